//! A mass behind a linear spring that strikes an infinite beam: the closed form of the wave-controlled impact.

use nalgebra::Complex;

/// A contact on an infinite beam in dimensionless form: time in units of `tau = sqrt(M/k)`, force in units of `V sqrt(k M)`.
///
/// A Bernoulli beam without end gives way under a force F with the velocity `1/C` times the half-integral of F, where
/// `C = 2 sqrt2 EI^(1/4) rhoA^(3/4)`. With the projectile's and the spring's equations of motion the Laplace transform of the
/// force is `1 / (s^2 + beta sqrt(s) + 1)`, `beta = M^(3/4) k^(1/4) / C`, whence by partial fractions in `sqrt(s)`
///
/// `phi(x) = sum r_i p_i erfc(-p_i sqrt(x)) exp(p_i^2 x)`, `r_i = 1 / (4 p_i^3 + beta)`
///
/// over the roots of `p^4 + beta p + 1 = 0`, up to the first zero of phi.
#[derive(Clone, Copy, Debug)]
pub struct InfiniteBeam {
    /// One set of partial fractions; beside a double root two, either side of it, for their mean, shape (2).
    sets: [Fractions; 2],
    beta: f64,
}

/// A contact on an infinite beam, from touch to release.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InfiniteBeamImpact {
    /// Largest force \[N\].
    pub peak_force: f64,
    /// Time of the largest force after touch \[s\].
    pub peak_time: f64,
    /// Time from touch to release \[s\]; none where the projectile stays on the beam (beta above about 3.6).
    pub duration: Option<f64>,
    /// Velocity of the projectile after release over that before touch, positive where it comes back; none where it stays.
    pub restitution: Option<f64>,
}

/// Roots p and residues r of `1 / (p^4 + beta p + 1)`.
#[derive(Clone, Copy, Debug)]
struct Fractions {
    /// Roots of the denominator, shape (4) \[1/s^(1/2)\].
    roots: [Complex<f64>; 4],
    /// Residues there, shape (4) \[s^(1/2)\].
    residues: [Complex<f64>; 4],
}

/// At this beta two roots are equal: `4 / 3^(3/4)`.
const DOUBLE_ROOT: f64 = 1.754_765_350_603_3;
/// Relative distance from it within which the mean of both sides is taken: its error is the square of this, that of
/// the partial fractions the precision of numbers over the root of it.
const BESIDE: f64 = 1e-6;
/// Tries to bracket the largest force, each a tenth nearer to the touch: down to 1e-46 of the contact time.
const MOST_SHRUNK: usize = 1000;

impl InfiniteBeam {
    /// For `beta = M^(3/4) k^(1/4) / C`.
    pub fn new(beta: f64) -> Self {
        let sets = if (beta / DOUBLE_ROOT - 1.0).abs() < BESIDE {
            [beta * (1.0 - 2.0 * BESIDE), beta * (1.0 + 2.0 * BESIDE)].map(Fractions::new)
        } else {
            [Fractions::new(beta); 2]
        };
        Self { sets, beta }
    }

    /// A mass M \[kg\] behind a spring k \[N/m\] on a beam with bending stiffness EI \[N m^2\] and mass rhoA \[kg/m\].
    pub fn of(mass: f64, stiffness: f64, bending: f64, mass_per_length: f64) -> Self {
        let beam = 2.0 * 2.0_f64.sqrt() * bending.powf(0.25) * mass_per_length.powf(0.75);
        Self::new(mass.powf(0.75) * stiffness.powf(0.25) / beam)
    }

    /// The parameter `beta`: zero for a rigid beam, above about 3.6 the projectile never leaves.
    pub fn beta(&self) -> f64 {
        self.beta
    }

    /// Force phi at the time `x` after touch, without regard to release.
    pub fn force(&self, x: f64) -> f64 {
        self.sum(x, |p, r, w| r * p * w)
    }

    /// Velocity of the projectile at the time `x` after touch, over that before: `1 - int phi`.
    pub fn velocity(&self, x: f64) -> f64 {
        // The residues' identity `sum r_i / p_i = -1` takes the constant away.
        self.sum(x, |p, r, w| -r / p * w)
    }

    /// Rate of phi.
    fn rate(&self, x: f64) -> f64 {
        self.sum(x, |p, r, w| r * p * p * p * w)
    }

