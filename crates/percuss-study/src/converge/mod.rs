//! How far results depend on step and mesh: the run repeated on finer ones, orders, limits, and the cheapest settings for an
//! accuracy.

mod cheapest;
mod results;
mod sequence;

pub use cheapest::Cheapest;
pub use sequence::{Extrapolation, extrapolate};

use percuss::{Fault, Flow, Model, Recorder, RunSummary, Settings, Simulation, Termination};
use percuss_codes::AnalysisCode;
use percuss_output::{SummaryPath, pick};
use percuss_scenario::{Diagnostics, Scenario};

use results::paths;

/// Products of steps and elements that one run may have; about a quarter of an hour.
const MOST_WORK: f64 = 5e8;
/// Growth from one level to the next that no sequence with a limit keeps up.
const GROWS: f64 = 1.3;

/// What is refined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refined {
    /// The step of time.
    Step,
    /// The elements of every beam.
    Mesh,
}

/// What to look at, and how far.
#[derive(Clone, Debug)]
pub struct Ladder {
    /// Paths in the summary; the usual results if there are none.
    pub results: Vec<String>,
    /// Levels, each twice as fine as the one before, the given settings first; three at least.
    pub levels: usize,
    /// Relative accuracy for which the cheapest settings are wanted.
    pub accuracy: Option<f64>,
}

/// A result on finer steps, or meshes.
#[derive(Clone, Debug, PartialEq)]
pub struct Sequence {
    /// Values, coarsest first; NaN where a run lacks the result.
    pub values: Vec<f64>,
    /// Order, limit and uncertainty.
    pub found: Extrapolation,
    /// What it means, in plain words.
    pub words: String,
    /// Why there can be no limit, where that is known.
    pub no_limit: bool,
}

/// A result and what it converges to.
#[derive(Clone, Debug, PartialEq)]
pub struct Converged {
    /// Path in the summary.
    pub path: String,
    /// SI unit.
    pub unit: String,
    /// Value under the given settings.
    pub value: f64,
    /// Limit in step and mesh together; NaN where there is none.
    pub limit: f64,
    /// Its uncertainty.
    pub uncertainty: f64,
    /// On finer steps.
    pub step: Sequence,
    /// On finer meshes.
    pub mesh: Sequence,
}

/// How the results of a scenario converge.
#[derive(Clone, Debug, PartialEq)]
pub struct Convergence {
    /// Steps of the levels \[s\].
    pub steps: Vec<f64>,
    /// Numbers of elements of the levels.
    pub elements: Vec<usize>,
    /// Results.
    pub results: Vec<Converged>,
    /// The cheapest settings for the accuracy wanted, if one is.
    pub cheapest: Option<Cheapest>,
}

/// Why there is no answer.
#[derive(Debug)]
pub enum ConvergeError {
    /// The scenario, or a path.
    Faults(Diagnostics),
    /// What was asked for cannot be done.
    Refused(String),
    /// A run did not reach its end: as what, and why.
    Run(AnalysisCode, String),
    /// Somebody asked to stop.
    Interrupted,
}

impl From<Diagnostics> for ConvergeError {
    fn from(faults: Diagnostics) -> Self {
        Self::Faults(faults)
    }
}

/// Listens for the wish to stop, and records nothing.
struct Ear<'a>(&'a dyn Fn() -> bool);

impl Recorder for Ear<'_> {
    fn wants_rows(&self) -> bool {
        false
    }

    fn progress(&mut self, _time: f64) -> Flow {
        if (self.0)() { Flow::Continue } else { Flow::Stop }
    }
}

