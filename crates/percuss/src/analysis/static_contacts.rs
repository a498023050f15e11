//! Contacts at rest, without friction: compliant ones by their potential, rigid ones as `0 <= gap  perp  force >= 0`.
//!
//! Rigid contacts keep a multiplier each and press with `multiplier - stiffness gap` while that is positive (augmented Lagrangian:
//! Alart, Curnier 1991); multipliers follow wherever the closed set has come to rest. Their stiffness only speeds the iteration up: in
//! equilibrium gaps are round-off and forces are the multipliers. Discs have no stiffness of their own; a weak spring to where the iteration stands, not to any place, keeps the
//! tangent regular.

use crate::contact::axis::longest_arc;
use crate::contact::configuration::Configuration;
use crate::contact::pair::{Memory, Pair, Target};
use crate::contact::row::Row;
use crate::contact::touch::{Reach, Touch};
use crate::contact::turning::Turning;
use crate::linalg::block::ZERO;
use crate::linalg::chain::Chain;
use crate::math::vec2::{cross, norm, scale};
use crate::model::frozen::{BodyKind, NodeHold};
use crate::model::{Model, TouchLaw};
use crate::state::State;
use crate::step::contacts::{add_tangent, add_turning};
use crate::step::forcing::Forcing;
use crate::step::tangent::Tangent;

/// Gaps and moves below this share of the positions in play are round-off.
const ROUND_OFF: f64 = 8.0 * f64::EPSILON;
/// Gaps below this share of the positions in play are closed: a tenth of what a transient holds to be none.
const CLOSED: f64 = 1e-13;
/// A rigid contact begins as stiff as a foundation that lets its beam sink in over this share of its length: whole stretches come and go
/// at once on it, which on a stiff one would one by one.
const SOFT: f64 = 0.1;
/// Stiffness of a rigid contact in the end, in units of its element's.
const STIFFER: f64 = 1e3;
/// The weak spring of a disc in the end, in units of its weight over the size of the structure, and the stiffness of its rigid
/// contacts.
const WEAK: f64 = 1e-4;
const STIFF: f64 = 1e5;
/// Stiffness of a rigid contact grows by this factor where a correction of a closed set that stays leaves more than a share of its gap.
const GROWTH: f64 = 100.0;
const SLOW: f64 = 1e-4;
/// A disc is pushed no deeper into a compliant contact than where it presses with so many times its weight.
const DEEP: f64 = 4.0;
/// Forces below this share of the largest.
const NEXT_TO_NOTHING: f64 = 1e-8;
/// Change of a multiplier that has settled, relative to the largest.
const SETTLED: f64 = 1e-6;
/// A disc moves by no more than this share of the structure in a correction, once it touches.
const STRIDE: f64 = 0.05;
/// What has moved by so many times the size of everything is held by nothing.
const LOST: f64 = 1e2;

/// A contact of an equilibrium: the sum over the places where it is closed.
#[derive(Clone, Debug, PartialEq)]
pub struct StaticContact {
    /// Its name.
    pub name: String,
    /// Its parties.
    pub between: [String; 2],
    /// Forces along the normals, summed \[N\].
    pub force: f64,
    /// Resultant on the first of the two parties \[N\].
    pub resultant: [f64; 2],
    /// Least gap \[m\]; negative where a compliant contact is pressed in, infinite where nothing can touch.
    pub gap: f64,
    /// Where it is closed along the beam: from and to, arc length \[m\]; NaN where it is open or on no beam.
    pub s: [f64; 2],
    /// Arc length at which the forces have their centre \[m\]; NaN likewise.
    pub centre: f64,
    /// Whether its law has friction, which takes no part.
    pub frictional: bool,
}

