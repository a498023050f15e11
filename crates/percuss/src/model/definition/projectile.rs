//! Projectiles.

use super::PointRef;

/// How the force of an elastic projectile is evaluated over a step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ContactForce {
    /// Difference quotient of the spring's potential: conserves energy through opening and closing.
    #[default]
    Conserving,
    /// The paper's: the spring's force at the midpoint of the step.
    Midpoint,
}

/// What strikes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ProjectileKind {
    /// A mass behind a massless linear spring.
    Elastic {
        /// Spring stiffness \[N/m\].
        stiffness: f64,
        /// Evaluation of the contact force.
        force: ContactForce,
    },
    /// A rigid mass under Newton's impact law.
    Rigid {
        /// Coefficient of restitution in \[0, 1\].
        restitution: f64,
    },
}

/// A projectile: it moves along a fixed line of flight and strikes a material point of a beam.
#[derive(Clone, Debug, PartialEq)]
pub struct Projectile {
    /// The user's name for it.
    pub name: String,
    /// Elastic or rigid.
    pub kind: ProjectileKind,
    /// Mass \[kg\].
    pub mass: f64,
    /// Initial velocity \[m/s\].
    pub velocity: [f64; 2],
    /// Line of flight towards the beam; needed only where the velocity is zero. Need not be of unit length.
    pub direction: Option<[f64; 2]>,
    /// The material point struck.
    pub strikes: PointRef,
    /// Initial distance between projectile (or spring tip) and beam along the line of flight \[m\].
    pub standoff: f64,
}
