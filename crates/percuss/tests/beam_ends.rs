//! Ends of beams: the outline ends where the beam ends, with two corners that touch, and books close while things roll over them.

mod common;

use common::{beam, disc};
use percuss::*;
use std::f64::consts::PI;

/// Numbers between -1 and 1 that look random and are the same in every run.
struct Dice(u64);

impl Dice {
    fn roll(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + 0.5 * (self.roll() + 1.0) * (high - low)
    }
}

fn smooth(stiffness: f64) -> TouchLaw {
    TouchLaw::Smooth(SmoothLaw::elastic(Potential::Linear { stiffness }))
}

fn rigid(e: f64) -> TouchLaw {
    TouchLaw::Rigid(RigidLaw::frictionless(e))
}

fn wall(b: &mut ModelBuilder, point: [f64; 2], normal: [f64; 2]) -> Party {
    let shape = ObstacleShape::HalfPlane { point, normal };
    Party::Obstacle(b.obstacle(Obstacle { name: "wall".into(), shape, motion: None }))
}

/// A straight bar of 0.1 m depth about a middle, under an angle.
fn bar(b: &mut ModelBuilder, name: &str, middle: [f64; 2], length: f64, angle: f64) -> BeamId {
    let material = b.material(Material::new(format!("m {name}"), 2e9, 1e3));
    let section = b.section(Section::rectangle(format!("s {name}"), 0.1, 0.1));
    let half = [0.5 * length * angle.cos(), 0.5 * length * angle.sin()];
    let (from, to) =
        ([middle[0] - half[0], middle[1] - half[1]], [middle[0] + half[0], middle[1] + half[1]]);
    b.beam(beam(name, from, to, 8, material, section))
}

fn run(b: &ModelBuilder, end: f64, step: f64) -> Result<RunSummary, String> {
    let model = b.build().map_err(|faults| format!("{faults:?}"))?;
    let summary = simulate(&model, &Settings::new(end, step), &mut NoRecorder)
        .map_err(|faults| format!("{faults:?}"))?;
    match summary.termination {
        Termination::Completed => Ok(summary),
        other => Err(format!("{other:?}")),
    }
}

/// The largest residual of the books.
fn residual(summary: &RunSummary) -> f64 {
    let m = &summary.momentum;
    summary.energy.residual_max.max(m.linear_residual_max).max(m.angular_residual_max)
}

fn touched(summary: &RunSummary) -> bool {
    match &summary.contacts[0].record {
        ContactRecord::Smooth { intervals, .. } => !intervals.is_empty(),
        ContactRecord::Nonsmooth { impact_count, .. } => *impact_count > 0,
    }
}

/// Scenes thrown under each law, each with its own dice; how many touched, what went wrong.
fn throws(mut count: u64, laws: &[TouchLaw], scene: fn(&mut Dice, TouchLaw) -> ModelBuilder, end: f64) {
    if let Ok(n) = std::env::var("SEEDS") { count = n.parse().unwrap(); }
    let mut wrong = Vec::new();
    let mut hits = 0;
    for (k, law) in laws.iter().enumerate() {
        for seed in 0..count {
            let b = scene(&mut Dice(1000 + 77 * seed), law.clone());
            match run(&b, end, 1e-4) {
                Ok(summary) => {
                    hits += u64::from(touched(&summary));
                    let residual = residual(&summary);
                    if residual > 1e-10 {
                        wrong.push(format!("law {k}, seed {seed}: books by {residual:.1e}"));
                    }
                }
                Err(text) => wrong.push(format!("law {k}, seed {seed}: {text}")),
            }
        }
    }
    assert!(wrong.is_empty(), "{} of {}:\n{}", wrong.len(), hits, wrong.join("\n"));
    assert!(2 * hits > count * laws.len() as u64, "{hits} touched");
}

fn laws() -> [TouchLaw; 6] {
    [smooth(1e6), smooth(2e7), rigid(1.0), rigid(0.5), smooth(1e5), TouchLaw::Rigid(RigidLaw { friction: 0.3, ..RigidLaw::frictionless(0.3) })]
}

