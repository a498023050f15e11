//! Forces of contacts at rest, for output.

use super::place::{CandidatePair, moving};
use super::{NEXT_TO_NOTHING, StaticContacts};
use crate::analysis::spectrum::Held;
use crate::frame::FrameForce;
use crate::geometry::configuration::Configuration;
use crate::geometry::pair::Memory;
use crate::geometry::row::Row;
use crate::geometry::touch::SearchRegion;
use crate::geometry::turning::Turning;
use crate::math::vec2::{add, cross, scale};
use crate::model::Model;
use crate::state::State;

/// A contact of an equilibrium: the sum over the places where it is closed.
#[derive(Clone, Debug, PartialEq)]
pub struct StaticContact {
    /// Its name.
    pub name: String,
    /// Its partners, shape (2).
    pub between: [String; 2],
    /// Forces along the normals, summed \[N\].
    pub force: f64,
    /// Resultant on the first of the two partners, shape (2) \[N\].
    pub resultant: [f64; 2],
    /// Least gap \[m\]; negative for a compressed compliant contact, infinite where contact is impossible.
    pub gap: f64,
    /// Closed range along the beam: from and to, arc length, shape (2) \[m\]; NaN if it is open or on no beam.
    pub s: [f64; 2],
    /// Arc length at which the forces have their centre \[m\]; NaN likewise.
    pub centre: f64,
    /// Whether its law has friction, which statics ignores.
    pub frictional: bool,
}
impl StaticContacts {
    /// Forces of the pairs, with the forms they act along.
    pub fn forces(&self) -> impl Iterator<Item = (usize, f64, &Row)> {
        self.places.iter().filter(|p| p.force != 0.0).map(|p| (p.pair, p.force, &p.row))
    }

    /// Largest stiffness of a compliant pair that presses \[N/m\]; zero without any.
    pub fn largest_stiffness(&self) -> f64 {
        let pressing = self.places.iter().filter(|p| p.is_compliant() && p.force > 0.0);
        pressing.map(|p| p.slope).fold(0.0, f64::max)
    }

    /// Forces of the pairs in a state, where they act.
    pub fn frame_forces(&self, model: &Model, state: &State) -> Vec<FrameForce> {
        let at = Configuration { arcs: &self.arcs, ..state.configuration() };
        let one = |place: &CandidatePair| {
            let pair = &model.pairs[place.pair];
            let memory = Memory { near: place.seen.near, ..place.accepted };
            let touch = pair.touch(model, &at, &memory, SearchRegion::All)?;
            let sign = if pair.source_partner == 1 { 1.0 } else { -1.0 };
            Some(FrameForce {
                contact: pair.contact,
                position: add(touch.closest_place, scale(touch.radius, touch.normal)),
                force: scale(sign * place.force, touch.normal),
                impulsive: false,
            })
        };
        self.places.iter().filter(|p| p.force != 0.0).filter_map(one).collect()
    }

    /// Active contacts of beams in a state, which remain closed in small motions; without those of discs.
    pub fn held(&self, model: &Model, state: &State) -> Vec<Held> {
        let beams = model.beam_node_count();
        let at = Configuration { arcs: &self.arcs, ..state.configuration() };
        let held = |place: &CandidatePair| {
            let pair = &model.pairs[place.pair];
            let memory = Memory { near: place.seen.near, ..place.accepted };
            let touch = pair.touch(model, &at, &memory, SearchRegion::All)?;
            let row = moving(model, &pair.normal_row(&touch, &at));
            let stiffness = match model.contacts[pair.contact].law.smooth() {
                Some(law) => law.held_stiffness(-touch.gap),
                None => place.stiffnesses[1],
            };
            let of_sections = pair.section_turnings(&touch, &at).into_iter().flatten();
            let turnings = pair.turning(&touch, &at).into_iter().chain(of_sections);
            let moved = |t: Turning| Turning { forms: t.forms.map(|f| moving(model, &f)), ..t };
            let turnings = turnings.map(moved).collect();
            let of_beams = row.iter().all(|(node, _)| node < beams) && !row.is_empty();
            of_beams.then_some(Held { row, stiffness, force: place.force, turnings })
        };
        // A contact whose force is round-off may as well be open.
        let most = self.places.iter().map(|p| p.force).fold(0.0, f64::max);
        let presses = |p: &&CandidatePair| p.force > NEXT_TO_NOTHING * most;
        self.places.iter().filter(presses).filter_map(held).collect()
    }

    /// Adds the reactions of obstacles.
    pub fn add_reactions(&self, model: &Model, out: &mut [[f64; 3]]) {
        for (pair, force, row) in self.forces() {
            let Some(obstacle) = model.pairs[pair].obstacle else { continue };
            let data = &model.obstacles[obstacle];
            let node = model.body_node(data.body);
            let c = row.at(node);
            let arm = [0, 1].map(|i| data.position[i] - model.nodes[node].position[i]);
            let own = &mut out[data.support];
            // The force on one body is opposite to that on the other.
            own[0] -= force * c[0];
            own[1] -= force * c[1];
            own[2] -= force * (c[2] - cross(arm, [c[0], c[1]]));
        }
    }

    /// Contacts with at least one pair in the analysis, in the model's order.
    pub fn results(&self, model: &Model) -> Vec<StaticContact> {
        let mut out: Vec<(usize, StaticContact)> = Vec::new();
        for place in &self.places {
            let pair = &model.pairs[place.pair];
            if out.last().is_none_or(|(c, _)| *c != pair.contact) {
                out.push((pair.contact, open(model, pair.contact)));
            }
            let Some((_, found)) = out.last_mut() else { continue };
            found.gap = found.gap.min(place.gap);
            if place.force == 0.0 {
                continue;
            }
            found.force += place.force;
            found.s = [found.s[0].min(place.s), found.s[1].max(place.s)];
            let before = if found.centre.is_nan() { 0.0 } else { found.centre };
            found.centre = before + (place.s - before) * place.force / found.force;
            let nodes = model.nodes_of_mover(pair.movers[0]);
            let sign = if pair.source_partner == 0 { 1.0 } else { -1.0 };
            // Shape functions of values sum to one: so do the parts of a force.
            for (_, c) in place.row.iter().filter(|(n, _)| nodes.contains(n)) {
                (0..2).for_each(|i| found.resultant[i] += sign * place.force * c[i]);
            }
        }
        out.into_iter().map(|(_, found)| found).collect()
    }
}
/// A contact without any force.
fn open(model: &Model, contact: usize) -> StaticContact {
    let data = &model.contacts[contact];
    StaticContact {
        name: data.name.clone(),
        between: data.between.clone(),
        force: 0.0,
        resultant: [0.0; 2],
        gap: f64::INFINITY,
        s: [f64::NAN; 2],
        centre: f64::NAN,
        frictional: data.law.has_friction(),
    }
}
