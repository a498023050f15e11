//! A scenario file from disk, with the changes of `--set`, ready to run.

use std::io::IsTerminal;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, OnceLock, PoisonError};
use std::time::Duration;

use percuss::{Fault, mechanisms};
use percuss_codes::RequestCode;
use percuss_scenario::{
    Compiled, Diagnostics, FileAccess, Scenario, load_with, read_bytes, read_in_time, read_with,
};

use crate::memory;
use crate::outcome::Failure;

/// Standard input that gives nothing for so long will not.
const PATIENCE: Duration = Duration::from_secs(10);

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
    memory::refuse(&name(file), &scenario.extent())?;
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
            None => Err(Failure::input(
                RequestCode::NoBeam,
                format!(
                    "this scenario has no beams, and {what} of discs alone are not computed; use `percuss run`"
                ),
            )),
        }
    }

    /// Faults that an analysis found, each with its place in the file.
    pub fn refuse(&self, faults: Vec<Fault>, changes: &[String]) -> Failure {
        let faults = Box::new(self.scenario.diagnostics(faults));
        Failure::Faults { faults, changed: !changes.is_empty() }
    }
}

/// What `--allow-outside` says, of all scenarios of the command.
static ACCESS: OnceLock<FileAccess> = OnceLock::new();

/// Scenarios may name files outside their folders.
pub fn allow_outside() {
    let _ = ACCESS.set(FileAccess::Anywhere);
}

/// Which files scenarios may name.
pub fn access() -> FileAccess {
    ACCESS.get().copied().unwrap_or_default()
}

/// Text of a file, or of standard input for `-`. That, a pipe or a device can be read only once and is kept.
///
/// # Errors
/// What the system says.
pub fn text(file: &Path) -> std::io::Result<String> {
    static INPUT: Mutex<Option<Result<String, String>>> = Mutex::new(None);
    if is_plain(file) {
        return std::fs::read_to_string(file);
    }
    let mut kept = INPUT.lock().unwrap_or_else(PoisonError::into_inner);
    let read = || text_once(file).map_err(|error| error.to_string());
    kept.get_or_insert_with(read).clone().map_err(std::io::Error::other)
}

fn text_once(file: &Path) -> std::io::Result<String> {
    let bytes = match is_input(file) {
        // Whoever types takes his time.
        true if std::io::stdin().is_terminal() => std::io::read_to_string(std::io::stdin())?.into(),
        true => read_in_time(|| Ok(std::io::stdin()), PATIENCE)?,
        false => read_bytes(file)?,
    };
    String::from_utf8(bytes).map_err(|_| std::io::Error::other("it is not UTF-8"))
}

/// Whether a file can be read as often as one likes, or not at all.
fn is_plain(file: &Path) -> bool {
    let special = |m: std::fs::Metadata| !m.is_file() && !m.is_dir();
    !is_input(file) && !std::fs::metadata(file).is_ok_and(special)
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
        Err(error) if !is_plain(file) => {
            let found = format!("what cannot be read: {error}");
            return Err(Diagnostics::of_file(&name, found, "the text of a scenario"));
        }
        // What is no text is left to `load`, which says why; what it can read after all lacks the changes.
        Err(error) => {
            let found = || format!("a file that cannot be read ({error})");
            let other = || Diagnostics::of_file(&name, found(), "a readable file");
            return Err(load_with(file, access()).err().unwrap_or_else(other));
        }
    };
    match percuss_scenario::apply_overrides(&text, &name, changes) {
        Ok(text) => read_with(&text, &name, access()),
        // Syntax errors keep changes from being made; `read` reports more than these.
        Err(faults) if faults.name() == name => {
            Err(read_with(&text, &name, access()).err().unwrap_or(faults))
        }
        Err(faults) => Err(faults),
    }
}
