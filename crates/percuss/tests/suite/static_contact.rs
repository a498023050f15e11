//! Static equilibrium with contact: closed forms, shooting solutions, balance; transients that start there.

use crate::common;

use common::*;
use percuss::*;

/// A steel strip of 10 x 2 mm, clamped at its left end and bent about its small side, at the height of its axis above a floor.
struct Strip {
    elements: usize,
    height: f64,
    law: TouchLaw,
    /// Vertical force at its end \[N\].
    tip: f64,
}

const GRAVITY: f64 = 9.81;
const LENGTH: f64 = 2.0;
const BENDING: f64 = 2.1e11 * 0.01 * 8e-9 / 12.0;
const WEIGHT: f64 = 7850.0 * 2e-5 * GRAVITY;

fn rigid_law() -> TouchLaw {
    TouchLaw::Rigid(RigidLaw::frictionless(0.0))
}

fn spring_law(stiffness: f64) -> TouchLaw {
    TouchLaw::Smooth(SmoothLaw::elastic(Potential::Linear { stiffness }))
}

fn floor_at(y: f64) -> Obstacle {
    let shape = ObstacleShape::HalfPlane { point: [0.0, y], normal: [0.0, 1.0] };
    Obstacle { name: "floor".into(), shape, motion: None }
}

fn gravity(b: &mut ModelBuilder) {
    b.load(Load::new("g", LoadKind::Gravity { acceleration: [0.0, -GRAVITY] }));
}

impl Strip {
    fn model(&self) -> Model {
        self.builder().0.build().unwrap()
    }

    fn builder(&self) -> (ModelBuilder, BeamId) {
        let mut b = ModelBuilder::new();
        let material = b.material(Material::new("steel", 2.1e11, 7850.0));
        let section =
            Section { depth: Some(2e-3), ..Section::new("strip", 2e-5, 0.01 * 8e-9 / 12.0) };
        let section = b.section(section);
        let strip =
            b.beam(beam("strip", [0.0, 0.0], [LENGTH, 0.0], self.elements, material, section));
        b.support(Support::new("root", at("root", strip, 0.0), SupportKind::Clamp));
        // The faces of the strip lie half its depth from its axis.
        let floor = b.obstacle(floor_at(-self.height - 1e-3));
        let between = [ContactPartner::Beam(strip), ContactPartner::Obstacle(floor)];
        b.contact(Contact::new("on_floor", between, self.law.clone()));
        gravity(&mut b);
        if self.tip != 0.0 {
            let (at, force) = (at("tip", strip, 1.0), [0.0, self.tip]);
            let kind = LoadKind::Point { at, force, moment: 0.0, follower: false };
            b.load(Load::new("tip", kind));
        }
        for (name, share) in [("near", 0.2), ("mid", 0.5), ("tip", 1.0)] {
            b.record_point(at(name, strip, share));
        }
        (b, strip)
    }
}

/// A bar pressed against a wall by a force of its own axis: the gap between faces at 2 m is known to 4e-16 m, which is no lack of balance where the
/// contact is ten thousand times as stiff as the bar.
#[test]
fn stiff_contacts_are_balanced_to_the_round_off_of_positions() {
    for stiffness in [1e9, 1e11, 1e12] {
        let mut b = ModelBuilder::new();
        let strain = StrainMeasure::Engineering;
        let material = b.material(Material { strain, ..Material::new("m", 1e10, 2e3) });
        let section = b.section(Section::rectangle("bar", 0.1, 0.2));
        let bar = b.beam(beam("bar", [0.0, 0.0], [2.0, 0.0], 10, material, section));
        b.support(Support::new("root", at("root", bar, 0.0), SupportKind::Clamp));
        let shape = ObstacleShape::HalfPlane { point: [2.0001, 0.0], normal: [-1.0, 0.0] };
        let wall = b.obstacle(Obstacle { name: "wall".into(), shape, motion: None });
        let between = [ContactPartner::Beam(bar), ContactPartner::Obstacle(wall)];
        b.contact(Contact::new("end", between, spring_law(stiffness)));
        let kind = LoadKind::Point {
            at: at("tip", bar, 1.0),
            force: [4e4, 0.0],
            moment: 0.0,
            follower: false,
        };
        b.load(Load::new("push", kind));
        let found = equilibrium(&b.build().unwrap()).unwrap();
        // The bar has 1e8 N/m, both corners of its end have the law: 1e8 u + 2 k (u - 1e-4) = 4e4.
        let u = (4e4 + 2.0 * stiffness * 1e-4) / (1e8 + 2.0 * stiffness);
        let expected = 2.0 * stiffness * (u - 1e-4);
        let force = found.contacts[0].force;
        assert!((force / expected - 1.0).abs() < 1e-6, "{stiffness:e}: {force} {expected}");
    }
}

