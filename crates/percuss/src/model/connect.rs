//! Springs and dampers between points and to ground.

use super::builder::ModelBuilder;
use super::definition::*;
use super::frozen::*;
use super::material_points::locate;
use super::time_function::PreparedFunction;
use crate::element::fibre::{PlasticLaw, StressLaw};
use crate::math::vec2::{cross, dot, norm, rot90, scale, sub};

/// Adds the supports' names, their motions and their springs.
pub(super) fn supports(builder: &ModelBuilder, model: &mut Model) {
    for (index, support) in builder.supports.iter().enumerate() {
        let point = locate(model, &support.at);
        let motion = support.motion.as_ref().map(|motion| {
            model.motions.push(PreparedFunction::new(&motion.function));
            model.motions.len() - 1
        });
        let (name, until) = (support.name.clone(), support.until);
        let stops = matches!(support.kind, SupportKind::Stop { .. });
        model.supports.push(SupportData { name, point: Some(point.clone()), until, motion, stops });
        match support.kind {
            SupportKind::Elastic {
                direction,
                stiffness,
                damping,
                rotational_stiffness,
                rotational_damping,
            } => {
                let along = scale(1.0 / norm(direction), direction);
                for (axis, k, c) in
                    [(along, stiffness[0], damping[0]), (rot90(along), stiffness[1], damping[1])]
                {
                    let drive = drive_of(support, model, index, axis);
                    let coordinate =
                        Coordinate::Displacement { point: point.clone(), direction: axis, drive };
                    let law = ConnectorLaw::Linear { stiffness: k, rest: 0.0 };
                    push(model, coordinate, law, c, index, support);
                }
                let a = Box::new(point.clone());
                let coordinate = Coordinate::Angle { a, b: None, cosine: 1.0, sine: 0.0 };
                let law = ConnectorLaw::Linear { stiffness: rotational_stiffness, rest: 0.0 };
                push(model, coordinate, law, rotational_damping, index, support);
            }
            SupportKind::Stop { direction, gap, stiffness, two_sided } => {
                let along = scale(1.0 / norm(direction), direction);
                let sides = if two_sided { vec![1.0, -1.0] } else { vec![1.0] };
                for side in sides {
                    let direction = scale(side, along);
                    let drive = drive_of(support, model, index, direction);
                    let coordinate =
                        Coordinate::Displacement { point: point.clone(), direction, drive };
                    let law = ConnectorLaw::OneSided { stiffness, gap };
                    push(model, coordinate, law, 0.0, index, support);
                }
            }
            _ => {}
        }
    }
}

/// Prescribed displacement along `axis` of the support of number `index`.
pub(super) fn drive_of(support: &Support, model: &Model, index: usize, axis: [f64; 2]) -> Drive {
    let amplitude = support.motion.as_ref().map_or(0.0, |m| dot(m.displacement, axis));
    drive(model.supports[index].motion, amplitude)
}

/// An amplitude times a motion; zero without one.
pub(super) fn drive(motion: Option<usize>, amplitude: f64) -> Drive {
    motion.filter(|_| amplitude != 0.0).map(|m| (m, amplitude)).into_iter().collect()
}

fn push(
    model: &mut Model,
    coordinate: Coordinate,
    law: ConnectorLaw,
    damping: f64,
    index: usize,
    support: &Support,
) {
    if !matches!(law, ConnectorLaw::Linear { stiffness: 0.0, .. }) || damping > 0.0 {
        let (support, until) = (Some(index), support.until);
        let yielding = None;
        model.connectors.push(Connector { coordinate, law, yielding, damping, support, until });
    }
}

