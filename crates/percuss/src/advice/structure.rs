//! What hand formulas need to know of a beam: its constants, its ends, what disturbs it.

use super::formulas::{Span, SpanKind, UniformBeam, free_bar_mass};
use crate::element::beam::ElementTable;
use crate::math::vec2::{cross, dot, rot90, sub};
use crate::model::frozen::{BeamData, Coordinate, LoadAction, LoadData, MaterialPoint, Place};
use crate::model::{Model, StrainMeasure};

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
    pub beam: &'a BeamData,
    /// Index of the beam.
    pub index: usize,
    /// Arc length of the place \[m\].
    pub s: f64,
}

impl<'a> BeamPlace<'a> {
    /// The place at arc length `s` of beam number `index`.
    pub fn new(model: &'a Model, index: usize, s: f64) -> Self {
        Self { model, beam: &model.beams[index], index, s }
    }

    /// Span that holds the place, and the number of the element in it.
    fn element(&self) -> (usize, usize) {
        let spans = self.beam.spans.clone();
        let last = spans.end - 1;
        let holds = |i: &usize| self.model.spans[*i].stations.last().is_some_and(|s| *s >= self.s);
        let i = spans.clone().find(holds).unwrap_or(last);
        let span = &self.model.spans[i];
        let k = span.stations.partition_point(|s| *s <= self.s).saturating_sub(1);
        (i, k.min(span.elements.len() - 1))
    }

    /// Length of the element at the place \[m\].
    pub fn element_length(&self) -> f64 {
        let (span, k) = self.element();
        self.model.spans[span].table(k).length
    }

    /// First node of the element at the place, and its shape functions there.
    pub fn interpolation(&self) -> (usize, [f64; 4]) {
        let (i, k) = self.element();
        let span = &self.model.spans[i];
        let length = span.table(k).length;
        let share = (self.s - span.stations[k]) / (span.stations[k + 1] - span.stations[k]);
        (span.nodes.start + k, crate::math::hermite::shape(share.clamp(0.0, 1.0), length))
    }

    /// Reference tangent at the place.
    pub fn tangent(&self) -> [f64; 2] {
        let (span, k) = self.element();
        self.model.spans[span].table(k).rows[1].tangent
    }

    /// Constants per length at the place.
    pub fn section(&self) -> UniformBeam {
        let (span, k) = self.element();
        let row = &self.model.spans[span].table(k).rows[1];
        let law = &row.section;
        UniformBeam { axial: law.axial, bending: law.bending, mass: row.mass, rotary: law.rotary }
    }

    /// Strain measure at the place.
    pub fn measure(&self) -> StrainMeasure {
        self.model.spans[self.element().0].measure
    }

    /// Young's modulus at the place \[Pa\].
    pub fn young(&self) -> f64 {
        let (span, k) = self.element();
        let row = &self.model.spans[span].table(k).rows[1];
        row.section.axial / row.area
    }

    /// Distance of the extreme fibres from the centre line \[m\]; NaN if unknown.
    pub fn half_depth(&self) -> f64 {
        let (span, k) = self.element();
        self.model.spans[span].table(k).rows[1].half_depth
    }

    /// Shortest time of a longitudinal wave through an element of the beam \[s\].
    pub fn shortest_transit(&self) -> f64 {
        self.transits().fold(f64::INFINITY, f64::min)
    }

    fn transits(&self) -> impl Iterator<Item = f64> {
        let spans = self.beam.spans.clone().map(|i| &self.model.spans[i]);
        let tables = spans.flat_map(|span| (0..span.elements.len()).map(|k| span.table(k)));
        let transit = |table: &ElementTable| {
            let row = &table.rows[1];
            table.length / (row.section.axial / row.mass).sqrt()
        };
        tables.map(transit)
    }

    /// Whether the beam is straight and has one section all along.
    pub fn is_uniform(&self) -> bool {
        let (section, tangent) = (self.section(), self.tangent());
        let alike = |a: f64, b: f64| (a - b).abs() <= 1e-9 * b.abs();
        self.beam.spans.clone().all(|i| {
            let span = &self.model.spans[i];
            (0..span.elements.len()).flat_map(|k| &span.table(k).rows).all(|row| {
                let law = &row.section;
                alike(law.axial, section.axial)
                    && alike(law.bending, section.bending)
                    && alike(row.mass, section.mass)
                    && alike(law.rotary, section.rotary)
                    && cross(row.tangent, tangent).abs() < 1e-9
                    && dot(row.tangent, tangent) > 0.0
            })
        })
    }

