//! Published motions, frequencies and impacts.

use std::collections::VecDeque;
use std::f64::consts::{PI, TAU};

use percuss::*;

use crate::check::{Checks, Curve, Report};
use crate::scene::{Recorded, published, scene, thinned};
use crate::structure::{or_nan, smooth};

/// Stiffness EI, mass and rotary inertia per length of the deep beam of NAFEMS \[N m^2, kg/m, kg m\].
const DEEP: [f64; 3] = [200e9 * 16.0 / 12.0, 8000.0 * 4.0, 8000.0 * 16.0 / 12.0];
/// Its shear stiffness, with the coefficient 5/6 of a rectangle and a Poisson's ratio of 0.3 \[N\].
const SHEAR: f64 = 5.0 / 6.0 * 200e9 / 2.6 * 4.0;
const DEEP_LENGTH: f64 = 10.0;

/// NAFEMS FV5: a deep simply supported beam. Its published flexural frequencies include shear deformation: the closed form of Timoshenko's beam
/// agrees with them. The reference here is Rayleigh's beam, and the quotient shows the effect of shear.
pub fn deep_beam() -> Report {
    let mut c = Checks::new();
    let model = scene(&mut c, published!("deep-beam")).model;
    let found = natural_frequencies(&model, 12);
    let near = |f: f64| {
        let off = |x: &f64| (x - f).abs();
        or_nan(found.iter().copied().min_by(|a, b| off(a).total_cmp(&off(b))))
    };
    c.relative("axial frequency, published [Hz]", near(125.0), 125.0, 1e-5);
    let [ei, mass, rotary] = DEEP;
    for (n, published, worth) in [(1, 42.650, 1.047), (2, 148.15, 1.152), (3, 283.47, 1.266)] {
        let k2 = (f64::from(n) * PI / DEEP_LENGTH).powi(2);
        let rayleigh = f64::sqrt(ei * k2 * k2 / (mass + rotary * k2)) / TAU;
        // The error of 24 elements grows with the fourth power of the number of waves.
        let mesh = 3e-7 * f64::from(n).powi(4);
        // a w^4 - b w^2 + d = 0
        let (a, d) = (rotary * mass / SHEAR, ei * k2 * k2);
        let b = mass + (rotary + ei * mass / SHEAR) * k2;
        let shears = f64::sqrt((b - f64::sqrt(b * b - 4.0 * a * d)) / (2.0 * a)) / TAU;
        c.relative(
            format!("flexure {n}: closed form without shear [Hz]"),
            near(rayleigh),
            rayleigh,
            mesh,
        );
        // The shear coefficient of the source differs in the third digit.
        c.relative(
            format!("flexure {n}: closed form with shear, published [Hz]"),
            shears,
            published,
            4e-3,
        );
        c.relative(
            format!("flexure {n}: too high without shear by a factor"),
            near(rayleigh) / published,
            worth,
            2e-3,
        );
    }
    c.into_report()
}