/// Runs a scenario, then with halved steps and with doubled meshes, level after level.
///
/// `goes_on` is asked after every step; `tell` hears before each run how many of how many are done.
///
/// # Errors
/// Faults of scenario and paths, a ladder that costs too much, a run that fails, or the wish to stop.
pub fn converge(
    scenario: &Scenario,
    ladder: &Ladder,
    goes_on: &dyn Fn() -> bool,
    tell: &dyn Fn(usize, usize),
) -> Result<Convergence, ConvergeError> {
    if ladder.levels < 3 {
        return Err(ConvergeError::Refused("an order needs three levels or more".into()));
    }
    let compiled = scenario.compile()?;
    let (base, settings) = (&compiled.model, &compiled.settings);
    if settings.accuracy.is_some() {
        let why = "`time.accuracy` chooses steps as it goes, and what is halved here is one that is given: give a `time.step`";
        return Err(ConvergeError::Refused(why.into()));
    }
    let finest = 2_f64.powi(ladder.levels as i32 - 1);
    let work = finest * settings.step_count() as f64 * base.element_count().max(1) as f64;
    if work > MOST_WORK {
        return Err(ConvergeError::Refused(format!(
            "the finest runs would have {work:.1e} steps times elements, more than {MOST_WORK:.0e}: \
             use fewer levels, a coarser start or a shorter run"
        )));
    }
    let has_mesh = base.element_count() > 0;
    let runs = 1 + (ladder.levels - 1) * if has_mesh { 2 } else { 1 };
    tell(0, runs);
    let first = completed(base, settings, goes_on)?;
    let paths = paths(scenario, &ladder.results, &first)?;
    let (mut by_step, mut by_mesh) = (vec![pick(&paths, &first)], vec![pick(&paths, &first)]);
    let (mut steps, mut elements) = (vec![settings.step], vec![base.element_count()]);
    for level in 1..ladder.levels {
        let factor = 2_u32.pow(level as u32);
        let finer = Settings { step: settings.step / f64::from(factor), ..*settings };
        tell(by_step.len() + by_mesh.len() - 1, runs);
        by_step.push(pick(&paths, &completed(base, &finer, goes_on)?));
        steps.push(finer.step);
        if has_mesh {
            let model = finer_mesh(scenario, factor)?;
            tell(by_step.len() + by_mesh.len() - 1, runs);
            by_mesh.push(pick(&paths, &completed(&model, settings, goes_on)?));
            elements.push(model.element_count());
        }
    }
    let results: Vec<Converged> = paths
        .iter()
        .enumerate()
        .map(|(k, path)| {
            let of = |all: &[Vec<f64>]| alike(path, all.iter().map(|run| run[k]).collect());
            let why = Why { path: path.path(), model: base, summary: &first };
            let step = why.sequence(Refined::Step, of(&by_step));
            let mesh = why.sequence(Refined::Mesh, of(&by_mesh));
            both(path, step, mesh)
        })
        .collect();
    let cheapest =
        ladder.accuracy.map(|accuracy| Cheapest::of(&results, accuracy, &steps, &elements));
    Ok(Convergence { steps, elements, results, cheapest })
}

/// Values of one result. What is largest in magnitude may be so in either direction, at two supports say, and which of them wins is
/// chance: its magnitudes are compared, with the sign of the first.
fn alike(path: &SummaryPath, mut values: Vec<f64>) -> Vec<f64> {
    if path.path().contains("_max.") {
        let sign = values[0].signum();
        values.iter_mut().for_each(|value| *value = value.abs() * sign);
    }
    values
}

/// A result from both of its sequences: their errors add up.
fn both(path: &SummaryPath, step: Sequence, mesh: Sequence) -> Converged {
    let value = step.values[0];
    let none = step.no_limit || mesh.no_limit;
    let limit = step.found.limit + mesh.found.limit - value;
    let uncertainty = step.found.uncertainty + mesh.found.uncertainty;
    Converged {
        path: path.path().into(),
        unit: path.unit().into(),
        value,
        limit: if none { f64::NAN } else { limit },
        uncertainty: if none { f64::NAN } else { uncertainty },
        step,
        mesh,
    }
}

fn completed(
    model: &Model,
    settings: &Settings,
    goes_on: &dyn Fn() -> bool,
) -> Result<RunSummary, ConvergeError> {
    if !goes_on() {
        return Err(ConvergeError::Interrupted);
    }
    let told = |faults: Vec<Fault>| {
        let texts: Vec<String> = faults.iter().map(ToString::to_string).collect();
        ConvergeError::Refused(texts.join("; "))
    };
    let summary = Simulation::new(model, settings).map_err(told)?.run(&mut Ear(goes_on));
    match &summary.termination {
        Termination::Completed => Ok(summary),
        Termination::Interrupted { .. } => Err(ConvergeError::Interrupted),
        Termination::Failed(error) => {
            let (step, elements) = (settings.step, model.element_count());
            let text = format!("with a step of {step:e} s and {elements} elements: {error}");
            Err(ConvergeError::Run(error.code(), text))
        }
        Termination::Unsolved => {
            Err(ConvergeError::Run(AnalysisCode::Broken, "a run was not made".into()))
        }
    }
}