    /// Mass of the beam \[kg\].
    pub fn mass(&self) -> f64 {
        let spans = self.beam.spans.clone().map(|i| &self.model.spans[i]);
        spans
            .flat_map(|span| (0..span.elements.len()).flat_map(|k| &span.table(k).rows))
            .map(|row| row.weight * row.mass)
            .sum()
    }

    /// Distance along the beam to the nearest end, support, joint, connector or point mass \[m\]; infinite only for a beam without
    /// ends, of which there is none. A mass at the place itself belongs to the place.
    pub fn free_distance(&self) -> f64 {
        let own = |s: &f64| (s - self.s).abs() > SAME * self.beam.length;
        let ends = [0.0, self.beam.length];
        let masses = self.model.masses.iter().map(|m| &m.point);
        let masses = masses.filter(|p| p.beam == self.index).map(|p| p.s).filter(own);
        let held = self.model.holds.iter().filter_map(|hold| self.station(hold.node));
        let tied = self.tied_points().filter(|p| !self.is_seam(p)).map(|p| p.s);
        let others = held.chain(tied).chain(masses).chain(ends);
        others.map(|s| (s - self.s).abs()).fold(f64::INFINITY, f64::min)
    }

    /// Arc lengths at which supports, joints and connectors hold the beam.
    fn ties(&self) -> impl Iterator<Item = f64> {
        let held = self.model.holds.iter().filter_map(|hold| self.station(hold.node));
        let points = self.tied_points().map(|p| p.s);
        held.chain(points)
    }

    /// Points of the beam at which constraints and connectors act.
    fn tied_points(&self) -> impl Iterator<Item = &'a MaterialPoint> {
        let model = self.model;
        let constraints = model.constraints.iter().flat_map(|c| c.points());
        let connectors = model.connectors.iter().flat_map(|c| coordinate_points(&c.coordinate));
        let index = self.index;
        constraints.chain(connectors).filter(move |p| p.beam == index)
    }

    /// Whether nothing but spans of the beam itself, in one line, are tied at a point: where a mass or a load stands inside it.
    fn is_seam(&self, point: &MaterialPoint) -> bool {
        let here = |p: &MaterialPoint| {
            p.beam == self.index && (p.s - point.s).abs() <= SAME * self.beam.length
        };
        let inner = |points: &[MaterialPoint]| points.len() > 1 && points.iter().all(here);
        let mut tied = self.model.constraints.iter().map(|c| c.points());
        let mut springs =
            self.model.connectors.iter().flat_map(|c| coordinate_points(&c.coordinate));
        self.is_uniform()
            && tied.all(|points| !points.iter().any(here) || inner(points))
            && !springs.any(here)
    }

    /// Arc length of a node, if it is one of this beam.
    fn station(&self, node: usize) -> Option<f64> {
        if !self.beam.nodes.contains(&node) {
            return None;
        }
        let spans = self.beam.spans.clone().map(|i| &self.model.spans[i]);
        let mut found = spans.filter(|span| span.nodes.contains(&node));
        found.next().map(|span| span.stations[node - span.nodes.start])
    }

    /// Whether only supports at rest that last for ever, at nodes, hold the beam, and no mass sits on it.
    fn is_plain(&self) -> bool {
        let masses = self.model.masses.iter().filter(|m| m.point.beam == self.index).count();
        let lasts = |support: usize| {
            let support = &self.model.supports[support];
            support.until.is_infinite() && support.motion.is_none()
        };
        let holds = self.model.holds.iter().filter(|hold| self.station(hold.node).is_some());
        masses == 0
            && self.tied_points().next().is_none()
            && holds.filter_map(|hold| hold.support).all(lasts)
    }

    /// How the end at a node is held.
    fn end(&self, node: usize) -> End {
        let Some(hold) = self.model.hold_at(node) else { return End::Free };
        let across = rot90(self.tangent());
        // Share of a direction that the held ones span.
        let held = |direction: [f64; 4]| -> f64 {
            let along = |n: &[f64; 4]| (0..4).map(|i| n[i] * direction[i]).sum::<f64>();
            hold.normals.iter().map(|n| along(n).powi(2)).sum()
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
        let nodes = [self.beam.nodes.start, self.beam.nodes.end - 1];
        let held = |node: &usize| self.model.hold_at(*node).is_some();
        let inner = self.beam.nodes.start + 1..self.beam.nodes.end - 1;
        if !self.is_uniform() || !self.is_plain() || inner.into_iter().any(|n| held(&n)) {
            return None;
        }
        let near = |s: f64| (self.s - s).abs() < SAME * self.beam.length;
        let (middle, ends) = (near(0.5 * self.beam.length), nodes.map(|node| self.end(node)));
        let kind = match ends {
            [End::Pinned, End::Pinned] if middle => SpanKind::Pinned,
            [End::Clamped, End::Clamped] if middle => SpanKind::Clamped,
            [End::Clamped, End::Free] if near(self.beam.length) => SpanKind::Cantilever,
            [End::Free, End::Clamped] if near(0.0) => SpanKind::Cantilever,
            _ => return None,
        };
        let section = self.section();
        Some(Span { kind, length: self.beam.length, bending: section.bending, mass: section.mass })
    }

    /// Whether neither end can slide along the beam.
    pub fn is_held_lengthwise(&self) -> bool {
        let t = self.tangent();
        [self.beam.nodes.start, self.beam.nodes.end - 1].into_iter().all(|node| {
            let along = |n: &[f64; 4]| (n[0] * t[0] + n[1] * t[1]).powi(2);
            let held = self.model.hold_at(node);
            held.is_some_and(|h| h.normals.iter().map(along).sum::<f64>() > 1.0 - SAME)
        })
    }

    /// Mass with which the beam meets a blow across it at the place as one rigid piece \[kg\], if it is uniform, straight and held
    /// nowhere.
    pub fn free_mass(&self) -> Option<f64> {
        if !self.is_plain() || !self.is_uniform() || self.ties().next().is_some() {
            return None;
        }
        let (mass, section) = (self.mass(), self.section());
        let inertia = mass * self.beam.length.powi(2) / 12.0 + section.rotary * self.beam.length;
        Some(free_bar_mass(mass, inertia, self.s - 0.5 * self.beam.length))
    }
}

