//! Frames of a run: its configuration at an instant, with the forces that belong to it, for drawings.

use super::record::Recorder;
use super::simulation::Simulation;
use crate::frame::{Frame, FrameForce};
use crate::geometry::touch::{Reach, tangent_of};
use crate::math::vec2::{add, norm, scale};

/// What frames are made in.
#[derive(Clone, Debug, Default)]
pub(super) struct Frames {
    /// Axial force, shear force and moment at the start and the end of every element, shape (elements, 2, 3) \[N, N, N m\].
    section_forces: Vec<[[f64; 3]; 2]>,
    /// Forces of everything that touches, shape (such forces).
    contact_forces: Vec<FrameForce>,
    /// Factors of the loads, shape (loads) \[-\].
    load_factors: Vec<f64>,
    /// Size of the part of a step accepted last \[s\], and whether impulses acted in it.
    pub part: (f64, bool),
}

impl Simulation<'_> {
    /// Hands the state reached to a recorder that wants it.
    pub(super) fn show(&mut self, recorder: &mut dyn Recorder) {
        let (h, impulsive) = self.frames.part;
        let divisor = if impulsive { 1.0 } else { h };
        let smooth: f64 = self.work.smooth.iter().map(|c| c.force.force.abs()).sum();
        let rigid: f64 = self.work.rigid.iter().map(|c| norm(c.impulse)).sum();
        let contact = if rigid > 0.0 { rigid / divisor } else { smooth };
        if !recorder.wants_frame(self.state.time, contact, impulsive && rigid > 0.0) {
            return;
        }
        let mut frames = std::mem::take(&mut self.frames);
        frames.section_forces.clear();
        let ends = self.monitor.lines().ends(self.model.element_count());
        frames.section_forces.extend(ends);
        frames.contact_forces.clear();
        self.contact_forces_of(frames.part, &mut frames.contact_forces);
        frames.load_factors.clone_from(&self.forcing.factors);
        if self.state.time == 0.0 {
            // Before the first step no mean over one is known: what acts at that instant.
            let at_once = self.model.loads.iter().map(|load| load.factor_at_start());
            frames.load_factors.splice(.., at_once);
        }
        recorder.frame(&Frame {
            time: self.state.time,
            displacement: &self.state.displacement,
            velocity: &self.state.velocity,
            spin: &self.state.spin,
            section_forces: &frames.section_forces,
            contact_forces: &frames.contact_forces,
            load_factors: &frames.load_factors,
        });
        self.frames = frames;
    }

    /// Forces of all pairs that touched in the part of a step accepted last, and in an impact their impulses.
    fn contact_forces_of(&self, (h, impulsive): (f64, bool), out: &mut Vec<FrameForce>) {
        let smooth = self.work.smooth.iter().map(|c| (c.pair, [c.force.force, 0.0], false));
        let divisor = if impulsive { 1.0 } else { h };
        let rigid = (self.work.rigid_pairs.iter().zip(&self.work.rigid))
            .map(|(&pair, c)| (pair, c.impulse.map(|l| l / divisor), impulsive));
        let at = self.state.configuration();
        for (index, [normal, tangential], impulsive) in smooth.chain(rigid) {
            if normal == 0.0 && tangential == 0.0 {
                continue;
            }
            let (pair, seen) = (&self.model.pairs[index], &self.state.pairs[index]);
            let Some(touch) = pair.touch(self.model, &at, &seen.memory, Reach::Near) else {
                continue;
            };
            let along = scale(tangential, tangent_of(touch.normal));
            let on_source = add(scale(normal, touch.normal), along);
            let sign = if pair.source_partner == 1 { 1.0 } else { -1.0 };
            out.push(FrameForce {
                contact: pair.contact,
                position: add(touch.closest_place, scale(touch.radius, touch.normal)),
                force: scale(sign, on_source),
                impulsive,
            });
        }
    }
}