/// A pair that takes part.
#[derive(Clone, Copy, Debug)]
struct Place {
    pair: usize,
    /// Side and foot in the equilibrium found last, and the foot seen last.
    accepted: Memory,
    seen: Memory,
    /// Gap at the last look; infinite where nothing can touch \[m\].
    gap: f64,
    /// Force at the last look \[N\].
    force: f64,
    /// Multiplier of a rigid pair \[N\].
    multiplier: f64,
    /// Stiffness of a rigid pair \[N/m\]; zero for a compliant one.
    stiffness: f64,
    /// The one an iteration begins with, and the largest \[N/m\].
    stiffnesses: [f64; 2],
    /// Rigid and closed at the last look, and in the tangent assembled last.
    closed: bool,
    was_closed: bool,
    /// Force in the tangent assembled last \[N\].
    held: f64,
    /// How deep a disc may be pushed in by a correction \[m\].
    deep: f64,
    row: Row,
    /// Arc length along the beam \[m\].
    s: f64,
    /// Change of the multiplier by the last correction \[N\].
    change: f64,
}

/// A disc at rest.
#[derive(Clone, Copy, Debug)]
struct Disc {
    body: usize,
    node: usize,
    /// Weak spring \[N/m\].
    spring: f64,
}

/// Contacts and discs that take part in statics.
#[derive(Clone, Debug, Default)]
pub(super) struct StaticContacts {
    places: Vec<Place>,
    discs: Vec<Disc>,
    /// Bodies in the model: all of them stand still but those discs.
    has_bodies: bool,
    /// Scale of positions \[m\].
    size: f64,
    /// Whether the closed set of the tangent assembled last is another one than that before; whether it is empty and was not always.
    changed: bool,
    opened: bool,
    /// Weak springs of discs in units of their weights over the size of the structure.
    damping: f64,
    /// A disc that has left for good.
    lost: Option<usize>,
    arcs: Vec<f64>,
}

/// Whether a body takes part in an equilibrium: at rest, and not on a line of flight.
fn rests(model: &Model, body: usize) -> bool {
    let body = &model.bodies[body];
    match body.kind {
        BodyKind::Obstacle => true,
        BodyKind::Disc { .. } => body.velocity == [0.0; 2] && body.spin == 0.0,
        BodyKind::Guided | BodyKind::Rear { .. } => false,
    }
}

/// Whether a pair takes part.
pub(super) fn takes_part(model: &Model, pair: &Pair) -> bool {
    let beams = model.beams.len();
    !matches!(pair.target, Target::Guided { .. })
        && pair.movers.iter().all(|m| *m < beams || rests(model, m - beams))
}

