//! Derivatives of a run's results with respect to its parameters: forward differentiation of every operation of the run.
//!
//! The numbers of the frozen model enter with their derivatives; these follow through each step by the linearised step
//! itself. Where an impact is located, the instant moves with the parameters, too: it is a number with derivatives like any
//! other, which gives the jump of the derivatives across the impact (the saltation).

use percuss_codes::AnalysisCode;

use super::column::{ColumnSample, Found, FoundSamples, simulate_found};
use super::derivative_run::{DerivativeRun, Derived, TOGETHER};
use super::grazing::Grazing;
use super::horizon::{Horizon, agreeing, align, withdraw, withdraw_plastic};
use super::numbers::Numbers;
use super::slopes::{Slopes, Variation, known, slopes};
use super::summary::{Fixed, Reading, SummaryInput};
use percuss::Model;
use percuss::Settings;
use percuss::internals::scalar::Dual;
use percuss::{RunSummary, Termination};

/// Why a run has no derivatives.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Undifferentiated {
    /// A property of model, settings or parameters, or an event in the run, is not differentiable.
    Refused(String),
    /// The run itself fails: code and reason.
    Failed(AnalysisCode, String),
}

impl Undifferentiated {
    /// Its code in the catalogue.
    pub fn code(&self) -> AnalysisCode {
        match self {
            Self::Refused(_) => AnalysisCode::NoDerivative,
            Self::Failed(code, _) => *code,
        }
    }
}

impl std::fmt::Display for Undifferentiated {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Refused(why) | Self::Failed(_, why) => f.write_str(why),
        }
    }
}

impl std::error::Error for Undifferentiated {}

impl From<String> for Undifferentiated {
    fn from(why: String) -> Self {
        Self::Refused(why)
    }
}

/// A run and its derivatives.
#[derive(Debug)]
pub struct Sensitivities {
    /// The run.
    pub summary: RunSummary,
    /// For every parameter, a summary whose numbers are the derivatives of those of `summary`, shape (parameters). They are NaN for section forces
    /// and reactions, measures of error, times of peaks that steps do not resolve, and results later than `horizon`. Counts are those of the run.
    pub derivatives: Vec<RunSummary>,
    /// Time up to which derivatives are valid, if it is before the end of the run.
    pub horizon: Option<Horizon>,
    /// Contacts of the run and near misses, each with the changes of the parameters at which it vanishes or appears,
    /// shape (such contacts).
    pub grazing: Vec<Grazing>,
    /// Numbers taken from columns of the history, and their derivatives.
    pub columns: SampleDerivatives,
    /// Factorisations of the tangent for the derivatives: one a step, and a few of its iterations, for every three parameters.
    pub factorizations: usize,
}

/// Numbers taken from columns of the history, and their derivatives.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SampleDerivatives {
    /// The numbers, shape (samples) \[unit of the column\]; NaN where the run has none.
    pub values: Vec<f64>,
    /// Derivatives, shape (parameters, samples) \[unit of the column by that of the parameter\]; NaN where they are not known: of section forces,
    /// reactions and errors, and later than the horizon.
    pub derivatives: Vec<Vec<f64>>,
}

/// Runs a model and differentiates its results.
///
/// # Errors
/// The reason in words: a part of the model or of the settings that ensembles do not support, a parameter that changes more than numbers, a run
/// that fails.
pub fn sensitivities(
    model: &Model,
    settings: &Settings,
    variations: &[Variation],
) -> Result<Sensitivities, Undifferentiated> {
    sensitivities_with_columns(model, settings, variations, &[])
}

/// The same with numbers taken from columns of the history.
///
/// # Errors
/// As [`sensitivities`]; if a column does not exist the run fails.
pub fn sensitivities_with_columns(
    model: &Model,
    settings: &Settings,
    variations: &[Variation],
    samples: &[ColumnSample],
) -> Result<Sensitivities, Undifferentiated> {
    if let Some(fault) = settings.validate(model).first() {
        return Err(fault.to_string().into());
    }
    let base = known(model, settings)?;
    let parameters = slopes(model, settings, &base, variations)?;
    let (summary, taken) = match simulate_found(model, settings, samples) {
        Ok(both) => both,
        Err(faults) => return Err(faults[0].to_string().into()),
    };
    if let Termination::Failed(error) = &summary.termination {
        return Err(Undifferentiated::Failed(error.code(), error.to_string()));
    }
    let value = |one: &Option<Found<f64>>| one.map_or(f64::NAN, |one| one.value);
    let values = taken.iter().map(value).collect();
    let case = Case { model, settings, base, fixed: Fixed::all(model), samples, taken };
    let mut found = Sensitivities {
        summary,
        derivatives: Vec::new(),
        horizon: None,
        grazing: Vec::new(),
        columns: SampleDerivatives { values, derivatives: Vec::new() },
        factorizations: 0,
    };
    let none: &[Slopes] = &[];
    // Without parameters the grazing contacts are still found.
    let chunks: Vec<_> =
        if parameters.is_empty() { vec![none] } else { parameters.chunks(TOGETHER).collect() };
    for chunk in chunks {
        case.differentiate(chunk, &mut found);
    }
    Ok(found)
}

