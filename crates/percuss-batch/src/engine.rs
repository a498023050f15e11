//! State of the runs of an ensemble, and residual and tangent of a step.

mod beams;
mod fibres;
mod guide;
mod impulse;
mod joined;
mod springs;

use super::band::Band;
use super::constraints::Constraints;
use super::fibres::FibreStates;
use super::ground_springs::GroundSpringState;
use super::impact::Press;
use super::numbers::Numbers;
use percuss::internals::element::energy_momentum::End;
use percuss::internals::linalg::block::Block;
use percuss::internals::scalar::{Number, Task};
use percuss::internals::step::projection::project_held;
use percuss::math::hermite::GAUSS;
use percuss::math::vec2::dot;

pub use guide::GuideState;

/// Runs in lanes (or one run with its derivatives), each with its own step.
#[derive(Clone, Debug)]
pub struct Engine<S: Number> {
    pub numbers: Numbers<S>,
    /// Size of the current step \[s\].
    pub h: S,
    /// Displacements of the beams' nodes, shape (beam nodes, 4) \[m, -\].
    pub displacement: Vec<[S; 4]>,
    /// Velocities of the same, shape (beam nodes, 4) \[m/s, 1/s\].
    pub velocity: Vec<[S; 4]>,
    /// Gauss points at the start of the step, shape (elements, Gauss points).
    pub start: Vec<[End<S>; GAUSS]>,
    /// Angular rates of their tangents, shape (elements, Gauss points) \[rad/s\].
    pub spin: Vec<[S; GAUSS]>,
    /// State variables of the fibres.
    pub fibres: FibreStates<S>,
    /// Joints, and supports between nodes.
    pub constraints: Constraints<S>,
    /// Elastic supports and stops, shape (springs to the ground).
    pub springs: Vec<GroundSpringState<S>>,
    /// Guided projectiles, shape (guided projectiles).
    pub guides: Vec<GuideState<S>>,
    /// Reactions of the supports in the fixed directions, shape (nodes held, 4) \[N, N m\].
    pub reactions: Vec<[S; 4]>,
    /// Lanes whose step is solved, including reactions, while others still iterate.
    pub settled: S::Mask,
    /// Rows of their nodes in the tangent in use, before degrees of freedom were fixed: blocks of the previous node, of the node, and of the next
    /// one, shape (nodes held, 3, 4, 4) \[N/m, N, N m\].
    pub reaction_rows: Vec<[Block<S>; 3]>,
    /// Mean factors of the loads over the current step, shape (loads) \[-\].
    pub load_factors: Vec<S>,
    /// Nodal forces of the loads, shape (beam nodes, 4) \[N, N m\].
    pub applied: Vec<[S; 4]>,
    /// Increment over the step, shape (beam nodes, 4) \[m, -\].
    pub increment: Vec<[S; 4]>,
    /// Part of it due to accelerations, extrapolated from the previous step, shape (beam nodes, 4) \[m, -\].
    pub trend: Vec<[S; 4]>,
    /// Residual in the free directions, shape (beam nodes, 4) \[N, N m\].
    pub residual: Vec<[S; 4]>,
    /// Correction of the increment, shape (beam nodes, 4) \[m, -\].
    pub correction: Vec<[S; 4]>,
    /// The tangent, assembled and then factored, and the factors in use.
    pub tangent: Band<S>,
    pub factors: Band<S>,
    /// The rigid contact that may press, if there is one.
    pub press: Option<Press<S>>,
}

