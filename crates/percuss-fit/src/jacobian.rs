//! Derivatives of the residuals with respect to the free parameters.

use std::sync::PoisonError;

use percuss_codes::AnalysisCode;
use percuss_scenario::fit::FitJacobian;
use percuss_study::Means;
use rayon::prelude::*;

use crate::error::Stop;
use crate::exact::{RunSlopes, needs_differences};
use crate::parameter::Adjustable;
use crate::problem::{Computed, Derivation, Problem};
use crate::run::{GoesOn, Share};

/// Change of a coordinate to either side. Rounding and tolerances of a run are 1e-9 of a curve and less, so that both errors of the
/// central difference lie near 1e-6.
const CHANGE: f64 = 1e-4;

/// Derivatives of the curves of a test with respect to one parameter.
struct Slope {
    /// Its parameter among the free ones, and its test among the fitted ones, shape (2) \[index of a parameter, index of a test\].
    place: [usize; 2],
    /// Derivatives of the computed values by the coordinate, shape (channels, n_sample) \[unit of the channel\].
    values: Vec<Vec<f64>>,
}

/// Derivatives from runs.
#[derive(Default)]
struct RunDerivatives {
    /// Of curves, shape (parameters of tests).
    slopes: Vec<Slope>,
    /// How they were found, shape (tests).
    means: Vec<Means>,
    /// Tests without, and why, shape (tests) \[index of a test\].
    without: Vec<(usize, String)>,
    /// What is valid on one side alone, in sentences, shape (sentences).
    one_sided: Vec<String>,
}

impl RunDerivatives {
    /// Why there are differences, each reason once.
    fn reasons(&self) -> Vec<String> {
        let differences = self.means.iter().filter_map(|means| match means {
            Means::Exact => None,
            Means::Differences { why } => Some(why),
        });
        let mut all: Vec<String> = Vec::new();
        for why in self.without.iter().map(|(_, why)| why).chain(differences) {
            if !all.contains(why) {
                all.push(why.clone());
            }
        }
        all
    }
}

impl Problem {
    /// Derivatives of the residuals by the coordinates, shape (n_residual, free parameters) \[-\].
    ///
    /// # Errors
    /// If runs fail, or the user asks to stop.
    pub fn jacobian(
        &self,
        coordinates: &[f64],
        goes_on: GoesOn<'_>,
    ) -> Result<Vec<Vec<f64>>, Stop> {
        let values = self.values(coordinates);
        let computed = self.compute_all(&self.fitted_tests(), &values, Share::Whole, goes_on)?;
        self.jacobian_of(&computed, coordinates, goes_on)
    }

    /// The same, where the runs at the point are known.
    pub(crate) fn jacobian_of(
        &self,
        computed: &[Computed],
        coordinates: &[f64],
        goes_on: GoesOn<'_>,
    ) -> Result<Vec<Vec<f64>>, Stop> {
        let values = self.values(coordinates);
        let slopes = self.slopes(computed, coordinates, goes_on)?;
        let mut rows = vec![vec![0.0; coordinates.len()]; self.residual_count()];
        let tests = self.fitted_tests();
        let starts = tests.iter().scan(0, |next, k| {
            let start = *next;
            *next += self.tests[*k].samples();
            Some(start)
        });
        let starts: Vec<usize> = starts.collect();
        for Slope { place: [column, test], values } in slopes {
            let channels = &self.tests[tests[test]].channels;
            let scaled = channels
                .iter()
                .zip(&values)
                .flat_map(|(channel, values)| values.iter().map(|value| value / channel.sigma));
            for (row, value) in rows[starts[test]..].iter_mut().zip(scaled) {
                row[column] = value;
            }
        }
        let known = self.free_places().into_iter().enumerate();
        let known = known.filter_map(|(column, k)| Some((column, k, self.adjustables[k].prior?)));
        for (row, (column, k, [_, deviation])) in rows[self.data_count()..].iter_mut().zip(known) {
            row[column] = self.adjustables[k].rate(values[k]) / deviation;
        }
        Ok(rows)
    }

    /// Derivatives of all curves; how they were found is noted.
    fn slopes(
        &self,
        computed: &[Computed],
        coordinates: &[f64],
        goes_on: GoesOn<'_>,
    ) -> Result<Vec<Slope>, Stop> {
        let values = self.values(coordinates);
        let tests = self.fitted_tests();
        let wanted = self.options.jacobian;
        let mut found = RunDerivatives::default();
        for (place, k) in tests.iter().enumerate() {
            let why = match wanted {
                FitJacobian::Differences => Some("requested"),
                _ => needs_differences(&self.tests[*k]),
            };
            found.without.extend(why.map(|why| (place, why.to_owned())));
        }
        self.run_derivatives(&mut found, computed, &values, goes_on)?;
        if let (FitJacobian::Exact, Some(why)) = (wanted, found.reasons().first()) {
            return Err(Stop::failed(AnalysisCode::NoDerivative, why));
        }
        let words = match (&found.reasons()[..], wanted) {
            ([], _) => "exact".to_owned(),
            (_, FitJacobian::Differences) => "central differences of runs".to_owned(),
            (reasons, _) => format!("central differences of runs ({})", reasons.join("; ")),
        };
        let RunDerivatives { mut slopes, without, one_sided, .. } = found;
        *self.found.lock().unwrap_or_else(PoisonError::into_inner) =
            Derivation { words, one_sided };
        let places: Vec<usize> = without.into_iter().map(|(place, _)| place).collect();
        slopes.extend(self.difference_slopes(computed, coordinates, &places, goes_on)?);
        slopes.extend(self.offset_slopes(computed, &values));
        Ok(slopes)
    }

