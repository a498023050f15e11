//! Runs that an ensemble supports, and their shape: runs of one shape share lanes.

use super::constraints::unknown;

use super::ground_springs::GroundSpringNumbers;
use super::loads::dead_load;
use super::numbers::{GuideLaw, GuideNumbers, Numbers, SpanNumbers};
use percuss::internals::element::beam::ElementTable;
use percuss::internals::ledger::RoundOff;
use percuss::internals::model::frozen::{BodyKind, FibreShape, ProjectileData, SpanFibres};
use percuss::internals::settings::{ImpactResolution, MultipleImpacts, Scheme, Settings, Start};
use percuss::math::vec2::dot;
use percuss::{ContactForce, ImpactLaw, Model, Potential, StrainMeasure, TouchLaw};

/// Common properties of runs in lanes: all properties that are not numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct BatchShape {
    /// First node, number of elements and beam of every span, its measure, whether it is damped, shape (spans, 3)
    /// \[index of a node, number of elements, index of a beam\].
    spans: Vec<([usize; 3], StrainMeasure, bool)>,
    /// Whether each table samples membrane strains at nodes or at Gauss points, if it does, shape (spans, tables).
    sampled: Vec<Vec<Option<bool>>>,
    /// Layout of the fibres of every span with a fibre section, shape (spans).
    fibres: Vec<Option<FibreShape>>,
    /// Node, number of directions held, components, shape (nodes held, 4) \[index of a node, number of directions\].
    prescribed: Vec<(usize, usize, Option<[bool; 4]>)>,
    /// Whether each constraint is of slopes, and the nodes of its points, shape (constraints, points) \[index of a node\].
    constraints: Vec<(bool, Vec<usize>)>,
    /// Node of each spring to the ground, and whether it presses on one side only, shape (springs to the ground)
    /// \[index of a node\].
    springs: Vec<(usize, bool)>,
    /// Struck node and law of each guided projectile, and whether its contact is damped, shape (guided projectiles) \[index of a node\].
    pub guides: Vec<(usize, GuideLaw, bool)>,
    /// Nodes of each load, shape (loads, nodes of one) \[index of a node\].
    loads: Vec<Vec<usize>>,
    /// Node of each recorded point, shape (recorded points) \[index of a node\].
    points: Vec<usize>,
}

impl BatchShape {
    /// The shape of a set of numbers.
    pub fn of<S: Copy>(numbers: &Numbers<S>) -> Self {
        let sampled = |t: &ElementTable<S>| t.membrane.as_ref().map(|m| m.is_nodal);
        let of_span = |s: &SpanNumbers<S>| s.tables.iter().map(sampled).collect();
        Self {
            spans: (numbers.spans.iter())
                .map(|s| ([s.first, s.count, s.beam], s.measure, s.damped))
                .collect(),
            sampled: numbers.spans.iter().map(of_span).collect(),
            fibres: numbers
                .spans
                .iter()
                .map(|s| s.fibres.as_ref().map(SpanFibres::shape))
                .collect(),
            prescribed: (numbers.prescribed.iter())
                .map(|h| (h.node, h.normals.len(), h.components))
                .collect(),
            constraints: (numbers.constraints.iter())
                .map(|c| (c.kind.is_of_slopes(), c.points().iter().map(|p| p.node).collect()))
                .collect(),
            springs: numbers.springs.iter().map(|s| (s.point.node, s.law.is_one_sided())).collect(),
            guides: numbers.guides.iter().map(|g| (g.node, g.law, g.damped)).collect(),
            loads: numbers.loads.iter().map(|l| l.nodes.clone()).collect(),
            points: numbers.points.iter().map(|p| p.node).collect(),
        }
    }
}

