//! The columns of the history and their values at a state: each column is one entry of name, unit, meaning and value.
//!
//! A new column is a new entry, of [`super::balances`] if its name contains none of the model, else of the function here whose part it belongs to.

use super::balances::{BALANCES, HARDENING, SHEAR};
use super::now::Now;
use crate::analysis::section_forces;
use crate::contact::search::Search;
use crate::geometry::pair::Memory;
use crate::geometry::touch::SearchRegion;
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
    enter_all(model, &mut Sheet::Columns(&mut out));
    out
}

/// Values of a row.
pub fn values(model: &Model, now: &Now<'_>, row: &mut Vec<f64>) {
    row.clear();
    enter_all(model, &mut Sheet::Row { now, row });
}

/// Takes the entries: of each its name, unit and meaning, or at a state its value.
enum Sheet<'a> {
    /// The columns so far, shape (columns).
    Columns(&'a mut Vec<Channel>),
    Row {
        now: &'a Now<'a>,
        /// Their values, shape (columns) \[unit of the column\].
        row: &'a mut Vec<f64>,
    },
}

impl Sheet<'_> {
    /// What the values of several columns follow from; nothing where values are not asked for.
    fn at<T>(&self, of: impl FnOnce(&Now<'_>) -> T) -> Option<T> {
        match self {
            Self::Columns(_) => None,
            Self::Row { now, .. } => Some(of(now)),
        }
    }

    /// A column: its name, unit, meaning, and where values are asked for its value.
    fn enter(
        &mut self,
        name: impl FnOnce() -> String,
        unit: &'static str,
        meaning: &str,
        value: Option<f64>,
    ) {
        match self {
            Self::Columns(out) => {
                out.push(Channel { name: name(), unit, description: meaning.to_owned() });
            }
            Self::Row { row, .. } => row.extend(value),
        }
    }

    /// A column of each component of a vector.
    fn enter_vector(
        &mut self,
        name: impl Fn() -> String,
        unit: &'static str,
        meaning: &str,
        value: Option<[f64; 2]>,
    ) {
        for i in 0..2 {
            let component = || format!("{}_{}", name(), i + 1);
            self.enter(component, unit, meaning, value.map(|vector| vector[i]));
        }
    }
}

fn enter_all(model: &Model, sheet: &mut Sheet<'_>) {
    let time = sheet.at(|now| now.state.time);
    sheet.enter(|| "time".to_owned(), "s", "Time", time);
    enter_projectiles(model, sheet);
    enter_contacts(model, sheet);
    enter_points(model, sheet);
    enter_sections(model, sheet);
    enter_supports(model, sheet);
    enter_connectors(model, sheet);
    enter_foundations(model, sheet);
    let hardening = HARDENING.iter().filter(|_| model.is_inelastic());
    let shear = SHEAR.iter().filter(|_| model.has_shear());
    for (name, unit, meaning, value) in BALANCES.iter().chain(hardening).chain(shear) {
        let value = sheet.at(value);
        sheet.enter(|| (*name).to_owned(), unit, meaning, value);
    }
}

fn enter_projectiles(model: &Model, sheet: &mut Sheet<'_>) {
    for i in model.striking_bodies() {
        let (body, node) = (&model.bodies[i], model.body_node(i));
        let (name, disc) = (body.name.as_str(), body.kind.is_disc());
        let motion = sheet.at(|now| (now.state.displacement[node], now.state.velocity[node]));
        let x = model.nodes[node].position;
        let position = motion.map(|(u, _)| [x[0] + u[0], x[1] + u[1]]);
        let velocity = motion.map(|(_, v)| [v[0], v[1]]);
        let [place, rate] = if disc {
            ["Position of the disc", "Velocity of the disc"]
        } else {
            ["Position of the projectile", "Velocity of the projectile"]
        };
        sheet.enter_vector(|| format!("projectile.{name}.position"), "m", place, position);
        sheet.enter_vector(|| format!("projectile.{name}.velocity"), "m/s", rate, velocity);
        if disc {
            let [angle, spin] = [motion.map(|(u, _)| u[2]), motion.map(|(_, v)| v[2])];
            let named = |what: &str| format!("projectile.{name}.{what}");
            sheet.enter(|| named("angle"), "rad", "Rotation of the disc", angle);
            sheet.enter(|| named("spin"), "rad/s", "Angular velocity of the disc", spin);
        }
    }
}

