//! Frames of a run: its configuration at an instant, with the forces that belong to it, for drawings.

use serde::{Deserialize, Serialize};

use crate::analysis::section_forces::Lines;
use crate::frame::{Frame, FrameForce};
use crate::geometry::touch::{Reach, tangent_of};
use crate::math::vec2::{add, norm, scale};
use crate::model::Model;
use crate::run::solving::trial::Accepted;
use crate::state::State;

/// Contact forces in a part of a step.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Pressed {
    pair: usize,
    /// Along normal and tangent, shape (2) \[N\], or \[N s\] of an impulse.
    force: [f64; 2],
    impulsive: bool,
}

/// Data of frames.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Frames {
    /// Contact forces in the last accepted part of a step, shape (such contacts).
    pressed: Vec<Pressed>,
    /// Sum of the magnitudes of its forces, or of its impulses if there were any \[N\] or \[N s\].
    contact: f64,
    /// Whether they are impulses.
    impulsive: bool,
    /// Factors of its loads, shape (loads) \[-\].
    load_factors: Vec<f64>,
    /// Axial force, shear force and moment at the start and the end of every element, shape (elements, 2, 3) \[N, N, N m\].
    #[serde(skip)]
    section_forces: Vec<[[f64; 3]; 2]>,
    /// Forces of everything that touches, shape (such forces).
    #[serde(skip)]
    contact_forces: Vec<FrameForce>,
}

impl Frames {
    /// Whether they belong to a model.
    pub fn fits(&self, model: &Model) -> bool {
        let loads = [0, model.loads.len()];
        self.pressed.iter().all(|one| one.pair < model.pairs.len())
            && loads.contains(&self.load_factors.len())
    }

    /// Enters an accepted part of a step.
    pub fn take(&mut self, part: &Accepted<'_>) {
        let (solved, work) = (part.solved, part.work());
        // Resting contacts may have an impulse in such a short part, too: no quotient by its length is a force.
        let trial = &solved.trial;
        let impulsive = solved.impulsive && (trial.carries_impulses() || !trial.active.is_empty());
        let divisor = if impulsive { 1.0 } else { trial.h };
        let smooth = work.smooth.iter().map(|c| Pressed {
            pair: c.pair,
            force: [c.force.force, 0.0],
            impulsive: false,
        });
        let rigid = work.rigid_pairs.iter().zip(&work.rigid).map(|(pair, c)| Pressed {
            pair: *pair,
            force: c.impulse.map(|l| l / divisor),
            impulsive,
        });
        self.pressed.clear();
        self.pressed.extend(smooth.chain(rigid).filter(|one| one.force != [0.0; 2]));
        let smooth: f64 = work.smooth.iter().map(|c| c.force.force.abs()).sum();
        let rigid: f64 = work.rigid.iter().map(|c| norm(c.impulse)).sum();
        self.contact = if rigid > 0.0 { rigid / divisor } else { smooth };
        self.impulsive = impulsive && rigid > 0.0;
        self.load_factors.clone_from(&solved.solution.forcing.factors);
    }

    /// Sum of the magnitudes of all contact forces \[N\], or impulses \[N s\], and whether they are impulses.
    pub fn contact(&self) -> (f64, bool) {
        (self.contact, self.impulsive)
    }

    /// The frame of a state.
    pub fn frame<'a>(&'a mut self, model: &Model, state: &'a State, lines: &Lines) -> Frame<'a> {
        self.section_forces.clear();
        self.section_forces.extend(lines.ends(model.element_count()));
        self.contact_forces.clear();
        let force = |one: &Pressed| one.force_on(model, state);
        self.contact_forces.extend(self.pressed.iter().filter_map(force));
        if state.time == 0.0 {
            // Before the first step no mean over one exists: the forces at that instant.
            let at_once = model.loads.iter().map(|load| load.factor_at_start());
            self.load_factors.splice(.., at_once);
        }
        Frame {
            time: state.time,
            displacement: &state.displacement,
            velocity: &state.velocity,
            spin: &state.spin,
            section_forces: &self.section_forces,
            contact_forces: &self.contact_forces,
            load_factors: &self.load_factors,
        }
    }
}

impl Pressed {
    /// Its force on the target, at its current position; `None` if the two no longer face each other.
    fn force_on(&self, model: &Model, state: &State) -> Option<FrameForce> {
        let (pair, seen) = (&model.pairs[self.pair], &state.pairs[self.pair]);
        let touch = pair.touch(model, &state.configuration(), &seen.memory, Reach::Near)?;
        let [normal, tangential] = self.force;
        let along = scale(tangential, tangent_of(touch.normal));
        let on_source = add(scale(normal, touch.normal), along);
        let sign = if pair.source_partner == 1 { 1.0 } else { -1.0 };
        Some(FrameForce {
            contact: pair.contact,
            position: add(touch.closest_place, scale(touch.radius, touch.normal)),
            force: scale(sign, on_source),
            impulsive: self.impulsive,
        })
    }
}
