//! The change of a distance or an angle over a step, written exactly as a linear form of the increment.

use super::super::integration::{Integration, Rule};
use crate::math::vec2::{add, cross, dot, norm, rot90, scale, sub};
use crate::model::frozen::ConnectorEnd;

/// A matrix between the two ends of a connector, 2 x 2 blocks.
pub(super) type Blocks = [[[[f64; 2]; 2]; 2]; 2];

/// The exact change of a coordinate over a step, its form at the middle (`mean`), the derivative at the end (`end`), and the
/// derivative of `mean` with respect to the end (`bend`).
pub(super) struct CoordinateForm {
    pub change: f64,
    /// Form at the middle, on displacements or slopes of both ends, shape (2, 2) \[-\].
    pub mean: [[f64; 2]; 2],
    /// Derivative at the end of the step, likewise, shape (2, 2) \[-\].
    pub end: [[f64; 2]; 2],
    /// Derivative of `mean` with respect to the ends' increments: by end, end and components, shape (2, 2, 2, 2)
    /// \[1/m of a distance, 1 of an angle\].
    pub bend: Blocks,
}

/// `l1 - l0 = 2 d_m . Dd / (l0 + l1)`.
pub(super) fn distance_form(
    ends: &[ConnectorEnd; 2],
    rule: &Integration,
    u: &[[f64; 4]],
    increment: &[[f64; 4]],
) -> CoordinateForm {
    let start = sub(ends[0].position(u), ends[1].position(u));
    let step = sub(ends[0].increment(increment), ends[1].increment(increment));
    let end = add(start, step);
    let (l0, l1) = (norm(start), norm(end));
    let unit = |v: [f64; 2], l: f64| if l > 0.0 { scale(1.0 / l, v) } else { [0.0; 2] };
    let middle = add(start, scale(0.5, step));
    let change = dot(scale(2.0, middle), step) / (l0 + l1).max(f64::MIN_POSITIVE);
    // K = d(mean)/d(end): (I - mean (x) end) / length.
    let (mean, end_form, length, weight) = match rule.rule {
        Rule::Midpoint(_) => (unit(middle, 0.5 * (l0 + l1)), unit(end, l1), l0 + l1, 1.0),
        Rule::Alpha(_) | Rule::Static => {
            let at = add(start, scale(rule.theta(), step));
            let direction = unit(at, norm(at));
            (direction, direction, norm(at), rule.theta())
        }
    };
    let inverse = if length > 0.0 { weight / length } else { 0.0 };
    let k = |i: usize, j: usize| (f64::from(u8::from(i == j)) - mean[i] * end_form[j]) * inverse;
    let block = |sign: f64| [[sign * k(0, 0), sign * k(0, 1)], [sign * k(1, 0), sign * k(1, 1)]];
    CoordinateForm {
        change,
        mean: [mean, scale(-1.0, mean)],
        end: [end_form, scale(-1.0, end_form)],
        bend: [[block(1.0), block(-1.0)], [block(-1.0), block(1.0)]],
    }
}

/// Change of the angle from b to a, through `s = b x a` and `c = b . a`, which are quadratic: with `sigma = c_m Ds - s_m Dc`,
/// the angle changes by `atan2(sigma, c0 c1 + s0 s1)`.
pub(super) fn angle_form(
    start: [[f64; 2]; 2],
    step: [[f64; 2]; 2],
    joined: bool,
    rule: &Integration,
    [cosine, sine]: [f64; 2],
) -> CoordinateForm {
    let at =
        |share: f64| [add(start[0], scale(share, step[0])), add(start[1], scale(share, step[1]))];
    let (middle, end) = (at(0.5), at(1.0));
    // d s = b x da + db x a, d c = b . da + db . a.
    let forms = |[a, b]: [[f64; 2]; 2]| ([rot90(b), scale(-1.0, rot90(a))], [b, a]);
    let pair = |[a, b]: [[f64; 2]; 2]| (cross(b, a), dot(b, a));
    let ((s0, c0), (s1, c1)) = (pair(start), pair(end));
    let (sigma, gamma) = (s1 * c0 - s0 * c1, c0 * c1 + s0 * s1);
    let change = sigma.atan2(gamma);
    let combine = |x: f64, p: [[f64; 2]; 2], y: f64, q: [[f64; 2]; 2]| {
        [0, 1].map(|g| add(scale(x, p[g]), scale(y, q[g])))
    };
    let (ds1, dc1) = forms(end);
    let size1 = s1 * s1 + c1 * c1;
    let end_form = combine(c1 / size1, ds1, -s1 / size1, dc1);
    let mut form = match rule.rule {
        Rule::Midpoint(_) => {
            let (ds, dc) = forms(middle);
            let (s_m, c_m) = (0.5 * (s0 + s1), 0.5 * (c0 + c1));
            let small = sigma.abs() <= 1e-5 * gamma.abs();
            let factor = if small { 1.0 / gamma } else { change / sigma };
            let raw = combine(c_m, ds, -s_m, dc);
            // d(factor): of 1/gamma to first order, or of the quotient.
            let d_factor = if small {
                let d_gamma = combine(c0, dc1, s0, ds1);
                [0, 1].map(|g| scale(-1.0 / (gamma * gamma), d_gamma[g]))
            } else {
                let d_sigma = combine(c0, ds1, -s0, dc1);
                [0, 1].map(|g| scale(1.0 / sigma, sub(end_form[g], scale(factor, d_sigma[g]))))
            };
            let mut bend = product(&raw, &d_factor, 1.0);
            add_to(&mut bend, &product(&ds, &dc1, 0.5 * factor));
            add_to(&mut bend, &product(&dc, &ds1, -0.5 * factor));
            add_to(&mut bend, &cross_blocks(0.5 * factor * c_m, -0.5 * factor * s_m));
            let mean = raw.map(|v| scale(factor, v));
            CoordinateForm { change, mean, end: end_form, bend }
        }
        Rule::Alpha(_) | Rule::Static => {
            let theta = rule.theta();
            let here = at(theta);
            let ((s, c), (ds, dc)) = (pair(here), forms(here));
            let size = s * s + c * c;
            let mean = combine(c / size, ds, -s / size, dc);
            let d_size = combine(2.0 * s, ds, 2.0 * c, dc);
            let mut bend = product(&mean, &d_size, -theta / size);
            add_to(&mut bend, &product(&ds, &dc, theta / size));
            add_to(&mut bend, &product(&dc, &ds, -theta / size));
            add_to(&mut bend, &cross_blocks(theta * c / size, -theta * s / size));
            CoordinateForm { change, mean, end: mean, bend }
        }
    };
    // Back from the turned tangent of b to its own: R^T on its side.
    let back = |v: [f64; 2]| [cosine * v[0] + sine * v[1], -sine * v[0] + cosine * v[1]];
    if joined {
        form.mean[1] = back(form.mean[1]);
        form.end[1] = back(form.end[1]);
        let r = [[cosine, -sine], [sine, cosine]];
        let rows = |m: [[f64; 2]; 2]| {
            [0, 1].map(|i| [0, 1].map(|j| r[0][i] * m[0][j] + r[1][i] * m[1][j]))
        };
        let columns = |m: [[f64; 2]; 2]| {
            [0, 1].map(|i| [0, 1].map(|j| m[i][0] * r[0][j] + m[i][1] * r[1][j]))
        };
        for k in 0..2 {
            form.bend[1][k] = rows(form.bend[1][k]);
            form.bend[k][1] = columns(form.bend[k][1]);
        }
    } else {
        form.mean[1] = [0.0; 2];
        form.end[1] = [0.0; 2];
    }
    form
}

