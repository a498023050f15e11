//! Which runs are made: each direction refined alone, and all of them at once.

use percuss::{Fault, Model, RunSummary, Section, Settings};
use percuss_scenario::Scenario;

use super::converged::ConvergeError;

/// Products of steps and elements that one run may have; about a quarter of an hour.
const MOST_WORK: f64 = 5e8;
/// Levels with everything refined that are run whatever they cost, once the finest run of three such levels may be made: an order needs three.
const LEAST_TOGETHER: usize = 3;
/// What a fibre costs, as a share of an elastic element: one of sixteen fibres takes some ten times as long.
const FIBRE_COST: f64 = 0.6;

/// A run: how many times finer than given its step, elements and fibres are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Rung {
    pub step: u32,
    pub mesh: u32,
    pub fibres: u32,
}

/// The runs beside the given one, shape (levels but the first) each.
#[derive(Clone, Debug)]
pub(super) struct Rungs {
    /// On finer steps, shape (levels but the first).
    pub step: Vec<Rung>,
    /// On finer meshes, shape (levels but the first).
    pub mesh: Vec<Rung>,
    /// On more fibres, shape (levels but the first).
    pub fibres: Vec<Rung>,
    /// On finer steps and meshes and more fibres at once, shape (levels but the first).
    pub together: Vec<Rung>,
    levels: usize,
    /// Steps times elements of the given run.
    work: f64,
    /// Fibres of the section with the most; one where no section yields.
    most_fibres: usize,
}

impl Rungs {
    /// Of a scenario in which nothing yields.
    ///
    /// # Errors
    /// What the finest runs would cost, if that is too much.
    pub fn of(
        scenario: &Scenario,
        model: &Model,
        settings: &Settings,
        levels: usize,
    ) -> Result<Self, ConvergeError> {
        let has_mesh = model.element_count() > 0;
        let work = settings.step_count() as f64 * model.element_count().max(1) as f64;
        let together = if has_mesh { factor(2 * (LEAST_TOGETHER - 1)) } else { 1 };
        let finest = f64::from(factor(levels - 1).max(together)) * work;
        if finest > MOST_WORK {
            return Err(ConvergeError::Refused(format!(
                "the finest runs would have {finest:.1e} steps times elements, more than {MOST_WORK:.0e}: \
                 use fewer levels, a coarser start or a shorter run"
            )));
        }
        let given = Rung { step: 1, mesh: 1, fibres: 1 };
        let alone = |of: fn(u32, Rung) -> Rung| (1..levels).map(|k| of(factor(k), given)).collect();
        let mut rungs = Self {
            step: alone(|step, given| Rung { step, ..given }),
            mesh: if has_mesh { alone(|mesh, given| Rung { mesh, ..given }) } else { Vec::new() },
            fibres: Vec::new(),
            together: Vec::new(),
            levels,
            work,
            most_fibres: scenario
                .clone()
                .with_tables_of_profiles()
                .content()
                .section
                .iter()
                .map(|s| s.table.fibres)
                .max()
                .unwrap_or(1),
        };
        rungs.settle_together(false);
        Ok(rungs)
    }

    /// With what the given run shows: whether fibres count.
    pub fn after(mut self, first: &RunSummary) -> Self {
        if !first.plastic.iter().any(|beam| beam.first_yield.is_some()) {
            self.most_fibres = 1;
            return self;
        }
        let alone = (1..self.levels).map(|k| Rung { step: 1, mesh: 1, fibres: factor(k) });
        let within = |rung: &Rung| self.most_fibres * rung.fibres as usize <= Section::MOST_FIBRES;
        let alone: Vec<Rung> = alone.take_while(within).collect();
        // One change tells no order; refined with step and mesh they count all the same.
        self.fibres = if alone.len() + 1 < LEAST_TOGETHER { Vec::new() } else { alone };
        self.settle_together(true);
        self
    }

    /// How many runs there are.
    pub fn runs(&self) -> usize {
        1 + [&self.step, &self.mesh, &self.fibres, &self.together]
            .map(Vec::len)
            .iter()
            .sum::<usize>()
    }

    /// Steps of the levels \[s\], from the given one.
    pub fn steps(&self, given: f64) -> Vec<f64> {
        levels(&self.step, |rung| given / f64::from(rung.step), given)
    }

    /// Numbers of elements of the levels.
    pub fn elements(&self, model: &Model) -> Vec<usize> {
        let given = model.element_count();
        levels(&self.mesh, |rung| given * rung.mesh as usize, given)
    }

    /// Fibres of the section with the most, of the levels.
    pub fn fibre_counts(&self) -> Vec<usize> {
        levels(&self.fibres, |rung| self.most_fibres * rung.fibres as usize, self.most_fibres)
    }

    /// The runs in which everything is refined: as many levels as of each alone if they do not cost too much.
    fn settle_together(&mut self, yields: bool) {
        let all = |k: usize| {
            let [mesh, fibres] =
                [!self.mesh.is_empty(), yields].map(|is| if is { factor(k) } else { 1 });
            Rung { step: factor(k), mesh, fibres }
        };
        let cost = |rung: Rung| {
            let fibres = if yields {
                (self.most_fibres * rung.fibres as usize).min(Section::MOST_FIBRES)
            } else {
                0
            };
            self.work
                * f64::from(rung.step)
                * f64::from(rung.mesh)
                * (1.0 + FIBRE_COST * fibres as f64)
        };
        let affordable = |k: &usize| *k < LEAST_TOGETHER || cost(all(*k)) <= MOST_WORK;
        self.together = match all(1) {
            Rung { mesh: 1, fibres: 1, .. } => Vec::new(),
            _ => (1..self.levels).take_while(affordable).map(all).collect(),
        };
    }
}

fn factor(level: usize) -> u32 {
    2_u32.pow(level as u32)
}

/// What the levels have, from the given one on.
fn levels<T>(rungs: &[Rung], of: impl Fn(&Rung) -> T, given: T) -> Vec<T> {
    std::iter::once(given).chain(rungs.iter().map(of)).collect()
}

impl Rung {
    /// The scenario with so many times the elements on every beam and, as far as sections take them, fibres through every section.
    ///
    /// # Errors
    /// What the scenario does not take.
    pub fn model(&self, scenario: &Scenario) -> Result<Model, ConvergeError> {
        let scenario = scenario.clone().with_tables_of_profiles();
        let mut fine = scenario.clone();
        let mut set = |path: String, value: f64| {
            let refused = |fault: Fault| ConvergeError::Refused(fault.to_string());
            let field = fine.field(&path).map_err(refused)?;
            fine.set_number(&field, value).map_err(refused)
        };
        let factor = f64::from(self.mesh);
        for beam in &scenario.content().beam {
            if let Some(elements) = beam.table.elements {
                set(format!("beam.{}.elements", beam.name), elements as f64 * factor)?;
            }
            if let Some(length) = beam.table.element_length {
                set(format!("beam.{}.element_length", beam.name), length / factor)?;
            }
        }
        for section in scenario.content().section.iter().filter(|_| self.fibres > 1) {
            let fibres = (section.table.fibres * self.fibres as usize).min(Section::MOST_FIBRES);
            set(format!("section.{}.fibres", section.name), fibres as f64)?;
        }
        Ok(fine.compile()?.model)
    }
}
