//! Statics compared with closed forms and published values: large bending, buckling, snap-through.

use std::f64::consts::PI;

use percuss::*;

use crate::check::{Checks, Report};
use crate::structure::{at, lee, or_nan};

const BOTH: [(&str, StrainMeasure); 2] =
    [("Green", StrainMeasure::Green), ("engineering", StrainMeasure::Engineering)];

/// A cantilever along e1 with a dead force and a moment at its tip, whose displacement is recorded.
struct Cantilever {
    strain: StrainMeasure,
    elements: usize,
    length: f64,
    young: f64,
    area: f64,
    inertia: f64,
    /// Force at the tip, shape (2) \[N\].
    force: [f64; 2],
    moment: f64,
}

impl Cantilever {
    fn model(&self) -> Model {
        let mut b = ModelBuilder::new();
        let material = Material { strain: self.strain, ..Material::new("m", self.young, 1.0) };
        let material = b.material(material);
        let section = b.section(Section::new("s", self.area, self.inertia));
        let ends = [[0.0, 0.0], [self.length, 0.0]];
        let arm = b.beam(Beam::new("arm", &ends, self.elements, material, section));
        b.support(Support::new("root", at("arm.start", arm, 0.0), SupportKind::Clamp));
        let tip = at("arm.end", arm, 1.0);
        let (force, moment) = (self.force, self.moment);
        let kind = LoadKind::Point { at: tip.clone(), force, moment, follower: false };
        b.load(Load::new("tip", kind));
        b.record_point(tip);
        b.build().expect("a verification case builds")
    }

    /// Displacement of the tip; NaN without equilibrium.
    fn tip(&self) -> [f64; 2] {
        equilibrium(&self.model()).map_or([f64::NAN; 2], |found| found.points[0].1)
    }
}

/// alpha = P L^2 / EI, then w/L and u/L by elliptic integrals.
const BISSHOPP_DRUCKER: [(f64, f64, f64); 4] = [
    (1.0, 0.3017207738, 0.0564332363),
    (2.0, 0.4934574804, 0.1606417208),
    (5.0, 0.7137915236, 0.3876283607),
    (10.0, 0.8106090249, 0.5549955978),
];

fn tip_loaded(strain: StrainMeasure, elements: usize, alpha: f64) -> Cantilever {
    let inertia = 1e-9; // I/(A L^2)
    Cantilever {
        strain,
        elements,
        length: 1.0,
        young: 1.0,
        area: 1.0,
        inertia,
        force: [0.0, alpha * inertia],
        moment: 0.0,
    }
}

/// A1: cantilever under a dead tip force (Bisshopp and Drucker 1945), elliptic integrals.
pub fn cantilever() -> Report {
    let mut c = Checks::new();
    for (name, strain) in BOTH {
        for (alpha, w, u) in BISSHOPP_DRUCKER {
            let [x, y] = tip_loaded(strain, 32, alpha).tip();
            c.absolute(format!("{name}, alpha {alpha}: w/L"), y, w, 1e-6);
            c.absolute(format!("{name}, alpha {alpha}: u/L"), -x, u, 1e-6);
        }
        // Errors of the mesh decrease with the fourth power of the element length.
        for (alpha, w, u) in BISSHOPP_DRUCKER {
            let error = |n: usize| {
                let [x, y] = tip_loaded(strain, n, alpha).tip();
                (y - w).hypot(-x - u)
            };
            let what = format!("{name}, alpha {alpha}");
            let errors = [8, 16].map(|n| [1.0 / n as f64, error(n)]);
            let axes = ["length of an element / L", "error of the tip / L"];
            let order = c.convergence(what.clone(), axes, errors.to_vec());
            c.absolute(format!("{what}: order from 8 to 16 elements"), order, 4.0, 0.1);
        }
    }
    c.into_report()
}

