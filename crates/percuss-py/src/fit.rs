//! Fits for Python.

use std::path::PathBuf;
use std::sync::Arc;

use numpy::PyArray1;
use percuss_fit::{
    Fit, FitError, Minimum, Problem, Stop as Ended, Supplied, fit_page, fit_text, fit_value,
    write_fit,
};
use percuss_output::{Extent, Results, RunDirectory};
use percuss_scenario::fit::{Record, RecordColumn};
use percuss_scenario::{FileAccess, FitFile};
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;

use crate::error::Refusal;
use crate::ready::Source;
use crate::structure::{array, shaped};
use crate::watch::{Stop, Watch};

/// Headers and values of the columns of a record, shape (columns).
type RecordColumns = Vec<(String, Vec<f64>)>;

/// Start, coordinates, cost, whether it converged, why it ended, and evaluations of a minimum.
type Found = (Vec<f64>, Vec<f64>, f64, bool, String, u64);

/// Test, channel, column, unit, time, measured, computed, offset.
type Curves<'py> = (
    String,
    String,
    String,
    String,
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray1<f64>>,
    f64,
);

/// Values, least costs, interval of a profile, and what it says against the minimum.
type Profiled<'py> =
    (Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>, [f64; 2], Option<String>);

/// Whether work is to go on.
type GoesOn<'a> = dyn Fn() -> bool + Sync + 'a;

/// Parameters to be found and the tests that they are found from.
#[pyclass(frozen, module = "percuss._percuss")]
pub struct FitProblem {
    problem: Arc<Problem>,
    /// Ends work on all threads: signals are seen on the main thread only.
    stopped: Stop,
}

/// The result of a fit.
#[pyclass(frozen, module = "percuss._percuss")]
pub struct NativeFit(Arc<Fit>);

impl From<FitError> for Refusal {
    fn from(error: FitError) -> Self {
        match error {
            FitError::Faults(faults) => Self::Faults(*faults),
            FitError::Run(code, why) => Self::Analysis(code, why),
            FitError::Interrupted => Self::Stopped,
            FitError::System(error) => Self::Study(error),
        }
    }
}

#[pymethods]
impl FitProblem {
    /// A problem from the text of its file; scenarios and records by the names of their tests.
    #[new]
    fn new(
        py: Python<'_>,
        text: &str,
        base: Source,
        scenarios: Vec<(String, Source)>,
        records: Vec<(String, RecordColumns)>,
        jobs: usize,
    ) -> PyResult<Self> {
        let scenario = |source: Source| source.attend(py, |ready, _| Ok(ready.scenario.clone()));
        let mut supplied = Supplied::default();
        for (test, source) in scenarios {
            supplied.scenarios.insert(test, scenario(source)?);
        }
        for (test, columns) in records {
            let column = |(header, values): (String, Vec<f64>)| RecordColumn::new(&header, values);
            let columns = columns.into_iter().map(column).collect();
            supplied.records.insert(test, Record { columns });
        }
        let text = text.to_owned();
        let problem = base.attend(py, move |ready, stop| {
            let supplied = Supplied { base: Some(ready.scenario.clone()), ..supplied };
            // The user names records himself, and those that are named here are his.
            let file = FitFile::read_with(&text, "fit", FileAccess::Anywhere)?;
            Ok(Problem::new(&file, &supplied, jobs, &|| !stop.is_wanted())?)
        })?;
        Ok(Self { problem: Arc::new(problem), stopped: Stop::default() })
    }

    /// Coordinates of the starting points.
    fn starts(&self) -> Vec<Vec<f64>> {
        self.problem.starts()
    }

    /// Smallest and largest coordinates.
    fn bounds(&self) -> Vec<[f64; 2]> {
        self.problem.bounds()
    }

    /// Values of all parameters at coordinates.
    fn values(&self, coordinates: Vec<f64>) -> Vec<f64> {
        self.problem.values(&coordinates)
    }

