//! A scenario file from disk, with the changes of `--set`, ready to run.

use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

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

/// Where the results of `file` go unless the user says otherwise: `runs/<file stem><suffix>`, `runs/stdin<suffix>` for `-`.
pub fn results(file: &Path, suffix: &str) -> PathBuf {
    let stem = if is_input(file) { Some("stdin".as_ref()) } else { file.file_stem() };
    let mut name = stem.unwrap_or("run".as_ref()).to_owned();
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

    /// Refuses a scene without beams, which has no static equilibrium and no modes of its own.
    ///
    /// # Errors
    /// If there is no beam.
    pub fn refuse_without_beam(&self, what: &str) -> Result<(), Failure> {
        match self.compiled.model.beam_names().next() {
            Some(_) => Ok(()),
            None => Err(Failure::Input(format!(
                "there is no beam in this scene: {what} are those of beams; `percuss run` simulates it"
            ))),
        }
    }

    /// Faults that an analysis found, each with its place in the file.
    pub fn refuse(&self, faults: Vec<Fault>, changes: &[String]) -> Failure {
        let faults = Box::new(self.scenario.diagnostics(faults));
        Failure::Faults { faults, changed: !changes.is_empty() }
    }
}

/// Text of a file, or of standard input for `-`; that can be read only once and is kept.
///
/// # Errors
/// What the system says.
pub fn text(file: &Path) -> std::io::Result<String> {
    static INPUT: Mutex<Option<String>> = Mutex::new(None);
    if !is_input(file) {
        return std::fs::read_to_string(file);
    }
    let mut kept = INPUT.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(text) = &*kept {
        return Ok(text.clone());
    }
    let text = std::io::read_to_string(std::io::stdin())?;
    *kept = Some(text.clone());
    Ok(text)
}

/// Whether a scenario comes from standard input; files that it names then lie from the working directory on.
pub fn is_input(file: &Path) -> bool {
    file == Path::new("-")
}

/// What a file is called in messages.
pub fn name(file: &Path) -> String {
    if is_input(file) { "standard input".into() } else { file.display().to_string() }
}

fn changed(file: &Path, changes: &[String]) -> Result<Scenario, Diagnostics> {
    let name = name(file);
    let text = match text(file) {
        Ok(text) => text,
        Err(error) if is_input(file) => {
            let found = format!("what cannot be read: {error}");
            return Err(Diagnostics::of_file(&name, found, "the text of a scenario"));
        }
        // What is no text is left to `load`, which says why.
        Err(_) => return percuss_scenario::load(file),
    };
    match percuss_scenario::apply_overrides(&text, &name, changes) {
        Ok(text) => percuss_scenario::read(&text, &name),
        // Syntax errors keep changes from being made; `read` reports more than these.
        Err(faults) if faults.name() == name => {
            Err(percuss_scenario::read(&text, &name).err().unwrap_or(faults))
        }
        Err(faults) => Err(faults),
    }
}
