//! Profile likelihood: the least cost at given values of one parameter, all others free.

use rayon::prelude::*;

use crate::error::Stop;
use crate::fit::Fit;
use crate::least_costs::Profile;
use crate::problem::Problem;
use crate::run::GoesOn;

/// A profile reaches so many standard errors to either side.
const REACH: f64 = 3.0;
/// Increase of the sum of squares at the ends of the interval of 95 %: the quantile of chi-square with one degree of freedom.
const NINETY_FIVE: f64 = 3.841_458_820_694_124;

impl Problem {
    /// The profile of a free parameter of a fit, at `points` values to either side within three standard errors; none if there is no such
    /// parameter.
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
        // Each side starts from the minimum and goes on from point to point.
        let side = |sign: &f64| -> Result<Vec<(f64, f64)>, Stop> {
            let (mut from, mut found) = (best.to_vec(), Vec::new());
            for k in 1..=points {
                let at = z + sign * error * REACH * k as f64 / points as f64;
                if at < low || at > high {
                    break;
                }
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
            self.workers.install(|| [-1.0, 1.0].par_iter().map(side).collect());
        let sides = sides?;
        let scale = if fit.sigma_unknown { fit.reduced_chi_square } else { 1.0 };
        let limit = fit.cost + 0.5 * NINETY_FIVE * scale;
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

/// Where a profile passes a cost on its way from the minimum. The root of its height above the minimum is nearly straight.
fn crossing(minimum: (f64, f64), side: &[(f64, f64)], limit: f64) -> f64 {
    let root = |cost: f64| (cost - minimum.1).max(0.0).sqrt();
    let mut before = (minimum.0, 0.0);
    for (value, cost) in side {
        let here = (*value, root(*cost));
        let wanted = root(limit);
        if here.1 >= wanted && here.1 > before.1 {
            return before.0 + (here.0 - before.0) * (wanted - before.1) / (here.1 - before.1);
        }
        before = here;
    }
    f64::NAN
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
    }
}
