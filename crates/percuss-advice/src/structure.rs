//! What hand formulas need to know of a beam: its constants, its ends, what disturbs it.

use super::formulas::{Span, SpanKind, UniformBeam, free_bar_mass};
use percuss::inspect::{
    BeamView, FoundationView, GaussPointView, LoadView, PointView, SectionConstants, SpanView,
};
use percuss::math::vec2::{cross, dot, rot90, sub};
use percuss::{Model, StrainMeasure};

/// Ends and places on a beam agree within this share of its length.
const SAME: f64 = 1e-6;

/// How an end of a beam is held across the beam and against turning.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum End {
    Free,
    Pinned,
    Clamped,
    Other,
}

/// A beam, and a place on it.
#[derive(Clone, Copy, Debug)]
pub struct BeamPlace<'a> {
    pub model: &'a Model,
    pub beam: BeamView<'a>,
    /// Index of the beam.
    pub index: usize,
    /// Arc length of the place \[m\].
    pub s: f64,
}

impl<'a> BeamPlace<'a> {
    /// Shear stiffness there \[N\]; of a shear-flexible beam alone, for which formulas of slender ones do not hold.
    pub fn shear_stiffness(&self) -> Option<f64> {
        self.beam.span_at(self.s).shear_stiffness_at(self.s)
    }

    /// The place at arc length `s` of beam number `index`.
    pub fn new(model: &'a Model, index: usize, s: f64) -> Self {
        Self { model, beam: model.beam(index), index, s }
    }

    /// Span that holds the place, and the number of the element in it.
    fn element(&self) -> (SpanView<'a>, usize) {
        let span = self.beam.span_at(self.s);
        let k = span.stations().partition_point(|s| *s <= self.s).saturating_sub(1);
        (span, k.min(span.element_count() - 1))
    }

    /// The beam in the middle of the element at the place.
    fn middle(&self) -> GaussPointView {
        let (span, k) = self.element();
        span.gauss_points(k)[1]
    }

    /// The section at the place.
    fn here(&self) -> SectionConstants {
        self.element().0.section_at(self.s)
    }

    /// The place in the middle of beam number `index`, however many elements it has.
    pub fn in_the_middle(model: &'a Model, index: usize) -> Self {
        Self::new(model, index, 0.5 * model.beam(index).length())
    }

    /// Position in the reference configuration \[m\]; between nodes that of the chord.
    pub fn position(&self) -> [f64; 2] {
        let (span, k) = self.element();
        let [a, b] = [k, k + 1].map(|k| self.model.node_position(span.nodes().start + k));
        let [from, to] = [k, k + 1].map(|k| span.stations()[k]);
        let share = ((self.s - from) / (to - from)).clamp(0.0, 1.0);
        [0, 1].map(|i| a[i] + share * (b[i] - a[i]))
    }

    /// Length of the element at the place, of short ones at plastic hinges that of the longest next to them \[m\].
    pub fn element_length(&self) -> f64 {
        let (span, k) = self.element();
        let (first, last) = (k.saturating_sub(2), (k + 1).min(span.element_count() - 1));
        let hinges = self.beam.hinge_places();
        let is_short = |k: usize| hinges.iter().any(|s| span.stations()[k..=k + 1].contains(s));
        match is_short(k) {
            true => (first..=last).map(|k| span.element_length(k)).fold(0.0, f64::max),
            false => span.element_length(k),
        }
    }

    /// First node of the element at the place, and its shape functions there.
    pub fn interpolation(&self) -> (usize, [f64; 4]) {
        let (span, k) = self.element();
        let stations = span.stations();
        let share = (self.s - stations[k]) / (stations[k + 1] - stations[k]);
        (span.nodes().start + k, span.interpolation(k, share.clamp(0.0, 1.0)))
    }

    /// Reference tangent at the place.
    pub fn tangent(&self) -> [f64; 2] {
        self.middle().tangent
    }

    /// Constants per length at the place.
    pub fn section(&self) -> UniformBeam {
        let here = self.here();
        UniformBeam {
            axial: here.axial,
            bending: here.bending,
            mass: here.mass,
            rotary: here.rotary,
        }
    }

