//! What speaks against the result of a fit.

use crate::covariance::Covariance;
use crate::goodness::Goodness;
use crate::loss::Loss;
use crate::problem::Problem;
use crate::solve::Minimum;

/// Residuals so many times their standard deviation, in the mean square, are no noise of that deviation, where they are many.
const ABOVE: f64 = 1.5;
/// Standard deviations of the reduced chi-square beyond which it is not chance.
const CHANCE: f64 = 5.0;
/// Correlation above which two parameters can hardly be distinguished.
const CORRELATED: f64 = 0.95;
/// Condition number above which some combination of parameters is lost in round-off of the runs.
const CONDITION: f64 = 1e6;
/// Two minima differ where a coordinate differs by so many standard errors, and by this share of it.
const APART: f64 = 3.0;
const APART_SHARE: f64 = 1e-3;
/// Costs within this factor, or so much above the best, are similar.
const SIMILAR: f64 = 1.5;
const SIMILAR_BY: f64 = 5.0;
/// Costs within this share, or so near, belong to one minimum.
pub(crate) const SAME: f64 = 1e-3;
/// A value is at its bound within this share of the width, if that is less than a standard error, or within this share of the latter.
const AT_BOUND: f64 = 1e-3;
const AT_BOUND_ERRORS: f64 = 0.1;
/// Correlation of neighbouring residuals from which it is reported.
const AUTOCORRELATED: f64 = 0.3;

/// Reduced chi-square below which residuals say nothing about noise.
const BELOW: f64 = 0.01;

/// What kind of doubt it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DoubtKind {
    /// The iteration did not converge.
    Convergence,
    /// Residuals far above their standard deviation.
    Residuals,
    /// Parameters that the data cannot tell apart, or do not depend on.
    Correlation,
    /// Several minima of similar cost.
    Minima,
    /// A parameter at its bound.
    Bound,
    /// An error of the step as large as that of the measurement.
    Step,
    /// Correlated residuals.
    Autocorrelation,
    /// Derivatives that hold on one side alone.
    OneSided,
}

impl DoubtKind {
    /// Its word in results.
    pub fn name(self) -> &'static str {
        match self {
            Self::Convergence => "convergence",
            Self::Residuals => "residuals",
            Self::Correlation => "correlation",
            Self::Minima => "minima",
            Self::Bound => "bound",
            Self::Step => "step",
            Self::Autocorrelation => "autocorrelation",
            Self::OneSided => "one_sided",
        }
    }
}

/// Something that speaks against the result.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Doubt {
    /// What kind it is.
    pub kind: DoubtKind,
    /// What was found, and what would help.
    pub text: String,
}

/// What a fit is judged by.
pub(crate) struct Evidence<'f> {
    pub problem: &'f Problem,
    pub best: &'f Minimum,
    /// From each starting point, shape (starts).
    pub minima: &'f [Minimum],
    /// Derivatives of weighted residuals by coordinates, shape (n_residual, n_free) \[-\].
    pub jacobian: &'f [Vec<f64>],
    pub covariance: &'f Covariance,
    /// Factor on the covariance.
    pub scale: f64,
    /// Mean square of the residuals per degree of freedom, by their median where the loss is robust.
    pub spread: f64,
    pub freedom: usize,
    /// How well channels are met, shape (channels).
    pub channels: &'f [Goodness],
    /// In standard deviations, shape (n_residual) \[-\].
    pub residuals: &'f [f64],
    /// What holds on one side alone, in sentences, shape (sentences).
    pub one_sided: &'f [String],
    /// Residuals at half the step; none where that fails, shape (n_residual) \[-\].
    pub half: Option<Vec<f64>>,
}

impl Evidence<'_> {
    /// Names of the free parameters.
    fn names(&self) -> Vec<&str> {
        self.problem.free().map(|one| one.name.as_str()).collect()
    }

    /// Standard errors of the coordinates, shape (n_free) \[-\].
    fn errors(&self) -> Vec<f64> {
        let n = self.covariance.matrix.len();
        (0..n).map(|k| (self.scale * self.covariance.matrix[k][k]).sqrt()).collect()
    }
}

