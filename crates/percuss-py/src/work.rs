//! The work of a study's shards and sweeps for Python.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use percuss_study::{Done, Folder, Progress, Shard, Study, Table, Values, merge};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyList};

use crate::error::{Refusal, incomplete, study_error};
use crate::structure::array;
use crate::watch::{Stop, Watch};

/// Does what is left of a study on `jobs` threads, 0 for one a core, and puts the results together.
///
/// # Errors
/// What `progress` raised, or what ended the sweep.
pub fn sweep(
    py: Python<'_>,
    study: Arc<Study>,
    folder: Folder,
    jobs: usize,
    progress: &Py<PyAny>,
) -> PyResult<()> {
    let (seen, runs) = (Arc::new(AtomicU64::new(0)), study.run_count());
    let raised = Arc::clone(&seen);
    let work = move |stop: &Stop| {
        let wanted: Vec<u64> = (0..study.shard_count()).collect();
        let tell = |at: Progress| {
            seen.store(at.done, Ordering::Relaxed);
            !stop.is_wanted()
        };
        let done = percuss_study::sweep(&study, &folder, &wanted, jobs, &tell)?;
        if done == Done::All {
            folder.finish(&study)?;
        }
        Ok(done)
    };
    let tell =
        |py: Python<'_>| progress.call1(py, (raised.load(Ordering::Relaxed), runs)).map(drop);
    match Watch::default().run_reporting(py, work, tell)? {
        Ok(Done::All) => Ok(()),
        Ok(_) => Err(incomplete("the study is not complete")),
        Err(error) => Err(study_error(&error)),
    }
}

/// The table of all shards, taken one after the other from `read(index)`.
///
/// # Errors
/// What `read` raised, or a shard that is missing or not of this study.
pub fn merged<'py>(
    py: Python<'py>,
    study: Arc<Study>,
    read: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyBytes>> {
    let all = (0..study.shard_count()).map(|index| read.call1((index,))?.extract::<Vec<u8>>());
    let all = all.collect::<PyResult<Vec<_>>>()?;
    let work = move |_: &Stop| {
        let mut out = Vec::new();
        merge(&study, all.iter().map(|bytes| Shard::from_parquet(bytes, &study)), &mut out)?;
        Ok(out)
    };
    let merged = Watch::default().run(py, work)?;
    Ok(PyBytes::new(py, &merged.map_err(|error| study_error(&error))?))
}

/// Columns of the results in a directory: (name, unit, role, what it is, values).
///
/// # Errors
/// Results that are not there or cannot be read.
pub fn columns<'py>(
    py: Python<'py>,
    study: Arc<Study>,
    folder: Folder,
) -> PyResult<Bound<'py, PyList>> {
    let table = Watch::default().run(py, move |_| folder.results(&study))?;
    let table = table.map_err(|error| study_error(&error))?;
    to_python(py, table)
}

/// Columns of a table that has been kept: (name, unit, role, what it is, values).
///
/// # Errors
/// If the table is damaged, or that of another study.
pub fn table(py: Python<'_>, study: Arc<Study>, bytes: Vec<u8>) -> PyResult<Bound<'_, PyList>> {
    let table = Watch::default().run(py, move |_| percuss_study::read_table(&bytes, &study))?;
    to_python(py, table.map_err(|error| study_error(&error))?)
}

/// The report of the results in a directory: HTML.
///
/// # Errors
/// Results that are not there or cannot be read.
pub fn report(py: Python<'_>, study: Arc<Study>, folder: Folder) -> PyResult<String> {
    let work =
        move |_: &Stop| Ok(percuss_study::report(&study, &folder.results(&study)?, &folder.kept()));
    Watch::default().run(py, work)?.map_err(|error: percuss_study::Error| study_error(&error))
}

/// Columns of a table that has been read: (name, unit, role, what it is, values); arrays cannot be written to.
///
/// # Errors
/// If Python has no memory for them.
fn to_python(py: Python<'_>, table: Table) -> PyResult<Bound<'_, PyList>> {
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
pub fn shard<'py>(py: Python<'py>, study: Arc<Study>, index: u64) -> PyResult<Bound<'py, PyBytes>> {
    let work = move |stop: &Stop| {
        let shard = study.run_shard_while(index, &|| !stop.is_wanted());
        shard.ok_or(Refusal::Stopped)?.to_parquet(&study).map_err(Refusal::Study)
    };
    let bytes = Watch::default().run(py, work)?;
    Ok(PyBytes::new(py, &bytes.map_err(|refusal| refusal.exception(py))?))
}

/// The table of Sobol indices: Parquet; none for a study without.
///
/// # Errors
/// Results that are not there or cannot be read.
pub fn indices(
    py: Python<'_>,
    study: Arc<Study>,
    folder: impl FnOnce() -> PyResult<Folder>,
) -> PyResult<Option<Vec<u8>>> {
    if !study.has_sobol_indices() {
        return Ok(None);
    }
    let folder = folder()?;
    let work = move |_: &Stop| {
        let table = folder.results(&study)?;
        percuss_study::indices_parquet(&study, &percuss_study::indices(&study, &table))
    };
    let bytes = Watch::default().run(py, work)?;
    bytes.map(Some).map_err(|error| study_error(&error))
}
