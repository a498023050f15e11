//! Two bodies that meet under a contact law and move as points while they touch: the shortest of all impact theories.

use std::f64::consts::PI;

/// An impact without losses, from touch to release.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SingleMassImpact {
    /// Time from touch to release \[s\].
    pub duration: f64,
    /// Largest force \[N\].
    pub peak_force: f64,
    /// Largest penetration \[m\].
    pub penetration: f64,
}

/// Reduced mass of two free bodies, `m1 m2 / (m1 + m2)` \[kg\]; the other one's mass where one is infinite.
pub fn reduced_mass(masses: [f64; 2]) -> f64 {
    1.0 / (1.0 / masses[0] + 1.0 / masses[1])
}

/// Mass with which a free rigid bar meets an impact across it: `1 / (1/m + a^2/J)` \[kg\], for its mass `mass` \[kg\], moment of
/// inertia about its centre `inertia` \[kg m^2\] and the distance `offset` of the impact from its centre \[m\].
pub fn free_bar_mass(mass: f64, inertia: f64, offset: f64) -> f64 {
    1.0 / (1.0 / mass + offset * offset / inertia)
}

/// A mass \[kg\] at `speed` \[m/s\] against a rigid target, with a linear spring \[N/m\] between: half a period of the spring,
/// `pi sqrt(m/k)`. For two free bodies the mass is the reduced one.
pub fn linear_impact(mass: f64, stiffness: f64, speed: f64) -> SingleMassImpact {
    SingleMassImpact {
        duration: PI * (mass / stiffness).sqrt(),
        peak_force: speed * (mass * stiffness).sqrt(),
        penetration: speed * (mass / stiffness).sqrt(),
    }
}

/// The same under Hertz' law `F = K p^(3/2)`, K in \[N/m^1.5\].
///
/// The energy `2/5 K p^(5/2)` takes up that of the mass: `p_max = (5 m v^2 / (4 K))^(2/5)`. The time is
/// `2 p_max/v` times the integral of `1/sqrt(1 - x^(5/2))` over \[0, 1\], which is `2/5 B(2/5, 1/2)`: in all
/// `2.94327518 p_max/v = 3.21807 (m^2 / (K^2 v))^(1/5)` (K. L. Johnson, Contact Mechanics, 1985, eqs. 11.23 and 11.24).
pub fn hertz_impact(mass: f64, stiffness: f64, speed: f64) -> SingleMassImpact {
    /// `4/5 sqrt(pi) Gamma(2/5) / Gamma(9/10)`.
    const TIME: f64 = 2.943_275_184_320_484_7;
    let penetration = (1.25 * mass * speed * speed / stiffness).powf(0.4);
    SingleMassImpact {
        duration: TIME * penetration / speed,
        peak_force: stiffness * penetration.powf(1.5),
        penetration,
    }
}

/// The same under a force that is a straight line between given values, and beyond the last one; penetrations \[m\] and
/// forces \[N\] from zero on.
///
/// The time is `2 int dp / sqrt(v^2 - 2 V(p)/m)` over the way; with `p = p_max (1 - u^2)` the integrand is smooth at the
/// turning point, so that the midpoint rule serves.
pub fn table_impact(
    penetrations: &[f64],
    forces: &[f64],
    mass: f64,
    speed: f64,
) -> SingleMassImpact {
    const INTERVALS: usize = 4000;
    let law = Lines::new(penetrations, forces);
    let energy = 0.5 * mass * speed * speed;
    let way = law.turning_point(energy);
    let integrand = |k: usize| {
        let u = (k as f64 + 0.5) / INTERVALS as f64;
        let left = energy - law.energy(way * (1.0 - u * u));
        2.0 * u / (left.max(f64::MIN_POSITIVE) / energy).sqrt()
    };
    let sum: f64 = (0..INTERVALS).map(integrand).sum();
    SingleMassImpact {
        duration: 2.0 * way / speed * sum / INTERVALS as f64,
        peak_force: law.force(way),
        penetration: way,
    }
}

/// A force given by points.
struct Lines<'a> {
    /// Penetrations of the points, shape (points) \[m\].
    penetrations: &'a [f64],
    /// Forces there, shape (points) \[N\].
    forces: &'a [f64],
    /// Energy taken up on the way to each point, shape (points) \[J\].
    energies: Vec<f64>,
}

impl<'a> Lines<'a> {
    fn new(penetrations: &'a [f64], forces: &'a [f64]) -> Self {
        let mut energies = vec![0.0; penetrations.len()];
        let mut law = Self { penetrations, forces, energies: Vec::new() };
        for k in 1..penetrations.len() {
            energies[k] = energies[k - 1] + law.of(k - 1);
        }
        law.energies = energies;
        law
    }

    /// Number of the line that holds `p`.
    fn number(&self, p: f64) -> usize {
        let last = self.penetrations.len().saturating_sub(2);
        self.penetrations.partition_point(|x| *x <= p).saturating_sub(1).min(last)
    }

    /// Start of the line that holds `p`, force there and slope.
    fn line(&self, p: f64) -> [f64; 3] {
        self.line_of(self.number(p))
    }

    fn line_of(&self, k: usize) -> [f64; 3] {
        let (x, f) = (self.penetrations, self.forces);
        [x[k], f[k], (f[k + 1] - f[k]) / (x[k + 1] - x[k])]
    }

    fn force(&self, p: f64) -> f64 {
        let [start, force, slope] = self.line(p);
        force + slope * (p - start)
    }

