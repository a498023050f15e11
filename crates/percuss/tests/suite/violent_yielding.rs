//! Random extreme scenes of beams that yield: complete energy balance and irreversible dissipation in every case.

use std::collections::BTreeMap;

use crate::common;

use common::numbers::Numbers;
use common::{at, beam, disc};
use percuss::*;

/// A metal with any of the hardening, rate, failure, viscosity and strain measures there are.
fn metal(r: &mut Numbers, brittle: bool) -> Material {
    let (young, density) = (r.decades(1e9, 2e11), r.between(1e3, 8e3));
    let stress = young * r.decades(3e-4, 1e-2);
    let modulus = |r: &mut Numbers| if r.chance(0.5) { 0.0 } else { young * r.decades(1e-4, 0.5) };
    let mut curve = vec![Hardening { from: 0.0, stress, modulus: modulus(r) }];
    if r.chance(0.4) {
        // A table: further parts, the last one perhaps flat.
        for _ in 0..1 + r.below(3) {
            let last = curve[curve.len() - 1];
            let length = r.decades(1e-4, 3e-2);
            let (from, stress) = (last.from + length, last.stress + last.modulus * length);
            let modulus = last.modulus * r.between(0.0, 1.0);
            curve.push(Hardening { from, stress, modulus });
        }
    }
    let overstress = r
        .chance(0.35)
        .then(|| Overstress { rate: r.decades(1.0, 1e4), exponent: r.between(1.0, 6.0) });
    let failure_strain = r.chance(0.35).then(|| r.decades(5e-3, 0.3).max(1.5 * stress / young));
    let failure_strain =
        if brittle { Some(r.decades(1.2, 10.0) * stress / young) } else { failure_strain };
    let kinematic = if r.chance(0.4) { modulus(r) } else { 0.0 };
    let plasticity = Plasticity { curve, kinematic, overstress, failure_strain };
    let engineering = r.chance(0.6);
    Material {
        strain: if engineering { StrainMeasure::Engineering } else { StrainMeasure::Green },
        retardation: if r.chance(0.2) { r.decades(1e-8, 1e-5) } else { 0.0 },
        inelasticity: Some(Inelasticity::Plastic(plasticity)),
        ..Material::new("metal", young, density)
    }
}

fn section(r: &mut Numbers) -> Section {
    let (width, depth) = (r.between(0.01, 0.05), r.decades(0.005, 0.08));
    let shape = match r.below(4) {
        0 => Section::circle("s", depth),
        1 => Section::tube("s", depth, 0.15 * depth),
        2 => Section::i_shape("s", width, depth, 0.1 * depth, 0.2 * width),
        _ => Section::rectangle("s", width, depth),
    };
    Section { fibres: 4 + 2 * r.below(5), ..shape }
}

/// Supports of the beam, and stops; whether anything holds it.
fn hold(b: &mut ModelBuilder, r: &mut Numbers, girder: BeamId) -> bool {
    let roller = SupportKind::Roller { direction: [1.0, 0.3] };
    let held: &[(f64, SupportKind)] = match r.below(5) {
        0 => &[],
        1 => &[(0.0, SupportKind::Clamp)],
        2 => &[(0.0, SupportKind::Pin), (1.0, roller)],
        3 => &[(0.0, SupportKind::Clamp), (1.0, SupportKind::Clamp)],
        _ => &[(0.0, SupportKind::Pin), (1.0, SupportKind::Pin)],
    };
    for (f, kind) in held {
        b.support(Support::new(format!("hold{f}"), at("held", girder, *f), kind.clone()));
    }
    let stops = r.chance(0.3);
    if stops {
        let stop = SupportKind::Stop {
            direction: [0.0, -1.0],
            gap: r.between(0.0, 0.05),
            stiffness: r.decades(1e5, 1e9),
            two_sided: r.chance(0.3),
        };
        b.support(Support::new("stop", at("stopped", girder, r.between(0.2, 0.9)), stop));
    }
    !held.is_empty() || stops
}