    /// Strain measure at the place.
    pub fn measure(&self) -> StrainMeasure {
        self.element().0.measure()
    }

    /// Young's modulus at the place \[Pa\].
    pub fn young(&self) -> f64 {
        self.here().young
    }

    /// Distance of the extreme fibres from the centre line \[m\]; NaN if unknown.
    pub fn half_depth(&self) -> f64 {
        self.here().half_depth
    }

    /// Shortest time of a longitudinal wave through an element of the beam \[s\].
    pub fn shortest_transit(&self) -> f64 {
        self.transits().fold(f64::INFINITY, f64::min)
    }

    /// Those of all elements but short ones at plastic hinges.
    fn transits(&self) -> impl Iterator<Item = f64> {
        let mean =
            self.beam.length() / self.beam.spans().map(|s| s.element_count()).sum::<usize>() as f64;
        let hinges = self.beam.hinge_places();
        let is_short = move |span: &SpanView<'a>, k: usize| {
            let at = |s: &f64| span.stations()[k..=k + 1].contains(s);
            span.element_length(k) < 0.5 * mean && hinges.iter().any(at)
        };
        let each = move |span: SpanView<'a>| {
            (0..span.element_count()).filter(move |k| !is_short(&span, *k)).map(move |k| (span, k))
        };
        self.beam.spans().flat_map(each).map(|(span, k)| {
            let section = span.gauss_points(k)[1].section;
            span.element_length(k) / (section.axial / section.mass).sqrt()
        })
    }

    /// Whether the beam is straight and has one section all along.
    pub fn is_uniform(&self) -> bool {
        let (section, tangent) = (self.section(), self.tangent());
        let alike = |a: f64, b: f64| (a - b).abs() <= 1e-9 * b.abs();
        self.gauss_points().all(|point| {
            let own = point.section;
            alike(own.axial, section.axial)
                && alike(own.bending, section.bending)
                && alike(own.mass, section.mass)
                && alike(own.rotary, section.rotary)
                && cross(point.tangent, tangent).abs() < 1e-9
                && dot(point.tangent, tangent) > 0.0
        })
    }

    /// Mass of the beam \[kg\].
    pub fn mass(&self) -> f64 {
        self.gauss_points().map(|point| point.weight * point.section.mass).sum()
    }

    /// The beam at the Gauss points of all its elements.
    fn gauss_points(&self) -> impl Iterator<Item = GaussPointView> {
        let each =
            |span: SpanView<'a>| (0..span.element_count()).flat_map(move |k| span.gauss_points(k));
        self.beam.spans().flat_map(each)
    }

    /// Distance along the beam to the nearest end, support, joint, connector, foundation or point mass \[m\]; infinite only for a beam without
    /// ends, of which there is none. A mass at the place itself belongs to the place.
    pub fn free_distance(&self) -> f64 {
        let own = |s: &f64| (s - self.s).abs() > SAME * self.beam.length();
        let ends = [0.0, self.beam.length()];
        let masses = self.model.point_masses().map(|m| m.point);
        let masses = masses.filter(|p| p.beam == self.index).map(|p| p.s).filter(own);
        let held = self.model.prescribed().filter_map(|dofs| self.station(dofs.node));
        let tied = self.tied_points().filter(|p| !self.is_seam(p)).map(|p| p.s);
        let others = held.chain(tied).chain(masses).chain(ends);
        let nearest = others.map(|s| (s - self.s).abs()).fold(f64::INFINITY, f64::min);
        let founded = self.foundations().map(|foundation| {
            let [from, to] = foundation.stretch();
            (from - self.s).max(self.s - to).max(0.0)
        });
        founded.fold(nearest, f64::min)
    }

    /// Foundations of the beam.
    fn foundations(&self) -> impl Iterator<Item = FoundationView<'a>> + use<'a> {
        let index = self.index;
        self.model.foundations().filter(move |foundation| foundation.beam() == index)
    }

    /// Arc lengths at which supports, joints and connectors hold the beam.
    fn ties(&self) -> impl Iterator<Item = f64> {
        let held = self.model.prescribed().filter_map(|dofs| self.station(dofs.node));
        let points = self.tied_points().map(|p| p.s);
        held.chain(points)
    }

    /// Longest distance between neighbours among its ends and the places where something holds it \[m\].
    pub fn longest_stretch(&self) -> f64 {
        let mut places: Vec<f64> = self.ties().chain([0.0, self.beam.length()]).collect();
        places.sort_by(f64::total_cmp);
        places.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max)
    }

    /// Points of the beam at which constraints and connectors act.
    fn tied_points(&self) -> impl Iterator<Item = PointView<'a>> + use<'a> {
        let model = self.model;
        let constraints = model.constraints().flat_map(|c| c.points());
        let connectors = model.connectors().flat_map(|c| c.points());
        let index = self.index;
        constraints.chain(connectors).filter(move |p| p.beam == index)
    }

    /// Whether nothing but spans of the beam itself, in one line, are tied at a point: where a mass or a load stands inside it.
    fn is_seam(&self, point: &PointView<'_>) -> bool {
        let here = |p: PointView<'_>| {
            p.beam == self.index && (p.s - point.s).abs() <= SAME * self.beam.length()
        };
        let mut tied = self.model.constraints();
        let mut springs = self.model.connectors().flat_map(|c| c.points());
        self.is_uniform()
            && tied.all(|one| {
                !one.points().any(here) || one.points().len() > 1 && one.points().all(here)
            })
            && !springs.any(here)
    }

    /// Arc length of a node, if it is one of this beam.
    fn station(&self, node: usize) -> Option<f64> {
        let found = self.beam.span_of(node);
        found.map(|span| span.stations()[node - span.nodes().start])
    }

    /// Whether only supports at rest that last for ever, at nodes, hold the beam, and no mass sits on it.
    fn is_plain(&self) -> bool {
        let masses = self.model.point_masses().filter(|m| m.point.beam == self.index).count();
        let lasts = |support: usize| {
            let support = self.model.supports().nth(support);
            support.is_some_and(|support| support.until.is_infinite() && !support.moves)
        };
        let mut holds = self.model.prescribed().filter(|dofs| self.station(dofs.node).is_some());
        masses == 0
            && self.foundations().next().is_none()
            && self.tied_points().next().is_none()
            && holds.all(|dofs| dofs.support.is_none_or(lasts))
    }

    /// First and last node.
    fn end_nodes(&self) -> [usize; 2] {
        let nodes = self.beam.nodes();
        [nodes.start, nodes.end - 1]
    }

    /// How the end at a node is held.
    fn end(&self, node: usize) -> End {
        let Some(hold) = self.model.prescribed_at(node) else { return End::Free };
        let across = rot90(self.tangent());
        // Share of a direction that the held ones span.
        let held = |direction: [f64; 4]| -> f64 {
            let along = |n: &[f64; 4]| (0..4).map(|i| n[i] * direction[i]).sum::<f64>();
            hold.directions.iter().map(|n| along(n).powi(2)).sum()
        };
        let place = held([across[0], across[1], 0.0, 0.0]);
        let turn = held([0.0, 0.0, across[0], across[1]]);
        match (place > 1.0 - SAME, turn > 1.0 - SAME) {
            (true, true) => End::Clamped,
            (true, false) if turn < SAME => End::Pinned,
            (false, false) if place < SAME && turn < SAME => End::Free,
            _ => End::Other,
        }
    }

    /// The span of which hand formulas know the struck point: uniform and straight, held at its ends alone, and the place in its
    /// middle, or at the tip of a cantilever.
    pub fn span(&self) -> Option<Span> {
        let nodes = self.end_nodes();
        let held = |node: &usize| self.model.prescribed_at(*node).is_some();
        let inner = nodes[0] + 1..nodes[1];
        if !self.is_uniform() || !self.is_plain() || inner.into_iter().any(|n| held(&n)) {
            return None;
        }
        let near = |s: f64| (self.s - s).abs() < SAME * self.beam.length();
        let (middle, ends) = (near(0.5 * self.beam.length()), nodes.map(|node| self.end(node)));
        let kind = match ends {
            [End::Pinned, End::Pinned] if middle => SpanKind::Pinned,
            [End::Clamped, End::Clamped] if middle => SpanKind::Clamped,
            [End::Clamped, End::Free] if near(self.beam.length()) => SpanKind::Cantilever,
            [End::Free, End::Clamped] if near(0.0) => SpanKind::Cantilever,
            _ => return None,
        };
        let section = self.section();
        Some(Span {
            kind,
            length: self.beam.length(),
            bending: section.bending,
            mass: section.mass,
        })
    }

    /// Whether neither end can slide along the beam.
    pub fn is_held_lengthwise(&self) -> bool {
        let t = self.tangent();
        self.end_nodes().into_iter().all(|node| {
            let along = |n: &[f64; 4]| (n[0] * t[0] + n[1] * t[1]).powi(2);
            let held = self.model.prescribed_at(node);
            held.is_some_and(|h| h.directions.iter().map(along).sum::<f64>() > 1.0 - SAME)
        })
    }

    /// Mass with which the beam meets an impact across it at the place as one rigid piece \[kg\], if it is uniform, straight and held
    /// nowhere.
    pub fn free_mass(&self) -> Option<f64> {
        if !self.is_plain() || !self.is_uniform() || self.ties().next().is_some() {
            return None;
        }
        let (mass, section) = (self.mass(), self.section());
        let inertia =
            mass * self.beam.length().powi(2) / 12.0 + section.rotary * self.beam.length();
        Some(free_bar_mass(mass, inertia, self.s - 0.5 * self.beam.length()))
    }
}

