//! A scenario file from disk, with the changes of `--set`, ready to run.

use std::path::{Path, PathBuf};

use percuss::{Fault, mechanisms};
use percuss_scenario::{Compiled, Diagnostics, Scenario};

use crate::outcome::Failure;

/// A scenario and what it compiles to.
#[derive(Debug)]
pub struct Ready {
    /// The scenario.
    pub scenario: Scenario,
    /// Model and settings.
    pub compiled: Compiled,
}

/// Reads and compiles `file` with `changes` of the form `path=value` made to it.
///
/// # Errors
/// Every fault of the file or of the changes.
pub fn read(file: &Path, changes: &[String]) -> Result<Ready, Failure> {
    let failure =
        |faults| Failure::Faults { faults: Box::new(faults), changed: !changes.is_empty() };
    let scenario = changed(file, changes).map_err(failure)?;
    let compiled = scenario.compile().map_err(failure)?;
    Ok(Ready { scenario, compiled })
}

/// Where the results of `file` go unless the user says otherwise: `runs/<file stem><suffix>`.
pub fn results(file: &Path, suffix: &str) -> PathBuf {
    let mut name = file.file_stem().unwrap_or("run".as_ref()).to_owned();
    name.push(suffix);
    Path::new("runs").join(name)
}

impl Ready {
    /// Refuses a structure that can move without being strained: it has no static equilibrium.
    ///
    /// # Errors
    /// Every loose beam, with its place in the file.
    pub fn refuse_mechanism(&self, changes: &[String]) -> Result<(), Failure> {
        let loose = mechanisms(&self.compiled.model);
        if loose.is_empty() {
            return Ok(());
        }
        Err(self.refuse(loose, changes))
    }

    /// Faults that an analysis found, each with its place in the file.
    pub fn refuse(&self, faults: Vec<Fault>, changes: &[String]) -> Failure {
        let faults = Box::new(self.scenario.diagnostics(faults));
        Failure::Faults { faults, changed: !changes.is_empty() }
    }
}

fn changed(file: &Path, changes: &[String]) -> Result<Scenario, Diagnostics> {
    // What is no text is left to `load`, which says why.
    let Ok(text) = std::fs::read_to_string(file) else { return percuss_scenario::load(file) };
    let name = file.display().to_string();
    match percuss_scenario::apply_overrides(&text, &name, changes) {
        Ok(text) => percuss_scenario::read(&text, &name),
        // Syntax errors keep changes from being made; `read` reports more than these.
        Err(faults) if faults.name() == name => {
            Err(percuss_scenario::read(&text, &name).err().unwrap_or(faults))
        }
        Err(faults) => Err(faults),
    }
}
