//! Evaluation of the increment of a step in a scheme.

use crate::settings::Scheme;

/// A scheme on a step of given size: how velocity and acceleration follow from the increment `d = x1 - x0`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Integration {
    /// Step size \[s\].
    pub h: f64,
    /// Instant of the acting forces between the ends of the step.
    pub rule: Rule,
}

/// The internal counterpart of [`Scheme`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rule {
    /// `v1 = 2 d/h - v0`, inertia `M (v1 - v0)/h`.
    Midpoint(MidpointForces),
    /// Newmark's family with accelerations.
    Alpha(AlphaWeights),
    /// Equilibrium at the end of the step: no inertia.
    Static,
}

/// Internal forces of the midpoint family.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MidpointForces {
    /// Discrete gradient through invariants.
    Invariant,
    /// Strains advanced by their midpoint rates.
    StrainRate,
    /// Forces at the midpoint configuration.
    Collocated,
}

/// Weights of generalized-alpha: `alpha_m`, `alpha_f` weigh the start of the step, beta and gamma are Newmark's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AlphaWeights {
    /// Weight of the start in the inertia.
    pub alpha_m: f64,
    /// Weight of the start in the forces.
    pub alpha_f: f64,
    /// Newmark's beta.
    pub beta: f64,
    /// Newmark's gamma.
    pub gamma: f64,
}

impl AlphaWeights {
    /// Average acceleration.
    const NEWMARK: Self = Self { alpha_m: 0.0, alpha_f: 0.0, beta: 0.25, gamma: 0.5 };

    /// Optimal weights for a spectral radius at infinite frequency (Chung and Hulbert 1993, eqs. 17, 20, 25).
    fn chung_hulbert(radius: f64) -> Self {
        let alpha_m = (2.0 * radius - 1.0) / (radius + 1.0);
        let alpha_f = radius / (radius + 1.0);
        let spread = alpha_f - alpha_m;
        Self { alpha_m, alpha_f, beta: 0.25 * (1.0 + spread).powi(2), gamma: 0.5 + spread }
    }
}

impl Integration {
    /// `scheme` on a step of size `h`.
    pub fn new(scheme: Scheme, h: f64) -> Self {
        let rule = match scheme {
            Scheme::EnergyMomentum => Rule::Midpoint(MidpointForces::Invariant),
            Scheme::StrainRate => Rule::Midpoint(MidpointForces::StrainRate),
            Scheme::Midpoint => Rule::Midpoint(MidpointForces::Collocated),
            Scheme::Newmark => Rule::Alpha(AlphaWeights::NEWMARK),
            Scheme::GeneralizedAlpha { spectral_radius } => {
                Rule::Alpha(AlphaWeights::chung_hulbert(spectral_radius))
            }
        };
        Self { h, rule }
    }

    /// The same where forces balance at the start of the step, for schemes that advance accelerations.
    ///
    /// Such a scheme carries the accelerations `alpha_f - alpha_m` of a step before (Arnold, Bruels 2007) from step to step; at the start of a run
    /// they are those of that instant.
    pub fn at_start(&self, of_run: bool) -> Option<Self> {
        let Rule::Alpha(w) = self.rule else { return None };
        let alpha_m = if of_run { 1.0 } else { 1.0 + w.alpha_m - w.alpha_f };
        Some(Self { rule: Rule::Alpha(AlphaWeights { alpha_m, alpha_f: 1.0, ..w }), ..*self })
    }

    /// Whether elastic elements are evaluated side by side ([`sweep`](super::sweep)).
    pub fn sweeps(&self) -> bool {
        self.rule == Rule::Midpoint(MidpointForces::Invariant)
    }

    /// Weight of the end of the step in the configuration where forces are evaluated.
    pub fn theta(&self) -> f64 {
        match self.rule {
            Rule::Midpoint(_) => 0.5,
            Rule::Alpha(w) => 1.0 - w.alpha_f,
            Rule::Static => 1.0,
        }
    }

    /// Increment for zero acceleration.
    pub fn predict(&self, v0: f64, a0: f64) -> f64 {
        match self.rule {
            Rule::Midpoint(_) | Rule::Static => self.h * v0,
            Rule::Alpha(_) => self.h * (v0 + 0.5 * self.h * a0),
        }
    }

    /// The same of nodes: their velocities, and accelerations if the scheme advances them, both of shape (nodes, 4)
    /// \[m/s, 1/s, rad/s\] and \[m/s^2, 1/s^2, rad/s^2\], make their increments.
    pub fn predict_all(&self, v0: &[[f64; 4]], a0: &[[f64; 4]], increment: &mut [[f64; 4]]) {
        let none = [0.0; 4];
        // The rule is selected once: nodes then use vector registers.
        if let Rule::Midpoint(_) = self.rule {
            for (d, v0) in increment.iter_mut().zip(v0) {
                *d = v0.map(|v0| self.h * v0);
            }
            return;
        }
        for (n, (d, v0)) in increment.iter_mut().zip(v0).enumerate() {
            let a0 = a0.get(n).unwrap_or(&none);
            *d = std::array::from_fn(|i| self.predict(v0[i], a0[i]));
        }
    }

