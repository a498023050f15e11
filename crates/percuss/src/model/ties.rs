//! Supports and joints of beams: prescribed degrees of freedom, constraints, connectors, their points of action.

use super::point::MaterialPoint;
use crate::element::fibre::StressLaw;
use crate::linalg::block::{Block, IDENTITY};

/// Components of a node's displacement that are fixed, or moved as prescribed.
#[derive(Clone, Debug)]
pub struct PrescribedDofs<S = f64> {
    pub node: usize,
    /// Their support, the first one of several; `None` for the guide of a projectile and for obstacles, whose reactions are those of their contacts.
    pub support: Option<usize>,
    /// Fixed directions in (u1, u2, u1', u2'), orthonormal, shape (at most 4, 4) \[-\].
    pub normals: Vec<[S; 4]>,
    /// Motion along each of them, shape (directions held, motions that take part) \[index of a motion, m\].
    pub drives: Vec<Drive>,
    /// Projection on the free directions: `P = I - N N^T` with the fixed directions as columns of N, shape (4, 4) \[-\].
    pub free: Block<S>,
    /// Fixed components, if the directions are those of components, or all are, shape (4).
    pub components: Option<[bool; 4]>,
}

impl PrescribedDofs {
    /// No fixed direction yet.
    pub fn new(node: usize, support: Option<usize>) -> Self {
        let (normals, drives) = (Vec::new(), Vec::new());
        Self { node, support, normals, drives, free: IDENTITY, components: Some([false; 4]) }
    }

    /// Fixes one more direction, of unit length and across the fixed ones.
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
    /// Whether all directions are fixed.
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
    /// Active until this time \[s\].
    pub until: f64,
    /// Its time function among [`Model::motions`](super::frozen::Model::motions).
    pub motion: Option<usize>,
    /// Whether it is a stop, which presses only when its gap is closed.
    pub stops: bool,
    /// Whether it fixes displacements or is an obstacle with a rigid contact: its reactions can be impulses. Springs, stops and compliant contacts
    /// have forces only.
    pub rigid: bool,
}

/// Load of a joint, a mean over a step.
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
    /// Its strength, force and moment; infinite if unlimited, shape (2) \[N, N m\].
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

/// A scalar constraint on material points, with a multiplier.
#[derive(Clone, Debug)]
pub struct Constraint<S = f64> {
    pub kind: ConstraintKind<S>,
    /// The support it belongs to; a joint's belong to none.
    pub support: Option<usize>,
    /// The joint of a given strength that it belongs to, among `Model::joints`.
    pub joint: Option<usize>,
    /// Prescribed value, shape (motions that take part) \[index of a motion, m or rad\].
    pub drive: Drive,
    /// Active until this time \[s\].
    pub until: f64,
}

/// Kind of constraint.
#[derive(Clone, Debug)]
pub enum ConstraintKind<S = f64> {
    /// `direction . u(point) = value`, or of its gradient: a support between nodes.
    Held {
        point: MaterialPoint<S>,
        /// The direction, of unit length, shape (2) \[-\].
        direction: [S; 2],
        gradient: bool,
    },
    /// `J t . g(point) = 0` with t the reference tangent turned by the prescribed angle.
    Turned { point: MaterialPoint<S> },
    /// `direction . (u(a) - u(b)) = 0`: positions shared.
    Shared {
        /// The points a and b, shape (2).
        points: Box<[MaterialPoint<S>; 2]>,
        /// The direction, of unit length, shape (2) \[-\].
        direction: [S; 2],
    },
    /// `g_a x R g_b = 0` with R the rotation from the reference tangent of b to that of a: the angle is constant.
    Angle {
        /// The points a and b, shape (2).
        points: Box<[MaterialPoint<S>; 2]>,
        cosine: S,
        sine: S,
    },
    /// `(|g(point)|^2 - 1) / 2 = 0`: unit length of the vector of a node of a shear-flexible beam.
    Length { point: MaterialPoint<S> },
}

impl<S: Copy> ConstraintKind<S> {
    /// Whether it is of slopes and not of places.
    pub fn is_of_slopes(&self) -> bool {
        match self {
            Self::Held { gradient, .. } => *gradient,
            Self::Turned { .. } | Self::Angle { .. } | Self::Length { .. } => true,
            Self::Shared { .. } => false,
        }
    }