/// Where and when what flies from `from` with `velocity` first meets the polygon of a beam's nodes: arc length \[m\] and time \[s\].
pub fn first_hit(
    model: &Model,
    beam: BeamView<'_>,
    from: [f64; 2],
    velocity: [f64; 2],
) -> Option<[f64; 2]> {
    let mut best: Option<[f64; 2]> = None;
    for span in beam.spans() {
        let stations = span.stations();
        for k in 0..span.element_count() {
            let [a, b] = [k, k + 1].map(|k| model.node_position(span.nodes().start + k));
            let (side, to) = (sub(b, a), sub(a, from));
            let turn = cross(velocity, side);
            let (time, share) = (cross(to, side) / turn, cross(to, velocity) / turn);
            let meets = time >= 0.0 && (-SAME..=1.0 + SAME).contains(&share);
            if meets && best.is_none_or(|[_, least]| time < least) {
                let s = stations[k] + share * (stations[k + 1] - stations[k]);
                best = Some([s.clamp(0.0, beam.length()), time]);
            }
        }
    }
    best
}

/// Arc length of the place of a beam's polygon that is nearest to a position \[m\].
pub fn nearest(model: &Model, beam: BeamView<'_>, position: [f64; 2]) -> f64 {
    let mut best = [f64::INFINITY, 0.0];
    for span in beam.spans() {
        let stations = span.stations();
        for k in 0..span.element_count() {
            let [a, b] = [k, k + 1].map(|k| model.node_position(span.nodes().start + k));
            let (side, to) = (sub(b, a), sub(position, a));
            let share = (dot(to, side) / dot(side, side)).clamp(0.0, 1.0);
            let off = sub(to, side.map(|x| share * x));
            let s = stations[k] + share * (stations[k + 1] - stations[k]);
            if dot(off, off) < best[0] {
                best = [dot(off, off), s];
            }
        }
    }
    best[1]
}

/// Acceleration by gravity loads that act unchanged from the start for ever \[m/s^2\], and whether there are other loads.
pub fn gravity(model: &Model) -> ([f64; 2], bool) {
    let (mut sum, mut others) = ([0.0; 2], false);
    for load in model.loads() {
        match load.gravity() {
            Some(acceleration) if is_steady(&load) => {
                sum = [0, 1].map(|i| sum[i] + acceleration[i]);
            }
            _ => others = true,
        }
    }
    (sum, others)
}

/// Whether a gravity load changes in time.
pub fn gravity_varies(model: &Model) -> bool {
    model.loads().any(|load| load.gravity().is_some() && !is_steady(&load))
}

fn is_steady(load: &LoadView<'_>) -> bool {
    [0.0, 1e-3, 1.0, 1e3].iter().all(|t| load.factor(*t, 1e-6) == 1.0)
}
