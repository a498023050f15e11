//! Columns of the history of a run with its derivatives.

use std::f64::consts::TAU;

use super::{DerivativeRun, Derived};
use crate::known_columns::{Balance, KnownColumn};
use percuss::internals::scalar::Real;
use percuss::math::vec2::{add, cross, dot};

impl DerivativeRun<'_> {
    /// Takes a row in the current state, unless this instant has one.
    pub(super) fn row(&mut self) {
        if self.columns.taking.is_empty() || self.log.time.value <= self.columns.time {
            return;
        }
        let time = self.log.time;
        self.columns.time = time.value;
        for k in 0..self.columns.taking.len() {
            let Some(column) = self.columns.columns[k] else { continue };
            let value = self.column(column);
            self.columns.taking[k].row(time, value);
        }
        for (last, log) in self.columns.impulses.iter_mut().zip(&self.log.guides) {
            *last = log.given[0];
        }
        for k in 0..self.columns.rotations.len() {
            self.columns.rotations[k] = self.rotation(k).value;
        }
    }

    /// Value of a column in the current state.
    fn column(&self, column: KnownColumn) -> Derived {
        let (engine, guides) = (&self.engine, &self.engine.numbers.guides);
        let state = |k: usize| &engine.guides[k];
        match column {
            KnownColumn::Time => self.log.time,
            KnownColumn::Position(k, i) => {
                guides[k].position[i] + guides[k].direction[i] * state(k).way
            }
            KnownColumn::Velocity(k, i) => guides[k].direction[i] * state(k).velocity,
            KnownColumn::Gap(k) => state(k).gap,
            KnownColumn::Force(k) => guides[k].pushes(state(k).gap, state(k).rate),
            KnownColumn::Impulse(k) => self.log.guides[k].given[0] - self.columns.impulses[k],
            KnownColumn::Displacement(k, i) => engine.point(k)[0][i],
            KnownColumn::PointVelocity(k, i) => engine.point(k)[1][i],
            KnownColumn::Rotation(k) => self.rotation(k),
            KnownColumn::Balance(balance) => self.balance(balance),
        }
    }

    /// Rotation of a recorded point, within half a turn of that in the last row \[rad\].
    fn rotation(&self, k: usize) -> Derived {
        let near = self.columns.rotations[k];
        let point = &self.engine.numbers.points[k];
        let (from, to) =
            (point.tangent, add(point.tangent, point.gradient(&self.engine.displacement)));
        let (sine, cosine) = (cross(from, to), dot(from, to));
        let angle = sine.value.atan2(cosine.value);
        let square = cosine.value * cosine.value + sine.value * sine.value;
        let mut out = sine.constant(angle + TAU * ((near - angle) / TAU).round());
        for (i, slope) in out.slope.iter_mut().enumerate() {
            let turned = cosine.value * sine.slope[i] - sine.value * cosine.slope[i];
            *slope = turned / square;
        }
        out
    }

    fn balance(&self, balance: Balance) -> Derived {
        let (now, sums) = (&self.ledger.now, &self.ledger.sums);
        match balance {
            Balance::Kinetic => now.kinetic_beams + now.kinetic_projectiles,
            Balance::KineticBeams => now.kinetic_beams,
            Balance::KineticProjectiles => now.kinetic_projectiles,
            Balance::Strain => now.strain_axial + now.strain_bending,
            Balance::StrainAxial => now.strain_axial,
            Balance::StrainBending => now.strain_bending,
            Balance::Contact => now.contact,
            Balance::Springs => now.springs,
            Balance::Total => now.total(),
            Balance::WorkLoads => sums.work_loads,
            Balance::LossImpacts => sums.loss_impacts,
            Balance::LossDamping => sums.loss_damping,
            Balance::Plastic => sums.loss_plastic,
            Balance::Hardening => now.hardening,
            Balance::Linear(i) => now.linear[i],
            Balance::Angular => now.angular,
        }
    }
}
