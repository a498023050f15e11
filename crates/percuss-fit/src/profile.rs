//! Profile likelihood: the least cost at given values of one parameter, all others free.

use rayon::prelude::*;

use crate::error::Stop;
use crate::fit::Fit;
use crate::least_costs::Profile;
use crate::problem::Problem;
use crate::run::GoesOn;

/// A profile reaches so many standard errors to either side.
const REACH: f64 = 3.0;
/// A bound that is nearer to the value before it than this share of the distance of two values is no value of its own.
const APART: f64 = 1e-3;
/// Increase of the sum of squares at the ends of the interval of 95 %: the quantile of chi-square with one degree of freedom.
const NINETY_FIVE: f64 = 3.841_458_820_694_124;

impl Problem {
    /// The profile of a free parameter of a fit, at `points` values to either side within three standard errors, or fewer up to a bound; none if
    /// there is no such parameter.
    ///
    /// # Errors
    /// If the user asks to stop.
    pub fn profile(
        &self,
        fit: &Fit,
        name: &str,
        points: usize,
        goes_on: GoesOn<'_>,
    ) -> Result<Option<Profile>, Stop> {
        let place = fit.free.iter().position(|k| fit.parameters[*k].name == name);
        let (Some(place), Some(best)) = (place, best(fit)) else { return Ok(None) };
        let (parameter, one) =
            (&fit.parameters[fit.free[place]], &self.adjustables[fit.free[place]]);
        let z = best[place];
        let error = parameter.stderr / one.rate(parameter.value);
        let error = if error.is_finite() && error > 0.0 { error } else { 0.1 * z.abs().max(0.1) };
        let [low, high] = one.coordinates();
        let wanted = values_beside(z, error * REACH / points as f64, [low, high], points);
        // Each side starts from the minimum and goes on from point to point.
        let side = |wanted: &Vec<f64>| -> Result<Vec<(f64, f64)>, Stop> {
            let (mut from, mut found) = (best.to_vec(), Vec::new());
            for at in wanted.iter().copied() {
                let mut bounds = self.bounds();
                bounds[place] = [at, at];
                from[place] = at;
                let minimum = self.descend(&from, &bounds, goes_on)?;
                if minimum.cost.is_finite() {
                    from = minimum.coordinates;
                }
                found.push((one.value(at), minimum.cost));
            }
            Ok(found)
        };
        let sides: Result<Vec<_>, Stop> =
            self.workers.install(|| wanted.par_iter().map(side).collect());
        let sides = sides?;
        let limit = fit.cost + 0.5 * NINETY_FIVE * fit.scale;
        let middle = (parameter.value, fit.cost);
        let interval = [0, 1].map(|side| crossing(middle, &sides[side], limit));
        let below = sides[0].iter().rev().copied();
        let all: Vec<(f64, f64)> = below.chain([middle]).chain(sides[1].iter().copied()).collect();
        let (values, costs) = all.into_iter().unzip();
        let (name, unit) = (name.to_owned(), parameter.unit.clone());
        Ok(Some(Profile { name, unit, values, costs, interval }))
    }
}

/// Coordinates of the best minimum of a fit.
fn best(fit: &Fit) -> Option<&[f64]> {
    let finite = fit.minima.iter().filter(|one| one.cost.is_finite());
    let best = finite.min_by(|a, b| a.cost.total_cmp(&b.cost))?;
    Some(&best.coordinates)
}

/// Coordinates below and above one, at so many steps; the last one may lie at a bound, shape (2, values) \[-\].
fn values_beside(z: f64, step: f64, [low, high]: [f64; 2], points: usize) -> [Vec<f64>; 2] {
    [-1.0, 1.0].map(|sign| {
        let mut all: Vec<f64> = Vec::new();
        for k in 1..=points {
            let wanted = z + sign * step * k as f64;
            let at = wanted.clamp(low, high);
            if (at - all.last().unwrap_or(&z)).abs() > APART * step {
                all.push(at);
            }
            if at != wanted {
                break;
            }
        }
        all
    })
}