    /// Residuals at coordinates, NaN where there is no run; and why.
    fn residuals<'py>(
        &self,
        py: Python<'py>,
        coordinates: Vec<f64>,
    ) -> PyResult<(Bound<'py, PyArray1<f64>>, Option<String>)> {
        match self.work(py, move |problem, goes_on| problem.residuals(&coordinates, goes_on))? {
            Ok(residuals) => Ok((array(py, residuals), None)),
            Err(Ended::Interrupted) => Err(PyKeyboardInterrupt::new_err(())),
            Err(Ended::Failed(why)) => {
                Ok((array(py, vec![f64::NAN; self.problem.residual_count()]), Some(why)))
            }
        }
    }

    /// Derivatives of the residuals by the coordinates.
    fn jacobian<'py>(&self, py: Python<'py>, coordinates: Vec<f64>) -> PyResult<Bound<'py, PyAny>> {
        let shape = [self.problem.residual_count(), coordinates.len()];
        let found =
            self.work(py, move |problem, goes_on| problem.jacobian(&coordinates, goes_on))?;
        let rows = found.map_err(|ended| refused(py, ended.into()))?;
        shaped(py, rows.concat(), &shape)
    }

    /// Ends what other threads compute, and refuses what they ask for later: their calls raise `KeyboardInterrupt`.
    fn stop(&self) {
        self.stopped.want();
    }

    /// Minima by the optimiser of the command.
    fn minima(&self, py: Python<'_>) -> PyResult<Vec<Found>> {
        let found = self
            .work(py, |problem, goes_on| problem.minima(goes_on))?
            .map_err(|error| refused(py, error))?;
        let one =
            |m: Minimum| (m.start, m.coordinates, m.cost, m.success, m.message, m.evaluations);
        Ok(found.into_iter().map(one).collect())
    }

    /// What minima are worth.
    fn diagnose(&self, py: Python<'_>, minima: Vec<Found>) -> PyResult<NativeFit> {
        let one = |(start, coordinates, cost, success, message, evaluations): Found| Minimum {
            start,
            coordinates,
            cost,
            success,
            message,
            evaluations,
        };
        let minima = minima.into_iter().map(one).collect();
        let found = self.work(py, move |problem, goes_on| problem.diagnose(minima, goes_on))?;
        let fit = found.map_err(|error| refused(py, error))?;
        Ok(NativeFit(Arc::new(fit)))
    }

    /// The profile of a parameter: values, least costs, interval, what it says against the minimum; None if it is not free.
    fn profile<'py>(
        &self,
        py: Python<'py>,
        fit: &Bound<'py, NativeFit>,
        name: &str,
        points: usize,
    ) -> PyResult<Option<Profiled<'py>>> {
        let (fit, name) = (Arc::clone(&fit.get().0), name.to_owned());
        let cost = fit.cost;
        let work = move |problem: &Problem, goes_on: &GoesOn<'_>| {
            problem.profile(&fit, &name, points, goes_on)
        };
        let found = self.work(py, work)?.map_err(|ended| refused(py, ended.into()))?;
        Ok(found.map(|one| {
            let lower = one.lower_minimum(cost);
            (array(py, one.values), array(py, one.costs), one.interval, lower)
        }))
    }
}

impl FitProblem {
    /// Does work while signals are looked for; it asks whether to go on.
    fn work<T: Send + 'static>(
        &self,
        py: Python<'_>,
        work: impl FnOnce(&Problem, &GoesOn<'_>) -> T + Send + 'static,
    ) -> PyResult<T> {
        let (problem, stopped) = (Arc::clone(&self.problem), self.stopped.clone());
        let ends = move |_: Python<'_>| match stopped.is_wanted() {
            true => Err(PyKeyboardInterrupt::new_err(())),
            false => Ok(()),
        };
        ends(py)?;
        let done = move |stop: &Stop| work(&problem, &|| !stop.is_wanted());
        Watch::default().run_reporting(py, done, ends)
    }
}

fn refused(py: Python<'_>, error: FitError) -> PyErr {
    Refusal::from(error).exception(py)
}

#[pymethods]
impl NativeFit {
    /// Everything but curves and derivatives, as JSON.
    fn json(&self) -> String {
        fit_value(&self.0).to_string()
    }

    /// The report as text.
    fn text(&self) -> String {
        fit_text(&self.0)
    }

    /// The page.
    fn page(&self) -> String {
        fit_page(&self.0)
    }

    /// Residuals.
    fn residuals<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        array(py, self.0.residuals.clone())
    }

    /// Derivatives of the weighted residuals by the free parameters.
    fn jacobian<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        matrix(py, &self.0.jacobian, self.0.free.len())
    }

    /// Covariance and correlation of the free parameters.
    fn covariance<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>)> {
        let n = self.0.free.len();
        Ok((matrix(py, &self.0.covariance, n)?, matrix(py, &self.0.correlation, n)?))
    }

    /// Standard errors of all parameters; infinite where the data do not determine one.
    fn errors<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        array(py, self.0.parameters.iter().map(|one| one.stderr).collect())
    }

    /// Measured and computed curves.
    fn curves<'py>(&self, py: Python<'py>) -> Vec<Curves<'py>> {
        let one = |o: &percuss_fit::Overlay| {
            (
                o.test.clone(),
                o.channel.clone(),
                o.column.clone(),
                o.unit.clone(),
                array(py, o.time.clone()),
                array(py, o.measured.clone()),
                array(py, o.computed.clone()),
                o.offset,
            )
        };
        self.0.overlays.iter().map(one).collect()
    }

    /// Scenarios with the values found: name of the file and text.
    fn scenarios(&self) -> Vec<(String, String)> {
        self.0.scenarios.clone()
    }

    /// Writes the files of the fit into a directory; an earlier fit in it is replaced.
    fn write(&self, py: Python<'_>, out: PathBuf) -> PyResult<PathBuf> {
        let fit = Arc::clone(&self.0);
        let written = Watch::default().run(py, move |stop: &Stop| {
            stop.writes();
            let directory = RunDirectory::create_for(Results::Fit, &out)?;
            write_fit(directory.path(), &fit).map_err(|(path, error)| {
                Refusal::System(format!("{}: cannot write: {error}", path.display()))
            })?;
            Ok::<_, Refusal>(directory.commit_as(Extent::Complete)?.place)
        })?;
        written.map_err(|refusal| refusal.exception(py))
    }
}

fn matrix<'py>(py: Python<'py>, rows: &[Vec<f64>], columns: usize) -> PyResult<Bound<'py, PyAny>> {
    shaped(py, rows.concat(), &[rows.len(), columns])
}
