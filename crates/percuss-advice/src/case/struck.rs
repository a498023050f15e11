//! What formulas ask of what is struck.

use super::{Change, SHORTEST, Struck, force, linear_stiffness, rigid_impact};
use crate::formulas::{
    InfiniteBeam, InfiniteBeamImpact, Span, TwoMassImpact, TwoMasses, WaveControlled,
};
use crate::neglected_shear::NeglectedShear;
use crate::structure::gravity;
use crate::surroundings::Surroundings;
use percuss::TouchLaw;
use percuss::math::vec2::{dot, norm, rot90};

impl Struck<'_> {
    /// Share of the direction that lies across the beam, from zero to one.
    pub fn across(&self) -> f64 {
        dot(self.direction, rot90(self.place.tangent())).abs()
    }

    /// Whether the contact begins with an impact: bodies that touch at the start without approach have none.
    pub fn begins_with_an_impact(&self) -> bool {
        self.speed != 0.0 || self.gap != Some(0.0)
    }

    /// Acceleration of gravity along the direction of the impact, and all of it \[m/s^2\].
    pub fn gravity_shares(&self) -> [f64; 2] {
        let (pull, _) = gravity(self.place.model);
        [dot(pull, self.direction), norm(pull)]
    }

    /// Acceleration by which gravity brings both together \[m/s^2\]: of a beam that nothing holds, and that falls as the
    /// projectile does, none.
    pub fn pull(&self) -> f64 {
        let held = Surroundings::of(self.place.model, self.place.index).held;
        if held { self.gravity_shares()[0] } else { 0.0 }
    }

    /// Mass with which the beam as a whole meets the impact: of a known span the reduced one, of a free beam that of a rigid piece,
    /// else all of it \[kg\].
    pub fn beam_mass(&self) -> f64 {
        let span = self.place.span().map(|span| span.reduced_mass());
        span.or_else(|| self.place.free_mass()).unwrap_or_else(|| self.place.mass())
    }

    /// The span of the struck point, where hand formulas know it and the impact of a single mass goes across it.
    pub fn span(&self) -> Option<Span> {
        self.place.span().filter(|_| self.across() > 0.999 && self.rear.is_none())
    }

    /// The impact on a known span of one mass and one spring, where it lasts long enough, and the span.
    pub fn two_masses(&self, law: &TouchLaw, speed: f64) -> Option<(TwoMassImpact, Span)> {
        let (span, stiffness) = (self.span()?, linear_stiffness(law)?);
        // The duration does not depend on the speed.
        let unit = TwoMasses::on(&span, self.mass, stiffness).impact(1.0)?;
        if unit.duration < SHORTEST * span.period() {
            return None;
        }
        let impact = TwoMassImpact {
            peak_force: speed * unit.peak_force,
            deflection: speed * unit.deflection,
            ..unit
        };
        Some((impact, span))
    }

    /// The wave-controlled impact, where it is one: a single mass under a smooth law, across a beam that is uniform and carries
    /// nothing at the place. In closed form for a linear spring without losses and without weight.
    pub fn infinite_beam(&self, law: &TouchLaw, speed: f64) -> Option<InfiniteBeamImpact> {
        if !self.is_wave_controlled() {
            return None;
        }
        if let (Some(stiffness), true) = (linear_stiffness(law), self.pull() == 0.0) {
            let section = self.place.section();
            let beam = InfiniteBeam::of(self.mass, stiffness, section.bending, section.mass);
            return Some(beam.impact(self.mass, stiffness, speed));
        }
        self.softened(law, speed, 0.0)
    }

    /// The same by the integral equation, with rotary inertia and shear as the softening has them.
    pub fn softened(
        &self,
        law: &TouchLaw,
        speed: f64,
        softening: f64,
    ) -> Option<InfiniteBeamImpact> {
        let smooth = law.smooth()?;
        if law.crushes() {
            return None;
        }
        if speed <= 0.0 || !self.is_wave_controlled() {
            return None;
        }
        let (section, pull) = (self.place.section(), self.pull());
        let lasts = rigid_impact(law, self.mass, speed, self.mass * pull)?.duration;
        let case = WaveControlled {
            mass: self.mass,
            speed,
            bending: section.bending,
            mass_per_length: section.mass,
            pull,
            softening,
        };
        Some(case.impact(|p, rate| force(smooth, p, rate), lasts))
    }

    /// What rotary inertia and, beside it, shear change of an impact on a beam without end, to first order.
    pub fn corrections(&self, law: &TouchLaw, speed: f64) -> Option<[Change; 2]> {
        let section = self.place.section();
        let of = |shear| self.softened(law, speed, section.softening(shear));
        let plain = self.softened(law, speed, 0.0)?;
        let shear = NeglectedShear::at(&self.place).stiffness;
        let (rotary, sheared) = (of(f64::INFINITY)?, of(shear)?);
        let change = |a: &InfiniteBeamImpact, b: &InfiniteBeamImpact| {
            let rebound = a.restitution.zip(b.restitution).map(|(a, b)| b / a - 1.0);
            Change { force: b.peak_force / a.peak_force - 1.0, rebound }
        };
        let all = [change(&plain, &rotary), change(&rotary, &sheared)];
        all.iter().all(|c| c.force.is_finite()).then_some(all)
    }

    fn is_wave_controlled(&self) -> bool {
        let model = self.place.model;
        let here = |s: f64| (s - self.place.s).abs() < 1e-6 * self.place.beam.length();
        let index = self.place.index;
        let carries = model.point_masses().any(|m| m.point.beam == index && here(m.point.s));
        let fits = self.rear.is_none() && !carries && self.across() > 0.999;
        fits && self.place.is_uniform() && self.place.free_distance() > 0.0
    }
}
