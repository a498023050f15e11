//! How long the first contact lasts, and how far off steps of a given size leave its force.

use std::cell::OnceCell;

use super::case::{Beams, Bodies, Case, Meeting, Struck, force, rigid_impact};
use super::formulas::{ModalImpact, ModalTarget, Striker, UniformBeam};
use super::structure::BeamPlace;
use percuss::math::vec2::{dot, norm};
use percuss::{FirstTouches, Mode, modes_about, reference_state};
use percuss::{Model, Potential, SmoothLaw, TouchLaw};

/// Modes that take part in a contact: with more of them forces change by less than what they are estimated for.
const MODES: usize = 32;
/// Elements beyond which modes are not asked for, so that an estimate takes next to no time.
const ELEMENTS: usize = 3000;
/// Steps of the estimate in a period of the contact spring against what it moves, and most of them.
const STEPS: f64 = 60.0;
const MOST: usize = 60_000;
/// Instants within a step at which a contact may begin, as shares of it.
const EARLY: [f64; 4] = [0.0, 0.27, 0.53, 0.81];
/// Contacts whose durations differ by more than this factor are not the same one.
const SAME: f64 = 2.0;
/// A point that gives way to a unit impulse by less than this share of what the striker does is held.
const HELD: f64 = 1e-12;
/// Modes whose frequencies agree to this share are one motion.
const TOGETHER: f64 = 1e-6;

/// The lowest modes of a structure about its reference, found when they are first asked for.
pub struct Modes<'m> {
    model: &'m Model,
    lowest: OnceCell<Vec<Mode>>,
    touches: OnceCell<FirstTouches<'m>>,
}

/// What the duration of a contact follows from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum From {
    /// A beam without end.
    WithoutEnd,
    /// The structure's lowest modes.
    Modes,
    /// The bodies alone.
    Bodies,
    /// A beam that comes in its lowest motion.
    Comes,
}

/// A contact that is to come.
pub struct Lasting {
    /// Time from touch to release \[s\].
    pub duration: f64,
    pub from: From,
    target: ModalTarget,
    striker: Striker,
    law: SmoothLaw,
    /// Fine step \[s\], and the largest force in such steps \[N\].
    step: f64,
    peak: f64,
    /// Largest displacement of the struck point along the impact \[m\].
    pub deflection: f64,
}

impl<'m> Modes<'m> {
    pub fn new(model: &'m Model) -> Self {
        Self { model, lowest: OnceCell::new(), touches: OnceCell::new() }
    }

    /// These modes; none of a large model.
    pub fn lowest(&self) -> &[Mode] {
        self.lowest.get_or_init(|| {
            if self.model.beam_count() == 0 || self.model.element_count() > ELEMENTS {
                return Vec::new();
            }
            let state = reference_state(self.model);
            state.map_or(Vec::new(), |state| modes_about(self.model, &state, MODES))
        })
    }

    /// The first contact of a case.
    pub fn lasting(&self, case: &Case<'_>) -> Option<Lasting> {
        let law = case.law.smooth()?;
        match &case.meeting {
            Meeting::Struck(struck) => self.struck(struck, case.law, law),
            Meeting::Bodies(two) => bodies(two, law),
            Meeting::Beams(beams) => self.beams(beams, case.index, law),
        }
    }

    /// The struck point by the modes.
    pub fn target(&self, struck: &Struck<'_>) -> ModalTarget {
        let modes = self.lowest().iter().map(|mode| {
            let u = struck.place.displacement(&mode.shape);
            [mode.eigenvalue.max(0.0), dot(u, struck.direction)]
        });
        ModalTarget { modes: modes.collect() }
    }

    fn struck(&self, struck: &Struck<'_>, any: &TouchLaw, law: &SmoothLaw) -> Option<Lasting> {
        let target = self.target(struck);
        let rear = struck.rear.map(|rear| [rear.mass, rear.stiffness, rear.damping]);
        let (mass, speed, pull) = (struck.mass, struck.speed, struck.pull());
        let found = lasting(target, Striker { mass, rear, speed, pull }, law, From::Modes)?;
        let without_end = struck.infinite_beam(any, speed).and_then(|impact| impact.duration);
        let (section, free) = (struck.place.section(), struck.place.free_distance());
        match without_end.filter(|t| section.return_time(free, *t) >= *t) {
            Some(duration) => Some(Lasting { duration, from: From::WithoutEnd, ..found }),
            None => Some(found).filter(|found| !found.target.modes.is_empty()),
        }
    }

