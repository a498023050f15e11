//! Waves in a uniform bar or beam.

use std::f64::consts::PI;

/// Constants of a uniform beam, per length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UniformBeam {
    /// Axial stiffness EA \[N\].
    pub axial: f64,
    /// Bending stiffness EI \[N m^2\].
    pub bending: f64,
    /// Mass rhoA \[kg/m\].
    pub mass: f64,
    /// Rotary inertia rhoI \[kg m\]; zero for a Bernoulli beam.
    pub rotary: f64,
}

/// A bar that flies lengthwise against a rigid wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BarImpact {
    /// Force from touch to release, constant \[N\].
    pub force: f64,
    /// Time from touch to release \[s\].
    pub duration: f64,
    /// Impulse \[N s\].
    pub impulse: f64,
}

/// End of the main lobe of the spectrum of a half-sine pulse, `3 pi / T` \[rad/s\], for its duration T \[s\]: beyond it there is
/// next to nothing. (The spectrum is proportional to `cos(w T/2) / (1 - (w T/pi)^2)`.)
pub fn pulse_frequency(duration: f64) -> f64 {
    3.0 * PI / duration
}

/// Young's modulus over the shear modulus at Poisson's ratio 0.3.
const YOUNG_OVER_SHEAR: f64 = 2.6;
/// Share of a full rectangle's area that carries shear.
pub(crate) const SHEAR_AREA: f64 = 5.0 / 6.0;

/// Shear stiffness `kappa G A` \[N\] of a full rectangle with Poisson's ratio 0.3 whose axial stiffness EA \[N\] is given: beams
/// here have no shear deformation, this is for estimates of what it would do. A tube has some 0.6, an I-section across its
/// flanges some 0.3 to 0.5 of it.
pub fn shear_stiffness(axial: f64) -> f64 {
    axial * SHEAR_AREA / YOUNG_OVER_SHEAR
}

impl UniformBeam {
    /// Radius of gyration, the root of bending over axial stiffness \[m\].
    pub(crate) fn gyration(&self) -> f64 {
        (self.bending / self.axial).sqrt()
    }

    /// First order of rotary inertia and shear in what a beam without end gives way to a force across it, D in `(1 + D s)/(C
    /// s^(3/2))` of Laplace space \[s\]; `shear` is the shear stiffness \[N\], infinite for Rayleigh's beam.
    ///
    /// Timoshenko's beam has `Y(s) = ((1 + rhoI s^2/S)/(a b) + EI/S) / (2 EI (a + b))`, `(a b)^2 = rhoA s^2/EI (1 + rhoI s^2/S)`,
    /// `a^2 + b^2 = s^2 (rhoI/EI + rhoA/S)`; for small s, `D = sqrt(rhoA/EI) (3/4 EI/S - 1/4 rhoI/rhoA)`.
    pub fn softening(&self, shear: f64) -> f64 {
        (self.mass / self.bending).sqrt()
            * (0.75 * self.bending / shear - 0.25 * self.rotary / self.mass)
    }

    /// Speed of longitudinal waves, `sqrt(EA / rhoA)` \[m/s\].
    pub fn bar_speed(&self) -> f64 {
        (self.axial / self.mass).sqrt()
    }

    /// Wave number of free bending waves \[1/m\] of angular frequency `frequency` \[rad/s\].
    ///
    /// Rayleigh's beam: `EI k^4 = w^2 (rhoA + rhoI k^2)` (K. F. Graff, Wave Motion in Elastic Solids, 1975, section 3.4).
    pub fn wave_number(&self, frequency: f64) -> f64 {
        let squared = frequency * frequency;
        let turning = self.rotary * squared;
        let root = (turning * turning + 4.0 * self.bending * self.mass * squared).sqrt();
        ((turning + root) / (2.0 * self.bending)).sqrt()
    }

    /// Length of free bending waves of angular frequency `frequency` \[rad/s\], in \[m\].
    pub fn wavelength(&self, frequency: f64) -> f64 {
        2.0 * PI / self.wave_number(frequency)
    }

    /// Group velocity of bending waves \[m/s\] of angular frequency `frequency` \[rad/s\]: how fast their energy travels.
    /// `2 (EI/rhoA)^(1/4) sqrt(w)` without rotary inertia.
    pub fn group_velocity(&self, frequency: f64) -> f64 {
        let k = self.wave_number(frequency);
        let inertia = self.mass + self.rotary * k * k;
        // d/dk of w^2 = EI k^4 / (rhoA + rhoI k^2), over 2 w.
        self.bending * k.powi(3) * (2.0 * self.mass + self.rotary * k * k)
            / (inertia * inertia * frequency)
    }