/// Projectiles, elastic and rigid, guided and free.
fn strike(b: &mut ModelBuilder, r: &mut Numbers, girder: BeamId, depth: f64) {
    for i in 0..1 + r.below(3) {
        let kind = if r.chance(0.5) {
            ProjectileKind::spring(r.decades(1e5, 1e9))
        } else {
            ProjectileKind::Rigid { restitution: r.next() }
        };
        let speed = r.decades(3.0, 200.0) * if r.chance(0.3) { 1.0 } else { -1.0 };
        let velocity = [r.between(-0.5, 0.5) * speed, speed];
        let strikes = at(&format!("p{i}"), girder, r.next());
        let mass = r.decades(0.05, 100.0);
        let standoff = if r.chance(0.5) { 0.0 } else { r.between(0.0, 0.02) };
        let shot = Projectile::new(format!("shot{i}"), kind, mass, velocity, strikes);
        b.projectile(Projectile { standoff, ..shot });
    }
    if r.chance(0.4) {
        let radius = r.between(0.02, 0.1);
        let centre = [r.between(0.1, 0.9), radius + 0.5 * depth + r.between(0.001, 0.02)];
        let velocity = [r.between(-30.0, 30.0), -r.decades(3.0, 200.0)];
        let ball = b.disc(disc("ball", r.decades(0.1, 30.0), radius, centre, velocity));
        let law = if r.chance(0.5) {
            let stiffness = r.decades(1e6, 1e9);
            TouchLaw::Smooth(SmoothLaw::elastic(Potential::Linear { stiffness }))
        } else {
            let friction = if r.chance(0.5) { 0.0 } else { r.next() };
            TouchLaw::Rigid(RigidLaw { friction, ..RigidLaw::frictionless(r.next()) })
        };
        let between = [ContactPartner::Disc(ball), ContactPartner::Beam(girder)];
        b.contact(Contact::new("touch", between, law));
    }
}

/// A scene and its settings; whether supports hold it.
struct Scene {
    model: Model,
    settings: Settings,
    held: bool,
    thrown: Option<[f64; 2]>,
}

fn scene(number: u64, brittle: bool) -> Scene {
    let mut r = Numbers(number.wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ 0x5851_F42D);
    // The first numbers of neighbouring seeds are alike.
    for _ in 0..8 {
        r.next();
    }
    let mut b = ModelBuilder::new();
    let (material, section) = (metal(&mut r, brittle), section(&mut r));
    let depth = section.depth.unwrap_or(0.0);
    let (material, section) = (b.material(material), b.section(section));
    let girder = b.beam(beam("girder", [0.0, 0.0], [1.0, 0.0], 3 + r.below(3), material, section));
    let held = hold(&mut b, &mut r, girder);
    strike(&mut b, &mut r, girder, depth);
    if r.chance(0.3) {
        let kind = LoadKind::Gravity { acceleration: [0.0, -9.81] };
        b.load(Load::new("weight", kind));
    }
    let thrown = r.chance(0.3).then(|| [r.between(-50.0, 50.0), r.between(-100.0, 100.0)]);
    let step = r.decades(3e-6, 4e-4);
    let count = 40 + r.below(61);
    let settings = Settings::new(step * count as f64, step);
    let model = b.build().unwrap_or_else(|faults| panic!("scene {number}: {faults:?}"));
    Scene { model, settings, held, thrown }
}

/// Largest magnitude in a column.
fn largest(rows: &MemoryRecorder, column: &str) -> f64 {
    let values = rows.column(column).unwrap_or_else(|| panic!("no column {column}"));
    values.iter().fold(0.0_f64, |most, x| most.max(x.abs()))
}

/// Runs a scene and checks every row of it.
fn run(number: u64, brittle: bool) -> RunSummary {
    let scene = scene(number, brittle);
    let mut run = Simulation::new(&scene.model, &scene.settings)
        .unwrap_or_else(|faults| panic!("scene {number}: {faults:?}"));
    if let Some(v) = scene.thrown {
        let at_an_end = |x: f64| !(1e-9..=1.0 - 1e-9).contains(&x);
        run.set_velocities(|_, x| {
            if scene.held && at_an_end(x[0]) { [0.0; 2] } else { v.map(|v| v * (1.0 + x[0])) }
        });
    }
    let mut rows = MemoryRecorder::default();
    let summary = run.run(&mut rows);
    for column in ["energy.plastic", "energy.failure"] {
        let values = rows.column(column).expect("a column of what yields");
        for (k, pair) in values.windows(2).enumerate() {
            let given = pair[0] - pair[1];
            let round_off = 1e-13 * summary.energy.scale;
            assert!(given <= round_off, "scene {number}, row {k}: {column} gives {given:e} J");
        }
    }
    let (linear, angular) = (summary.momentum.linear_scale, summary.momentum.angular_scale);
    for (column, scale) in [
        ("momentum.residual_1", linear),
        ("momentum.residual_2", linear),
        ("momentum.residual_angular", angular),
    ] {
        let residual = largest(&rows, column) / scale;
        assert!(residual < BOUND, "scene {number}: {column} {residual:e}");
    }
    summary
}

