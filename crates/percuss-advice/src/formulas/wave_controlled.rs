//! A mass that strikes an infinite beam under any contact law: the integral equation of the wave-controlled impact.

use std::f64::consts::PI;

use super::InfiniteBeamImpact;

/// Steps in the time the contact would last on a rigid target. Forces and times are then exact to 3e-6, velocities to 1e-5, as
/// the closed form for a linear spring shows.
const STEPS: usize = 500;

/// A mass M \[kg\] that strikes a beam without end at `speed` V \[m/s\].
///
/// A Bernoulli beam gives way under a force F by `w(t) = 2/(C sqrt(pi)) int F(s) sqrt(t - s) ds`, `C = 2 sqrt2 EI^(1/4)
/// rhoA^(3/4)`, so that the penetration is
///
/// `p(t) = V t - 1/M int F(s) (t - s) ds - w(t)`
///
/// and F follows from p and its rate by the contact law. (S. Timoshenko, Zur Frage nach der Wirkung eines Stosses auf einen
/// Balken, Z. Math. Phys. 62, 1913, has the sum over modes of a span instead of w.) Solved step by step with a force
/// that is linear within each.
#[derive(Clone, Copy, Debug)]
pub struct WaveControlled {
    /// Mass of the projectile \[kg\].
    pub mass: f64,
    /// Its speed \[m/s\].
    pub speed: f64,
    /// Bending stiffness of the beam \[N m^2\].
    pub bending: f64,
    /// Its mass per length \[kg/m\].
    pub mass_per_length: f64,
    /// Acceleration that presses the projectile on, that of its weight \[m/s^2\].
    pub pull: f64,
    /// What the beam gives way beyond Bernoulli's beam, see [`UniformBeam::softening`](super::UniformBeam::softening); zero for
    /// Bernoulli's \[s\].
    pub softening: f64,
}

/// What a force, linear between the steps, has done by a later one: weights of its values, the later one's own first.
struct Memory {
    /// On the penetration, shape (steps) \[N/m\].
    way: Vec<f64>,
    /// On its rate, shape (steps) \[N s/m\].
    rate: Vec<f64>,
}

impl WaveControlled {
    /// The contact under a force law of the penetration \[m\] and its rate \[m/s\]; on a rigid target it would last `lasts` \[s\].
    pub fn impact(&self, law: impl Fn(f64, f64) -> f64, lasts: f64) -> InfiniteBeamImpact {
        let h = lasts / STEPS as f64;
        let memory = self.memory(h);
        let (mut force, mut before) = (vec![0.0], 0.0);
        let mut released = None;
        // As with a linear spring, a projectile that has not left after twice that time stays.
        for n in 1..=2 * STEPS {
            let past = |weights: &[f64]| -> f64 {
                force.iter().zip(weights[..=n].iter().rev()).map(|(f, w)| f * w).sum()
            };
            let time = h * n as f64;
            let way = (self.speed + 0.5 * self.pull * time) * time - past(&memory.way);
            let rate = self.speed + self.pull * time - past(&memory.rate);
            let mut f = force[n - 1];
            // What the force of this step does to itself is small: the iteration contracts.
            for _ in 0..60 {
                let next = law(way - memory.way[0] * f, rate - memory.rate[0] * f);
                let settled = (next - f).abs() <= 1e-14 * next.abs();
                f = next;
                if settled {
                    break;
                }
            }
            let penetration = way - memory.way[0] * f;
            if penetration <= 0.0 {
                let left = before / (before - penetration);
                released = Some(h * ((n - 1) as f64 + left));
                break;
            }
            force.push(f);
            before = penetration;
        }
        let (peak_time, peak_force) = peak(&force);
        let impulse = h * force.iter().sum::<f64>();
        InfiniteBeamImpact {
            peak_force,
            peak_time: h * peak_time,
            duration: released,
            restitution: released.map(|time| {
                impulse / (self.mass * self.speed) - 1.0 - self.pull * time / self.speed
            }),
        }
    }