    /// The same with every number replaced, in a fixed order.
    pub fn map<T: Copy>(&self, f: &mut impl FnMut(S) -> T) -> ConstraintKind<T> {
        match self {
            Self::Held { point, direction, gradient } => ConstraintKind::Held {
                point: point.map(f),
                direction: direction.map(f),
                gradient: *gradient,
            },
            Self::Turned { point } => ConstraintKind::Turned { point: point.map(f) },
            Self::Length { point } => ConstraintKind::Length { point: point.map(f) },
            Self::Shared { points, direction } => ConstraintKind::Shared {
                points: Box::new(points.each_ref().map(|p| p.map(f))),
                direction: direction.map(f),
            },
            Self::Angle { points, cosine, sine } => ConstraintKind::Angle {
                points: Box::new(points.each_ref().map(|p| p.map(f))),
                cosine: f(*cosine),
                sine: f(*sine),
            },
        }
    }
}

impl<S: Copy> Constraint<S> {
    /// The same with every number replaced, in a fixed order.
    pub fn map<T: Copy>(&self, f: &mut impl FnMut(S) -> T) -> Constraint<T> {
        Constraint {
            kind: self.kind.map(f),
            support: self.support,
            joint: self.joint,
            drive: self.drive.clone(),
            until: self.until,
        }
    }
}

impl<S> Constraint<S> {
    /// The points it ties.
    pub fn points(&self) -> &[MaterialPoint<S>] {
        match &self.kind {
            ConstraintKind::Held { point, .. }
            | ConstraintKind::Turned { point }
            | ConstraintKind::Length { point } => std::slice::from_ref(point),
            ConstraintKind::Shared { points, .. } | ConstraintKind::Angle { points, .. } => {
                points.as_slice()
            }
        }
    }
}

/// A spring and damper on one coordinate.
#[derive(Clone, Debug)]
pub struct Connector {
    /// Name of its support, spring or joint; empty for the springs of a foundation.
    pub name: String,
    pub coordinate: Coordinate,
    pub law: ConnectorLaw,
    /// How it yields or breaks, if it does; its linear law is then the elastic part.
    pub yielding: Option<YieldingLaw>,
    /// Viscous damping of the coordinate, force per rate.
    pub damping: f64,
    /// The support it belongs to, if any.
    pub support: Option<usize>,
    /// The foundation of which it is a part, if any.
    pub foundation: Option<usize>,
    /// Acts until this time \[s\].
    pub until: f64,
}

/// Yield law and strength of a spring or an elastic hinge.
#[derive(Clone, Debug)]
pub struct YieldingLaw {
    /// Kind and name, `spring.brace` or `joint.knee`.
    pub name: String,
    /// Force over extension from the length without force, or moment over rotation; none if it only breaks.
    pub law: Option<StressLaw>,
    /// Magnitude of the force, a mean over a step, beyond which it breaks \[N\].
    pub strength: f64,
    /// Sign of its extension or rotation, and of its force or moment, in results: 1 or, for a hinge, -1 if its coordinate (the rotation of the
    /// first point relative to the second) is opposite to the bending moment beside it.
    pub sign: f64,
    /// Number of its state variables among [`crate::state::State::memories`].
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

/// A place on a beam, on a body or in space.
#[derive(Clone, Debug)]
pub enum ConnectorEnd {
    Point(MaterialPoint),
    /// The centre of a body, as a point that follows its node alone.
    Body(MaterialPoint),
    /// A point fixed in space, shape (2) \[m\].
    Ground([f64; 2]),
}

/// Potential of a connector.
#[derive(Clone, Debug)]
pub enum ConnectorLaw<S = f64> {
    /// `k (q - rest)^2 / 2`.
    Linear {
        /// Stiffness k, force per unit of the coordinate.
        stiffness: S,
        /// Coordinate without force.
        rest: S,
    },
    /// `k <q - gap>^2 / 2`, or `k <gap - q>^2 / 2` of what acts from above down: no force before the gap is closed.
    OneSided {
        /// Stiffness k, force per unit of the coordinate.
        stiffness: S,
        /// Coordinate from which on it presses.
        gap: S,
        /// To which side it acts.
        from: ActsFrom,
    },
    /// The integral of a force along straight lines, constant beyond them.
    Tabulated {
        /// Its lines.
        table: ForceTable<S>,
        /// Coordinate without force.
        rest: S,
    },
}

/// On which side of its gap a spring of one side acts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ActsFrom {
    /// Where the coordinate is larger.
    Above,
    /// Where it is smaller.
    Below,
}