/// Scenes of the whole suite, and of a sample of it, the first ones.
fn scenes(all: u64) -> u64 {
    if common::whole() { all } else { all / 5 }
}

/// Of every balance, relative to its scale.
const BOUND: f64 = 1e-10;

/// A run without convergence ends in a step cut into ever smaller parts, usually where the axis of an element has zero length: its direction, which
/// is then undefined, has few digits. The bound of its energy is the same there, and that of its momenta up to the last row (4e-10 after it in one
/// scene).
#[test]
fn violent_scenes_account_for_all_energy() {
    let mut reasons: BTreeMap<&str, Vec<u64>> = BTreeMap::new();
    let (mut yielded, mut failed, mut struck) = (0, 0, 0);
    let scenes = scenes(500);
    for number in 0..scenes {
        let summary = run(number, false);
        let (energy, m) = (&summary.energy, &summary.momentum);
        assert!(energy.residual_max < BOUND, "scene {number}: {energy:?}");
        match &summary.termination {
            Termination::Completed => {
                let worst = m.linear_residual_max.max(m.angular_residual_max);
                assert!(worst < BOUND, "scene {number}: {m:?}");
            }
            Termination::Failed(error) => {
                println!("scene {number}: {error}");
                assert!(error.is_no_convergence(), "scene {number}: {error}");
                reasons.entry(error.code().code()).or_default().push(number);
            }
            other => panic!("scene {number}: {other:?}"),
        }
        yielded += usize::from(energy.plastic > 0.01 * energy.scale);
        failed += usize::from(summary.plastic[0].failed > 0);
        struck += usize::from(energy.loss_impacts > 0.0);
    }
    println!("{yielded} yielded, {failed} lost fibres, {struck} lost energy in impacts");
    println!("gave up: {reasons:?}");
    let share = |of: u64| (of * scenes / 500) as usize;
    // Of the first hundred scenes 67 yield, 19 lose fibres and 69 lose energy in impacts.
    let enough = yielded > share(250) && failed > share(75) && struck > share(250);
    assert!(enough, "{yielded} {failed} {struck}");
    // Seven of 500 when this was written.
    assert!(reasons.values().map(Vec::len).sum::<usize>() <= share(15), "{reasons:?}");
}

/// Scenes of beams that fail soon after yield: most fracture, many at several places, below the striking body and elsewhere.
#[test]
fn scenes_of_beams_that_part_account_for_all_energy() {
    let (mut parted, mut places, mut gave_up) = (0, 0, Vec::new());
    let scenes = scenes(300);
    for number in 0..scenes {
        let summary = run(number, true);
        let (energy, m) = (&summary.energy, &summary.momentum);
        assert!(energy.residual_max < BOUND, "scene {number}: {energy:?}");
        match &summary.termination {
            Termination::Completed => {
                let worst = m.linear_residual_max.max(m.angular_residual_max);
                assert!(worst < BOUND, "scene {number}: {m:?}");
            }
            Termination::Failed(error) => {
                println!("scene {number}: {error}");
                assert!(error.is_no_convergence(), "scene {number}: {error}");
                gave_up.push(number);
            }
            other => panic!("scene {number}: {other:?}"),
        }
        let own = &summary.plastic[0].parted;
        parted += usize::from(!own.is_empty());
        places += own.len();
        let released: f64 = own.iter().map(|one| one.energy).sum();
        assert!(released <= energy.failure + 1e-12 * energy.scale, "scene {number}: {own:?}");
    }
    println!("{parted} parted at {places} places; gave up: {gave_up:?}");
    let share = |of: u64| (of * scenes / 300) as usize;
    assert!(parted > share(150) && places > share(300), "{parted} {places}");
    assert!(gave_up.len() <= share(9), "{gave_up:?}");
}
