//! Partners of impact: rigid bodies, guided projectiles, obstacles, contacts.

use std::ops::Range;

use super::definition::TouchLaw;
use super::point::MaterialPoint;

/// A rigid body.
#[derive(Clone, Debug)]
pub struct Body {
    /// Its name.
    pub name: String,
    /// Kind.
    pub kind: BodyKind,
    /// Mass \[kg\].
    pub mass: f64,
    /// Moment of inertia about its centre \[kg m^2\].
    pub inertia: f64,
    /// Velocity at the start, shape (2) \[m/s\].
    pub velocity: [f64; 2],
    /// Angular velocity at the start \[rad/s\].
    pub spin: f64,
}

/// Kind of a rigid body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BodyKind {
    /// The mass of a projectile that strikes, on its line of motion.
    Guided,
    /// A mass behind it; the body before it in the row is the front.
    Rear {
        /// Unit vector of the line of motion, shape (2) \[-\].
        direction: [f64; 2],
        /// Stiffness of the spring between both \[N/m\].
        stiffness: f64,
        /// Damping between both \[N s/m\].
        damping: f64,
    },
    /// A disc.
    Disc {
        /// Radius \[m\].
        radius: f64,
    },
    /// An obstacle that moves as prescribed, or the ground of all fixed ones.
    Obstacle,
}

impl BodyKind {
    /// Whether it is a mass on its line of motion, in front.
    pub fn is_guided(&self) -> bool {
        matches!(self, Self::Guided)
    }

    /// Whether it is a disc.
    pub fn is_disc(&self) -> bool {
        self.radius().is_some()
    }

    /// Radius of a disc \[m\].
    pub fn radius(&self) -> Option<f64> {
        match self {
            Self::Disc { radius } => Some(*radius),
            _ => None,
        }
    }

    /// Whether it moves as prescribed, or is fixed.
    pub fn is_obstacle(&self) -> bool {
        matches!(self, Self::Obstacle)
    }

    /// Whether it is a projectile that strikes.
    pub fn strikes(&self) -> bool {
        self.is_guided() || self.is_disc()
    }

    /// The spring and the damper between a mass and the one in front of it; `None` for other masses than rear ones.
    pub fn behind(&self) -> Option<Behind> {
        match *self {
            Self::Rear { direction, stiffness, damping } => {
                Some(Behind { direction, stiffness, damping })
            }
            _ => None,
        }
    }
}

/// Spring and damper between a rear mass and the one in front of it.
#[derive(Clone, Copy, Debug)]
pub struct Behind {
    /// Unit vector of the line of motion, shape (2) \[-\].
    pub direction: [f64; 2],
    /// Stiffness of the spring between both \[N/m\].
    pub stiffness: f64,
    /// Damping between both \[N s/m\].
    pub damping: f64,
}

/// An obstacle: all fixed ones share one body, the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ObstacleData {
    pub body: usize,
    /// Index of its reactions.
    pub support: usize,
    /// The point its moment is about, in the reference configuration, shape (2) \[m\].
    pub position: [f64; 2],
}

/// A projectile on its line of motion.
#[derive(Clone, Debug)]
pub struct ProjectileData {
    /// Its body that strikes; a rear mass is the next one.
    pub body: usize,
    pub has_rear: bool,
    /// Unit vector of the line of motion, from projectile to beam, shape (2) \[-\].
    pub direction: [f64; 2],
    /// The point struck.
    pub point: MaterialPoint,
}

/// Contact law between two partners.
#[derive(Clone, Debug)]
pub struct ContactData {
    pub name: String,
    /// Names of the partners, shape (2).
    pub between: [String; 2],
    pub law: TouchLaw,
    /// Its pairs.
    pub pairs: Range<usize>,
}