/// NAFEMS 5T: the same beam under a sudden load, with damping: modal sum.
pub fn stepped_load() -> Report {
    let mut c = Checks::new();
    let compiled = scene(&mut c, published!("stepped-load"));
    let run = Recorded::of(&compiled);
    let [ei, mass, rotary] = DEEP;
    let (load, alpha, beta) = (1e6, 5.36, 7.46e-5);
    let exact = |t: f64| -> f64 {
        let mode = |n: u32| {
            let k = f64::from(n) * PI / DEEP_LENGTH;
            let still = 4.0 * load / (PI * f64::from(n) * ei * k.powi(4));
            let w = f64::sqrt(ei * k.powi(4) / (mass + rotary * k * k));
            let zeta = alpha / (2.0 * w) + beta * w / 2.0;
            let sign = if n % 4 == 1 { 1.0 } else { -1.0 };
            let decay = f64::exp(-zeta * w * t);
            let moved = if zeta < 1.0 {
                let damped = w * f64::sqrt(1.0 - zeta * zeta);
                1.0 - decay * (f64::cos(damped * t) + zeta * w / damped * f64::sin(damped * t))
            } else {
                1.0 // at rest within less than a millisecond
            };
            sign * still * moved
        };
        (1..40).step_by(2).map(mode).sum()
    };
    let fine = (0..20_000).map(|k| f64::from(k) * 1e-6);
    let (time, peak) =
        fine.map(|t| (t, exact(t))).fold((0.0, 0.0), |a, b| if b.1 > a.1 { b } else { a });
    let measured = run.displacement("beam.mid", 1);
    c.relative("largest deflection [mm]", 1e3 * measured.value.abs(), 1e3 * peak, 1e-3);
    c.absolute("its instant [s]", measured.time, time, 2e-5);
    // The source includes shear deformation: a tenth more static deflection.
    let still = 5.0 * load * DEEP_LENGTH.powi(4) / (384.0 * ei);
    let sheared = load * DEEP_LENGTH.powi(2) / (8.0 * SHEAR);
    c.relative("at rest, with shear, published [mm]", 1e3 * (still + sheared), 0.538, 3e-3);
    c.relative(
        "largest deflection, published with shear [mm]",
        1e3 * measured.value.abs(),
        1.043,
        0.1,
    );
    let range = &run.summary.section_forces[0].stress;
    let stress = 1e-6 * range.max.value.max(-range.min.value);
    c.relative("largest stress, published [MPa]", stress, 18.76, 0.02);
    run.balances(&mut c);
    let curve = run.curve("point.beam.mid.displacement_2");
    let closed = (0..=40).map(|k| f64::from(k) * 5e-4).map(|t| [t, -exact(t)]).collect();
    c.figure(
        "Deflection of the middle",
        ["time [s]", "displacement [m]"],
        [
            Curve::computed("Percuss", thinned(&curve, 400)),
            Curve::reference("sum over modes", closed),
        ],
    );
    c.into_report()
}

/// ANSYS VM9: two springs and a force, with large displacements: the least of the potential energy.
pub fn two_springs() -> Report {
    let mut c = Checks::new();
    let compiled = scene(&mut c, published!("two-springs"));
    let run = Recorded::of(&compiled);
    let spring = |k: f64, end: f64, x: f64, y: f64| {
        let (dx, dy) = (x, y - end);
        let length = f64::hypot(dx, dy);
        let (force, stretch) = (k * (length - 10.0), length - 10.0);
        ([force * dx / length, force * dy / length], 0.5 * k * stretch * stretch)
    };
    // Newton's method with a finite-difference tangent, from a starting point nearby.
    let (mut x, mut y) = (8.0, 4.0);
    let residual = |x: f64, y: f64| {
        let (a, b) = (spring(8.0, 10.0, x, y).0, spring(1.0, -10.0, x, y).0);
        [a[0] + b[0] - 5.0, a[1] + b[1] - 5.0]
    };
    for _ in 0..50 {
        let (r, h) = (residual(x, y), 1e-6);
        let column =
            |a: [f64; 2], b: [f64; 2]| [(a[0] - b[0]) / (2.0 * h), (a[1] - b[1]) / (2.0 * h)];
        let (u, v) = (
            column(residual(x + h, y), residual(x - h, y)),
            column(residual(x, y + h), residual(x, y - h)),
        );
        let det = u[0] * v[1] - v[0] * u[1];
        x -= (r[0] * v[1] - v[0] * r[1]) / det;
        y -= (u[0] * r[1] - r[0] * u[1]) / det;
    }
    let last = |name: &str| or_nan(run.curve(name).last().map(|p| p[1]));
    let (found_x, found_y) =
        (last("point.node.start.displacement_1"), last("point.node.start.displacement_2"));
    c.relative("displacement to the side [cm]", found_x, x, 1e-6);
    c.relative("displacement upwards [cm]", found_y, y, 1e-6);
    // The published point is the end of a numerical search; the minimum of the energy is 2.5e-4 from it.
    c.relative("to the side, published", found_x, 8.631, 3e-4);
    c.relative("upwards, published", found_y, 4.533, 3e-4);
    let stored = spring(8.0, 10.0, found_x, found_y).1 + spring(1.0, -10.0, found_x, found_y).1;
    c.relative("strain energy, published [N cm]", stored, 24.01, 1e-3);
    run.balances(&mut c);
    c.into_report()
}

