//! Foundations along beams, as springs to the ground at the Gauss points of the elements.
//!
//! The potential per length is integrated with the three-point rule of an element, through its shape functions: each point has a spring of the law
//! times the length that it stands for. The forces over a step are the difference quotients of these potentials, as of any spring to the ground.

use super::builder::ModelBuilder;
use super::definition::*;
use super::frozen::*;
use super::material_points::point_at;
use crate::element::fibre::{PlasticLaw, Slack, StressLaw};
use crate::math::hermite::{GAUSS_WEIGHTS, gauss_points};
use crate::math::vec2::{norm, rot90, scale};

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

impl Model {
    /// Springs and dampers that are not parts of foundations, in the model's order.
    pub(crate) fn single_connectors(&self) -> impl Iterator<Item = &Connector> {
        self.connectors.iter().filter(|c| c.foundation.is_none())
    }
}
