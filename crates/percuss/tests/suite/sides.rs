//! Which side of a jump and which of two equally near places a recorded value belongs to: by rule, however a scene lies and whatever its units are.

use crate::common;

use common::rows::Rows;
use common::{at, beam};
use percuss::*;

/// How a scene lies: moved to, turned by, mirrored across its first axis, and the size of its units.
#[derive(Clone, Copy, Debug)]
struct Pose {
    to: [f64; 2],
    angle: f64,
    mirror: f64,
    /// Length and mass of a unit of the pose in metres and kilograms; its second is a second.
    units: [f64; 2],
}

const AS_IT_IS: Pose = Pose { to: [0.0; 2], angle: 0.0, mirror: 1.0, units: [1.0; 2] };

const POSES: [Pose; 6] = [
    AS_IT_IS,
    Pose { to: [1000.0, -1000.0], ..AS_IT_IS },
    Pose { angle: 0.6457, ..AS_IT_IS },
    Pose { mirror: -1.0, ..AS_IT_IS },
    // Millimetres and tonnes.
    Pose { units: [1e-3, 1e3], ..AS_IT_IS },
    Pose { to: [-3.7, 11.3], angle: 2.1, mirror: -1.0, units: [0.7, 3.1] },
];

impl Pose {
    fn length(&self, metres: f64) -> f64 {
        metres / self.units[0]
    }

    fn mass(&self, kilograms: f64) -> f64 {
        kilograms / self.units[1]
    }

    /// A force in newtons, or a stiffness per metre, with so many lengths below it.
    fn per(&self, value: f64, lengths: i32) -> f64 {
        value / self.units[1] * self.units[0].powi(lengths - 1)
    }

    /// A direction times a size in metres.
    fn vector(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let ([x, y], (sin, cos)) = ([x, self.mirror * y], self.angle.sin_cos());
        [self.length(cos * x - sin * y), self.length(sin * x + cos * y)]
    }

    fn place(&self, x: [f64; 2]) -> [f64; 2] {
        let moved = self.vector(x);
        [moved[0] + self.length(self.to[0]), moved[1] + self.length(self.to[1])]
    }

    /// Shear force, bending moment and size of the stress at a point of a beam from (0, 0) to (1, 0) on two supports that is struck there from
    /// above, shape (3, rows) [N, N m, Pa].
    fn struck(&self, elements: usize, share: f64, yields: bool) -> [Vec<f64>; 3] {
        let mut b = ModelBuilder::new();
        let density = self.mass(6870.0) / self.length(1.0).powi(3);
        let stress = self.per(3e6, 2);
        let plasticity = Plasticity {
            curve: vec![Hardening { from: 0.0, stress, modulus: 0.0 }],
            kinematic: 0.0,
            overstress: None,
            failure_strain: None,
        };
        let inelasticity = yields.then_some(Inelasticity::Plastic(plasticity));
        let strain = StrainMeasure::Engineering;
        let plain = Material::new("m", self.per(47e9, 2), density);
        let material = b.material(Material { strain, inelasticity, ..plain });
        let side = self.length(0.03);
        let section = b.section(Section::rectangle("s", side, side));
        let ends = [self.place([0.0; 2]), self.place([1.0, 0.0])];
        let bar = b.beam(beam("a", ends[0], ends[1], elements, material, section));
        for (name, f) in [("left", 0.0), ("right", 1.0)] {
            b.support(Support::new(name, at(name, bar, f), SupportKind::Pin));
        }
        b.projectile(Projectile {
            kind: ProjectileKind::spring(self.per(168_000.0, 1)),
            mass: self.mass(0.08),
            standoff: 0.0,
            ..common::elastic("p", at("struck", bar, share), self.vector([0.0, -1.9]))
        });
        b.record_point(at("struck", bar, share));
        let model = b.build().unwrap();
        let (rows, _) = Rows::of(&model, &Settings::new(0.004, 5e-5));
        let column = |of: &str, by: f64| -> Vec<f64> {
            let all = rows.column(&format!("section.struck.{of}"));
            all.iter().map(|value| value * by).collect()
        };
        let (newton, metre) = (self.units[1] * self.units[0], self.units[0]);
        let stress: Vec<f64> =
            column("stress", newton / metre.powi(2)).iter().map(|s| s.abs()).collect();
        let [shear, moment] = [("shear", newton), ("moment", newton * metre)]
            .map(|(of, unit)| column(of, self.mirror * unit));
        [shear, moment, stress]
    }
}