/// ANSYS VM65 and VM81: a container dropped on a spring.
pub fn dropped_container() -> Report {
    let mut c = Checks::new();
    let compiled = scene(&mut c, published!("dropped-container"));
    let run = Recorded::of(&compiled);
    let (gravity, mass, stiffness) = (386.0_f64, 0.5, 1973.92_f64);
    let w = f64::sqrt(stiffness / mass);
    let (touch, speed, sag) =
        (f64::sqrt(2.0 / gravity), f64::sqrt(2.0 * gravity), gravity / (w * w));
    // x = sag (1 - cos) + speed / w sin
    let deepest = sag + f64::hypot(sag, speed / w);
    let lowest = touch + (PI - f64::atan(speed / (w * sag))) / w;
    let (peak, intervals) = smooth(&run.summary);
    let begins = or_nan(intervals.first().map(|i| i.start));
    let approach = or_nan(intervals.first().map(|i| i.approach_velocity));
    c.absolute("touches at [s]", begins, touch, 1e-5);
    c.relative("touches at, published [s]", begins, 0.07198, 2e-4);
    c.relative("speed as it touches [in/s]", approach, speed, 1e-4);
    c.relative("speed, published [in/s]", approach, 27.79, 1e-3);
    c.relative("deepest at [s]", peak.time, lowest, 1e-3);
    c.relative("deepest at, published [s]", peak.time, 0.10037, 2e-3);
    c.relative("pressed in by [in]", peak.value / stiffness, deepest, 1e-5);
    c.relative("lowest, published [in]", 1.0 + peak.value / stiffness, 1.5506, 1e-3);
    run.balances(&mut c);
    let curve = run.curve("contact.container.force");
    let exact = |t: f64| {
        let s = (t - touch).max(0.0);
        stiffness * (sag * (1.0 - f64::cos(w * s)) + speed / w * f64::sin(w * s))
    };
    let closed = (0..=44).map(|k| f64::from(k) * 2.5e-3).map(|t| [t, exact(t)]).collect();
    c.figure(
        "Force of the spring",
        ["time [s]", "force [lb]"],
        [Curve::computed("Percuss", thinned(&curve, 400)), Curve::reference("closed form", closed)],
    );
    c.into_report()
}

/// ANSYS VM77 (Biggs): a beam with a mass, under a force with a finite rise time.
pub fn rise_time() -> Report {
    let mut c = Checks::new();
    let compiled = scene(&mut c, published!("rise-time"));
    let run = Recorded::of(&compiled);
    let (length, inertia, rise) = (240.0_f64, 800.6, 0.075);
    let stiffness = 48.0 * 30e3 * inertia / length.powi(3);
    let w = f64::sqrt(stiffness / 0.0259067);
    let still = 20.0 / stiffness;
    let ramp = |t: f64| if t > 0.0 { (t - f64::sin(w * t) / w) / rise } else { 0.0 };
    let exact = |t: f64| still * (ramp(t) - ramp(t - rise));
    let peak = still * (1.0 + 2.0 * f64::sin(w * rise / 2.0).abs() / (w * rise));
    let instant =
        (0..150_000).map(|k| f64::from(k) * 1e-6).max_by(|a, b| exact(*a).total_cmp(&exact(*b)));
    let measured = run.displacement("beam.mid", 1);
    // The step of 0.2 ms is a five-hundredth of a period: an error of 5e-5 of the response. The deflection is 1e-3 of the length.
    c.relative("largest deflection [in]", measured.value.abs(), peak, 2e-4);
    c.absolute("its instant [s]", measured.time, or_nan(instant), 2e-4);
    // Values are read from a chart in the source.
    c.relative("largest deflection, published [in]", measured.value.abs(), 0.331, 0.015);
    c.relative("its instant, published [s]", measured.time, 0.092, 0.011);
    let range = &run.summary.section_forces[0].stress;
    let stress = range.max.value.max(-range.min.value);
    c.relative(
        "largest stress [ksi]",
        stress,
        stiffness * peak * length / 4.0 * 9.0 / inertia,
        1e-3,
    );
    c.relative("largest stress, published [ksi]", stress, 18.6, 0.016);
    run.balances(&mut c);
    let curve = run.curve("point.beam.mid.displacement_2");
    let closed = (0..=50).map(|k| f64::from(k) * 3e-3).map(|t| [t, -exact(t)]).collect();
    c.figure(
        "Deflection of the middle",
        ["time [s]", "displacement [in]"],
        [Curve::computed("Percuss", thinned(&curve, 400)), Curve::reference("closed form", closed)],
    );
    c.into_report()
}

