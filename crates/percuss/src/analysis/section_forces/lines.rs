//! Section forces of all elements in a step or an equilibrium: the forces on their ends, and what acts along them.

use serde::{Deserialize, Serialize};

use super::line::{ElementShape, Inner, Line, NUMBERS, OnNodes, SAME_PLACE, place_of, resultant};
use super::span_lines::SpanLines;
use crate::element::beam::ElementValues;
use crate::element::shear::spread_linearly;
use crate::element::yielding::GaussStrains;
use crate::geometry::row::Row;
use crate::math::vec2::{add, dot, scale};
use crate::model::Model;
use crate::model::frozen::{LoadAction, MaterialPoint, Span};
use crate::scalar::in_lanes;
use crate::state::State;
use crate::step::assemble::forces_at_rest;
use crate::step::columns::Columns;
use crate::step::contacts::PressingPair;
use crate::step::end_forces::EndForces;
use crate::step::external::{tangent_at, turned};
use crate::step::fibres::fibre_strains;
use crate::step::forcing::Forcing;
use crate::step::given_strains;
use crate::step::integration::{Integration, Rule};
use crate::step::masses;

/// What acts in a solved step, or in an equilibrium.
#[derive(Clone, Copy, Debug)]
pub struct Acting<'a> {
    /// Start of the step.
    pub state: &'a State,
    /// The increment that leads to its end, shape (nodes, 4) \[m, -\].
    pub increment: &'a [[f64; 4]],
    /// Scheme and size of the step; that of an equilibrium is static.
    pub rule: &'a Integration,
    /// What acts on the elements, as assembled for that increment.
    pub beams: &'a EndForces,
    /// Loads.
    pub forcing: &'a Forcing,
}

/// Section forces of all elements.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Lines {
    /// Coefficients of [`Line`], shape (numbers of a line, elements) \[m, N, N m\].
    pub(super) lines: Columns,
    /// Forces inside elements, by element and place, shape (such forces).
    pub(super) inner: Vec<Inner>,
    /// Nodal forces of the distributed loads and of foundations, by element, on values and slopes, shape (elements, 2, 4) \[N, N m\]; empty if there are none.
    loads: Vec<OnNodes>,
    /// Nodal forces of the strains that loads give, by element, likewise, shape (elements, 2, 4) \[N, N m\]; empty if there are none.
    given: Vec<OnNodes>,
    /// Mean rates of membrane and bending strain at the Gauss points of elements with viscous fibres, zero of others, shape (elements, Gauss points, 2)
    /// \[1/s, 1/(m s)\]; empty if there are none.
    rates: Vec<GaussStrains>,
}

impl Lines {
    /// Whether they are those of so many elements.
    pub fn fits(&self, elements: usize) -> bool {
        self.lines.fit(NUMBERS, elements)
            && (self.loads.is_empty() || self.loads.len() == elements)
            && (self.given.is_empty() || self.given.len() == elements)
            && (self.rates.is_empty() || self.rates.len() == elements)
            && self.inner.iter().all(|one| one.element < elements)
    }

    /// Of a state at rest, which what acts at time zero has brought about, the forces of contacts among it; nothing acts in the
    /// reference configuration.
    pub fn at_rest(model: &Model, state: &State, pressed: &[PressingPair]) -> Self {
        let nodes = &state.displacement[..model.beam_node_count()];
        let moved = nodes.as_flattened().iter().any(|u| *u != 0.0) || state.is_strained();
        let mut forcing = Forcing::new(model);
        if moved {
            forcing.set_static(model, 1.0);
        }
        let beams = &forces_at_rest(model, state, forcing.gravity);
        let increment = &vec![[0.0; 4]; model.node_count()];
        let mut lines = Self::default();
        let forcing = &forcing;
        let pressed = pressed.iter().map(|one| ([&one.row; 2], [one.force, 0.0]));
        let rule = &Integration { h: 1.0, rule: Rule::Static };
        lines.set(model, &Acting { state, increment, rule, beams, forcing }, pressed);
        lines
    }

