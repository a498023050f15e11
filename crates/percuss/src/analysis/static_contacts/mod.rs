//! Contacts at rest, without friction: compliant ones by their potential, rigid ones as `0 <= gap  perp  force >= 0`.
//!
//! Rigid contacts have a multiplier each. Those between beams, and of beams with obstacles, act with it; corrections determine it with the closed
//! set ([`pressing`]). Those of discs act with `multiplier - stiffness gap` while that is positive (augmented Lagrangian: Alart, Curnier 1991);
//! multipliers are updated when the closed set no longer changes. Their stiffness only accelerates the iteration: in equilibrium gaps are round-off
//! and forces are the multipliers. Discs have no stiffness of their own; a weak spring to their current position in the iteration, not to a fixed
//! place, keeps the tangent regular.

mod discs;
mod place;
mod pressing;
mod results;

pub(super) use pressing::{Programme, Response};
pub use results::StaticContact;

use crate::geometry::axis::longest_arc;
use crate::geometry::configuration::Configuration;
use crate::geometry::dents::{Dent, Dents};
use crate::geometry::pair::{Memory, Pair};
use crate::geometry::row::Row;
use crate::geometry::touch::SearchRegion;

use crate::model::Model;
use crate::model::frozen::BodyKind;
use crate::state::State;
use crate::step::tangent::Tangent;
pub(super) use place::Pressing;
use place::{CandidatePair, ROUND_OFF, RestingDisc};

/// Gaps below this share of the largest coordinate are closed: a tenth of the tolerance of a transient.
const CLOSED: f64 = 1e-13;
/// Gaps below this share of the size of the structure may close within the smallest load step.
const ABOUT_TO_CLOSE: f64 = 1e-3;
/// Initial stiffness of a rigid contact: that of a foundation into which its beam sinks by this share of its length. Whole regions close and open
/// at once on it, which on a stiff one would do so one by one.
const SOFT: f64 = 0.1;
/// Stiffness of a rigid contact in the end, in units of its element's.
const STIFFER: f64 = 1e3;
/// The weak spring of a disc in the end, in units of its weight over the size of the structure, and the stiffness of its rigid
/// contacts.
const WEAK: f64 = 1e-4;
const STIFF: f64 = 1e5;
/// Factor of the stiffness of a rigid contact if a correction with an unchanged closed set leaves more than a share of its gap.
const GROWTH: f64 = 100.0;
const SLOW: f64 = 1e-4;
/// Forces below this share of the largest.
const NEXT_TO_NOTHING: f64 = 1e-8;
/// Change of a multiplier that has settled, relative to the largest: where it follows the gap, and where a correction finds it.
const SETTLED: f64 = 1e-10;
const SETTLED_EXACTLY: f64 = 1e-9;
/// A disc moves by no more than this share of the structure in a correction, once it touches.
const STRIDE: f64 = 0.05;

/// Contacts and discs in statics.
#[derive(Clone, Debug, Default)]
pub(super) struct StaticContacts {
    /// Pairs in the analysis, in the model's order, shape (such pairs).
    places: Vec<CandidatePair>,
    /// Their indentations of faces, shape (such pairs); empty without crushing.
    dents: Vec<Dents>,
    /// Discs at rest, and guided projectiles at rest on springs, in the analysis, shape (such bodies).
    discs: Vec<RestingDisc>,
    /// Nodes of fixed bodies at which springs end, shape (such bodies) \[index of a node\].
    fixed_nodes: Vec<usize>,
    /// Bodies in the model: all of them are fixed except those discs and projectiles.
    has_bodies: bool,
    /// Scale of positions \[m\].
    size: f64,
    /// Whether the closed set of the tangent assembled last is another one than that before; whether it is empty and was not always.
    changed: bool,
    opened: bool,
    /// Weak springs of discs in units of their weights over the size of the structure.
    damping: f64,
    /// Components of nodes that, held, would stop all motions of beams that neither supports nor joints do, and their weak springs,
    /// shape (such components) \[index of a node, index of a component, N/m or N m\].
    loose: Vec<(usize, usize, f64)>,
    /// Unsupported bodies: beams first, then bodies.
    lost: Option<usize>,
    /// Length that no element of a beam exceeds, one a beam, shape (beams) \[m\]; empty if not known.
    arcs: Vec<f64>,
    pressing: Pressing,
}

