//! Natural modes about an equilibrium, linear in the number of elements.

use nalgebra::Complex;

use super::equilibrium::Equilibrium;
use super::spectrum::{
    Eigen, FreeMotions, Held, ImagePair, Layout, Matrix, Nodal, Pencil, subtract,
};
use super::spectrum::{free_motions, metric, size, strain_share, stress_share};
use super::static_search::{StaticSearch, largest};
use crate::linalg::block::inner;
use crate::linalg::chain::Chain;
use crate::math::vec2::dot;
use crate::model::Model;
use crate::model::frozen::Span;
use crate::settings::Scheme;
use crate::state::State;
use crate::step::effective_mass::mass_band;

/// Number of increases of the shift if modes are below it.
const MOST_SHIFTS: usize = 60;
/// A motion whose strain energy is less than this share of the bending stiffness is strain-free.
const STRAINLESS: f64 = 1e-6;
/// Stress whose sum over the structure is less than this share of its parts has no effect on a motion.
const UNSTRESSED: f64 = 1e-6;

/// A natural mode.
#[derive(Clone, Debug)]
pub struct Mode {
    /// Square of the angular frequency \[1/s^2\], or its real part; zero for a motion of a rigid body or of a mechanism,
    /// negative for one that grows without oscillating.
    pub eigenvalue: f64,
    /// Imaginary part of the square \[1/s^2\], not negative: of two modes coupled by follower forces, one grows and one decays, and both are
    /// reported as one. Zero otherwise.
    pub imaginary: f64,
    /// Nodal displacements and slopes (u1, u2, u1', u2') of unit modal mass, shape (nodes, 4) \[kg^(-1/2), kg^(-1/2)/m\]; for flutter the part in
    /// phase.
    pub shape: Vec<[f64; 4]>,
}

/// Kind of a mode.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ModeKind {
    /// It oscillates.
    Vibration,
    /// Motion without strain and without restoring forces: of a rigid body, or of a mechanism.
    RigidBody,
    /// Unstable without oscillation (divergence).
    Unstable,
    /// Unstable with oscillation (flutter), by follower forces.
    Flutter,
}

impl Mode {
    /// Kind of the mode.
    pub fn kind(&self) -> ModeKind {
        match self.eigenvalue {
            _ if self.imaginary > 0.0 => ModeKind::Flutter,
            0.0 => ModeKind::RigidBody,
            negative if negative < 0.0 => ModeKind::Unstable,
            _ => ModeKind::Vibration,
        }
    }

    /// Natural frequency \[Hz\]; zero for a motion without stiffness, NaN for one that grows without oscillating.
    pub fn frequency(&self) -> f64 {
        if self.imaginary == 0.0 {
            return self.eigenvalue.sqrt() / std::f64::consts::TAU;
        }
        self.root().re.abs() / std::f64::consts::TAU
    }

    /// Growth rate \[1/s\]; zero for a stable mode.
    pub fn growth(&self) -> f64 {
        match self.kind() {
            ModeKind::Vibration | ModeKind::RigidBody => 0.0,
            ModeKind::Unstable | ModeKind::Flutter => self.root().im.abs(),
        }
    }

    /// Whether it is a vibration of the second spectrum of Timoshenko's theory: more than half of its kinetic energy is rotation of sections of
    /// shear-flexible beams. `model` is that of the mode.
    ///
    /// On a simply supported beam both spectra have one mode each for every number of half waves, and this criterion separates them exactly if
    /// E exceeds the shear factor times G; the second begins at the cut-off frequency `sqrt(kappa G A / (rho I)) / (2 pi)`. On other supports modes
    /// above it mix both, and it names those that turn the sections more than they move them.
    pub fn is_second_spectrum(&self, model: &Model) -> bool {
        self.kind() == ModeKind::Vibration && self.rotation_of_sections(model) > 0.5
    }

    /// Share of the kinetic energy that is rotation of sections of shear-flexible beams; the modal mass is one.
    fn rotation_of_sections(&self, model: &Model) -> f64 {
        let share = |(span, k, a, _): (&Span, usize, usize, usize)| {
            if span.shear.is_none() {
                return 0.0;
            }
            let table = span.table(k);
            let [p, q] = [a, a + 1].map(|node| [self.shape[node][2], self.shape[node][3]]);
            let square = dot(p, p) + dot(p, q) + dot(q, q);
            table.rows[1].section.rotary * table.length * square / 3.0
        };
        model.each_element().map(share).sum()
    }

