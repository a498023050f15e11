//! An impact while a constant force presses both together: a falling weight that does not stop falling when it touches.

use std::f64::consts::FRAC_PI_2;

use super::SingleMassImpact;

/// Intervals of the midpoint rule; times are then exact to 1e-7.
const INTERVALS: usize = 4000;
/// Doublings that look for the turning point, and halvings that find it.
const TRIES: usize = 200;

/// A mass \[kg\] at `speed` \[m/s\] against a rigid target under a force law given by its potential `energy` \[J\] and its `force`
/// \[N\] over the penetration \[m\], while the constant force `pull` \[N\] presses it on (negative: pulls it back). None where it
/// never turns round.
///
/// The turning point is where the potential has taken up all there was, `V(p) = m v^2/2 + W p`; the time is twice
/// `int dp / sqrt(v^2 + 2 (W p - V(p))/m)` over the way. With `p = p_max sin^2 a` the integrand is smooth at both ends, also from
/// rest.
pub fn pressed_impact(
    energy: impl Fn(f64) -> f64,
    force: impl Fn(f64) -> f64,
    mass: f64,
    speed: f64,
    pull: f64,
) -> Option<SingleMassImpact> {
    let left = |p: f64| 0.5 * mass * speed * speed + pull * p - energy(p);
    let mut high = speed * speed + f64::MIN_POSITIVE.sqrt();
    let passed = (0..TRIES).find(|_| {
        let passed = left(high) < 0.0;
        high *= if passed { 1.0 } else { 8.0 };
        passed
    });
    passed?;
    let mut low = 0.0;
    for _ in 0..TRIES {
        let middle = 0.5 * (low + high);
        *(if left(middle) > 0.0 { &mut low } else { &mut high }) = middle;
    }
    let way = low;
    let at = |k: usize| {
        let (sine, cosine) = (FRAC_PI_2 * (k as f64 + 0.5) / INTERVALS as f64).sin_cos();
        let rate = 2.0 * left(way * sine * sine).max(0.0) / mass;
        2.0 * way * sine * cosine / rate.sqrt()
    };
    let sum: f64 = (0..INTERVALS).map(at).sum();
    let duration = 2.0 * FRAC_PI_2 * sum / INTERVALS as f64;
    let impact = SingleMassImpact { duration, peak_force: force(way), penetration: way };
    (impact.duration.is_finite() && impact.duration > 0.0).then_some(impact)
}

#[cfg(test)]
mod tests {
    use super::super::{hertz_impact, linear_impact, near};
    use super::*;

    /// On a spring the motion is `p = (W/k)(1 - cos wt) + (v/w) sin wt`: the largest force is `W + sqrt(W^2 + k m v^2)`, the time
    /// `(2 pi - 2 atan(v k / (w W)))/w`.
    #[test]
    fn a_weight_on_a_spring_has_its_closed_form() {
        for (mass, stiffness, speed, pull) in [
            (2.0, 1e4, 0.01, 19.62),
            (2.0, 1e4, 3.0, 19.62),
            (2.0, 1e4, 0.5, -9.0),
            (1.0, 1e6, 0.0, 9.81),
        ] {
            let k: f64 = stiffness;
            let impact = pressed_impact(|p| 0.5 * k * p * p, |p| k * p, mass, speed, pull);
            let impact = impact.unwrap_or(SingleMassImpact {
                duration: 0.0,
                peak_force: 0.0,
                penetration: 0.0,
            });
            let w = (k / mass).sqrt();
            near(impact.peak_force, pull + (pull * pull + k * mass * speed * speed).sqrt(), 1e-9);
            let angle = (speed * k).atan2(w * pull);
            near(impact.duration, 2.0 * (std::f64::consts::PI - angle) / w, 1e-6);
        }
    }

    #[test]
    fn without_a_weight_it_is_the_impact_that_is_known() {
        let (mass, k, speed) = (0.3, 2e9, 1.5);
        let found =
            pressed_impact(|p| 0.4 * k * p.powf(2.5), |p| k * p.powf(1.5), mass, speed, 0.0);
        let hertz = hertz_impact(mass, k, speed);
        near(found.map_or(f64::NAN, |b| b.duration), hertz.duration, 1e-6);
        near(found.map_or(f64::NAN, |b| b.peak_force), hertz.peak_force, 1e-9);
        let linear = linear_impact(mass, k, speed);
        let found = pressed_impact(|p| 0.5 * k * p * p, |p| k * p, mass, speed, 0.0);
        near(found.map_or(f64::NAN, |b| b.duration), linear.duration, 1e-6);
    }

    #[test]
    fn a_force_that_never_balances_the_weight_has_no_turning_point() {
        assert_eq!(pressed_impact(|p| 5.0 * p, |_| 5.0, 1.0, 1.0, 9.81), None);
    }
}
