//! Axial impact of bars: exact waves, contact without spurious oscillation.

use percuss::*;

use crate::check::{Checks, Report};
use crate::structure::at;

const RIGID: fn(f64) -> TouchLaw = |e| TouchLaw::Rigid(RigidLaw::frictionless(e));

fn section(area: f64) -> Section {
    // Large bending stiffness: a bar in compression does not buckle.
    let mut section = Section::new("bar", area, 1e3 * area);
    section.rotary_inertia = RotaryInertia::Neglected;
    section
}

fn wall(b: &mut ModelBuilder, normal: [f64; 2]) -> ContactPartner {
    let shape = ObstacleShape::HalfPlane { point: [0.0, 0.0], normal };
    ContactPartner::Obstacle(b.obstacle(Obstacle { name: "wall".into(), shape, motion: None }))
}

/// Time and a column of a run's history.
struct History {
    /// Times, shape (rows) \[s\].
    time: Vec<f64>,
    rows: MemoryRecorder,
    summary: RunSummary,
}

impl History {
    fn of(simulation: Simulation) -> Self {
        let mut rows = MemoryRecorder::default();
        let summary = simulation.run(&mut rows);
        let time = rows.column("time").unwrap_or_default();
        Self { time, rows, summary }
    }

    fn value(&self, column: &str, time: f64) -> f64 {
        let values = self.rows.column(column).unwrap_or_default();
        let k = self.time.partition_point(|t| *t < time - 1e-12);
        values.get(k.min(values.len().saturating_sub(1))).copied().unwrap_or(f64::NAN)
    }

    fn impulses(&self) -> Vec<f64> {
        self.rows.column("contact.blow.impulse").unwrap_or_default()
    }

    /// Impulse between two times divided by the time between them.
    fn mean_force(&self, from: f64, to: f64) -> f64 {
        let each = self.time.iter().zip(self.impulses());
        each.filter(|(t, _)| **t > from && **t <= to).map(|(_, l)| l).sum::<f64>() / (to - from)
    }

    /// First and last instant with an impulse.
    fn pressed(&self) -> [f64; 2] {
        let pressed: Vec<f64> = self
            .time
            .iter()
            .zip(self.impulses())
            .filter(|(_, l)| *l > 0.0)
            .map(|(t, _)| *t)
            .collect();
        let or_nan = |t: Option<&f64>| t.copied().unwrap_or(f64::NAN);
        [or_nan(pressed.first()), or_nan(pressed.last())]
    }
}

/// A bar along `points` that moves against a wall at the origin.
fn flying_bar(
    points: [[f64; 2]; 2],
    material: Material,
    area: f64,
    elements: usize,
    velocity: [f64; 2],
    law: TouchLaw,
) -> ModelBuilder {
    let mut b = ModelBuilder::new();
    let (material, section) = (b.material(material), b.section(section(area)));
    let bar = b.beam(Beam::new("bar", &points, elements, material, section));
    let away = [points[1][0] - points[0][0], points[1][1] - points[0][1]];
    let wall = wall(&mut b, away);
    b.contact(Contact::new("blow", [ContactPartner::Beam(bar), wall], law));
    b.initial_motion(InitialMotion { velocity, spin: 0.0, about: [0.0; 2] });
    b.record_point(at("foot", bar, 0.0));
    b
}

fn history(b: &ModelBuilder, end: f64, step: f64) -> History {
    let model = b.build().expect("a verification case builds");
    History::of(Simulation::new(&model, &Settings::new(end, step)).expect("valid settings"))
}

/// D1: a bar on a rigid wall (ANSYS VM265; Carpenter, Taylor and Katona 1991). D4: the same of code_aster SDNV100.
pub fn bar_on_a_wall() -> Report {
    let mut c = Checks::new();
    let engineering = |m: Material| Material { strain: StrainMeasure::Engineering, ..m };
    for e in [0.0, 1.0] {
        let material = engineering(Material::new("VM265", 3e7, 0.73e-3));
        let points = [[0.01, 0.0], [10.01, 0.0]];
        let bar = flying_bar(points, material, 1.0, 20, [-202.2, 0.0], RIGID(e));
        let h = history(&bar, 2e-4, 2.5e-7);
        let [first, last] = h.pressed();
        // Contact lasts 2L/c, at a force EA v/c; c = 202,720 m/s.
        c.relative(format!("D1, e = {e}: impact [s]"), first, 4.9455984e-5, 1e-6);
        c.relative(format!("D1, e = {e}: release [s]"), last, 1.48113641e-4, 5e-3);
        let force = h.mean_force(6e-5, 1.4e-4);
        c.relative(format!("D1, e = {e}: mean force in contact [N]"), force, 29_922.867, 3e-3);
        if e == 1.0 {
            let loss = h.summary.energy.loss_impacts.abs() / h.summary.energy.initial;
            c.at_most("D1, e = 1: energy lost", loss, 1e-10);
        }
        c.at_most(format!("D1, e = {e}: energy residual"), h.summary.energy.residual_max, 1e-12);
    }
    let material = engineering(Material::new("SDNV100", 2e11, 8000.0));
    let points = [[2e-3, 0.0], [0.202, 0.0]];
    // Scaled by 1/100, as the source assumes small strains.
    let bar = flying_bar(points, material, 4e-4, 40, [-100.0, 0.0], RIGID(1.0));
    let h = history(&bar, 2e-3 / 100.0 + 1e-4, 2e-7);
    let [first, last] = h.pressed();
    c.relative("D4: impact [s]", first, 2e-5, 1e-5);
    c.relative("D4: time in contact [s]", last - first, 8e-5, 1e-2);
    c.relative("D4: mean force in contact [N]", h.mean_force(2.5e-5, 9.5e-5), 1.6e6, 5e-3);
    c.into_report()
}

