//! A number on finer and finer steps or meshes: observed order, limit, and how sure both are.

/// Ratio of neighbouring changes below which a sequence does not close in on anything that can be told.
const LEAST_RATIO: f64 = 1.2;
/// Changes below this share of the value are round-off of runs.
const ROUND_OFF: f64 = 1e-9;

/// What a sequence of values on steps, or meshes, each twice as fine as the one before, says of its limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extrapolation {
    /// Observed order, from the three finest values; none where neighbouring changes do not shrink steadily, with one sign.
    pub order: Option<f64>,
    /// Richardson's extrapolation; the finest value where there is no order.
    pub limit: f64,
    /// Uncertainty of the limit: with an order, by what the limits of neighbouring triples differ, and a quarter of what is
    /// extrapolated at least (the safety factor 1.25 of Roache's grid convergence index, Annu. Rev. Fluid Mech. 29, 1997);
    /// without one, the spread of the values but the coarsest.
    pub uncertainty: f64,
    /// Whether the values are the same to round-off.
    pub constant: bool,
}

/// Order, limit and uncertainty of a sequence of three values or more, coarsest first.
pub fn extrapolate(values: &[f64]) -> Extrapolation {
    let finest = values.last().copied().unwrap_or(f64::NAN);
    let none = Extrapolation { order: None, limit: finest, uncertainty: f64::NAN, constant: false };
    if values.len() < 3 || values.iter().any(|value| !value.is_finite()) {
        return none;
    }
    let size = values.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    let spread = |values: &[f64]| {
        let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        most - values.iter().copied().fold(f64::INFINITY, f64::min)
    };
    if spread(values) <= ROUND_OFF * size {
        return Extrapolation { uncertainty: spread(values), constant: true, ..none };
    }
    let triples: Vec<Option<[f64; 2]>> = values.windows(3).map(of_three).collect();
    let steady: Option<Vec<[f64; 2]>> = triples.iter().copied().collect();
    let Some(steady) = steady else {
        return Extrapolation { uncertainty: spread(&values[1..]), ..none };
    };
    let [ratio, limit] = steady[steady.len() - 1];
    let before = steady.len().checked_sub(2).map_or(limit, |k| steady[k][1]);
    let uncertainty = (limit - before).abs().max(0.25 * (limit - finest).abs());
    Extrapolation { order: Some(ratio.log2()), limit, uncertainty, constant: false }
}

/// Ratio of the changes, and limit, of three values; none where they do not shrink steadily.
fn of_three(values: &[f64]) -> Option<[f64; 2]> {
    let [a, b, c] = values else { return None };
    let ratio = (a - b) / (b - c);
    (ratio >= LEAST_RATIO && ratio.is_finite()).then(|| [ratio, c + (c - b) / (ratio - 1.0)])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(law: impl Fn(f64) -> f64) -> Extrapolation {
        let values: Vec<f64> = (0..4).map(|k| law(0.5_f64.powi(k))).collect();
        extrapolate(&values)
    }

    #[test]
    fn powers_of_the_step_have_their_order_and_limit() {
        for order in [1, 2, 4] {
            let found = of(|h| 3.0 - 0.2 * h.powi(order));
            assert!((found.order.unwrap_or(f64::NAN) - f64::from(order)).abs() < 1e-9);
            assert!((found.limit - 3.0).abs() < 1e-12);
        }
    }

    /// With a term of higher order besides, the error of the limit lies within its uncertainty.
    #[test]
    fn the_uncertainty_holds_the_true_limit() {
        for (first, second) in [(0.3, 0.2), (0.3, -0.1), (1.0, 0.5)] {
            let found = of(|h| 2.0 + first * h + second * h * h);
            assert!((found.limit - 2.0).abs() <= found.uncertainty, "{found:?}");
        }
    }

    #[test]
    fn what_does_not_close_in_steadily_has_no_order() {
        for values in [
            [1.0, 2.0, 1.5, 1.7],
            [1.0, 1.1, 1.2, 1.3],
            [1.0, 1.0, 1.1, 1.1],
            [5.0, 1.0, 1.1, 1.12],
        ] {
            let found = extrapolate(&values);
            assert_eq!((found.order, found.limit), (None, values[3]));
            assert!(found.uncertainty > 0.0 && !found.constant);
        }
        assert_eq!(extrapolate(&[1.0, f64::NAN, 1.0]).order, None);
    }

    #[test]
    fn what_does_not_change_is_constant() {
        let found = extrapolate(&[2.0, 2.0 + 1e-13, 2.0]);
        assert!(found.constant && found.order.is_none() && found.uncertainty < 1e-12);
    }
}