    fn root(&self) -> Complex<f64> {
        Complex::new(self.eigenvalue, self.imaginary).sqrt()
    }
}

/// The `count` lowest natural modes about `state`, an equilibrium, in ascending order; without projectiles.
///
/// About the reference configuration no load acts; given strains count if supports and joints bear them without a displacement, as of a heated bar
/// between walls.
///
/// Fewer if there are fewer: as many as the rank of the mass matrix. Damping is left out.
pub fn modes_about(model: &Model, state: &State, count: usize) -> Vec<Mode> {
    let model = &model.structure();
    lowest(model, &state.of_structure(model), Vec::new(), count)
}

/// The same about a static equilibrium, with active contacts kept closed: rigid ones do not move, compliant ones have the stiffness of their law.
/// Contacts of discs are omitted.
pub fn modes_about_equilibrium(model: &Model, found: &Equilibrium, count: usize) -> Vec<Mode> {
    let model = &model.structure();
    lowest(model, &found.state.of_structure(model), found.held.clone(), count)
}

/// The `count` lowest natural frequencies about the stress-free reference configuration \[Hz\], in ascending order.
pub fn natural_frequencies(model: &Model, count: usize) -> Vec<f64> {
    let rest = State::at_rest(model, Scheme::EnergyMomentum);
    modes_about(model, &rest, count).iter().map(Mode::frequency).collect()
}

/// The `count` lowest modes of a structure.
pub(super) fn lowest(model: &Model, state: &State, held: Vec<Held>, count: usize) -> Vec<Mode> {
    Linearized::new(model, state, held).lowest(count)
}

/// The same about an equilibrium under a share of the loads.
pub(super) fn lowest_under(model: &Model, state: &State, share: f64, count: usize) -> Vec<Mode> {
    let search = StaticSearch::at_share(model, state, share);
    Linearized::about(Layout::new(model), search, state).lowest(count)
}

/// A structure linearised about an equilibrium.
pub(super) struct Linearized<'m> {
    layout: Layout<'m>,
    pub(super) search: StaticSearch<'m>,
    tangent: Matrix,
    pub(super) mass: Chain,
    /// Whether the structure has stress.
    stressed: bool,
    /// Unknowns that supports and joints leave free.
    free: usize,
}

impl<'m> Linearized<'m> {
    pub(super) fn new(model: &'m Model, state: &State, held: Vec<Held>) -> Self {
        let mut search = StaticSearch::at(model, state);
        if held.is_empty() && state.is_strained() && largest(&state.displacement) == 0.0 {
            search.keep_borne_strains(&state.strained);
        }
        Self::about(Layout::holding(model, held), search, state)
    }

    fn about(layout: Layout<'m>, search: StaticSearch<'m>, state: &State) -> Self {
        let model = layout.model;
        let tangent = layout.tangent(&search);
        let held: usize = model.prescribed.iter().map(|h| h.normals.len()).sum();
        let free = (4 * model.node_count()).saturating_sub(held + model.constraints.len());
        let stressed = state.displacement.as_flattened().iter().any(|u| *u != 0.0)
            || state.is_strained()
            || (model.connectors.iter().zip(&state.coordinates))
                .any(|(c, q)| c.potential(*q, &state.memories) != 0.0);
        let mass = mass_band(model, &state.displacement);
        Self { layout, search, tangent, mass, stressed, free }
    }

    /// Number of strain-free motions.
    pub(super) fn free_motions(&self) -> usize {
        free_motions(&self.layout, &self.search).motions.len()
    }

    fn lowest(&self, count: usize) -> Vec<Mode> {
        let mut modes = if self.layout.is_symmetric(&self.tangent) {
            self.symmetric(count, false)
        } else {
            self.general(count)
        };
        modes.sort_by(|a, b| a.eigenvalue.total_cmp(&b.eigenvalue));
        modes.truncate(count);
        modes
    }

