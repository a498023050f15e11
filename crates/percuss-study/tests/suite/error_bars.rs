//! What `converge` says of its own uncertainty, against runs many times as fine, over random scenes.

use std::fmt::Write;

use percuss::{Settings, Simulation, Termination};
use percuss_output::{SummaryPath, pick};
use percuss_scenario::read;
use percuss_study::{Ladder, converge};

/// Numbers that follow from a seed alone (Knuth's constants).
struct Chance(u64);

impl Chance {
    fn share(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * self.share()
    }

    /// A number whose logarithm is anywhere between those of the two.
    fn of_size(&mut self, from: f64, to: f64) -> f64 {
        from * (to / from).powf(self.share())
    }

    fn one_of<T: Copy>(&mut self, all: &[T]) -> T {
        all[((self.share() * all.len() as f64) as usize).min(all.len() - 1)]
    }

    fn with(&mut self, probability: f64) -> bool {
        self.share() < probability
    }
}

/// A scene, its number of elements, fibres and step \[s\].
struct Scene {
    text: String,
    elements: usize,
    yields: bool,
    fibres: usize,
    step: f64,
}

/// First eigenvalue `(beta L)^2` of the beam under its supports.
const SUPPORTS: [(&str, &str, f64); 7] = [
    ("clamp", "pin", 15.4),
    ("clamp", "clamp", 22.4),
    ("pin", "roller", 9.87),
    ("clamp", "free", 3.52),
    ("pin", "pin", 9.87),
    ("clamp", "roller", 15.4),
    ("clamp", "stop", 3.52),
];

/// A beam under an impact or a load: supports, stops, materials that yield or damp, contact laws, discs, gravity.
fn scene(seed: u64) -> Scene {
    let mut chance = Chance(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15));
    for _ in 0..8 {
        chance.share();
    }
    let (width, depth) = (chance.between(0.02, 0.06), chance.between(0.015, 0.06));
    let (length, elements) = (chance.between(0.8, 2.5), chance.one_of(&[4, 5, 6, 8]));
    let (material, young, density) =
        chance.one_of(&[("steel", 210e9, 7850.0), ("aluminium", 70e9, 2700.0)]);
    let mut text = format!("[material.m]\npreset = \"{material}\"\n");
    let yields = chance.with(0.15);
    if yields {
        let (stress, modulus) = (chance.one_of(&[150, 235, 355]), chance.one_of(&[1, 2, 5]));
        let hardening = format!("hardening = {{ isotropic = \"{modulus} GPa\" }}");
        writeln!(text, "yield = \"{stress} MPa\"\n{hardening}").unwrap();
    }
    if chance.with(0.3) {
        writeln!(text, "retardation = {:e}", chance.one_of(&[1e-5, 5e-5, 2e-4])).unwrap();
    }
    let fibres = chance.one_of(&[6, 10, 16]);
    writeln!(
        text,
        "[section.s]\nshape = \"rectangle\"\nwidth = {width}\ndepth = {depth}\nfibres = {fibres}"
    )
    .unwrap();
    writeln!(text, "[beam.b]\npoints = [[0, 0], [{length}, 0]]\nelements = {elements}").unwrap();
    let (first, last, root) = chance.one_of(&SUPPORTS);
    writeln!(
        text,
        "material = \"m\"\nsection = \"s\"\n[support.a]\nat = \"b.start\"\nkind = \"{first}\""
    )
    .unwrap();
    match last {
        "free" => {}
        "stop" => {
            let (gap, stiffness) = (chance.between(1e-4, 2e-3), chance.of_size(3e5, 5e6));
            write!(text, "[support.z]\nat = \"b.end\"\nkind = \"stop\"\ndirection = [0, -1]\n")
                .unwrap();
            writeln!(text, "gap = {gap}\nstiffness = {stiffness}").unwrap();
        }
        kind => writeln!(text, "[support.z]\nat = \"b.end\"\nkind = \"{kind}\"").unwrap(),
    }
    let (stiffness, line) = (young * width * depth.powi(3) / 12.0, density * width * depth);
    let period = std::f64::consts::TAU * length.powi(2) / root * (line / stiffness).sqrt();
    let (end, step) = match chance.with(0.87) {
        true => blow(&mut chance, &mut text, [length, depth, line * length, period]),
        false => load(&mut chance, &mut text, 48.0 * stiffness / length.powi(2), period),
    };
    if chance.with(0.25) {
        writeln!(text, "[load.g]\nkind = \"gravity\"\nacceleration = [0, -9.81]").unwrap();
    }
    writeln!(text, "[record]\npoints = [\"b.mid\"]").unwrap();
    let step = step.max(end / 300.0);
    writeln!(text, "[time]\nend = {end}\nstep = {step}").unwrap();
    Scene { text, elements, yields, fibres, step }
}

