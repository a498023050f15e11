//! The same scenario under other restitution coefficients, for the figure that compares energies.

use percuss::{Simulation, Termination};
use percuss_codes::Code;
use percuss_output::ComparisonSeries;
use percuss_scenario::content::ProjectileKind;

use super::recorder::{EnergyRecorder, EnergySeries};
use crate::progress::Progress;
use crate::scenario::Ready;

/// Coefficients compared where the scenario says nothing.
const COEFFICIENTS: [f64; 3] = [1.0, 0.5, 0.0];
/// Without `[report] restitution` only runs of at most so many steps times elements are compared.
const MOST_WORK: usize = 200_000;

/// The runs of a comparison.
pub struct Comparison<'a> {
    /// The scenario.
    pub ready: &'a Ready,
    /// Whether to show a progress bar.
    pub shows_progress: bool,
}

impl Comparison<'_> {
    /// Total energies for each coefficient; those of the run itself, `own`, are taken for its own.
    /// Nothing if the user interrupts. Those that failed are warned of, by `warn`.
    pub fn run(&self, own: &EnergySeries, warn: &mut dyn FnMut(String)) -> Vec<ComparisonSeries> {
        let own_coefficient = own_coefficient(self.ready);
        let mut all = Vec::new();
        for coefficient in coefficients(self.ready) {
            let label = format!("restitution {coefficient}");
            let energy = match own_coefficient {
                Some(same) if same == coefficient => Ok(own.clone()),
                _ => self.one(coefficient, &label),
            };
            match energy {
                Ok(EnergySeries { time, energy, .. }) => {
                    all.push(ComparisonSeries { label, time, energy });
                }
                Err(Termination::Interrupted { .. }) => return Vec::new(),
                Err(Termination::Failed(error)) => {
                    let error = Code::from(error.code()).behind(error);
                    warn(format!("{label} is missing from the comparison: {error}"));
                }
                Err(_) => warn(format!("{label} is missing from the comparison")),
            }
        }
        all
    }

    fn one(&self, coefficient: f64, label: &str) -> Result<EnergySeries, Termination> {
        let other = self.ready.scenario.with_restitution(coefficient);
        let compiled = other.compile().map_err(|_| Termination::Unsolved)?;
        let simulation = Simulation::new(&compiled.model, &compiled.settings)
            .map_err(|_| Termination::Unsolved)?;
        let progress = Progress::of_settings(label.into(), &compiled.settings, self.shows_progress);
        let mut recorder = EnergyRecorder { energy: EnergySeries::default(), progress };
        match simulation.run(&mut recorder).termination {
            Termination::Completed => Ok(recorder.energy),
            other => Err(other),
        }
    }
}

/// Whether the energies of the run itself are part of its comparison.
pub fn has_part_for(ready: &Ready) -> bool {
    own_coefficient(ready).is_some_and(|own| coefficients(ready).contains(&own))
}

/// The coefficients to compare; none without a rigid projectile.
fn coefficients(ready: &Ready) -> Vec<f64> {
    let compiled = &ready.compiled;
    let rigid = |p: &ProjectileKind| matches!(p, ProjectileKind::Rigid { .. });
    if !ready.scenario.content().projectile.iter().any(|p| rigid(&p.table.kind)) {
        return Vec::new();
    }
    if let Some(given) = &compiled.comparison {
        return given.clone();
    }
    let steps = Simulation::new(&compiled.model, &compiled.settings).map_or(0, |s| s.step_count());
    let work = steps.saturating_mul(compiled.model.element_count());
    if work <= MOST_WORK { COEFFICIENTS.into() } else { Vec::new() }
}

/// The coefficient of every rigid projectile, if it is the same.
fn own_coefficient(ready: &Ready) -> Option<f64> {
    let mut all = ready.scenario.content().projectile.iter().filter_map(|p| match p.table.kind {
        ProjectileKind::Rigid { restitution } => Some(restitution),
        ProjectileKind::Elastic { .. } => None,
    });
    let first = all.next()?;
    all.all(|other| other == first).then_some(first)
}
