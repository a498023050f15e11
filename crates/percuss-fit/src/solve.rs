//! Minima of the cost, by the trust-region method of `basin`, from one or several starting points.

use std::sync::{Mutex, PoisonError};

use basin::{
    BoxBounds, ConstraintDescription, ConstraintSet, ConstraintSolveError, Constraints,
    DenseMatrix, Executor, Jacobian, Residual, RobustLeastSquares, Termination, TerminationCode,
    TrustRegionReflective,
};
use percuss_codes::AnalysisCode;
use percuss_study::latin_hypercube;
use rayon::prelude::*;

use crate::error::{FitError, Stop};
use crate::loss::Loss;
use crate::problem::{Computed, Problem};
use crate::run::{GoesOn, Share};

/// Relative changes of cost and of coordinates below which an iteration ends, those of SciPy's `least_squares`.
const COST: f64 = 1e-8;
const STEP: f64 = 1e-8;

/// What an optimiser found from a starting point.
#[derive(Clone, Debug, PartialEq)]
pub struct Minimum {
    /// Coordinates of the starting point, shape (free parameters) \[-\].
    pub start: Vec<f64>,
    /// Coordinates of the minimum, shape (free parameters) \[-\].
    pub coordinates: Vec<f64>,
    /// Half the sum of the losses of its residuals; NaN where none was computed.
    pub cost: f64,
    /// Whether the iteration converged.
    pub success: bool,
    /// Why it ended, in words.
    pub message: String,
    /// Evaluations of the residuals, those for difference quotients not counted.
    pub evaluations: u64,
}

/// The problem as the optimiser sees it.
struct Descent<'p> {
    problem: &'p Problem,
    /// Smallest coordinates, shape (free parameters) \[-\].
    lower: Vec<f64>,
    /// Largest coordinates, shape (free parameters) \[-\].
    upper: Vec<f64>,
    goes_on: GoesOn<'p>,
    /// The latest runs and their point: derivatives are wanted where residuals were.
    latest: Mutex<Option<(Vec<f64>, Vec<Computed>)>>,
}

impl Descent<'_> {
    fn computed(&self, point: &[f64]) -> Result<Vec<Computed>, Stop> {
        let mut latest = self.latest.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((at, computed)) = latest.as_ref().filter(|(at, _)| at == point) {
            debug_assert_eq!(at.len(), point.len());
            return Ok(computed.clone());
        }
        let (problem, values) = (self.problem, self.problem.values(point));
        let tests = problem.fitted_tests();
        let computed = problem.compute_all(&tests, &values, Share::Whole, self.goes_on)?;
        *latest = Some((point.to_vec(), computed.clone()));
        Ok(computed)
    }
}

impl Residual for Descent<'_> {
    type Param = Vec<f64>;
    type Output = Vec<f64>;
    type Error = Stop;

    /// A point without a run has no finite residual: the optimiser goes less far.
    fn residual(&self, point: &Vec<f64>) -> Result<Vec<f64>, Stop> {
        match self.computed(point) {
            Ok(computed) => Ok(self.problem.residuals_of(&computed, &self.problem.values(point))),
            Err(Stop::Interrupted) => Err(Stop::Interrupted),
            Err(Stop::Failed(_)) => Ok(vec![f64::NAN; self.problem.residual_count()]),
        }
    }
}

impl Jacobian for Descent<'_> {
    type Jacobian = DenseMatrix;

    fn jacobian(&self, point: &Vec<f64>) -> Result<DenseMatrix, Stop> {
        let rows = self.problem.jacobian_of(&self.computed(point)?, point, self.goes_on)?;
        let (m, n) = (rows.len(), point.len());
        Ok(DenseMatrix::from_row_slice(m, n, &rows.concat()))
    }
}

impl Constraints for Descent<'_> {
    type Set = ConstraintSet<BoxBounds<Vec<f64>>>;

    fn constraints(&self) -> <Self::Set as ConstraintDescription>::Borrowed<'_> {
        let bounds = BoxBounds::new(Some(&self.lower), Some(&self.upper));
        ConstraintSet::new().with_bounds(bounds)
    }
}