    /// A beam that comes in its lowest motion that closes the gap, the others as what it gives way with.
    fn beams(&self, beams: &Beams<'_>, contact: usize, law: &SmoothLaw) -> Option<Lasting> {
        let modes = self.lowest();
        if modes.is_empty() {
            return None;
        }
        let shapes: Vec<&[[f64; 4]]> = modes.iter().map(|mode| mode.shape.as_slice()).collect();
        let touches = self.touches.get_or_init(|| FirstTouches::new(self.model));
        let closing = touches.closing_rates(contact, &shapes)?;
        let most = closing.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        let takes_part = |i: &usize| closing[*i].abs() > TOGETHER * most;
        let first = (0..modes.len()).find(takes_part)?;
        let lowest = modes[first].eigenvalue.max(0.0);
        let next = modes.get(first + 1).map_or(1.0, |mode| mode.eigenvalue);
        let comes = |i: &usize| modes[*i].eigenvalue <= lowest + TOGETHER * next.max(lowest);
        let (own, others): (Vec<usize>, Vec<usize>) = (0..modes.len()).partition(comes);
        let mass = 1.0 / own.iter().map(|i| closing[*i].powi(2)).sum::<f64>();
        let modes = others.iter().map(|i| [modes[*i].eigenvalue.max(0.0), closing[*i]]).collect();
        let speed = norm(beams.velocity);
        let striker = Striker { mass, rear: None, speed, pull: 0.0 };
        lasting(ModalTarget { modes }, striker, law, From::Comes)
    }
}

fn bodies(two: &Bodies, law: &SmoothLaw) -> Option<Lasting> {
    let pull = two.pressed.unwrap_or(0.0) / two.mass;
    let striker = Striker { mass: two.mass, rear: None, speed: two.speed, pull };
    lasting(ModalTarget { modes: Vec::new() }, striker, law, From::Bodies)
}

/// The contact in steps fine enough.
fn lasting(
    target: ModalTarget,
    mut striker: Striker,
    law: &SmoothLaw,
    from: From,
) -> Option<Lasting> {
    let mut law = law.clone();
    if striker.speed == 0.0 && matches!(law.potential, Potential::Linear { .. }) {
        // The duration of a linear contact without losses does not depend on the speed.
        striker = Striker { speed: 1.0, pull: 0.0, ..striker };
        law.dissipation = 0.0;
    }
    let any = TouchLaw::Smooth(law.clone());
    if !(striker.speed > 0.0 && striker.mass > 0.0 && striker.mass.is_finite()) {
        return None;
    }
    let rigid = rigid_impact(&any, striker.mass, striker.speed, striker.mass * striker.pull)?;
    let stiffness = rigid.peak_force / rigid.penetration;
    let mobility: f64 = target.modes.iter().map(|[_, shape]| shape * shape).sum();
    let fastest = (stiffness * (1.0 / striker.mass + mobility)).sqrt();
    let step = 2.0 * std::f64::consts::PI / fastest / STEPS;
    let (duration, peak, deflection) = (0.0, 0.0, 0.0);
    let mut found = Lasting { duration, from, target, striker, law, step, peak, deflection };
    let impact = found.impact(&found.target, step, 0.0)?;
    (found.duration, found.peak) = (impact.duration, impact.peak_force);
    found.deflection = impact.deflection;
    (found.duration > 0.0 && found.peak > 0.0).then_some(found)
}

impl Lasting {
    fn impact(&self, target: &ModalTarget, step: f64, early: f64) -> Option<ModalImpact> {
        let over = |p0: f64, p1: f64, h: f64| self.law.step_force([p0, p1], 0.0, h).force;
        let force = |p: f64, rate: f64| force(&self.law, p, rate);
        target.impact(&self.striker, [step, early * step], MOST, over, force)
    }

    /// Whether the struck point moves in no mode.
    pub fn is_held(&self) -> bool {
        let moves = |[_, shape]: &[f64; 2]| shape * shape * self.striker.mass > HELD;
        self.from == From::Modes && !self.target.modes.iter().any(moves)
    }

    /// Share by which shear deformation of a section, with its shear stiffness \[N\], would change the largest force; None where it would join the
    /// first contact with a later one, or part it.
    pub fn shear(&self, section: &UniformBeam, shear: f64) -> Option<f64> {
        let impact = self.impact(&self.target.sheared(section, shear), self.step, 0.0)?;
        let same = (self.duration / SAME..SAME * self.duration).contains(&impact.duration);
        same.then(|| impact.peak_force / self.peak - 1.0)
    }

    /// Share by which it would increase the static displacement of the struck point, by the modes; None where nothing holds that.
    pub fn yields(&self, section: &UniformBeam, shear: f64) -> Option<f64> {
        let sheared = self.target.sheared(section, shear);
        let share = sheared.compliance() / self.target.compliance() - 1.0;
        share.is_finite().then_some(share)
    }

    /// How far off the largest force is likely to be in steps of this size, as a share of it: the mean over instants at which a
    /// step may meet the touch. None where there is no estimate.
    pub fn off(&self, step: f64) -> Option<f64> {
        let mut sum = 0.0;
        for early in EARLY {
            let off = self.impact(&self.target, step, early)?.peak_force / self.peak - 1.0;
            sum += off * off;
        }
        Some((sum / EARLY.len() as f64).sqrt())
    }
}

impl BeamPlace<'_> {
    /// Displacement at the place, of those of all nodes.
    fn displacement(&self, nodal: &[[f64; 4]]) -> [f64; 2] {
        let (a, shape) = self.interpolation();
        let (left, right) = (&nodal[a], &nodal[a + 1]);
        [0, 1].map(|i| {
            shape[0] * left[i]
                + shape[1] * left[2 + i]
                + shape[2] * right[i]
                + shape[3] * right[2 + i]
        })
    }
}