    /// Energy taken up on the way to `p` \[J\].
    fn energy(&self, p: f64) -> f64 {
        let k = self.number(p);
        let [start, force, slope] = self.line_of(k);
        self.energies[k] + (p - start) * (force + 0.5 * slope * (p - start))
    }

    /// Energy taken up on the whole of line `k` \[J\].
    fn of(&self, k: usize) -> f64 {
        let (x, f) = (self.penetrations, self.forces);
        0.5 * (x[k + 1] - x[k]) * (f[k] + f[k + 1])
    }

    /// Where the energy taken up is `energy`; infinite if it never is.
    fn turning_point(&self, energy: f64) -> f64 {
        let lines = self.penetrations.len() - 1;
        let mut left = energy;
        for k in 0..lines {
            let of = self.of(k);
            if left > of && k + 1 < lines {
                left -= of;
                continue;
            }
            let [start, force, slope] = self.line_of(k);
            // The positive root of `slope w^2/2 + force w = left`, without cancellation.
            return start + 2.0 * left / (force + (force * force + 2.0 * slope * left).sqrt());
        }
        f64::INFINITY
    }
}

#[cfg(test)]
mod tests {
    use super::super::near;
    use super::*;

    /// Time and largest penetration by small steps of `m p'' = -f(p)`.
    fn integrated(force: impl Fn(f64) -> f64, mass: f64, speed: f64, h: f64) -> [f64; 2] {
        let (mut p, mut v, mut t, mut most) = (0.0, speed, 0.0, 0.0_f64);
        loop {
            let a0 = -force(p) / mass;
            let next = p + h * v + 0.5 * h * h * a0;
            let a1 = -force(next.max(0.0)) / mass;
            v += 0.5 * h * (a0 + a1);
            if next <= 0.0 {
                return [t + h * p / (p - next), most];
            }
            (p, t, most) = (next, t + h, most.max(next));
        }
    }

    #[test]
    fn a_mass_on_a_spring_touches_for_half_a_period() {
        let impact = linear_impact(500.0, 7.5e5, 20.0);
        let [duration, penetration] = integrated(|p| 7.5e5 * p, 500.0, 20.0, 1e-6);
        near(impact.duration, duration, 1e-7);
        near(impact.penetration, penetration, 1e-7);
        near(impact.peak_force, 7.5e5 * penetration, 1e-7);
    }

    /// Two free rigid masses, 500 and 900 kg, k 7.5e5 N/m, 20 m/s (closed form).
    #[test]
    fn two_free_masses_meet_as_their_reduced_mass() {
        let impact = linear_impact(reduced_mass([500.0, 900.0]), 7.5e5, 20.0);
        near(impact.duration, 0.065_037_147, 1e-8);
        near(impact.peak_force, 310_529.50, 1e-8);
        assert_eq!(reduced_mass([500.0, f64::INFINITY]), 500.0);
    }

    #[test]
    fn a_hertz_contact_takes_the_time_of_its_equation_of_motion() {
        for (mass, stiffness, speed) in [(0.033_343, 1.580_559e10, 0.01), (20.0, 3e7, 4.0)] {
            let impact = hertz_impact(mass, stiffness, speed);
            let force = |p: f64| stiffness * p * p.sqrt();
            let [duration, penetration] = integrated(force, mass, speed, 1e-5 * impact.duration);
            near(impact.duration, duration, 1e-7);
            near(impact.penetration, penetration, 1e-7);
            near(impact.peak_force, force(penetration), 1e-7);
            let law = 3.218_07 * (mass * mass / (stiffness * stiffness * speed)).powf(0.2);
            near(impact.duration, law, 1e-5);
        }
    }

    #[test]
    fn a_table_on_a_straight_line_is_a_linear_spring() {
        let by_table = table_impact(&[0.0, 0.001, 0.002], &[0.0, 750.0, 1500.0], 500.0, 20.0);
        let linear = linear_impact(500.0, 7.5e5, 20.0);
        near(by_table.duration, linear.duration, 1e-8);
        near(by_table.peak_force, linear.peak_force, 1e-12);
        near(by_table.penetration, linear.penetration, 1e-12);
    }

    #[test]
    fn a_buffer_with_a_plateau_takes_the_time_of_its_equation_of_motion() {
        let (way, force) = ([0.0, 0.01, 0.05, 0.06], [0.0, 2e4, 2e4, 9e4]);
        for speed in [0.5, 3.0, 9.0] {
            let impact = table_impact(&way, &force, 100.0, speed);
            let law = Lines::new(&way, &force);
            let [duration, penetration] =
                integrated(|p| law.force(p), 100.0, speed, 1e-5 * impact.duration);
            near(impact.duration, duration, 1e-6);
            near(impact.penetration, penetration, 1e-6);
            near(law.energy(impact.penetration), 50.0 * speed * speed, 1e-12);
        }
    }

    /// A free rigid bar of 900 kg and 3 m struck by 100 kg at 40 m/s, e = 1: impulses at the middle, a quarter off it and the end
    /// (closed form).
    #[test]
    fn a_free_bar_gives_way_more_off_its_centre() {
        let cases = [(0.0, 7200.0), (0.75, 6_697.674_419), (1.5, 5_538.461_538)];
        for (offset, impulse) in cases {
            let bar = free_bar_mass(900.0, 900.0 * 9.0 / 12.0, offset);
            near(2.0 * 40.0 * reduced_mass([100.0, bar]), impulse, 1e-9);
        }
    }
}