/// The inextensible heavy elastica that leaves a clamp level, at height h above a smooth floor, and touches it without a moment:
/// clamp force and moment and the free length, by Runge-Kutta and Newton's method (no closed form).
struct Elastica {
    force: f64,
    moment: f64,
    free: f64,
}

impl Elastica {
    /// (x, y, angle, moment) at the end of `free`, from the clamp: `EI theta' = m`, `m' = (R - q s) cos theta`.
    fn shoot(&self, until: f64) -> [f64; 4] {
        let rate = |s: f64, z: [f64; 4]| {
            let (sine, cosine) = z[2].sin_cos();
            [cosine, sine, z[3] / BENDING, (self.force - WEIGHT * s) * cosine]
        };
        let (steps, mut z) = (2000, [0.0, 0.0, 0.0, self.moment]);
        let h = until / f64::from(steps);
        let ahead = |z: [f64; 4], k: [f64; 4], t: f64| std::array::from_fn(|i| z[i] + t * k[i]);
        for n in 0..steps {
            let s = h * f64::from(n);
            let a = rate(s, z);
            let b = rate(s + 0.5 * h, ahead(z, a, 0.5 * h));
            let c = rate(s + 0.5 * h, ahead(z, b, 0.5 * h));
            let d = rate(s + h, ahead(z, c, h));
            z = std::array::from_fn(|i| z[i] + h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]));
        }
        z
    }

    fn above(height: f64) -> Self {
        // The long strip of linear theory: L^4 = 72 EI h / q; M = -q L^2 / 6 and R = 2 q L / 3 at the clamp.
        let free = (72.0 * BENDING * height / WEIGHT).powf(0.25);
        let mut found =
            Self { force: 2.0 * WEIGHT * free / 3.0, moment: -WEIGHT * free * free / 6.0, free };
        let miss = |e: &Self| {
            let [_, y, angle, moment] = e.shoot(e.free);
            [y + height, angle, moment]
        };
        for _ in 0..20 {
            let r = miss(&found);
            let mut columns = [[0.0; 3]; 3];
            for (k, column) in columns.iter_mut().enumerate() {
                let mut e = Self { ..found };
                let unknown = [&mut e.force, &mut e.moment, &mut e.free];
                let step = 1e-6 * *unknown[k];
                for (j, u) in unknown.into_iter().enumerate() {
                    *u += if j == k { step } else { 0.0 };
                }
                *column = std::array::from_fn(|i| (miss(&e)[i] - r[i]) / step);
            }
            let det = |a: [[f64; 3]; 3]| {
                a[0][0] * (a[1][1] * a[2][2] - a[2][1] * a[1][2])
                    - a[1][0] * (a[0][1] * a[2][2] - a[2][1] * a[0][2])
                    + a[2][0] * (a[0][1] * a[1][2] - a[1][1] * a[0][2])
            };
            let whole = det(columns);
            let change = |k: usize| {
                let mut replaced = columns;
                replaced[k] = r;
                -det(replaced) / whole
            };
            let [a, b, c] = [change(0), change(1), change(2)];
            (found.force, found.moment, found.free) =
                (found.force + a, found.moment + b, found.free + c);
        }
        found
    }
}

fn point(found: &Equilibrium, name: &str) -> [f64; 2] {
    found.points.iter().find(|(n, _)| n == name).unwrap().1
}

