//! Values of the steps of a run with its derivatives: solved in a lane, without derivatives, with one factorisation of the tangent at the solution
//! for the derivatives by all parameters.

use super::engine::Engine;
use super::impact::Press;
use super::ledger::LaneLedger;
use super::newton::LaneNewton;
use super::numbers::Numbers;
use percuss::internals::scalar::{Lanes, Mask, Number, in_lanes};
use percuss::internals::step::projection::project_held;

/// Solves the steps of a run whose numbers have derivatives for their values.
pub trait SolvesValues<D: Number> {
    /// Solves the current step of a run: its increments, impulses, multipliers, and the factors of the tangent there; false without a solution.
    fn solve(&mut self, run: &mut Engine<D>, ledger: &LaneLedger<D>) -> bool;
    /// Corrections and factorisations so far.
    fn effort(&self) -> [f64; 2];
}

/// A solver in the widest registers of the processor.
pub fn value_solver<D: Number + 'static>(numbers: &Numbers<D>) -> Box<dyn SolvesValues<D>> {
    in_lanes(MakeSolver(numbers))
}

/// See [`value_solver`].
struct MakeSolver<'a, D>(&'a Numbers<D>);

impl<D: Number + 'static> pulp::WithSimd for MakeSolver<'_, D> {
    type Output = Box<dyn SolvesValues<D>>;
    #[inline(always)]
    fn with_simd<P: pulp::Simd>(self, family: P) -> Self::Output {
        Box::new(ValueSolver::new(self.0, Lanes::new(family, 0.0)))
    }
}

/// The run without derivatives, in the first lane.
struct ValueSolver<L: Number> {
    engine: Engine<L>,
    ledger: LaneLedger<L>,
    search: LaneNewton<L>,
    /// Numbers of the state, shape (numbers) \[unit of each\].
    state: Vec<f64>,
}

impl<L: Number> ValueSolver<L> {
    /// For a run with the given numbers.
    fn new<D: Number>(numbers: &Numbers<D>, like: L) -> Self {
        let mut engine = Engine::new(numbers.map(&mut |x: D| like.constant(x.lane(0))));
        engine.apply_loads();
        let ledger = LaneLedger::open(&engine);
        let mut search = LaneNewton::idle(like);
        search.set_run(0, true);
        // Parts of steps have sizes of their own: factors serve those of about the same size.
        search.by_parts = true;
        Self { engine, ledger, search, state: Vec::new() }
    }

    /// Takes the state of the run, the size of its step, and the contact that may press.
    fn read<D: Number>(&mut self, run: &mut Engine<D>, ledger: &LaneLedger<D>) {
        let engine = &mut self.engine;
        let like = engine.h;
        let value = |x: D| like.constant(x.lane(0));
        self.state.clear();
        run.each_of_state(|x| self.state.push(x.lane(0)));
        let mut state = self.state.iter();
        engine.each_of_state(|x| {
            *x = like.constant(*state.next().expect("of the same shape"));
        });
        engine.h = value(run.h);
        let impulsive = run.constraints.impulsive.lane(0);
        engine.constraints.impulsive = like.mask(|_| impulsive);
        if let Some(press) = &run.press {
            let own = engine.press.get_or_insert_with(|| Press::new(&engine.numbers, press.guide));
            own.known &= own.guide == press.guide;
            let which = press.which.lane(0);
            (own.guide, own.which) = (press.guide, like.mask(|_| which));
            own.bound = value(press.bound);
        }
        let (sums, from) = (&mut self.ledger.sums, &ledger.sums);
        sums.energy_scale = value(from.energy_scale);
        sums.linear_scale = value(from.linear_scale);
    }

    /// Writes the solution and the factors there. Derivatives begin as those of a uniform motion; the next linear step makes them right.
    fn write<D: Number>(&self, run: &mut Engine<D>) {
        let engine = &self.engine;
        let h = run.h;
        for n in 0..run.increment.len() {
            for i in 0..4 {
                let value = engine.increment[n][i].lane(0);
                run.increment[n][i] = with_value(h * run.velocity[n][i], value);
            }
        }
        project_held(&run.numbers.prescribed, &mut run.increment);
        run.predict_multipliers();
        for (mine, own) in run.constraints.each.iter_mut().zip(&engine.constraints.each) {
            mine.multiplier = with_value(mine.multiplier, own.multiplier.lane(0));
        }
        for (mine, own) in run.guides.iter_mut().zip(&engine.guides) {
            mine.increment = with_value(h * mine.velocity, own.increment.lane(0));
            mine.impulse = h.constant(own.impulse.lane(0));
            mine.factored = own.factored.map(|x| h.constant(x.lane(0)));
        }
        let (to, from) = (&mut run.factors, &engine.factors);
        for (to, from) in
            [(&mut to.diag, &from.diag), (&mut to.upper, &from.upper), (&mut to.lower, &from.lower)]
        {
            let to = to.as_flattened_mut().as_flattened_mut();
            for (to, from) in to.iter_mut().zip(from.as_flattened().as_flattened()) {
                *to = h.constant(from.lane(0));
            }
        }
    }
}

/// The derivatives of a number with another value.
fn with_value<D: Number>(x: D, value: f64) -> D {
    x + x.constant(value - x.lane(0))
}

impl<D: Number, L: Number> SolvesValues<D> for ValueSolver<L> {
    fn solve(&mut self, run: &mut Engine<D>, ledger: &LaneLedger<D>) -> bool {
        self.read(run, ledger);
        self.engine.solve(&self.ledger, &mut self.search);
        if self.search.failed.lane(0) {
            return false;
        }
        self.engine.renew_at_solution(&mut self.search);
        self.write(run);
        true
    }

    fn effort(&self) -> [f64; 2] {
        [self.search.iterations.lane(0), self.search.factorizations.lane(0)]
    }
}