/// In-plane modes of a thin free ring, symmetric to both axes: `n (n^2 - 1) / sqrt(n^2 + 1) sqrt(E I / rho A R^4)`.
pub fn ring_modes() -> Report {
    let mut c = Checks::new();
    let model = scene(&mut c, published!("ring")).model;
    let found = natural_frequencies(&model, 3);
    let speed = f64::sqrt(200e9 * 0.02 * 0.004_f64.powi(3) / 12.0 / (8000.0 * 0.02 * 0.004));
    for (k, n) in [2.0_f64, 4.0, 6.0].into_iter().enumerate() {
        let exact = n * (n * n - 1.0) / f64::sqrt(n * n + 1.0) * speed / TAU;
        // The formula is inextensional: stretching and rotary inertia of a thin ring change it by n^2 (h/R)^2 / 12.
        let thin = n * n * 1.6e-5 / 12.0;
        c.relative(
            format!("n = {n} [Hz]"),
            or_nan(found.get(k).copied()),
            exact,
            2.0 * thin + 1e-5,
        );
    }
    c.into_report()
}

/// Saint-Venant's rod, struck along its axis by a mass behind a spring: waves in closed form with a delay, integrated with small steps.
/// The wave into the rod has the velocity f'(t), its reflection from the wall -f'(t - T). At the struck end the
/// velocity is `f'(t) - f'(t - T)` and the force `Z (f'(t) + f'(t - T))`, `Z = E A / c`, `T = 2 L / c`.
pub fn struck_rod() -> Report {
    let mut c = Checks::new();
    let compiled = scene(&mut c, published!("struck-rod"));
    let run = Recorded::of(&compiled);
    let (impedance, trip, mass, stiffness) = (200e9 * 1e-4 / 5000.0, 8e-4, 1.6, 4e7);
    let step = 1e-8;
    let count = (trip / step) as usize;
    let mut sent: VecDeque<f64> = VecDeque::from(vec![0.0; count + 1]);
    let (mut speed, mut pressed, mut curve) = (0.01, 0.0_f64, Vec::new());
    let (mut peak, mut ends) = ((0.0, 0.0), f64::NAN);
    for k in 0..150_000 {
        let t = f64::from(k) * step;
        let force = stiffness * pressed.max(0.0);
        let back = sent.pop_front().unwrap_or(0.0);
        let out = force / impedance - back;
        sent.push_back(out);
        if force > peak.0 {
            peak = (force, t);
        }
        if k % 2000 == 0 {
            curve.push([t, force]);
        }
        if k > 0 && pressed <= 0.0 {
            ends = t;
            break;
        }
        // Velocities are updated before the compression: second order in a step of a ten-thousandth of the spring's time.
        speed -= force / mass * step;
        pressed += (speed - (out - back)) * step;
    }
    let (found, intervals) = smooth(&run.summary);
    // The mesh has 200 elements; the wave's front is as long as the spring makes it, 0.5 m.
    c.relative("largest force [N]", found.value, peak.0, 2e-3);
    c.relative("its instant [s]", found.time, peak.1, 5e-3);
    let end = or_nan(intervals.first().map(|i| i.end));
    c.relative("parts at [s]", end, ends, 2e-3);
    let impulse = or_nan(intervals.first().map(|i| i.impulse));
    c.relative("impulse until then [N s]", impulse, mass * (0.01 - speed), 2e-3);
    run.balances(&mut c);
    let computed = thinned(&run.curve("contact.hammer.force"), 500);
    c.figure(
        "Force of the hammer",
        ["time [s]", "force [N]"],
        [Curve::computed("Percuss", computed), Curve::reference("waves", curve)],
    );
    c.into_report()
}