    /// Derivatives of the curves of those tests that need no differences, from their runs. Where a run has none after all, and differences
    /// are allowed, they are to be differences.
    fn run_derivatives(
        &self,
        found: &mut RunDerivatives,
        computed: &[Computed],
        values: &[f64],
        goes_on: GoesOn<'_>,
    ) -> Result<(), Stop> {
        let tests = self.fitted_tests();
        let free = self.free_places();
        // Differences that a run needs after all use the threads that other tests leave.
        let threads = if tests.len() == 1 { self.workers.count() } else { 1 };
        let varies = |place: &usize| {
            let fields = &self.tests[tests[*place]].fields;
            let known = !found.without.iter().any(|(other, _)| other == place);
            known && fields.iter().any(|(k, _)| !self.adjustables[*k].fixed)
        };
        let places: Vec<usize> = (0..tests.len()).filter(varies).collect();
        let one = |place: &usize| {
            if !goes_on() {
                return Err(Stop::Interrupted);
            }
            let test = &self.tests[tests[*place]];
            self.run_slopes(test, &computed[*place], values, threads)
        };
        let all: Vec<Result<RunSlopes, Stop>> =
            self.workers.install(|| places.par_iter().map(one).collect());
        for (place, one) in places.into_iter().zip(all) {
            let RunSlopes { by, means, one_sided } = match one {
                Ok(one) => one,
                Err(Stop::Failed(why)) if self.options.jacobian == FitJacobian::Auto => {
                    found.without.push((place, why));
                    continue;
                }
                Err(stop) => return Err(stop),
            };
            for (k, mut values_by) in by {
                let rate = self.adjustables[k].rate(values[k]);
                values_by.iter_mut().flatten().for_each(|x| *x *= rate);
                let column = free.iter().position(|one| *one == k);
                let slope =
                    column.map(|column| Slope { place: [column, place], values: values_by });
                found.slopes.extend(slope);
            }
            found.means.push(means);
            found.one_sided.extend(one_sided);
        }
        Ok(())
    }

    /// Derivatives by offsets: a later start moves a curve to the right.
    fn offset_slopes(&self, computed: &[Computed], values: &[f64]) -> Vec<Slope> {
        let tests = self.fitted_tests();
        let mut slopes = Vec::new();
        for (column, k) in self.free_places().into_iter().enumerate() {
            let of = |test: &usize| self.tests[*test].fitted_offset == Some(k);
            let Some(place) = tests.iter().position(of) else { continue };
            let (test, computed) = (&self.tests[tests[place]], &computed[place]);
            let rate = self.adjustables[k].rate(values[k]);
            let slope = |curve: &crate::curve::Curve| {
                let times = test.time.iter().map(|t| t - computed.offset);
                times.map(|t| -rate * curve.rate(t)).collect()
            };
            let values = computed.curves.iter().map(slope).collect();
            slopes.push(Slope { place: [column, place], values });
        }
        slopes
    }

    /// Derivatives of the curves of some tests by numbers of the scenario: central differences of runs, all of them in parallel.
    fn difference_slopes(
        &self,
        computed: &[Computed],
        coordinates: &[f64],
        differenced: &[usize],
        goes_on: GoesOn<'_>,
    ) -> Result<Vec<Slope>, Stop> {
        let tests = self.fitted_tests();
        let mut tasks = Vec::new();
        for (column, k) in self.free_places().into_iter().enumerate() {
            for place in differenced.iter().copied() {
                let test = &tests[place];
                if self.tests[*test].fields.iter().any(|(number, _)| *number == k) {
                    let [low, high] = ends(&self.adjustables[k], coordinates[column]);
                    tasks.push((column, place, low));
                    tasks.push((column, place, high));
                }
            }
        }
        let run = |(column, place, end): &(usize, usize, f64)| {
            let mut moved = coordinates.to_vec();
            moved[*column] = *end;
            let test = &self.tests[tests[*place]];
            let found = self.compute(test, &self.values(&moved), Share::Whole, goes_on);
            found.map(|found| found.predicted(test))
        };
        let found: Vec<Result<Vec<Vec<f64>>, Stop>> =
            self.workers.install(|| tasks.par_iter().map(run).collect());
        let mut slopes = Vec::new();
        for (task, found) in tasks.chunks_exact(2).zip(found.chunks_exact(2)) {
            let (column, place, low) = task[0];
            let middle = || computed[place].predicted(&self.tests[tests[place]]);
            let z = coordinates[column];
            let ((from, lower), (to, upper)) = match (&found[0], &found[1]) {
                (Err(Stop::Interrupted), _) | (_, Err(Stop::Interrupted)) => {
                    return Err(Stop::Interrupted);
                }
                (Ok(lower), Ok(upper)) => ((low, lower.clone()), (task[1].2, upper.clone())),
                // At the edge of what can be computed one side is enough.
                (Ok(lower), Err(_)) => ((low, lower.clone()), (z, middle())),
                (Err(_), Ok(upper)) => ((z, middle()), (task[1].2, upper.clone())),
                (Err(why), Err(_)) => return Err(why.clone()),
            };
            let slope = |(lower, upper): (&Vec<f64>, &Vec<f64>)| {
                lower.iter().zip(upper).map(|(a, b)| (b - a) / (to - from)).collect()
            };
            let values = lower.iter().zip(&upper).map(slope).collect();
            slopes.push(Slope { place: [column, place], values });
        }
        Ok(slopes)
    }
}

/// Coordinates to either side, within bounds.
fn ends(one: &Adjustable, z: f64) -> [f64; 2] {
    let change = CHANGE * if one.logarithmic { 1.0 } else { z.abs().max(1e-2) };
    let [low, high] = one.coordinates();
    [(z - change).max(low), (z + change).min(high)]
}
