//! Free bodies, obstacles, and contact laws between two partners.

use std::fmt;
use std::sync::Arc;

use super::{BeamId, Motion, PointRef};

/// Index of a disc, given by [`ModelBuilder::disc`](crate::ModelBuilder::disc).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct DiscId(pub(crate) u32);

/// Index of an obstacle, given by [`ModelBuilder::obstacle`](crate::ModelBuilder::obstacle).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ObstacleId(pub(crate) u32);

/// A rigid disc that moves freely in the plane.
#[derive(Clone, Debug, PartialEq)]
pub struct Disc {
    /// The user's name for it.
    pub name: String,
    /// Mass \[kg\].
    pub mass: f64,
    /// Moment of inertia about its centre \[kg m^2\]; that of a solid disc, or of the point's own mass at the least, if none is
    /// given.
    pub inertia: Option<f64>,
    /// Radius \[m\]; zero for a point.
    pub radius: f64,
    /// Centre at the start, shape (2) \[m\].
    pub position: [f64; 2],
    /// Velocity at the start, shape (2) \[m/s\].
    pub velocity: [f64; 2],
    /// Angular velocity at the start, positive counter-clockwise \[rad/s\].
    pub spin: f64,
}

/// Shape of an obstacle.
#[derive(Clone, Debug, PartialEq)]
pub enum ObstacleShape {
    /// Everything behind a straight line.
    HalfPlane {
        /// A point of the line, shape (2) \[m\].
        point: [f64; 2],
        /// Direction out of the obstacle, shape (2) \[-\]; need not be of unit length.
        normal: [f64; 2],
    },
    /// A disc.
    Disc {
        /// Centre, shape (2) \[m\].
        centre: [f64; 2],
        /// Radius \[m\].
        radius: f64,
    },
    /// A wall of finite length with round ends; it can be struck from both sides.
    Segment {
        /// Its ends, shape (2, 2) \[m\].
        ends: [[f64; 2]; 2],
        /// Thickness \[m\].
        thickness: f64,
    },
    /// A support of finite width around a beam, with clearance: a segment on each side, or on one.
    Clearance {
        /// The point of the beam in the middle of it.
        at: PointRef,
        /// Extent along the beam \[m\].
        width: f64,
        /// Free way between the beam's surface and either segment \[m\].
        gap: f64,
        /// Sides on which it acts.
        sides: Sides,
    },
}

/// Sides of a beam, in its direction.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Sides {
    /// Left and right.
    #[default]
    Both,
    /// To the left, where the tangent turned by +90 degrees points.
    Left,
    /// To the right.
    Right,
}

/// An obstacle: it is fixed, or moves as prescribed.
#[derive(Clone, Debug, PartialEq)]
pub struct Obstacle {
    /// The user's name for it.
    pub name: String,
    /// Its shape.
    pub shape: ObstacleShape,
    /// Prescribed motion; an obstacle does not rotate.
    pub motion: Option<Motion>,
}

/// One of two things that can touch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ContactPartner {
    /// A disc.
    Disc(DiscId),
    /// A beam, on either face; twice the same for a beam against itself.
    Beam(BeamId),
    /// An obstacle.
    Obstacle(ObstacleId),
}

/// Potential of a contact force, a function of the penetration p.
#[derive(Clone, Debug, PartialEq)]
pub enum Potential {
    /// `k p^2 / 2`.
    Linear {
        /// Stiffness k \[N/m\].
        stiffness: f64,
    },
    /// Hertz: `2/5 K p^(5/2)`, force `K p^(3/2)`.
    Hertz {
        /// K \[N/m^1.5\].
        stiffness: f64,
    },
    /// Integral of a force that is a straight line between given values, and beyond the last one.
    Table {
        /// Penetrations, from zero on, increasing, shape (points) \[m\].
        penetration: Vec<f64>,
        /// Forces, from zero on, never falling, shape (points) \[N\].
        force: Vec<f64>,
    },
    /// Any other, given as code.
    Function(PotentialFunction),
}

