//! Derivatives of the numbers of a model with respect to a parameter, from models in which it is changed.
//!
//! Numbers are smooth functions of a parameter, but the scale on which they change is not that of its value: the length of an element that ends
//! where a load does is a few millimetres, whatever the coordinate of that place. Differences over large changes and small ones are compared: each
//! number has the derivative on which two of them agree best, and one without agreement is refused.

use super::numbers::Numbers;
use super::shape::{BatchShape, numbers};
use super::summary::Fixed;
use percuss::{Model, Settings};

/// Two differences agree within this share of the derivative, or of the number over the size of the parameter.
const AGREED: f64 = 1e-7;

/// A number whose best two differences disagree by more than this share has no derivative.
const KNOWN: f64 = 1e-5;

/// Round-off of numbers that follow from others, in units of the last digit of the largest of their kind.
const ROUNDED: f64 = 64.0 * f64::EPSILON;

/// Models in which a parameter is changed.
#[derive(Clone, Debug)]
pub struct Difference {
    /// The model with the parameter changed by -2, -1, 1 and 2 times `change`, shape (4).
    pub models: [Model; 4],
    /// Time at which the run ends with each of them, shape (4) \[s\]. No other setting may change with a parameter: the effect of the step on a
    /// result is its error.
    pub ends: [f64; 4],
    /// Change of the parameter.
    pub change: f64,
}

/// A parameter, given by models with its changed values.
#[derive(Clone, Debug)]
pub struct Variation {
    /// Size of the parameter: its magnitude, or of one without any the unit of its changes.
    pub size: f64,
    /// Differences, from large changes to small ones, shape (differences). Fourth-order differences give the derivatives of the numbers of a model;
    /// one alone is taken as it is.
    pub differences: Vec<Difference>,
}

impl Variation {
    /// Whether the differences agree, so that smaller changes would add nothing.
    pub fn agrees(&self, model: &Model, settings: &Settings) -> bool {
        let Ok(base) = known(model, settings) else { return true };
        let Ok(found) = self.slopes(model, settings, &base) else { return false };
        found.off < 1.0
    }

    /// Derivatives of the numbers of the model and of the end.
    pub(super) fn slopes(
        &self,
        model: &Model,
        settings: &Settings,
        base: &Numbers<f64>,
    ) -> Result<Slopes, String> {
        let shape = BatchShape::of(base);
        let mut tried = Vec::new();
        for difference in &self.differences {
            let varied = difference.models.each_ref().map(|model| known(model, settings));
            let [a, b, c, d] = varied;
            let varied = (|| Ok([a?, b?, c?, d?]))();
            let varied = varied.map_err(|why: String| format!("leads to models of which {why}"))?;
            if varied.iter().all(|numbers| BatchShape::of(numbers) == shape) {
                tried.push((difference.change, difference.slopes(&varied)));
            }
        }
        if tried.is_empty() {
            return Err("changes the mesh, not numbers alone".into());
        }
        let (own, beside) = scales(model, settings, base);
        let mut found = Slopes { numbers: Vec::new(), fixed: Vec::new(), end: 0.0, off: 0.0 };
        if tried.len() == 1 {
            found.off = f64::INFINITY;
        }
        let mut all: Vec<f64> = Vec::with_capacity(own.len());
        for k in 0..own.len() {
            let each = tried.iter().map(|(change, slopes)| (*change, slopes[k]));
            let best = Best::of(each, own[k]);
            let scale = best.slope.abs().max((own[k] / self.size).abs());
            let rounded = ROUNDED * beside[k] / best.change;
            let off = best.off / (AGREED * scale).max(rounded);
            found.off = found.off.max(if best.off > 0.0 { off } else { 0.0 });
            if best.off > (KNOWN * scale).max(rounded) {
                let percent = 100.0 * best.off / scale;
                return Err(format!(
                    "does not change the numbers of the model smoothly: their differences over \
                     ever smaller changes, down to {:.3e}, disagree by {percent:.2} %",
                    best.change
                ));
            }
            all.push(best.slope);
        }
        let rest = all.split_off(base.flat().len());
        // Unset numbers remain unset.
        found.numbers = all.into_iter().map(|x| if x.is_nan() { 0.0 } else { x }).collect();
        let (end, fixed) = rest.split_last().unwrap_or((&0.0, &[]));
        found.end = *end;
        found.fixed =
            fixed.chunks_exact(3).map(|own| Fixed::from([own[0], own[1], own[2]])).collect();
        Ok(found)
    }
}

