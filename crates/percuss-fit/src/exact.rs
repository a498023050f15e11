//! Derivatives of the curves of a test from those of its run.
//!
//! Derivatives of recorded columns are wanted at the rows of the run. What is compared is linear in the columns, so that derivatives take
//! the same way: rate of change, filter, times of the record.

use percuss_codes::AnalysisCode;
use percuss_scenario::fit::Alignment;
use percuss_study::{
    ColumnJacobian, ColumnSample, Means, OneSided, SensitivityError, column_jacobian, in_one_line,
};

use crate::channel::Test;
use crate::curve::Curve;
use crate::error::Stop;
use crate::problem::{Computed, Problem};

/// Derivatives of the curves of a test.
pub(crate) struct RunSlopes {
    /// Places of parameters among all, and derivatives of the computed values by their values, shape (parameters, channels, n_sample)
    /// \[unit of the channel by that of the parameter\].
    pub by: Vec<(usize, Vec<Vec<f64>>)>,
    /// How they were found.
    pub means: Means,
    /// What holds on one side alone, in sentences, shape (sentences).
    pub one_sided: Vec<String>,
}

/// Why only differences of runs tell how the curves of a test change, if so.
pub(crate) fn needs_differences(test: &Test) -> Option<&'static str> {
    let by_onset = test.align == Alignment::Onset && test.fitted_offset.is_none();
    by_onset.then_some("records are aligned by their onset, which has no derivative of its own")
}

impl Problem {
    /// Derivatives of the curves of a test by the free numbers of its scenario, with `threads` threads where runs are differenced.
    ///
    /// # Errors
    /// If the run fails, or has no derivatives.
    pub(crate) fn run_slopes(
        &self,
        test: &Test,
        computed: &Computed,
        values: &[f64],
        threads: usize,
    ) -> Result<RunSlopes, Stop> {
        let scenario = self.scenario(test, values)?;
        let free: Vec<(usize, String)> = test
            .fields
            .iter()
            .filter(|(k, _)| !self.adjustables[*k].fixed)
            .map(|(k, field)| (*k, field.path().to_owned()))
            .collect();
        let paths: Vec<String> = free.iter().map(|(_, path)| path.clone()).collect();
        let names = test.recorded();
        let rows: &[f64] = computed.recorded.first().map_or(&[], |curve| &curve.time);
        let samples: Vec<ColumnSample> = names
            .iter()
            .flat_map(|name| rows.iter().map(|t| ColumnSample::at(name.clone(), *t)))
            .collect();
        let found = column_jacobian(&scenario, &paths, &samples, threads).map_err(stopped)?;
        let ColumnJacobian { derivatives, means, one_sided, .. } = found;
        let mut by: Vec<(usize, Vec<Vec<f64>>)> = Vec::new();
        for (column, (k, _)) in free.iter().enumerate() {
            let curve = |name: usize| Curve {
                time: rows.to_vec(),
                values: (0..rows.len())
                    .map(|row| derivatives[name * rows.len() + row][column])
                    .collect(),
            };
            let curves: Vec<Curve> = (0..names.len()).map(curve).collect();
            let slopes = self.sampled(test, computed, &names, &curves)?;
            // A parameter that sets several numbers changes curves by all of them.
            match by.iter_mut().find(|(other, _)| other == k) {
                Some((_, sums)) => add(sums, &slopes),
                None => by.push((*k, slopes)),
            }
        }
        let one_sided = one_sided.iter().map(OneSided::text).collect();
        Ok(RunSlopes { by, means, one_sided })
    }

    /// What becomes of changes of the recorded columns, shape (channels, n_sample).
    fn sampled(
        &self,
        test: &Test,
        computed: &Computed,
        names: &[String],
        curves: &[Curve],
    ) -> Result<Vec<Vec<f64>>, Stop> {
        let one = |channel: &crate::channel::Channel| {
            let place = names.iter().position(|name| *name == channel.column.recorded);
            let curve = &curves[place.unwrap_or(0)];
            let shaped = channel
                .shaped(curve)
                .map_err(|error| Stop::failed(AnalysisCode::NoDerivative, error))?;
            Ok(shaped.sampled(&test.time, computed.offset))
        };
        test.channels.iter().map(one).collect()
    }
}

fn add(sums: &mut [Vec<f64>], more: &[Vec<f64>]) {
    for (sum, more) in sums.iter_mut().zip(more) {
        sum.iter_mut().zip(more).for_each(|(a, b)| *a += b);
    }
}

fn stopped(error: SensitivityError) -> Stop {
    match error {
        SensitivityError::Faults(faults) => Stop::Failed(in_one_line(&faults)),
        SensitivityError::Refused(why) => Stop::failed(AnalysisCode::NoDerivative, why),
        SensitivityError::Run(code, why) => Stop::failed(code, why),
    }
}
