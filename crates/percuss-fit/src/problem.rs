//! A fit as a problem of least squares: residuals as a function of the free parameters.

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};

use percuss_codes::RequestCode;
use percuss_scenario::Scenario;
use percuss_scenario::fit::{Alignment, FitOptions};
use percuss_study::Workers;
use rayon::prelude::*;

use crate::align::{Origin, onset};
use crate::channel::Test;
use crate::curve::Curve;
use crate::error::Stop;
use crate::parameter::Adjustable;
use crate::run::{GoesOn, Share, columns};

/// Parameters to be found, and the tests that they are found from.
///
/// Its functions take coordinates of the free parameters (see [`Adjustable::coordinate`]), offsets of records behind them.
#[derive(Debug)]
pub struct Problem {
    pub(crate) title: String,
    pub(crate) options: FitOptions,
    /// Parameters and offsets, fixed ones included, shape (parameters).
    pub(crate) adjustables: Vec<Adjustable>,
    /// Tests, those that are held out included, shape (tests).
    pub(crate) tests: Vec<Test>,
    /// The scenario without what differs in tests.
    pub(crate) base: Scenario,
    /// Whether standard deviations follow from the residuals, since none is given.
    pub(crate) sigma_unknown: bool,
    pub(crate) workers: Workers,
    /// Runs so far.
    pub(crate) runs: AtomicU64,
    /// How the latest derivatives were found.
    pub(crate) found: Mutex<Derivation>,
}

/// How derivatives were found.
#[derive(Clone, Debug, Default)]
pub(crate) struct Derivation {
    /// In words; empty before the first ones.
    pub words: String,
    /// What holds on one side alone, in sentences, shape (sentences).
    pub one_sided: Vec<String>,
}

/// The run of a test.
#[derive(Clone, Debug)]
pub(crate) struct Computed {
    /// What was recorded, shape (recorded columns).
    pub recorded: Vec<Curve>,
    /// What is compared, shape (channels).
    pub curves: Vec<Curve>,
    /// Time of the record at which the run starts \[s\].
    pub offset: f64,
}

impl Computed {
    /// Computed values at the times of the record, shape (channels, n_sample) \[unit of the channel\].
    pub fn predicted(&self, test: &Test) -> Vec<Vec<f64>> {
        self.curves.iter().map(|curve| curve.sampled(&test.time, self.offset)).collect()
    }
}

impl Problem {
    /// Parameters and offsets, fixed ones included.
    pub fn adjustables(&self) -> &[Adjustable] {
        &self.adjustables
    }

    /// Those that are free, in the order of coordinates.
    pub fn free(&self) -> impl Iterator<Item = &Adjustable> {
        self.adjustables.iter().filter(|one| !one.fixed)
    }

    /// Their places among all, shape (free parameters) \[index\].
    pub(crate) fn free_places(&self) -> Vec<usize> {
        let all = self.adjustables.iter().enumerate();
        all.filter(|(_, one)| !one.fixed).map(|(k, _)| k).collect()
    }

    /// Coordinates of the starting values, shape (free parameters) \[-\].
    pub fn start(&self) -> Vec<f64> {
        self.free().map(|one| one.coordinate(one.start)).collect()
    }

    /// Smallest and largest coordinates, shape (free parameters, 2) \[-\].
    pub fn bounds(&self) -> Vec<[f64; 2]> {
        self.free().map(Adjustable::coordinates).collect()
    }

    /// Values of all parameters at coordinates of the free ones, shape (parameters) \[SI unit of the parameter\].
    pub fn values(&self, coordinates: &[f64]) -> Vec<f64> {
        let mut coordinates = coordinates.iter();
        let value = |one: &Adjustable| match one.fixed {
            true => one.start,
            false => coordinates.next().map_or(f64::NAN, |z| one.value(*z)),
        };
        self.adjustables.iter().map(value).collect()
    }

    /// Number of runs made so far.
    pub fn runs(&self) -> u64 {
        self.runs.load(Ordering::Relaxed)
    }