fn reaction(found: &Equilibrium, name: &str) -> [f64; 3] {
    found.reactions.iter().find(|(n, _)| n == name).unwrap().1
}

#[test]
fn a_strip_lies_down_on_a_floor_as_the_heavy_elastica_does() {
    let height = 0.1;
    let exact = Elastica::above(height);
    let found =
        equilibrium(&Strip { elements: 200, height, law: rigid_law(), tip: 0.0 }.model()).unwrap();
    let [_, clamp, moment] = reaction(&found, "root");
    // Candidates for contact are 5 mm apart: this is the accuracy of the touch-down point, and of its force.
    assert!((clamp / exact.force - 1.0).abs() < 2e-3, "{clamp} for {}", exact.force);
    assert!((moment / -exact.moment - 1.0).abs() < 2e-3, "{moment} for {}", exact.moment);
    assert!((point(&found, "near")[1] - exact.shoot(0.4)[1]).abs() < 1e-3 * height);
    assert!((point(&found, "tip")[1] + height).abs() < 1e-14);
    let contact = &found.contacts[0];
    assert!((contact.s[0] - exact.free).abs() < 0.011, "{contact:?} for {}", exact.free);
    assert!(contact.gap.abs() < 1e-14 && contact.s[1] == LENGTH && found.stable);
    // The floor carries the force that the clamp does not carry, to the round-off of some thousand forces. Like the reaction of a support, that of
    // the floor is the force on the structure.
    let floor = reaction(&found, "floor")[1];
    assert!((clamp + contact.force - WEIGHT * LENGTH).abs() < 1e-9, "{contact:?}");
    assert!((floor - contact.force).abs() < 1e-9, "{floor} {contact:?}");
    // The arrows of drawings are these forces, each where the strip lies on the floor.
    let arrows = &found.frame().contact_forces;
    let sum = arrows.iter().fold([0.0; 2], |sum, f| [sum[0] + f.force[0], sum[1] + f.force[1]]);
    let push = contact.resultant.map(|r| -r); // that is on the first partner, arrows are on the second
    assert!((0..2).all(|i| (sum[i] - push[i]).abs() < 1e-9), "{sum:?} {push:?}");
    let face = -height - 1e-3;
    assert!(arrows.iter().all(|f| (f.position[1] - face).abs() < 1e-9 && !f.impulsive));
}

#[test]
fn a_compliant_floor_carries_what_the_clamp_does_not() {
    for (stiffness, tip) in [(1e3, 0.0), (1e6, 0.0), (1e3, -2.0), (1e5, 0.5)] {
        let strip = Strip { elements: 60, height: 0.1, law: spring_law(stiffness), tip };
        let found = equilibrium(&strip.model()).unwrap();
        let (clamp, contact) = (reaction(&found, "root")[1], &found.contacts[0]);
        let load = WEIGHT * LENGTH - tip;
        assert!(
            (clamp + contact.force - load).abs() < 1e-8 * load,
            "{stiffness} {tip}: {clamp} {contact:?}"
        );
        assert!(contact.force > 0.0 && contact.gap < 0.0);
        // The tip's own candidate: the deepest one is pressed by its spring.
        assert!(-contact.gap * stiffness < contact.force);
    }
}

