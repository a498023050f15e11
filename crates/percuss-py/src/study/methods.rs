//! What Python calls of a study.

use std::path::PathBuf;

use percuss_study::Shard;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyList};

use super::Study;
use crate::work;

#[pymethods]
impl Study {
    /// Reads a study; `name` is the name of the file in messages, and the scenario it names is relative to its folder.
    #[new]
    #[pyo3(signature = (text, name, allow_outside = false))]
    fn new(py: Python<'_>, text: &str, name: &str, allow_outside: bool) -> PyResult<Self> {
        Self::read(py, text, name, allow_outside)
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
    ///
    /// Returns
    /// -------
    /// Function
    ///     From values of the parameters to results.
    ///
    /// Raises
    /// ------
    /// InputError
    ///     If something else than a number varies.
    ///
    /// Examples
    /// --------
    /// >>> percuss.sweep("speed.toml").study.function().names
    /// ('speed',)
    fn function<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("percuss._function")?.getattr("Function")?.call1((slf,))
    }

    /// The study as a file that needs no other.
    ///
    /// Returns
    /// -------
    /// str
    ///     TOML, the scenario in it.
    ///
    /// Examples
    /// --------
    /// >>> study = percuss.sweep("speed.toml").study
    /// >>> percuss.Study(study.text, "copy").fingerprint == study.fingerprint
    /// True
    #[getter]
    fn text(&self) -> String {
        self.inner.to_toml()
    }

    /// Its title.
    ///
    /// Returns
    /// -------
    /// str
    ///     As the file says.
    ///
    /// Examples
    /// --------
    /// >>> percuss.sweep("speed.toml").study.title
    /// 'The bag, from 1 to 9 m/s'
    #[getter]
    fn title(&self) -> &str {
        self.inner.title()
    }

    /// What tells it from every other study, and one version of the program from the next.
    ///
    /// Returns
    /// -------
    /// str
    ///     Hexadecimal digits.
    ///
    /// Examples
    /// --------
    /// >>> len(percuss.sweep("speed.toml").study.fingerprint) >= 16
    /// True
    #[getter]
    fn fingerprint(&self) -> &str {
        self.inner.fingerprint()
    }

    /// Number of its runs.
    ///
    /// Returns
    /// -------
    /// int
    ///     Runs of its design.
    ///
    /// Examples
    /// --------
    /// >>> percuss.sweep("speed.toml").study.run_count
    /// 9
    #[getter]
    fn run_count(&self) -> u64 {
        self.inner.run_count()
    }

    /// Number of its shards, which depend on nothing but the study.
    ///
    /// Returns
    /// -------
    /// int
    ///     Shards.
    ///
    /// Examples
    /// --------
    /// >>> percuss.sweep("speed.toml").study.shard_count
    /// 2
    #[getter]
    fn shard_count(&self) -> u64 {
        self.inner.shard_count()
    }

    /// The runs of a shard.
    ///
    /// Parameters
    /// ----------
    /// index : int
    ///     The shard, from 0.
    ///
    /// Returns
    /// -------
    /// (int, int)
    ///     Numbers of its first run and of the one behind its last.
    ///
    /// Raises
    /// ------
    /// IndexError
    ///     If there is no such shard.
    ///
    /// Examples
    /// --------
    /// >>> percuss.sweep("speed.toml").study.runs_of(0)
    /// (0, 8)
    fn runs_of(&self, index: u64) -> PyResult<(u64, u64)> {
        let runs = self.inner.runs_of(self.known(index)?);
        Ok((runs.start, runs.end))
    }