/// A2: roll-up by an end moment, closed form in both strain measures; and a moment that Green strains cannot carry.
pub fn roll_up() -> Report {
    let mut c = Checks::new();
    // GXBeam's data: L = 12, 1 x 1, E = 30e6.
    let (length, young, area, inertia) = (12.0, 30e6, 1.0, 1.0 / 12.0);
    for turns in [0.5, 1.0] {
        for (name, strain) in BOTH {
            let moment = turns * 2.0 * PI * young * inertia / length;
            // M = EI k (1 - 2 (I/A) k^2) in Green strains, nu = sqrt(1 - 2 (I/A) k^2); k = M/EI and nu = 1 in engineering ones.
            let ratio = if strain == StrainMeasure::Green { inertia / area } else { 0.0 };
            let mut k = moment / (young * inertia);
            for _ in 0..100 {
                k = moment / (young * inertia) / (1.0 - 2.0 * ratio * k * k);
            }
            let nu = (1.0 - 2.0 * ratio * k * k).sqrt();
            let angle = k * length;
            let expected = [nu / k * angle.sin() - length, nu / k * (1.0 - angle.cos())];
            let force = [0.0; 2];
            let elements = 64;
            let arm = Cantilever { strain, elements, length, young, area, inertia, force, moment };
            let found = arm.tip();
            for i in 0..2 {
                let what = format!("{name}, {turns} turns: tip displacement {}", i + 1);
                c.absolute(what, found[i], expected[i], 5e-5);
            }
        }
    }
    // code_aster SSNL103: E 1, A 1, I 2, L 1, M 4 pi has no solution in Green strains.
    let arm = Cantilever {
        strain: StrainMeasure::Green,
        elements: 32,
        length: 1.0,
        young: 1.0,
        area: 1.0,
        inertia: 2.0,
        force: [0.0; 2],
        moment: 4.0 * PI,
    };
    let refusal = equilibrium(&arm.model()).err().map(|e| e.to_string());
    let says_so = refusal.is_some_and(|text| {
        text.contains("at most 3.849002e-1 N m") && text.contains("engineering")
    });
    c.at_least("SSNL103 in Green strains is refused, with the largest moment", says_so.into(), 1.0);
    c.into_report()
}

/// A3: a column beyond its buckling load (ANSYS VM136), elliptic integrals; its linear buckling factor.
pub fn buckled_column() -> Report {
    let mut c = Checks::new();
    let (length, young, side) = (100.0, 3e7, 0.5_f64);
    let inertia = side.powi(4) / 12.0;
    let critical = PI * PI * young * inertia / (4.0 * length * length);
    c.relative("buckling load [lbf], published 38.553", critical, 38.553, 2e-5);
    for (angle, share, x, y) in [
        (60, 1.151_719_62, 0.741_019_606_1, 0.593_207_646_2),
        (80, 1.293_889_324, 0.559_395_919_0, 0.719_497_104_7),
    ] {
        let column = |lateral: f64| Cantilever {
            strain: StrainMeasure::Green,
            elements: 32,
            length,
            young,
            area: side * side,
            inertia,
            force: [-share * critical, lateral * critical],
            moment: 0.0,
        };
        // A lateral force determines the side.
        let found = column(1e-5).tip();
        // Axial strains of P/EA = 6e-6, which the inextensible closed form neglects, have a larger effect near buckling.
        c.relative(format!("{angle} deg: tip x/L"), 1.0 + found[0] / length, x, 1e-4);
        c.relative(format!("{angle} deg: tip y/L"), found[1] / length, y, 1e-4);
    }
    let loaded = Cantilever {
        strain: StrainMeasure::Green,
        elements: 32,
        length,
        young,
        area: side * side,
        inertia,
        force: [-critical, 0.0],
        moment: 0.0,
    };
    let factor = buckling(&loaded.model(), 1).modes.first().map(|m| m.factor);
    c.relative("linear buckling factor", or_nan(factor), 1.0, 2e-5);
    c.into_report()
}

/// A5: Lee's frame, a rigid corner and a path beyond its limit points; engineering strains, independent shooting.
pub fn lees_frame() -> Report {
    let mut c = Checks::new();
    let strain = StrainMeasure::Engineering;
    let material = Material { strain, ..Material::new("m", 7.2e6, 1.0) };
    let model = lee(80, material, Section::new("s", 6.0, 2.0), Theory::Slender);
    let down_to = |v: f64| {
        let point = "load".into();
        let end = PathEnd::Displacement { point, component: 2, value: -v };
        equilibrium_path(&model, &PathSettings { first: 1000.0, points: 500, end }).ok()
    };
    for (v, p, u) in [
        (10.0, 9635.10, 1.7103),
        (20.0, 13457.87, 5.2552),
        (30.0, 15952.90, 10.3348),
        (40.0, 17807.81, 17.5577),
    ] {
        let path = down_to(v);
        let end = path.as_ref().and_then(|p| p.points.last());
        c.relative(format!("v = {v}: load"), or_nan(end.map(|e| e.factor)), p, 5e-5);
        let found = or_nan(end.map(|e| e.displacements[0][0]));
        c.absolute(format!("v = {v}: u"), found, u, 3e-4);
    }
    let limits = down_to(95.0).map(|p| p.limit_points).unwrap_or_default();
    for (i, (name, p, v, u)) in
        [("largest", 18556.73, 48.735, 26.881), ("least", -9414.43, 58.217, 90.196)]
            .into_iter()
            .enumerate()
    {
        let limit = limits.get(i);
        let place = |k: usize| or_nan(limit.map(|l| l.displacements[0][k]));
        c.relative(format!("{name} load"), or_nan(limit.map(|l| l.factor)), p, 5e-5);
        c.absolute(format!("{name} load: v"), -place(1), v, 2e-3);
        c.absolute(format!("{name} load: u"), place(0), u, 2e-3);
    }
    c.into_report()
}

