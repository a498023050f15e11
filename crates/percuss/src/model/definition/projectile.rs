//! Projectiles that are guided along a line of motion.

use super::{PointRef, Potential, SmoothLaw};

/// Kind of contact of a projectile.
#[derive(Clone, Debug, PartialEq)]
pub enum ProjectileKind {
    /// A mass behind a massless spring.
    Elastic {
        /// Law of the spring.
        law: SmoothLaw,
    },
    /// A rigid mass under Newton's impact law.
    Rigid {
        /// Coefficient of restitution in \[0, 1\].
        restitution: f64,
    },
}

impl ProjectileKind {
    /// A mass behind a linear spring \[N/m\].
    pub fn spring(stiffness: f64) -> Self {
        Self::Elastic { law: SmoothLaw::elastic(Potential::Linear { stiffness }) }
    }
}

/// A second mass of a projectile, behind the first one on its line of motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RearMass {
    /// Mass \[kg\].
    pub mass: f64,
    /// Stiffness of the spring between the two, in tension and compression \[N/m\].
    pub stiffness: f64,
    /// Damping of the same \[N s/m\].
    pub damping: f64,
}

/// A projectile: it is guided along a fixed line of motion and strikes a material point of a beam.
#[derive(Clone, Debug, PartialEq)]
pub struct Projectile {
    /// The user's name for it.
    pub name: String,
    /// Elastic or rigid.
    pub kind: ProjectileKind,
    /// Mass \[kg\]; of two masses, that of the front one.
    pub mass: f64,
    /// Initial velocity, shape (2) \[m/s\].
    pub velocity: [f64; 2],
    /// Line of motion towards the beam, shape (2) \[-\]; needed only where the velocity is zero. Need not be of unit length.
    pub direction: Option<[f64; 2]>,
    /// The material point struck.
    pub strikes: PointRef,
    /// Initial distance between projectile (or spring tip) and beam along the line of motion \[m\].
    pub standoff: f64,
    /// A second mass behind it.
    pub rear: Option<RearMass>,
    /// Added nodal mass at the struck point \[kg\]: the first mass in an impact, for any mesh.
    pub local_mass: f64,
}

impl Projectile {
    /// A single mass that starts at the beam.
    pub fn new(
        name: impl Into<String>,
        kind: ProjectileKind,
        mass: f64,
        velocity: [f64; 2],
        strikes: PointRef,
    ) -> Self {
        Self {
            name: name.into(),
            kind,
            mass,
            velocity,
            direction: None,
            strikes,
            standoff: 0.0,
            rear: None,
            local_mass: 0.0,
        }
    }
}
