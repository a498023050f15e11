//! Springs and hinges that yield.

use std::f64::consts::PI;

use percuss::*;

use crate::check::{Checks, Curve, Report};
use crate::scene::{Recorded, published, scene, thinned};
use crate::structure::or_nan;

/// ANSYS VM80: a mass on a rod that yields, under a force put on at once: elastic, then slowed by the limit less the force, then
/// elastic about where it has come to.
pub fn yielding_rod() -> Report {
    const INCH: f64 = 0.0254;
    let mut c = Checks::new();
    let run = Recorded::of(&scene(&mut c, published!("yielding-rod")));
    // In pounds of force, inches and seconds.
    let (stiffness, mass, force, limit) = (83.4_f64, 0.0259_f64, 30.0, 45.2862);
    let omega = f64::sqrt(stiffness / mass);
    let (still, elastic) = (force / stiffness, limit / stiffness);
    let yields = f64::acos(1.0 - elastic / still) / omega;
    let speed = still * omega * f64::sin(omega * yields);
    let slower = (limit - force) / mass;
    let (most, when) = (elastic + speed * speed / (2.0 * slower), yields + speed / slower);
    let back = (limit - force) / stiffness;
    let curve: Vec<[f64; 2]> =
        run.curve("point.slide.start.displacement_2").iter().map(|p| [p[0], p[1] / INCH]).collect();
    let measured = run.displacement("slide.start", 1);
    let top = measured.value / INCH;
    let after = curve.iter().filter(|p| p[0] > when);
    let least = after.min_by(|a, b| a[1].total_cmp(&b[1])).copied();
    let [least_at, least] = least.unwrap_or([f64::NAN; 2]);
    c.relative("largest deflection [in]", top, most, 1e-4);
    c.relative("its instant [s]", measured.time, when, 1e-3);
    c.relative("least deflection after it [in]", least, most - 2.0 * back, 1e-4);
    c.relative("its instant [s]", least_at, when + PI / omega, 1e-3);
    c.relative("largest deflection, published [in]", top, 0.806, 3e-3);
    c.relative("its instant, published [s]", measured.time, 0.0669, 2e-3);
    c.relative("least deflection after it, published [in]", least, 0.438, 2e-3);
    c.relative("its instant, published [s]", least_at, 0.122, 3e-3);
    let rod = &run.summary.yielding[0];
    c.relative("permanent extension [in]", rod.plastic / INCH, most - elastic, 1e-4);
    c.absolute("first yield [s]", or_nan(rod.first_yield), yields, 2e-5);
    let dissipated = limit * (most - elastic);
    c.relative("dissipated [lbf in]", rod.dissipated / (4.448_221_615_260_5 * INCH), dissipated, 1e-4);
    run.balances(&mut c);
    let closed = |t: f64| match t {
        t if t < yields => still * (1.0 - f64::cos(omega * t)),
        t if t < when => most - 0.5 * slower * (when - t).powi(2),
        _ => most - back * (1.0 - f64::cos(omega * (t - when))),
    };
    let closed = (0..=100).map(|k| f64::from(k) * 2.5e-3).map(|t| [t, closed(t)]).collect();
    c.figure(
        "Deflection of the mass",
        ["time [s]", "deflection [in]"],
        [
            Curve::computed("Percuss", thinned(&curve, 400)),
            Curve::reference("closed form", closed),
        ],
    );
    c.into_report()
}

/// A stiff bar turns about a hinge of moment `M` by `K/M - M/2k` for good, `K` its energy and `k` the hinge's stiffness, and swings on
/// about there.
pub fn yielding_hinge() -> Report {
    let mut c = Checks::new();
    let run = Recorded::of(&scene(&mut c, published!("yielding-hinge")));
    let (mass, spin, moment, stiffness) = (10.0, 12.0, 300.0, 1e4);
    // A square bar about its end, the inertia of its section with it.
    let inertia = mass * (1.0 / 3.0 + 0.1_f64.powi(2) / 12.0);
    let energy = 0.5 * inertia * spin * spin;
    let rotation = energy / moment - moment / (2.0 * stiffness);
    let hinge = &run.summary.yielding[0];
    let found = hinge.plastic.abs();
    // The bar bends by M L / 3 E I, a thousandth of what the hinge turns elastically, and carries waves.
    c.relative("permanent rotation [rad]", found, rotation, 1e-3);
    c.relative("over that of a rigid, plastic hinge", found / (energy / moment), 0.9842, 1e-3);
    c.relative("dissipated [J]", hinge.dissipated, moment * found, 1e-9);
    c.relative("energy at the start [J]", run.summary.energy.initial, energy, 1e-9);
    let first = f64::sqrt(inertia / stiffness);
    let yields = first * f64::asin(moment / (spin * f64::sqrt(inertia * stiffness)));
    c.absolute("first yield [s]", or_nan(hinge.first_yield), yields, 4e-4);
    run.balances(&mut c);
    c.into_report()
}

/// The frame of `portal-hinges.toml` by hand: heights and spans \[m\], `EI` \[N m^2\], stiffness \[N m\] and limit \[N m\] of its hinges, both
/// forces \[N\].
struct Portal {
    height: f64,
    span: f64,
    bending: f64,
    stiffness: f64,
    limit: f64,
    force: f64,
}

const PORTAL: Portal = Portal {
    height: 4.0,
    span: 6.0,
    bending: 200e9 * 1e-4 / 12.0,
    stiffness: 1e7,
    limit: 100.0,
    force: 100.0,
};
const PLACES: [&str; 5] = ["left_foot", "left_knee", "middle", "right_knee", "right_foot"];

