//! The result of a fit: parameters with their uncertainty, and what it is worth.

use percuss_codes::AnalysisCode;

use crate::channel::Test;
use crate::covariance::{Covariance, covariance};
use crate::doubts::{Doubt, DoubtKind, Evidence, doubts};
use crate::error::{FitError, Stop};
use crate::goodness::{Goodness, goodness};
use crate::least_costs::Profile;
use crate::loss::Loss;
use crate::problem::{Computed, Problem};
use crate::run::{GoesOn, Share};
use crate::solve::Minimum;
use crate::spread::spread;

/// Share of a normal distribution within so many standard deviations: 95 %.
const NINETY_FIVE: f64 = 1.959_963_984_540_054;

/// A parameter as it was found.
#[derive(Clone, Debug, PartialEq)]
pub struct FittedParameter {
    /// Its name.
    pub name: String,
    /// SI unit, `1` for a pure number.
    pub unit: String,
    /// Paths in the scenario; none for the offset of a record, shape (paths).
    pub paths: Vec<String>,
    /// Value.
    pub value: f64,
    /// Standard error: the standard deviation of the value, to first order; zero if it is fixed, infinite where the data do not determine it.
    pub stderr: f64,
    /// Interval that contains the true value with a probability of 95 %, to first order, shape (2) \[unit of the parameter\].
    pub interval: [f64; 2],
    /// Starting value.
    pub start: f64,
    /// Smallest and largest value, infinite where there is none, shape (2) \[unit of the parameter\].
    pub bounds: [f64; 2],
    /// Whether it kept its starting value.
    pub fixed: bool,
}

/// Measured and computed curve of a channel.
#[derive(Clone, Debug, PartialEq)]
pub struct Overlay {
    /// Name of its test.
    pub test: String,
    /// Name of the channel.
    pub channel: String,
    /// Column of the history.
    pub column: String,
    /// SI unit.
    pub unit: String,
    /// Times of the record, shape (n_sample) \[s\].
    pub time: Vec<f64>,
    /// Measured values, filtered, shape (n_sample) \[unit of the channel\].
    pub measured: Vec<f64>,
    /// Computed values, shape (n_sample) \[unit of the channel\].
    pub computed: Vec<f64>,
    /// Time of the record at which the run starts \[s\].
    pub offset: f64,
}

/// Parameters found from measured curves.
#[derive(Clone, Debug)]
pub struct Fit {
    /// One line about the fit; empty if it has none.
    pub title: String,
    /// Parameters, fixed ones and offsets of records included, shape (parameters).
    pub parameters: Vec<FittedParameter>,
    /// Places of the free ones among them, shape (n_free) \[index\].
    pub free: Vec<usize>,
    /// Covariance of the free parameters, shape (n_free, n_free) \[product of both units\].
    pub covariance: Vec<Vec<f64>>,
    /// Coefficients of correlation of the free parameters, shape (n_free, n_free) \[-\].
    pub correlation: Vec<Vec<f64>>,
    /// Condition number of the Jacobian with columns of length one.
    pub condition: f64,
    /// Derivatives of the residuals by the values of the free parameters, rows weighted by the loss, shape (n_residual, n_free)
    /// \[1/unit of the parameter\].
    pub jacobian: Vec<Vec<f64>>,
    /// How derivatives were found, in words.
    pub derivatives: String,
    /// Residuals in standard deviations, shape (n_residual) \[-\].
    pub residuals: Vec<f64>,
    /// Half the sum of the losses of the residuals.
    pub cost: f64,
    /// Degrees of freedom.
    pub freedom: usize,
    /// Mean square of the residuals of all channels, per degree of freedom.
    pub reduced_chi_square: f64,
    /// Whether standard deviations of the channels follow from the residuals.
    pub sigma_unknown: bool,
    /// Factor on the covariance that follows from the residuals, 1 where standard deviations are given.
    pub scale: f64,
    /// Whether the iteration converged.
    pub success: bool,
    /// Why it ended, in words.
    pub message: String,
    /// Evaluations of the residuals, from all starting points.
    pub evaluations: u64,
    /// Runs, those for difference quotients and for the diagnosis included.
    pub runs: u64,
    /// How well channels are met, hold-out tests included, shape (channels).
    pub channels: Vec<Goodness>,
    /// Measured and computed curves, shape (channels).
    pub overlays: Vec<Overlay>,
    /// What was found from each starting point, shape (starts).
    pub minima: Vec<Minimum>,
    /// Values of all parameters at each of them, shape (starts, parameters) \[SI unit of the parameter\].
    pub reached: Vec<Vec<f64>>,
    /// What speaks against the result, shape (doubts).
    pub doubts: Vec<Doubt>,
    /// Profiles of parameters, as far as they were asked for, shape (profiles).
    pub profiles: Vec<Profile>,
    /// Scenarios with the values found: file name and text, shape (scenarios).
    pub scenarios: Vec<(String, String)>,
}