/// A shallow toggle of two hinged bars under a unit force on its top, over a floor.
fn toggle_over(rise: f64, floor: f64) -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("stuff", 1e9, 1e3));
    let section = b.section(Section::new("bar", 1e-4, 1e-5));
    let left = b.beam(Beam::new("left", &[[-1.0, 0.0], [0.0, rise]], 2, material, section));
    let right = b.beam(Beam::new("right", &[[0.0, rise], [1.0, 0.0]], 2, material, section));
    b.support(Support::new("a", at("a", left, 0.0), SupportKind::Pin));
    b.support(Support::new("b", at("b", right, 1.0), SupportKind::Pin));
    let between = [at("top", left, 1.0), at("top", right, 0.0)];
    b.joint(Joint::new("top", JointKind::Hinge, between));
    let shape = ObstacleShape::HalfPlane { point: [0.0, floor], normal: [0.0, 1.0] };
    let floor = b.obstacle(Obstacle { name: "floor".into(), shape, motion: None });
    let law = TouchLaw::Rigid(RigidLaw::frictionless(0.0));
    b.contact(Contact::new(
        "on_floor",
        [ContactPartner::Beam(left), ContactPartner::Obstacle(floor)],
        law,
    ));
    let top = at("top", left, 1.0);
    let (force, moment) = ([0.0, -1.0], 0.0);
    let kind = LoadKind::Point { at: top.clone(), force, moment, follower: false };
    b.load(Load::new("push", kind));
    b.record_point(top);
    b.build().expect("a verification case builds")
}

/// A toggle that snaps through onto a floor: `P = EA (rise^2 - h^2) h / l^3` in Green strain, limit points from it or where the floor stops the
/// top; the contact force is the rest of the load.
pub fn toggle_on_floor() -> Report {
    let mut c = Checks::new();
    for (rise, floor) in [(0.05, -0.03), (0.05, -0.02), (0.02, -0.012)] {
        let load = |h: f64| 1e5 * (rise * rise - h * h) * h / 1.0_f64.hypot(rise).powi(3);
        let flat = rise / 3.0_f64.sqrt();
        let (most, least) = (load(flat), load(f64::max(floor, -flat)));
        let end = PathEnd::Factor(1.5 * most);
        let settings = PathSettings { first: 0.02 * most, points: 2000, end };
        let path = equilibrium_path(&toggle_over(rise, floor), &settings).ok();
        let turns = path.as_ref().map(|p| p.limit_points.as_slice()).unwrap_or_default();
        let case = format!("rise {rise} m, floor at {floor} m:");
        for (k, exact) in [most, least].into_iter().enumerate() {
            let found = or_nan(turns.get(k).map(|p| p.factor));
            c.relative(format!("{case} limit point {}", k + 1), found, exact, 1e-6);
        }
        let pressed = path.and_then(|p| p.end.contacts.first().map(|c| c.force));
        let rest = 1.5 * most - load(floor);
        c.relative(format!("{case} force of the floor [N]"), or_nan(pressed), rest, 1e-8);
    }
    c.into_report()
}

/// A7: a regression figure of Exudyn, `LShapeGeomExactBeam2D` (shear-flexible, coarse: 1 %).
pub fn l_shape() -> Report {
    let mut c = Checks::new();
    let mut b = ModelBuilder::new();
    let strain = StrainMeasure::Engineering;
    let material = b.material(Material { strain, ..Material::new("steel", 2.1e11, 7850.0) });
    let section = b.section(Section::rectangle("s", 0.1, 0.05));
    let points = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]];
    let legs = b.beam(Beam::new("legs", &points, 8, material, section));
    b.support(Support::new("root", at("root", legs, 0.0), SupportKind::Clamp));
    let tip = at("tip", legs, 1.0);
    let (force, moment) = ([1e6, 0.0], 0.0);
    let kind = LoadKind::Point { at: tip.clone(), force, moment, follower: false };
    b.load(Load::new("load", kind));
    b.record_point(tip);
    let model = b.build().expect("a verification case builds");
    let y = or_nan(equilibrium(&model).ok().map(|e| e.points[0].1[1]));
    c.relative("tip displacement 2 [m]", y, -0.918_147_451_051_521_4, 1e-2);
    c.into_report()
}