/// Whether a body is included in an equilibrium: at rest, and not a guided projectile.
fn rests(model: &Model, body: usize) -> bool {
    let body = &model.bodies[body];
    let is_disc_at_rest = body.kind.is_disc() && body.velocity == [0.0; 2] && body.spin == 0.0;
    body.kind.is_obstacle() || is_disc_at_rest
}

/// Whether a guided projectile is at rest on springs and is included, guided along its line of motion.
pub(crate) fn hangs(model: &Model, body: usize) -> bool {
    let own = &model.bodies[body];
    own.kind == BodyKind::Guided && own.velocity == [0.0; 2] && model.is_tied(body)
}

/// Whether a pair is included.
pub(crate) fn takes_part(model: &Model, pair: &Pair) -> bool {
    let beams = model.beams.len();
    !pair.target.is_guided() && pair.movers.iter().all(|m| *m < beams || rests(model, m - beams))
}

impl StaticContacts {
    /// Contacts in the configuration `base`.
    pub fn new(model: &Model, base: &State) -> Self {
        let size = model.position_scale();
        let extent = model.extent().max(f64::MIN_POSITIVE);
        let gravity = model.gravity();
        let bending = model.beams.iter().map(|b| {
            let law = &model.spans[b.spans.start].table(0).rows[1].section;
            law.bending / (b.length * b.length)
        });
        let other = bending.fold(f64::INFINITY, f64::min).min(f64::MAX);
        let disc = |body: usize| {
            let weight = model.bodies[body].mass * gravity;
            let weight = if weight > 0.0 { weight } else { WEAK * other };
            RestingDisc { body, node: model.body_node(body), spring: WEAK * weight / extent }
        };
        let moves =
            |i: &usize| (model.bodies[*i].kind.is_disc() && rests(model, *i)) || hangs(model, *i);
        let discs: Vec<RestingDisc> = (0..model.bodies.len()).filter(moves).map(disc).collect();
        let is_fixed = |i: &usize| !moves(i) && model.is_tied(*i);
        let fixed_nodes =
            (0..model.bodies.len()).filter(is_fixed).map(|i| model.body_node(i)).collect();
        let has_bodies = !model.bodies.is_empty();
        let mut contacts = Self { discs, fixed_nodes, has_bodies, size, ..Self::default() };
        let at = Configuration::of(&base.displacement);
        for (i, pair) in model.pairs.iter().enumerate().filter(|(_, p)| takes_part(model, p)) {
            let touch = pair.touch(model, &at, &Memory::default(), SearchRegion::All);
            let memory = touch.map_or(Memory::default(), |t| t.memory);
            let rigid = model.contacts[pair.contact].law.is_rigid();
            let of_disc = |d: &RestingDisc| pair.movers.contains(&(model.beams.len() + d.body));
            contacts.places.push(CandidatePair {
                pair: i,
                is_exact: rigid && !contacts.discs.iter().any(of_disc),
                accepted: memory,
                seen: memory,
                deepest: base.pairs.get(i).map_or(0.0, |seen| seen.deepest),
                on_face: f64::NAN,
                gap: touch.map_or(f64::INFINITY, |t| t.gap),
                force: 0.0,
                slope: 0.0,
                multiplier: 0.0,
                stiffness: 0.0,
                stiffnesses: if rigid { contacts.stiffnesses(model, pair) } else { [0.0; 2] },
                closed: false,
                was_closed: false,
                held: 0.0,
                deep: contacts.deep(model, pair),
                row: Row::default(),
                s: f64::NAN,
                change: 0.0,
            });
            if model.crushes() {
                contacts.dents.push(base.dents.get(i).cloned().unwrap_or_default());
            }
        }
        contacts
    }

