//! Reciprocals and square roots of lanes without the divider.
//!
//! On registers of eight numbers division is slow: one root and one reciprocal per Gauss point took a sixth of a study's time (from a profile).
//! Newton's iteration from the processor's estimate of 14 bits, its last step rounded as Markstein showed (IA-64 and Elementary Functions, 2000,
//! chapters 8 and 9), gives the same bits. Each of its steps depends on the previous one: several numbers at a time, step by step, use the
//! processor meanwhile.

use pulp::Simd;

/// Reciprocals of ordinary numbers: neither they nor their reciprocals are zero, infinite or subnormal.
#[inline(always)]
pub fn reciprocals<P: Simd, const N: usize>(family: P, x: [P::f64s; N]) -> [P::f64s; N] {
    #[cfg(target_arch = "x86_64")]
    if let (Some(family), Some(y)) = (same(family), same::<_, [pulp::f64x8; N]>(x)) {
        return same(estimated::reciprocals(family, y)).unwrap_or(x);
    }
    let mut y = x;
    for i in 0..N {
        y[i] = family.div_f64s(family.splat_f64s(1.0), x[i]);
    }
    y
}

/// Square roots of ordinary numbers: positive, neither infinite nor subnormal.
#[inline(always)]
pub fn roots<P: Simd, const N: usize>(family: P, x: [P::f64s; N]) -> [P::f64s; N] {
    #[cfg(target_arch = "x86_64")]
    if let (Some(family), Some(y)) = (same(family), same::<_, [pulp::f64x8; N]>(x)) {
        return same(estimated::roots(family, y)).unwrap_or(x);
    }
    let mut y = x;
    for i in 0..N {
        y[i] = family.sqrt_f64s(x[i]);
    }
    y
}

/// The same value if `A` and `B` are the same type. Known when this is compiled.
#[cfg(target_arch = "x86_64")]
#[inline(always)]
fn same<A: Copy + 'static, B: Copy + 'static>(a: A) -> Option<B> {
    (&a as &dyn std::any::Any).downcast_ref().copied()
}

#[cfg(target_arch = "x86_64")]
mod estimated {
    use std::arch::x86_64::{__m512d, _MM_FROUND_NO_EXC, _MM_FROUND_TO_POS_INF};

    use pulp::x86::V4;
    use pulp::{Simd, cast, f64x8};

    #[inline(always)]
    pub fn reciprocals<const N: usize>(family: V4, x: [f64x8; N]) -> [f64x8; N] {
        let (one, sign) = (family.splat_f64s(1.0), family.splat_f64s(-0.0));
        let (mut y, mut opposite) = (x, x);
        for i in 0..N {
            opposite[i] = family.or_f64s(x[i], sign);
            y[i] = cast(family.avx512f._mm512_rcp14_pd(cast(minus(family, opposite[i]))));
        }
        for round in 0..3 {
            let mut error = y;
            for i in 0..N {
                error[i] = family.mul_add_f64s(opposite[i], y[i], one);
            }
            for i in 0..N {
                y[i] = match round {
                    1 => add_product_upwards(family, y[i], error[i]),
                    _ => family.mul_add_f64s(y[i], error[i], y[i]),
                };
            }
        }
        for i in 0..N {
            y[i] = family.or_f64s(y[i], family.and_f64s(x[i], sign));
        }
        y
    }

    /// `y + y e`, rounded up: where the digits of a number are all ones, as those of 1 - 2^-53, which a stretch often is, the last
    /// step finds the reciprocal from above only (from below it comes upon a tie).
    #[inline(always)]
    fn add_product_upwards(family: V4, y: f64x8, e: f64x8) -> f64x8 {
        const UP: i32 = _MM_FROUND_TO_POS_INF | _MM_FROUND_NO_EXC;
        let (y, e): (__m512d, __m512d) = (cast(y), cast(e));
        cast(family.avx512f._mm512_fmadd_round_pd::<UP>(y, e, y))
    }

    #[inline(always)]
    pub fn roots<const N: usize>(family: V4, x: [f64x8; N]) -> [f64x8; N] {
        let half = family.splat_f64s(0.5);
        // The root, and half its reciprocal.
        let (mut y, mut z) = (x, x);
        for i in 0..N {
            let estimate = cast(family.avx512f._mm512_rsqrt14_pd(cast(x[i])));
            (y[i], z[i]) = (family.mul_f64s(x[i], estimate), family.mul_f64s(estimate, half));
        }
        for _ in 0..2 {
            let mut error = y;
            for i in 0..N {
                error[i] = family.mul_add_f64s(minus(family, y[i]), z[i], half);
            }
            for i in 0..N {
                y[i] = family.mul_add_f64s(y[i], error[i], y[i]);
            }
            for i in 0..N {
                z[i] = family.mul_add_f64s(z[i], error[i], z[i]);
            }
        }
        let mut left = y;
        for i in 0..N {
            left[i] = family.mul_add_f64s(minus(family, y[i]), y[i], x[i]);
        }
        for i in 0..N {
            y[i] = family.mul_add_f64s(left[i], z[i], y[i]);
        }
        y
    }

    #[inline(always)]
    fn minus(family: V4, x: f64x8) -> f64x8 {
        family.mul_f64s(x, family.splat_f64s(-1.0))
    }
}

#[cfg(all(test, target_arch = "x86_64"))]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use pulp::bytemuck::cast;
    use pulp::x86::V4;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(20_000))]
        #[test]
        fn bits_are_those_of_the_divider(
            mantissa in prop::array::uniform8(1.0..2.0_f64),
            exponent in prop::array::uniform8(-300..300_i32),
        ) {
            let Some(family) = V4::try_new() else { return Ok(()) };
            let x: [f64; 8] = std::array::from_fn(|i| mantissa[i] * 2.0_f64.powi(exponent[i]));
            let y: [f64; 8] = cast(family.vectorize(|| reciprocals(family, [cast(x)])));
            let z: [f64; 8] = cast(family.vectorize(|| roots(family, [cast(x)])));
            prop_assert_eq!(y, x.map(f64::recip));
            prop_assert_eq!(z, x.map(f64::sqrt));
        }
    }

    #[test]
    fn so_they_are_next_to_powers_of_two() {
        let Some(family) = V4::try_new() else { return };
        for power in -30..30 {
            for near in -100..100_i64 {
                let bits = |i: i64| (2.0_f64.powi(power).to_bits() as i64 + 8 * near + i) as u64;
                let x: [f64; 8] = std::array::from_fn(|i| f64::from_bits(bits(i as i64)));
                let z: [f64; 8] = cast(family.vectorize(|| roots(family, [cast(x)])));
                assert_eq!(z, x.map(f64::sqrt));
                for x in [x, x.map(|x| -x)] {
                    let y: [f64; 8] = cast(family.vectorize(|| reciprocals(family, [cast(x)])));
                    assert_eq!(y, x.map(f64::recip), "{x:?}");
                }
            }
        }
    }
}