fn enter_contacts(model: &Model, sheet: &mut Sheet<'_>) {
    for (k, contact) in model.contacts.iter().enumerate() {
        let named = |what: &str| format!("contact.{}.{what}", contact.name);
        let nearest = sheet.at(|now| nearest(model, now.state, contact, now.search));
        let gap = nearest.as_ref().map(|one| one.gap);
        sheet.enter(|| named("gap"), "m", "Gap at the closest points", gap);
        if !contact.law.is_rigid() {
            let force = sheet.at(|now| force_now(contact, now));
            sheet.enter(|| named("force"), "N", "Contact force at this instant", force);
        }
        let [normal, tangential] = [0, 1].map(|i| sheet.at(|now| now.impulse[k][i]));
        let meaning = "Impulse during the output interval";
        sheet.enter(|| named("impulse"), "N*s", meaning, normal);
        if contact.law.has_friction() {
            let meaning = "Impulse of friction during the output interval";
            sheet.enter(|| named("friction_impulse"), "N*s", meaning, tangential);
        }
        if slides(model, contact) {
            let meaning = "Arc length of the closest point along the first beam";
            sheet.enter(|| named("place"), "m", meaning, nearest.map(|one| one.s));
        }
    }
}

/// Force of a compliant contact, that of its damping included \[N\].
fn force_now(contact: &ContactData, now: &Now<'_>) -> f64 {
    let Some(law) = contact.law.smooth() else { return 0.0 };
    let force = |i: usize| {
        let pair = &now.state.pairs[i];
        let damped = (1.0 - law.dissipation * pair.rate).max(0.0);
        law.force(-pair.gap, pair.deepest) * damped
    };
    let awake = now.search.awake().iter().filter(|i| contact.pairs.contains(i));
    awake.map(|i| force(*i)).sum()
}

fn enter_points(model: &Model, sheet: &mut Sheet<'_>) {
    for (k, point) in model.points.iter().enumerate() {
        let named = |what: &str| format!("point.{}.{what}", point.label);
        let displacement = sheet.at(|now| point.displacement(&now.state.displacement));
        let meaning = "Displacement of the point";
        sheet.enter_vector(|| named("displacement"), "m", meaning, displacement);
        let rotation = sheet.at(|now| now.rotations[k]);
        let meaning =
            "Rotation of the section at the point, counter-clockwise, continued from row to row";
        sheet.enter(|| named("rotation"), "rad", meaning, rotation);
        let velocity = sheet.at(|now| point.velocity(&now.state.displacement, &now.state.velocity));
        sheet.enter_vector(|| named("velocity"), "m/s", "Velocity of the point", velocity);
        let speed = velocity.map(|[v1, v2]| v1.hypot(v2));
        sheet.enter(|| named("speed"), "m/s", "Magnitude of the velocity of the point", speed);
        if model.has_accelerated_base() {
            let base = sheet.at(|now| now.base_velocity);
            let absolute = velocity.zip(base).map(|(v, base)| [v[0] + base[0], v[1] + base[1]]);
            let meaning = "Velocity of the point and of the accelerated base together";
            sheet.enter_vector(|| named("absolute_velocity"), "m/s", meaning, absolute);
        }
    }
}