    /// Does the runs of a shard.
    ///
    /// Parameters
    /// ----------
    /// index : int
    ///     The shard, from 0.
    ///
    /// Returns
    /// -------
    /// bytes
    ///     Parquet, the same bytes wherever it is done.
    ///
    /// Raises
    /// ------
    /// IndexError
    ///     If there is no such shard.
    /// KeyboardInterrupt
    ///     On Ctrl-C.
    ///
    /// Examples
    /// --------
    /// >>> study = percuss.sweep("speed.toml").study
    /// >>> study.run_shard(0) == study.run_shard(0)
    /// True
    fn run_shard<'py>(&self, py: Python<'py>, index: u64) -> PyResult<Bound<'py, PyBytes>> {
        let index = self.known(index)?;
        work::shard(py, self.shared(), index)
    }

    /// Whether these are the bytes of a shard, whole and of this study.
    ///
    /// Parameters
    /// ----------
    /// bytes : bytes
    ///     What `run_shard` gave, somewhere.
    /// index : int
    ///     The shard, from 0.
    ///
    /// Returns
    /// -------
    /// bool
    ///     Whether they can be kept.
    ///
    /// Examples
    /// --------
    /// >>> study = percuss.sweep("speed.toml").study
    /// >>> data = study.run_shard(0)
    /// >>> study.is_shard(data, 0), study.is_shard(data[:-1], 0)
    /// (True, False)
    fn is_shard(&self, bytes: &[u8], index: u64) -> bool {
        Shard::from_parquet(bytes, &self.inner).is_ok_and(|shard| shard.index == index)
    }

    /// `results.parquet` from the bytes of all shards.
    ///
    /// Parameters
    /// ----------
    /// read : callable
    ///     Gives the bytes of a shard by its number; asked for one after the other.
    ///
    /// Returns
    /// -------
    /// bytes
    ///     Parquet.
    ///
    /// Raises
    /// ------
    /// StudyError
    ///     If a shard is missing or not of this study; what `read` raises comes out.
    ///
    /// Examples
    /// --------
    /// >>> study = percuss.sweep("speed.toml").study
    /// >>> study.merge(study.run_shard)[:4]
    /// b'PAR1'
    fn merge<'py>(
        &self,
        py: Python<'py>,
        read: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyBytes>> {
        work::merged(py, self.shared(), read)
    }

    /// Does what is left of the study in a directory, and puts the results together. Nothing is returned.
    ///
    /// Parameters
    /// ----------
    /// directory : str or path
    ///     Where shards and results are kept.
    /// jobs : int
    ///     Threads, 0 for one a core.
    /// progress : callable
    ///     Called with runs done and runs in all; what it raises ends the sweep.
    ///
    /// Raises
    /// ------
    /// StudyError
    ///     If the sweep ended early.
    /// FileError, InputError
    ///     If the directory cannot be written, or belongs to something else.
    ///
    /// Examples
    /// --------
    /// >>> study = percuss.sweep("speed.toml").study
    /// >>> study.sweep("kept", 1, lambda done, of: None)
    /// >>> len(study.results("kept"))
    /// 15
    fn sweep(
        &self,
        py: Python<'_>,
        directory: PathBuf,
        jobs: usize,
        progress: Py<PyAny>,
    ) -> PyResult<()> {
        work::sweep(py, self.shared(), self.folder(&directory)?, jobs, &progress)
    }

    /// Makes a directory that of the study, or refuses one of something else. Nothing is returned.
    ///
    /// Parameters
    /// ----------
    /// directory : str or path
    ///     It is made if it is not there.
    ///
    /// Raises
    /// ------
    /// FileError, InputError
    ///     If it cannot be written, or belongs to something else.
    ///
    /// Examples
    /// --------
    /// >>> percuss.sweep("speed.toml").study.open("kept")
    fn open(&self, directory: PathBuf) -> PyResult<()> {
        self.folder(&directory).map(drop)
    }

    /// `indices.parquet` of the results in a directory.
    ///
    /// Parameters
    /// ----------
    /// directory : str or path
    ///     Where a sweep was kept.
    ///
    /// Returns
    /// -------
    /// bytes or None
    ///     Parquet; None for a study without Sobol indices.
    ///
    /// Raises
    /// ------
    /// InputError
    ///     If the results are not there.
    ///
    /// Examples
    /// --------
    /// >>> table = percuss.sweep("speed.toml", out="kept")
    /// >>> table.study.indices("kept") is None
    /// True
    fn indices(&self, py: Python<'_>, directory: PathBuf) -> PyResult<Option<Vec<u8>>> {
        work::indices(py, self.shared(), || self.folder(&directory))
    }

    /// `report.html` of the results in a directory.
    ///
    /// Parameters
    /// ----------
    /// directory : str or path
    ///     Where a sweep was kept.
    ///
    /// Returns
    /// -------
    /// str
    ///     HTML.
    ///
    /// Raises
    /// ------
    /// InputError
    ///     If the results are not there.
    ///
    /// Examples
    /// --------
    /// >>> table = percuss.sweep("speed.toml", out="kept")
    /// >>> "The bag, from 1 to 9 m/s" in table.study.report("kept")
    /// True
    fn report(&self, py: Python<'_>, directory: PathBuf) -> PyResult<String> {
        work::report(py, self.shared(), self.folder(&directory)?)
    }

    /// Columns of a table of the study that has been kept, whichever version of the program computed it.
    ///
    /// Parameters
    /// ----------
    /// bytes : bytes
    ///     The content of `results.parquet`.
    ///
    /// Returns
    /// -------
    /// list of tuple
    ///     As of `results`.
    ///
    /// Raises
    /// ------
    /// InputError
    ///     If it is damaged, or the table of another study.
    ///
    /// Examples
    /// --------
    /// >>> table = percuss.sweep("speed.toml", out="kept")
    /// >>> with open(table.path, "rb") as file:
    /// ...     len(table.study.columns(file.read()))
    /// 15
    fn columns<'py>(&self, py: Python<'py>, bytes: &[u8]) -> PyResult<Bound<'py, PyList>> {
        work::table(py, self.shared(), bytes.to_vec())
    }

    /// Columns of `results.parquet` in a directory.
    ///
    /// Parameters
    /// ----------
    /// directory : str or path
    ///     Where a sweep was kept.
    ///
    /// Returns
    /// -------
    /// list of tuple
    ///     Name, unit, role, what it is, and values of shape (n_run,), each in its SI unit.
    ///
    /// Raises
    /// ------
    /// InputError
    ///     If the results are not there.
    ///
    /// Examples
    /// --------
    /// >>> table = percuss.sweep("speed.toml", out="kept")
    /// >>> [column[0] for column in table.study.results("kept")][:3]
    /// ['run', 'speed', 'peak_force']
    fn results<'py>(&self, py: Python<'py>, directory: PathBuf) -> PyResult<Bound<'py, PyList>> {
        work::columns(py, self.shared(), self.folder(&directory)?)
    }
}
