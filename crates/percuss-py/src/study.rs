//! Studies for Python: their shards, wherever they are run, and the table at the end.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::Duration;

use numpy::IntoPyArray;
use percuss::AnalysisCode;
use percuss_scenario::FileAccess;
use percuss_study::{Done, Folder, Progress, Shard, Values, merge, sweep};
use pyo3::exceptions::PyIndexError;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyList};

use crate::error::{analysis_error, incomplete, scenario_error, study_error};
use crate::structure::array;

/// Python is asked this often during a sweep.
const LOOK: Duration = Duration::from_millis(50);

/// A study that has been read; it needs no file any more.
#[pyclass(frozen, module = "percuss._percuss")]
pub struct Study {
    inner: percuss_study::Study,
}

#[pymethods]
impl Study {
    /// Reads a study; `name` stands for the file in messages, and the scenario it names lies where it lies.
    #[new]
    #[pyo3(signature = (text, name, allow_outside = false))]
    fn new(py: Python<'_>, text: &str, name: &str, allow_outside: bool) -> PyResult<Self> {
        let access = if allow_outside { FileAccess::Anywhere } else { FileAccess::OwnFolder };
        let read = py.detach(|| percuss_study::Study::from_toml_with(text, name, access));
        read.map(|inner| Self { inner }).map_err(|faults| scenario_error(py, &faults))
    }