#[test]
fn a_ball_rests_in_the_middle_of_a_beam_and_its_supports_carry_both() {
    for law in [
        rigid_law(),
        spring_law(1e6),
        TouchLaw::Smooth(SmoothLaw::elastic(Potential::Hertz { stiffness: 1e9 })),
    ] {
        for (x, above) in [(1.0, 0.0), (1.0, 0.03), (0.93, 0.01)] {
            let mut b = ModelBuilder::new();
            let material = b.material(Material::new("steel", 2.1e11, 7850.0));
            let section =
                Section { depth: Some(0.01), ..Section::new("bar", 1e-4, 0.01 * 1e-6 / 12.0) };
            let section = b.section(section);
            let bar = b.beam(beam("bar", [0.0, 0.0], [2.0, 0.0], 20, material, section));
            b.support(Support::new("left", at("left", bar, 0.0), SupportKind::Pin));
            let roller = SupportKind::Roller { direction: [1.0, 0.0] };
            b.support(Support::new("right", at("right", bar, 1.0), roller));
            let ball = b.disc(disc("ball", 3.0, 0.05, [x, 0.055 + above], [0.0, 0.0]));
            b.contact(Contact::new(
                "on_bar",
                [ContactPartner::Disc(ball), ContactPartner::Beam(bar)],
                law.clone(),
            ));
            gravity(&mut b);
            b.record_point(at("mid", bar, 0.5));
            let model = b.build().unwrap();
            let found = equilibrium(&model).unwrap_or_else(|e| panic!("{law:?} {x} {above}: {e}"));
            let weight = 3.0 * GRAVITY;
            let contact = &found.contacts[0];
            assert!(
                (contact.force / weight - 1.0).abs() < 1e-9,
                "{law:?} {x} {above}: {contact:?}"
            );
            assert!((contact.resultant[1] / weight - 1.0).abs() < 1e-9);
            // Without friction it rolls to the lowest place, wherever it is put down.
            assert!((contact.centre - 1.0).abs() < 1e-3, "{law:?} {x} {above}: {contact:?}");
            let each = 0.5 * (weight + 7850.0 * 1e-4 * 2.0 * GRAVITY);
            for support in ["left", "right"] {
                assert!(
                    (reaction(&found, support)[1] / each - 1.0).abs() < 1e-3,
                    "{:?}",
                    found.reactions
                );
            }
            let sag = weight * 8.0 / 48.0 / (2.1e11 * 0.01 * 1e-6 / 12.0)
                + 5.0 * 7850.0 * 1e-4 * GRAVITY * 16.0 / 384.0 / (2.1e11 * 0.01 * 1e-6 / 12.0);
            assert!(
                (point(&found, "mid")[1] / -sag - 1.0).abs() < 2e-2,
                "{:?} for {sag}",
                found.points
            );
            assert!(found.stable);
        }
    }
}

#[test]
fn beams_that_nothing_holds_are_named() {
    let mut b = ModelBuilder::new();
    let (material, section) = plank(&mut b);
    let bar = b.beam(beam("bar", [0.0, 0.0], [1.0, 0.0], 4, material, section));
    b.support(Support::new("root", at("root", bar, 0.0), SupportKind::Clamp));
    let ball = b.disc(disc("ball", 3.0, 0.05, [1.5, 0.1], [0.0, 0.0]));
    b.contact(Contact::new(
        "on_bar",
        [ContactPartner::Disc(ball), ContactPartner::Beam(bar)],
        rigid_law(),
    ));
    gravity(&mut b);
    let model = b.build().unwrap();
    let error = equilibrium(&model).unwrap_err().to_string();
    assert!(error.contains("`ball` is not supported"), "{error}");
    let error = equilibrium_path(&model, &PathSettings::default()).unwrap_err().to_string();
    assert!(error.contains("`ball` is not supported"), "{error}");
}

/// Two cantilevers, the tip of the upper one over the lower one, with a force on the upper tip.
fn leaning(law: TouchLaw, gap: f64, force: f64) -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("steel", 2.1e11, 7850.0));
    let section =
        b.section(Section { depth: Some(0.01), ..Section::new("bar", 1e-4, 1e-8 / 12.0) });
    let upper = b.beam(beam("upper", [0.0, 0.01 + gap], [1.0, 0.01 + gap], 20, material, section));
    let lower = b.beam(beam("lower", [2.0, 0.0], [0.9, 0.0], 22, material, section));
    b.support(Support::new("a", at("a", upper, 0.0), SupportKind::Clamp));
    b.support(Support::new("b", at("b", lower, 0.0), SupportKind::Clamp));
    let tip = at("upper.tip", upper, 1.0);
    b.record_point(tip.clone());
    b.load(Load::new(
        "push",
        LoadKind::Point { at: tip, force: [0.0, -force], moment: 0.0, follower: false },
    ));
    b.contact(Contact::new(
        "lean",
        [ContactPartner::Beam(upper), ContactPartner::Beam(lower)],
        law,
    ));
    b.build().unwrap()
}

