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
        let rigid = !matches!(support.kind, SupportKind::Elastic { .. } | SupportKind::Stop { .. });
        let own = Some(point.clone());
        model.supports.push(SupportData { name, point: own, until, motion, stops, rigid });
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
                if two_sided && gap == 0.0 {
                    // One of both always acts: an elastic support, with that stiffness in modes and buckling, too.
                    let drive = drive_of(support, model, index, along);
                    let coordinate =
                        Coordinate::Displacement { point: point.clone(), direction: along, drive };
                    let law = ConnectorLaw::Linear { stiffness, rest: 0.0 };
                    push(model, coordinate, law, 0.0, index, support);
                    continue;
                }
                let sides: &[f64] = if two_sided { &[1.0, -1.0] } else { &[1.0] };
                for side in sides {
                    let direction = scale(*side, along);
                    let drive = drive_of(support, model, index, direction);
                    let coordinate =
                        Coordinate::Displacement { point: point.clone(), direction, drive };
                    let from = ActsFrom::Above;
                    let law = ConnectorLaw::OneSided { stiffness, gap, from };
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
        let yielding = None;
        model.connectors.push(Connector {
            name: support.name.clone(),
            coordinate,
            law,
            yielding,
            damping,
            support: Some(index),
            foundation: None,
            until: support.until,
        });
    }
}