    /// Studies travel as their text.
    fn __reduce__<'py>(
        slf: &Bound<'py, Self>,
    ) -> PyResult<(Bound<'py, PyAny>, (String, &'static str))> {
        Ok((slf.get_type().into_any(), (slf.get().inner.to_toml(), "study")))
    }

    fn __repr__(&self) -> String {
        format!("<percuss.Study {}: {} runs>", self.inner.title(), self.inner.run_count())
    }

    /// The study as a function: `f(x)` for numbers of its parameters in SI units.
    fn function<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("percuss._function")?.getattr("Function")?.call1((slf,))
    }

    #[getter]
    fn text(&self) -> String {
        self.inner.to_toml()
    }

    #[getter]
    fn title(&self) -> &str {
        self.inner.title()
    }

    #[getter]
    fn fingerprint(&self) -> &str {
        self.inner.fingerprint()
    }

    #[getter]
    fn run_count(&self) -> u64 {
        self.inner.run_count()
    }

    #[getter]
    fn shard_count(&self) -> u64 {
        self.inner.shard_count()
    }

    /// Numbers of the first run of a shard and of the one behind its last.
    fn runs_of(&self, index: u64) -> PyResult<(u64, u64)> {
        let runs = self.inner.runs_of(self.known(index)?);
        Ok((runs.start, runs.end))
    }

    /// Does the runs of a shard: Parquet, the same bytes wherever it is done.
    fn run_shard<'py>(&self, py: Python<'py>, index: u64) -> PyResult<Bound<'py, PyBytes>> {
        let index = self.known(index)?;
        let done = py.detach(|| {
            let goes_on = || Python::attach(|py| py.check_signals()).is_ok();
            let shard = self.inner.run_shard_while(index, &goes_on)?;
            Some(shard.to_parquet(&self.inner))
        });
        match done {
            Some(bytes) => Ok(PyBytes::new(py, &bytes.map_err(|error| study_error(&error))?)),
            None => Err(pyo3::exceptions::PyKeyboardInterrupt::new_err(())),
        }
    }

    /// Whether these are the bytes of a shard, whole and of this study.
    fn is_shard(&self, bytes: &[u8], index: u64) -> bool {
        Shard::from_parquet(bytes, &self.inner).is_ok_and(|shard| shard.index == index)
    }

    /// `results.parquet` from the shards' bytes, taken one after the other from `read(index)`.
    fn merge<'py>(
        &self,
        py: Python<'py>,
        read: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyBytes>> {
        let raised = std::cell::RefCell::new(None);
        let shards = (0..self.inner.shard_count()).map_while(|index| {
            let bytes = read.call1((index,)).and_then(|bytes| bytes.extract::<Vec<u8>>());
            bytes
                .map(|bytes| Shard::from_parquet(&bytes, &self.inner))
                .map_err(|error| raised.borrow_mut().replace(error))
                .ok()
        });
        let mut out = Vec::new();
        let merged = merge(&self.inner, shards, &mut out);
        raised.take().map_or(Ok(()), Err)?;
        merged.map_err(|error| study_error(&error))?;
        Ok(PyBytes::new(py, &out))
    }

    /// Does what is left of the study in a directory on `jobs` threads, 0 for one a core, and puts the results together.
    ///
    /// `progress` is called with runs done and runs in all.
    fn sweep(
        &self,
        py: Python<'_>,
        directory: PathBuf,
        jobs: usize,
        progress: Py<PyAny>,
    ) -> PyResult<()> {
        let folder = self.folder(&directory)?;
        let wanted: Vec<u64> = (0..self.inner.shard_count()).collect();
        let (stop, seen) = (AtomicBool::new(false), AtomicU64::new(0));
        let tell = |at: Progress| {
            seen.store(at.done, Ordering::Relaxed);
            !stop.load(Ordering::Relaxed)
        };
        // Python hears signals on its main thread only, so the work is done on another one.
        let (done, raised) = py.detach(|| {
            std::thread::scope(|scope| {
                let work = scope.spawn(|| sweep(&self.inner, &folder, &wanted, jobs, &tell));
                let mut raised = None;
                while !work.is_finished() {
                    std::thread::sleep(LOOK);
                    let runs = (seen.load(Ordering::Relaxed), self.inner.run_count());
                    let look = |py: Python<'_>| {
                        py.check_signals()?;
                        progress.call1(py, runs).map(drop)
                    };
                    if raised.is_none()
                        && let Err(error) = Python::attach(look)
                    {
                        raised = Some(error);
                        stop.store(true, Ordering::Relaxed);
                    }
                }
                (work.join(), raised)
            })
        });
        if let Some(error) = raised {
            return Err(error);
        }
        match done {
            Ok(Ok(Done::All)) => {
                py.detach(|| folder.finish(&self.inner)).map_err(|error| study_error(&error))
            }
            Ok(Ok(_)) => Err(incomplete("the study is not complete")),
            Ok(Err(error)) => Err(study_error(&error)),
            Err(_) => Err(analysis_error(AnalysisCode::Broken, "a thread of the sweep broke down")),
        }
    }

    /// Makes a directory that of the study, or refuses one of something else.
    fn open(&self, directory: PathBuf) -> PyResult<()> {
        self.folder(&directory).map(drop)
    }

    /// `indices.parquet` of the results in a directory; none for a study without Sobol indices.
    fn indices(&self, py: Python<'_>, directory: PathBuf) -> PyResult<Option<Vec<u8>>> {
        if !self.inner.has_sobol_indices() {
            return Ok(None);
        }
        let folder = self.folder(&directory)?;
        let bytes = py.detach(|| {
            let table = folder.results(&self.inner)?;
            let indices = percuss_study::indices(&self.inner, &table);
            percuss_study::indices_parquet(&self.inner, &indices)
        });
        bytes.map(Some).map_err(|error| study_error(&error))
    }

    /// `report.html` of the results in a directory.
    fn report(&self, py: Python<'_>, directory: PathBuf) -> PyResult<String> {
        let folder = self.folder(&directory)?;
        py.detach(|| {
            Ok(percuss_study::report(&self.inner, &folder.results(&self.inner)?, &folder.kept()))
        })
        .map_err(|error| study_error(&error))
    }

    /// Columns of `results.parquet` in a directory: (name, unit, role, what it is, values).
    fn results<'py>(&self, py: Python<'py>, directory: PathBuf) -> PyResult<Bound<'py, PyList>> {
        let folder = self.folder(&directory)?;
        let table =
            py.detach(|| folder.results(&self.inner)).map_err(|error| study_error(&error))?;
        let out = PyList::empty(py);
        for (column, values) in table.columns.into_iter().zip(table.values) {
            let values = match values {
                Values::Whole(values) => values.into_pyarray(py).into_any(),
                Values::Number(values) => array(py, values).into_any(),
                Values::Text(values) => PyList::new(py, values)?.into_any(),
            };
            out.append((column.name, column.unit, column.role.name(), column.about, values))?;
        }
        Ok(out)
    }
}

impl Study {
    /// The study of the core.
    pub(crate) fn inner(&self) -> &percuss_study::Study {
        &self.inner
    }

    fn known(&self, index: u64) -> PyResult<u64> {
        let count = self.inner.shard_count();
        let fault = || PyIndexError::new_err(format!("shard {index} of {count}"));
        (index < count).then_some(index).ok_or_else(fault)
    }

    fn folder(&self, directory: &Path) -> PyResult<Folder> {
        Folder::open(directory, &self.inner).map_err(|error| study_error(&error))
    }
}