#[test]
fn a_beam_that_leans_on_another_gives_it_half_of_what_is_left() {
    let bending = 2.1e11 * 1e-8 / 12.0;
    for gap in [0.0, 1e-3] {
        // Both tips go down by the same once they touch: (P - F) / 3 EI = F / 3 EI + gap.
        let (force, exact) = (10.0, 0.5 * (10.0 - 3.0 * bending * gap));
        let found = equilibrium(&leaning(rigid_law(), gap, force)).unwrap();
        let contact = &found.contacts[0];
        assert!((contact.force / exact - 1.0).abs() < 1e-2, "{contact:?} for {exact}");
        let sum = reaction(&found, "a")[1] + reaction(&found, "b")[1];
        assert!((sum - force).abs() < 1e-9, "{sum}");
        assert!((contact.resultant[1] / contact.force - 1.0).abs() < 1e-3);
    }
}

#[test]
fn a_path_stops_at_what_stands_in_its_way() {
    let model = leaning(rigid_law(), 1e-3, 10.0);
    let path = equilibrium_path(&model, &PathSettings::default()).unwrap();
    assert!(path.reached);
    let (end, direct) = (&path.end, equilibrium(&model).unwrap());
    let (along, at_once) = (&end.contacts[0], &direct.contacts[0]);
    assert!((along.force / at_once.force - 1.0).abs() < 1e-7, "{along:?} {at_once:?}");
    let [a, b] = [end, &direct].map(|e| point(e, "upper.tip")[1]);
    assert!((a - b).abs() < 1e-9 * b.abs(), "{a} {b}");
}

#[test]
fn a_run_that_starts_where_things_lie_stays_there() {
    for law in [rigid_law(), spring_law(1e4)] {
        for scheme in [Scheme::EnergyMomentum, Scheme::StrainRate] {
            let strip = Strip { elements: 40, height: 0.1, law: law.clone(), tip: 0.0 };
            let model = strip.model();
            let settings = Settings { start: Start::Static, scheme, ..Settings::new(0.05, 1e-3) };
            let mut simulation = Simulation::new(&model, &settings).unwrap();
            let start = simulation.state().displacement.clone();
            for _ in 0..50 {
                simulation.advance(&mut NoRecorder).unwrap();
            }
            let moved = simulation.state().displacement.iter().zip(&start);
            let most = moved
                .map(|(a, b)| (a[0] - b[0]).abs().max((a[1] - b[1]).abs()))
                .fold(0.0, f64::max);
            let summary = simulation.run(&mut NoRecorder);
            assert!(matches!(summary.termination, Termination::Completed));
            // Round-off of the equilibrium: the strip weighs 3 N and is as soft as 0.5 N/m.
            assert!(most < 1e-9, "{law:?} {scheme:?}: {most}");
        }
    }
}

/// A shallow toggle of two bars: rises by `rise` over a half span of one, snaps through under a force in the middle.
fn toggle(rise: f64, area: f64) -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("stuff", 1e9, 1e3));
    let section = b.section(Section::new("bar", area, 1e-9));
    let left = b.beam(beam("left", [-1.0, 0.0], [0.0, rise], 2, material, section));
    let right = b.beam(beam("right", [0.0, rise], [1.0, 0.0], 2, material, section));
    b.support(Support::new("a", at("a", left, 0.0), SupportKind::Pin));
    b.support(Support::new("b", at("b", right, 1.0), SupportKind::Pin));
    let between = [at("top", left, 1.0), at("top", right, 0.0)];
    b.joint(Joint::new("top", JointKind::Hinge, between));
    b.record_point(at("top", left, 1.0));
    let kind = LoadKind::Point {
        at: at("top", left, 1.0),
        force: [0.0, -1.0],
        moment: 0.0,
        follower: false,
    };
    b.load(Load::new("push", kind));
    b.build().unwrap()
}