impl Portal {
    /// Moments at the five places, counter-clockwise from the left foot on, linear between: of forces and a moment at the left foot that is
    /// cut, and of both loads, shape (4, 5).
    fn moments(&self) -> [[f64; 5]; 4] {
        let (h, l) = (self.height, self.span);
        // About (x, y) of each place: x F2 - y F1 + M of the foot; the sway acts at height h, the weight at l/2.
        let places = [[0.0, 0.0], [0.0, h], [0.5 * l, h], [l, h], [l, 0.0]];
        let along = places.map(|p: [f64; 2]| p[1]);
        let across = places.map(|p| -p[0]);
        let sway = [0.0, 0.0, 0.0, 0.0, -h].map(|y| y * self.force);
        let weight = places.map(|p| (p[0] - 0.5 * l).max(0.0) * self.force);
        [along, across, [1.0; 5], std::array::from_fn(|k| sway[k] + weight[k])]
    }

    /// How fast moments grow with the load factor where some places have yielded, which bear no more: the least complementary energy.
    fn rates(&self, yielded: &[bool; 5]) -> [f64; 5] {
        let m = self.moments();
        let lengths = [self.height, 0.5 * self.span, 0.5 * self.span, self.height];
        let energy = |a: &[f64; 5], b: &[f64; 5]| {
            let member = |k: usize| {
                let (a, b) = ([a[k], a[k + 1]], [b[k], b[k + 1]]);
                let product = 2.0 * (a[0] * b[0] + a[1] * b[1]) + a[0] * b[1] + a[1] * b[0];
                lengths[k] * product / (6.0 * self.bending)
            };
            // What has yielded gives way as if it had next to no stiffness.
            let gives = |k: usize| if yielded[k] { 1e9 } else { 1.0 } / self.stiffness;
            let hinge = |k: usize| gives(k) * a[k] * b[k];
            (0..4).map(member).sum::<f64>() + (0..5).map(hinge).sum::<f64>()
        };
        let mut rows: [[f64; 4]; 3] =
            std::array::from_fn(|i| std::array::from_fn(|j| energy(&m[i], &m[j])));
        for k in 0..3 {
            let pivot = rows[k];
            for (i, row) in rows.iter_mut().enumerate().filter(|(i, _)| *i != k) {
                let share = row[k] / pivot[k];
                debug_assert!(i < 3);
                *row = std::array::from_fn(|j| row[j] - share * pivot[j]);
            }
        }
        let redundant: [f64; 3] = std::array::from_fn(|k| -rows[k][3] / rows[k][k]);
        std::array::from_fn(|p| m[3][p] + (0..3).map(|k| redundant[k] * m[k][p]).sum::<f64>())
    }

    /// The four places that yield up to the mechanism, in their order, and the load factors at which they do.
    fn hinges(&self) -> Vec<(usize, f64)> {
        let (mut moment, mut factor, mut yielded) = ([0.0_f64; 5], 0.0, [false; 5]);
        let mut found = Vec::new();
        for _ in 0..4 {
            let rate = self.rates(&yielded);
            let left = |k: usize| (self.limit - moment[k] * rate[k].signum()) / rate[k].abs();
            let open = (0..5).filter(|k| !yielded[*k]);
            let Some(next) = open.min_by(|a, b| left(*a).total_cmp(&left(*b))) else { break };
            let more = left(next);
            (0..5).for_each(|k| moment[k] += more * rate[k]);
            factor += more;
            yielded[next] = true;
            found.push((next, factor));
        }
        found
    }
}

/// A portal frame pushed until its hinges make a mechanism: its limit load and the order of its hinges.
pub fn portal_hinges() -> Report {
    let mut c = Checks::new();
    let model = scene(&mut c, published!("portal-hinges")).model;
    let hinges = PORTAL.hinges();
    // Sway and beam together: P h + P l/2 = 6 M over the same turn.
    let collapse = 6.0 * PORTAL.limit / (PORTAL.force * (PORTAL.height + 0.5 * PORTAL.span));
    c.relative("limit load by hand, hinge by hinge", hinges[3].1, collapse, 1e-6);
    let end = PathEnd::Displacement { point: "left.end".into(), component: 1, value: 2e-3 };
    let found = equilibrium_path(&model, &PathSettings { end, ..PathSettings::default() });
    let Ok(path) = found else {
        c.at_least("a path is found", f64::NAN, 1.0);
        return c.into_report();
    };
    for (k, (place, factor)) in hinges.iter().enumerate() {
        let first = path.yields.get(k);
        let name = format!("joint.{}", PLACES[*place]);
        let right = first.is_some_and(|first| first.name == name);
        c.at_least(format!("hinge {}: {name}", k + 1), f64::from(u8::from(right)), 1.0);
        c.relative(
            format!("hinge {}: load factor", k + 1),
            or_nan(first.map(|first| first.factor)),
            *factor,
            1e-3,
        );
    }
    c.absolute("hinges in all", path.yields.len() as f64, 4.0, 0.0);
    let last = or_nan(path.points.last().map(|point| point.factor));
    c.relative("limit load", last, collapse, 1e-3);
    let most = path.points.iter().map(|point| point.factor).fold(0.0, f64::max);
    c.relative("largest load factor", most, collapse, 1e-3);
    let at_limit = path.end.yielding.iter().filter(|one| {
        (one.force.abs() / PORTAL.limit - 1.0).abs() < 1e-9
    });
    c.absolute("hinges that bear their limit at the end", at_limit.count() as f64, 4.0, 0.0);
    let curve = path.points.iter().map(|p| [1e3 * p.displacements[0][0], p.factor]).collect();
    c.figure(
        "Load factor over the sway",
        ["sway [mm]", "load factor [-]"],
        [
            Curve::computed("Percuss", curve),
            Curve::reference("limit load", vec![[0.0, collapse], [2.0, collapse]]),
        ],
    );
    c.into_report()
}