/// Everything that speaks against a result.
pub(crate) fn doubts(evidence: &Evidence<'_>) -> Vec<Doubt> {
    let mut all = Vec::new();
    let mut add = |kind: DoubtKind, texts: Vec<String>| {
        all.extend(texts.into_iter().map(|text| Doubt { kind, text }));
    };
    add(DoubtKind::Convergence, convergence(evidence));
    add(DoubtKind::Residuals, residuals(evidence));
    add(DoubtKind::Correlation, correlation(evidence));
    add(DoubtKind::Minima, minima(evidence));
    add(DoubtKind::Bound, bounds(evidence));
    add(DoubtKind::Step, step(evidence));
    add(DoubtKind::Autocorrelation, autocorrelation(evidence));
    add(DoubtKind::OneSided, evidence.one_sided.to_vec());
    all
}

fn convergence(e: &Evidence<'_>) -> Vec<String> {
    match e.best.success {
        true => Vec::new(),
        false => vec![format!("{}: the values are not those of a minimum", e.best.message)],
    }
}

fn residuals(e: &Evidence<'_>) -> Vec<String> {
    let chance = 1.0 + CHANCE * (2.0 / e.freedom.max(1) as f64).sqrt();
    if e.problem.sigma_unknown || e.spread <= ABOVE.max(chance) {
        return Vec::new();
    }
    let found = match Loss::of(&e.problem.options).is_robust() {
        true => "by their median".to_owned(),
        false => format!("reduced chi-square {:.3}", e.spread),
    };
    vec![format!(
        "residuals are {:.3} times their standard deviation ({found}): a wrong minimum, a model that lacks something, or \
         standard deviations that are too small; the standard errors do not hold. Try more starting points, and look at the residuals",
        e.spread.sqrt()
    )]
}

fn correlation(e: &Evidence<'_>) -> Vec<String> {
    let names = e.names();
    let mut texts = Vec::new();
    let unresolved: Vec<String> = names
        .iter()
        .zip(&e.covariance.unresolved)
        .filter(|(_, unresolved)| **unresolved)
        .map(|(name, _)| format!("`{name}`"))
        .collect();
    match &unresolved[..] {
        [] => {}
        [one] => texts.push(format!(
            "the data do not determine {one}: fix it, give a prior, or measure something that depends on it"
        )),
        all => texts.push(format!(
            "the data do not determine {}: fix all but one of them, give a prior, or measure something that depends on them",
            all.join(", ")
        )),
    }
    for i in 0..names.len() {
        for j in 0..i {
            let found = e.covariance.correlation[i][j];
            if found.abs() > CORRELATED {
                texts.push(format!(
                    "the data can hardly tell `{}` and `{}` apart (correlation {found:.3}): only a combination of them is well determined",
                    names[j], names[i]
                ));
            }
        }
    }
    if texts.is_empty() && e.covariance.condition > CONDITION {
        texts.push(format!(
            "some combination of the parameters is hardly determined (condition number {:.1e})",
            e.covariance.condition
        ));
    }
    texts
}

fn minima(e: &Evidence<'_>) -> Vec<String> {
    let errors = e.errors();
    let is_best = |one: &Minimum| {
        let both = one.coordinates.iter().zip(&e.best.coordinates).zip(&errors);
        let near = both.into_iter().all(|((a, b), error)| {
            let off = (a - b).abs();
            off <= (APART_SHARE * b.abs()).max(if error.is_finite() { APART * error } else { off })
        });
        near && one.cost <= e.best.cost * (1.0 + SAME) + SAME
    };
    let reached = e.minima.iter().filter(|one| is_best(one)).count();
    let similar = |one: &&Minimum| {
        let limit = (SIMILAR * e.best.cost).max(e.best.cost + SIMILAR_BY);
        one.success && !is_best(one) && one.cost <= limit
    };
    let mut others: Vec<&Minimum> = e.minima.iter().filter(similar).collect();
    others.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    let Some(next) = others.first() else { return Vec::new() };
    let values = e.problem.values(&next.coordinates);
    let free = e.problem.free_places();
    let all = e.problem.adjustables();
    let reported =
        free.iter().map(|k| format!("{} = {}", all[*k].name, all[*k].in_words(values[*k])));
    vec![format!(
        "{reached} of {} starting points reach the best minimum (cost {:.5}), and others of similar cost exist: {} has cost {:.5}. The data \
         do not say which it is; narrow the bounds or give a prior",
        e.minima.len(),
        e.best.cost,
        reported.collect::<Vec<_>>().join(", "),
        next.cost
    )]
}

