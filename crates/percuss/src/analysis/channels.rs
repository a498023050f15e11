//! The columns of the history and their values at a state.

use crate::contact::law;
use crate::ledger::Measures;
use crate::math::vec2::{add, scale};
use crate::model::Model;
use crate::model::frozen::ContactLaw;
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
    for (name, unit, description) in BOOK_COLUMNS {
        add(name.into(), unit, description);
    }
    out
}

/// Columns every history has.
const BOOK_COLUMNS: [(&str, &str, &str); 21] = [
    ("energy.kinetic", "J", "Kinetic energy"),
    ("energy.kinetic_beams", "J", "Kinetic energy of the beams"),
    ("energy.kinetic_projectiles", "J", "Kinetic energy of the projectiles"),
    ("energy.strain", "J", "Strain energy"),
    ("energy.strain_axial", "J", "Axial strain energy"),
    ("energy.strain_bending", "J", "Bending strain energy"),
    ("energy.contact", "J", "Energy of the contact springs"),
    ("energy.total", "J", "Total energy"),
    ("energy.work_loads", "J", "Work of the loads so far"),
    ("energy.work_supports", "J", "Work of the supports so far"),
    ("energy.loss_impacts", "J", "Energy lost in impacts so far"),
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

/// Values of a row; `impulse` holds the impulses since the row before, shape (n_projectile).
pub fn values(
    model: &Model,
    state: &State,
    m: &Measures,
    impulse: &[f64],
    iterations: usize,
    row: &mut Vec<f64>,
) {
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
        row.push(impulse[i]);
    }
    for p in &model.points {
        row.extend(p.value(&state.displacement));
        row.extend(p.value(&state.velocity));
    }
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
        m.total(),
        books.work_loads,
        books.work_supports,
        books.loss_impacts,
        books.energy_residual(m),
        m.linear[0],
        m.linear[1],
        m.angular,
        residual[0],
        residual[1],
        books.angular_residual(m),
        m.curvature_drift,
        m.membrane_drift,
        iterations as f64,
    ]);
}