impl<S: Number> Engine<S> {
    /// State at rest in the reference configuration, with moving projectiles.
    pub fn new(numbers: Numbers<S>) -> Self {
        let zero = numbers.step.constant(0.0);
        let nodes = numbers.nodes.len();
        let still = vec![[zero; 4]; nodes];
        let at_rest = |engine: &Numbers<S>| {
            let mut ends = Vec::new();
            for span in &engine.spans {
                ends.extend((0..span.count).map(|k| {
                    span.table(k).rows.map(|row| {
                        End::new(span.measure, row.reference.tangent, [zero; 2], [zero; 2])
                    })
                }));
            }
            ends
        };
        let start = at_rest(&numbers);
        let guides = numbers.guides.iter().map(GuideState::at_start).collect();
        Self {
            h: numbers.step,
            displacement: still.clone(),
            velocity: still.clone(),
            spin: vec![[zero; GAUSS]; start.len()],
            start,
            fibres: FibreStates::at_rest(&numbers),
            constraints: Constraints::new(&numbers.constraints, nodes, zero),
            springs: vec![GroundSpringState::at_rest(zero); numbers.springs.len()],
            guides,
            reactions: vec![[zero; 4]; numbers.prescribed.len()],
            settled: zero.less(zero),
            reaction_rows: vec![[[[zero; 4]; 4]; 3]; numbers.prescribed.len()],
            load_factors: vec![numbers.step.constant(1.0); numbers.loads.len()],
            applied: still.clone(),
            increment: still.clone(),
            trend: still.clone(),
            residual: still.clone(),
            correction: still,
            tangent: Band::zeros(nodes, zero),
            factors: Band::zeros(nodes, zero),
            press: None,
            numbers,
        }
    }

    /// Calls `f` with every number of the state in a fixed order: all numbers that accepting a step changes.
    #[inline(always)]
    pub fn each_of_state(&mut self, mut f: impl FnMut(&mut S)) {
        for nodal in [&mut self.displacement, &mut self.velocity] {
            for x in nodal.as_flattened_mut() {
                f(x);
            }
        }
        for x in self.spin.as_flattened_mut() {
            f(x);
        }
        for end in self.start.as_flattened_mut() {
            let End { slope: [s0, s1], bend: [b0, b1], stretch, inverse, membrane } = end;
            for x in [s0, s1, b0, b1, stretch, inverse, membrane] {
                f(x);
            }
        }
        for g in &mut self.guides {
            for x in [&mut g.way, &mut g.velocity, &mut g.gap, &mut g.rate] {
                f(x);
            }
        }
        for x in self.constraints.accepted() {
            f(x);
        }
        self.fibres.each(&mut f);
    }

    /// Copies a run at its start from another engine into a lane.
    pub fn set_lane(&mut self, lane: usize, from: &mut Self) {
        let mut state = Vec::new();
        from.each_of_state(|x| state.push(*x));
        let mut state = state.into_iter();
        self.each_of_state(|x| x.set_lane(lane, state.next().expect("of the same shape"), 0));
        let zero = self.h.constant(0.0);
        let increments = self.increment.as_flattened_mut().iter_mut();
        let guides = self.guides.iter_mut();
        let guides = guides.flat_map(|g| [&mut g.increment, &mut g.impulse, &mut g.force]);
        increments.chain(guides).for_each(|x| x.set_lane(lane, zero, 0));
        self.h.set_lane(lane, from.h, 0);
        let mut numbers = self.numbers.flat();
        for (mine, other) in numbers.iter_mut().zip(from.numbers.flat()) {
            mine.set_lane(lane, other, 0);
        }
        self.numbers = self.numbers.with(&numbers);
    }

    /// Residual and reactions at the current increment (settled lanes keep their reactions), and, if `TANGENT`, the assembled tangent including
    /// fixed components.
    #[inline(always)]
    pub fn evaluate<const TANGENT: bool>(&mut self) {
        self.h.apart(Evaluate::<S, TANGENT>(self));
    }

    #[inline(always)]
    fn balance<const TANGENT: bool>(&mut self) {
        self.beams::<TANGENT>();
        if !self.numbers.loads.is_empty() {
            self.resist_loads();
        }
        self.connect::<TANGENT>();
        for k in 0..self.numbers.prescribed.len() {
            let dofs = &self.numbers.prescribed[k];
            let free = &mut self.residual[dofs.node];
            let all = *free;
            dofs.project(free);
            for i in 0..4 {
                let mine = &mut self.reactions[k][i];
                *mine = S::choose(self.settled, *mine, all[i] - free[i]);
            }
        }
    }

