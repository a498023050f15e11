//! What holds and ties beams: prescribed degrees of freedom, constraints, connectors, the points they act at.

use crate::element::fibre::StressLaw;
use crate::linalg::block::{Block, IDENTITY};

/// Components of a node's displacement that are held, or moved as prescribed.
#[derive(Clone, Debug)]
pub struct PrescribedDofs<S = f64> {
    pub node: usize,
    /// The support that holds them, the first one where several do; `None` for the guide of a projectile
    /// and for obstacles, whose reactions are those of their contacts.
    pub support: Option<usize>,
    /// Held directions in (u1, u2, u1', u2'), orthonormal, shape (at most 4, 4) \[-\].
    pub normals: Vec<[S; 4]>,
    /// Motion along each of them, shape (directions held, motions that take part) \[index of a motion, m\].
    pub drives: Vec<Drive>,
    /// What they leave free: `P = I - N N^T` with the held directions as columns of N, shape (4, 4) \[-\].
    pub free: Block<S>,
    /// Which components are held, where the directions are those of components, or all are, shape (4).
    pub components: Option<[bool; 4]>,
}

impl PrescribedDofs {
    /// Nothing held yet.
    pub fn new(node: usize, support: Option<usize>) -> Self {
        let (normals, drives) = (Vec::new(), Vec::new());
        Self { node, support, normals, drives, free: IDENTITY, components: Some([false; 4]) }
    }

    /// Holds one more direction, of unit length and across those held already.
    pub fn hold(&mut self, normal: [f64; 4], drive: Drive) {
        for r in 0..4 {
            for c in 0..4 {
                self.free[r][c] -= normal[r] * normal[c];
            }
        }
        self.normals.push(normal);
        self.drives.push(drive);
        let own = normal.map(|c| c.abs() == 1.0);
        let is_component = own.contains(&true) && (0..4).all(|k| own[k] || normal[k] == 0.0);
        self.components = match self.components {
            _ if self.is_whole() => Some([true; 4]),
            Some(held) if is_component => Some(std::array::from_fn(|k| held[k] || own[k])),
            _ => None,
        };
    }
}

impl<S: Copy> PrescribedDofs<S> {
    /// Whether nothing is left free.
    pub fn is_whole(&self) -> bool {
        self.normals.len() == 4
    }

    /// The same with every number replaced, in a fixed order.
    pub fn map<T>(&self, f: &mut impl FnMut(S) -> T) -> PrescribedDofs<T> {
        PrescribedDofs {
            node: self.node,
            support: self.support,
            normals: self.normals.iter().map(|n| n.map(&mut *f)).collect(),
            drives: self.drives.clone(),
            free: self.free.map(|row| row.map(&mut *f)),
            components: self.components,
        }
    }
}

/// A prescribed value: amplitudes times time functions of [`Model::motions`](super::frozen::Model::motions).
pub type Drive = Vec<(usize, f64)>;

/// A support, for its reactions.
#[derive(Clone, Debug)]
pub struct SupportData {
    pub name: String,
    /// Its point; an obstacle has none.
    pub point: Option<MaterialPoint>,
    /// Holds until this time \[s\].
    pub until: f64,
    /// Its time function among [`Model::motions`](super::frozen::Model::motions).
    pub motion: Option<usize>,
    /// Whether it is a stop, which presses only when its gap is closed.
    pub stops: bool,
}

/// A material point: where it lies in the mesh and how it follows the nodes.
#[derive(Clone, Debug)]
pub struct MaterialPoint {
    pub label: String,
    pub beam: usize,
    /// Node `a` of the element; node `b` is the next one.
    pub node: usize,
    /// Arc length from the start of the beam \[m\].
    pub s: f64,
    /// Shape functions, on (u_a, u_a', u_b, u_b'), shape (4) \[1, m, 1, m\].
    pub shape: [f64; 4],
    /// Derivatives of the shape functions, shape (4) \[1/m, 1, 1/m, 1\].
    pub slope: [f64; 4],
    /// Reference position, shape (2) \[m\].
    pub position: [f64; 2],
    /// Reference tangent, shape (2) \[1\].
    pub tangent: [f64; 2],
}

impl MaterialPoint {
    /// Interpolates nodal values with the shape functions.
    #[inline]
    pub fn value(&self, nodal: &[[f64; 4]]) -> [f64; 2] {
        self.combine(nodal, &self.shape)
    }

    /// Interpolates nodal values with the derivatives of the shape functions.
    #[inline]
    pub fn gradient(&self, nodal: &[[f64; 4]]) -> [f64; 2] {
        self.combine(nodal, &self.slope)
    }

