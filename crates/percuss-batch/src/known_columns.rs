//! Columns of the history whose derivatives are known, and the numbers taken from them.

use super::column::{ColumnSample, Found, Taking};
use percuss::Model;
use percuss::internals::scalar::Number;

/// A column whose derivatives are known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum KnownColumn {
    Time,
    /// Position or velocity of a guided projectile \[index of a projectile, index of a component\].
    Position(usize, usize),
    Velocity(usize, usize),
    /// Gap, force and impulse since the last row of its contact \[index of a projectile\].
    Gap(usize),
    Force(usize),
    Impulse(usize),
    /// Displacement, velocity and rotation of a recorded point \[index of a point, index of a component\].
    Displacement(usize, usize),
    PointVelocity(usize, usize),
    Rotation(usize),
    /// Of the energy and momentum balances.
    Balance(Balance),
}

/// A column of the balances.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Balance {
    Kinetic,
    KineticBeams,
    KineticProjectiles,
    Strain,
    StrainAxial,
    StrainBending,
    Contact,
    Springs,
    Total,
    WorkLoads,
    LossImpacts,
    LossDamping,
    Plastic,
    Hardening,
    Linear(usize),
    Angular,
}

/// Names of these columns.
const BALANCES: [(&str, Balance); 17] = [
    ("energy.kinetic", Balance::Kinetic),
    ("energy.kinetic_beams", Balance::KineticBeams),
    ("energy.kinetic_projectiles", Balance::KineticProjectiles),
    ("energy.strain", Balance::Strain),
    ("energy.strain_axial", Balance::StrainAxial),
    ("energy.strain_bending", Balance::StrainBending),
    ("energy.contact", Balance::Contact),
    ("energy.springs", Balance::Springs),
    ("energy.total", Balance::Total),
    ("energy.work_loads", Balance::WorkLoads),
    ("energy.loss_impacts", Balance::LossImpacts),
    ("energy.loss_damping", Balance::LossDamping),
    ("energy.plastic", Balance::Plastic),
    ("energy.hardening", Balance::Hardening),
    ("momentum.linear_1", Balance::Linear(0)),
    ("momentum.linear_2", Balance::Linear(1)),
    ("momentum.angular", Balance::Angular),
];

impl KnownColumn {
    /// The column of a name, if its derivatives are known.
    pub fn of(name: &str, model: &Model) -> Option<Self> {
        if name == "time" {
            return Some(Self::Time);
        }
        if let Some((_, balance)) = BALANCES.iter().find(|(known, _)| *known == name) {
            return Some(Self::Balance(*balance));
        }
        let (kind, rest) = name.split_once('.')?;
        let (owner, quantity) = rest.rsplit_once('.')?;
        let projectile = || {
            let own = |body: usize| model.bodies[body].name == owner;
            model.projectiles.iter().position(|p| own(p.body))
        };
        let contact = || model.contacts.iter().position(|c| c.name == owner);
        let point = || model.points.iter().position(|p| p.label == owner);
        Some(match (kind, quantity) {
            ("projectile", "position_1") => Self::Position(projectile()?, 0),
            ("projectile", "position_2") => Self::Position(projectile()?, 1),
            ("projectile", "velocity_1") => Self::Velocity(projectile()?, 0),
            ("projectile", "velocity_2") => Self::Velocity(projectile()?, 1),
            ("contact", "gap") => Self::Gap(contact()?),
            ("contact", "force") => Self::Force(contact()?),
            ("contact", "impulse") => Self::Impulse(contact()?),
            ("point", "displacement_1") => Self::Displacement(point()?, 0),
            ("point", "displacement_2") => Self::Displacement(point()?, 1),
            ("point", "velocity_1") => Self::PointVelocity(point()?, 0),
            ("point", "velocity_2") => Self::PointVelocity(point()?, 1),
            ("point", "rotation") => Self::Rotation(point()?),
            _ => return None,
        })
    }
}

/// Whether the derivatives of a column are known.
pub fn has_derivatives(column: &str, model: &Model) -> bool {
    KnownColumn::of(column, model).is_some()
}

/// Numbers taken from the columns of a run with its derivatives.
#[derive(Clone, Debug)]
pub struct KnownColumns<S> {
    /// The column of each sample, shape (samples).
    pub columns: Vec<Option<KnownColumn>>,
    /// The samples, shape (samples).
    pub taking: Vec<Taking<S>>,
    /// Impulses of the contacts up to the last row, shape (guided projectiles) \[N s\].
    pub impulses: Vec<S>,
    /// Rotations of the recorded points in the last row, shape (recorded points) \[rad\].
    pub rotations: Vec<f64>,
    /// Time of the last row \[s\].
    pub time: f64,
}

impl<S: Number> KnownColumns<S> {
    /// Before the first row.
    pub fn new(samples: &[ColumnSample], model: &Model, zero: S) -> Self {
        Self {
            columns: samples.iter().map(|sample| KnownColumn::of(&sample.column, model)).collect(),
            taking: samples.iter().map(|sample| Taking::new(sample.taken)).collect(),
            impulses: vec![zero; model.projectiles.len()],
            rotations: vec![0.0; model.points.len()],
            time: f64::NEG_INFINITY,
        }
    }

    /// Each sample with its time, if the rows have it, shape (samples).
    pub fn found(&self) -> impl Iterator<Item = Option<Found<S>>> + '_ {
        let known = self.columns.iter().zip(&self.taking);
        known.map(|(column, taking)| taking.found.filter(|_| column.is_some()))
    }
}