    /// Stiffnesses of a rigid pair, the first and the largest: in units of the softer partner's, or of a disc's weight.
    fn stiffnesses(&self, model: &Model, pair: &Pair) -> [f64; 2] {
        let beams = model.beams.len();
        let of = |mover: &usize| {
            if let Some(beam) = model.beams.get(*mover) {
                let table = model.spans[beam.spans.start].table(0);
                let (bending, l) = (table.rows[1].section.bending, table.length);
                let soft = 4.0 * bending * l / (SOFT * beam.length).powi(4);
                return [soft, STIFFER * 12.0 * bending / l.powi(3)];
            }
            let disc = self.discs.iter().find(|d| d.body == mover - beams);
            let own = disc.map_or(f64::MAX, |d| STIFF / WEAK * d.spring);
            [own, own]
        };
        let [a, b] = pair.movers.each_ref().map(of);
        [a[0].min(b[0]), a[1].min(b[1])]
    }

    /// Whether there are no contacts and no unsupported bodies.
    pub fn is_empty(&self) -> bool {
        self.places.is_empty() && self.discs.is_empty()
    }

    /// Whether any contact transmits a force.
    pub fn press(&self) -> bool {
        self.places.iter().any(|p| p.force != 0.0)
    }

    /// Whether a rigid contact transmits a force, or is about to close: an open one cannot be the reason for a failed iteration.
    pub fn rigid_ones_matter(&self, model: &Model) -> bool {
        let near = ABOUT_TO_CLOSE * model.extent();
        self.places.iter().any(|p| !p.is_compliant() && (p.force != 0.0 || p.gap <= near))
    }

    /// An iteration begins.
    pub fn begin(&mut self, pressing: Pressing) {
        self.pressing = pressing;
        self.places.iter_mut().for_each(|p| p.stiffness = p.stiffnesses[0]);
    }

    /// Closed contacts remain closed and resist any motion.
    pub fn hold(&mut self) {
        self.damping = WEAK;
        if self.pressing == Pressing::Exactly {
            self.pressing = Pressing::Held;
        }
    }

    /// Whether corrections find forces of rigid contacts.
    pub fn press_exactly(&self) -> bool {
        self.pressing == Pressing::Exactly && self.places.iter().any(|p| p.is_exact)
    }

    /// Accepts the current equilibrium: sides, closest points and crushing depths are updated from it.
    pub fn accept(&mut self, model: &Model) {
        self.places.iter_mut().for_each(|place| place.accepted = place.seen);
        for (place, dents) in self.places.iter_mut().zip(&mut self.dents) {
            let pair = &model.pairs[place.pair];
            let Some(law) = model.contacts[pair.contact].law.smooth() else { continue };
            if law.unloading.is_some() {
                let face = (dents, pair.reach - pair.target_radius);
                let now = Dent { place: place.on_face, side: place.seen.side, depth: -place.gap };
                law.remember(&mut place.deepest, now, Some(face), place.force > 0.0);
            }
        }
    }

    /// Writes crushing depths into a state.
    pub fn remember_crushing(&self, state: &mut State) {
        for place in &self.places {
            state.pairs[place.pair].deepest = place.deepest;
        }
        for (place, dents) in self.places.iter().zip(&self.dents) {
            state.dents[place.pair].clone_from(dents);
        }
    }