    /// Modes of forces with a potential, unstable ones first; `flexible` of them in addition to those of rigid bodies.
    pub(super) fn symmetric(&self, count: usize, flexible: bool) -> Vec<Mode> {
        let loose = free_motions(&self.layout, &self.search);
        let tangent = self.layout.symmetric(&self.tangent);
        let pencil = Pencil { layout: &self.layout, stiffness: &tangent, mass: &self.mass };
        let most = count.min(self.free);
        if !self.stressed {
            let rigid = self.orthonormal(&loose.motions);
            let wanted = if flexible { most } else { most.saturating_sub(rigid.len()) };
            let springs = self.springs(&loose);
            let found = pencil.lowest(0.0, &springs, &rigid, wanted).unwrap_or_default();
            let none = Complex::new(0.0, 0.0);
            let rigid = rigid.into_iter().map(|pair| mode(Eigen { value: none, pair }));
            return rigid.chain(found.into_iter().map(mode)).collect();
        }
        let wanted = most + if flexible { loose.motions.len() } else { 0 };
        let wanted = wanted.min(self.free);
        let Some(shift) = self.shift(&pencil, &loose) else { return Vec::new() };
        let found = pencil.lowest(shift, &[], &[], wanted).unwrap_or_default();
        found.into_iter().map(|e| self.classified(e, &loose)).collect()
    }

    /// Modes where forces follow the beams.
    fn general(&self, count: usize) -> Vec<Mode> {
        let loose = free_motions(&self.layout, &self.search);
        let pencil = Pencil { layout: &self.layout, stiffness: &self.tangent, mass: &self.mass };
        let shift = if loose.motions.is_empty() { 0.0 } else { self.usual() };
        let found = pencil.nearest(shift, count.min(self.free)).unwrap_or_default();
        found.into_iter().map(|e| self.classified(e, &loose)).collect()
    }

    /// An eigenvalue as a mode; it is zero for a strain-free motion on which stress has no effect.
    fn classified(&self, mut eigen: Eigen, loose: &FreeMotions) -> Mode {
        let x = &eigen.pair.x;
        if !loose.motions.is_empty()
            && strain_share(&self.layout, &self.search, x) <= STRAINLESS
            && stress_share(&self.layout, &self.search, x, eigen.value.re) <= UNSTRESSED
        {
            eigen.value = Complex::new(0.0, 0.0);
        }
        mode(eigen)
    }

    /// A shift above all unstable eigenvalues; zero if the stiffness is positive.
    fn shift(&self, pencil: &Pencil, loose: &FreeMotions) -> Option<f64> {
        if loose.motions.is_empty() && pencil.below(0.0) == Some(0) {
            return Some(0.0);
        }
        let mut shift = self.usual();
        for _ in 0..MOST_SHIFTS {
            if pencil.below(-shift) == Some(0) {
                return Some(shift);
            }
            shift *= 4.0;
        }
        None
    }

    /// A low eigenvalue of beams as long as all together, with the mass of all.
    fn usual(&self) -> f64 {
        let model = self.layout.model;
        let along: Nodal = vec![[1.0, 0.0, 0.0, 0.0]; model.node_count()];
        let stiffness = inner(&along, &metric(model, false).multiply(&along));
        let mass = inner(&along, &self.mass.multiply(&along));
        stiffness / mass
    }

    /// Motions orthonormal in the inner product of the mass; those without mass have no frequency and are left out.
    fn orthonormal(&self, motions: &[Nodal]) -> Vec<ImagePair> {
        let mut out: Vec<ImagePair> = Vec::new();
        for x in motions {
            let mut pair = ImagePair { x: x.clone(), image: self.mass.multiply(x) };
            let before = inner(&pair.x, &pair.image);
            for _ in 0..2 {
                for other in &out {
                    let along = inner(&pair.x, &other.image);
                    subtract(&mut pair, along, other);
                }
            }
            let square = inner(&pair.x, &pair.image);
            if square > 1e-20 * before && square.is_normal() {
                let factor = 1.0 / square.sqrt();
                for x in [&mut pair.x, &mut pair.image] {
                    x.as_flattened_mut().iter_mut().for_each(|c| *c *= factor);
                }
                out.push(pair);
            }
        }
        out
    }

    /// Springs that stop motions without strain. Forces that do no work on these motions load none of them: any stiffness will
    /// do, so that of bending.
    fn springs(&self, loose: &FreeMotions) -> Vec<(usize, usize, f64)> {
        let model = self.layout.model;
        let length = size(model);
        let spring = |(node, component): &(usize, usize)| {
            let (span, k) = model.element_of(*node);
            let bending = span.table(k).rows[1].section.bending;
            let power = if *component < 2 { 3 } else { 1 };
            (*node, *component, bending / length.powi(power))
        };
        loose.stops.iter().map(spring).collect()
    }
}

fn mode(eigen: Eigen) -> Mode {
    Mode { eigenvalue: eigen.value.re, imaginary: eigen.value.im, shape: eigen.pair.x }
}