impl Problem {
    /// Starting points: that of the parameters, then those of a Latin hypercube within their bounds, shape (starts, free parameters) \[-\].
    pub fn starts(&self) -> Vec<Vec<f64>> {
        let bounds = self.bounds();
        let more = self.options.starts.saturating_sub(1);
        let point = |shares: Vec<f64>| -> Vec<f64> {
            let both = bounds.iter().zip(shares);
            both.map(|([low, high], share)| low + share * (high - low)).collect()
        };
        let mut all = vec![self.start()];
        if more > 0 {
            let points = latin_hypercube(more, bounds.len(), self.options.seed);
            all.extend(points.into_iter().map(point));
        }
        all
    }

    /// Minima of the cost, one from each starting point, in parallel.
    ///
    /// # Errors
    /// If no starting point has a run, or the user asks to stop.
    pub fn minima(&self, goes_on: GoesOn<'_>) -> Result<Vec<Minimum>, FitError> {
        let (starts, bounds) = (self.starts(), self.bounds());
        let found: Vec<Result<Minimum, Stop>> = self.workers.install(|| {
            starts.par_iter().map(|start| self.descend(start, &bounds, goes_on)).collect()
        });
        let found: Vec<Minimum> = found.into_iter().collect::<Result<_, _>>()?;
        match found.iter().all(|one| one.cost.is_nan()) {
            true => Err(FitError::Run(AnalysisCode::NoFit, found[0].message.clone())),
            false => Ok(found),
        }
    }

    /// The minimum that is reached from a starting point within bounds; equal ones keep a coordinate.
    pub(crate) fn descend(
        &self,
        start: &[f64],
        bounds: &[[f64; 2]],
        goes_on: GoesOn<'_>,
    ) -> Result<Minimum, Stop> {
        let [lower, upper] = [0, 1].map(|end| bounds.iter().map(|bound| bound[end]).collect());
        let latest = Mutex::default();
        let descent = Descent { problem: self, lower, upper, goes_on, latest };
        if let Err(Stop::Failed(why)) = descent.computed(start) {
            return Ok(failed(start, format!("the run at the starting point fails: {why}")));
        }
        let loss = Loss::of(&self.options);
        let objective = RobustLeastSquares::new(descent, loss).with_scale(loss.scale());
        let solver = TrustRegionReflective::new()
            .with_relative_cost_change_tolerance(COST)
            .with_relative_step_tolerance::<Vec<f64>, f64>(STEP);
        let iterations = self.options.iterations as u64;
        let run = Executor::from_start(objective, solver, start.to_vec());
        let result = match run.max_iter(iterations).run().map_err(stopped) {
            Ok(result) => result,
            // Other starting points may lead to a minimum.
            Err(Stop::Failed(why)) => {
                return Ok(failed(start, format!("the iteration fails: {why}")));
            }
            Err(Stop::Interrupted) => return Err(Stop::Interrupted),
        };
        let (success, message) = ended(&result.report.termination, iterations);
        Ok(Minimum {
            start: start.to_vec(),
            coordinates: result.param().clone(),
            cost: result.cost(),
            success,
            message,
            evaluations: result.counts.residual_evals,
        })
    }
}

/// What a starting point leads to from which there is no minimum.
fn failed(start: &[f64], message: String) -> Minimum {
    let start = start.to_vec();
    let coordinates = start.clone();
    Minimum { start, coordinates, cost: f64::NAN, success: false, message, evaluations: 1 }
}

/// What ended the optimiser.
fn stopped(error: ConstraintSolveError<Stop>) -> Stop {
    match error {
        ConstraintSolveError::Evaluation(stop) => stop,
        why => Stop::failed(AnalysisCode::Broken, why),
    }
}

/// Whether an iteration converged, and why it ended.
fn ended(termination: &Termination, iterations: u64) -> (bool, String) {
    let code = termination.code();
    match (termination, code) {
        (_, TerminationCode::RelativeCostTolerance) => {
            (true, "converged: the cost no longer changes".into())
        }
        (_, TerminationCode::RelativeParamTolerance) => {
            (true, "converged: the parameters no longer change".into())
        }
        (Termination::Converged(_), _) => (true, "converged: the gradient vanishes".into()),
        // No point nearby is better to the last digit.
        (Termination::Stalled(_), _) => (true, "converged: no further decrease of the cost".into()),
        (Termination::Limit(_), _) => {
            (false, format!("not converged within the limit of iterations ({iterations})"))
        }
        _ => (false, format!("the optimiser stopped ({code:?})")),
    }
}