/// Derivatives of the input with respect to a parameter.
pub struct Slopes {
    /// Numbers of the model, in the order of [`Numbers::flat`], shape (numbers) \[unit of the number by that of the parameter\].
    pub numbers: Vec<f64>,
    /// End of the run.
    pub end: f64,
    /// Results that depend only on the model, shape (guided projectiles).
    pub fixed: Vec<Fixed>,
    /// Largest disagreement, relative to the one that is allowed.
    off: f64,
}

/// Derivatives with respect to every parameter, shape (parameters).
///
/// # Errors
/// The parameter that has none, and why.
pub fn slopes(
    model: &Model,
    settings: &Settings,
    base: &Numbers<f64>,
    variations: &[Variation],
) -> Result<Vec<Slopes>, String> {
    let of = |(i, variation): (usize, &Variation)| {
        let found = variation.slopes(model, settings, base);
        found.map_err(|why| format!("parameter {} {why}", i + 1))
    };
    variations.iter().enumerate().map(of).collect()
}

/// The numbers of a model, or the reason why they have no derivatives.
pub fn known(model: &Model, settings: &Settings) -> Result<Numbers<f64>, String> {
    if model.loads.iter().any(|load| !load.is_steady()) {
        let why = "derivatives are not available for loads that change in time".to_owned();
        return Err(why);
    }
    numbers(model, settings).map_err(|what| format!("derivatives are not available for {what}"))
}

impl Difference {
    /// Fourth-order differences of all numbers, those of the model, those of [`Fixed`] and the end.
    fn slopes(&self, varied: &[Numbers<f64>; 4]) -> Vec<f64> {
        let flat = varied.each_ref().map(Numbers::flat);
        let difference = |x: [f64; 4]| {
            let [far_below, below, above, far_above] = x;
            (8.0 * (above - below) - (far_above - far_below)) / (12.0 * self.change)
        };
        let numbers = (0..flat[0].len()).map(|k| difference(flat.each_ref().map(|x| x[k])));
        let fixed = self.models.each_ref().map(fixed);
        let fixed = (0..fixed[0].len()).map(|k| difference(fixed.each_ref().map(|x| x[k])));
        numbers.chain(fixed).chain([difference(self.ends)]).collect()
    }
}

/// Results that depend only on the model.
fn fixed(model: &Model) -> Vec<f64> {
    Fixed::all(model).iter().flat_map(Fixed::numbers).collect()
}

/// All numbers, and the largest of each one's kind, as round-off may be in proportion to it.
fn scales(model: &Model, settings: &Settings, base: &Numbers<f64>) -> (Vec<f64>, Vec<f64>) {
    let (mut own, mut beside) = (base.flat(), base.largest_of_their_kind());
    for x in fixed(model).into_iter().chain([settings.end]) {
        own.push(x);
        beside.push(if x.is_finite() { x.abs() } else { 0.0 });
    }
    (own, beside)
}

/// The derivative of a number on which two differences agree best.
struct Best {
    slope: f64,
    /// Change of the parameter in the closer of them.
    change: f64,
    /// By how much they disagree.
    off: f64,
}

impl Best {
    /// From the changes and the differences, from large changes to small ones, and the number.
    fn of(each: impl Iterator<Item = (f64, f64)>, number: f64) -> Self {
        let mut best = Self { slope: f64::NAN, change: f64::NAN, off: f64::INFINITY };
        let mut before: Option<f64> = None;
        for (change, slope) in each {
            let Some(last) = before.replace(slope) else {
                best = Self { slope, change, off: f64::INFINITY };
                continue;
            };
            // Unset numbers have no derivatives.
            let off = if slope.is_nan() || last.is_nan() { 0.0 } else { (slope - last).abs() };
            if off < best.off {
                // Below its own round-off the closer one is not the better one.
                let rounded = ROUNDED * (number / change).abs();
                best = Self { slope: if off > rounded { slope } else { last }, change, off };
            }
        }
        if best.off.is_infinite() {
            best.off = 0.0;
        }
        best
    }
}
