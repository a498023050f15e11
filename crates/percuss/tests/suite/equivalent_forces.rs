//! Equivalent static forces: in nonlinear statics each has the effect of the run, or a reason tells why there is none.

use crate::common;

use common::*;
use percuss::*;

/// What acts on a structure: the projectile of a run, or a force in its place.
enum Action {
    Struck,
    Pushed(f64),
}

/// A structure with its struck point, and the direction of the impact.
struct Scene {
    beam: BeamId,
    at: f64,
    direction: [f64; 2],
    projectile: (f64, f64, f64),
}

impl Scene {
    fn finish(&self, mut b: ModelBuilder, action: Action) -> Model {
        let (point, [x, y]) = (at("struck", self.beam, self.at), self.direction);
        b.record_point(point.clone());
        match action {
            Action::Struck => {
                let (mass, stiffness, speed) = self.projectile;
                let kind = ProjectileKind::spring(stiffness);
                let velocity = [x * speed, y * speed];
                b.projectile(Projectile::new("striker", kind, mass, velocity, point));
            }
            Action::Pushed(force) => {
                let force = [x * force, y * force];
                let kind = LoadKind::Point { at: point, force, moment: 0.0, follower: false };
                b.load(Load::new("push", kind));
            }
        }
        b.build().unwrap()
    }
}

fn clamp(b: &mut ModelBuilder, name: &str, beam: BeamId, f: f64) {
    b.support(Support::new(name, at(name, beam, f), SupportKind::Clamp));
}

/// The force for the moment and that for the deflection, applied in statics, reproduce those of the run.
fn reproduces(
    name: &str,
    settings: Settings,
    build: impl Fn(Action, bool) -> Model,
) -> EquivalentForce {
    let run = simulate(&build(Action::Struck, false), &settings, &mut NoRecorder).unwrap();
    let contact = &run.contacts[0];
    let why = contact.no_equivalent_force.clone();
    let found = contact.equivalent_force.unwrap_or_else(|| panic!("{name}: {why:?}"));
    let elastic = found.as_if_elastic;
    let under = |force: f64| equilibrium(&build(Action::Pushed(force), elastic)).unwrap();
    let by_moment = under(found.moment.unwrap()).section_forces[0].moment.largest().value.abs();
    let moment = run.section_forces[0].moment.largest().value.abs();
    assert!((by_moment / moment - 1.0).abs() < 1e-6, "{name}: {by_moment} {moment}");
    let side = if found.on_rebound { -1.0 } else { 1.0 };
    let moved = under(side * found.deflection.unwrap()).points[0].1;
    let peak = run.points[0].displacement_max;
    let along = [0, 1].map(|k| peak[k].value);
    let k = usize::from(moved[1].abs() > moved[0].abs());
    assert!((moved[k] / along[k] - 1.0).abs() < 1e-6, "{name}: {moved:?} {along:?}");
    found
}

#[test]
fn a_clamped_beam_in_large_deflection() {
    let found = reproduces("clamped", Settings::new(0.15, 1e-4), |action, _| {
        let mut b = ModelBuilder::new();
        let (material, section) = plank(&mut b);
        let girder = b.beam(beam("girder", [0.0, 0.0], [3.0, 0.0], 6, material, section));
        clamp(&mut b, "left", girder, 0.0);
        clamp(&mut b, "right", girder, 1.0);
        let projectile = (500.0, 7.5e5, 20.0);
        let direction = [0.0, 1.0];
        Scene { beam: girder, at: 0.5, direction, projectile }.finish(b, action)
    });
    // By linear elasticity 357.7 and 210.7 kN.
    let (moment, deflection) = (found.moment.unwrap(), found.deflection.unwrap());
    assert!((moment / 969.5e3 - 1.0).abs() < 5e-3, "{moment}");
    assert!((deflection / 670.7e3 - 1.0).abs() < 5e-3, "{deflection}");
}

#[test]
fn a_cantilever_that_bends_far() {
    let found = reproduces("cantilever", Settings::new(0.4, 2e-4), |action, _| {
        let mut b = ModelBuilder::new();
        let material =
            Material { strain: StrainMeasure::Engineering, ..Material::new("s", 2e11, 7850.0) };
        let material = b.material(material);
        let section = b.section(Section::rectangle("strip", 0.05, 0.01));
        let arm = b.beam(beam("arm", [0.0, 0.0], [1.0, 0.0], 10, material, section));
        clamp(&mut b, "root", arm, 0.0);
        let projectile = (20.0, 1e5, 6.0);
        Scene { beam: arm, at: 1.0, direction: [0.0, -1.0], projectile }.finish(b, action)
    });
    assert!(found.moment.unwrap() > 0.0 && !found.beside_loads);
}