    /// Time in which the fastest bending wave of weight in a pulse of the given duration \[s\] travels `distance` \[m\] and back.
    pub fn return_time(&self, distance: f64, duration: f64) -> f64 {
        2.0 * distance / self.group_velocity(pulse_frequency(duration))
    }

    /// Distance beyond which nothing of weight comes back while a pulse of the given duration \[s\] lasts \[m\].
    pub fn least_distance(&self, duration: f64) -> f64 {
        0.5 * duration * self.group_velocity(pulse_frequency(duration))
    }

    /// A bar of the given length \[m\] that flies lengthwise at `speed` \[m/s\] against a rigid wall: force `EA v/c` while a wave
    /// runs up and down it once, `2 L/c` (A. de Saint-Venant; S. Timoshenko and J. N. Goodier, Theory of Elasticity,
    /// chapter on longitudinal impact of bars).
    pub fn bar_impact(&self, length: f64, speed: f64) -> BarImpact {
        let wave = self.bar_speed();
        BarImpact {
            force: self.axial * speed / wave,
            duration: 2.0 * length / wave,
            impulse: 2.0 * self.mass * length * speed,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::near;
    use super::*;

    fn plank(rotary: f64) -> UniformBeam {
        UniformBeam { axial: 2e8, bending: 166_600.0, mass: 300.0, rotary }
    }

    #[test]
    fn bending_waves_follow_their_equation_of_motion() {
        for rotary in [0.0, 0.2499] {
            let beam = plank(rotary);
            for frequency in [1.0, 300.0, 2e4, 3e6] {
                let k = beam.wave_number(frequency);
                let inertia = frequency * frequency * (beam.mass + beam.rotary * k * k);
                near(beam.bending * k.powi(4), inertia, 1e-12);
            }
        }
    }

    #[test]
    fn group_velocity_is_the_slope_of_the_dispersion_curve() {
        for rotary in [0.0, 0.2499] {
            let beam = plank(rotary);
            for frequency in [1.0, 300.0, 2e4, 3e6] {
                let step = 1e-5 * frequency;
                let ahead = beam.wave_number(frequency + step);
                let behind = beam.wave_number(frequency - step);
                near(beam.group_velocity(frequency), 2.0 * step / (ahead - behind), 1e-7);
            }
        }
        let bernoulli = 2.0 * (166_600.0_f64 / 300.0).powf(0.25) * 300.0_f64.sqrt();
        near(plank(0.0).group_velocity(300.0), bernoulli, 1e-14);
    }

    /// With the rotary inertia of the material the energy of no bending wave travels faster than at `4 sqrt(2/27)` times the speed
    /// of longitudinal waves, and that of very short ones at that speed.
    #[test]
    fn no_wave_of_a_rayleigh_beam_is_much_faster_than_sound() {
        let beam = UniformBeam { axial: 2e8, bending: 166_600.0, mass: 300.0, rotary: 0.2499 };
        let fastest = 4.0 * (2.0_f64 / 27.0).sqrt() * beam.bar_speed();
        let found = (0..1200).map(|k| beam.group_velocity(10_f64.powf(0.01 * f64::from(k))));
        near(found.fold(0.0, f64::max), fastest, 1e-4);
        near(beam.group_velocity(1e12), beam.bar_speed(), 1e-6);
    }

    #[test]
    fn the_least_distance_is_that_from_which_a_wave_returns_at_the_end_of_the_pulse() {
        let beam = plank(0.2499);
        let distance = beam.least_distance(3.08e-3);
        near(beam.return_time(distance, 3.08e-3), 3.08e-3, 1e-14);
    }

    /// ANSYS verification case VM265 (Carpenter, Taylor and Katona 1991) and code_aster SDNV100.
    #[test]
    fn a_bar_on_a_wall_has_the_published_force_and_duration() {
        let bar = UniformBeam { axial: 3e7, bending: 1.0, mass: 0.73e-3, rotary: 0.0 };
        let impact = bar.bar_impact(10.0, 202.2);
        near(impact.force, 29_922.867, 1e-6);
        near(impact.duration, 1.481_136_41e-4 - 4.945_598_4e-5, 1e-6);
        near(impact.force * impact.duration, impact.impulse, 1e-14);
        let bar = UniformBeam { axial: 8e7, bending: 1.0, mass: 3.2, rotary: 0.0 };
        let impact = bar.bar_impact(0.2, 100.0);
        near(impact.force, 1.6e6, 1e-14);
        near(impact.duration, 8e-5, 1e-14);
    }
}
