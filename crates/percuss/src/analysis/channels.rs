//! The columns of the history and their values at a state.

use super::section_forces::{self, Before};
use crate::contact::law;
use crate::ledger::Measures;
use crate::math::vec2::{add, scale};
use crate::model::Model;
use crate::model::frozen::{ContactLaw, MaterialPoint};
use crate::record::Channel;
use crate::state::State;

/// Columns of the history of `model`, in the order of [`values`].
pub fn channels(model: &Model) -> Vec<Channel> {
    let mut out = Vec::new();
    let mut add = |name: String, unit: &'static str, description: &str| {
        out.push(Channel { name, unit, description: description.into() });
    };
    add("time".into(), "s", "Time");
    for p in &model.projectiles {
        let name = &p.name;
        for i in 1..=2 {
            add(format!("projectile.{name}.position_{i}"), "m", "Position of the projectile");
        }
        for i in 1..=2 {
            add(format!("projectile.{name}.velocity_{i}"), "m/s", "Velocity of the projectile");
        }
        let gap = "Gap between projectile and struck point along the line of flight";
        add(format!("contact.{name}.gap"), "m", gap);
        if matches!(p.law, ContactLaw::Spring { .. }) {
            add(format!("contact.{name}.force"), "N", "Contact force at this instant");
        }
        let text = "Impulse handed over since the row before";
        add(format!("contact.{name}.impulse"), "N*s", text);
    }
    for p in &model.points {
        let name = &p.label;
        for i in 1..=2 {
            add(format!("point.{name}.displacement_{i}"), "m", "Displacement of the point");
        }
        for i in 1..=2 {
            add(format!("point.{name}.velocity_{i}"), "m/s", "Velocity of the point");
        }
    }
    for p in &model.points {
        let name = &p.label;
        let section = |q: &str| format!("section.{name}.{q}");
        add(section("axial"), "N", "Axial force at the point, positive in tension");
        add(section("shear"), "N", "Shear force at the point");
        add(section("moment"), "N*m", "Bending moment at the point");
        if has_depth(model, p) {
            add(section("stress"), "Pa", "Stress of larger magnitude of the two extreme fibres");
        }
    }
    for s in &model.supports {
        let name = &s.name;
        for i in 1..=2 {
            let text = "Force of the support on the structure, mean since the row before";
            add(format!("support.{name}.force_{i}"), "N", text);
        }
        let text = "Moment of the support on the structure, mean since the row before";
        add(format!("support.{name}.moment"), "N*m", text);
    }
    for (name, unit, description) in BOOK_COLUMNS {
        add(name.into(), unit, description);
    }
    out
}

/// Columns every history has.
const BOOK_COLUMNS: [(&str, &str, &str); 23] = [
    ("energy.kinetic", "J", "Kinetic energy"),
    ("energy.kinetic_beams", "J", "Kinetic energy of the beams"),
    ("energy.kinetic_projectiles", "J", "Kinetic energy of the projectiles"),
    ("energy.strain", "J", "Strain energy"),
    ("energy.strain_axial", "J", "Axial strain energy"),
    ("energy.strain_bending", "J", "Bending strain energy"),
    ("energy.contact", "J", "Energy of the contact springs"),
    ("energy.springs", "J", "Energy of springs, elastic supports and stops"),
    ("energy.total", "J", "Total energy"),
    ("energy.work_loads", "J", "Work of the loads so far"),
    ("energy.work_supports", "J", "Work of the supports so far"),
    ("energy.loss_impacts", "J", "Energy lost in impacts so far"),
    ("energy.loss_damping", "J", "Energy taken by damping so far"),
    ("energy.residual", "J", "What is missing from the energy books"),
    ("momentum.linear_1", "kg*m/s", "Linear momentum"),
    ("momentum.linear_2", "kg*m/s", "Linear momentum"),
    ("momentum.angular", "kg*m^2/s", "Angular momentum about the origin"),
    ("momentum.residual_1", "kg*m/s", "What is missing from the momentum books"),
    ("momentum.residual_2", "kg*m/s", "What is missing from the momentum books"),
    ("momentum.residual_angular", "kg*m^2/s", "What is missing from the angular momentum books"),
    ("audit.curvature_drift", "1/m", "Distance of stored bending strains from the configuration"),
    ("audit.membrane_drift", "1", "Distance of stored membrane strains from the configuration"),
    ("solver.newton_iterations", "1", "Newton iterations since the row before"),
];

/// Whether the section at a point has a depth, and so extreme fibres.
fn has_depth(model: &Model, point: &MaterialPoint) -> bool {
    let (span, k) = model.element_of(point.node);
    span.table(k).rows.iter().all(|row| !row.half_depth.is_nan())
}

/// What happened since the row before.
pub struct SinceLast<'a> {
    /// Impulses, shape (n_projectile) \[N s\].
    pub impulse: &'a [f64],
    /// Mean reactions, shape (n_support) \[N, N m\].
    pub reactions: &'a [[f64; 3]],
    /// Angular rates at the start of the last step.
    pub before: Before<'a>,
    /// Newton iterations.
    pub iterations: usize,
}

/// Values of a row.
pub fn values(model: &Model, state: &State, m: &Measures, since: &SinceLast, row: &mut Vec<f64>) {
    row.clear();
    row.push(state.time);
    for (i, p) in model.projectiles.iter().enumerate() {
        let s = &state.projectiles[i];
        row.extend(add(p.position, scale(s.travel, p.direction)));
        row.extend(scale(s.speed, p.direction));
        let gap = state.gap(model, i);
        row.push(gap);
        if let ContactLaw::Spring { stiffness, .. } = p.law {
            row.push(law::force(stiffness, -gap));
        }
        row.push(since.impulse[i]);
    }
    for p in &model.points {
        row.extend(p.value(&state.displacement));
        row.extend(p.value(&state.velocity));
    }
    for p in &model.points {
        let forces = section_forces::at_point(model, state, since.before, p);
        row.extend_from_slice(&forces[..if has_depth(model, p) { 4 } else { 3 }]);
    }
    row.extend_from_slice(since.reactions.as_flattened());
    let books = &state.books;
    let residual = books.linear_residual(m);
    row.extend([
        m.kinetic_beams + m.kinetic_projectiles,
        m.kinetic_beams,
        m.kinetic_projectiles,
        m.strain_axial + m.strain_bending,
        m.strain_axial,
        m.strain_bending,
        m.contact,
        m.springs,
        m.total(),
        books.work_loads,
        books.work_supports,
        books.loss_impacts,
        books.loss_damping,
        books.energy_residual(m),
        m.linear[0],
        m.linear[1],
        m.angular,
        residual[0],
        residual[1],
        books.angular_residual(m),
        m.curvature_drift,
        m.membrane_drift,
        since.iterations as f64,
    ]);
}