#[test]
fn a_bar_before_a_wall_starts_where_its_end_is() {
    for e in [0.0, 1.0] {
        let mut b = ModelBuilder::new();
        let bar = bar(&mut b, "bar", [0.51, 0.0], 1.0, 0.0);
        let wall = wall(&mut b, [0.0, 0.0], [1.0, 0.0]);
        b.contact(Contact::new("blow", [Party::Beam(bar), wall], rigid(e)));
        b.initial_motion(InitialMotion { velocity: [-10.0, 0.0], spin: 0.0, about: [0.0; 2] });
        let summary = run(&b, 1.5e-3, 1e-5).expect("sound");
        let ContactRecord::Nonsmooth { impacts, .. } = &summary.contacts[0].record else {
            panic!()
        };
        assert!((impacts[0].time - 1e-3).abs() < 1e-9, "{impacts:?}");
        assert_eq!(impacts[0].points, 2);
    }
}

#[test]
fn bars_thrown_on_a_floor_keep_their_books() {
    fn scene(dice: &mut Dice, law: TouchLaw) -> ModelBuilder {
        let mut b = ModelBuilder::new();
        let angle = dice.between(0.0, PI);
        let low = 0.5 * angle.sin() + 0.05 * angle.cos().abs();
        let bar = bar(&mut b, "bar", [0.0, low + dice.between(0.06, 0.08)], 1.0, angle);
        let floor = wall(&mut b, [0.0, 0.0], [0.1 * dice.roll(), 1.0]);
        b.contact(Contact::new("fall", [Party::Beam(bar), floor], law));
        let velocity = [5.0 * dice.roll(), dice.between(-10.0, -2.0)];
        b.initial_motion(InitialMotion { velocity, spin: 10.0 * dice.roll(), about: [0.0, low] });
        b
    }
    throws(12, &laws(), scene, 0.05);
}

#[test]
fn discs_thrown_at_ends_keep_their_books() {
    fn scene(dice: &mut Dice, law: TouchLaw) -> ModelBuilder {
        let mut b = ModelBuilder::new();
        let bar = bar(&mut b, "bar", [0.0, 0.0], 1.0, 0.0);
        let (aim, from) = ([0.5, 0.07 * dice.roll()], dice.between(-1.7, 1.7));
        let radius = dice.between(0.01, 0.1);
        let away = radius + 0.13;
        let position = [aim[0] + away * from.cos(), aim[1] + away * from.sin()];
        let speed = dice.between(5.0, 20.0);
        let ball =
            b.disc(disc("ball", 2.0, radius, position, [-speed * from.cos(), -speed * from.sin()]));
        b.contact(Contact::new("throw", [Party::Disc(ball), Party::Beam(bar)], law));
        b
    }
    throws(12, &laws(), scene, 0.04);
}

#[test]
fn bars_thrown_at_each_other_keep_their_books() {
    fn scene(dice: &mut Dice, law: TouchLaw) -> ModelBuilder {
        let mut b = ModelBuilder::new();
        let fixed = bar(&mut b, "one", [0.0, 0.0], 1.0, 0.0);
        let angle = PI * dice.roll();
        let reach = [0.25 * angle.cos(), 0.25 * angle.sin()];
        let aim = [0.5, 0.05 * dice.roll()];
        // Its last end comes first, aimed at the end of the other one.
        let middle = [aim[0] + 0.13 - reach[0], aim[1] - reach[1]];
        let middle =
            if reach[0] > 0.0 { [aim[0] + 0.13 + reach[0], aim[1] - reach[1]] } else { middle };
        let other = bar(&mut b, "two", middle, 0.5, angle);
        b.contact(Contact::new("clash", [Party::Beam(fixed), Party::Beam(other)], law));
        let velocity = [dice.between(-20.0, -5.0), 2.0 * dice.roll()];
        b.initial_motion_of(
            "two",
            InitialMotion { velocity, spin: 5.0 * dice.roll(), about: middle },
        );
        b
    }
    throws(12, &laws(), scene, 0.04);
}