/// A potential given as code: energy \[J\] and force \[N\] at a penetration \[m\] of zero or above.
#[derive(Clone)]
pub struct PotentialFunction {
    /// Energy at a penetration, but for a constant.
    pub(crate) energy: Arc<dyn Fn(f64) -> f64 + Send + Sync>,
    /// Force at a penetration: the derivative of the energy.
    pub(crate) force: Arc<dyn Fn(f64) -> f64 + Send + Sync>,
    /// Energy at no penetration \[J\].
    pub(crate) rest: f64,
}

impl fmt::Debug for PotentialFunction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("PotentialFunction")
    }
}

impl PartialEq for PotentialFunction {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.energy, &other.energy) && Arc::ptr_eq(&self.force, &other.force)
    }
}

/// A smooth contact law: a potential, and dissipation.
#[derive(Clone, Debug, PartialEq)]
pub struct SmoothLaw {
    /// Potential of the elastic part.
    pub potential: Potential,
    /// Hunt and Crossley's factor chi \[s/m\]: the force is `f(p) (1 + chi p_dot)`, never a pull; zero for none.
    pub dissipation: f64,
    /// How it is evaluated over a step.
    pub force: ContactForce,
    /// Slope of the line of unloading with crushing: the potential is then that of further loading, and unloading follows only this line \[N/m\].
    pub unloading: Option<f64>,
}

/// How a smooth contact force is evaluated over a step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ContactForce {
    /// Difference quotient of the potential along the discrete gradient of the gap: conserves energy and momenta, also while
    /// the contact opens, closes and slides.
    #[default]
    Conserving,
    /// Difference quotient of the potential along the gradient in the middle of the step: energy is lost or gained where
    /// the point of contact moves.
    PlainGradient,
    /// The force in the middle of the step (the paper, section 2.2).
    Midpoint,
}

/// Impact law for the velocities.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ImpactLaw {
    /// Newton's: `z1 >= -e z0` along the normal, and along the tangent within the cone of friction. With friction it can give
    /// energy; where it would, Moreau's is used instead and the impact counted.
    #[default]
    Newton,
    /// Moreau's: the impulses of the plastic impact, times 1 + e. Never gives energy.
    Moreau,
}

/// A set-valued contact law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidLaw {
    /// Coefficient of restitution along the normal, in \[0, 1\].
    pub restitution: f64,
    /// Tangential coefficient of restitution, in \[0, 1\]: a sticking contact separates with this share of its sliding velocity, in the opposite
    /// direction.
    pub tangential_restitution: f64,
    /// Coefficient of Coulomb friction, zero or above.
    pub friction: f64,
    /// Impact law for the velocities.
    pub impact: ImpactLaw,
}

/// Law between two partners in contact.
#[derive(Clone, Debug, PartialEq)]
pub enum TouchLaw {
    /// A force that grows with the penetration.
    Smooth(SmoothLaw),
    /// No penetration: impulses and persistent contact.
    Rigid(RigidLaw),
}

/// Two things that can touch.
///
/// Beams touch with their faces, half a depth from the centre line (with the line itself where the section has no depth), and
/// with their [`Ends`](crate::Ends), flat or round, that lie where the beam ends. Against anything but a disc a beam touches at points along it,
/// `points_per_element` of them in each element, and with the corners of its ends; the law holds for each of these points. Where
/// two beams meet, the corners of flat ends are rounded off by a twentieth of the depth.
#[derive(Clone, Debug, PartialEq)]
pub struct Contact {
    /// The user's name for it.
    pub name: String,
    /// Partners, shape (2).
    pub between: [ContactPartner; 2],
    /// Law.
    pub law: TouchLaw,
    /// Points of a beam's element that can touch.
    pub points_per_element: usize,
}

impl SmoothLaw {
    /// A law without dissipation.
    pub fn elastic(potential: Potential) -> Self {
        Self { potential, dissipation: 0.0, force: ContactForce::Conserving, unloading: None }
    }
}

impl RigidLaw {
    /// Newton's law without friction.
    pub fn frictionless(restitution: f64) -> Self {
        Self {
            restitution,
            tangential_restitution: 0.0,
            friction: 0.0,
            impact: ImpactLaw::default(),
        }
    }
}