/// The material points of a coordinate.
pub fn coordinate_points(coordinate: &Coordinate) -> impl Iterator<Item = &MaterialPoint> {
    let points: [Option<&MaterialPoint>; 2] = match coordinate {
        Coordinate::Displacement { point, .. } => [Some(point), None],
        Coordinate::Distance { ends } => ends.each_ref().map(|end| match end {
            Place::Point(point) => Some(point),
            Place::Ground(_) => None,
        }),
        Coordinate::Angle { a, b, .. } => [Some(a), b.as_deref()],
    };
    points.into_iter().flatten()
}

/// Where and when what flies from `from` with `velocity` first meets the polygon of a beam's nodes: arc length \[m\] and time \[s\].
pub fn first_hit(
    model: &Model,
    beam: &BeamData,
    from: [f64; 2],
    velocity: [f64; 2],
) -> Option<[f64; 2]> {
    let mut best: Option<[f64; 2]> = None;
    for span in beam.spans.clone().map(|i| &model.spans[i]) {
        for k in 0..span.elements.len() {
            let [a, b] = [k, k + 1].map(|k| model.nodes[span.nodes.start + k].position);
            let (side, to) = (sub(b, a), sub(a, from));
            let turn = cross(velocity, side);
            let (time, share) = (cross(to, side) / turn, cross(to, velocity) / turn);
            let meets = time >= 0.0 && (-SAME..=1.0 + SAME).contains(&share);
            if meets && best.is_none_or(|[_, least]| time < least) {
                let s = span.stations[k] + share * (span.stations[k + 1] - span.stations[k]);
                best = Some([s.clamp(0.0, beam.length), time]);
            }
        }
    }
    best
}

/// Arc length of the place of a beam's polygon that is nearest to a position \[m\].
pub fn nearest(model: &Model, beam: &BeamData, position: [f64; 2]) -> f64 {
    let mut best = [f64::INFINITY, 0.0];
    for span in beam.spans.clone().map(|i| &model.spans[i]) {
        for k in 0..span.elements.len() {
            let [a, b] = [k, k + 1].map(|k| model.nodes[span.nodes.start + k].position);
            let (side, to) = (sub(b, a), sub(position, a));
            let share = (dot(to, side) / dot(side, side)).clamp(0.0, 1.0);
            let off = sub(to, side.map(|x| share * x));
            let s = span.stations[k] + share * (span.stations[k + 1] - span.stations[k]);
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
    for load in &model.loads {
        match &load.kind {
            LoadAction::Gravity { acceleration } if is_steady(load) => {
                sum = [0, 1].map(|i| sum[i] + acceleration[i]);
            }
            _ => others = true,
        }
    }
    (sum, others)
}

/// Whether a gravity load changes in time.
pub fn gravity_varies(model: &Model) -> bool {
    let falls = |load: &LoadData| matches!(load.kind, LoadAction::Gravity { .. });
    model.loads.iter().any(|load| falls(load) && !is_steady(load))
}

fn is_steady(load: &LoadData) -> bool {
    [0.0, 1e-3, 1.0, 1e3].iter().all(|t| load.factor(*t, 1e-6) == 1.0)
}