/// `factor left (x) right`.
pub(super) fn product(left: &[[f64; 2]; 2], right: &[[f64; 2]; 2], factor: f64) -> Blocks {
    std::array::from_fn(|g| {
        std::array::from_fn(|h| [0, 1].map(|i| [0, 1].map(|j| factor * left[g][i] * right[h][j])))
    })
}

/// Second derivatives of s and c, which tie a to b only: `x d2s + y d2c`.
fn cross_blocks(x: f64, y: f64) -> Blocks {
    let mut out = [[[[0.0; 2]; 2]; 2]; 2];
    // s = b1 a2 - b2 a1, c = b1 a1 + b2 a2.
    out[0][1] = [[y, -x], [x, y]];
    out[1][0] = [[y, x], [-x, y]];
    out
}

pub(super) fn add_to(sum: &mut Blocks, other: &Blocks) {
    for (a, b) in sum.as_flattened_mut().iter_mut().zip(other.as_flattened()) {
        for i in 0..2 {
            for j in 0..2 {
                a[i][j] += b[i][j];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::settings::Scheme;

    fn rules() -> [Integration; 2] {
        let h = 1e-2;
        [
            Integration::new(Scheme::EnergyMomentum, h),
            Integration::new(Scheme::GeneralizedAlpha { spectral_radius: 0.6 }, h),
        ]
    }

    #[test]
    fn an_angle_changes_by_its_form_and_forms_have_the_derivatives_given() {
        let start = [[1.0, 0.2], [0.7, -0.9]];
        for step in [[[0.3, 0.4], [-0.2, 0.5]], [[1e-9, -2e-9], [1e-9, 1e-9]]] {
            for rule in rules() {
                let turn = [0.6, 0.8];
                // Steps of b are given turned; its forms act on the steps before the turn.
                let own = |v: [f64; 2]| [0.6 * v[0] + 0.8 * v[1], -0.8 * v[0] + 0.6 * v[1]];
                let form = |step| angle_form(start, step, true, &rule, turn);
                let f = form(step);
                if matches!(rule.rule, Rule::Midpoint(_)) {
                    let work = dot(f.mean[0], step[0]) + dot(f.mean[1], own(step[1]));
                    assert!((work - f.change).abs() <= 1e-15 * (1.0 + f.change.abs()));
                }
                let e = 1e-6;
                for h in 0..2 {
                    for j in 0..2 {
                        let shifted = |sign: f64| {
                            let mut s = step;
                            let mut unit = [0.0; 2];
                            unit[j] = sign * e;
                            // A unit step of b before the turn is turned.
                            let unit = if h == 1 {
                                [0.6 * unit[0] - 0.8 * unit[1], 0.8 * unit[0] + 0.6 * unit[1]]
                            } else {
                                unit
                            };
                            s[h] = add(s[h], unit);
                            form(s)
                        };
                        let (p, m) = (shifted(1.0), shifted(-1.0));
                        for g in 0..2 {
                            for i in 0..2 {
                                let slope = (p.mean[g][i] - m.mean[g][i]) / (2.0 * e);
                                let given = f.bend[g][h][i][j];
                                assert!(
                                    (slope - given).abs() < 1e-7,
                                    "{g}{h}{i}{j} {slope} {given}"
                                );
                            }
                        }
                        if matches!(rule.rule, Rule::Midpoint(_)) {
                            let slope = (p.change - m.change) / (2.0 * e);
                            assert!((slope - f.end[h][j]).abs() < 1e-8);
                        }
                    }
                }
            }
        }
    }
}