    fn sum(
        &self,
        x: f64,
        term: fn(Complex<f64>, Complex<f64>, Complex<f64>) -> Complex<f64>,
    ) -> f64 {
        let of = |set: &Fractions| -> f64 {
            let both = set.roots.iter().zip(&set.residues);
            both.map(|(&p, &r)| term(p, r, scaled_erfc(p, x)).re).sum()
        };
        0.5 * (of(&self.sets[0]) + of(&self.sets[1]))
    }

    /// Time of the largest force, the first zero of its rate.
    pub fn peak(&self) -> f64 {
        // The rate falls from one; it has changed sign at pi/2, where the beam gives way the less the smaller beta.
        let mut high = std::f64::consts::FRAC_PI_2;
        for _ in 0..MOST_SHRUNK {
            let has_passed = self.rate(0.9 * high) < 0.0;
            if !has_passed {
                break;
            }
            high *= 0.9;
        }
        bisect(0.0, high, |x| self.rate(x))
    }

    /// Time of release, the first zero of phi after touch; none where there is none.
    pub fn release(&self) -> Option<f64> {
        const SEARCHED: usize = 240;
        // First zeros fall from pi at beta zero to 2.02; past 2 pi there is none that is the first.
        let start = self.peak();
        let step = (2.0 * std::f64::consts::PI - start) / SEARCHED as f64;
        let ends = (0..SEARCHED).map(|k| [start + k as f64 * step, start + (k + 1) as f64 * step]);
        let [low, high] = ends.into_iter().find(|[_, high]| self.force(*high) <= 0.0)?;
        Some(bisect(low, high, |x| self.force(x)))
    }

    /// The contact at `speed` \[m/s\] of a mass \[kg\] behind a spring \[N/m\], for which this was made.
    pub fn impact(&self, mass: f64, stiffness: f64, speed: f64) -> InfiniteBeamImpact {
        let (time, peak, release) = ((mass / stiffness).sqrt(), self.peak(), self.release());
        InfiniteBeamImpact {
            peak_force: speed * (stiffness * mass).sqrt() * self.force(peak),
            peak_time: time * peak,
            duration: release.map(|x| time * x),
            restitution: release.map(|x| -self.velocity(x)),
        }
    }
}

impl Fractions {
    /// By Ferrari's factors `(p^2 + a p + b)(p^2 - a p + c)`: `y = a^2` solves `y^3 - 4 y = beta^2`, `c = (y + beta/a)/2`, `b = 1/c`.
    /// Differences of roots come from the factors' discriminants, exact also where roots are nearly equal.
    fn new(beta: f64) -> Self {
        let mut y = 2.0 + (beta * beta).cbrt(); // above the root, from where Newton's method falls to it
        for _ in 0..60 {
            y -= (y * (y * y - 4.0) - beta * beta) / (3.0 * y * y - 4.0);
        }
        let a = y.sqrt();
        let c = 0.5 * (y + beta / a);
        let b = 1.0 / c;
        let left = Complex::new(y - 4.0 * b, 0.0).sqrt();
        let right = Complex::new(y - 4.0 * c, 0.0).sqrt();
        let far = -0.5 * (left + a);
        let roots = [far, far.inv() * b, 0.5 * (right + a), 0.5 * (-right + a)];
        let other = |p: Complex<f64>, a: f64, b: f64| p * (p + a) + b;
        let residues = [
            -(left * other(roots[0], -a, c)).inv(),
            (left * other(roots[1], -a, c)).inv(),
            (right * other(roots[2], a, b)).inv(),
            -(right * other(roots[3], a, b)).inv(),
        ];
        Self { roots, residues }
    }
}

/// `erfc(-p sqrt(x)) exp(p^2 x) = w(-i p sqrt(x))`, w the Faddeeva function.
///
/// w is taken from the crate puruspe: pure Rust, kept up, a port of S. G. Johnson's and J. Wuttke's libcerf, and in the upper half
/// plane within 3e-14 of an independent port of the same algorithms over 720 000 points. In the lower half plane, where w
/// grows, it comes from `w(z) = 2 exp(-z^2) - w(-z)`: roots there have `Re p^2 <= 0`, so nothing overflows.
fn scaled_erfc(p: Complex<f64>, x: f64) -> Complex<f64> {
    let q = p * x.sqrt();
    let w = |re: f64, im: f64| {
        let (re, im) = puruspe::faddeeva(re, im);
        Complex::new(re, im)
    };
    // -i q = (Im q, -Re q)
    if q.re <= 0.0 { w(q.im, -q.re) } else { 2.0 * (q * q).exp() - w(-q.im, q.re) }
}