impl StaticContacts {
    /// Contacts as they stand in `base`.
    pub fn new(model: &Model, base: &State) -> Self {
        let nodes = model.nodes.iter().map(|n| norm(n.position)).fold(0.0, f64::max);
        let size = super::trial::size_of(model).max(nodes);
        let extent = super::trial::size_of(model).max(f64::MIN_POSITIVE);
        let gravity = model.gravity();
        let bending = model.beams.iter().map(|b| {
            let law = &model.spans[b.spans.start].table(0).rows[1].section;
            law.bending / (b.length * b.length)
        });
        let other = bending.fold(f64::INFINITY, f64::min).min(f64::MAX);
        let disc = |body: usize| {
            let weight = model.bodies[body].mass * gravity;
            let weight = if weight > 0.0 { weight } else { WEAK * other };
            Disc { body, node: model.body_node(body), spring: WEAK * weight / extent }
        };
        let is_disc = |i: &usize| matches!(model.bodies[*i].kind, BodyKind::Disc { .. });
        let discs: Vec<Disc> = (0..model.bodies.len())
            .filter(is_disc)
            .filter(|i| rests(model, *i))
            .map(disc)
            .collect();
        let mut contacts =
            Self { discs, has_bodies: !model.bodies.is_empty(), size, ..Self::default() };
        let at = Configuration::of(&base.displacement);
        for (i, pair) in model.pairs.iter().enumerate().filter(|(_, p)| takes_part(model, p)) {
            let touch = pair.touch(model, &at, &Memory::default(), Reach::All);
            let memory = touch.map_or(Memory::default(), |t| t.memory);
            let rigid = matches!(model.contacts[pair.contact].law, TouchLaw::Rigid(_));
            contacts.places.push(Place {
                pair: i,
                accepted: memory,
                seen: memory,
                gap: touch.map_or(f64::INFINITY, |t| t.gap),
                force: 0.0,
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
        }
        contacts
    }

    /// Stiffnesses of a rigid pair, the first and the largest: in units of the softer party's, or of a disc's weight.
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

    /// How deep a disc of the pair may be pushed in by a correction \[m\].
    fn deep(&self, model: &Model, pair: &Pair) -> f64 {
        let stride = STRIDE * self.size;
        if let Target::Round { .. } = pair.target {
            return (0.5 * pair.reach).min(stride);
        }
        let TouchLaw::Smooth(law) = &model.contacts[pair.contact].law else { return stride };
        let mass = |disc: &Disc| model.bodies[disc.body].mass;
        let weight = self.discs.iter().map(mass).fold(0.0, f64::max) * model.gravity();
        let mut deep = stride;
        while weight > 0.0 && law.potential.force(deep) > DEEP * weight && deep > self.round_off() {
            deep *= 0.5;
        }
        deep
    }

    /// Whether there is nothing that could touch or has to be held.
    pub fn is_empty(&self) -> bool {
        self.places.is_empty() && self.discs.is_empty()
    }

    /// Whether any contact transmits a force.
    pub fn press(&self) -> bool {
        self.places.iter().any(|p| p.force != 0.0)
    }

    /// An iteration begins.
    pub fn begin(&mut self) {
        self.places.iter_mut().for_each(|p| p.stiffness = p.stiffnesses[0]);
    }

    /// Discs move cautiously at first: on a beam that has not yet given way their tangent tells little of where they roll to.
    pub fn slow_discs(&mut self) {
        self.damping = 1.0;
    }

    /// Whether a correction moves a disc against the force on it, which a tangent that is not positive does; discs are slower then.
    pub fn climb(&mut self, residual: &[[f64; 4]], correction: &[[f64; 4]]) -> bool {
        let uphill = |d: &Disc| {
            let (r, c) = (&residual[d.node], &correction[d.node]);
            r[0] * c[0] + r[1] * c[1] > 0.0
        };
        let climbs = self.damping < 0.25 && self.discs.iter().any(uphill);
        if climbs {
            self.slow_discs();
        }
        climbs
    }

    /// The equilibrium at hand is one: sides and feet are those seen in it.
    pub fn accept(&mut self) {
        self.places.iter_mut().for_each(|p| p.accepted = p.seen);
    }

    /// Adds weight and weak springs of discs, forces of contacts and their tangent to those of the beams.
    pub fn assemble<const TANGENT: bool>(
        &mut self,
        model: &Model,
        base: &State,
        forcing: &Forcing,
        increment: &[[f64; 4]],
        residual: &mut [[f64; 4]],
        tangent: &mut Tangent,
    ) {
        if self.has_bodies {
            self.bodies::<TANGENT>(model, forcing, residual, tangent);
        }
        if self.places.is_empty() {
            return;
        }
        let start = Configuration { start: &base.displacement, increment, share: 1.0, arcs: &[] };
        self.arcs.clear();
        let on_axis = |p: &Place| matches!(model.pairs[p.pair].target, Target::Axis { .. });
        if self.places.iter().any(on_axis) {
            let arcs = model.beams.iter().map(|b| longest_arc(&b.axis, &model.nodes, &start));
            self.arcs.extend(arcs);
        }
        let (at, size) = (Configuration { arcs: &self.arcs, ..start }, self.size);
        let (mut flips, mut most) = (0.0_f64, 0.0_f64);
        let closed = |contacts: &Self| contacts.places.iter().any(|p| p.was_closed);
        let held = closed(self);
        for place in &mut self.places {
            let pair = &model.pairs[place.pair];
            let memory = Memory { near: place.seen.near, ..place.accepted };
            let Some(touch) = pair.touch(model, &at, &memory, Reach::All) else {
                (place.gap, place.force, place.closed) = (f64::INFINITY, 0.0, false);
                continue;
            };
            place.seen = touch.memory;
            place.look(model, pair, &touch, size);
            if TANGENT {
                if place.closed != place.was_closed {
                    flips = flips.max(place.force).max(place.held);
                }
                most = most.max(place.force);
                (place.was_closed, place.held) = (place.closed, place.force);
            }
            if place.force == 0.0 && !place.closed {
                continue;
            }
            place.row = pair.normal_row(&touch, &at);
            place.row.spread(-place.force, residual);
            if TANGENT {
                place.add_tangent(model, pair, &touch, &at, tangent);
            }
        }
        if TANGENT {
            // What presses next to nothing may come and go by round-off.
            self.changed = flips > NEXT_TO_NOTHING * most;
            self.opened = held && !closed(self);
            self.damping = (0.5 * self.damping).max(WEAK);
        }
    }

    /// Whether everything has come open at once, which was not what the tangent before had in mind.
    pub fn opened(&self) -> bool {
        self.opened
    }

    /// Bodies: weight of the discs that take part; all others stand still.
    fn bodies<const TANGENT: bool>(
        &self,
        model: &Model,
        forcing: &Forcing,
        residual: &mut [[f64; 4]],
        tangent: &mut Tangent,
    ) {
        for body in 0..model.bodies.len() {
            let node = model.body_node(body);
            residual[node] = [0.0; 4];
            if TANGENT {
                let chain = tangent.chain_mut();
                let mut diagonal = ZERO;
                (0..4).for_each(|k| diagonal[k][k] = 1.0);
                (chain.diag[node], chain.upper[node], chain.lower[node]) = (diagonal, ZERO, ZERO);
            }
        }
        for disc in &self.discs {
            let [x, y] = scale(-model.bodies[disc.body].mass, forcing.gravity);
            residual[disc.node] = [x, y, 0.0, 0.0];
            if TANGENT {
                let diagonal = &mut tangent.chain_mut().diag[disc.node];
                let spring = self.damping / WEAK * disc.spring;
                (diagonal[0][0], diagonal[1][1]) = (spring, spring);
            }
        }
    }

    /// The share of a correction that discs can take: up to what is in their way, and not much further.
    pub fn share(&self, model: &Model, correction: &[[f64; 4]]) -> f64 {
        let mut share: f64 = 1.0;
        for disc in &self.discs {
            let c = correction[disc.node];
            let way = norm([c[0], c[1]]);
            let mover = model.beams.len() + disc.body;
            let mut free = f64::INFINITY;
            for place in &self.places {
                let pair = &model.pairs[place.pair];
                if !pair.movers.contains(&mover) {
                    continue;
                }
                let touches = place.force != 0.0;
                let closing = if touches { -place.row.on(correction) } else { way };
                let room = place.gap.max(0.0) + place.deep;
                if closing > room {
                    share = share.min(room / closing);
                }
                if touches {
                    free = free.min(STRIDE * self.size);
                } else {
                    free = free.min(room.max(place.gap));
                }
            }
            let free = if free.is_finite() { free } else { self.size };
            if way > free {
                share = share.min(free / way);
            }
        }
        share
    }

    /// Takes in a correction, of which a share was taken.
    pub fn correct(&mut self, correction: &[[f64; 4]], share: f64, u: &[[f64; 4]]) {
        let (size, follows) = (self.size, !self.changed);
        for place in self.places.iter_mut().filter(|p| p.stiffnesses[0] > 0.0) {
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
        let far = LOST * self.size;
        let lost = |d: &&Disc| {
            let moved = norm([u[d.node][0], u[d.node][1]]);
            moved.is_nan() || moved > far
        };
        self.lost = self.discs.iter().find(lost).map(|d| d.body);
    }

    /// Whether the closed set of the tangent assembled last is another one than that before.
    pub fn changed(&self) -> bool {
        self.changed
    }

    /// Whether the last look found nothing to change, and the last correction hardly changed a force.
    pub fn settled(&self) -> bool {
        let most = self.places.iter().map(|p| p.force.abs()).fold(0.0, f64::max);
        let rests = |p: &Place| {
            let touches = !p.closed || p.stiffnesses[0] == 0.0 || p.gap.abs() <= CLOSED * self.size;
            touches && p.change.abs() <= SETTLED * most
        };
        !self.changed && self.places.iter().all(rests)
    }

    fn round_off(&self) -> f64 {
        ROUND_OFF * self.size
    }

    /// A disc that nothing holds.
    pub fn lost<'m>(&self, model: &'m Model) -> Option<&'m str> {
        self.lost.map(|body| model.bodies[body].name.as_str())
    }

    /// Discs that take part.
    pub fn has_discs(&self) -> bool {
        !self.discs.is_empty()
    }

    /// Adds the measure of motions of bodies: of discs the stiffness that their weight has over the size of the structure.
    pub fn measure_bodies(&self, measure: &mut Chain, model: &Model) {
        let nodes = (0..model.bodies.len()).map(|body| (model.body_node(body), 1.0));
        let discs = self.discs.iter().map(|d| (d.node, d.spring / WEAK));
        for (node, stiffness) in nodes.chain(discs) {
            (0..4).for_each(|k| measure.diag[node][k][k] = stiffness);
        }
    }

    /// Takes the weak springs of the discs out of an assembled tangent.
    pub fn without_springs(&self, tangent: &mut Tangent) {
        for disc in &self.discs {
            let diagonal = &mut tangent.chain_mut().diag[disc.node];
            (0..2).for_each(|k| diagonal[k][k] -= disc.spring);
        }
    }

    /// Writes pairs as they stand to a state of the model.
    pub fn enter(&self, state: &mut State) {
        for place in &self.places {
            let seen = &mut state.pairs[place.pair];
            (seen.gap, seen.rate, seen.memory) = (place.gap, 0.0, place.seen);
            seen.closed = place.closed && place.force > 0.0;
        }
    }

    /// Forces of the pairs, with the forms they act along.
    pub fn forces(&self) -> impl Iterator<Item = (usize, f64, &Row)> {
        self.places.iter().filter(|p| p.force != 0.0).map(|p| (p.pair, p.force, &p.row))
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
            // What it gives is the opposite of what it takes.
            own[0] -= force * c[0];
            own[1] -= force * c[1];
            own[2] -= force * (c[2] - cross(arm, [c[0], c[1]]));
        }
    }