fn enter_sections(model: &Model, sheet: &mut Sheet<'_>) {
    for point in &model.points {
        let named = |what: &str| format!("section.{}.{what}", point.label);
        let found = sheet.at(|now| section_forces::at_point(model, now.lines, now.state, point));
        let value = |of: fn(&PointForces) -> f64| found.as_ref().map(of);
        let meaning = "Axial force at the point, positive in tension";
        sheet.enter(|| named("axial"), "N", meaning, value(|f| f.axial));
        sheet.enter(|| named("shear"), "N", "Shear force at the point", value(|f| f.shear));
        sheet.enter(|| named("moment"), "N*m", "Bending moment at the point", value(|f| f.moment));
        if has_depth(model, point) {
            let meaning = "Stress of the extreme fibre (top or bottom) with the larger magnitude";
            sheet.enter(|| named("stress"), "Pa", meaning, value(|f| f.stress.largest));
            let meaning = "Stress at the top fibre: left of the direction of increasing s, the upper face of a beam drawn from left to right";
            sheet.enter(|| named("stress_top"), "Pa", meaning, value(|f| f.stress.top));
            let meaning = "Stress at the bottom fibre: right of the direction of increasing s, the lower face of a beam drawn from left to right";
            sheet.enter(|| named("stress_bottom"), "Pa", meaning, value(|f| f.stress.bottom));
        }
    }
}

fn enter_supports(model: &Model, sheet: &mut Sheet<'_>) {
    for (k, support) in model.supports.iter().enumerate() {
        let named = |what: &str| format!("support.{}.{what}", support.name);
        let mean = sheet.at(|now| now.reactions[k]);
        let force = mean.map(|r| [r[0], r[1]]);
        let meaning = "Force of the support on the structure, averaged over the output interval";
        sheet.enter_vector(|| named("force"), "N", meaning, force);
        let meaning = "Moment of the support on the structure, averaged over the output interval";
        sheet.enter(|| named("moment"), "N*m", meaning, mean.map(|r| r[2]));
        if model.has_impulses() {
            let sum = sheet.at(|now| now.reaction_impulses[k]);
            let meaning = "Impulse of the support in impacts during the output interval, in addition to its force";
            let impulse = sum.map(|r| [r[0], r[1]]);
            sheet.enter_vector(|| named("impulse"), "N*s", meaning, impulse);
            let meaning = "Angular impulse of the support in impacts during the output interval";
            sheet.enter(|| named("impulse_moment"), "N*m*s", meaning, sum.map(|r| r[2]));
        }
    }
}

/// Springs and hinges that can yield.
fn enter_connectors(model: &Model, sheet: &mut Sheet<'_>) {
    for (i, connector, own) in model.yielding() {
        let [what, unit, force, of] = if connector.turns() {
            ["rotation", "rad", "moment", "N*m"]
        } else {
            ["extension", "m", "force", "N"]
        };
        let signed = |value: f64| own.sign * value + 0.0;
        let extension = sheet.at(|now| signed(now.state.coordinates[i] - connector.law.free()));
        let plastic = sheet.at(|now| signed(now.state.memories[own.memory].plastic));
        let of_now = sheet.at(|now| signed(connector.force_now(i, now.state)));
        let named = |what: &str| format!("{}.{what}", own.name);
        let meaning = format!("Its {what} from the state without {force}");
        sheet.enter(|| named(what), unit, &meaning, extension);
        let meaning = format!("Plastic {what}, which would remain without {force}");
        sheet.enter(|| named(&format!("plastic_{what}")), unit, &meaning, plastic);
        let meaning = format!("Its {force}, that of its damper included");
        sheet.enter(|| named(force), of, &meaning, of_now);
    }
}

fn enter_foundations(model: &Model, sheet: &mut Sheet<'_>) {
    for foundation in &model.foundations {
        let named = |what: &str| format!("foundation.{}.{what}", foundation.name);
        let sums = sheet.at(|now| FoundationSums::of(model, now.state, foundation));
        let value = |of: fn(&FoundationSums) -> f64| sums.as_ref().map(of);
        let meaning = "Resultant force of the foundation on the beam, that of its dampers included";
        sheet.enter_vector(|| named("force"), "N", meaning, sums.as_ref().map(|sum| sum.force));
        let meaning = "Reaction per length of largest magnitude, that of the dampers included, positive where it pushes the beam";
        sheet.enter(|| named("pressure"), "N/m", meaning, value(|sum| sum.pressure[0]));
        let meaning = "Length over which the beam has lifted off";
        sheet.enter(|| named("lifted"), "m", meaning, value(|sum| sum.lifted));
        let meaning = "Energy stored in the foundation, a part of that of the springs";
        sheet.enter(|| named("energy"), "J", meaning, value(|sum| sum.energy));
    }
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