/// The zero between `low`, where `f` is positive, and `high`, where it is not.
fn bisect(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        *(if f(middle) > 0.0 { &mut low } else { &mut high }) = middle;
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::super::near;
    use super::*;

    /// Benchmark E4 (closed form): largest force, its time, end of contact, apparent restitution. The times of the largest force
    /// were found there from values near a flat maximum, good to 1e-8; 40 digits give 1.49832175451676 and 1.2685889476654.
    #[test]
    fn force_time_release_and_restitution_are_those_of_the_closed_form() {
        let cases = [
            (0.1, 0.937_779_493_8, 1.498_321_768_1, 3.055_548_472_1, 0.821_481_250_9),
            (0.5, 0.755_596_451_1, 1.268_588_938_2, 2.774_035_704_3, 0.319_362_132_6),
        ];
        for (beta, force, time, end, restitution) in cases {
            let beam = InfiniteBeam::new(beta);
            near(beam.force(beam.peak()), force, 1e-10);
            near(beam.peak(), time, 2e-8);
            let release = beam.release().unwrap_or(f64::NAN);
            near(release, end, 1e-10);
            near(-beam.velocity(release), restitution, 1e-9);
        }
    }

    /// Benchmark E4, the example: EI 166600 N m^2, rhoA 300 kg/m, M 10 kg, k 1e7 N/m, V 0.01 m/s.
    #[test]
    fn the_example_has_the_force_time_and_rebound_of_the_closed_form() {
        let beam = InfiniteBeam::of(10.0, 1e7, 166_600.0, 300.0);
        let impact = beam.impact(10.0, 1e7, 0.01);
        near(impact.peak_force, 95.146_518_557, 1e-10);
        near(impact.peak_time, 1.514_508_856e-3, 1e-8); // 40 digits give 1.5145088647457e-3
        near(0.01 * impact.restitution.unwrap_or(f64::NAN), 8.604_740_827e-3, 1e-9);
    }

    /// Values of phi by mpmath with 30 digits, beside the double root at beta = 1.7547653506033 too.
    #[test]
    fn the_force_is_exact_for_any_beta() {
        let cases = [
            (0.5, 0.3, 0.288_271_229_206_424_3),
            (3.0, 2.0, 0.003_482_566_994_837_178),
            (1.754_765_350_603_3, 1.1, 0.459_491_387_282_110_36),
            (20.0, 5.0, 0.010_395_735_173_346_266),
            (1000.0, 0.5, 0.000_796_871_802_595_948_8),
        ];
        for (beta, x, phi) in cases {
            let found = InfiniteBeam::new(beta).force(x);
            assert!((found - phi).abs() < 3e-12, "beta {beta}: {found} instead of {phi}");
        }
    }

    #[test]
    fn a_rigid_beam_sends_everything_back_after_half_a_period() {
        let beam = InfiniteBeam::new(0.0);
        for x in [0.1, 1.0, 2.0, 3.0] {
            near(beam.force(x), x.sin(), 1e-13);
            assert!((beam.velocity(x) - x.cos()).abs() < 1e-13);
        }
        near(beam.release().unwrap_or(f64::NAN), std::f64::consts::PI, 1e-12);
    }

    #[test]
    fn the_projectile_loses_the_impulse_of_the_force() {
        for beta in [0.02, 0.7, 1.754_765_4, 5.0] {
            let beam = InfiniteBeam::new(beta);
            let n = 4000_u32;
            let at = |k: u32| 2.0 * (f64::from(k) + 0.5) / f64::from(n);
            let impulse: f64 = (0..n).map(|k| beam.force(at(k))).sum::<f64>() * 2.0 / f64::from(n);
            near(1.0 - beam.velocity(2.0), impulse, 1e-6);
        }
    }

    #[test]
    fn a_heavy_mass_on_a_hard_spring_never_comes_back() {
        assert!(InfiniteBeam::new(3.5).release().is_some());
        assert!(InfiniteBeam::new(4.0).release().is_none());
        assert!(InfiniteBeam::new(50.0).release().is_none());
    }
}
