//! An impact on a structure known by its modes, under any contact law.

use super::UniformBeam;

/// What strikes: a mass, or two with a spring between.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Striker {
    /// Mass that touches \[kg\].
    pub mass: f64,
    /// A mass behind it \[kg\], the stiffness \[N/m\] and the damping \[N s/m\] between, shape (3) \[kg, N/m, N s/m\].
    pub rear: Option<[f64; 3]>,
    /// Speed of approach \[m/s\].
    pub speed: f64,
    /// Acceleration by which it is pressed on \[m/s^2\].
    pub pull: f64,
}

/// A structure by its modes of unit modal mass.
#[derive(Clone, Debug, PartialEq)]
pub struct ModalTarget {
    /// For each mode the square of its angular frequency and its displacement at the struck point along the impact, shape (modes, 2)
    /// \[1/s^2, kg^-1/2\].
    pub modes: Vec<[f64; 2]>,
}

/// The first contact with a [`ModalTarget`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModalImpact {
    /// Largest force \[N\].
    pub peak_force: f64,
    /// Time from touch to release \[s\].
    pub duration: f64,
    /// Largest displacement of the struck point along the impact \[m\].
    pub deflection: f64,
}

/// One degree of freedom of the penetration.
#[derive(Clone, Copy, Debug)]
struct Oscillator {
    squared: f64,
    damping: f64,
    /// Its part in the penetration.
    part: f64,
    /// Force that acts on it all the time.
    pressed: f64,
    place: f64,
    rate: f64,
}

/// Halvings that find the force of a step.
const HALVINGS: usize = 60;
/// Places within a step at which the force is looked at.
const INSIDE: usize = 8;

impl Striker {
    /// Its own degrees of freedom: the common motion, and that against the mass behind it.
    fn oscillators(&self) -> Vec<Oscillator> {
        let behind = self.rear.map_or(0.0, |[mass, ..]| mass);
        let all = self.mass + behind;
        let root = all.sqrt();
        let together = Oscillator {
            squared: 0.0,
            damping: 0.0,
            part: 1.0 / root,
            pressed: root * self.pull,
            place: 0.0,
            rate: root * self.speed,
        };
        let apart = self.rear.map(|[behind, stiffness, damping]| {
            let reduced = self.mass * behind / all;
            let part = behind / all / reduced.sqrt();
            let (squared, damping) = (stiffness / reduced, damping / reduced);
            Oscillator { squared, damping, part, pressed: 0.0, place: 0.0, rate: 0.0 }
        });
        std::iter::once(together).chain(apart).collect()
    }
}

impl Oscillator {
    /// Place and rate after a step of `h` by the midpoint rule, under a contact force.
    fn after(&self, h: f64, force: f64) -> [f64; 2] {
        let (a, b) = (0.25 * self.squared * h * h, 0.5 * self.damping * h);
        let given = h * (self.pressed - self.part * force - self.squared * self.place);
        let rate = (self.rate * (1.0 - a - b) + given) / (1.0 + a + b);
        [self.place + 0.5 * h * (self.rate + rate), rate]
    }

    /// Way in the penetration that a unit force takes back within a step.
    fn gives(&self, h: f64) -> f64 {
        let (a, b) = (0.25 * self.squared * h * h, 0.5 * self.damping * h);
        0.5 * h * h * self.part * self.part / (1.0 + a + b)
    }
}

impl ModalTarget {
    /// The same structure with shear deformation, to first order: a bending wave of wave number k has its frequency squared over `1 +
    /// EI k^2/S`, S the shear stiffness, and `k^2 = w sqrt(rhoA/EI)`. On a pinned span the compliance is then that of bending plus
    /// `L/(4 S)`, exactly.
    pub fn sheared(&self, section: &UniformBeam, shear: f64) -> Self {
        let slow = section.bending / shear * (section.mass / section.bending).sqrt();
        let modes = self.modes.iter().map(|[w2, shape]| [w2 / (1.0 + slow * w2.sqrt()), *shape]);
        Self { modes: modes.collect() }
    }

