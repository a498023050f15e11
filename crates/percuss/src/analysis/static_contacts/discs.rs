//! Bodies without stiffness, discs and beams without supports: weak springs connect them to their current position in the iteration, not to a fixed
//! place.

use super::place::RestingDisc;
use super::{STRIDE, StaticContacts, WEAK};
use crate::geometry::pair::Pair;
use crate::linalg::block::ZERO;
use crate::linalg::chain::Chain;
use crate::math::vec2::{norm, scale};
use crate::model::Model;
use crate::model::frozen::BeamData;
use crate::step::forcing::Forcing;
use crate::step::tangent::Tangent;

/// Stiffness of fixed bodies, far beyond that of any spring.
const IMMOVABLE: f64 = 1e30;
/// A body that has moved by more than this multiple of the total size is unsupported.
const LOST: f64 = 1e2;
/// Limit of the penetration of a disc in a compliant contact, as a multiple of the one under its weight.
const DEEP: f64 = 4.0;

impl StaticContacts {
    /// Corrections of discs are limited at first: on a beam that has not yet deformed, their tangent is a poor prediction of their motion.
    pub fn slow_discs(&mut self) {
        self.damping = 1.0;
    }

    /// Whether a correction moves a disc against the force on it, as with a tangent that is not positive; discs are slower then.
    pub fn climb(&mut self, residual: &[[f64; 4]], correction: &[[f64; 4]]) -> bool {
        let uphill = |d: &RestingDisc| {
            let (r, c) = (&residual[d.node], &correction[d.node]);
            r[0] * c[0] + r[1] * c[1] > 0.0
        };
        let climbs = self.damping < 0.25 && self.discs.iter().any(uphill);
        if climbs {
            self.slow_discs();
        }
        climbs
    }

    /// Bodies: weight of those in the analysis; all others do not move.
    pub fn bodies<const TANGENT: bool>(
        &self,
        model: &Model,
        forcing: &Forcing,
        residual: &mut [[f64; 4]],
        tangent: &mut Tangent,
    ) {
        if !self.has_bodies {
            return;
        }
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

    /// Bodies that are fixed whatever forces of springs act on them.
    pub fn fix_nodes<const TANGENT: bool>(&self, residual: &mut [[f64; 4]], tangent: &mut Tangent) {
        for node in &self.fixed_nodes {
            residual[*node] = [0.0; 4];
            if TANGENT {
                let diagonal = &mut tangent.chain_mut().diag[*node];
                (0..4).for_each(|k| diagonal[k][k] = IMMOVABLE);
            }
        }
    }

    /// Whether the body of a node is fixed.
    pub fn is_fixed(&self, node: usize) -> bool {
        self.fixed_nodes.contains(&node)
    }

    /// Share of a correction that discs can follow: up to the next obstacle, and not much further.
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

    /// Records unsupported bodies.
    pub fn look_for_lost(&mut self, model: &Model, u: &[[f64; 4]]) {
        let far = |n: &[f64; 4]| {
            let moved = norm([n[0], n[1]]);
            moved.is_nan() || moved > LOST * self.size
        };
        let disc = self.discs.iter().find(|d| far(&u[d.node])).map(|d| model.beams.len() + d.body);
        let gone = |b: &BeamData| u[b.nodes.clone()].iter().any(far);
        let beam = || model.beams.iter().position(gone).filter(|_| !self.loose.is_empty());
        self.lost = disc.or_else(beam);
    }

    /// A disc or a beam without support.
    pub fn lost<'m>(&self, model: &'m Model) -> Option<&'m str> {
        let body = |lost: usize| model.bodies[lost - model.beams.len()].name.as_str();
        self.lost.map(|lost| model.beams.get(lost).map_or_else(|| body(lost), |b| b.name.as_str()))
    }

    /// Number of that: beams first, then bodies.
    pub fn lost_one(&self) -> Option<usize> {
        self.lost
    }

    /// Marks a body as unsupported.
    pub fn lose(&mut self, lost: Option<usize>) {
        self.lost = lost;
    }

    /// Weak springs at components of nodes, in units of the weight of everything over the size of the structure.
    pub fn hold_loosely(&mut self, model: &Model, stops: Vec<(usize, usize)>) {
        let extent = model.extent().max(f64::MIN_POSITIVE);
        let tables = model.each_element().map(|(span, k, _, _)| span.table(k));
        let mass: f64 = tables.map(|t| t.mass[0][0] + 2.0 * t.mass[0][2] + t.mass[2][2]).sum();
        let weight = mass * model.gravity();
        let bending =
            model.each_element().map(|(span, k, _, _)| span.table(k).rows[1].section.bending);
        let least = bending.fold(f64::INFINITY, f64::min) / (extent * extent);
        let weight = if weight > 0.0 { weight } else { WEAK * least };
        let spring = |component| if component < 2 { weight / extent } else { weight * extent };
        self.loose = stops.into_iter().map(|(node, k)| (node, k, spring(k))).collect();
    }

    /// Whether there are beams that neither supports nor joints hold.
    pub fn holds_beams(&self) -> bool {
        !self.loose.is_empty()
    }

    pub(super) fn add_springs(&self, tangent: &mut Tangent) {
        for (node, k, spring) in &self.loose {
            tangent.chain_mut().diag[*node][*k][*k] += self.damping * spring;
        }
    }

    /// Discs in the analysis.
    pub fn has_discs(&self) -> bool {
        !self.discs.is_empty()
    }

    /// Whether a body is one of them.
    pub fn has_disc(&self, body: usize) -> bool {
        self.discs.iter().any(|disc| disc.body == body)
    }

    /// Adds the measure of motions of bodies: of discs the stiffness that their weight has over the size of the structure.
    pub fn measure_bodies(&self, measure: &mut Chain, model: &Model) {
        let nodes = (0..model.bodies.len()).map(|body| (model.body_node(body), 1.0));
        let discs = self.discs.iter().map(|d| (d.node, d.spring / WEAK));
        for (node, stiffness) in nodes.chain(discs) {
            (0..4).for_each(|k| measure.diag[node][k][k] = stiffness);
        }
    }

    /// Removes the weak springs from an assembled tangent.
    pub fn without_springs(&self, tangent: &mut Tangent) {
        for disc in &self.discs {
            let diagonal = &mut tangent.chain_mut().diag[disc.node];
            (0..2).for_each(|k| diagonal[k][k] -= disc.spring);
        }
        for (node, k, spring) in &self.loose {
            tangent.chain_mut().diag[*node][*k][*k] -= self.damping * spring;
        }
    }

    /// Limit of the penetration of the pair's disc in a correction \[m\].
    pub(super) fn deep(&self, model: &Model, pair: &Pair) -> f64 {
        let stride = STRIDE * self.size;
        if pair.target.is_round() {
            return (0.5 * pair.reach).min(stride);
        }
        let Some(law) = model.contacts[pair.contact].law.smooth() else { return stride };
        let mass = |disc: &RestingDisc| model.bodies[disc.body].mass;
        let weight = self.discs.iter().map(mass).fold(0.0, f64::max) * model.gravity();
        let mut deep = stride;
        while weight > 0.0 && law.potential.force(deep) > DEEP * weight && deep > self.round_off() {
            deep *= 0.5;
        }
        deep
    }
}