#[test]
fn a_roof_load_acts_beside_the_force() {
    let settings = Settings { start: Start::Static, ..Settings::new(0.3, 5e-4) };
    let found = reproduces("roof", settings, |action, _| {
        let mut b = ModelBuilder::new();
        let material = b.material(Material::new("steel", 2.1e11, 7850.0));
        let section = b.section(Section::rectangle("bar", 0.1, 0.2));
        let girder = b.beam(beam("girder", [0.0, 0.0], [6.0, 0.0], 12, material, section));
        clamp(&mut b, "left", girder, 0.0);
        let roller = SupportKind::Roller { direction: [1.0, 0.0] };
        b.support(Support::new("right", at("right", girder, 1.0), roller));
        b.load(Load::new("weight", LoadKind::Gravity { acceleration: [0.0, -9.81] }));
        let force = [[0.0, -20e3]; 2];
        let stretch = [Along::Fraction(0.0), Along::Fraction(1.0)];
        let kind = LoadKind::Distributed { beam: girder, stretch, force, follower: false };
        b.load(Load::new("roof", kind));
        let projectile = (300.0, 1e6, 8.0);
        Scene { beam: girder, at: 0.5, direction: [0.0, -1.0], projectile }.finish(b, action)
    });
    assert!(found.beside_loads && !found.as_if_elastic);
}

#[test]
fn a_yielding_beam_has_the_force_of_the_elastic_one() {
    let found = reproduces("yielding", Settings::new(0.2, 2e-4), |action, elastic| {
        let plasticity = Plasticity {
            curve: vec![Hardening { from: 0.0, stress: 235e6, modulus: 0.0 }],
            kinematic: 0.0,
            overstress: None,
            failure_strain: None,
        };
        let mut b = ModelBuilder::new();
        let inelasticity = (!elastic).then_some(Inelasticity::Plastic(plasticity));
        let material = b.material(Material { inelasticity, ..Material::new("m", 2.1e11, 7850.0) });
        let section = b.section(Section::rectangle("s", 0.05, 0.05));
        let girder = b.beam(beam("girder", [0.0, 0.0], [2.0, 0.0], 8, material, section));
        b.support(Support::new("a", at("a", girder, 0.0), SupportKind::Pin));
        let roller = SupportKind::Roller { direction: [1.0, 0.0] };
        b.support(Support::new("z", at("z", girder, 1.0), roller));
        let projectile = (40.0, 1e5, 6.0);
        Scene { beam: girder, at: 0.5, direction: [0.0, -1.0], projectile }.finish(b, action)
    });
    assert!(found.as_if_elastic);
}

#[test]
fn a_stop_behind_a_gap_takes_part() {
    reproduces("stop", Settings::new(0.1, 1e-4), |action, _| {
        let mut b = ModelBuilder::new();
        let material = b.material(Material::new("steel", 2.1e11, 7850.0));
        let section = b.section(Section::rectangle("bar", 0.05, 0.05));
        let pipe = b.beam(beam("pipe", [0.0, 0.0], [2.0, 0.0], 8, material, section));
        clamp(&mut b, "left", pipe, 0.0);
        let kind =
            SupportKind::Stop { direction: [0.0, 1.0], gap: 5e-3, stiffness: 1e6, two_sided: true };
        b.support(Support::new("bracket", at("bracket", pipe, 1.0), kind));
        let projectile = (20.0, 1e6, 10.0);
        Scene { beam: pipe, at: 0.5, direction: [0.0, 1.0], projectile }.finish(b, action)
    });
}

/// A shallow arch that the impact takes through: no static force has its deflection.
#[test]
fn an_arch_that_snaps_through_has_none() {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("steel", 2.1e11, 7850.0));
    let section = b.section(Section::rectangle("strip", 0.04, 0.004));
    let points = [[0.0, 0.0], [0.5, 0.03], [1.0, 0.0]];
    let arch = b.beam(Beam::new("arch", &points, 16, material, section));
    for (name, f) in [("left", 0.0), ("right", 1.0)] {
        b.support(Support::new(name, at(name, arch, f), SupportKind::Pin));
    }
    let scene = Scene { beam: arch, at: 0.5, direction: [0.0, -1.0], projectile: (1.0, 1e5, 20.0) };
    let model = scene.finish(b, Action::Struck);
    let run = simulate(&model, &Settings::new(0.05, 2e-5), &mut NoRecorder).unwrap();
    let contact = &run.contacts[0];
    assert!(run.points[0].displacement_max[1].value < -0.04, "it snaps through");
    match (contact.equivalent_force, &contact.no_equivalent_force) {
        (Some(found), _) => {
            let why = found.deflection.unwrap_err();
            assert!(matches!(why, NoEquivalentForce::LimitPoint { .. }), "{why:?}");
        }
        (None, why) => assert!(why.as_ref().unwrap().contains("snaps through"), "{why:?}"),
    }
}

/// Without a contact there is no effect of an impact to be equivalent to.
#[test]
fn a_projectile_that_does_not_arrive_has_no_equivalent_force() {
    let mut b = ModelBuilder::new();
    let (material, section) = plank(&mut b);
    let girder = b.beam(beam("girder", [0.0, 0.0], [3.0, 0.0], 6, material, section));
    clamp(&mut b, "left", girder, 0.0);
    let kind = ProjectileKind::spring(7.5e5);
    let striker = Projectile::new("striker", kind, 500.0, [0.0, -1.0], at("tip", girder, 1.0));
    b.projectile(Projectile { standoff: 1.0, ..striker });
    let run = simulate(&b.build().unwrap(), &Settings::new(0.1, 1e-3), &mut NoRecorder).unwrap();
    let contact = &run.contacts[0];
    assert!(!contact.record.has_closed() && contact.equivalent_force.is_none());
    assert_eq!(contact.no_equivalent_force.as_deref(), Some("the contact did not close"));
}