    /// Static displacement of the struck point under a unit force \[m/N\], of these modes alone; infinite where nothing holds it.
    pub fn compliance(&self) -> f64 {
        self.modes.iter().map(|[squared, shape]| shape * shape / squared).sum()
    }

    /// The first contact in steps of `h` \[s\], which begins `early` \[s\] after a step does. `over` is the force over a step, of the
    /// penetrations at its ends \[m\] and its size \[s\]; `force` that of a penetration and its rate \[m/s\]. None where it has
    /// not ended after `most` steps.
    ///
    /// With `p = x - w`, `M x'' = -F + M g` and `q_i'' + w_i^2 q_i = phi_i F`, by the midpoint rule, the force over the step that
    /// of the law between its ends: the schemes of the midpoint family do the same with a linear structure.
    pub fn impact(
        &self,
        striker: &Striker,
        [h, early]: [f64; 2],
        most: usize,
        over: impl Fn(f64, f64, f64) -> f64,
        force: impl Fn(f64, f64) -> f64,
    ) -> Option<ModalImpact> {
        let target = self.modes.iter().map(|&[squared, shape]| Oscillator {
            squared,
            damping: 0.0,
            part: -shape,
            pressed: 0.0,
            place: 0.0,
            rate: 0.0,
        });
        let mut all: Vec<Oscillator> = striker.oscillators().into_iter().chain(target).collect();
        let gives: f64 = all.iter().map(|one| one.gives(h)).sum();
        let way = early * striker.speed;
        let (mut p, mut rate) = (-way, striker.speed);
        let (mut peak_force, mut deflection, mut touched) = (0.0_f64, 0.0_f64, None);
        let own = striker.oscillators().len();
        for n in 0..most {
            let free: f64 =
                all.iter().map(|one| one.part * one.after(h, 0.0)[0]).sum::<f64>() - way;
            let f = step_force(|f| over(p, free - gives * f, h));
            for one in &mut all {
                [one.place, one.rate] = one.after(h, f);
            }
            let next = free - gives * f;
            let next_rate: f64 = all.iter().map(|one| one.part * one.rate).sum();
            if !next.is_finite() {
                return None;
            }
            let way = all[own..].iter().map(|one| -one.part * one.place).sum();
            deflection = deflection.max(way);
            peak_force = peak_force.max(within([p, rate, next, next_rate], h, &force));
            let start = h * n as f64;
            if touched.is_none() && next > 0.0 {
                touched = Some(start + h * (-p).max(0.0) / (next - p));
            }
            if let Some(touch) = touched
                && next <= 0.0
            {
                let end = start + h * p.max(0.0) / (p - next);
                return Some(ModalImpact { peak_force, duration: end - touch, deflection });
            }
            (p, rate) = (next, next_rate);
        }
        None
    }
}

/// The force that the law gives for the penetration it leads to, which falls with it.
fn step_force(law: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (0.0, law(0.0));
    if high <= 0.0 {
        return 0.0;
    }
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        *(if law(middle) > middle { &mut low } else { &mut high }) = middle;
        if high - low <= 1e-12 * high {
            break;
        }
    }
    0.5 * (low + high)
}