#[test]
fn a_toggle_snaps_through_in_few_points() {
    for rise in [0.02, 0.05, 0.1] {
        let area = 1e-4;
        let model = toggle(rise, area);
        let end = PathEnd::Displacement { point: "top".into(), component: 2, value: -2.5 * rise };
        let settings = PathSettings { first: 1e-3 * 1e9 * area * rise.powi(3), points: 2000, end };
        let path = equilibrium_path(&model, &settings).unwrap();
        assert!(path.reached && path.points.len() < 500, "{rise}: {}", path.points.len());
        // Bars in Green strain (l^2 - l0^2) / (2 l0^2): P = EA (rise^2 - h^2) h / l0^3, largest at a height left of rise / sqrt(3).
        let l0 = 1.0_f64.hypot(rise);
        let h = rise / 3.0_f64.sqrt();
        let most = 1e9 * area * (rise * rise - h * h) * h / l0.powi(3);
        let [up, down] = [0, 1].map(|k| path.limit_points[k].factor);
        assert!(
            (up / most - 1.0).abs() < 1e-4 && (down / -most - 1.0).abs() < 1e-4,
            "{up} {down} for {most}"
        );
    }
}

/// Equilibria offered along a path: factor, whether the load turns there, displacement of the recorded point.
#[derive(Default)]
struct Offered(Vec<(f64, bool, [f64; 2])>);

impl PathRecorder for Offered {
    fn wants(&mut self, _: bool) -> bool {
        true
    }

    fn equilibrium(&mut self, factor: f64, limit: bool, found: &Equilibrium) {
        // The load as it is drawn, and the forces that carry it.
        assert!((found.frame().load_factors[0] - factor).abs() <= 1e-12 * factor.abs());
        let thrust = found.element_forces[0][0][0];
        assert!(factor == 0.0 || thrust.abs() > factor.abs(), "{thrust} at {factor}");
        self.0.push((factor, limit, found.points[0].1));
    }
}

#[test]
fn the_equilibria_of_a_path_are_offered_without_changing_it() {
    let rise = 0.05;
    let model = toggle(rise, 1e-4);
    let end = PathEnd::Displacement { point: "top".into(), component: 2, value: -2.5 * rise };
    let settings = PathSettings { first: 1e-3 * 1e5 * rise.powi(3), points: 2000, end };
    let plain = equilibrium_path(&model, &settings).unwrap();
    let mut offered = Offered::default();
    let path = equilibrium_path_recorded(&model, &settings, &mut offered).unwrap();
    assert_eq!(path.points.len(), plain.points.len());
    for (a, b) in path.points.iter().zip(&plain.points) {
        assert!((a.factor - b.factor).abs() < 1e-6 * path.limit_points[0].factor);
    }
    // All points but the end, which the path has itself; limit points between those beside them.
    let reported = |limit: bool| -> Vec<(f64, [f64; 2])> {
        offered.0.iter().filter(|o| o.1 == limit).map(|o| (o.0, o.2)).collect()
    };
    let points = |of: &[PathPoint]| -> Vec<(f64, [f64; 2])> {
        of.iter().map(|p| (p.factor, p.displacements[0])).collect()
    };
    assert_eq!(reported(false), points(&path.points[..path.points.len() - 1]));
    assert_eq!(reported(true), points(&path.limit_points));
    let down: Vec<f64> = offered.0.iter().map(|o| o.2[1]).collect();
    assert!(down.windows(2).all(|w| w[1] <= w[0] + 1e-12), "the top goes down all the way");
}

/// A clamp and a roller at the end of a beam, the roller with a prescribed motion.
fn torn(function: TimeFunction, displacement: [f64; 2], both: bool) -> Result<Model, Vec<Fault>> {
    let mut b = ModelBuilder::new();
    let (material, section) = plank(&mut b);
    let bar = b.beam(beam("bar", [0.0, 0.0], [1.0, 0.0], 4, material, section));
    let motion = Some(Motion { displacement, rotation: 0.0, function });
    let first = Support::new("first", at("end", bar, 0.0), SupportKind::Clamp);
    b.support(Support { motion: if both { motion.clone() } else { None }, ..first });
    let kind = SupportKind::Roller { direction: [1.0, 0.0] };
    b.support(Support { motion, ..Support::new("second", at("end", bar, 0.0), kind) });
    b.build()
}