/// The numbers of a run, or the property that ensembles do not support. Supported are beams with and without material damping, fixed and elastic
/// supports, stops, hinged and rigid joints, guided projectiles and dead loads.
pub fn numbers(model: &Model, settings: &Settings) -> Result<Numbers<f64>, &'static str> {
    for (found, what) in [
        (settings.scheme != Scheme::EnergyMomentum, "a scheme other than energy-momentum"),
        (
            settings.multiple_impacts == MultipleImpacts::Sequential && model.contacts.len() > 1,
            "impacts one after another",
        ),
        (model.has_shear(), "shear-flexible beams"),
        (!model.foundations.is_empty(), "foundations along beams"),
        (model.memory_count() > 0, "springs or joints that yield"),
        (settings.accuracy.is_some(), "an accuracy in place of a step"),
        (settings.start != Start::Reference, "a start in static equilibrium"),
        (!model.is_still(), "beams that move at the start"),
        (!model.masses.is_empty(), "point masses"),
        (!model.motions.is_empty(), "prescribed motions"),
        (!model.modal_damping.is_empty(), "modal damping"),
        (!model.obstacles.is_empty(), "obstacles"),
        (model.bodies.iter().any(|b| b.kind != BodyKind::Guided), "discs and rear masses"),
        (model.contacts.len() != model.projectiles.len(), "contacts that move along a beam"),
    ] {
        if found {
            return Err(what);
        }
    }
    if let Some(what) = model.constraints.iter().find_map(unknown) {
        return Err(what);
    }
    let springs = model.connectors.iter().map(GroundSpringNumbers::of);
    let springs = springs.collect::<Result<Vec<_>, _>>()?;
    let guides = model.projectiles.iter().enumerate().map(|(i, p)| guide(model, settings, i, p));
    let guides = guides.collect::<Result<Vec<_>, _>>()?;
    let loads = model.loads.iter().map(|load| dead_load(model, &load.kind));
    let loads = loads.collect::<Result<Vec<_>, _>>()?;
    let beams = &model.nodes[..model.beam_node_count()];
    Ok(Numbers {
        step: settings.step,
        spans: (model.spans.iter())
            .map(|s| SpanNumbers {
                first: s.nodes.start,
                count: s.elements.len(),
                beam: model.beams.partition_point(|beam| beam.nodes.end <= s.nodes.start),
                measure: s.measure,
                retardation: s.retardation,
                mass_damping: s.mass_damping,
                damped: s.is_damped(),
                tables: s.tables.clone(),
                fibres: s.fibres.clone(),
            })
            .collect(),
        nodes: (beams.iter())
            .map(|n| [n.position[0], n.position[1], n.tangent[0], n.tangent[1]])
            .collect(),
        prescribed: (model.prescribed.iter()).filter(|h| h.node < beams.len()).cloned().collect(),
        constraints: model.constraints.clone(),
        springs,
        guides,
        loads,
        points: model.points.clone(),
        round_off: RoundOff::new(model, settings.step),
        total_mass: model.total_mass,
        size: model.extent(),
    })
}

fn guide(
    model: &Model,
    settings: &Settings,
    i: usize,
    projectile: &ProjectileData,
) -> Result<GuideNumbers<f64>, &'static str> {
    let (law, stiffness, restitution, dissipation) = match &model.contacts[i].law {
        TouchLaw::Smooth(law) => {
            if law.force != ContactForce::Conserving {
                return Err("a contact force other than the conserving one");
            }
            if law.unloading.is_some() {
                return Err("a contact that crushes");
            }
            match law.potential {
                Potential::Linear { stiffness } => {
                    (GuideLaw::Linear, stiffness, 0.0, law.dissipation)
                }
                Potential::Hertz { stiffness } => {
                    (GuideLaw::Hertz, stiffness, 0.0, law.dissipation)
                }
                _ => return Err("a contact law given by a table or a function"),
            }
        }
        TouchLaw::Rigid(law) => {
            if settings.impacts != ImpactResolution::Event {
                return Err("impacts by time-stepping");
            }
            if law.impact != ImpactLaw::Newton {
                return Err("an impact law other than Newton's");
            }
            (GuideLaw::Rigid, 0.0, law.restitution, 0.0)
        }
    };
    let (body, point) = (&model.bodies[projectile.body], &projectile.point);
    let contact = &model.pairs[model.contacts[i].pairs.start];
    let percuss::internals::geometry::pair::Target::Guided { standoff, .. } = contact.target else {
        return Err("contacts that move along a beam");
    };
    Ok(GuideNumbers {
        node: point.node,
        law,
        shape: point.shape,
        struck: point.position,
        position: model.nodes[model.body_node(projectile.body)].position,
        direction: projectile.direction,
        standoff,
        mass: body.mass,
        speed: dot(projectile.direction, body.velocity),
        stiffness,
        restitution,
        dissipation,
        damped: dissipation != 0.0,
    })
}