/// The differentiated run.
struct Case<'a> {
    model: &'a Model,
    settings: &'a Settings,
    base: Numbers<f64>,
    /// Results that depend only on the model, shape (guided projectiles).
    fixed: Vec<Fixed>,
    /// Numbers taken from columns of the history, shape (samples).
    samples: &'a [ColumnSample],
    /// Those of the run, shape (samples) \[s, unit of the column\].
    taken: FoundSamples,
}

/// Extremes of a column belong to the same row if their times differ by less than this share of a step.
const SAME_ROW: f64 = 1e-3;

impl Case<'_> {
    /// Adds the derivatives with respect to up to [`TOGETHER`] parameters.
    fn differentiate(&self, parameters: &[Slopes], found: &mut Sensitivities) {
        let derived = |value: f64, of: &dyn Fn(&Slopes) -> f64| {
            let mut slope = [0.0; TOGETHER + 1];
            parameters.iter().zip(&mut slope).for_each(|(from, to)| *to = of(from));
            Dual { value, slope }
        };
        let numbers = self.base.flat().into_iter().enumerate();
        let numbers: Vec<Derived> = numbers.map(|(i, x)| derived(x, &|p| p.numbers[i])).collect();
        let end = derived(self.settings.end, &|p| p.end);
        let numbers = self.base.with(&numbers);
        let mut run = DerivativeRun::new((self.model, self.settings), numbers, end, self.samples);
        let reached = run.run().err();
        let input = SummaryInput {
            model: self.model,
            engine: &run.engine,
            ledger: &run.ledger,
            log: &run.log,
            search: &run.search,
            lane: 0,
            steps: self.settings.step_count(),
            accumulated_steps: run.progress.accumulated_steps,
            solver_steps: run.progress.solver_steps,
            rows: found.summary.rows,
            rigid: &|k, reading| {
                let s = reading.fixed[k].s;
                run.rigid_logs[k].record(s, reading.read, reading.derivative)
            },
            residual: 0.0,
        };
        let read = |x: Derived| x.value;
        let reading = Reading { read: &read, fixed: &self.fixed, derivative: false };
        let own = input.summary(Termination::Completed, &reading);
        let horizon = agreeing(&own, &found.summary, self.settings.step, reached);
        for (j, parameter) in parameters.iter().enumerate() {
            let read = |x: Derived| x.slope[j];
            let reading = Reading { read: &read, fixed: &parameter.fixed, derivative: true };
            let mut derivative = input.summary(Termination::Completed, &reading);
            align(&mut derivative, &found.summary, &own, self.settings.step);
            if let Some(horizon) = &horizon {
                withdraw(&mut derivative, &found.summary, &own, horizon.time, self.settings.step);
            }
            derivative.plastic = run.plastic(self.model, &read, &found.summary.plastic);
            if horizon.is_some() {
                derivative.plastic.iter_mut().for_each(withdraw_plastic);
            }
            found.derivatives.push(derivative);
            let until = horizon.as_ref().map_or(f64::INFINITY, |horizon| horizon.time);
            found.columns.derivatives.push(self.columns(&run, until, &read));
        }
        found.factorizations += own.factorizations;
        let grazing = run.grazing(parameters.len());
        if found.grazing.is_empty() {
            found.grazing = grazing;
        } else {
            for (all, more) in found.grazing.iter_mut().zip(grazing) {
                all.changes.extend(more.changes);
            }
        }
        found.horizon = horizon;
    }
    /// Derivatives of the samples up to a time, shape (samples) \[unit of the column by that of the parameter\].
    fn columns(
        &self,
        run: &DerivativeRun<'_>,
        until: f64,
        read: &dyn Fn(Derived) -> f64,
    ) -> Vec<f64> {
        let same = |a: f64, b: f64| (a - b).abs() <= SAME_ROW * self.settings.step;
        let both = run.samples().zip(&self.taken);
        let derivative = both.map(|(own, run)| {
            let (own, run) = (own?, (*run)?);
            (run.time < until && same(own.time, run.time)).then(|| read(own.value))
        });
        derivative.map(|one| one.unwrap_or(f64::NAN)).collect()
    }
}
