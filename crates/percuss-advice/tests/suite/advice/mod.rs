//! What the advisor says before a run and after it: warnings where results mislead, and none where they do not.

mod after_runs;
mod beams;
mod durations;
mod properties;
mod starts;

use crate::common;

use common::{at, disc};
use percuss::*;
use percuss_advice::*;

fn bar(b: &mut ModelBuilder, length: f64, elements: usize, [width, depth]: [f64; 2]) -> BeamId {
    let section = Section::rectangle("bar", width, depth);
    of_section(b, length, elements, section)
}

fn of_section(b: &mut ModelBuilder, length: f64, elements: usize, section: Section) -> BeamId {
    let material = b.material(Material::new("steel", 2.1e11, 7850.0));
    let section = b.section(section);
    b.beam(Beam::new("beam", &[[0.0, 0.0], [length, 0.0]], elements, material, section))
}

fn hold(b: &mut ModelBuilder, beam: BeamId, kind: &SupportKind, ends: &[f64]) {
    for end in ends {
        b.support(Support::new(format!("at {end}"), at("end", beam, *end), kind.clone()));
    }
}

fn mass(strikes: PointRef, mass: f64, stiffness: f64, velocity: [f64; 2]) -> Projectile {
    Projectile::new("mass", ProjectileKind::spring(stiffness), mass, velocity, strikes)
}

fn freeze(b: &ModelBuilder) -> Model {
    b.build().unwrap_or_else(|faults| panic!("{faults:?}"))
}

fn run(model: &Model, settings: &Settings) -> RunSummary {
    simulate(model, settings, &mut NoRecorder).unwrap_or_else(|faults| panic!("{faults:?}"))
}

fn verdict(all: &[Advice], topic: Topic) -> Option<Verdict> {
    all.iter().filter(|a| a.topic == topic).map(|a| a.verdict).max()
}

/// Duration reported, and that of the run's first contact.
fn durations(b: &ModelBuilder, settings: &Settings) -> [f64; 2] {
    let model = freeze(b);
    let reported = advise(&model, settings)
        .iter()
        .find(|a| a.topic == Topic::ContactDuration)
        .map(|a| a.value);
    let found = match &run(&model, settings).contacts[0].record {
        ContactRecord::Smooth { intervals, .. } => intervals.first().map(|i| i.end - i.start),
        ContactRecord::Nonsmooth { .. } => None,
    };
    [reported.unwrap_or(f64::NAN), found.unwrap_or(f64::NAN)]
}
