//! Frames of a run: its configuration at an instant, with the forces and impulses that belong to it, for drawings.

use serde::{Deserialize, Serialize};

use crate::analysis::section_forces::Lines;
use crate::frame::{Frame, FrameForce, SectionPoint};
use crate::geometry::touch::{SearchRegion, tangent_of};
use crate::math::vec2::{add, norm, scale};
use crate::model::Model;
use crate::run::solving::trial::{Accepted, PartKind};
use crate::state::State;
use crate::step::contacts::PressingPair;
use crate::summary::SectionForceSummary;

/// In an impact a contact at rest has an impulse of its own only above this multiple of that of its force.
const OF_FORCE: f64 = 2.0;

/// What a pair carries along normal and tangent.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Carried {
    pair: usize,
    /// A force or an impulse, shape (2) \[N\] or \[N s\].
    vector: [f64; 2],
}

/// Data of frames. Forces and impulses are apart: no force is an impulse over the length of a step.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Frames {
    /// Forces of compliant contacts in the last accepted part of a step, shape (such pairs) \[N\].
    compliant: Vec<Carried>,
    /// Forces of persistent contacts in the last part without a jump of velocities, of those still closed, in the order of pairs,
    /// shape (such pairs) \[N\]; at the start of a run those of the equilibrium.
    persistent: Vec<Carried>,
    /// Impulses of impacts since the last row, in the order of pairs, shape (such pairs) \[N s\].
    impulses: Vec<Carried>,
    /// Factors of the loads in the last part, shape (loads) \[-\].
    load_factors: Vec<f64>,
    /// Axial force, shear force and moment at the start and the end of every element, shape (elements, 2, 3) \[N, N, N m\].
    #[serde(skip)]
    section_forces: Vec<[[f64; 3]; 2]>,
    /// Section forces along all elements, shape (vertices).
    #[serde(skip)]
    section_points: Vec<SectionPoint>,
    /// Forces and impulses of everything that touches, shape (such forces and impulses).
    #[serde(skip)]
    contact_forces: Vec<FrameForce>,
}

impl Frames {
    /// At the start of a run, with the forces of the pairs of an equilibrium.
    pub fn at_start(pressed: &[PressingPair]) -> Self {
        let force = |one: &PressingPair| Carried { pair: one.pair, vector: [one.force, 0.0] };
        let mut persistent: Vec<Carried> = pressed.iter().map(force).collect();
        persistent.sort_unstable_by_key(|one| one.pair);
        Self { persistent, ..Self::default() }
    }

    /// Whether they belong to a model.
    pub fn fits(&self, model: &Model) -> bool {
        let loads = [0, model.loads.len()];
        let mut carried = [&self.compliant, &self.persistent, &self.impulses].into_iter().flatten();
        carried.all(|one| one.pair < model.pairs.len()) && loads.contains(&self.load_factors.len())
    }

    /// Enters an accepted part of a step.
    pub fn take(&mut self, part: &Accepted<'_>) {
        let smooth = part.work().smooth.iter();
        let compliant = smooth.map(|c| Carried { pair: c.pair, vector: [c.force.force, 0.0] });
        self.compliant.clear();
        self.compliant.extend(compliant.filter(Carried::is_any));
        self.take_rigid(part);
        self.load_factors.clone_from(&part.solved.solution.forcing.factors);
    }

    /// Rigid contacts have a force in a part in which no velocity jumps, and in any other an impulse.
    fn take_rigid(&mut self, part: &Accepted<'_>) {
        let (solved, work) = (part.solved, part.work());
        let h = solved.trial.h;
        let rigid = work.rigid_pairs.iter().zip(&work.rigid);
        let given = rigid.map(|(pair, c)| Carried { pair: *pair, vector: c.impulse });
        if !solved.jumps {
            self.persistent.clear();
            let forces = given.map(|one| Carried { vector: one.vector.map(|l| l / h), ..one });
            self.persistent.extend(forces.filter(Carried::is_any));
            self.persistent.sort_unstable_by_key(|one| one.pair);
            return;
        }
        // A part without impact may be as short as one: what contacts at rest have in it is no force, and nothing strikes.
        if !matches!(solved.trial.kind, PartKind::Free { .. }) {
            for one in given.filter(Carried::is_any) {
                let known = place_of(&self.persistent, one.pair).ok();
                let of_force = known.map_or(0.0, |k| norm(self.persistent[k].vector) * h);
                if norm(one.vector) > OF_FORCE * of_force {
                    self.add_impulse(one);
                }
            }
        }
        let closed = |one: &Carried| solved.impulsive && part.after.pairs[one.pair].closed;
        self.persistent.retain(closed);
    }

    fn add_impulse(&mut self, one: Carried) {
        match place_of(&self.impulses, one.pair) {
            Ok(k) => (0..2).for_each(|i| self.impulses[k].vector[i] += one.vector[i]),
            Err(k) => self.impulses.insert(k, one),
        }
    }

    /// Sums of the magnitudes of all contact forces \[N\], and of the impulses since the last row \[N s\].
    pub fn contact(&self) -> [f64; 2] {
        let sum = |list: &[Carried]| list.iter().map(|one| norm(one.vector)).sum::<f64>();
        [sum(&self.compliant) + sum(&self.persistent), sum(&self.impulses)]
    }

    /// The frame of a state, with the section forces of the last step and the extremes so far.
    pub fn frame<'a>(
        &'a mut self,
        model: &Model,
        state: &'a State,
        (lines, so_far): (&Lines, &[SectionForceSummary]),
    ) -> Frame<'a> {
        self.section_forces.clear();
        self.section_forces.extend(lines.ends(model.element_count()));
        lines.vertices(model, so_far, &mut self.section_points);
        self.contact_forces.clear();
        let forces = self.compliant.iter().chain(&self.persistent).map(|one| (one, false));
        let impulses = self.impulses.iter().map(|one| (one, true));
        let placed = |(one, impulsive): (&Carried, bool)| one.on_target(model, state, impulsive);
        self.contact_forces.extend(forces.chain(impulses).filter_map(placed));
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
            section_points: &self.section_points,
            contact_forces: &self.contact_forces,
            load_factors: &self.load_factors,
        }
    }

    /// Ends a row.
    pub fn end_row(&mut self) {
        self.impulses.clear();
    }
}

/// Place of a pair in a list in the order of pairs, or that where it belongs.
fn place_of(list: &[Carried], pair: usize) -> Result<usize, usize> {
    list.binary_search_by_key(&pair, |one| one.pair)
}

impl Carried {
    fn is_any(&self) -> bool {
        self.vector != [0.0; 2]
    }

    /// On the target, at its current position; `None` if the two no longer face each other.
    fn on_target(&self, model: &Model, state: &State, impulsive: bool) -> Option<FrameForce> {
        let (pair, seen) = (&model.pairs[self.pair], &state.pairs[self.pair]);
        let touch = pair.touch(model, &state.configuration(), &seen.memory, SearchRegion::Near)?;
        let [normal, tangential] = self.vector;
        let along = scale(tangential, tangent_of(touch.normal));
        let on_source = add(scale(normal, touch.normal), along);
        let sign = if pair.source_partner == 1 { 1.0 } else { -1.0 };
        Some(FrameForce {
            contact: pair.contact,
            position: add(touch.closest_place, scale(touch.radius, touch.normal)),
            force: scale(sign, on_source),
            impulsive,
        })
    }
}