    /// Weights for steps of `h`: second differences of what integrates the kernels twice.
    fn memory(&self, h: f64) -> Memory {
        let beam = 2.0 * 2.0_f64.sqrt() * self.bending.powf(0.25) * self.mass_per_length.powf(0.75);
        let kernel = |power: f64, k: usize| {
            let of = |x: f64| x.powf(power);
            let k = k as f64;
            if k == 0.0 { 1.0 } else { of(k + 1.0) - 2.0 * of(k) + of(k - 1.0) }
        };
        let sluggish = 2.0 / (beam * PI.sqrt());
        let way = |k: usize| {
            h * h / (6.0 * self.mass) * kernel(3.0, k)
                + sluggish * h.powf(1.5) * 4.0 / 15.0 * kernel(2.5, k)
                + sluggish * self.softening * h.sqrt() * 2.0 / 3.0 * kernel(1.5, k)
        };
        let rate = |k: usize| {
            h / (2.0 * self.mass) * kernel(2.0, k)
                + 0.5 * sluggish * h.sqrt() * 4.0 / 3.0 * kernel(1.5, k)
                + sluggish * self.softening / h.sqrt() * kernel(0.5, k)
        };
        let steps = 0..=2 * STEPS;
        Memory { way: steps.clone().map(way).collect(), rate: steps.map(rate).collect() }
    }
}

/// Place and height of the peak of values one apart: that of the parabola through the largest three, unless it is a plateau.
fn peak(values: &[f64]) -> (f64, f64) {
    let largest = values.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1));
    let (k, most) = largest.map_or((0, 0.0), |(k, most)| (k, *most));
    if k == 0 || k + 1 >= values.len() {
        return (k as f64, most);
    }
    let (a, c) = (values[k - 1], values[k + 1]);
    if a >= most || c >= most {
        return (k as f64, most);
    }
    let off = 0.5 * (a - c) / (a - 2.0 * most + c);
    (k as f64 + off, most - 0.25 * (a - c) * off)
}

#[cfg(test)]
mod tests {
    use nalgebra::Complex;

    use super::super::{
        InfiniteBeam, UniformBeam, hertz_impact, linear_impact, near, shear_stiffness,
    };
    use super::*;

    /// Benchmark E4 (closed form): EI 166600 N m^2, rhoA 300 kg/m, M 10 kg, k 1e7 N/m, V 0.01 m/s.
    #[test]
    fn a_linear_spring_gives_the_closed_form() {
        let case = WaveControlled {
            mass: 10.0,
            speed: 0.01,
            bending: 166_600.0,
            mass_per_length: 300.0,
            pull: 0.0,
            softening: 0.0,
        };
        let impact = case.impact(|p, _| 1e7 * p.max(0.0), PI * 1e-3);
        near(impact.peak_force, 95.146_518_557, 3e-6);
        near(impact.peak_time, 1.514_508_864_745_7e-3, 3e-6);
        near(impact.restitution.unwrap_or(f64::NAN), 0.860_474_082_7, 1e-5);
    }

    /// Benchmark E7 (Timoshenko 1913): a sphere of steel on a beam of 0.1535 m, 4.9772 N at 72.56 us. Waves come back before
    /// the contact ends, the largest force hardly knows of them.
    #[test]
    fn timoshenkos_sphere_presses_as_on_a_beam_without_end() {
        let (bending, mass_per_length) = (2.157_46e11 * 1e-8 / 12.0, 7960.0 * 1e-4);
        let (mass, speed, stiffness) = (0.033_343, 0.01, 1.580_559e10);
        let case =
            WaveControlled { mass, speed, bending, mass_per_length, pull: 0.0, softening: 0.0 };
        let lasts = hertz_impact(mass, stiffness, speed).duration;
        let impact = case.impact(|p, _| stiffness * p.max(0.0).powf(1.5), lasts);
        near(impact.peak_force, 4.9772, 3e-3);
        near(impact.peak_time, 72.56e-6, 6e-3);
        // On a rigid beam nothing is lost.
        let rigid = WaveControlled { bending: 1e30, ..case };
        let back = rigid.impact(|p, _| stiffness * p.max(0.0).powf(1.5), lasts);
        near(back.restitution.unwrap_or(f64::NAN), 1.0, 1e-5);
        near(back.duration.unwrap_or(f64::NAN), lasts, 1e-5);
    }

    /// A table may yield under a constant force.
    #[test]
    fn a_plateau_of_the_force_is_its_largest() {
        let case = WaveControlled {
            mass: 10.0,
            speed: 1.0,
            bending: 166_600.0,
            mass_per_length: 300.0,
            pull: 0.0,
            softening: 0.0,
        };
        let impact = case.impact(|p, _| (1e7 * p.max(0.0)).min(500.0), 0.05);
        assert_eq!(impact.peak_force, 500.0);
        assert!(impact.peak_time > 0.0, "{impact:?}");
    }

    #[test]
    fn a_heavy_mass_on_a_soft_beam_stays() {
        let case = WaveControlled {
            mass: 1e4,
            speed: 1.0,
            bending: 10.0,
            mass_per_length: 1.0,
            pull: 0.0,
            softening: 0.0,
        };
        let lasts = hertz_impact(case.mass, 1e9, 1.0).duration;
        assert!(case.impact(|p, _| 1e9 * p.max(0.0).powf(1.5), lasts).duration.is_none());
    }

