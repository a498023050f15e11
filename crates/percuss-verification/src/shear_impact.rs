//! Impacts of a rigid mass on shear-flexible beams, which have a limit on fine meshes.

use percuss::*;

use crate::check::{Checks, Report};
use crate::shear::Stub;
use crate::structure::at;

/// The section of the paper's second example, with shear.
const SECTION: Stub = Stub {
    length: 3.0,
    elements: 400,
    young: 2e11,
    density: 3e3,
    poisson: 0.3,
    kappa: 5.0 / 6.0,
    area: 0.1,
    inertia: 8.33e-5,
};

/// Mass of the projectile of that example \[kg\].
const MASS: f64 = 100.0;

/// A clamped beam struck in the middle by a rigid mass that stays in contact.
fn struck(stub: &Stub, speed: f64, standoff: f64) -> Model {
    let clamp = Some(SupportKind::Clamp);
    let (mut b, id) = stub.begun([clamp.clone(), clamp]);
    b.projectile(Projectile {
        name: "mass".into(),
        kind: ProjectileKind::Rigid { restitution: 0.0 },
        mass: MASS,
        velocity: [0.0, -speed],
        direction: None,
        strikes: at("struck", id, 0.5),
        standoff,
        rear: None,
        local_mass: 0.0,
    });
    b.build().expect("a verification case builds")
}

/// Distance moved and speed of the mass after each step, from the start on \[m, m/s\].
fn course(model: &Model, end: f64, step: f64) -> Vec<[f64; 2]> {
    let mut run = Simulation::new(model, &Settings::new(end, step)).expect("valid settings");
    let now = |state: &State| {
        let mass = state.projectile(model, 0);
        mass.map_or([f64::NAN; 2], |mass| [-mass.position[1], -mass.velocity[1]])
    };
    let mut all = vec![now(run.state())];
    while run.state().step < run.step_count() {
        if run.advance(&mut NoRecorder).is_err() {
            break;
        }
        if run.state().offset == 0.0 {
            all.push(now(run.state()));
        }
    }
    let start = all[0][0];
    all.iter().map(|[place, speed]| [place - start, *speed]).collect()
}

/// Velocity of the mass after the impact.
pub fn velocity() -> Report {
    let mut c = Checks::new();
    let step = 1e-7;
    // It touches after one step and a half.
    let model = struck(&SECTION, 40.0, 60.0 * step);
    let course = course(&model, 1.02e-4, step);
    for (microseconds, exact) in
        [(5.0, 34.8562072), (10.0, 30.570388), (20.0, 24.5604188), (100.0, 14.1394579)]
    {
        let k = (microseconds * 1e-6 / step).round() as usize + 1;
        let found = match course.get(k..k + 2) {
            Some([before, after]) => (after[0] - before[0]) / step,
            _ => f64::NAN,
        };
        c.relative(format!("velocity after {microseconds} us [m/s]"), found, exact, 1e-3);
    }
    c.into_report()
}

