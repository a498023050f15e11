//! The work of a study's shards and sweeps for Python.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::Duration;

use percuss::AnalysisCode;
use percuss_study::{Done, Folder, Progress, Shard, Study, Table, Values, merge};
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyList};

use crate::error::{analysis_error, incomplete, study_error};
use crate::structure::array;

/// Python is asked this often during a sweep.
const LOOK: Duration = Duration::from_millis(50);

/// Does what is left of a study on `jobs` threads, 0 for one a core, and puts the results together.
///
/// # Errors
/// What `progress` raised, or what ended the sweep.
pub fn sweep(
    py: Python<'_>,
    study: &Study,
    folder: &Folder,
    jobs: usize,
    progress: &Py<PyAny>,
) -> PyResult<()> {
    let wanted: Vec<u64> = (0..study.shard_count()).collect();
    let (stop, seen) = (AtomicBool::new(false), AtomicU64::new(0));
    let tell = |at: Progress| {
        seen.store(at.done, Ordering::Relaxed);
        !stop.load(Ordering::Relaxed)
    };
    // Python hears signals on its main thread only, so the work is done on another one.
    let (done, raised) = py.detach(|| {
        std::thread::scope(|scope| {
            let work = scope.spawn(|| percuss_study::sweep(study, folder, &wanted, jobs, &tell));
            let mut raised = None;
            while !work.is_finished() {
                std::thread::sleep(LOOK);
                let runs = (seen.load(Ordering::Relaxed), study.run_count());
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
            py.detach(|| folder.finish(study)).map_err(|error| study_error(&error))
        }
        Ok(Ok(_)) => Err(incomplete("the study is not complete")),
        Ok(Err(error)) => Err(study_error(&error)),
        Err(_) => Err(analysis_error(AnalysisCode::Broken, "a thread of the sweep broke down")),
    }
}

/// The table of all shards, taken one after the other from `read(index)`.
///
/// # Errors
/// What `read` raised, or a shard that is missing or not of this study.
pub fn merged<'py>(
    py: Python<'py>,
    study: &Study,
    read: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyBytes>> {
    let raised = std::cell::RefCell::new(None);
    let shards = (0..study.shard_count()).map_while(|index| {
        let bytes = read.call1((index,)).and_then(|bytes| bytes.extract::<Vec<u8>>());
        bytes
            .map(|bytes| Shard::from_parquet(&bytes, study))
            .map_err(|error| raised.borrow_mut().replace(error))
            .ok()
    });
    let mut out = Vec::new();
    let merged = merge(study, shards, &mut out);
    raised.take().map_or(Ok(()), Err)?;
    merged.map_err(|error| study_error(&error))?;
    Ok(PyBytes::new(py, &out))
}

/// Columns of the results in a directory: (name, unit, role, what it is, values).
///
/// # Errors
/// Results that are not there or cannot be read.
pub fn columns<'py>(
    py: Python<'py>,
    study: &Study,
    folder: &Folder,
) -> PyResult<Bound<'py, PyList>> {
    let table = py.detach(|| folder.results(study)).map_err(|error| study_error(&error))?;
    to_python(py, table)
}

/// Columns of a table that has been read: (name, unit, role, what it is, values); arrays cannot be written to.
///
/// # Errors
/// If Python has no memory for them.
pub fn to_python(py: Python<'_>, table: Table) -> PyResult<Bound<'_, PyList>> {
    let out = PyList::empty(py);
    for (column, values) in table.columns.into_iter().zip(table.values) {
        let values = match values {
            Values::Whole(values) => array(py, values).into_any(),
            Values::Number(values) => array(py, values).into_any(),
            Values::Text(values) => PyList::new(py, values)?.into_any(),
        };
        out.append((column.name, column.unit, column.role.name(), column.about, values))?;
    }
    Ok(out)
}

/// The runs of a shard: Parquet.
///
/// # Errors
/// `KeyboardInterrupt`, or a table that cannot be written.
pub fn shard<'py>(py: Python<'py>, study: &Study, index: u64) -> PyResult<Bound<'py, PyBytes>> {
    let done = py.detach(|| {
        let goes_on = || Python::attach(|py| py.check_signals()).is_ok();
        let shard = study.run_shard_while(index, &goes_on)?;
        Some(shard.to_parquet(study))
    });
    match done {
        Some(bytes) => Ok(PyBytes::new(py, &bytes.map_err(|error| study_error(&error))?)),
        None => Err(PyKeyboardInterrupt::new_err(())),
    }
}

/// The table of Sobol indices: Parquet; none for a study without.
///
/// # Errors
/// Results that are not there or cannot be read.
pub fn indices(
    py: Python<'_>,
    study: &Study,
    folder: impl FnOnce() -> PyResult<Folder>,
) -> PyResult<Option<Vec<u8>>> {
    if !study.has_sobol_indices() {
        return Ok(None);
    }
    let folder = folder()?;
    let bytes = py.detach(|| {
        let table = folder.results(study)?;
        percuss_study::indices_parquet(study, &percuss_study::indices(study, &table))
    });
    bytes.map(Some).map_err(|error| study_error(&error))
}