fn assert_same(pose: &Pose, found: &[f64], known: &[f64]) {
    let size = known.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    assert_eq!(found.len(), known.len());
    for (k, (a, b)) in found.iter().zip(known).enumerate() {
        assert!((a - b).abs() <= 1e-6 * size, "{pose:?}, row {k}: {a} in place of {b}");
    }
}

/// Inside an element, at a node, and at the place next to a node that decimals make of it.
#[test]
fn at_a_jump_the_values_are_those_just_ahead_of_the_point_however_a_scene_lies() {
    for (elements, share) in [(3, 0.2), (10, 0.35), (10, 0.3), (7, 3.0 / 7.0)] {
        let known = AS_IT_IS.struck(elements, share, false);
        // Pressed down: the part ahead of the point bears towards the support on its right, V = dM/ds < 0.
        let least = known[0].iter().copied().fold(f64::INFINITY, f64::min);
        assert!(least < -60.0, "{elements}, {share}: {least}");
        for pose in &POSES {
            let found = pose.struck(elements, share, false);
            (0..3).for_each(|k| assert_same(pose, &found[k], &known[k]));
        }
    }
}

/// At thirds of an element, and half-way between its Gauss points.
#[test]
fn stresses_of_a_beam_that_yields_are_those_of_one_gauss_point_however_a_scene_lies() {
    let half_way = 0.5 - 0.25 * 0.6_f64.sqrt();
    for xi in [1.0 / 3.0, 2.0 / 3.0, half_way, 1.0 - half_way, 0.0] {
        let share = (1.0 + xi) / 4.0;
        let known = AS_IT_IS.struck(4, share, true);
        for pose in &POSES {
            assert_same(pose, &pose.struck(4, share, true)[2], &known[2]);
        }
    }
}

/// A beam clamped at both ends under equal forces at its quarters: its largest moments are those at the ends, its shear forces those before the
/// first force and after the second. Of the ends the first is told, of the shear forces the positive one.
#[test]
fn of_values_as_large_the_positive_and_the_first_is_told_however_a_scene_lies() {
    for pose in &POSES {
        let mut b = ModelBuilder::new();
        let density = pose.mass(7850.0) / pose.length(1.0).powi(3);
        let material = b.material(Material::new("m", pose.per(210e9, 2), density));
        let (wide, deep) = (pose.length(0.03), pose.length(0.02));
        let section = b.section(Section::rectangle("s", wide, deep));
        let ends = [pose.place([0.0; 2]), pose.place([1.0, 0.0])];
        let bar = b.beam(beam("a", ends[0], ends[1], 8, material, section));
        for (name, f) in [("left", 0.0), ("right", 1.0)] {
            b.support(Support::new(name, at(name, bar, f), SupportKind::Clamp));
        }
        for fraction in [0.25, 0.75] {
            let force = pose.vector([0.0, -1.0]).map(|f| f / pose.length(1.0) * pose.per(1.0, 0));
            let kind = LoadKind::Point {
                at: at("load", bar, fraction),
                force,
                moment: 0.0,
                follower: false,
            };
            b.load(Load::new(format!("load at {fraction}"), kind));
        }
        let found = equilibrium(&b.build().unwrap()).unwrap();
        let moment = &found.section_forces[0].moment;
        let ends = if pose.mirror > 0.0 { moment.min } else { moment.max };
        assert!(ends.s < 1e-6 * pose.length(1.0), "{pose:?}: {moment:?}");
        let shear = &found.section_forces[0].shear;
        assert!(shear.largest().value > 0.0, "{pose:?}: {shear:?}");
    }
}