    /// How the latest derivatives were found.
    pub(crate) fn derivation(&self) -> Derivation {
        self.found.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Tests that take part in the fit, and their numbers.
    pub(crate) fn fitted_tests(&self) -> Vec<usize> {
        (0..self.tests.len()).filter(|k| !self.tests[*k].hold_out).collect()
    }

    /// The scenario of a test at some values of all parameters.
    pub(crate) fn scenario(&self, test: &Test, values: &[f64]) -> Result<Scenario, Stop> {
        let mut scenario = test.scenario.clone();
        for (k, field) in &test.fields {
            let set = scenario.set_number(field, values[*k]);
            set.map_err(|fault| Stop::Failed(percuss_scenario::in_one_line(&fault)))?;
        }
        Ok(scenario)
    }

    /// The run of a test at some values of all parameters.
    pub(crate) fn compute(
        &self,
        test: &Test,
        values: &[f64],
        share: Share,
        goes_on: GoesOn<'_>,
    ) -> Result<Computed, Stop> {
        if !goes_on() {
            return Err(Stop::Interrupted);
        }
        let scenario = self.scenario(test, values)?;
        self.runs.fetch_add(1, Ordering::Relaxed);
        let names = test.recorded();
        let recorded = columns(&scenario, share, &names, goes_on)?;
        let coarse = |error| Stop::failed(RequestCode::Acceleration, error);
        let shaped = test.channels.iter().map(|channel| {
            let place = names.iter().position(|name| *name == channel.column.recorded);
            let curve = place.map(|place| &recorded[place]);
            let empty = Curve { time: Vec::new(), values: Vec::new() };
            channel.shaped(curve.unwrap_or(&empty)).map_err(coarse)
        });
        let curves = shaped.collect::<Result<Vec<Curve>, Stop>>()?;
        let offset = offset(test, values, &curves);
        Ok(Computed { recorded, curves, offset })
    }

    /// Runs of some tests at some values, in parallel, shape (tests).
    pub(crate) fn compute_all(
        &self,
        tests: &[usize],
        values: &[f64],
        share: Share,
        goes_on: GoesOn<'_>,
    ) -> Result<Vec<Computed>, Stop> {
        let one = |k: &usize| self.compute(&self.tests[*k], values, share, goes_on);
        self.workers.install(|| tests.par_iter().map(one).collect())
    }

    /// Residuals in standard deviations: computed less measured values, test after test, channel after channel, those of hold-out tests
    /// left out; then those of what is known of parameters from elsewhere.
    pub(crate) fn residuals_of(&self, computed: &[Computed], values: &[f64]) -> Vec<f64> {
        let tests = self.fitted_tests();
        let mut all = Vec::with_capacity(self.residual_count());
        for (k, computed) in tests.iter().zip(computed) {
            let test = &self.tests[*k];
            for (channel, predicted) in test.channels.iter().zip(computed.predicted(test)) {
                let both = predicted.iter().zip(&channel.measured);
                all.extend(both.map(|(y, measured)| (y - measured) / channel.sigma));
            }
        }
        for (one, value) in self.adjustables.iter().zip(values).filter(|(one, _)| !one.fixed) {
            all.extend(one.prior.map(|[mean, deviation]| (value - mean) / deviation));
        }
        all
    }

    /// Number of residuals of measured values.
    pub(crate) fn data_count(&self) -> usize {
        self.fitted_tests().into_iter().map(|k| self.tests[k].samples()).sum()
    }

    /// Number of residuals.
    pub fn residual_count(&self) -> usize {
        self.data_count() + self.free().filter(|one| one.prior.is_some()).count()
    }

    /// Residuals at coordinates of the free parameters, in standard deviations, shape (n_residual) \[-\]. Those of measured values come
    /// first, test after test and channel after channel; then those of what is known of parameters from elsewhere.
    ///
    /// # Errors
    /// If a run fails, or the user asks to stop.
    pub fn residuals(&self, coordinates: &[f64], goes_on: GoesOn<'_>) -> Result<Vec<f64>, Stop> {
        let values = self.values(coordinates);
        let computed = self.compute_all(&self.fitted_tests(), &values, Share::Whole, goes_on)?;
        Ok(self.residuals_of(&computed, &values))
    }
}

/// Time of the record at which the run of a test starts.
fn offset(test: &Test, values: &[f64], curves: &[Curve]) -> f64 {
    match (test.fitted_offset, test.align, test.onset) {
        (Some(k), ..) => values[k],
        (None, Alignment::None, _) | (.., None) => test.offset,
        (None, _, Some(measured)) => {
            let computed = curves.first().and_then(|curve| onset(curve, Origin::Computed));
            computed.map_or(test.offset, |computed| measured - computed)
        }
    }
}
