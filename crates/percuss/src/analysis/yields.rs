//! Springs and hinges that yield, at rest.

use super::static_search::Reached;
use crate::element::fibre::StressLaw;
use crate::model::Model;
use crate::model::frozen::{Connector, Coordinate, YieldingLaw};
use crate::state::State;

/// A spring or an elastic hinge that can yield, in equilibrium.
#[derive(Clone, Debug, PartialEq)]
pub struct StaticYielding {
    /// What it is and its name, `spring.brace` or `joint.knee`.
    pub name: String,
    /// Whether it is a hinge: its extensions are rotations, its force a moment then.
    pub turns: bool,
    /// Extension from the length without force, or rotation \[m, rad\].
    pub extension: f64,
    /// What of it is plastic \[m, rad\].
    pub plastic: f64,
    /// Its force, positive in tension, or moment \[N, N m\].
    pub force: f64,
    /// Whether it has yielded on the way.
    pub yielded: bool,
    /// Whether it has failed on the way.
    pub failed: bool,
}

/// The first yield of a spring or hinge along an equilibrium path.
#[derive(Clone, Debug, PartialEq)]
pub struct PathYield {
    /// What it is and its name, `spring.brace` or `joint.knee`.
    pub name: String,
    /// Load factor at which it yields, between the points of the path before and after by its extension.
    pub factor: f64,
}

impl Model {
    /// Connectors that can yield, their number and how, in the model's order.
    pub(crate) fn yielding(&self) -> impl Iterator<Item = (usize, &Connector, &YieldingLaw)> {
        let each = self.connectors.iter().enumerate();
        each.filter_map(|(i, c)| c.yielding.as_ref().map(|own| (i, c, own)))
    }
}

impl Connector {
    /// Whether it acts on an angle.
    pub(crate) fn turns(&self) -> bool {
        matches!(self.coordinate, Coordinate::Angle { .. })
    }
}

/// Springs and hinges that can yield in a state at rest.
pub(super) fn at_rest(model: &Model, state: &State) -> Vec<StaticYielding> {
    let each = model.yielding().map(|(i, c, own)| {
        let (q, memory) = (state.coordinates[i], &state.memories[own.memory]);
        StaticYielding {
            name: own.name.clone(),
            turns: c.turns(),
            extension: q - c.law.free(),
            plastic: memory.plastic,
            force: c.reached_force(q, &state.memories),
            yielded: memory.accumulated > 0.0,
            failed: memory.failed,
        }
    });
    each.collect()
}

/// What yields for the first time between two places of a path, in the order in which it does; `base` is what their increments
/// count from.
pub(super) fn between(
    model: &Model,
    base: &State,
    places: [&Reached; 2],
    factors: [f64; 2],
) -> Vec<PathYield> {
    let extension = |i: usize, c: &Connector, place: &Reached| {
        let add = |(u, d): (&[f64; 4], &[f64; 4])| std::array::from_fn(|k| u[k] + d[k]);
        let moved: Vec<[f64; 4]> =
            base.displacement.iter().zip(&place.increment).map(add).collect();
        c.value(&moved, base.coordinates[i]) - c.law.free()
    };
    let yielded = |place: &Reached, own: &YieldingLaw| place.memories[own.memory].accumulated > 0.0;
    let mut out: Vec<PathYield> = Vec::new();
    for (i, c, own) in model.yielding() {
        if yielded(places[0], own) || !yielded(places[1], own) {
            continue;
        }
        let [from, to] = places.map(|place| extension(i, c, place));
        let at = first_yield(&own.law, to);
        let share = ((at - from) / (to - from)).clamp(0.0, 1.0);
        let factor = factors[0] + share * (factors[1] - factors[0]);
        out.push(PathYield { name: own.name.clone(), factor });
    }
    out.sort_by(|a, b| {
        let along = |y: &PathYield| (y.factor - factors[0]) * (factors[1] - factors[0]).signum();
        along(a).total_cmp(&along(b))
    });
    out
}

/// Extension at which what has never yielded does, on the side of `to`.
fn first_yield(law: &StressLaw, to: f64) -> f64 {
    match law {
        StressLaw::Plastic(plastic) => {
            to.signum() * plastic.plasticity.first_yield() / plastic.young
        }
        _ => to,
    }
}