/// Three beads above each other fall on a floor: the sequence of their impacts, computed from event to event.
pub fn bead_column() -> Report {
    const EVENTS: usize = 24;
    let mut c = Checks::new();
    let compiled = scene(&mut c, published!("bead-column"));
    let run = Recorded::of(&compiled);
    let (gravity, restitution, mass) = (9.81_f64, 0.9, [1.0, 2.0, 0.5]);
    // Heights of the lowest points above their positions in a resting stack.
    let mut height = [0.5, 0.6, 0.8];
    let (mut speed, mut time, mut events) = ([0.0_f64; 3], 0.0, Vec::new());
    while events.len() < EVENTS {
        let floor =
            (speed[0] + f64::sqrt(speed[0] * speed[0] + 2.0 * gravity * height[0])) / gravity;
        let closing = |k: usize| {
            let rate: f64 = speed[k - 1] - speed[k];
            if rate > 0.0 { (height[k] - height[k - 1]) / rate } else { f64::INFINITY }
        };
        let next = [floor, closing(1), closing(2)];
        let first = (0..3).min_by(|a, b| next[*a].total_cmp(&next[*b])).unwrap_or(0);
        let dt = next[first];
        for k in 0..3 {
            height[k] += speed[k] * dt - 0.5 * gravity * dt * dt;
            speed[k] -= gravity * dt;
        }
        time += dt;
        let impulse = if first == 0 {
            height[0] = 0.0;
            let impulse = -(1.0 + restitution) * mass[0] * speed[0];
            speed[0] += impulse / mass[0];
            impulse
        } else {
            let (a, b) = (first - 1, first);
            height[b] = height[a];
            let reduced = mass[a] * mass[b] / (mass[a] + mass[b]);
            let impulse = (1.0 + restitution) * reduced * (speed[a] - speed[b]);
            speed[a] -= impulse / mass[a];
            speed[b] += impulse / mass[b];
            impulse
        };
        events.push((time, impulse));
    }
    let of = |contact: &ContactSummary| match &contact.record {
        ContactRecord::Nonsmooth { impacts, .. } => impacts.clone(),
        ContactRecord::Smooth { .. } => Vec::new(),
    };
    let mut found: Vec<Impact> = run.summary.contacts.iter().flat_map(of).collect();
    found.sort_by(|a, b| a.time.total_cmp(&b.time));
    for (k, (time, impulse)) in events.iter().enumerate() {
        let impact = found.get(k);
        // Impacts take an interval of a ten-millionth of the step each, and errors grow from impact to impact.
        c.relative(
            format!("impact {}: instant [s]", k + 1),
            or_nan(impact.map(|i| i.time)),
            *time,
            1e-6,
        );
        c.relative(
            format!("impact {}: impulse [N s]", k + 1),
            or_nan(impact.map(|i| i.impulse)),
            *impulse,
            1e-4,
        );
    }
    run.balances(&mut c);
    c.into_report()
}

/// code_aster SSNL106: the force of a fibre bar in tension beyond yield is its area times the yield stress.
pub fn fibre_bar() -> Report {
    let mut c = Checks::new();
    let compiled = scene(&mut c, published!("fibre-bar"));
    let run = Recorded::of(&compiled);
    let range = &run.summary.section_forces[0].axial;
    c.relative("axial force, published [N]", range.max.value, 3.0e6, 1e-6);
    let limit = 150e6 / 200e9;
    let plastic = &run.summary.plastic[0];
    let first = or_nan(plastic.first_yield.as_ref().map(|first| first.time));
    c.absolute("first yield [s]", first, limit / 2e-3, 5e-3);
    c.relative("dissipated [J]", plastic.dissipated, 3.0e6 * (2e-3 - limit), 1e-3);
    run.balances(&mut c);
    let curve = run.curve("support.pull.force_1");
    let closed = (0..=20).map(|k| f64::from(k) / 20.0);
    let closed = closed.map(|t| [t, 3e6 * ((2e-3 * t) / limit).min(1.0)]).collect();
    c.figure(
        "Force of the pull",
        ["time [s]", "force [N]"],
        [
            Curve::computed("Percuss", thinned(&curve, 200)),
            Curve::reference("elastic, then yield", closed),
        ],
    );
    c.into_report()
}