    #[inline]
    fn combine(&self, nodal: &[[f64; 4]], n: &[f64; 4]) -> [f64; 2] {
        let (a, b) = (&nodal[self.node], &nodal[self.node + 1]);
        [
            n[0] * a[0] + n[1] * a[2] + n[2] * b[0] + n[3] * b[2],
            n[0] * a[1] + n[1] * a[3] + n[2] * b[1] + n[3] * b[3],
        ]
    }

    /// Adds `shape^T f` to nodal forces.
    #[inline]
    pub fn spread(&self, force: [f64; 2], nodal: &mut [[f64; 4]]) {
        spread(&self.shape, self.node, force, nodal);
    }

    /// Adds `shape^T f` to the forces on the two nodes of its element.
    pub fn spread_over(&self, force: [f64; 2], nodes: &mut [[f64; 4]; 2]) {
        spread(&self.shape, 0, force, nodes);
    }

    /// Adds `slope^T f` to the forces on the two nodes of its element.
    pub fn spread_gradient_over(&self, force: [f64; 2], nodes: &mut [[f64; 4]; 2]) {
        spread(&self.slope, 0, force, nodes);
    }

    /// Adds `slope^T f` to nodal forces.
    #[inline]
    pub fn spread_gradient(&self, force: [f64; 2], nodal: &mut [[f64; 4]]) {
        spread(&self.slope, self.node, force, nodal);
    }
}

#[inline]
fn spread(n: &[f64; 4], node: usize, force: [f64; 2], nodal: &mut [[f64; 4]]) {
    for i in 0..2 {
        nodal[node][i] += n[0] * force[i];
        nodal[node][2 + i] += n[1] * force[i];
        nodal[node + 1][i] += n[2] * force[i];
        nodal[node + 1][2 + i] += n[3] * force[i];
    }
}

/// What a joint carries, a mean over a step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct JointLoad {
    /// Size of the force \[N\].
    pub force: f64,
    /// Size of the moment \[N m\]; zero of a hinge.
    pub moment: f64,
}

/// A joint that parts.
#[derive(Clone, Debug)]
pub struct JointData {
    pub name: String,
    /// What it carries at most, force and moment; endless if it bears any, shape (2) \[N, N m\].
    pub strength: [f64; 2],
}

impl JointData {
    /// Whether it parts under a load.
    pub fn parts_under(&self, load: &JointLoad) -> bool {
        self.use_under(load) > 1.0
    }

    /// Its load over its strength, the larger of force and moment: above one it parts.
    pub fn use_under(&self, load: &JointLoad) -> f64 {
        (load.force / self.strength[0]).max(load.moment / self.strength[1])
    }
}

/// A scalar constraint on material points, kept by a multiplier.
#[derive(Clone, Debug)]
pub struct Constraint {
    pub kind: ConstraintKind,
    /// The support it belongs to; a joint's belong to none.
    pub support: Option<usize>,
    /// The joint of a given strength that it belongs to, among `Model::joints`.
    pub joint: Option<usize>,
    /// Prescribed value, shape (motions that take part) \[index of a motion, m or rad\].
    pub drive: Drive,
    /// Holds until this time \[s\].
    pub until: f64,
}

/// What is constrained.
#[derive(Clone, Debug)]
pub enum ConstraintKind {
    /// `direction . u(point) = value`, or of its gradient: a support between nodes.
    Held {
        point: MaterialPoint,
        /// The direction, of unit length, shape (2) \[-\].
        direction: [f64; 2],
        gradient: bool,
    },
    /// `J t . g(point) = 0` with t the reference tangent turned by the prescribed angle.
    Turned { point: MaterialPoint },
    /// `direction . (u(a) - u(b)) = 0`: positions shared.
    Shared {
        /// The points a and b, shape (2).
        points: Box<[MaterialPoint; 2]>,
        /// The direction, of unit length, shape (2) \[-\].
        direction: [f64; 2],
    },
    /// `g_a x R g_b = 0` with R the rotation from the reference tangent of b to that of a: the angle is kept.
    Angle {
        /// The points a and b, shape (2).
        points: Box<[MaterialPoint; 2]>,
        cosine: f64,
        sine: f64,
    },
}

impl ConstraintKind {
    /// Whether it is of slopes and not of places.
    pub fn is_of_slopes(&self) -> bool {
        match self {
            Self::Held { gradient, .. } => *gradient,
            Self::Turned { .. } | Self::Angle { .. } => true,
            Self::Shared { .. } => false,
        }
    }
}

