//! Violent scenes of beams that yield, drawn at random: whatever happens, energy is accounted for, and what is dissipated is gone.

use std::collections::BTreeMap;

use crate::common;

use common::{at, beam, disc};
use percuss::*;

/// Numbers that look random, the same every time.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 33) as f64 / (1_u64 << 31) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    /// Evenly over the logarithm.
    fn decades(&mut self, low: f64, high: f64) -> f64 {
        10_f64.powf(self.between(low.log10(), high.log10()))
    }

    fn chance(&mut self, share: f64) -> bool {
        self.next() < share
    }

    fn below(&mut self, count: usize) -> usize {
        (self.next() * count as f64) as usize
    }
}

/// A metal with any of the hardening, rate, failure, viscosity and strain measures there are.
fn metal(r: &mut Numbers) -> Material {
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

fn scene(number: u64) -> Scene {
    let mut r = Numbers(number.wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ 0x5851_F42D);
    (0..8).for_each(|_| drop(r.next()));
    let mut b = ModelBuilder::new();
    let (material, section) = (metal(&mut r), section(&mut r));
    let depth = section.depth.unwrap_or(0.0);
    let (material, section) = (b.material(material), b.section(section));
    let girder =
        b.beam(beam("girder", [0.0, 0.0], [1.0, 0.0], 3 + r.below(3), material, section));
    let held = hold(&mut b, &mut r, girder);
    strike(&mut b, &mut r, girder, depth);
    let heavy = r.chance(0.3);
    if heavy {
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

/// Runs a scene and looks at every row of it.
fn run(number: u64) -> (Scene, RunSummary) {
    let scene = scene(number);
    let mut run = Simulation::new(&scene.model, &scene.settings)
        .unwrap_or_else(|faults| panic!("scene {number}: {faults:?}"));
    if let Some(v) = scene.thrown {
        let ends = |x: f64| scene.held && !(1e-9..=1.0 - 1e-9).contains(&x);
        run.set_velocities(|_, x| {
            if ends(x[0]) { [0.0; 2] } else { v.map(|v| v * (1.0 + x[0])) }
        });
    }
    let mut rows = MemoryRecorder::default();
    let summary = run.run(&mut rows);
    let scale = summary.energy.scale;
    let residual = rows.column("energy.residual").expect("a column of every run");
    let largest = residual.iter().fold(0.0_f64, |m, x| m.max(x.abs())) / scale;
    assert!(largest < 1e-10, "scene {number}: {largest:e}");
    for column in ["energy.plastic", "energy.failure"] {
        let values = rows.column(column).expect("a column of what yields");
        for (k, pair) in values.windows(2).enumerate() {
            let gain = pair[0] - pair[1];
            assert!(gain <= 1e-13 * scale, "scene {number}, row {k}: {column} gives {gain:e} J");
        }
    }
    (scene, summary)
}

const SCENES: u64 = 500;

pub fn all() { inner() }
pub fn trace(n: u64) {
    let scene = scene(n);
    println!("{:?} thrown {:?} material {:?}", scene.settings, scene.thrown, metal(&mut { let mut r = Numbers(n.wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ 0x5851_F42D); (0..8).for_each(|_| drop(r.next())); r }));
    let mut run = Simulation::new(&scene.model, &scene.settings).unwrap();
    if let Some(v) = scene.thrown {
        let ends = |x: f64| scene.held && !(1e-9..=1.0 - 1e-9).contains(&x);
        run.set_velocities(|_, x| if ends(x[0]) { [0.0; 2] } else { v.map(|v| v * (1.0 + x[0])) });
    }
    let mut last = 0.0;
    while run.state().step < run.step_count() {
        let r = run.advance(&mut NoRecorder);
        let l = &run.state().ledger;
        let res = l.energy_residual(run.measures());
        let m = run.measures();
        let st: Vec<String> = run.state().displacement.iter().map(|u| format!("{:.3}", (1.0 + u[2]).hypot(u[3]))).collect();
        if (res - last).abs() > 3e-12 * l.energy_scale || r.is_err() { println!("step {} t {:.6e} res {:.2e} change {:.2e} kinetic {:.3e} axial {:.3e} bending {:.3e} hard {:.3e} contact {:.3e} plastic {:.3e} failure {:.3e} lin {:?} stretch {:?}", run.state().step, run.state().time, res / l.energy_scale, (res - last) / l.energy_scale, m.kinetic_beams / l.energy_scale, m.strain_axial/ l.energy_scale, m.strain_bending / l.energy_scale, m.hardening / l.energy_scale, m.contact / l.energy_scale, l.loss_plastic / l.energy_scale, l.loss_failure / l.energy_scale, l.linear_residual(m).map(|x| x / l.linear_scale), st); }
        last = res;
        if let Err(e) = r { println!("{e}"); break; }
    }
}
pub fn one(n: u64) { let (s, r) = run(n); println!("{:#?} {:?} held {} thrown {:?}", r, s.settings, s.held, s.thrown); }
#[test]
fn five_hundred_violent_scenes_account_for_all_energy() { inner() }
fn inner() {
    let mut reasons: BTreeMap<&str, Vec<u64>> = BTreeMap::new();
    let (mut yielded, mut failed, mut struck, mut worst) = (0, 0, 0, [(0.0_f64, 0); 3]);
    for number in 0..SCENES {
        let started = std::time::Instant::now();
        let (_, summary) = run(number);
        let took = started.elapsed().as_secs_f64();
        if took > 0.5 {
            println!("scene {number}: {took} s, {} solver steps of {}", summary.solver_steps, summary.steps);
        }
        if let Termination::Failed(error) = &summary.termination {
            let text = error.to_string();
            assert!(error.is_no_convergence() && !text.is_empty(), "scene {number}: {text}");
            println!("scene {number}: {text} failed {} res {:e}", summary.plastic[0].failed, summary.energy.residual_max);
            reasons.entry(error.code().code()).or_default().push(number);
        } else {
            assert!(matches!(summary.termination, Termination::Completed), "scene {number}");
        }
        let m = &summary.momentum;
        let residuals =
            [summary.energy.residual_max, m.linear_residual_max, m.angular_residual_max];
        for (worst, residual) in worst.iter_mut().zip(residuals) {
            if residual > worst.0 || residual.is_nan() {
                *worst = (residual, number);
            }
        }
        if residuals.iter().any(|x| x.is_nan() || *x > 1e-10) {
            println!("scene {number}: {residuals:?}");
        }
        yielded += usize::from(summary.energy.plastic > 0.01 * summary.energy.scale);
        failed += usize::from(summary.plastic[0].failed > 0);
        struck += usize::from(summary.energy.loss_impacts > 0.0);
    }
    println!("{reasons:?}; {yielded} yielded, {failed} with failed fibres, {struck} with losses of impacts; worst {worst:?}");
    assert!(worst.iter().all(|(x, _)| *x < 1e-10), "{worst:?}");
}