    /// Moves nodes by their increments, shape (nodes, 4) \[m, -, rad\]: displacements, velocities, and accelerations if the scheme advances
    /// them, of the same shape.
    pub fn advance_all(
        &self,
        increment: &[[f64; 4]],
        displacement: &mut [[f64; 4]],
        velocity: &mut [[f64; 4]],
        acceleration: &mut [[f64; 4]],
    ) {
        let moved = increment.iter().zip(displacement).zip(velocity);
        if let Rule::Midpoint(_) = self.rule {
            for ((d, u), v) in moved {
                for i in 0..4 {
                    u[i] += d[i];
                    v[i] = 2.0 * d[i] / self.h - v[i];
                }
            }
            return;
        }
        let mut none = [0.0; 4];
        for (n, ((d, u), v)) in moved.enumerate() {
            let a = acceleration.get_mut(n).unwrap_or(&mut none);
            for i in 0..4 {
                let (v0, a0) = (v[i], a[i]);
                u[i] += d[i];
                v[i] = self.velocity(d[i], v0, a0);
                if let Rule::Alpha(_) = self.rule {
                    a[i] = self.acceleration(d[i], v0, a0);
                }
            }
        }
    }

    /// Derivative of [`Integration::inertia`] with respect to the increment \[1/s^2\].
    pub fn inertia_slope(&self) -> f64 {
        match self.rule {
            Rule::Midpoint(_) => 2.0 / (self.h * self.h),
            Rule::Alpha(w) => (1.0 - w.alpha_m) / (w.beta * self.h * self.h),
            Rule::Static => 0.0,
        }
    }

    /// Velocity in the equation of motion, where forces are evaluated.
    #[inline(always)]
    pub fn rate(&self, d: f64, v0: f64, a0: f64) -> f64 {
        match self.rule {
            Rule::Midpoint(_) => d / self.h,
            Rule::Alpha(w) => w.alpha_f * v0 + (1.0 - w.alpha_f) * self.velocity(d, v0, a0),
            Rule::Static => 0.0,
        }
    }

    /// Derivative of [`Integration::rate`] with respect to the increment \[1/s\].
    pub fn rate_slope(&self) -> f64 {
        match self.rule {
            Rule::Midpoint(_) => 1.0 / self.h,
            Rule::Alpha(w) => (1.0 - w.alpha_f) * w.gamma / (w.beta * self.h),
            Rule::Static => 0.0,
        }
    }

    /// A time over the step size; zero in statics, which has no rates.
    pub fn lag(&self, time: f64) -> f64 {
        match self.rule {
            Rule::Midpoint(_) => time / self.h,
            Rule::Alpha(_) | Rule::Static => 0.0,
        }
    }

    /// Acceleration in the equation of motion.
    #[inline(always)]
    pub fn inertia(&self, d: f64, v0: f64, a0: f64) -> f64 {
        match self.rule {
            Rule::Midpoint(_) => 2.0 * (d / self.h - v0) / self.h,
            Rule::Alpha(w) => (1.0 - w.alpha_m) * self.acceleration(d, v0, a0) + w.alpha_m * a0,
            Rule::Static => 0.0,
        }
    }

    /// Acceleration at the end of the step.
    #[inline(always)]
    pub fn acceleration(&self, d: f64, v0: f64, a0: f64) -> f64 {
        match self.rule {
            Rule::Midpoint(_) | Rule::Static => 0.0,
            Rule::Alpha(w) => (d / self.h - v0) / (w.beta * self.h) - (0.5 / w.beta - 1.0) * a0,
        }
    }

    /// Velocity at the end of the step.
    #[inline(always)]
    pub fn velocity(&self, d: f64, v0: f64, a0: f64) -> f64 {
        match self.rule {
            Rule::Midpoint(_) => 2.0 * d / self.h - v0,
            Rule::Static => 0.0,
            Rule::Alpha(w) => {
                let a1 = self.acceleration(d, v0, a0);
                v0 + self.h * ((1.0 - w.gamma) * a0 + w.gamma * a1)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn schemes_reproduce_constant_acceleration() {
        let (h, v0, a) = (0.1, 2.0, -3.0);
        let d = h * v0 + 0.5 * h * h * a;
        for scheme in [
            Scheme::EnergyMomentum,
            Scheme::Newmark,
            Scheme::GeneralizedAlpha { spectral_radius: 0.6 },
        ] {
            let rule = Integration::new(scheme, h);
            assert!((rule.inertia(d, v0, a) - a).abs() < 1e-12);
            assert!((rule.velocity(d, v0, a) - (v0 + h * a)).abs() < 1e-12);
        }
    }
}
