//! A scenario ready to run: text, changes and functions in, model and settings out.

use std::time::SystemTime;

use percuss::{Fault, mechanisms};
use percuss_advice::{Advice, Verdict};
use percuss_output::RunSource;
use percuss_scenario::{
    Adds, Compiled, Diagnostics, FileAccess, Scenario, apply_changes, read_with,
};
use pyo3::prelude::*;

use crate::error::Refusal;
use crate::given::Given;
use crate::watch::{Stop, Watch};

/// What a Python scenario hands over: its text, its name in messages (files that it names lie where it lies), changes as paths with
/// values in TOML, functions behind paths, whether it may name files outside its folder, shape (changes).
#[derive(Debug, FromPyObject)]
pub struct Source(String, String, Vec<(String, String)>, Given, bool);

/// What keywords that change a scenario are called in messages.
const CHANGES: &str = "changes of the scenario";

/// Origin of a run, known to another thread.
#[derive(Debug)]
pub struct Origin {
    scenario: String,
    /// Changes, each as `path=value`, shape (changes).
    overrides: Vec<String>,
}

impl Origin {
    /// Origin of a run that starts now.
    pub fn started_now(&self) -> RunSource<'_> {
        let Self { scenario, overrides } = self;
        RunSource { scenario, overrides, started: SystemTime::now() }
    }
}

/// A scenario and what it compiles to.
#[derive(Debug)]
pub struct Ready {
    pub scenario: Scenario,
    pub compiled: Compiled,
}

impl Source {
    /// Reads and compiles, and does work with it while signals are looked for. What a function of the user's raised comes out as it is.
    ///
    /// # Errors
    /// What a function or the handler of a signal raised, `ScenarioError` with every fault, and what the work refuses.
    pub fn attend<T: Send + 'static>(
        self,
        py: Python<'_>,
        work: impl FnOnce(&Ready, &Stop) -> Result<T, Refusal> + Send + 'static,
    ) -> PyResult<T> {
        self.attend_reporting(py, work, |_| Ok(()))
    }

    /// The same; `tell` is called some times a second, and what it raises ends the work.
    ///
    /// # Errors
    /// As [`Source::attend`], and what `tell` raised.
    pub fn attend_reporting<T: Send + 'static>(
        self,
        py: Python<'_>,
        work: impl FnOnce(&Ready, &Stop) -> Result<T, Refusal> + Send + 'static,
        tell: impl FnMut(Python<'_>) -> PyResult<()> + Send,
    ) -> PyResult<T> {
        let raised = self.3.raised().clone();
        let watch = Watch { stop: raised.stop.clone(), calls_python: !self.3.is_empty() };
        let work = move |stop: &Stop| {
            let ready = self.compile()?;
            if stop.is_wanted() { Err(Refusal::Stopped) } else { work(&ready, stop) }
        };
        let done = watch.run_reporting(py, work, tell);
        match raised.take() {
            Some(error) => Err(error),
            None => done?.map_err(|refusal| refusal.exception(py)),
        }
    }

    /// Origin of a run of it.
    pub fn origin(&self) -> Origin {
        let overrides = self.2.iter().map(|(path, value)| format!("{path}={value}"));
        Origin { scenario: self.1.clone(), overrides: overrides.collect() }
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

/// A warning of the model checks: contact, topic, text, code.
pub type Warned = (String, &'static str, String, &'static str);

impl Ready {
    /// The warnings among findings, without those that the scenario allows.
    pub fn warnings(&self, mut found: Vec<Advice>) -> Vec<Warned> {
        percuss_advice::allow(&mut found, |code| self.scenario.content().reason_to_allow(code));
        let warnings = found.into_iter().filter(|one| one.verdict == Verdict::Warning);
        warnings.map(|one| (one.contact, one.topic.name(), one.text, one.topic.code())).collect()
    }

    /// Faults that an analysis found, each with its place in the text.
    pub fn refuse(&self, faults: Vec<Fault>) -> Refusal {
        self.scenario.diagnostics(faults).into()
    }

    /// Refuses a structure that can move without being strained: it has no static equilibrium.
    ///
    /// # Errors
    /// The parts that can.
    pub fn refuse_mechanism(&self) -> Result<(), Refusal> {
        match mechanisms(&self.compiled.model) {
            loose if loose.is_empty() => Ok(()),
            loose => Err(self.refuse(loose)),
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
    source.attend(py, |ready, _| {
        let Compiled { model, settings, .. } = &ready.compiled;
        percuss::Simulation::new(model, settings).map_err(|faults| ready.refuse(faults))?;
        let mut advice = percuss_advice::advise(model, settings);
        let content = ready.scenario.content();
        percuss_advice::allow(&mut advice, |code| content.reason_to_allow(code));
        let said = advice.into_iter();
        let said = said.map(|a| (a.verdict.name(), a.contact, a.text, a.topic.code(), a.reason));
        Ok(said.collect())
    })
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
    source.attend(py, |ready, _| Ok(ready.scenario.to_toml()))
}