/// A quarter of a circle, clamped, with a small force at its tip: Castigliano's closed form for a slender bar.
pub fn curved_cantilever() -> Report {
    let mut c = Checks::new();
    let (radius, inertia) = (1.0_f64, 1e-8);
    let tip = |elements: usize, force: [f64; 2]| {
        let mut b = ModelBuilder::new();
        let material = b.material(Material::new("m", 1.0, 1.0));
        let section = b.section(Section::new("s", 1.0, inertia));
        let (sine, cosine) = (PI / 4.0).sin_cos();
        let points = [[0.0, 0.0], [radius * sine, radius * (1.0 - cosine)], [radius, radius]];
        let curve = Curve::Arc;
        let arc = Beam { curve, ..Beam::new("arc", &points, elements, material, section) };
        let arc = b.beam(arc);
        b.support(Support::new("root", at("root", arc, 0.0), SupportKind::Clamp));
        let tip = at("tip", arc, 1.0);
        let force = force.map(|f| f * inertia);
        b.load(Load::new(
            "tip",
            LoadKind::Point { at: tip.clone(), force, moment: 0.0, follower: false },
        ));
        b.record_point(tip);
        let model = b.build().expect("a verification case builds");
        equilibrium(&model).map_or([f64::NAN; 2], |e| e.points[0].1)
    };
    // Displacements per P R^3 / EI; the force is small enough for the linear theory.
    let small = 1e-6;
    let flexibility = [[PI / 4.0, -0.5], [-0.5, 0.75 * PI - 2.0]];
    for (k, row) in flexibility.into_iter().enumerate() {
        let mut force = [0.0; 2];
        force[k] = small;
        let found = tip(16, force);
        for i in 0..2 {
            let what = format!("force {}: tip displacement {}, EI / (P R^3)", k + 1, i + 1);
            c.absolute(what, found[i] / small, row[i], 1e-5);
        }
        let error = |n: usize| {
            let found = tip(n, force);
            (found[0] / small - row[0]).hypot(found[1] / small - row[1])
        };
        let order = (error(4) / error(8)).log2();
        c.at_least(format!("force {}: order from 4 to 8 elements", k + 1), order, 3.9);
    }
    c.into_report()
}

/// Equilibria do not depend on the load steps that led to them.
pub fn load_steps() -> Report {
    let mut c = Checks::new();
    let heavy = {
        let mut arm = tip_loaded(StrainMeasure::Green, 32, 10.0);
        arm.inertia = 1e-6;
        arm.force = [0.0, 10.0 * arm.inertia];
        arm
    };
    let models = [
        ("cantilever, alpha 10", heavy.model()),
        ("Lee's frame at its own scale", {
            let mut b = ModelBuilder::new();
            let material = b.material(Material::new("m", 7.2e6, 1.0));
            let section = b.section(Section::new("s", 6.0, 2.0));
            let points = [[0.0, 0.0], [0.0, 120.0], [120.0, 120.0]];
            let frame = b.beam(Beam::new("frame", &points, 20, material, section));
            for (name, f) in [("foot", 0.0), ("wall", 1.0)] {
                b.support(Support::new(name, at(name, frame, f), SupportKind::Pin));
            }
            let point =
                PointRef { label: "load".into(), beam: frame, along: Along::Distance(144.0) };
            let force = [0.0, -1.5e4];
            let kind = LoadKind::Point { at: point.clone(), force, moment: 0.0, follower: false };
            b.load(Load::new("load", kind));
            b.record_point(point);
            b.build().expect("a verification case builds")
        }),
    ];
    for (name, model) in models {
        let at_step = |step: f64| {
            equilibrium_in(&model, step).map_or([f64::NAN; 2], |found| found.points[0].1)
        };
        let reference = at_step(0.02);
        for step in [0.1, 0.37, 1.0] {
            let found = at_step(step);
            let distance = (found[0] - reference[0]).hypot(found[1] - reference[1]);
            let size = reference[0].hypot(reference[1]);
            let what = format!("{name}: load steps of {step} against 0.02, relative");
            c.at_most(what, distance / size, 1e-9);
        }
    }
    c.into_report()
}