    /// Contacts of which any pair takes part, in the model's order.
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
            let sign = if pair.source_party == 0 { 1.0 } else { -1.0 };
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
        frictional: matches!(data.law, TouchLaw::Rigid(law) if law.friction > 0.0),
    }
}

impl Place {
    /// Gap and force where the pair is nearest.
    fn look(&mut self, model: &Model, pair: &Pair, touch: &Touch, size: f64) {
        self.gap = touch.gap;
        self.s = super::contact_log::along(pair, touch);
        match &model.contacts[pair.contact].law {
            TouchLaw::Smooth(law) => {
                self.force = law.potential.force(-touch.gap);
                self.closed = false;
            }
            TouchLaw::Rigid(_) => {
                let round_off = ROUND_OFF * size;
                let gap = if touch.gap.abs() <= round_off { 0.0 } else { touch.gap };
                let pushed = self.multiplier - self.stiffness * gap;
                self.closed = pushed > 0.0;
                self.force = pushed.max(0.0);
            }
        }
    }

    fn add_tangent(
        &self,
        model: &Model,
        pair: &Pair,
        touch: &Touch,
        at: &Configuration,
        tangent: &mut Tangent,
    ) {
        let (slope, bend) = match &model.contacts[pair.contact].law {
            TouchLaw::Smooth(law) => (law.potential.stiffness(-touch.gap), self.force),
            // What closes has not yet a force of which the turning could be told.
            TouchLaw::Rigid(_) => (self.stiffness, self.multiplier.max(0.0)),
        };
        let row = moving(model, &self.row);
        let moving = |t: Turning| Turning { forms: t.forms.map(|form| moving(model, &form)), ..t };
        let turning = pair.turning(touch, at).map(moving);
        add_tangent(tangent, &row, &row, slope, bend, turning.as_ref());
        let of_sections = pair.section_turnings(touch, at);
        of_sections.into_iter().flatten().for_each(|t| add_turning(tangent, bend, &moving(t)));
    }
}

/// A form on the nodes that can move: the others would only tie together what they touch.
fn moving(model: &Model, row: &Row) -> Row {
    let mut out = Row::default();
    for (node, c) in row.iter() {
        if !model.hold_at(node).is_some_and(NodeHold::is_whole) {
            out.add(node, *c);
        }
    }
    out
}