/// Where a profile passes a cost, beginning at the minimum: on the parabola through the values before and behind and the next one, since a
/// profile may rise from a minimum or, at a bound, in a straight line.
fn crossing(minimum: (f64, f64), side: &[(f64, f64)], limit: f64) -> f64 {
    let rise = |cost: f64| cost - minimum.1;
    let (wanted, mut before) = (rise(limit), (minimum.0, 0.0));
    for (k, (value, cost)) in side.iter().enumerate() {
        let here = (*value, rise(*cost));
        if here.1 >= wanted && here.1 > before.1 {
            let next = side.get(k + 1).map(|(value, cost)| (*value, rise(*cost)));
            // With nothing else a minimum is level.
            let mirrored = (2.0 * before.0 - here.0, here.1);
            let third = next.filter(|next| next.1.is_finite()).unwrap_or(mirrored);
            return before.0 + (here.0 - before.0) * share(before, here, third, wanted);
        }
        before = here;
    }
    f64::NAN
}

/// Share of the way between two points at which the parabola through them and a third one has a height that lies between theirs.
fn share(from: (f64, f64), to: (f64, f64), third: (f64, f64), height: f64) -> f64 {
    let width = to.0 - from.0;
    let (rise, wanted) = (to.1 - from.1, height - from.1);
    let slope = (third.1 - to.1) / (third.0 - to.0);
    let bend = (slope - rise / width) / (third.0 - from.0) * width * width;
    // wanted = (rise - bend) s + bend s^2
    let linear = rise - bend;
    let root = (linear * linear + 4.0 * bend * wanted).max(0.0).sqrt();
    (2.0 * wanted / (linear + root)).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_interval_of_a_parabola_is_that_of_its_standard_error() {
        // Cost x^2 / 2 about 1 with a standard error of one.
        let side: Vec<(f64, f64)> =
            (1..=6).map(f64::from).map(|k| (1.0 + 0.5 * k, 0.125 * k * k)).collect();
        let found = crossing((1.0, 0.0), &side, 0.5 * NINETY_FIVE);
        assert!((found - 2.959_963_984_540_054).abs() < 1e-9, "{found}");
        assert!(crossing((1.0, 0.0), &side[..2], 0.5 * NINETY_FIVE).is_nan());
        let alone = crossing((1.0, 0.0), &[(4.0, 4.5)], 0.5 * NINETY_FIVE);
        assert!((alone - 2.959_963_984_540_054).abs() < 1e-9, "{alone}");
    }

    #[test]
    fn a_profile_may_rise_in_a_straight_line_from_a_bound() {
        let of = |cost: fn(f64) -> f64| {
            let side: Vec<(f64, f64)> =
                (1..=4).map(|k| -0.5 * f64::from(k)).map(|x| (x, cost(x))).collect();
            crossing((0.0, 0.0), &side, 2.0)
        };
        assert!((of(|x| -10.0 * x) + 0.2).abs() < 1e-12);
        // 10 s + 20 s^2 = 2 at s = (sqrt(260) - 10) / 40.
        assert!(
            (of(|x| -10.0 * x + 20.0 * x * x) + (260.0_f64.sqrt() - 10.0) / 40.0).abs() < 1e-12
        );
        // The profile is level at first, and NaN behind where it rises.
        let side = [(1.0, 0.0), (2.0, 4.0), (3.0, f64::NAN)];
        assert!((crossing((0.0, 0.0), &side, 1.0) - 1.5).abs() < 1e-12);
    }

    #[test]
    fn a_profile_ends_at_a_bound() {
        let [below, above] = values_beside(1.0, 0.5, [-0.2, 2.0], 4);
        assert_eq!((below, above), (vec![0.5, 0.0, -0.2], vec![1.5, 2.0]));
        let [below, above] = values_beside(1.0, 0.5, [0.5, 1.0 + 1e-9], 1);
        assert_eq!((below, above), (vec![0.5], Vec::new()));
    }
}