impl Fit {
    /// Adds a profile, and a warning where it leads to a lower cost.
    pub fn add(&mut self, profile: Profile) {
        let lower = profile.lower_minimum(self.cost);
        self.doubts.extend(lower.map(|text| Doubt { kind: DoubtKind::Minima, text }));
        self.profiles.push(profile);
    }
}

impl Problem {
    /// What minima are worth: the best of them with its uncertainty, how well it meets the measured curves, and what speaks against it.
    /// Costs the runs of a Jacobian, one of each hold-out test, and one of each test at half the step.
    ///
    /// # Errors
    /// If there is no minimum with runs, or the user asks to stop.
    pub fn diagnose(&self, minima: Vec<Minimum>, goes_on: GoesOn<'_>) -> Result<Fit, FitError> {
        let finite = minima.iter().filter(|one| one.cost.is_finite());
        let best = finite.min_by(|a, b| a.cost.total_cmp(&b.cost)).cloned();
        let Some(best) = best else {
            let why = minima.first().map_or("no starting point", |one| one.message.as_str());
            return Err(FitError::Run(AnalysisCode::NoFit, why.into()));
        };
        let values = self.values(&best.coordinates);
        let every: Vec<usize> = (0..self.tests.len()).collect();
        let computed = self.compute_all(&every, &values, Share::Whole, goes_on)?;
        let fitted: Vec<Computed> =
            self.fitted_tests().into_iter().map(|k| computed[k].clone()).collect();
        let residuals = self.residuals_of(&fitted, &values);
        let loss = Loss::of(&self.options);
        let mut jacobian = self.jacobian_of(&fitted, &best.coordinates, goes_on)?;
        for (row, residual) in jacobian.iter_mut().zip(&residuals) {
            let weight = loss.weight(*residual);
            row.iter_mut().for_each(|x| *x *= weight);
        }
        let derivation = self.derivation();
        let n = best.coordinates.len();
        let found = covariance(&jacobian, n);
        let freedom = residuals.len().saturating_sub(n);
        let squares: f64 = residuals.iter().map(|r| r * r).sum();
        let reduced = squares / freedom.max(1) as f64;
        let spread = spread(&residuals, freedom, &loss);
        let scale = if self.sigma_unknown { spread } else { 1.0 };
        let channels = self.channels(&computed, scale, freedom);
        let half = match self.compute_all(&self.fitted_tests(), &values, Share::Half, goes_on) {
            Ok(half) => Some(self.residuals_of(&half, &values)),
            Err(Stop::Failed(_)) => None,
            Err(Stop::Interrupted) => return Err(FitError::Interrupted),
        };
        let evidence = Evidence {
            problem: self,
            best: &best,
            minima: &minima,
            jacobian: &jacobian,
            covariance: &found,
            scale,
            spread,
            freedom,
            channels: &channels,
            residuals: &residuals,
            one_sided: &derivation.one_sided,
            half,
        };
        let doubts = doubts(&evidence);
        let places = self.free_places();
        let rates: Vec<f64> =
            places.iter().map(|k| self.adjustables[*k].rate(values[*k])).collect();
        for row in &mut jacobian {
            row.iter_mut().zip(&rates).for_each(|(x, rate)| *x /= rate);
        }
        let entry = |i: usize, j: usize| scale * found.matrix[i][j] * rates[i] * rates[j];
        Ok(Fit {
            title: self.title.clone(),
            parameters: self.fitted(&best, &values, &found, scale),
            free: places,
            covariance: (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect(),
            correlation: found.correlation,
            condition: found.condition,
            jacobian,
            derivatives: derivation.words,
            residuals,
            cost: best.cost,
            freedom,
            reduced_chi_square: reduced,
            sigma_unknown: self.sigma_unknown,
            scale,
            success: best.success,
            message: best.message,
            evaluations: minima.iter().map(|one| one.evaluations).sum(),
            runs: self.runs(),
            channels,
            overlays: self.overlays(&computed),
            reached: minima.iter().map(|one| self.values(&one.coordinates)).collect(),
            minima,
            doubts,
            profiles: Vec::new(),
            scenarios: self.scenarios(&values)?,
        })
    }

    fn fitted(
        &self,
        best: &Minimum,
        values: &[f64],
        found: &Covariance,
        scale: f64,
    ) -> Vec<FittedParameter> {
        let mut column = 0..best.coordinates.len();
        let one = |(one, value): (&crate::parameter::Adjustable, &f64)| {
            let place = if one.fixed { None } else { column.next() };
            let deviation = place.map_or(0.0, |k| (scale * found.matrix[k][k]).sqrt());
            let z = one.coordinate(*value);
            let end = |sign: f64| match one.logarithmic {
                true => value * (sign * NINETY_FIVE * deviation).exp(),
                false => value + sign * NINETY_FIVE * deviation * one.rate(*value),
            };
            debug_assert!(z.is_finite() || one.fixed);
            FittedParameter {
                name: one.name.clone(),
                unit: one.unit.clone(),
                paths: one.paths.clone(),
                value: *value,
                stderr: deviation * one.rate(*value),
                interval: [end(-1.0), end(1.0)],
                start: one.start,
                bounds: one.bounds,
                fixed: one.fixed,
            }
        };
        self.adjustables.iter().zip(values).map(one).collect()
    }

    fn channels(&self, computed: &[Computed], scale: f64, freedom: usize) -> Vec<Goodness> {
        let data = self.residual_count().max(1) as f64;
        let mut all = Vec::new();
        for (test, computed) in self.tests.iter().zip(computed) {
            // Parameters were chosen for the tests of the fit, and not for those kept out.
            let share = if test.hold_out { 1.0 } else { freedom.max(1) as f64 / data };
            for (channel, predicted) in test.channels.iter().zip(computed.predicted(test)) {
                let of = (test.name.as_str(), test.hold_out);
                let sigma = scale.sqrt() * channel.sigma;
                all.push(goodness(of, channel, &predicted, sigma, share));
            }
        }
        all
    }

    fn overlays(&self, computed: &[Computed]) -> Vec<Overlay> {
        let mut all = Vec::new();
        for (test, computed) in self.tests.iter().zip(computed) {
            for (channel, predicted) in test.channels.iter().zip(computed.predicted(test)) {
                all.push(Overlay {
                    test: test.name.clone(),
                    channel: channel.name.clone(),
                    column: channel.column_name.clone(),
                    unit: channel.unit.clone(),
                    time: test.time.clone(),
                    measured: channel.measured.clone(),
                    computed: predicted,
                    offset: computed.offset,
                });
            }
        }
        all
    }

    /// The scenario with the values found, and that of each test that differs from it.
    fn scenarios(&self, values: &[f64]) -> Result<Vec<(String, String)>, FitError> {
        let mut base = self.base.clone();
        for (k, (one, value)) in self.adjustables.iter().zip(values).enumerate() {
            // The value of a parameter of some tests is in the scenarios of these.
            let acts = |test: &Test| test.fields.iter().any(|(number, _)| *number == k);
            for path in &one.paths {
                let elsewhere = |test: &Test| !acts(test) && test.scenario.field(path).is_ok();
                if self.tests.iter().any(elsewhere) {
                    continue;
                }
                // What the base does not have is a number of a test.
                if let Ok(field) = base.field(path) {
                    let _ = base.set_number(&field, *value);
                }
            }
        }
        let own = base.to_toml();
        let mut all = vec![("fitted.toml".to_owned(), own.clone())];
        for test in &self.tests {
            let text = self.scenario(test, values)?.to_toml();
            if text != own {
                all.push((format!("fitted-{}.toml", test.name), text));
            }
        }
        Ok(all)
    }
}