fn bounds(e: &Evidence<'_>) -> Vec<String> {
    let errors = e.errors();
    let free = e.problem.free().zip(&e.best.coordinates).zip(&errors);
    let at = free.filter_map(|((one, z), error)| {
        let [low, high] = one.coordinates();
        let width = if (high - low).is_finite() { high - low } else { z.abs() };
        let near = match error.is_finite() {
            // Within wide bounds a share of the width may be many standard errors.
            true => (AT_BOUND * width).min(*error).max(AT_BOUND_ERRORS * error),
            false => AT_BOUND * width,
        };
        let bound = match (z - low <= near, high - z <= near) {
            (true, _) => one.bounds[0],
            (_, true) => one.bounds[1],
            _ => return None,
        };
        Some(format!(
            "`{}` is at its bound {}: its standard error does not hold; the minimum may lie beyond",
            one.name,
            one.in_words(bound)
        ))
    });
    at.collect()
}

/// What half the step changes, in standard deviations of the measurement and in standard errors of the parameters.
fn step(e: &Evidence<'_>) -> Vec<String> {
    let Some(half) = &e.half else {
        return vec![
            "the run at half the step fails, so that the error of the step is unknown".into(),
        ];
    };
    // A step of second order has four thirds of this change as its error; of first order, twice it.
    let change: Vec<f64> = half.iter().zip(e.residuals).map(|(a, b)| a - b).collect();
    let mut texts = Vec::new();
    let mut next = 0;
    let mut goodness = e.channels.iter().filter(|one| !one.hold_out);
    for k in e.problem.fitted_tests() {
        let test = &e.problem.tests[k];
        for channel in &test.channels {
            let Some(one) = goodness.next() else { break };
            let part = &change[next..next + test.time.len()];
            next += test.time.len();
            let rms = (part.iter().map(|x| x * x).sum::<f64>() / part.len() as f64).sqrt();
            let sigma = one.sigma / channel.sigma;
            if rms >= sigma {
                texts.push(format!(
                    "half the step changes `{}` of `{}` by {:.2} standard deviations of the measurement: reduce `time.step`",
                    channel.name, test.name, rms / sigma
                ));
            }
        }
    }
    let n = e.best.coordinates.len();
    let gradient: Vec<f64> = (0..n)
        .map(|j| e.jacobian.iter().zip(&change).map(|(row, x)| row[j] * x).sum::<f64>())
        .collect();
    for (i, (one, error)) in e.problem.free().zip(e.errors()).enumerate() {
        let row = &e.covariance.matrix[i];
        // What the data do not determine stays where it is.
        let known = row.iter().zip(&gradient).filter(|(c, _)| c.is_finite());
        let shift: f64 = -known.map(|(c, g)| c * g).sum::<f64>();
        if shift.abs() >= error && error.is_finite() {
            texts.push(format!(
                "half the step moves `{}` by {:.2} of its standard errors: reduce `time.step`",
                one.name,
                shift.abs() / error
            ));
        }
    }
    texts
}

fn autocorrelation(e: &Evidence<'_>) -> Vec<String> {
    // What lies far below the noise need not look like noise.
    let reported = |one: &&Goodness| {
        let seen = one.samples > 10 && one.reduced_chi_square > BELOW;
        !one.hold_out && seen && one.autocorrelation > AUTOCORRELATED
    };
    let text = |one: &Goodness| {
        format!(
            "residuals of `{}` of `{}` are correlated (neighbours by {:.2}): {} values count as {:.0} independent ones, and standard \
             errors are too small by a factor of about {:.1}",
            one.channel,
            one.test,
            one.autocorrelation,
            one.samples,
            one.effective_samples,
            (one.samples as f64 / one.effective_samples).sqrt()
        )
    };
    e.channels.iter().filter(reported).map(text).collect()
}
