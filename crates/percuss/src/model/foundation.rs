//! Foundations along beams, as springs to the ground at the Gauss points of the elements.
//!
//! The potential per length is integrated with the three-point rule of an element, through its shape functions: each point has a spring of the law
//! times the length that it stands for. The forces over a step are the difference quotients of these potentials, as of any spring to the ground.

use std::ops::Range;

use super::builder::ModelBuilder;
use super::definition::*;
use super::frozen::*;
use super::material_points::point_at;
use crate::element::fibre::{FibreState, PlasticLaw, Slack, StressLaw};
use crate::math::hermite::{GAUSS_WEIGHTS, gauss_points};
use crate::math::vec2::{norm, rot90, scale};

/// A foundation: which of the connectors are its springs.
#[derive(Clone, Debug)]
pub struct FoundationData {
    pub name: String,
    pub beam: usize,
    /// Arc lengths of its ends, shape (2) \[m\].
    pub stretch: [f64; 2],
    /// Its springs among the connectors of the model.
    pub connectors: Range<usize>,
    /// Length that each of its springs stands for, shape (springs) \[m\].
    pub lengths: Vec<f64>,
    /// Its law as given.
    pub law: FoundationLaw,
    /// Whether it can yield.
    pub yields: bool,
}

/// Adds the foundations' springs, behind all other connectors.
pub(super) fn place(builder: &ModelBuilder, model: &mut Model) {
    for foundation in &builder.foundations {
        let beam = foundation.beam.0 as usize;
        let ends = foundation.stretch.map(|along| match along {
            Along::Fraction(f) => f * model.beams[beam].length,
            Along::Distance(s) => s,
        });
        let first = model.connectors.len();
        let mut lengths = Vec::new();
        for (s, length) in quadrature(model, beam, ends) {
            let connector = spring(model, foundation, point_at(model, beam, s), length);
            model.connectors.push(connector);
            lengths.push(length);
        }
        model.foundations.push(FoundationData {
            name: foundation.name.clone(),
            beam,
            stretch: ends,
            connectors: first..model.connectors.len(),
            lengths,
            law: foundation.law.clone(),
            yields: foundation.yielding.is_some(),
        });
    }
}

/// Arc lengths of the Gauss points of the elements in a stretch, and the length that each stands for \[m\]; elements begin and end at the ends of
/// the stretch, where [`super::places`] requires nodes.
fn quadrature(model: &Model, beam: usize, [from, to]: [f64; 2]) -> Vec<(f64, f64)> {
    let beam = &model.beams[beam];
    let mut out = Vec::new();
    for span in &model.spans[beam.spans.clone()] {
        for w in span.stations.windows(2) {
            let (a, b) = (w[0].max(from), w[1].min(to));
            if b - a <= 1e-12 * beam.length {
                continue;
            }
            let point = |(x, weight)| (a + x * (b - a), weight * (b - a));
            out.extend(gauss_points().into_iter().zip(GAUSS_WEIGHTS).map(point));
        }
    }
    out
}

/// The spring of a place that stands for a length; its coordinate is the deflection into the foundation.
fn spring(model: &Model, given: &Foundation, point: MaterialPoint, length: f64) -> Connector {
    let push = given.direction.unwrap_or(rot90(point.tangent));
    let direction = scale(-1.0 / norm(push), push);
    let law = match &given.law {
        FoundationLaw::Linear { stiffness } => {
            ConnectorLaw::Linear { stiffness: stiffness * length, rest: 0.0 }
        }
        FoundationLaw::Compression { stiffness, gap } => ConnectorLaw::OneSided {
            stiffness: stiffness * length,
            gap: *gap,
            from: ActsFrom::Above,
        },
        FoundationLaw::Table { deflection, reaction } => {
            let force: Vec<f64> = reaction.iter().map(|p| p * length).collect();
            ConnectorLaw::Tabulated { table: ForceTable::new(deflection, &force), rest: 0.0 }
        }
    };
    let yielding = given.yielding.as_ref().map(|plasticity| YieldingLaw {
        name: format!("foundation.{}", given.name),
        law: Some(StressLaw::Plastic(PlasticLaw {
            young: given.law.stiffness() * length,
            plasticity: of_length(plasticity, length),
            // Deflections are positive in compression: it gapes where they are smaller than the plastic one.
            slack: matches!(given.law, FoundationLaw::Compression { .. })
                .then_some(Slack::Compression),
        })),
        strength: f64::INFINITY,
        sign: 1.0,
        memory: model.memory_count(),
    });
    Connector {
        coordinate: Coordinate::Displacement { point, direction, drive: Drive::default() },
        law,
        yielding,
        damping: given.damping * length,
        support: None,
        foundation: Some(model.foundations.len()),
        until: f64::INFINITY,
    }
}

/// A yield law per length for a given length.
fn of_length(law: &Plasticity, length: f64) -> Plasticity {
    let part = |part: &Hardening| Hardening {
        from: part.from,
        stress: part.stress * length,
        modulus: part.modulus * length,
    };
    Plasticity {
        curve: law.curve.iter().map(part).collect(),
        kinematic: law.kinematic * length,
        overstress: law.overstress,
        failure_strain: law.failure_strain,
    }
}

/// A place of a foundation in a state.
#[derive(Clone, Copy, Debug)]
pub struct FoundationPlace {
    /// Arc length from the start of the beam \[m\].
    pub s: f64,
    /// Length that it stands for \[m\].
    pub length: f64,
    /// Reaction per length, positive where it pushes the beam, without damping \[N/m\].
    pub pressure: f64,
    /// Force on the beam, shape (2) \[N\].
    pub force: [f64; 2],
    /// Energy stored in the length \[J\].
    pub stored: f64,
    /// Whether it reacts at all: a beam that has lifted off has no contact.
    pub acts: bool,
    /// Plastic deflection \[m\].
    pub plastic: f64,
    /// Energy that the length has dissipated by yielding, and that hardening has stored in it, shape (2) \[J\].
    pub flow: [f64; 2],
}

impl FoundationData {
    /// Its places in a state given by the connectors' coordinates and memories.
    pub fn places<'a>(
        &'a self,
        model: &'a Model,
        coordinates: &'a [f64],
        memories: &'a [FibreState],
    ) -> impl Iterator<Item = FoundationPlace> + 'a {
        self.connectors.clone().zip(&self.lengths).filter_map(move |(i, length)| {
            let (c, q) = (&model.connectors[i], coordinates[i]);
            let Coordinate::Displacement { point, direction, .. } = &c.coordinate else {
                return None;
            };
            let force = c.reached_force(q, memories) + 0.0;
            let memory = c.memory(memories).map(|(_, memory)| *memory).unwrap_or_default();
            let acts = match (&c.yielding, &self.law) {
                (_, FoundationLaw::Compression { .. }) => force > 0.0,
                _ => c.law.acts_at(q),
            };
            Some(FoundationPlace {
                s: point.s,
                length: *length,
                pressure: force / length,
                force: scale(-force, *direction),
                stored: c.potential(q, memories),
                acts,
                plastic: memory.plastic,
                flow: [memory.dissipated, c.hardening_energy(memories)],
            })
        })
    }
}

impl Model {
    /// Springs and dampers that are not parts of foundations, in the model's order.
    pub(crate) fn single_connectors(&self) -> impl Iterator<Item = &Connector> {
        self.connectors.iter().filter(|c| c.foundation.is_none())
    }
}