impl Constraint {
    /// The points it ties.
    pub fn points(&self) -> &[MaterialPoint] {
        match &self.kind {
            ConstraintKind::Held { point, .. } | ConstraintKind::Turned { point } => {
                std::slice::from_ref(point)
            }
            ConstraintKind::Shared { points, .. } | ConstraintKind::Angle { points, .. } => {
                points.as_slice()
            }
        }
    }
}

/// A spring and damper on one coordinate.
#[derive(Clone, Debug)]
pub struct Connector {
    pub coordinate: Coordinate,
    pub law: ConnectorLaw,
    /// How it yields, if it does; its linear law is the elastic part then.
    pub yielding: Option<YieldingLaw>,
    /// Viscous damping of the coordinate, force per rate.
    pub damping: f64,
    /// The support it belongs to, if any.
    pub support: Option<usize>,
    /// Acts until this time \[s\].
    pub until: f64,
}

/// How a spring or an elastic hinge yields.
#[derive(Clone, Debug)]
pub struct YieldingLaw {
    /// What it is and its name, `spring.brace` or `joint.knee`.
    pub name: String,
    /// Force over extension from the length without force, or moment over rotation.
    pub law: StressLaw,
    /// What its extension or rotation, and its force or moment, are told with: 1 or, of a hinge, -1 where its coordinate (the turn of the
    /// first place against the second) counts against the bending moment beside it.
    pub sign: f64,
    /// Number of what it remembers among [`crate::state::State::memories`].
    pub memory: usize,
}

/// A scalar coordinate of the configuration, zero or its natural value in the reference configuration.
#[derive(Clone, Debug)]
pub enum Coordinate {
    /// `direction . u(point)` less a prescribed motion.
    Displacement {
        point: MaterialPoint,
        /// The direction, of unit length, shape (2) \[-\].
        direction: [f64; 2],
        /// The prescribed motion, shape (motions that take part) \[index of a motion, m\].
        drive: Drive,
    },
    /// Distance between two places.
    Distance {
        /// The two places, shape (2).
        ends: Box<[ConnectorEnd; 2]>,
    },
    /// Angle from the tangent at b, or its reference, to that at a, less that in the reference configuration; the rotation R
    /// takes the reference tangent of b to that of a.
    Angle { a: Box<MaterialPoint>, b: Option<Box<MaterialPoint>>, cosine: f64, sine: f64 },
}

/// A place on a beam or in space.
#[derive(Clone, Debug)]
pub enum ConnectorEnd {
    Point(MaterialPoint),
    /// A point fixed in space, shape (2) \[m\].
    Ground([f64; 2]),
}

/// Potential of a connector.
#[derive(Clone, Copy, Debug)]
pub enum ConnectorLaw<S = f64> {
    /// `k (q - rest)^2 / 2`.
    Linear {
        /// Stiffness k, force per unit of the coordinate.
        stiffness: S,
        /// Coordinate without force.
        rest: S,
    },
    /// `k <q - gap>^2 / 2`: no force before the gap is closed.
    OneSided {
        /// Stiffness k, force per unit of the coordinate.
        stiffness: S,
        /// Coordinate from which on it presses.
        gap: S,
    },
}

impl<S: Copy> ConnectorLaw<S> {
    /// The same with every number replaced, in a fixed order.
    #[inline(always)]
    pub fn map<T>(self, f: &mut impl FnMut(S) -> T) -> ConnectorLaw<T> {
        match self {
            Self::Linear { stiffness, rest } => {
                ConnectorLaw::Linear { stiffness: f(stiffness), rest: f(rest) }
            }
            Self::OneSided { stiffness, gap } => {
                ConnectorLaw::OneSided { stiffness: f(stiffness), gap: f(gap) }
            }
        }
    }

    /// Whether it presses only while its gap is closed.
    pub fn is_one_sided(self) -> bool {
        matches!(self, Self::OneSided { .. })
    }

    /// A value of the coordinate without force and energy.
    pub fn free(self) -> S {
        match self {
            Self::Linear { rest, .. } => rest,
            Self::OneSided { gap, .. } => gap,
        }
    }
}

impl ConnectorLaw {
    /// Whether it acts at a value of the coordinate: what is not closed there has neither force nor stiffness.
    pub fn acts_at(self, q: f64) -> bool {
        match self {
            Self::Linear { .. } => true,
            Self::OneSided { gap, .. } => q > gap,
        }
    }
}

/// A mass at a point.
#[derive(Clone, Debug)]
pub struct MassData {
    pub point: MaterialPoint,
    pub mass: f64,
    pub rotary_inertia: f64,
}