/// Adds springs between points, and those of elastic hinges.
pub(super) fn springs(builder: &ModelBuilder, model: &mut Model) {
    for spring in &builder.springs {
        let place = |anchor: &Anchor| match anchor {
            Anchor::Point(p) => ConnectorEnd::Point(locate(model, p)),
            Anchor::Projectile(name) => ConnectorEnd::Body(centre(model, name)),
            Anchor::Ground(x) => ConnectorEnd::Ground(*x),
        };
        let ends = Box::new([place(&spring.between[0]), place(&spring.between[1])]);
        let distance = norm(sub(ends[0].reference(), ends[1].reference()));
        let rest = spring.length.unwrap_or(distance);
        let name = format!("spring.{}", spring.name);
        let law = match &spring.law {
            SpringLaw::Linear { stiffness } => ConnectorLaw::Linear { stiffness: *stiffness, rest },
            SpringLaw::Tension { stiffness, slack } => ConnectorLaw::OneSided {
                stiffness: *stiffness,
                gap: rest + slack,
                from: ActsFrom::Above,
            },
            SpringLaw::Compression { stiffness, gap } => ConnectorLaw::OneSided {
                stiffness: *stiffness,
                gap: rest - gap,
                from: ActsFrom::Below,
            },
            SpringLaw::Table { extension, force } => {
                ConnectorLaw::Tabulated { table: ForceTable::new(extension, force), rest }
            }
        };
        let flow = (spring.yielding.as_ref(), 1.0);
        let strength = spring.strength.unwrap_or(f64::INFINITY);
        let yielding = yielding(model, name, spring.law.stiffness(), flow, strength);
        model.connectors.push(Connector {
            name: spring.name.clone(),
            coordinate: Coordinate::Distance { ends },
            law,
            yielding,
            damping: spring.damping,
            support: None,
            foundation: None,
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
            let flow = (joint.yielding.as_ref(), sign);
            let yielding = yielding(model, name, stiffness, flow, f64::INFINITY);
            model.connectors.push(Connector {
                name: joint.name.clone(),
                coordinate: Coordinate::Angle { a, b, cosine, sine },
                law: ConnectorLaw::Linear { stiffness, rest: 0.0 },
                yielding,
                damping,
                support: None,
                foundation: None,
                until: f64::INFINITY,
            });
        }
    }
}

/// The centre of a body that strikes as a point of the mesh: the shape function of its node alone.
fn centre(model: &Model, name: &str) -> MaterialPoint {
    let own = |i: &usize| model.bodies[*i].name == name;
    let body = model.striking_bodies().find(own).unwrap_or_default();
    let own = model.body_node(body);
    let (node, shape) = match own.checked_sub(1) {
        Some(before) => (before, [0.0, 0.0, 1.0, 0.0]),
        None => (own, [1.0, 0.0, 0.0, 0.0]),
    };
    MaterialPoint {
        label: name.into(),
        beam: MaterialPoint::OF_BODY,
        node,
        xi: shape[2],
        s: f64::NAN,
        shape,
        slope: [0.0; 4],
        position: model.nodes[own].position,
        tangent: [0.0; 2],
        stretched: None,
    }
}

/// Sign of the rotation of the first point relative to the second that corresponds to a positive bending moment beside the hinge: in the first of
/// the two beams that begins or ends there.
fn as_the_moment(model: &Model, places: [&MaterialPoint; 2]) -> f64 {
    // At the end of a beam the path continues into the other one, at its start it comes from it.
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

/// A point closer to an end of a beam than this share of its length is at the end.
const AT_END: f64 = 1e-9;

/// Yield law of the next connector, as the law of a fibre, the sign of its results, and its strength.
fn yielding(
    model: &Model,
    name: String,
    stiffness: f64,
    (plasticity, sign): (Option<&Plasticity>, f64),
    strength: f64,
) -> Option<YieldingLaw> {
    let plastic =
        |plasticity| StressLaw::Plastic(PlasticLaw { young: stiffness, plasticity, slack: None });
    let law = plasticity.cloned().map(plastic);
    let memory = model.memory_count();
    (law.is_some() || strength < f64::INFINITY).then_some(YieldingLaw {
        name,
        law,
        strength,
        sign,
        memory,
    })
}

impl Model {
    /// Number of connectors that can yield or break.
    #[doc(hidden)]
    pub fn memory_count(&self) -> usize {
        let last = self.connectors.iter().rev().find_map(|c| c.yielding.as_ref());
        last.map_or(0, |own| own.memory + 1)
    }

    /// Springs and hinges that can yield or break, their number and how, in the model's order; those of foundations are not among them.
    pub(crate) fn yielding(&self) -> impl Iterator<Item = (usize, &Connector, &YieldingLaw)> {
        let each = self.connectors.iter().enumerate().filter(|(_, c)| c.foundation.is_none());
        each.filter_map(|(i, c)| c.yielding.as_ref().map(|own| (i, c, own)))
    }
}

impl Model {
    /// Whether any spring ends at a body.
    pub(crate) fn has_tied_bodies(&self) -> bool {
        self.connectors.iter().any(|c| c.tied_nodes().next().is_some())
    }

    /// Whether a spring ends at a body.
    pub(crate) fn is_tied(&self, body: usize) -> bool {
        let node = self.body_node(body);
        self.connectors.iter().flat_map(Connector::tied_nodes).any(|tied| tied == node)
    }
}

impl Connector {
    /// Nodes of the bodies that it ends at.
    pub(crate) fn tied_nodes(&self) -> impl Iterator<Item = usize> + '_ {
        let ends = match &self.coordinate {
            Coordinate::Distance { ends } => ends.as_slice(),
            _ => &[],
        };
        ends.iter().filter_map(|end| match end {
            ConnectorEnd::Body(p) => p.body_node(),
            _ => None,
        })
    }

    /// The same without what ties it to bodies that are not there: it does nothing then.
    pub(crate) fn without_bodies(&mut self) {
        if self.tied_nodes().next().is_none() {
            return;
        }
        if let Coordinate::Distance { ends } = &mut self.coordinate {
            for end in ends.iter_mut().filter(|end| matches!(end, ConnectorEnd::Body(_))) {
                *end = ConnectorEnd::Ground(end.reference());
            }
        }
        let rest = self.law.free();
        (self.law, self.yielding) = (ConnectorLaw::Linear { stiffness: 0.0, rest }, None);
        self.damping = 0.0;
    }

    /// Whether it acts on an angle.
    pub(crate) fn turns(&self) -> bool {
        matches!(self.coordinate, Coordinate::Angle { .. })
    }
}

impl ConnectorEnd {
    /// Position in the reference configuration \[m\].
    pub fn reference(&self) -> [f64; 2] {
        match self {
            Self::Point(p) | Self::Body(p) => p.position,
            Self::Ground(x) => *x,
        }
    }
}