/// D7: a bar strikes another one, equal, whose far end is fixed (code_aster SDNL111).
pub fn bar_on_a_bar() -> Report {
    let mut c = Checks::new();
    let stiff = SmoothLaw::elastic(Potential::Linear { stiffness: 4e10 });
    for (name, law, tolerance) in
        [("rigid", RIGID(1.0), 1.5e-6), ("stiff potential", TouchLaw::Smooth(stiff), 1.5e-6)]
    {
        let mut b = ModelBuilder::new();
        let material = Material::new("steel", 2e11, 7800.0);
        let material = b.material(Material { strain: StrainMeasure::Engineering, ..material });
        let mut square = Section::rectangle("square", 0.02, 0.02);
        square.rotary_inertia = RotaryInertia::Neglected;
        let square = b.section(square);
        let fixed = b.beam(Beam::new("fixed", &[[0.0, 0.0], [1.0, 0.0]], 80, material, square));
        let flying = b.beam(Beam::new("flying", &[[1.0, 0.0], [2.0, 0.0]], 80, material, square));
        b.support(Support::new("far", at("far", fixed, 0.0), SupportKind::Clamp));
        b.record_point(at("face", flying, 0.0));
        b.contact(Contact::new(
            "blow",
            [ContactPartner::Beam(fixed), ContactPartner::Beam(flying)],
            law,
        ));
        let model = b.build().expect("a verification case builds");
        let mut run = Simulation::new(&model, &Settings::new(1e-3, 5e-7)).expect("valid settings");
        let velocity = |name: &str, _: [f64; 2]| [if name == "flying" { -1.0 } else { 0.0 }, 0.0];
        run.set_velocities(velocity);
        let h = History::of(run);
        let expected = [-1e-4, -1.949684e-4, -9.49684e-5, 1.00633e-5, 2.100633e-4];
        for (k, expected) in expected.into_iter().enumerate() {
            let time = 2e-4 * (k + 1) as f64;
            let u = h.value("point.face.displacement_1", time);
            c.absolute(format!("{name}: face at {:.1} ms [m]", 1e3 * time), u, expected, tolerance);
        }
        c.relative(format!("{name}: mean force [N]"), h.mean_force(5e-5, 3.5e-4), 7899.367, 5e-3);
        c.at_most(format!("{name}: energy residual"), h.summary.energy.residual_max, 1e-10);
        c.at_most(
            format!("{name}: energy lost"),
            h.summary.energy.loss_impacts.abs() / h.summary.energy.initial,
            1e-10,
        );
    }
    c.into_report()
}

/// D8: the bouncing bar of Doyen, Ern and Piperno (2011), heights and gravity times 1e-4 so that strains are small.
pub fn bouncing_bar() -> Report {
    const SCALE: f64 = 1e-4;
    let mut c = Checks::new();
    let tau = 1.0 / 3.0;
    let bottom = [5.0, 4.4444, 2.7778, 0.0, 0.0, 0.0, 1.666667, 4.444444, 3.888889];
    let stiff = SmoothLaw::elastic(Potential::Linear { stiffness: 1e5 });
    for (name, law) in [
        ("restitution 1", RIGID(1.0)),
        ("restitution 0", RIGID(0.0)),
        ("stiff potential", TouchLaw::Smooth(stiff)),
    ] {
        let points = [[0.0, 5.0 * SCALE], [0.0, 10.0 + 5.0 * SCALE]];
        let material = Material::new("bar", 900.0, 1.0);
        let mut bar = flying_bar(points, material, 1.0, 50, [0.0; 2], law);
        let fall = LoadKind::Gravity { acceleration: [0.0, -10.0 * SCALE] };
        bar.load(Load::new("weight", fall));
        let h = history(&bar, 17.0 * tau, tau / 60.0);
        for (m, expected) in bottom.into_iter().enumerate() {
            let u = h.value("point.foot.displacement_2", m as f64 * tau);
            // A kink in time and space at m = 3, 5, 7: half an element's transit there.
            let tolerance = if m < 3 { 1e-3 } else { 0.11 };
            let what = format!("{name}: foot after {m} tau [1e-4 m]");
            c.absolute(what, 5.0 + u / SCALE, expected, tolerance);
        }
        // The exact force grows from EA v/c = 300 by rho A c g = 300 per second, times 1e-4. Means over a fifth of tau.
        let window = tau / 5.0;
        let miss = |k: usize| {
            let from = 1.0 + window * k as f64;
            let exact = 300.0 + 300.0 * (from + 0.5 * window - 1.0);
            let mean = h.mean_force(from, from + window) / SCALE;
            (mean - exact).powi(2)
        };
        let norm = ((1..9).map(miss).sum::<f64>() / 8.0).sqrt() / 400.0;
        c.at_most(format!("{name}: deviation of the contact force, relative L2 norm"), norm, 1e-2);
        let fall = 500.0 * SCALE * SCALE;
        if name != "restitution 0" {
            let loss = h.summary.energy.loss_impacts.abs() / fall;
            c.at_most(format!("{name}: energy lost in both contacts"), loss, 1e-10);
        }
        c.at_most(format!("{name}: energy residual"), h.summary.energy.residual_max, 1e-10);
    }
    c.into_report()
}