    /// Adds forces of contacts and their tangent to those of the beams, and weak springs.
    pub fn assemble<const TANGENT: bool>(
        &mut self,
        model: &Model,
        base: &State,
        increment: &[[f64; 4]],
        residual: &mut [[f64; 4]],
        tangent: &mut Tangent,
    ) {
        if TANGENT {
            self.add_springs(tangent);
            self.damping = (0.5 * self.damping).max(WEAK);
        }
        if self.places.is_empty() {
            return;
        }
        let start = Configuration {
            start: &base.displacement,
            increment,
            share: 1.0,
            arcs: &[],
            parted: &base.parted,
        };
        self.arcs.clear();
        let on_axis = |p: &CandidatePair| model.pairs[p.pair].target.is_outline();
        if self.places.iter().any(on_axis) {
            let arcs = model.beams.iter().map(|b| longest_arc(&b.axis, &model.nodes, &start));
            self.arcs.extend(arcs);
        }
        let (at, size) = (Configuration { arcs: &self.arcs, ..start }, self.size);
        let pressing = self.pressing;
        let (mut flips, mut most) = (0.0_f64, 0.0_f64);
        let closed = |contacts: &Self| contacts.places.iter().any(|p| p.was_closed);
        let held = closed(self);
        for place in &mut self.places {
            let pair = &model.pairs[place.pair];
            let memory = Memory { near: place.seen.near, ..place.accepted };
            let Some(touch) = pair.touch(model, &at, &memory, SearchRegion::All) else {
                (place.gap, place.force, place.closed) = (f64::INFINITY, 0.0, false);
                place.multiplier = 0.0;
                continue;
            };
            place.seen = touch.memory;
            place.on_face = pair.place_on_face(&touch, &at);
            place.look(model, pair, &touch, size, pressing);
            let exact = place.is_exact && pressing != Pressing::Following;
            if TANGENT && !exact {
                if place.closed != place.was_closed {
                    flips = flips.max(place.force).max(place.held);
                }
                most = most.max(place.force);
                (place.was_closed, place.held) = (place.closed, place.force);
            }
            place.row = pair.normal_row(&touch, &at);
            if place.force == 0.0 && !place.closed && !exact {
                continue;
            }
            place.row.spread(-place.force, residual);
            if TANGENT && (place.force != 0.0 || place.closed) {
                place.add_tangent(model, pair, (&touch, &at), tangent, pressing);
            }
        }
        if TANGENT {
            // Contacts with negligible forces may open and close by round-off.
            self.changed = flips > NEXT_TO_NOTHING * most;
            self.opened = held && !closed(self);
        }
    }

    /// Whether all contacts have opened at once, contrary to the prediction of the previous tangent.
    pub fn opened(&self) -> bool {
        self.opened
    }

    /// Records a correction, of which a share was applied.
    pub fn correct(&mut self, correction: &[[f64; 4]], share: f64) {
        let (size, follows) = (self.size, !self.changed);
        let exactly = self.press_exactly();
        for place in self.places.iter_mut().filter(|p| p.stiffnesses[0] > 0.0) {
            if exactly && place.is_exact {
                place.change *= share;
                place.multiplier += place.change;
                continue;
            }
            place.change = 0.0;
            if !place.closed {
                place.multiplier = 0.0;
                continue;
            }
            if !follows {
                continue;
            }
            let moved = place.row.on(correction) / share;
            let pushed = (place.force - place.stiffness * moved).max(0.0);
            place.change = share * (pushed - place.multiplier);
            place.multiplier += place.change;
            let gap = place.gap.abs();
            if gap > CLOSED * size && (place.gap + moved).abs() > SLOW * gap {
                place.stiffness = (GROWTH * place.stiffness).min(place.stiffnesses[1]);
            }
        }
    }

    /// Whether the closed set of the tangent assembled last is another one than that before.
    pub fn changed(&self) -> bool {
        self.changed
    }

    /// Whether the last check changed no contact, and the last correction hardly changed a force.
    pub fn settled(&self) -> bool {
        let most = self.places.iter().map(|p| p.force.abs()).fold(0.0, f64::max);
        let exactly = self.press_exactly();
        let rests = |p: &CandidatePair| {
            let touches = !p.closed || p.stiffnesses[0] == 0.0 || p.gap.abs() <= CLOSED * self.size;
            let exact = exactly && p.is_exact;
            let (outside, share) = match exact {
                true => (p.gap >= -CLOSED * self.size, SETTLED_EXACTLY),
                false => (true, SETTLED),
            };
            touches && outside && p.change.abs() <= share * most
        };
        !self.changed && self.places.iter().all(rests)
    }

    fn round_off(&self) -> f64 {
        ROUND_OFF * self.size
    }

    /// Writes the state of the pairs to a state of the model.
    pub fn enter(&self, state: &mut State) {
        for place in &self.places {
            let seen = &mut state.pairs[place.pair];
            (seen.gap, seen.rate, seen.memory) = (place.gap, 0.0, place.seen);
            seen.closed = place.closed && place.force > 0.0;
        }
    }
}
