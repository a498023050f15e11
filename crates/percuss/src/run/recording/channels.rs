//! The columns of the history and their values at a state.

use super::columns::{
    BALANCE_COLUMNS, FORCE_COLUMNS, PLASTIC_COLUMNS, SECTION_COLUMNS, SHEAR_COLUMN,
};
use crate::analysis::section_forces::{self, Lines};
use crate::contact::search::Search;
use crate::geometry::pair::Memory;
use crate::geometry::touch::SearchRegion;
use crate::ledger::Measures;
use crate::model::Model;
use crate::model::frozen::{ContactData, MaterialPoint};
use crate::run::observing::foundation_log::FoundationSums;
use crate::state::State;
use crate::summary::PointForces;

/// A column of the history.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Channel {
    /// Name in the form `<kind>.<name>.<quantity>`, for instance `projectile.mass.velocity_2`.
    pub name: String,
    /// Unit in plain ASCII: `m`, `m/s`, `rad`, `N`, `N*s`, `J`, `kg*m/s`, `1/m`, `s`, or `1`.
    pub unit: &'static str,
    /// One sentence that describes the column.
    pub description: String,
}

/// Columns of the history of `model`, in the order of [`values`].
pub fn channels(model: &Model) -> Vec<Channel> {
    let mut out = Vec::new();
    let mut add = |name: String, unit: &'static str, description: &str| {
        out.push(Channel { name, unit, description: description.into() });
    };
    add("time".into(), "s", "Time");
    for (_, name, disc) in projectiles(model) {
        let body = if disc { "disc" } else { "projectile" };
        for i in 1..=2 {
            let what = format!("Position of the {body}");
            add(format!("projectile.{name}.position_{i}"), "m", &what);
        }
        for i in 1..=2 {
            let what = format!("Velocity of the {body}");
            add(format!("projectile.{name}.velocity_{i}"), "m/s", &what);
        }
        if disc {
            add(format!("projectile.{name}.angle"), "rad", "Rotation of the disc");
            add(format!("projectile.{name}.spin"), "rad/s", "Angular velocity of the disc");
        }
    }
    for contact in &model.contacts {
        let name = &contact.name;
        add(format!("contact.{name}.gap"), "m", "Gap at the closest points");
        if !contact.law.is_rigid() {
            add(format!("contact.{name}.force"), "N", "Contact force at this instant");
        }
        let text = "Impulse during the output interval";
        add(format!("contact.{name}.impulse"), "N*s", text);
        if has_friction(contact) {
            let text = "Impulse of friction during the output interval";
            add(format!("contact.{name}.friction_impulse"), "N*s", text);
        }
        if slides(model, contact) {
            let text = "Arc length of the closest point along the first beam";
            add(format!("contact.{name}.place"), "m", text);
        }
    }
    for p in &model.points {
        let name = &p.label;
        for i in 1..=2 {
            add(format!("point.{name}.displacement_{i}"), "m", "Displacement of the point");
        }
        let text =
            "Rotation of the section at the point, counter-clockwise, continued from row to row";
        add(format!("point.{name}.rotation"), "rad", text);
        for i in 1..=2 {
            add(format!("point.{name}.velocity_{i}"), "m/s", "Velocity of the point");
        }
        if model.has_accelerated_base() {
            for i in 1..=2 {
                let text = "Velocity of the point and of the accelerated base together";
                add(format!("point.{name}.absolute_velocity_{i}"), "m/s", text);
            }
        }
    }
    for p in &model.points {
        let shown = if has_depth(model, p) { SECTION_COLUMNS.len() } else { FORCE_COLUMNS };
        for (quantity, unit, text) in &SECTION_COLUMNS[..shown] {
            add(format!("section.{}.{quantity}", p.label), unit, text);
        }
    }
    for s in &model.supports {
        let name = &s.name;
        for i in 1..=2 {
            let text = "Force of the support on the structure, averaged over the output interval";
            add(format!("support.{name}.force_{i}"), "N", text);
        }
        let text = "Moment of the support on the structure, averaged over the output interval";
        add(format!("support.{name}.moment"), "N*m", text);
        if model.has_impulses() {
            for i in 1..=2 {
                let text = "Impulse of the support in impacts during the output interval, in addition to its force";
                add(format!("support.{name}.impulse_{i}"), "N*s", text);
            }
            let text = "Angular impulse of the support in impacts during the output interval";
            add(format!("support.{name}.impulse_moment"), "N*m*s", text);
        }
    }
    out.extend(connector_channels(model));
    out.extend(foundation_channels(model));
    out.extend(balances(model));
    out
}

