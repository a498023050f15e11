//! A bar that flies lengthwise against a wall, with a contact law between.

use super::{BarImpact, UniformBeam};

/// Steps in the shorter of the time a wave takes up and down the bar and the time in which the force rises.
const STEPS: f64 = 40.0;
/// A force that rises in this share of the time of the wave, or less, rises at once.
const AT_ONCE: f64 = 1e-3;
/// A contact that lasts so many times of the wave, or more, is that of a rigid bar.
const RIGID: f64 = 60.0;

/// What a bar does on a wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BarOnWall {
    /// Waves shape it.
    Waves(BarImpact),
    /// The contact is so soft that the bar moves as one piece.
    OnePiece,
}

impl UniformBeam {
    /// Time in which the force of a bar on a wall rises to that of the wave `Z v`, were its rate that of the start: the penetration
    /// that has this force, over the speed \[s\]; zero for a rigid contact. None where the law does not reach it.
    pub fn rise_time(&self, speed: f64, law: impl Fn(f64) -> f64) -> Option<f64> {
        let force = self.bar_impedance() * speed;
        let mut high = speed * f64::EPSILON;
        (0..200).find(|_| {
            let reached = law(high) >= force;
            high *= if reached { 1.0 } else { 4.0 };
            reached
        })?;
        let mut low = 0.0;
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            *(if law(middle) < force { &mut low } else { &mut high }) = middle;
        }
        Some(high / speed)
    }

    /// Impedance of longitudinal waves, `Z = EA/c` \[kg/s\].
    pub fn bar_impedance(&self) -> f64 {
        self.axial / self.bar_speed()
    }

    /// A bar of the given length \[m\] that flies lengthwise at `speed` \[m/s\] against a rigid wall, with a force between them
    /// that follows from the penetration \[m\] and its rate \[m/s\]. None where the force rises too slowly to tell.
    ///
    /// D'Alembert's waves: the end moves with `v - F/Z + 2 r`, r the wave that comes back from the free end,
    /// `r(t) = r(t - 2L/c) - F(t - 2L/c)/Z`. On a spring k the force is `Z v (1 - exp(-k t/Z))` until the wave is back.
    pub fn bar_on_wall(
        &self,
        length: f64,
        speed: f64,
        law: impl Fn(f64, f64) -> f64,
    ) -> Option<BarOnWall> {
        let (impedance, back) = (self.bar_impedance(), 2.0 * length / self.bar_speed());
        let rise = self.rise_time(speed, |p| law(p, 0.0))?;
        if rise <= AT_ONCE * back {
            return Some(BarOnWall::Waves(self.bar_impact(length, speed)));
        }
        // Half a period of the rigid bar on the secant of its contact, about.
        if (rise * back).sqrt() > RIGID * back {
            return Some(BarOnWall::OnePiece);
        }
        let steps = (STEPS * (back / rise).max(10.0)).ceil() as usize;
        let h = back / steps as f64;
        let most = steps.saturating_mul(6 * RIGID as usize).min(2_000_000);
        let (mut forces, mut waves) = (Vec::new(), Vec::new());
        let (mut p, mut peak, mut impulse) = (0.0, 0.0_f64, 0.0);
        for n in 0..most {
            // The wave in the middle of the step.
            let earlier = |k: usize, values: &[f64]| values.get(k).copied().unwrap_or(0.0);
            let wave = n
                .checked_sub(steps)
                .map_or(0.0, |k| earlier(k, &waves) - earlier(k, &forces) / impedance);
            let coming = speed + 2.0 * wave;
            // The force in the middle of the step, of a penetration that it slows down itself.
            let mut f = if n > 0 { forces[n - 1] } else { 0.0 };
            for _ in 0..60 {
                let rate = coming - f / impedance;
                let next = law((p + 0.5 * h * rate).max(0.0), rate).max(0.0);
                let settled = (next - f).abs() <= 1e-13 * next;
                f = next;
                if settled {
                    break;
                }
            }
            let next = p + h * (coming - f / impedance);
            forces.push(f);
            waves.push(wave);
            peak = peak.max(f);
            impulse += h * f;
            if next <= 0.0 && n > 0 {
                let duration = h * (n as f64 + p / (p - next));
                return Some(BarOnWall::Waves(BarImpact { force: peak, duration, impulse }));
            }
            p = next;
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::super::{linear_impact, near};
    use super::*;

    const BAR: UniformBeam = UniformBeam { axial: 2e8, bending: 1.0, mass: 300.0, rotary: 0.0 };

    fn waves(found: Option<BarOnWall>) -> BarImpact {
        match found {
            Some(BarOnWall::Waves(impact)) => impact,
            _ => BarImpact { force: f64::NAN, duration: f64::NAN, impulse: f64::NAN },
        }
    }

    /// Until the wave is back the force is `Z v (1 - exp(-k t/Z))`, and afterwards it falls.
    #[test]
    fn the_force_on_a_spring_rises_as_the_closed_form_says() {
        let (length, speed, z) = (3.0, 0.5, BAR.bar_impedance());
        let back = 2.0 * length / BAR.bar_speed();
        for stiffness in [0.3, 1.0, 5.0, 30.0].map(|x| x * z / back) {
            let impact = waves(BAR.bar_on_wall(length, speed, |p, _| stiffness * p));
            let force = z * speed * (1.0 - (-stiffness * back / z).exp());
            near(impact.force.max(force), impact.force, 2e-3);
            if stiffness * back / z >= 5.0 {
                near(impact.force, force, 2e-3);
                assert!(impact.duration > back, "{impact:?}");
            }
            // All momentum is taken, and no more than twice of it given.
            let momentum = BAR.mass * length * speed;
            assert!((1.0..=2.0 + 1e-3).contains(&(impact.impulse / momentum)), "{impact:?}");
        }
    }

    /// A soft contact throws the bar back as one piece, a hard one as Saint-Venant says.
    #[test]
    fn soft_and_hard_contacts_have_their_limits() {
        let (length, speed) = (3.0, 0.5);
        let back = 2.0 * length / BAR.bar_speed();
        let mass = BAR.mass * length;
        let soft = mass * (std::f64::consts::PI / (30.0 * back)).powi(2);
        let (impact, rigid) = (
            waves(BAR.bar_on_wall(length, speed, |p, _| soft * p)),
            linear_impact(mass, soft, speed),
        );
        near(impact.duration, rigid.duration, 0.01);
        near(impact.force, rigid.peak_force, 0.03);
        near(impact.impulse, 2.0 * mass * speed, 0.01);
        let hard = waves(BAR.bar_on_wall(length, speed, |p, _| 1e14 * p));
        assert_eq!(hard, BAR.bar_impact(length, speed));
        let softer = mass * (std::f64::consts::PI / (1e4 * back)).powi(2);
        let found = BAR.bar_on_wall(length, speed, |p, _| softer * p);
        assert_eq!(found, Some(BarOnWall::OnePiece));
    }
}
