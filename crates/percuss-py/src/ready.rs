//! A scenario ready to run: text, changes and functions in, model and settings out.

use std::time::SystemTime;

use percuss::{Fault, mechanisms};
use percuss_output::RunSource;
use percuss_scenario::{
    Adds, Compiled, Diagnostics, FileAccess, Scenario, apply_changes, read_with,
};
use pyo3::prelude::*;

use crate::error::scenario_error;
use crate::given::Given;

/// What a Python scenario hands over: its text, its name in messages (files that it names lie where it lies), changes as paths with
/// values in TOML, functions behind paths, whether it may name files outside its folder, shape (changes).
#[derive(Debug, FromPyObject)]
pub struct Source(String, String, Vec<(String, String)>, Given, bool);

/// What keywords that change a scenario are called in messages.
const CHANGES: &str = "changes of the scenario";

/// A scenario and what it compiles to.
#[derive(Debug)]
pub struct Ready {
    pub scenario: Scenario,
    pub compiled: Compiled,
}

impl Source {
    /// Reads and compiles.
    ///
    /// # Errors
    /// `ScenarioError` with every fault.
    pub fn ready(&self, py: Python<'_>) -> PyResult<Ready> {
        py.detach(|| self.compile()).map_err(|faults| scenario_error(py, &faults))
    }

    /// What a function of the user's raised, if one did.
    pub fn raised(&self) -> Option<PyErr> {
        self.3.raised()
    }

    /// Origin of a run that starts now.
    pub fn run_source(&self) -> RunSource<'_> {
        RunSource { scenario: &self.1, overrides: &self.2, started: SystemTime::now() }
    }

    /// Functions behind paths.
    pub fn given(&self) -> &Given {
        &self.3
    }

    fn compile(&self) -> Result<Ready, Diagnostics> {
        let scenario = self.read()?.with_given(self.3.to_core());
        let compiled = scenario.compile()?;
        Ok(Ready { scenario, compiled })
    }

    fn read(&self) -> Result<Scenario, Diagnostics> {
        let Self(text, name, changes, _, outside) = self;
        let access = if *outside { FileAccess::Anywhere } else { FileAccess::OwnFolder };
        match apply_changes(text, [name, CHANGES], changes, Adds::Fixed) {
            Ok(text) => read_with(&text, name, access),
            // Syntax errors keep changes from being made; `read` reports more than these.
            Err(faults) if faults.name() == name => {
                Err(read_with(text, name, access).err().unwrap_or(faults))
            }
            Err(faults) => Err(faults),
        }
    }
}

impl Ready {
    /// Faults that an analysis found, each with its place in the text.
    pub fn refuse(&self, py: Python<'_>, faults: Vec<Fault>) -> PyErr {
        scenario_error(py, &self.scenario.diagnostics(faults))
    }

    /// Refuses a structure that can move without being strained: it has no static equilibrium.
    pub fn refuse_mechanism(&self, py: Python<'_>) -> PyResult<()> {
        match mechanisms(&self.compiled.model) {
            loose if loose.is_empty() => Ok(()),
            loose => Err(self.refuse(py, loose)),
        }
    }
}

/// What the advisor says: verdict, contact, text, code, reason why it is allowed.
type Said = (&'static str, String, String, &'static str, Option<String>);

/// What the advisor says.
///
/// Parameters
/// ----------
/// source : tuple
///     What `Scenario._source` gives.
///
/// Returns
/// -------
/// list of tuple
///     Verdict, contact, text, code, and the reason why it is allowed or None.
///
/// Raises
/// ------
/// ScenarioError
///     If anything is wrong: every fault.
///
/// Examples
/// --------
/// >>> percuss._percuss.check(percuss.load("plank.toml")._source())[0][:2]
/// ('fine', '...')
#[pyfunction]
pub fn check(py: Python<'_>, source: Source) -> PyResult<Vec<Said>> {
    let ready = source.ready(py)?;
    let Compiled { model, settings, .. } = &ready.compiled;
    percuss::Simulation::new(model, settings).map_err(|faults| ready.refuse(py, faults))?;
    let mut advice = py.detach(|| percuss_advice::advise(model, settings));
    percuss_advice::allow(&mut advice, |code| ready.scenario.content().reason_to_allow(code));
    source.raised().map_or(Ok(()), Err)?;
    Ok(advice
        .into_iter()
        .map(|a| (a.verdict.name(), a.contact, a.text, a.topic.code(), a.reason))
        .collect())
}

/// The scenario as a file with every default written out.
///
/// Parameters
/// ----------
/// source : tuple
///     What `Scenario._source` gives.
///
/// Returns
/// -------
/// str
///     TOML, in SI units.
///
/// Raises
/// ------
/// ScenarioError
///     If anything is wrong: every fault.
///
/// Examples
/// --------
/// >>> "gravity" in percuss._percuss.written(percuss.load("plank.toml")._source())
/// False
#[pyfunction]
pub fn written(py: Python<'_>, source: Source) -> PyResult<String> {
    Ok(source.ready(py)?.scenario.to_toml())
}