/// Columns of energies, momenta and the solver.
fn balances(model: &Model) -> impl Iterator<Item = Channel> {
    let plastic = PLASTIC_COLUMNS.iter().filter(|_| model.is_inelastic());
    let plastic = plastic.map(|(name, description)| (*name, "J", *description));
    let shear = model.has_shear().then_some(SHEAR_COLUMN);
    BALANCE_COLUMNS.into_iter().chain(plastic).chain(shear).map(|(name, unit, description)| {
        Channel { name: name.into(), unit, description: description.into() }
    })
}

/// Bodies of projectiles, their names and whether they are discs.
fn projectiles(model: &Model) -> impl Iterator<Item = (usize, &str, bool)> {
    model.striking_bodies().map(|i| {
        let body = &model.bodies[i];
        (i, body.name.as_str(), body.kind.is_disc())
    })
}

fn has_friction(contact: &ContactData) -> bool {
    contact.law.has_friction()
}

/// Whether the place of a contact along a beam can change.
fn slides(model: &Model, contact: &ContactData) -> bool {
    model.pairs[contact.pairs.clone()]
        .iter()
        .any(|p| !p.target.is_guided() && p.movers.iter().any(|m| *m < model.beams.len()))
}

/// The nearest pair of a contact: gap, and arc length along the beam where that can change.
struct NearestPair {
    gap: f64,
    s: f64,
}

/// The closest pair of a contact in the current state; of sleeping pairs, those that could be closer are evaluated.
fn nearest(model: &Model, state: &State, contact: &ContactData, search: &Search) -> NearestPair {
    let slides = slides(model, contact);
    let mut best = NearestPair { gap: f64::INFINITY, s: f64::NAN };
    let at = state.configuration();
    for i in contact.pairs.clone() {
        let pair = &model.pairs[i];
        let least = search.least_gap(pair, i);
        if least.unwrap_or(state.pairs[i].gap) >= best.gap {
            continue;
        }
        if least.is_none() && !slides {
            best.gap = state.pairs[i].gap;
            continue;
        }
        let seen = state.pairs[i].memory;
        // A sleeping pair may have passed around an end meanwhile: its side and closest point are those of its current position.
        let (memory, reach) = match least {
            Some(_) => (Memory { side: 0.0, ..seen }, SearchRegion::All),
            None => (seen, SearchRegion::Near),
        };
        if let Some(touch) = pair.touch(model, &at, &memory, reach)
            && touch.gap < best.gap
        {
            let s = if slides { pair.along(&touch) } else { f64::NAN };
            best = NearestPair { gap: touch.gap, s };
        }
    }
    best
}

/// Whether the section at a point has a depth, and so extreme fibres.
fn has_depth(model: &Model, point: &MaterialPoint) -> bool {
    model.element_of(point.node).0.has_depth()
}

/// Changes since the previous row.
pub struct SinceLast<'a> {
    /// Impulses along normal and tangent, shape (contacts, 2) \[N s\].
    pub impulse: &'a [[f64; 2]],
    /// Rotations of the recorded points in the current state, shape (points) \[rad\].
    pub rotations: &'a [f64],
    /// Pairs evaluated in the current state, and bounds for the gaps of the others.
    pub search: &'a Search,
    /// Mean reactions, shape (supports, 3) \[N, N m\].
    pub reactions: &'a [[f64; 3]],
    /// Their additional impulses, shape (supports, 3) \[N s, N m s\].
    pub reaction_impulses: &'a [[f64; 3]],
    /// Section forces of the last step without impact.
    pub lines: &'a Lines,
    /// Velocity of the accelerated base, shape (2) \[m/s\].
    pub base_velocity: [f64; 2],
    /// Newton iterations.
    pub iterations: usize,
}

