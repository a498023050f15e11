//! Steps chosen for an accuracy: the requested accuracy is reached, and balance errors are those of constant steps.

use crate::common;

use common::*;
use percuss::*;

/// The paper's clamped plank, struck in the middle.
fn struck(shot: impl Fn(PointRef) -> Projectile) -> Model {
    let mut b = ModelBuilder::new();
    let (material, section) = plank(&mut b);
    let girder = b.beam(beam("girder", [0.0, 0.0], [3.0, 0.0], 6, material, section));
    for (name, f) in [("left", 0.0), ("right", 1.0)] {
        b.support(Support::new(name, at(name, girder, f), SupportKind::Clamp));
    }
    b.projectile(shot(at("mid", girder, 0.5)));
    b.build().unwrap()
}

fn soft() -> Model {
    struck(|mid| elastic("mass", mid, [0.0, 20.0]))
}

fn hard() -> Model {
    struck(|mid| rigid("hammer", mid, [0.0, 40.0], 0.5))
}

fn accurate(model: &Model, end: f64, accuracy: f64) -> Settings {
    Settings { accuracy: Some(accuracy), ..Settings::new(end, first_step(model, end)) }
}

fn run(model: &Model, settings: &Settings) -> RunSummary {
    let summary = simulate(model, settings, &mut NoRecorder).unwrap();
    assert!(matches!(summary.termination, Termination::Completed), "{summary:?}");
    assert!(summary.energy.residual_max < 1e-10, "{:e}", summary.energy.residual_max);
    assert!(summary.momentum.linear_residual_max < 1e-10);
    assert!(summary.momentum.angular_residual_max < 1e-10);
    summary
}

fn deflection(summary: &RunSummary) -> f64 {
    summary.points[0].displacement_max[1].value
}

fn peak_force(summary: &RunSummary) -> f64 {
    match &summary.contacts[0].record {
        ContactRecord::Smooth { peak_force, .. } => peak_force.value,
        ContactRecord::Nonsmooth { .. } => panic!("an elastic projectile"),
    }
}

fn off(found: f64, converged: f64) -> f64 {
    (found / converged - 1.0).abs()
}

#[test]
fn peaks_of_an_elastic_impact_are_as_accurate_as_asked_for() {
    let model = soft();
    let converged = run(&model, &Settings::new(0.15, 2e-5));
    let (force, way) = (peak_force(&converged), deflection(&converged));
    let mut before = f64::INFINITY;
    for accuracy in [0.04, 0.02, 0.01, 0.005] {
        let summary = run(&model, &accurate(&model, 0.15, accuracy));
        let errors = [off(peak_force(&summary), force), off(deflection(&summary), way)];
        assert!(errors.iter().all(|e| *e <= accuracy), "{errors:?} at {accuracy}");
        // For half the accuracy the error is smaller.
        assert!(errors[0] < before, "{errors:?} after {before} at {accuracy}");
        before = errors[0];
        let control = summary.step_control.unwrap();
        assert!(control.estimate <= accuracy, "{control:?}");
        assert_eq!(control.steps, summary.steps);
        assert!(summary.steps < 250, "{control:?}");
    }
}

#[test]
fn deflections_under_rigid_impacts_are_as_accurate_as_asked_for() {
    let model = hard();
    let converged = run(&model, &Settings::new(0.02, 1e-6));
    for accuracy in [0.02, 0.005] {
        let summary = run(&model, &accurate(&model, 0.02, accuracy));
        let error = off(deflection(&summary), deflection(&converged));
        assert!(error <= accuracy, "{error} at {accuracy}");
    }
}

#[test]
fn steps_follow_the_motion() {
    let model = soft();
    let summary = run(&model, &accurate(&model, 0.15, 0.01));
    let control = summary.step_control.unwrap();
    assert!(control.refused > 0, "the blow comes unforeseen: {control:?}");
    assert!(control.smallest <= control.mean && control.mean <= control.largest);
    assert!(control.largest > 10.0 * control.smallest, "{control:?}");
    assert!((control.mean * summary.steps as f64 / 0.15 - 1.0).abs() < 1e-12);
    assert_eq!(summary.time, 0.15);
}

/// Time and all of a row, bit by bit.
fn bits(rows: &MemoryRecorder) -> Vec<u64> {
    rows.values.iter().map(|value| value.to_bits()).collect()
}