    /// Forces of springs, contacts and constraints.
    #[inline(always)]
    pub fn connect<const TANGENT: bool>(&mut self) {
        self.push_springs::<TANGENT>();
        self.contacts::<TANGENT>();
        self.constrain();
    }

    /// Forces of the guided projectiles, and their own balance.
    #[inline(always)]
    fn contacts<const TANGENT: bool>(&mut self) {
        let rate = self.h.recip();
        for k in 0..self.guides.len() {
            let push = self.push(k, rate);
            let (guide, state) = (&self.numbers.guides[k], &mut self.guides[k]);
            let a = guide.node;
            let row = guide.row();
            for (i, c) in row.iter().enumerate() {
                let target = &mut self.residual[a + i / 4][i % 4];
                *target = target.sub_product(push, *c);
            }
            if TANGENT {
                let inertia = guide.mass * (rate + rate) * rate;
                state.assembled = [state.slope, inertia + state.slope];
                let felt = state.slope * inertia / state.assembled[1];
                self.tangent.add_square(a, &row, felt);
            }
        }
    }

    /// Force of a guided projectile on the beam at the current increment, including its impulse (F of eq. 4, Lambda of eq. 12 of the paper), and
    /// the balance of the projectile (eqs. 3 and 13).
    #[inline(always)]
    pub fn push(&mut self, k: usize, rate: S) -> S {
        let (guide, state) = (&self.numbers.guides[k], &mut self.guides[k]);
        state.gap_change = guide.along(&self.increment) - state.increment;
        let gap_1 = state.gap + state.gap_change;
        guide.force(state, -gap_1, rate);
        let push = state.force + state.impulse * rate;
        let inertia = guide.mass * (state.increment * rate - state.velocity) * (rate + rate);
        state.residual = inertia + push - dot(guide.direction, state.applied);
        push
    }

    /// Applies the fixed degrees of freedom to the tangent, and factors it.
    #[inline(always)]
    pub fn factor(&mut self) {
        self.h.apart(FactorBand(self));
    }

    #[inline(always)]
    fn hold_and_factor(&mut self) {
        let (band, last) = (&mut self.tangent, self.residual.len() - 1);
        for dofs in &self.numbers.prescribed {
            dofs.hold_in([&mut band.diag, &mut band.upper, &mut band.lower], |i| i < last);
        }
        self.tangent.factor();
    }

    /// Correction of the increments by the factors.
    #[inline(always)]
    pub fn correct(&mut self) {
        self.h.apart(Correct(self));
    }

    #[inline(always)]
    fn solve_for_correction(&mut self) {
        for n in 0..self.residual.len() {
            for i in 0..4 {
                self.correction[n][i] = -self.residual[n][i];
            }
        }
        for k in 0..self.guides.len() {
            let (guide, state) = (&self.numbers.guides[k], &self.guides[k]);
            let push = state.left_over();
            for (i, c) in guide.row().iter().enumerate() {
                let target = &mut self.correction[guide.node + i / 4][i % 4];
                *target = target.sub_product(push, *c);
            }
        }
        project_held(&self.numbers.prescribed, &mut self.correction);
        self.solve_constrained(true);
        for k in 0..self.guides.len() {
            let (guide, state) = (&self.numbers.guides[k], &mut self.guides[k]);
            let moved = guide.along(&self.correction);
            let [slope, inertia] = state.factored;
            state.correction = (slope * moved - state.residual) / inertia;
        }
    }
}

/// See [`Engine::evaluate`].
struct Evaluate<'a, S: Number, const TANGENT: bool>(&'a mut Engine<S>);

impl<S: Number, const TANGENT: bool> Task for Evaluate<'_, S, TANGENT> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        self.0.balance::<TANGENT>();
    }
}

/// See [`Engine::factor`].
struct FactorBand<'a, S: Number>(&'a mut Engine<S>);

impl<S: Number> Task for FactorBand<'_, S> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        self.0.hold_and_factor();
    }
}

/// See [`Engine::correct`].
struct Correct<'a, S: Number>(&'a mut Engine<S>);

impl<S: Number> Task for Correct<'_, S> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        self.0.solve_for_correction();
    }
}