/// Force on the mass after the impact.
///
/// The struck node has a mass, which meets the projectile in an impulse, and waves as short as two elements do not travel: the force of single steps
/// rings about the limit. What has a limit with an order is the motion of the mass, and its change of momentum over an interval, the mean force.
pub fn force() -> Report {
    let mut c = Checks::new();
    // Slow, so that displacements are small; numbers are those of 40 m/s.
    let (speed, scale) = (0.4, 100.0);
    // Short beams, in which no wave returns to the middle before the end of the run.
    let run = |length: f64, elements: usize, (end, step): (f64, f64)| {
        let model = struck(&Stub { length, elements, ..SECTION }, speed, 0.0);
        course(&model, end, step)
    };
    let mean = |course: &[[f64; 2]], step: f64, [from, to]: [f64; 2]| {
        let speed = |t: f64| {
            let k = (t * 1e-6 / step).round() as usize;
            course.get(k).map_or(f64::NAN, |now| now[1])
        };
        // Momentum in N s over microseconds is MN.
        scale * MASS * (speed(from) - speed(to)) / (to - from)
    };
    let mut lost: [Vec<[f64; 2]>; 2] = Default::default();
    for elements in [50, 100, 200] {
        let step = 6.25e-6 / elements as f64;
        let course = run(0.1, elements, (11.05e-6, step));
        for ((microseconds, exact), errors) in
            [(5.0, 1.867_974_000_4e-4), (10.0, 3.499_963_577_2e-4)].into_iter().zip(&mut lost)
        {
            let t = microseconds * 1e-6;
            let k = (t / step).round() as usize;
            let moved = course.get(k).map_or(f64::NAN, |now| scale * now[0]);
            let unhindered = scale * speed * t;
            let error = ((unhindered - moved) / (unhindered - exact) - 1.0).abs();
            errors.push([0.1 / elements as f64, error]);
            if elements == 200 {
                let what = format!("distance lost by the force in {microseconds} us [m]");
                c.relative(what, unhindered - moved, unhindered - exact, 1e-4);
            }
        }
        if elements < 200 {
            continue;
        }
        for (microseconds, exact) in [(1.0, 38.906_148_5), (5.0, 34.856_207_2), (10.0, 30.570_388)]
        {
            let k = (microseconds * 1e-6 / step).round() as usize;
            let found = course.get(k).map_or(f64::NAN, |now| scale * now[1]);
            c.relative(format!("velocity after {microseconds} us [m/s]"), found, exact, 2e-5);
        }
        for (window, exact) in
            [([0.0, 2.0], 107.798_860), ([4.0, 6.0], 94.484_505), ([9.0, 11.0], 76.882_768)]
        {
            let what = format!("mean force from {} to {} us [MN]", window[0], window[1]);
            c.relative(what, mean(&course, step, window), exact, 1e-4);
        }
        // The means from the start over 1 and 2 us, extrapolated to none; the rest is of second order in the time, 2.8e-4.
        let [one, two] = [[0.0, 1.0], [0.0, 2.0]].map(|window| mean(&course, step, window));
        let shear = SECTION.kappa * SECTION.young / 2.6 * SECTION.area;
        let impedance = 2.0 * (shear * SECTION.density * SECTION.area).sqrt();
        let limit = impedance * scale * speed * 1e-6;
        c.relative("closed form of the force at 0+ [MN]", limit, 110.940_039_2, 1e-9);
        c.relative("force at 0+ [MN]", 2.0 * one - two, limit, 1e-3);
        for (window, exact) in
            [([0.0, 2.0], 107.814_194), ([4.0, 6.0], 94.492_482_2), ([9.0, 11.0], 76.879_457_4)]
        {
            let what = format!("force at {} us [MN]", 0.5 * (window[0] + window[1]));
            c.relative(what, mean(&course, step, window), exact, 5e-4);
        }
    }
    for (microseconds, errors) in [5, 10].into_iter().zip(lost) {
        let title =
            format!("Distance that the force has taken from the mass after {microseconds} us");
        let order = c.convergence(title, ["element size [m]", "relative error"], errors);
        c.absolute(format!("order of that distance, {microseconds} us"), order, 2.0, 0.05);
    }
    for (length, elements, step, window, exact) in [
        (0.2, 200, 1.25e-7, [18.0, 22.0], [44.765_503, 44.681_059_4]),
        (0.9, 450, 2.5e-7, [95.0, 105.0], [5.184_381, 5.182_167_87]),
    ] {
        let course = run(length, elements, (window[1] * 1e-6 + 0.1 * step, step));
        let found = mean(&course, step, window);
        let what = format!("mean force from {} to {} us [MN]", window[0], window[1]);
        c.relative(what, found, exact[0], 3e-4);
        let middle = 0.5 * (window[0] + window[1]);
        c.relative(format!("force at {middle} us [MN]"), found, exact[1], 3e-3);
    }
    c.into_report()
}