    /// Takes in a step; `contacts` are forms along normal and tangent, with the forces along them.
    pub fn set<'r>(
        &mut self,
        model: &Model,
        acting: &Acting,
        contacts: impl IntoIterator<Item = ([&'r Row; 2], [f64; 2])>,
    ) {
        self.inner.clear();
        self.distribute(model, acting);
        self.found(model, acting);
        self.strain(model, acting);
        self.rate(model, acting);
        self.weigh(model, acting);
        for (rows, forces) in contacts {
            self.push(model, rows, forces);
        }
        self.inner.sort_by(|a, b| a.element.cmp(&b.element).then(a.xi.total_cmp(&b.xi)));
        if !self.lines.fit(NUMBERS, model.element_count()) {
            self.lines = Columns::zeros(NUMBERS, model.element_count());
        }
        let mut inner = std::mem::take(&mut self.inner);
        let mut rest = inner.as_mut_slice();
        for (i, span) in model.spans.iter().enumerate() {
            let swept = self.loads.is_empty()
                && self.given.is_empty()
                && acting.beams.sweep.has_evaluated(i);
            if swept {
                let (sweep, theta) = (&acting.beams.sweep, acting.rule.theta());
                in_lanes(SpanLines { span, number: i, sweep, theta, lines: &mut self.lines });
            }
            if swept && rest.is_empty() {
                continue;
            }
            for (k, element) in span.elements.clone().enumerate() {
                let own = rest.iter().take_while(|one| one.element == element).count();
                if swept && own == 0 {
                    continue;
                }
                let (here, others) = std::mem::take(&mut rest).split_at_mut(own);
                self.set_one(model, acting, (i, k), here);
                rest = others;
            }
        }
        self.inner = inner;
    }

    /// Takes in a step of one element, with what acts inside it.
    fn set_one(
        &mut self,
        model: &Model,
        acting: &Acting,
        (number, k): (usize, usize),
        inner: &mut [Inner],
    ) {
        let span = &model.spans[number];
        let (table, a, element) = (span.table(k), span.nodes.start + k, span.elements.start + k);
        if acting.state.has_parted(a) {
            // A gap bears nothing; what its mass does is no section force.
            (0..NUMBERS).for_each(|column| self.lines.set(column, element, 0.0));
            return;
        }
        let theta = acting.rule.theta();
        let share =
            |n: usize, i: usize| acting.state.displacement[n][i] + theta * acting.increment[n][i];
        let (na, nb) = (&model.nodes[a], &model.nodes[a + 1]);
        let shape = ElementShape {
            tangents: [
                [0, 1].map(|i| na.tangent[i] + share(a, 2 + i)),
                [0, 1].map(|i| nb.tangent[i] + share(a + 1, 2 + i)),
            ],
            chord: [0, 1]
                .map(|i| (nb.position[i] - na.position[i]) + (share(a + 1, i) - share(a, i))),
            length: table.length,
        };
        let mut along = [[0.0; 4]; 2];
        let [ia, ib] = [a, a + 1].map(|n| acting.beams.inertia(number, n));
        let [on_a, on_b] = &mut along;
        table.add_inertia(&ia, &ib, on_a, on_b);
        if span.shear.is_some() {
            spread_linearly(&table.mass, [&ia, &ib], &mut along);
        }
        let mut ends = acting.beams.on_nodes(number, element);
        if let Some(given) = self.given.get(element) {
            for (own, force) in ends.iter_mut().zip(given) {
                (0..4).for_each(|i| own[i] += force[i]);
            }
        }
        if let Some(load) = self.loads.get(element) {
            match span.shear {
                Some(_) => take(&mut along, &linear_shares(load, table.length)),
                None => take(&mut along, load),
            }
            take(&mut ends, load);
        }
        inner.iter().for_each(|one| take(&mut ends, &one.on_nodes));
        let line = match span.shear {
            Some(_) => Line::sheared(&shape, span.inside(k), [&ends, &along], inner),
            None => Line::new(&shape, &ends, &along, inner),
        };
        let numbers = line.numbers();
        for (column, x) in numbers.into_iter().enumerate() {
            self.lines.set(column, element, x);
        }
    }

    /// Takes mean rates of strains. Velocities at the end of a step may have another sign in every step, where damping is stiff: their means have not.
    fn rate(&mut self, model: &Model, acting: &Acting) {
        let viscous = |span: &&Span| span.retardation > 0.0 && span.fibres.is_some();
        self.rates.clear();
        if matches!(acting.rule.rule, Rule::Static) || !model.spans.iter().any(|s| viscous(&s)) {
            return;
        }
        self.rates.resize(model.element_count(), Default::default());
        for span in model.spans.iter().filter(viscous) {
            for (k, element) in span.elements.clone().enumerate() {
                let a = span.nodes.start + k;
                let strains = |share: f64| {
                    let node = |n: usize| -> [f64; 4] {
                        let (u, d) = (acting.state.displacement[n], acting.increment[n]);
                        std::array::from_fn(|i| u[i] + share * d[i])
                    };
                    fibre_strains(span, k, &ElementValues::new(&node(a), &node(a + 1)))
                };
                let (from, to) = (strains(0.0), strains(1.0));
                self.rates[element] = std::array::from_fn(|j| {
                    [0, 1].map(|i| (to[j][i] - from[j][i]) / acting.rule.h)
                });
            }
        }
    }

    /// Mean rates of strains at the Gauss points of an element with viscous fibres, shape (Gauss points, 2) \[1/s, 1/(m s)\].
    pub(super) fn rates_of(&self, element: usize) -> Option<&GaussStrains> {
        self.rates.get(element)
    }

    /// The section forces of an element, and what acts inside it.
    #[inline]
    pub fn of(&self, element: usize) -> (Line, &[Inner]) {
        (Line::from_numbers(self.lines.row(element)), self.inside(element))
    }

    /// What acts inside an element.
    #[inline]
    pub(super) fn inside(&self, element: usize) -> &[Inner] {
        if self.inner.is_empty() {
            return &[];
        }
        let from = self.inner.partition_point(|one| one.element < element);
        let count = self.inner[from..].partition_point(|one| one.element == element);
        &self.inner[from..from + count]
    }

    /// Axial force, shear force and moment at the start and the end of each of so many elements.
    pub fn ends(&self, elements: usize) -> impl Iterator<Item = [[f64; 3]; 2]> {
        (0..elements).map(|element| {
            let (line, inner) = self.of(element);
            [(0.0, true), (1.0, false)].map(|(xi, ahead)| {
                let at = line.at(xi, inner, ahead);
                [at.axial, at.shear, at.moment]
            })
        })
    }

    /// Loads by element.
    fn distribute(&mut self, model: &Model, acting: &Acting) {
        let spread_out = |kind: &LoadAction| {
            matches!(kind, LoadAction::Dead { .. } | LoadAction::Follower { .. })
        };
        let founded = !model.foundations.is_empty();
        if founded || model.loads.iter().any(|load| spread_out(&load.kind)) {
            self.loads.clear();
            self.loads.resize(model.element_count(), [[0.0; 4]; 2]);
        }
        let tangent =
            |p: &MaterialPoint| tangent_at(p, acting.state, acting.increment, acting.rule.theta());
        for (load, factor) in model.loads.iter().zip(&acting.forcing.factors) {
            if *factor == 0.0 {
                continue;
            }
            match &load.kind {
                LoadAction::Gravity { .. } | LoadAction::Strain { .. } => {}
                LoadAction::Point { point, force, moment, follower } => {
                    let g = tangent(point);
                    let scaled = scale(*factor, *force);
                    let force = match follower {
                        true => turned(scale(1.0 / dot(g, g).sqrt(), scaled), g),
                        false => scaled,
                    };
                    self.act(model, point, force, factor * moment, g);
                }
                LoadAction::Dead { shares, .. } => {
                    for (node, share) in shares {
                        let own = &mut self.loads[model.element_at(*node)];
                        for (own, share) in own.iter_mut().zip(share) {
                            (0..4).for_each(|i| own[i] += factor * share[i]);
                        }
                    }
                }
                LoadAction::Follower { points } => {
                    for p in points {
                        let own = &mut self.loads[model.element_at(p.point.node)];
                        let force = turned(scale(*factor, p.force), tangent(&p.point));
                        p.point.spread_over(force, own);
                    }
                }
            }
        }
    }

    /// Reactions of foundations by element.
    fn found(&mut self, model: &Model, acting: &Acting) {
        let Acting { state, increment, rule, forcing, .. } = *acting;
        for foundation in &model.foundations {
            for i in foundation.connectors.clone() {
                let connector = &model.connectors[i];
                let step = connector.step(i, rule, forcing, state, increment);
                for (end, (point, _)) in connector.attachments() {
                    let own = &mut self.loads[model.element_at(point.node)];
                    point.spread_over(scale(-step.force, step.forms[end]), own);
                }
            }
        }
    }

    /// Forces of given strains by element: they are a part of its section forces.
    fn strain(&mut self, model: &Model, acting: &Acting) {
        let Acting { state, increment, rule, forcing, .. } = *acting;
        if state.strained.is_empty() {
            return;
        }
        self.given.clear();
        self.given.resize(model.element_count(), [[0.0; 4]; 2]);
        let (at, by) = ((state, increment), (rule, &forcing.factors[..]));
        given_strains::on_nodes(model, at, by, &mut self.given);
    }

    /// Inertia and weight of masses inside elements, as forces on the beam.
    fn weigh(&mut self, model: &Model, acting: &Acting) {
        let Acting { state, increment, rule, forcing, .. } = *acting;
        for (i, mass) in model.masses.iter().enumerate() {
            let p = &mass.point;
            if is_at_node(p) {
                continue;
            }
            let inertia = masses::inertia(mass, state, rule, forcing.gravity, increment);
            let turning = masses::turning(mass, state, i, rule, increment);
            let mut on_nodes = [[0.0; 4]; 2];
            let force = scale(-1.0, inertia);
            p.spread_over(force, &mut on_nodes);
            if let Some(couple) = turning {
                p.spread_gradient_over(scale(-1.0, couple), &mut on_nodes);
            }
            let (element, xi) = (model.element_at(p.node), share_of(model, p));
            let has_couple = turning.is_some();
            self.inner.push(Inner { element, xi, force, couple: 0.0, has_couple, on_nodes });
        }
    }

    /// A force and a moment at a point; what acts at a node concerns no element.
    fn act(&mut self, model: &Model, p: &MaterialPoint, force: [f64; 2], moment: f64, g: [f64; 2]) {
        if let Some(mut inner) = inner_of(model, p, force) {
            let gradient = scale(moment / dot(g, g), [-g[1], g[0]]);
            p.spread_gradient_over(gradient, &mut inner.on_nodes);
            inner.has_couple = moment != 0.0;
            self.inner.push(inner);
        }
    }

    /// A contact along its forms: inside the one element of a beam that it touches. Where a closest point has left one element for
    /// another within the step, its force counts at the nodes.
    fn push(&mut self, model: &Model, [normal, tangent]: [&Row; 2], forces: [f64; 2]) {
        if forces == [0.0; 2] {
            return;
        }
        let beams = model.beam_node_count();
        let has = |node: usize| normal.iter().any(|(n, _)| n == node);
        for (a, c) in normal.iter().filter(|(n, _)| *n + 1 < beams) {
            let (span, k) = model.element_of(a);
            let inside = a + 1 < span.nodes.end && has(a + 1);
            let more = (k > 0 && has(a - 1)) || (a + 2 < span.nodes.end && has(a + 2));
            if !inside || more {
                continue;
            }
            let d = normal.at(a + 1);
            let (on_a, on_b) = ([c[0], c[1]], [d[0], d[1]]);
            let whole = add(on_a, on_b);
            let share = dot(on_b, whole) / dot(whole, whole);
            if !(SAME_PLACE..=1.0 - SAME_PLACE).contains(&share) {
                continue;
            }
            let on = |n: usize| {
                let (c, t) = (normal.at(n), tangent.at(n));
                std::array::from_fn(|i| forces[0] * c[i] + forces[1] * t[i])
            };
            let on_nodes = [on(a), on(a + 1)];
            let (force, element) = (resultant(&on_nodes), span.elements.start + k);
            let xi = match span.shear {
                Some(_) => span.inside(k).place_of(share),
                None => place_of(share),
            };
            let has_couple = forces[1] != 0.0;
            self.inner.push(Inner { element, xi, force, couple: 0.0, has_couple, on_nodes });
        }
    }
}

/// A force at a point; what acts at a node concerns no element.
pub(super) fn inner_of(model: &Model, p: &MaterialPoint, force: [f64; 2]) -> Option<Inner> {
    if is_at_node(p) {
        return None;
    }
    let mut on_nodes = [[0.0; 4]; 2];
    p.spread_over(force, &mut on_nodes);
    let (element, xi) = (model.element_at(p.node), share_of(model, p));
    Some(Inner { element, xi, force, couple: 0.0, has_couple: false, on_nodes })
}

/// Share of its element at which a point is.
fn share_of(model: &Model, p: &MaterialPoint) -> f64 {
    let (span, _) = model.element_of(p.node);
    if span.shear.is_some() { p.xi } else { place_of(p.shape[2]) }
}

/// Forces of a load on the positions of both nodes of a shear-flexible element that do its work on linear motions: in the field inside it the
/// cubic part has opposite coefficients of the positions, and those of both vectors d have its sum over the length.
fn linear_shares(load: &OnNodes, length: f64) -> OnNodes {
    let mut out = *load;
    for i in 0..2 {
        let cubic = (load[0][2 + i] + load[1][2 + i]) / length;
        (out[0][i], out[1][i]) = (load[0][i] - cubic, load[1][i] + cubic);
    }
    out
}

/// Whether a point is a node: what acts there concerns no element.
fn is_at_node(p: &MaterialPoint) -> bool {
    p.shape[2] == 0.0 || p.shape[2] == 1.0
}

pub(super) fn take(from: &mut OnNodes, what: &OnNodes) {
    for (from, what) in from.iter_mut().zip(what) {
        (0..4).for_each(|i| from[i] -= what[i]);
    }
}
