//! Studies for Python: their shards, wherever they are run, and the table at the end.

mod methods;

use std::path::Path;
use std::sync::Arc;

use percuss_scenario::FileAccess;
use percuss_study::Folder;
use pyo3::exceptions::PyIndexError;
use pyo3::prelude::*;

use crate::error::{Refusal, study_error};
use crate::watch::{Stop, Watch};

/// A study that has been read; it needs no file any more.
///
/// Parameters
/// ----------
/// text : str
///     The text of a study file.
/// name : str
///     Name of the file in messages; the scenario it names is relative to its folder.
/// allow_outside : bool
///     Let it name files that lie anywhere.
///
/// Raises
/// ------
/// ScenarioError
///     If it has faults: all of them.
///
/// Examples
/// --------
/// >>> with open("speed.toml") as file:
/// ...     percuss.Study(file.read(), "speed.toml")
/// <percuss.Study The bag, from 1 to 9 m/s: 9 runs>
#[pyclass(frozen, module = "percuss._percuss")]
pub struct Study {
    inner: Arc<percuss_study::Study>,
}

impl Study {
    /// A study from its text.
    ///
    /// # Errors
    /// All faults of it.
    fn read(py: Python<'_>, text: &str, name: &str, allow_outside: bool) -> PyResult<Self> {
        let access = if allow_outside { FileAccess::Anywhere } else { FileAccess::OwnFolder };
        let (text, name) = (text.to_owned(), name.to_owned());
        let work = move |_: &Stop| percuss_study::Study::from_toml_with(&text, &name, access);
        let read = Watch::default().run(py, work)?;
        read.map(|inner| Self { inner: Arc::new(inner) })
            .map_err(|faults| Refusal::Faults(faults).exception(py))
    }

    /// The study of the core.
    pub(crate) fn inner(&self) -> &percuss_study::Study {
        &self.inner
    }

    /// The same for another thread.
    pub(crate) fn shared(&self) -> Arc<percuss_study::Study> {
        Arc::clone(&self.inner)
    }

    /// The number of a shard.
    ///
    /// # Errors
    /// If there is none of that number.
    fn known(&self, index: u64) -> PyResult<u64> {
        let count = self.inner.shard_count();
        let fault = || PyIndexError::new_err(format!("shard {index} of {count}"));
        (index < count).then_some(index).ok_or_else(fault)
    }

    /// The directory of its shards and results.
    ///
    /// # Errors
    /// If it cannot be written, or belongs to something else.
    fn folder(&self, directory: &Path) -> PyResult<Folder> {
        Folder::open(directory, &self.inner).map_err(|error| study_error(&error))
    }
}
