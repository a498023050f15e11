//! A number on finer and finer steps or meshes: observed order, limit, and how sure both are.

/// Ratio of neighbouring changes from which on an order is given: that of the first order, less what further terms do to it. Changes that
/// shrink more slowly are as often a wave or a kink as an order of a half, and what is extrapolated from them is worse than the finest value.
const LEAST_RATIO: f64 = 1.9;
/// Roache's safety factor for observed orders (Annu. Rev. Fluid Mech. 29, 1997).
const SAFETY: f64 = 1.25;
/// Changes below this share of the value are round-off of runs.
const ROUND_OFF: f64 = 1e-9;

/// What a sequence of values on steps, or meshes, each twice as fine as the one before, says of its limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extrapolation {
    /// Observed order, one or more, from the three finest values; none where neighbouring changes do not shrink so fast everywhere, with one
    /// sign.
    pub order: Option<f64>,
    /// Richardson's extrapolation; the finest value where there is no order.
    pub limit: f64,
    /// Uncertainty of the limit. With an order that four values or more agree upon, what the limits of neighbouring triples differ by, and
    /// 1.25 times what is extrapolated at least; else 1.25 times what would still change if changes fell at first order from here on, from
    /// the largest of all changes seen, each reduced at that order to the finest level. An order of all together makes it no less than that of a step, mesh or
    /// fibres that have no order alone. Over random scenes more than nine of ten limits lie
    /// within it (`limits_lie_within_their_uncertainty` in the tests).
    pub uncertainty: f64,
    /// Whether the values are the same to round-off.
    pub constant: bool,
}

impl Extrapolation {
    /// The same of steps, meshes and fibres refined together, of which the sequences alone are `parts`: where one of these has no order, that of all
    /// together may be chance, and what is left of the part is uncertain.
    pub fn with_parts(mut self, parts: [&Self; 3]) -> Self {
        for part in parts {
            let chance = self.order.is_some() && part.order.is_none() && !part.constant;
            if chance && part.uncertainty > self.uncertainty {
                self.uncertainty = part.uncertainty;
            }
        }
        self
    }
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
    let cautious = SAFETY * left_at_first_order(values);
    let triples: Option<Vec<[f64; 2]>> = values.windows(3).map(of_three).collect();
    let Some(triples) = triples else {
        return Extrapolation { uncertainty: cautious, ..none };
    };
    let [ratio, limit] = triples[triples.len() - 1];
    let uncertainty = match triples.len() {
        1 => cautious,
        more => (limit - triples[more - 2][1]).abs().max(SAFETY * (limit - finest).abs()),
    };
    Extrapolation { order: Some(ratio.log2()), limit, uncertainty, constant: false }
}

/// What is still to change beyond the finest value if changes fall by a half from level to level: as much as the last change, or as any one
/// before it would have become.
fn left_at_first_order(values: &[f64]) -> f64 {
    let changes = values.windows(2).map(|pair| (pair[1] - pair[0]).abs());
    changes.fold(0.0, |left, change| change.max(0.5 * left))
}

/// Ratio of the changes, and limit, of three values; none where they do not shrink at first order or faster.
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
    fn sequences_that_do_not_close_in_steadily_have_no_order() {
        for values in [
            [1.0, 2.0, 1.5, 1.7],
            [1.0, 1.1, 1.2, 1.3],
            [1.0, 1.4, 1.65, 1.8],
            [1.0, 1.0, 1.1, 1.1],
            [5.0, 1.0, 1.1, 1.12],
        ] {
            let found = extrapolate(&values);
            assert_eq!((found.order, found.limit), (None, values[3]));
            assert!(found.uncertainty > 0.0 && !found.constant);
        }
        assert_eq!(extrapolate(&[1.0, f64::NAN, 1.0]).order, None);
    }

    /// An early change that has not come down at first order weighs as much as a late one.
    #[test]
    fn the_largest_change_tells_what_is_left() {
        let found = extrapolate(&[1.0, 1.8, 1.79, 1.795]);
        assert!((found.uncertainty - 1.25 * 0.2).abs() < 1e-12, "{found:?}");
        let found = extrapolate(&[1.0, 1.01, 1.02, 1.22]);
        assert!((found.uncertainty - 1.25 * 0.2).abs() < 1e-12, "{found:?}");
    }

    /// Velocities on 100 to 800 elements after an impact on a shear-flexible beam, with a limit of 14.1394579: the step has an order, the mesh has none.
    #[test]
    fn an_order_together_is_no_surer_than_its_parts() {
        let step = extrapolate(&[14.128_068, 14.129_349, 14.129_657, 14.129_728]);
        let mesh = extrapolate(&[14.128_068, 14.140_903, 14.138_970, 14.139_038]);
        let together = extrapolate(&[14.128_068, 14.137_108, 14.138_578, 14.138_787]);
        assert!(together.order.is_some() && mesh.order.is_none());
        assert!((together.limit - 14.139_457_9).abs() > together.uncertainty);
        let held = together.with_parts([&step, &mesh, &step]);
        assert!((held.limit - 14.139_457_9).abs() < held.uncertainty, "{held:?}");
        assert_eq!(together.with_parts([&step; 3]), together);
        let unknown = extrapolate(&[1.0, f64::NAN, 1.0]).with_parts([&mesh; 3]);
        assert!(unknown.uncertainty.is_nan());
    }

    #[test]
    fn sequences_without_change_are_constant() {
        let found = extrapolate(&[2.0, 2.0 + 1e-13, 2.0]);
        assert!(found.constant && found.order.is_none() && found.uncertainty < 1e-12);
    }
}