/// The same scenario with so many times the elements on every beam.
fn finer_mesh(scenario: &Scenario, factor: u32) -> Result<Model, ConvergeError> {
    let mut fine = scenario.clone();
    let factor = f64::from(factor);
    for beam in &scenario.content().beam {
        let path = |key: &str| format!("beam.{}.{key}", beam.name);
        let mut set = |key: &str, value: f64| {
            let told = |fault: Fault| ConvergeError::Refused(fault.to_string());
            let field = fine.field(&path(key)).map_err(told)?;
            fine.set_number(&field, value).map_err(told)
        };
        if let Some(elements) = beam.table.elements {
            set("elements", elements as f64 * factor)?;
        }
        if let Some(length) = beam.table.element_length {
            set("element_length", length / factor)?;
        }
    }
    Ok(fine.compile()?.model)
}

/// What is known of a result beside its values.
struct Why<'a> {
    path: &'a str,
    model: &'a Model,
    summary: &'a RunSummary,
}

impl Why<'_> {
    fn sequence(&self, refined: Refined, values: Vec<f64>) -> Sequence {
        let found = match values[..] {
            // Nothing of the kind to refine: it takes no part in what is uncertain.
            [limit] => Extrapolation { order: None, limit, uncertainty: 0.0, constant: true },
            _ => extrapolate(&values),
        };
        let reason = match refined {
            Refined::Step => self.impulsive(&values),
            Refined::Mesh => self.on_a_bare_node(),
        };
        let no_limit = reason.is_some() && !found.constant;
        let words = match reason {
            Some(reason) if no_limit => reason,
            _ => words(refined, &values, &found),
        };
        Sequence { values, found, words, no_limit }
    }

    /// Forces of rigid impacts are impulses spread over a step: they grow as it shrinks.
    fn impulsive(&self, values: &[f64]) -> Option<String> {
        let is_force =
            ["section_forces.", "support."].iter().any(|part| self.path.starts_with(part));
        let struck = self.summary.contacts.iter().any(|contact| {
            matches!(&contact.record, percuss::ContactRecord::Nonsmooth { impact_count, .. } if *impact_count > 0)
        });
        let grows = values.windows(2).all(|pair| pair[1].abs() > GROWS * pair[0].abs());
        (is_force && struck && grows).then(|| {
            "grows as the step shrinks: a rigid impact is an impulse, and this force has no limit".into()
        })
    }

    /// What a rigid projectile does to a point whose effective mass is that of the mesh.
    fn on_a_bare_node(&self) -> Option<String> {
        let masses = self.model.effective_masses();
        let contacts = self.summary.contacts.iter().zip(masses);
        let bare = contacts.into_iter().find(|(contact, mass)| {
            let rigid = matches!(contact.record, percuss::ContactRecord::Nonsmooth { .. });
            let own =
                [format!("contact.{}.", contact.name), format!("projectile.{}.", contact.name)];
            rigid
                && mass.depends_on_mesh()
                && own.iter().any(|part| self.path.starts_with(part.as_str()))
        });
        bare.map(|(_, mass)| {
            format!(
                "depends on the mesh: the struck point answers a rigid blow with {:.3e} kg here, with {:.3e} kg on ever \
                 finer meshes; give the contact a local_mass or a compliance of its own",
                mass.on_mesh, mass.limit
            )
        })
    }
}

/// What a sequence means.
fn words(refined: Refined, values: &[f64], found: &Extrapolation) -> String {
    let name = match refined {
        Refined::Step => "step",
        Refined::Mesh => "mesh",
    };
    if values.len() < 3 {
        return format!("there is no {name} to refine");
    }
    if values.iter().any(|value| !value.is_finite()) {
        return format!("not every {name} has this result");
    }
    if found.constant {
        return format!("does not depend on the {name}");
    }
    let percent = |x: f64| {
        let share = 100.0 * (x / found.limit).abs();
        match share {
            _ if !share.is_finite() => format!("{x:.2e}"),
            _ if share >= 0.01 => format!("{share:.2} %"),
            _ => format!("{share:.0e} %"),
        }
    };
    match found.order {
        Some(order) => format!(
            "converges with order {order:.2}: this {name} is off by {}",
            percent(values[0] - found.limit)
        ),
        None => format!(
            "no order observed: it still moves by {} between finer ones",
            percent(found.uncertainty)
        ),
    }
}