#[test]
fn supports_that_prescribe_different_motions_of_the_same_are_refused() {
    let up = [0.0, 1e-3];
    for function in [
        TimeFunction::Constant,
        TimeFunction::Ramp { duration: 0.1 },
        TimeFunction::HalfSine { duration: 1e-3 },
    ] {
        let faults = torn(function.clone(), up, false).unwrap_err();
        let text = faults[0].to_string();
        assert!(text.contains("`first`") && text.contains("`second`"), "{text}");
        // The same motion of both is redundant, one across the fixed direction of the other is independent.
        assert!(torn(function.clone(), up, true).is_ok());
        assert!(torn(function, [0.0, 0.0], false).is_ok());
    }
}

#[test]
fn a_rigid_joint_torn_by_settlements_is_refused() {
    let frame = |drop: f64, other: f64| {
        let mut b = ModelBuilder::new();
        let (material, section) = plank(&mut b);
        let left = b.beam(beam("left", [0.0, 0.0], [1.0, 0.0], 2, material, section));
        let right = b.beam(beam("right", [1.0, 0.0], [2.0, 0.0], 2, material, section));
        let moved = |y: f64| {
            (y != 0.0).then_some(Motion {
                displacement: [0.0, y],
                rotation: 0.0,
                function: TimeFunction::Constant,
            })
        };
        let a = Support::new("a", at("a", left, 1.0), SupportKind::Clamp);
        b.support(Support { motion: moved(drop), ..a });
        let kind = SupportKind::Roller { direction: [1.0, 0.0] };
        let c = Support::new("c", at("c", right, 0.0), kind);
        b.support(Support { motion: moved(other), ..c });
        let between = [at("j", left, 1.0), at("j", right, 0.0)];
        b.joint(Joint::new("j", JointKind::Rigid, between));
        b.build()
    };
    assert!(frame(-0.01, -0.01).is_ok() && frame(0.0, 0.0).is_ok());
    for (drop, other) in [(-0.01, 0.0), (0.0, -0.01), (-0.01, -0.02)] {
        let text = frame(drop, other).unwrap_err()[0].to_string();
        assert!(text.contains("`a`") && text.contains("`c`"), "{text}");
    }
}

/// A bar pressed beyond the largest force in Green strains, between guides and beside a floor: an open contact is not the reason, and is not named
/// as such.
#[test]
fn contact_forces_are_a_reason_only_where_a_contact_is_closed() {
    for (gap, code) in [(0.01, AnalysisCode::Equilibrium), (0.0, AnalysisCode::UnsettledContacts)] {
        let mut b = ModelBuilder::new();
        let material = b.material(Material::new("steel", 2.1e11, 7850.0));
        let section = b.section(Section::rectangle("bar", 0.02, 0.02));
        let bar = b.beam(beam("bar", [0.0, 0.0], [1.0, 0.0], 10, material, section));
        b.support(Support::new("foot", at("foot", bar, 0.0), SupportKind::Clamp));
        let components = vec![Component::Displacement2, Component::Rotation];
        let guide = SupportKind::Fix { components };
        b.support(Support::new("guide", at("guide", bar, 1.0), guide));
        let floor = b.obstacle(floor_at(-0.01 - gap));
        let between = [ContactPartner::Beam(bar), ContactPartner::Obstacle(floor)];
        b.contact(Contact::new("floor", between, rigid_law()));
        let (at, force) = (at("head", bar, 1.0), [-1e8, 0.0]);
        let kind = LoadKind::Point { at, force, moment: 0.0, follower: false };
        b.load(Load::new("press", kind));
        let error = equilibrium(&b.build().unwrap()).unwrap_err();
        assert_eq!(error.code(), code, "{error}");
    }
}