/// Largest force within a step, on the cubic through penetrations and rates at its ends.
fn within([a, da, b, db]: [f64; 4], h: f64, force: impl Fn(f64, f64) -> f64) -> f64 {
    let at = |k: usize| {
        let x = k as f64 / INSIDE as f64;
        let n = percuss::math::hermite::shape(x, h);
        let d = percuss::math::hermite::slope(x, h);
        let sum = |w: [f64; 4]| w[0] * a + w[1] * da + w[2] * b + w[3] * db;
        let p = sum(n);
        if p > 0.0 { force(p, sum(d)) } else { 0.0 }
    };
    (0..=INSIDE).map(at).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::super::{TwoMasses, linear_impact, near, reduced_mass};
    use super::*;

    const LINEAR: f64 = 3e6;

    fn on(target: &ModalTarget, striker: &Striker, h: f64) -> ModalImpact {
        let over = |a: f64, b: f64, _: f64| {
            let (a, b) = (a.max(0.0), b.max(0.0));
            0.5 * LINEAR * (a + b)
        };
        let impact = target.impact(striker, [h, 0.0], 100_000, over, |p, _| LINEAR * p);
        impact.unwrap_or(ModalImpact {
            peak_force: f64::NAN,
            duration: f64::NAN,
            deflection: f64::NAN,
        })
    }

    #[test]
    fn a_target_without_modes_is_rigid() {
        let striker = Striker { mass: 5.0, rear: None, speed: 2.0, pull: 0.0 };
        let rigid = linear_impact(5.0, LINEAR, 2.0);
        let impact = on(&ModalTarget { modes: Vec::new() }, &striker, 1e-3 * rigid.duration);
        near(impact.duration, rigid.duration, 1e-5);
        near(impact.peak_force, rigid.peak_force, 1e-5);
    }

    #[test]
    fn one_mode_without_stiffness_is_a_free_mass() {
        let striker = Striker { mass: 5.0, rear: None, speed: 2.0, pull: 0.0 };
        let two = linear_impact(reduced_mass([5.0, 2.0]), LINEAR, 2.0);
        let target = ModalTarget { modes: vec![[0.0, 1.0 / 2.0_f64.sqrt()]] };
        let impact = on(&target, &striker, 1e-3 * two.duration);
        near(impact.duration, two.duration, 1e-5);
        near(impact.peak_force, two.peak_force, 1e-5);
    }

    #[test]
    fn one_mode_is_a_second_mass_on_a_second_spring() {
        let pair = TwoMasses { mass: 5.0, contact: LINEAR, span_mass: 2.0, span_stiffness: 4e5 };
        let target = ModalTarget { modes: vec![[4e5 / 2.0, 1.0 / 2.0_f64.sqrt()]] };
        let striker = Striker { mass: 5.0, rear: None, speed: 2.0, pull: 0.0 };
        let expected = pair.impact(2.0);
        let impact = on(&target, &striker, 2e-6);
        near(impact.duration, expected.map_or(f64::NAN, |b| b.duration), 1e-3);
        near(impact.peak_force, expected.map_or(f64::NAN, |b| b.peak_force), 1e-3);
        // Still growing at release, and looked at there at four hundred instants of half a period.
        near(impact.deflection, expected.map_or(f64::NAN, |b| b.deflection), 5e-3);
    }

    /// A mass behind a very stiff spring is one with the front, behind a very soft one it takes no part.
    #[test]
    fn a_mass_behind_takes_part_as_its_spring_lets_it() {
        let rigid = ModalTarget { modes: Vec::new() };
        for (spring, mass) in [(1e12, 9.0), (1e-3, 5.0)] {
            let rear = Some([4.0, spring, 0.0]);
            let striker = Striker { mass: 5.0, rear, speed: 2.0, pull: 0.0 };
            let expected = linear_impact(mass, LINEAR, 2.0);
            let impact = on(&rigid, &striker, 1e-3 * expected.duration);
            near(impact.duration, expected.duration, 1e-3);
            near(impact.peak_force, expected.peak_force, 1e-3);
        }
    }

    /// A pinned span by its modes: its compliance is `L^3/(48 EI)`, with shear `L/(4 S)` more.
    #[test]
    fn shear_adds_its_own_compliance() {
        let (length, shear) = (2.0_f64, 5e6);
        let section = UniformBeam { axial: 1e9, bending: 3e5, mass: 40.0, rotary: 0.0 };
        let mode = |n: u32| {
            let k = std::f64::consts::PI * f64::from(2 * n + 1) / length;
            let shape = (2.0 / (section.mass * length)).sqrt();
            [section.bending / section.mass * k.powi(4), shape]
        };
        let span = ModalTarget { modes: (0..4000).map(mode).collect() };
        let bending = length.powi(3) / (48.0 * section.bending);
        near(span.compliance(), bending, 1e-9);
        near(span.sheared(&section, shear).compliance(), bending + length / (4.0 * shear), 1e-4);
    }
}