/// Values of a row.
pub fn values(model: &Model, state: &State, m: &Measures, since: &SinceLast, row: &mut Vec<f64>) {
    row.clear();
    row.push(state.time);
    for (i, _, disc) in projectiles(model) {
        let node = model.body_node(i);
        let (x, u, v) =
            (model.nodes[node].position, state.displacement[node], state.velocity[node]);
        row.extend([x[0] + u[0], x[1] + u[1], v[0], v[1]]);
        if disc {
            row.extend([u[2], v[2]]);
        }
    }
    for (k, contact) in model.contacts.iter().enumerate() {
        let nearest = nearest(model, state, contact, since.search);
        row.push(nearest.gap);
        if let Some(law) = contact.law.smooth() {
            let force = |i: usize| {
                let pair = &state.pairs[i];
                let damped = (1.0 - law.dissipation * pair.rate).max(0.0);
                law.force(-pair.gap, pair.deepest) * damped
            };
            let awake = since.search.awake().iter().filter(|i| contact.pairs.contains(i));
            row.push(awake.map(|i| force(*i)).sum());
        }
        row.push(since.impulse[k][0]);
        if has_friction(contact) {
            row.push(since.impulse[k][1]);
        }
        if slides(model, contact) {
            row.push(nearest.s);
        }
    }
    for (p, rotation) in model.points.iter().zip(since.rotations) {
        row.extend(p.displacement(&state.displacement));
        row.push(*rotation);
        let relative = p.velocity(&state.displacement, &state.velocity);
        row.extend(relative);
        if model.has_accelerated_base() {
            row.extend([0, 1].map(|i| relative[i] + since.base_velocity[i]));
        }
    }
    for p in &model.points {
        let PointForces { axial, shear, moment, stress } =
            section_forces::at_point(model, since.lines, state, p);
        row.extend([axial, shear, moment]);
        if has_depth(model, p) {
            row.extend([stress.largest, stress.top, stress.bottom]);
        }
    }
    for (forces, impulses) in since.reactions.iter().zip(since.reaction_impulses) {
        row.extend_from_slice(forces);
        if model.has_impulses() {
            row.extend_from_slice(impulses);
        }
    }
    add_connectors(model, state, row);
    add_foundations(model, state, row);
    let ledger = &state.ledger;
    let residual = ledger.linear_residual(m);
    row.extend([
        m.kinetic_beams + m.kinetic_projectiles,
        m.kinetic_beams,
        m.kinetic_projectiles,
        m.strain_axial + m.strain_bending,
        m.strain_axial,
        m.strain_bending - m.strain_shear,
        m.contact,
        m.springs,
        m.total(),
        ledger.work_loads,
        ledger.work_supports,
        ledger.loss_impacts,
        ledger.loss_damping,
        ledger.energy_residual(m),
        m.linear[0],
        m.linear[1],
        m.angular,
        residual[0],
        residual[1],
        ledger.angular_residual(m),
        m.curvature_drift,
        m.membrane_drift,
        m.angular_rate_drift,
        since.iterations as f64,
    ]);
    if model.is_inelastic() {
        row.extend([ledger.loss_plastic, m.hardening, ledger.loss_failure]);
    }
    if model.has_shear() {
        row.push(m.strain_shear);
    }
}

/// Columns of foundations, in the order of [`add_foundations`].
fn foundation_channels(model: &Model) -> Vec<Channel> {
    let each = model.foundations.iter().flat_map(|foundation| {
        let name = &foundation.name;
        let force = "Resultant force of the foundation on the beam, that of its dampers included";
        let pressure =
            "Reaction per length of largest magnitude, that of the dampers included, positive where it pushes the beam";
        let lifted = "Length over which the beam has lifted off";
        [
            ("force_1", "N", force),
            ("force_2", "N", force),
            ("pressure", "N/m", pressure),
            ("lifted", "m", lifted),
            ("energy", "J", "Energy stored in the foundation, a part of that of the springs"),
        ]
        .map(|(quantity, unit, text)| (format!("foundation.{name}.{quantity}"), unit, text.into()))
    });
    each.map(|(name, unit, description)| Channel { name, unit, description }).collect()
}

/// Adds their values to a row.
fn add_foundations(model: &Model, state: &State, row: &mut Vec<f64>) {
    for foundation in &model.foundations {
        let FoundationSums { force, pressure, lifted, energy, .. } =
            FoundationSums::of(model, state, foundation);
        row.extend([force[0], force[1], pressure[0], lifted, energy]);
    }
}

/// Columns of springs and hinges that can yield, in the order of [`add_connectors`].
fn connector_channels(model: &Model) -> Vec<Channel> {
    let each = model.yielding().flat_map(|(_, c, own)| {
        let name = &own.name;
        let [(what, unit), (force, of)] = if c.turns() {
            [("rotation", "rad"), ("moment", "N*m")]
        } else {
            [("extension", "m"), ("force", "N")]
        };
        let plastic = format!("Plastic {what}, which would remain without {force}");
        [
            (format!("{name}.{what}"), unit, format!("Its {what} from the state without {force}")),
            (format!("{name}.plastic_{what}"), unit, plastic),
            (format!("{name}.{force}"), of, format!("Its {force}, that of its damper included")),
        ]
    });
    each.map(|(name, unit, description)| Channel { name, unit, description }).collect()
}

/// Adds their values to a row.
fn add_connectors(model: &Model, state: &State, row: &mut Vec<f64>) {
    for (i, c, own) in model.yielding() {
        let (q, memory) = (state.coordinates[i], &state.memories[own.memory]);
        let force = c.force_now(i, state);
        let values = [q - c.law.free(), memory.plastic, force];
        row.extend(values.map(|value| own.sign * value + 0.0));
    }
}