/// Something elastic that strikes; end and step of the run \[s\].
fn blow(
    chance: &mut Chance,
    text: &mut String,
    [length, depth, beam, period]: [f64; 4],
) -> (f64, f64) {
    let (mass, stiffness) = (beam * chance.of_size(0.2, 6.0), chance.of_size(1e5, 1e7));
    let (speed, place) = (chance.between(0.5, 6.0), chance.between(0.2, 0.8));
    writeln!(text, "[projectile.p]\nkind = \"elastic\"\nmass = {mass}").unwrap();
    match chance.share() {
        x if x < 0.15 => {
            let (radius, gap) = (chance.between(0.02, 0.1), chance.between(1e-4, 3e-3));
            let height = radius + 0.5 * depth + gap;
            let along = chance.between(-1.0, 1.0);
            writeln!(
                text,
                "contact = \"surface\"\nradius = {radius}\nstiffness = {stiffness}\nstrikes = \"b\""
            )
            .unwrap();
            let at = (0.05 + 0.9 * place) * length;
            writeln!(text, "position = [{at}, {height}]\nvelocity = [{along}, {}]", -speed)
                .unwrap();
        }
        x => {
            writeln!(text, "velocity = [0, {}]\nstrikes = \"b@{place:.3}\"", -speed).unwrap();
            match x < 0.35 {
                true => writeln!(text, "law = \"hertz\"\nhertz_stiffness = {}", 20.0 * stiffness)
                    .unwrap(),
                false => writeln!(text, "stiffness = {stiffness}").unwrap(),
            }
            if x > 0.9 {
                writeln!(text, "rebound = {{ restitution = 0.6, velocity = {speed} }}").unwrap();
            }
        }
    }
    let contact = std::f64::consts::PI * (mass / stiffness).sqrt();
    let end = chance.one_of(&[1.0, 2.0, 4.0]) * contact + chance.one_of(&[0.2, 0.5, 1.0]) * period;
    (end, contact.min(period) / chance.one_of(&[10.0, 20.0, 40.0]))
}

/// A load in the field, of some share of `force` \[N\]; end and step of the run \[s\].
fn load(chance: &mut Chance, text: &mut String, force: f64, period: f64) -> (f64, f64) {
    let (place, force) = (chance.between(0.2, 0.8), force / chance.one_of(&[30.0, 100.0, 300.0]));
    writeln!(text, "[load.f]\nkind = \"point\"\nat = \"b@{place:.3}\"\nforce = [0, {}]", -force)
        .unwrap();
    if chance.with(0.5) {
        let duration = period * chance.between(0.1, 0.5);
        writeln!(text, "function = {{ kind = \"ramp\", duration = {duration} }}").unwrap();
    }
    (period * chance.between(0.5, 3.0), period / chance.one_of(&[20.0, 40.0, 80.0]))
}

/// Results of a run with so many times the steps, the elements and, where it yields, the fibres.
fn finer(scene: &Scene, paths: &[&str], [times, fibres]: [usize; 2]) -> Vec<f64> {
    let mesh = |n: usize| format!("elements = {n}\n");
    let layers = |n: usize| format!("fibres = {n}\n");
    let text = scene.text.replace(&mesh(scene.elements), &mesh(scene.elements * times));
    let text = text.replace(&layers(scene.fibres), &layers(scene.fibres * fibres));
    let fine = read(&text, "fine.toml").and_then(|scenario| scenario.compile()).expect("valid");
    let settings = Settings { step: scene.step / times as f64, ..fine.settings };
    let run = Simulation::new(&fine.model, &settings).expect("valid").run(&mut percuss::NoRecorder);
    assert!(matches!(run.termination, Termination::Completed), "{text}");
    let paths: Vec<SummaryPath> =
        paths.iter().map(|path| SummaryPath::find(path, &run).expect("a path")).collect();
    pick(&paths, &run)
}

/// Of all limits that `converge` tells with four levels, at least nine of ten lie within their uncertainty of what a run with 32 times as
/// many steps and elements gives, where sections yield 16 times as many and 8 times the fibres. Over a hundred scenes 94 of 100 do.
#[test]
fn limits_lie_within_their_uncertainty() {
    let scenes = if std::env::var_os("PERCUSS_WHOLE").is_some() { 100 } else { 8 };
    let (mut reported, mut outside) = (0, Vec::new());
    for seed in 0..scenes {
        let scene = scene(seed);
        let scenario = read(&scene.text, "scene.toml").unwrap_or_else(|faults| panic!("{faults}"));
        let ladder = Ladder { results: Vec::new(), levels: 4, accuracy: None };
        let found = converge(&scenario, &ladder, &|| true, &|_, _| {});
        let found = found.unwrap_or_else(|why| panic!("{why:?}\n{}", scene.text));
        let results: Vec<_> = found.results.iter().filter(|one| !one.limit.is_nan()).collect();
        let paths: Vec<&str> = results.iter().map(|one| one.path.as_str()).collect();
        let truth = finer(&scene, &paths, if scene.yields { [16, 8] } else { [32, 1] });
        for (one, truth) in results.iter().zip(truth) {
            reported += 1;
            let off = (one.limit - truth).abs();
            if off > one.uncertainty + 1e-9 * truth.abs() {
                let (path, limit, uncertainty) = (&one.path, one.limit, one.uncertainty);
                outside.push(format!("{seed}: {path} {limit} +- {uncertainty}, not {truth}"));
            }
        }
    }
    let share = 1.0 - outside.len() as f64 / f64::from(reported);
    println!("{:.1} % of {reported} limits within their uncertainty", 100.0 * share);
    assert!(share >= 0.9, "{share} of {reported}\n{}", outside.join("\n"));
}