impl Contact {
    /// Default of [`Contact::points_per_element`].
    pub const POINTS_PER_ELEMENT: usize = 2;

    /// A contact with the default number of points.
    pub fn new(name: impl Into<String>, between: [ContactPartner; 2], law: TouchLaw) -> Self {
        let points_per_element = Self::POINTS_PER_ELEMENT;
        Self { name: name.into(), between, law, points_per_element }
    }
}

/// One of two elastic bodies in Hertz contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HertzBody {
    /// Young's modulus \[Pa\].
    pub young: f64,
    /// Poisson's ratio.
    pub poisson: f64,
    /// Radius of curvature where they touch \[m\]; infinity for a flat face.
    pub radius: f64,
}

impl Potential {
    /// Hertz contact of two bodies: `K = 4/3 E* sqrt(R*)` with `1/E* = sum (1 - nu^2)/E` and `1/R* = sum 1/R` (K. L. Johnson,
    /// Contact Mechanics, 1985, eq. 4.23).
    pub fn hertz(bodies: [HertzBody; 2]) -> Self {
        let compliance: f64 = bodies.iter().map(|b| (1.0 - b.poisson * b.poisson) / b.young).sum();
        let curvature: f64 = bodies.iter().map(|b| 1.0 / b.radius).sum();
        Self::Hertz { stiffness: 4.0 / 3.0 / compliance / curvature.sqrt() }
    }

    /// A potential given as code: `energy` \[J\] and `force` \[N\] at a non-negative penetration \[m\]. They must depend on nothing else; the force
    /// is the derivative of the energy, zero at zero penetration and never tensile.
    pub fn function(
        energy: impl Fn(f64) -> f64 + Send + Sync + 'static,
        force: impl Fn(f64) -> f64 + Send + Sync + 'static,
    ) -> Self {
        let rest = energy(0.0);
        let (energy, force) = (Arc::new(energy), Arc::new(force));
        Self::Function(PotentialFunction { energy, force, rest })
    }
}

/// Hunt and Crossley's factor chi \[s/m\] for which two free bodies that approach at `velocity` \[m/s\] part with the given
/// coefficient of restitution, above zero.
///
/// With `b = chi v` the energy balance of `m p'' = -f(p) (1 + chi p')` gives `b (1 + e) = ln((1 + b) / (1 - e b))`, whatever f
/// is. (Hunt and Crossley's own `chi = 3/2 (1 - e)/v` is its limit for e near one.)
pub fn hunt_crossley(restitution: f64, velocity: f64) -> f64 {
    if restitution >= 1.0 {
        return 0.0;
    }
    let left_over = |b: f64| b * (1.0 + restitution) - (b.ln_1p() - (-restitution * b).ln_1p());
    // Positive at first, and falling to minus infinity towards b = 1/e.
    let (mut low, mut high) = (1e-12, (1.0 - 1e-15) / restitution.max(1e-12));
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if left_over(middle) > 0.0 { low = middle } else { high = middle }
    }
    0.5 * (low + high) / velocity
}

impl TouchLaw {
    /// The law of a force that grows with the penetration, if it is one.
    pub fn smooth(&self) -> Option<&SmoothLaw> {
        match self {
            Self::Smooth(law) => Some(law),
            Self::Rigid(_) => None,
        }
    }

    /// The law of impulses, if there is no penetration.
    pub fn rigid(&self) -> Option<&RigidLaw> {
        match self {
            Self::Rigid(law) => Some(law),
            Self::Smooth(_) => None,
        }
    }

    /// Whether it allows no penetration.
    pub fn is_rigid(&self) -> bool {
        self.rigid().is_some()
    }

    /// Whether the contact can stick.
    pub(crate) fn has_friction(&self) -> bool {
        self.rigid().is_some_and(|law| law.friction > 0.0)
    }

    /// Whether a force of it depends on a rate.
    pub(crate) fn dissipates(&self) -> bool {
        self.smooth().is_some_and(|law| law.dissipation > 0.0)
    }

    /// Whether a force of it depends on the previous penetration.
    pub fn crushes(&self) -> bool {
        self.smooth().is_some_and(|law| law.unloading.is_some())
    }
}