    /// Sum of the closed form's force and that of the weight, `W int phi`, which is `W (1 - velocity)`.
    #[test]
    fn a_weight_adds_the_integral_of_the_force() {
        let (mass, stiffness, speed, pull) = (10.0, 1e7, 0.01, 9.81);
        let beam = InfiniteBeam::of(mass, stiffness, 166_600.0, 300.0);
        let time = (mass / stiffness).sqrt();
        let force = |t: f64| {
            let x = t / time;
            speed * (stiffness * mass).sqrt() * beam.force(x)
                + mass * pull * (1.0 - beam.velocity(x))
        };
        let case = WaveControlled {
            mass,
            speed,
            bending: 166_600.0,
            mass_per_length: 300.0,
            pull,
            softening: 0.0,
        };
        let impact = case.impact(|p, _| stiffness * p.max(0.0), 5e-3);
        let most = (1..5000).map(|k| force(1e-6 * f64::from(k))).fold(0.0, f64::max);
        near(impact.peak_force, most, 2e-5);
        near(impact.peak_force, force(impact.peak_time), 2e-5);
        let released = impact.duration.unwrap_or(f64::NAN);
        assert!(force(released).abs() < 1e-3 * most, "{released}");
    }

    /// Against the driving point of Timoshenko's beam without end, exact in Laplace space, taken back by Talbot's method: 5 kg
    /// behind 3e9 N/m on a beam of 50 x 200 mm. Bernoulli's beam is 8 % off, the first order a tenth of one.
    #[test]
    fn rotary_inertia_and_shear_change_the_force_as_timoshenkos_beam_does() {
        let section =
            UniformBeam { axial: 2.1e9, bending: 7e6, mass: 78.5, rotary: 7850.0 * 3.3333e-5 };
        let (mass, stiffness, speed) = (5.0, 3e9, 1.0);
        let of = |softening| WaveControlled {
            mass,
            speed,
            bending: section.bending,
            mass_per_length: section.mass,
            pull: 0.0,
            softening,
        };
        let lasts = linear_impact(mass, stiffness, speed).duration;
        let impact =
            |softening| of(softening).impact(|p, _| stiffness * p.max(0.0), lasts).peak_force;
        let shear = shear_stiffness(section.axial);
        let (plain, soft) = (impact(0.0), impact(section.softening(shear)));
        let exact = talbot_peak(&section, shear, [mass, stiffness, speed], lasts);
        assert!((plain / exact - 1.0).abs() > 0.07, "{plain} {exact}");
        assert!((soft / exact - 1.0).abs() < 5e-3, "{plain} {soft} {exact}");
    }

    /// Largest force of a mass behind a spring on Timoshenko's beam: `1/k + 1/(M s^2) + Y(s)` under `V/s^2`, on the contour of
    /// Trefethen, Weideman and Schmelzer 2006.
    fn talbot_peak(
        section: &UniformBeam,
        shear: f64,
        [mass, stiffness, speed]: [f64; 3],
        lasts: f64,
    ) -> f64 {
        let beam = |s: Complex<f64>| {
            let turning = s * s * (section.rotary / shear) + 1.0;
            let ab = s * (section.mass / section.bending).sqrt() * turning.sqrt();
            let squares = s * s * (section.rotary / section.bending + section.mass / shear);
            let both = (squares + ab * 2.0).sqrt();
            (turning / ab + section.bending / shear) / (both * (2.0 * section.bending))
        };
        let at = |z: Complex<f64>| {
            let inertia = (z * z * mass).inv();
            Complex::from(speed) / (z * z) / (inertia + beam(z) + 1.0 / stiffness)
        };
        let n = 32;
        let force = |t: f64| {
            let sum = (0..n).map(|k| {
                let angle = PI * (2.0 * f64::from(k) + 1.0) / f64::from(n) - PI;
                let (sine, cosine) = (0.6407 * angle).sin_cos();
                let scale = f64::from(n) / t;
                let z = Complex::new(-0.6122 + 0.5017 * angle * cosine / sine, 0.2645 * angle);
                let slope = 0.5017 * (cosine / sine - 0.6407 * angle / (sine * sine));
                let z = z * scale;
                ((z * t).exp() * at(z) * Complex::new(slope, 0.2645) * scale).im
            });
            sum.sum::<f64>() / f64::from(n)
        };
        (1..200).map(|k| force(lasts * f64::from(k) / 200.0)).fold(0.0, f64::max)
    }
}