/// A force along straight lines over an extension, through zero; constant beyond its first and last bend.
#[derive(Clone, Debug)]
pub struct ForceTable<S = f64> {
    /// Slope next to zero, force per extension.
    pub slope: S,
    /// Bends from zero up: extension and change of the slope, shape (bends, 2) \[m, N/m\].
    pub above: Vec<[S; 2]>,
    /// Bends below zero, likewise, shape (bends, 2) \[m, N/m\].
    pub below: Vec<[S; 2]>,
    /// If it has forces of one sign alone: the side on which it acts, and the extension from which on it does.
    pub side: Option<(ActsFrom, S)>,
}

impl<S: Copy> ConnectorLaw<S> {
    /// The same with every number replaced, in a fixed order.
    #[doc(hidden)]
    #[inline(always)]
    pub fn map<T>(&self, f: &mut impl FnMut(S) -> T) -> ConnectorLaw<T> {
        match self {
            Self::Linear { stiffness, rest } => {
                ConnectorLaw::Linear { stiffness: f(*stiffness), rest: f(*rest) }
            }
            Self::OneSided { stiffness, gap, from } => {
                ConnectorLaw::OneSided { stiffness: f(*stiffness), gap: f(*gap), from: *from }
            }
            Self::Tabulated { table: ForceTable { slope, above, below, side }, rest } => {
                let slope = f(*slope);
                let mut bends =
                    |all: &[[S; 2]]| all.iter().map(|bend| bend.map(&mut *f)).collect::<Vec<_>>();
                let (above, below) = (bends(above), bends(below));
                let side = side.map(|(from, at)| (from, f(at)));
                let table = ForceTable { slope, above, below, side };
                ConnectorLaw::Tabulated { table, rest: f(*rest) }
            }
        }
    }

    /// Whether it presses only while its gap is closed.
    pub fn is_one_sided(&self) -> bool {
        matches!(self, Self::OneSided { .. })
    }

    /// The side on which it acts and the coordinate from which on it does, of a law that pulls alone or pushes alone.
    #[doc(hidden)]
    #[inline(always)]
    pub fn side(&self) -> Option<(ActsFrom, S)>
    where
        S: std::ops::Add<Output = S>,
    {
        match self {
            Self::Linear { .. } => None,
            Self::OneSided { gap, from, .. } => Some((*from, *gap)),
            Self::Tabulated { table, rest } => table.side.map(|(from, at)| (from, *rest + at)),
        }
    }

    /// A value of the coordinate without force and energy.
    pub fn free(&self) -> S {
        match self {
            Self::Linear { rest, .. } | Self::Tabulated { rest, .. } => *rest,
            Self::OneSided { gap, .. } => *gap,
        }
    }
}

impl ConnectorLaw {
    /// Whether it acts at a value of the coordinate: an open one has neither force nor stiffness.
    pub fn acts_at(&self, q: f64) -> bool {
        match self {
            Self::Linear { .. } | Self::Tabulated { .. } => true,
            Self::OneSided { gap, from: ActsFrom::Above, .. } => q > *gap,
            Self::OneSided { gap, from: ActsFrom::Below, .. } => q < *gap,
        }
    }

    /// Whether it has no stiffness, or a negative one, for some values of the coordinate.
    pub fn may_give_way(&self) -> bool {
        match self {
            Self::Linear { .. } => false,
            // A table has no stiffness beyond its points.
            Self::OneSided { .. } | Self::Tabulated { .. } => true,
        }
    }

    /// Whether it has no force over a range of the coordinate: a gap, or slack.
    pub fn has_gap(&self) -> bool {
        match self {
            Self::Linear { .. } => false,
            Self::OneSided { .. } => true,
            Self::Tabulated { table, .. } => table.side.is_some() || table.slope == 0.0,
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