#[test]
fn a_run_that_goes_on_from_a_checkpoint_takes_the_same_steps() {
    for model in [soft(), hard()] {
        let settings = accurate(&model, 0.02, 0.01);
        let mut whole = MemoryRecorder::default();
        let first = simulate(&model, &settings, &mut whole).unwrap();
        let mut again = MemoryRecorder::default();
        simulate(&model, &settings, &mut again).unwrap();
        assert_eq!(bits(&whole), bits(&again));

        let mut part = Simulation::new(&model, &settings).unwrap();
        for _ in 0..first.steps / 2 {
            part.advance(&mut NoRecorder).unwrap();
        }
        let resumed = Simulation::resume(&model, &settings, part.checkpoint()).unwrap();
        let end = resumed.run(&mut NoRecorder);
        assert_eq!(end.step_control, first.step_control);
        assert_eq!(end.points, first.points);
        // Steps of one size cannot continue from it.
        let given = Settings { accuracy: None, ..settings };
        let foreign = Simulation::resume(&model, &given, part.checkpoint());
        assert_eq!(foreign.err(), Some(ResumeError::Foreign));
    }
}

/// Keeps the last checkpoint of a run, from which it can be extended, and the rows up to it.
#[derive(Default)]
struct Extendable {
    rows: MemoryRecorder,
    kept: Option<(Checkpoint, usize)>,
}

impl Recorder for Extendable {
    fn begin(&mut self, channels: &[Channel]) -> Result<(), RecorderError> {
        self.rows.begin(channels)
    }

    fn row(&mut self, values: &[f64]) -> Result<(), RecorderError> {
        self.rows.row(values)
    }

    fn wants_checkpoint(&mut self, _: bool) -> bool {
        true
    }

    fn checkpoint(&mut self, checkpoint: &Checkpoint) -> Result<(), RecorderError> {
        self.kept = Some((checkpoint.clone(), self.rows.values.len()));
        Ok(())
    }
}

/// A run with a later end is that with this end from the beginning, to the last bit: of the steps that the first end has shaped, refused ones
/// included, none is left.
#[test]
fn a_run_that_is_extended_takes_the_steps_of_the_longer_one() {
    let mut refused = 0;
    for model in [soft(), hard()] {
        let long = accurate(&model, 0.02, 0.01);
        let mut whole = MemoryRecorder::default();
        let expected = simulate(&model, &long, &mut whole).unwrap();
        for k in 1..40 {
            let short = Settings { end: 0.02 * f64::from(k) / 41.0, ..long };
            let mut run = Extendable::default();
            let first = simulate(&model, &short, &mut run).unwrap();
            let (checkpoint, kept) = run.kept.take().unwrap();
            refused += first.step_control.unwrap().refused;
            let mut rows = run.rows.values[..kept].to_vec();
            let mut rest = MemoryRecorder::default();
            let extended = Simulation::resume(&model, &long, checkpoint).unwrap().run(&mut rest);
            rows.extend(rest.values);
            assert_eq!(rows.len(), whole.values.len(), "end {}", short.end);
            assert!(rows.iter().zip(&whole.values).all(|(a, b)| a.to_bits() == b.to_bits()));
            let contacts = [&extended, &expected].map(|run| format!("{:?}", run.contacts));
            assert_eq!(contacts[0], contacts[1], "end {}", short.end);
            assert_eq!(extended.step_control, expected.step_control, "end {}", short.end);
        }
    }
    assert!(refused > 0);
}

#[test]
fn steps_that_were_refused_leave_nothing_in_fibres() {
    let mut b = ModelBuilder::new();
    let plasticity = Plasticity {
        curve: vec![Hardening { from: 0.0, stress: 250e6, modulus: 0.0 }],
        kinematic: 0.0,
        overstress: None,
        failure_strain: None,
    };
    let material = b.material(Material {
        strain: StrainMeasure::Engineering,
        inelasticity: Some(Inelasticity::Plastic(plasticity)),
        ..Material::new("steel", 205e9, 7850.0)
    });
    let section = b.section(Section::rectangle("plank", 0.1, 0.1));
    let girder = b.beam(beam("girder", [0.0, 0.0], [3.0, 0.0], 6, material, section));
    for (name, f) in [("left", 0.0), ("right", 1.0)] {
        b.support(Support::new(name, at(name, girder, f), SupportKind::Clamp));
    }
    b.projectile(elastic("mass", at("mid", girder, 0.5), [0.0, 20.0]));
    let model = b.build().unwrap();
    let summary = run(&model, &accurate(&model, 0.05, 0.01));
    assert!(summary.step_control.unwrap().refused > 0 && summary.energy.plastic > 0.0);
    let converged = run(&model, &Settings::new(0.05, 1e-5));
    assert!(off(summary.energy.plastic, converged.energy.plastic) < 0.02);
}

