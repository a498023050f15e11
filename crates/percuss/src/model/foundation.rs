//! Foundations along beams, as springs to the ground at the Gauss points of the elements.
//!
//! The potential per length is integrated with the three-point rule of an element, through its shape functions: each point has a spring of the law
//! times the length that it stands for. The forces over a step are the difference quotients of these potentials, as of any spring to the ground.
//!
//! A reaction r per length deflects a shear-flexible element between its nodes by shear, beyond the field inside it, by `r l^2 / (12 kappa G A)` in
//! the mean. Its springs are in series with that: without it the error of the deflection under a point load would be of second order.

use super::builder::ModelBuilder;
use super::definition::*;
use super::frozen::*;
use super::material_points::point_at;
use crate::element::fibre::{PlasticLaw, Slack, StressLaw};
use crate::math::hermite::{GAUSS_WEIGHTS, gauss_points};
use crate::math::vec2::{cross, norm, rot90, scale};

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
        for (s, length, softness) in quadrature(model, beam, ends) {
            let point = point_at(model, beam, s);
            let connector = spring(model, foundation, point, [length, softness]);
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

/// Arc lengths of the Gauss points of the elements in a stretch, the length that each stands for \[m\], and the mean deflection between the nodes by
/// a load of one per length \[m^2/N\]; elements begin and end at the ends of the stretch, where [`super::places`] requires nodes.
fn quadrature(model: &Model, beam: usize, [from, to]: [f64; 2]) -> Vec<(f64, f64, f64)> {
    let beam = &model.beams[beam];
    let mut out = Vec::new();
    for span in &model.spans[beam.spans.clone()] {
        for (k, w) in span.stations.windows(2).enumerate() {
            let (a, b) = (w[0].max(from), w[1].min(to));
            if b - a <= 1e-12 * beam.length {
                continue;
            }
            let softness = match span.shear {
                Some(_) => (w[1] - w[0]).powi(2) / (12.0 * span.section_at(k, 0.5).shear),
                None => 0.0,
            };
            let point = |(x, weight)| (a + x * (b - a), weight * (b - a), softness);
            out.extend(gauss_points().into_iter().zip(GAUSS_WEIGHTS).map(point));
        }
    }
    out
}

/// The spring of a place that stands for a length, in an element of some softness across its axis; its coordinate is the deflection into the
/// foundation.
fn spring(
    model: &Model,
    given: &Foundation,
    point: MaterialPoint,
    [length, softness]: [f64; 2],
) -> Connector {
    let push = given.direction.unwrap_or(rot90(point.tangent));
    let direction = scale(-1.0 / norm(push), push);
    let softness = softness * cross(point.tangent, direction).powi(2);
    let law = match &softened(&given.law, softness) {
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
            young: softened(&given.law, softness).stiffness() * length,
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
        name: String::new(),
        coordinate: Coordinate::Displacement { point, direction, drive: Drive::default() },
        law,
        yielding,
        damping: given.damping * length,
        support: None,
        foundation: Some(model.foundations.len()),
        until: f64::INFINITY,
    }
}

/// A law in series with a softness: the same reaction at a deflection that is larger by that.
fn softened(law: &FoundationLaw, softness: f64) -> FoundationLaw {
    let soft = |stiffness: f64| stiffness / (1.0 + stiffness * softness);
    match law {
        FoundationLaw::Linear { stiffness } => {
            FoundationLaw::Linear { stiffness: soft(*stiffness) }
        }
        FoundationLaw::Compression { stiffness, gap } => {
            FoundationLaw::Compression { stiffness: soft(*stiffness), gap: *gap }
        }
        FoundationLaw::Table { deflection, reaction } => {
            let both = deflection.iter().zip(reaction);
            let moved: Vec<f64> = both.map(|(w, p)| w + softness * p).collect();
            // A reaction that falls more steeply than the element is stiff has no such law.
            let rises = moved.windows(2).all(|pair| pair[0] < pair[1]);
            let deflection = if rises { moved } else { deflection.clone() };
            FoundationLaw::Table { deflection, reaction: reaction.clone() }
        }
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
