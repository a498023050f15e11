//! Springs and hinges that yield, at rest.

use super::static_search::Reached;
use super::unloading::{permanent_sets, set_beside};
use crate::element::fibre::StressLaw;
use crate::model::Model;
use crate::model::frozen::{Connector, YieldingLaw};
use crate::state::State;
use crate::summary::{NoPermanentSet, SetOfBeam};

/// A spring or an elastic hinge that can yield, in equilibrium.
#[derive(Clone, Debug, PartialEq)]
pub struct StaticYielding {
    /// Kind and name, `spring.brace` or `joint.knee`.
    pub name: String,
    /// Whether it is a hinge: its extensions are rotations, its force a moment then.
    pub turns: bool,
    /// Extension from the force-free length; or rotation, positive in the direction of a positive bending moment in the first of the two beams that
    /// begins or ends there \[m, rad\].
    pub extension: f64,
    /// Plastic part of it \[m, rad\].
    pub plastic: f64,
    /// Its force, positive in tension, or moment, which is the bending moment of that beam there \[N, N m\].
    pub force: f64,
    /// Whether it has yielded during loading.
    pub yielded: bool,
    /// Whether it has failed during loading.
    pub failed: bool,
    /// As in [`crate::YieldingSummary`].
    pub permanent_set: Result<SetOfBeam, NoPermanentSet>,
}

/// The first yield of a spring or hinge along an equilibrium path.
#[derive(Clone, Debug, PartialEq)]
pub struct PathYield {
    /// Kind and name, `spring.brace` or `joint.knee`.
    pub name: String,
    /// Load factor at which it yields.
    pub factor: f64,
}

/// Springs and hinges that can yield in a state at rest.
pub(super) fn at_rest(model: &Model, state: &State) -> Vec<StaticYielding> {
    let sets = if model.memory_count() > 0 { permanent_sets(model, state) } else { Vec::new() };
    let each = model.yielding().map(|(i, c, own)| {
        let (q, memory) = (state.coordinates[i], &state.memories[own.memory]);
        StaticYielding {
            name: own.name.clone(),
            turns: c.turns(),
            extension: own.sign * (q - c.law.free()) + 0.0,
            plastic: own.sign * memory.plastic + 0.0,
            force: own.sign * c.reached_force(q, &state.memories) + 0.0,
            yielded: memory.accumulated > 0.0,
            failed: memory.failed,
            permanent_set: set_beside(model, c, &sets),
        }
    });
    each.collect()
}

/// A first yield on an arc of a path.
pub(super) struct Crossing<'a> {
    pub own: &'a YieldingLaw,
    /// Load factor relative to the start of the arc at first yield, from its rate there.
    pub rise: f64,
}

/// First yields between two points of a path, in their order; increments are relative to `base`, `rate` is the derivative of nodal displacements
/// with respect to the load factor at the first point, `rise` the range of the search.
pub(super) fn between<'m>(
    model: &'m Model,
    base: &State,
    places: [&Reached; 2],
    (rate, rise): (&[[f64; 4]], f64),
) -> Vec<Crossing<'m>> {
    let moved = |increment: &[[f64; 4]], rise: f64| -> Vec<[f64; 4]> {
        let each = base.displacement.iter().zip(increment).zip(rate);
        each.map(|((u, d), r)| std::array::from_fn(|k| u[k] + d[k] + rise * r[k])).collect()
    };
    let [start, end] = places.map(|place| moved(&place.increment, 0.0));
    let ahead = moved(&places[0].increment, rise);
    let yielded = |place: &Reached, own: &YieldingLaw| place.memories[own.memory].accumulated > 0.0;
    let crosses = |own: &YieldingLaw| !yielded(places[0], own) && yielded(places[1], own);
    let crossing = |(i, c, own): (usize, &Connector, &'m YieldingLaw)| {
        let extension = |u: &[[f64; 4]]| c.value(u, base.coordinates[i]) - c.law.free();
        let (from, to) = (extension(&start), extension(&end));
        let share = (first_yield(&own.law, to) - from) / (extension(&ahead) - from);
        Crossing { own, rise: share * rise }
    };
    let mut out: Vec<Crossing> =
        model.yielding().filter(|(.., own)| crosses(own)).map(crossing).collect();
    out.sort_by(|a, b| a.rise.abs().total_cmp(&b.rise.abs()));
    out
}

/// Extension of first yield, on the side of `to`.
fn first_yield(law: &StressLaw, to: f64) -> f64 {
    match law {
        StressLaw::Plastic(plastic) => {
            to.signum() * plastic.plasticity.first_yield() / plastic.young
        }
        _ => to,
    }
}