#[test]
fn settings_that_exclude_an_accuracy_are_faults() {
    let model = soft();
    let good = accurate(&model, 0.1, 0.01);
    let time_stepping = ImpactResolution::TimeStepping { closed_tolerance: 1e-9 };
    for (settings, path, found) in [
        (Settings { accuracy: Some(0.0), ..good }, "time.accuracy", "0"),
        (Settings { accuracy: Some(0.5), ..good }, "time.accuracy", "0.5"),
        (Settings { accuracy: Some(f64::NAN), ..good }, "time.accuracy", "NaN"),
        (Settings { impacts: time_stepping, ..good }, "time.accuracy", "evaluated once per step"),
        (Settings { scheme: Scheme::Newmark, ..good }, "time.accuracy", "advances accelerations"),
    ] {
        let faults = Simulation::new(&model, &settings).err().unwrap();
        let reported = faults.iter().any(|f| f.path == path && f.found.contains(found));
        assert!(reported, "{faults:?}");
    }
}

/// A steel cantilever of 2 m under its weight, and what else belongs to it.
fn cantilever(more: impl FnOnce(&mut ModelBuilder, BeamId), gravity: bool) -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("steel", 2.1e11, 7850.0));
    let section = b.section(Section::rectangle("s", 0.06, 0.04));
    let own = b.beam(beam("a", [0.0, 0.0], [2.0, 0.0], 16, material, section));
    b.support(Support::new("left", at("left", own, 0.0), SupportKind::Clamp));
    if gravity {
        b.load(Load::new("weight", LoadKind::Gravity { acceleration: [0.0, -9.81] }));
    }
    b.record_point(at("tip", own, 1.0));
    more(&mut b, own);
    b.build().unwrap()
}

/// A ball bounces on a floor while steps are those of a slow vibration: its peak force is `K (5 m v^2 / 4 K)^(3/5)` in every contact.
#[test]
fn peaks_of_short_contacts_are_as_accurate_as_asked_for() {
    let (mass, stiffness, fall) = (1.0, 1e9, 0.07);
    let model = cantilever(
        |b, _| {
            let shape = ObstacleShape::HalfPlane { point: [0.0, -1.0], normal: [0.0, 1.0] };
            let floor = b.obstacle(Obstacle { name: "floor".into(), shape, motion: None });
            let ball = b.disc(disc("ball", mass, 0.03, [5.0, -0.97 + fall], [0.0, -1.0]));
            let law = SmoothLaw::elastic(Potential::Hertz { stiffness });
            let between = [ContactPartner::Disc(ball), ContactPartner::Obstacle(floor)];
            b.contact(Contact::new("bounce", between, TouchLaw::Smooth(law)));
        },
        true,
    );
    let speed_squared = 1.0 + 2.0 * 9.81 * fall;
    let peak = stiffness * (1.25 * mass * speed_squared / stiffness).powf(0.6);
    for accuracy in [0.1, 0.05, 0.01] {
        let found = peak_force(&run(&model, &accurate(&model, 1.0, accuracy)));
        assert!(off(found, peak) < accuracy, "{found} for {peak} at {accuracy}");
    }
}

/// What rests in equilibrium moves by round-off, which needs no short steps.
#[test]
fn a_structure_at_rest_takes_few_steps() {
    let model = cantilever(|_, _| {}, true);
    let settings = Settings { start: Start::Static, ..accurate(&model, 0.1, 0.01) };
    let control = run(&model, &settings).step_control.unwrap();
    assert!(control.steps < 200 && control.is_reached(), "{control:?}");
}

/// A driven obstacle that strikes a beam at rest: before the impact there is neither energy nor deflection to which errors are relative.
#[test]
fn a_driven_obstacle_strikes_a_beam_at_rest() {
    let model = cantilever(
        |b, own| {
            let shape = ObstacleShape::Disc { centre: [1.9, 0.13], radius: 0.1 };
            let function = TimeFunction::Ramp { duration: 0.02 };
            let motion = Some(Motion { displacement: [0.0, -0.06], rotation: 0.0, function });
            let hammer = b.obstacle(Obstacle { name: "hammer".into(), shape, motion });
            let law = SmoothLaw::elastic(Potential::Linear { stiffness: 1e8 });
            let between = [ContactPartner::Beam(own), ContactPartner::Obstacle(hammer)];
            b.contact(Contact::new("blow", between, TouchLaw::Smooth(law)));
        },
        false,
    );
    let summary = run(&model, &accurate(&model, 0.05, 0.01));
    let control = summary.step_control.unwrap();
    assert!(control.is_reached() && control.estimate < 0.02, "{control:?}");
    let converged = run(&model, &Settings::new(0.05, 2e-6));
    assert!(off(peak_force(&summary), peak_force(&converged)) < 0.01);
}