/// Adds springs between points, and those of elastic hinges.
pub(super) fn springs(builder: &ModelBuilder, model: &mut Model) {
    for spring in &builder.springs {
        let place = |anchor: &Anchor| match anchor {
            Anchor::Point(p) => ConnectorEnd::Point(locate(model, p)),
            Anchor::Ground(x) => ConnectorEnd::Ground(*x),
        };
        let ends = Box::new([place(&spring.between[0]), place(&spring.between[1])]);
        let distance = norm(sub(ends[0].reference(), ends[1].reference()));
        let rest = spring.length.unwrap_or(distance);
        let name = format!("spring.{}", spring.name);
        let yielding = yielding(model, name, spring.stiffness, (spring.yielding.as_ref(), 1.0));
        model.connectors.push(Connector {
            coordinate: Coordinate::Distance { ends },
            law: ConnectorLaw::Linear { stiffness: spring.stiffness, rest },
            yielding,
            damping: spring.damping,
            support: None,
            until: f64::INFINITY,
        });
    }
    for joint in &builder.joints {
        if let JointKind::ElasticHinge { stiffness, damping } = joint.kind {
            let [a, b] = joint.between.each_ref().map(|p| locate(model, p));
            let (cosine, sine) = (dot(b.tangent, a.tangent), cross(b.tangent, a.tangent));
            let sign = as_the_moment(model, [&a, &b]);
            let (a, b) = (Box::new(a), Some(Box::new(b)));
            let name = format!("joint.{}", joint.name);
            let yielding = yielding(model, name, stiffness, (joint.yielding.as_ref(), sign));
            model.connectors.push(Connector {
                coordinate: Coordinate::Angle { a, b, cosine, sine },
                law: ConnectorLaw::Linear { stiffness, rest: 0.0 },
                yielding,
                damping,
                support: None,
                until: f64::INFINITY,
            });
        }
    }
}

/// Sign of the rotation of the first point relative to the second that corresponds to a positive bending moment beside the hinge: in the first of
/// the two beams that begins or ends there.
fn as_the_moment(model: &Model, places: [&MaterialPoint; 2]) -> f64 {
    // Where a beam ends the way leads on into the other one, where it begins it comes from it.
    for (place, goes_on) in places.into_iter().zip([-1.0, 1.0]) {
        let length = model.beams[place.beam].length;
        if place.s <= AT_END * length {
            return -goes_on;
        }
        if place.s >= (1.0 - AT_END) * length {
            return goes_on;
        }
    }
    -1.0
}

/// Nearer to an end of a beam than this share of its length is there.
const AT_END: f64 = 1e-9;

/// Yield law of the next connector, as the law of a fibre, and the sign of its results.
fn yielding(
    model: &Model,
    name: String,
    stiffness: f64,
    (plasticity, sign): (Option<&Plasticity>, f64),
) -> Option<YieldingLaw> {
    let plasticity = plasticity?.clone();
    let law = StressLaw::Plastic(PlasticLaw { young: stiffness, plasticity, slack: None });
    Some(YieldingLaw { name, law, sign, memory: model.memory_count() })
}

impl Model {
    /// Number of connectors that can yield.
    #[doc(hidden)]
    pub fn memory_count(&self) -> usize {
        let last = self.connectors.iter().rev().find_map(|c| c.yielding.as_ref());
        last.map_or(0, |own| own.memory + 1)
    }

    /// Connectors that can yield, their number and how, in the model's order.
    pub(crate) fn yielding(&self) -> impl Iterator<Item = (usize, &Connector, &YieldingLaw)> {
        let each = self.connectors.iter().enumerate();
        each.filter_map(|(i, c)| c.yielding.as_ref().map(|own| (i, c, own)))
    }
}

impl Connector {
    /// Whether it acts on an angle.
    pub(crate) fn turns(&self) -> bool {
        matches!(self.coordinate, Coordinate::Angle { .. })
    }
}

impl ConnectorEnd {
    /// Position in the reference configuration \[m\].
    pub fn reference(&self) -> [f64; 2] {
        match self {
            Self::Point(p) => p.position,
            Self::Ground(x) => *x,
        }
    }
}
