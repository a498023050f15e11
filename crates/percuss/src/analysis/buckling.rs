//! Linear buckling: the load factor at which the tangent would turn singular if the geometric stiffness grew with the load.

mod outcome;
mod touching;

use super::equilibrium::Equilibrium;
use super::flutter::{FollowerStability, follower_stability};
use super::spectrum::{Held, Krylov, Layout, Matrix, Nodal, Ritz, free_motions};
use super::static_search::{StaticSearch, largest};
use crate::model::Model;
use crate::model::frozen::{Connector, ConnectorLaw, LoadAction};
use crate::settings::Scheme;
use crate::state::State;
use crate::step::given_strains;
pub use outcome::BucklingOutcome;
pub use touching::JustTouching;
use touching::{both_sides, line, loads, sides};

/// Additional vectors of the subspace, beside six for each requested factor.
const SPARE: usize = 80;
/// Steps down from the largest factor.
const STEP: f64 = 4.0;
/// Number of attempts to find missing factors.
const MOST_COUNTS: usize = 8;
/// Loads that move a structure by less than this share of its size are round-off.
const NO_LOAD: f64 = 1e-14;
/// Strains below this share of the displacements, relative to the size of the structure, are round-off of a motion without strain.
const NO_STRAIN: f64 = 1e-12;

/// A buckling mode of the linearised structure.
#[derive(Clone, Debug)]
pub struct BucklingMode {
    /// Factor on the loads that act at time zero.
    pub factor: f64,
    /// Nodal displacements and slopes, the largest component of a displacement one, shape (nodes, 4) \[-, 1/m\].
    pub shape: Vec<[f64; 4]>,
}

/// Linear buckling modes, or why there are none.
#[derive(Clone, Debug)]
pub struct LinearBuckling {
    /// Lowest positive factors, ascending, shape (modes found).
    pub modes: Vec<BucklingMode>,
    /// Reason and properties of the loss of stability.
    pub outcome: BucklingOutcome,
    /// Under follower loads, where stability is lost instead; not searched with active contacts.
    pub stability: Option<FollowerStability>,
    /// Number of stops behind a gap that are closed in the equilibrium: springs from the start, without their gaps.
    pub closed_stops: usize,
    /// Number of springs between points with the stiffness of the reference configuration whose stiffness in the equilibrium is another one: of
    /// tension or compression only, behind a slack or a gap that the loads close, or of a table.
    pub springs_as_unloaded: usize,
    /// Number of foundations with such springs.
    pub foundations_as_unloaded: usize,
    /// Springs and stops that round-off alone decides to be taut or slack, if there are any.
    pub touching: Option<JustTouching>,
}

impl LinearBuckling {
    /// What it assumes of springs and stops whose stiffness changes under the loads, in words, shape (assumptions).
    pub fn assumptions(&self) -> Vec<String> {
        let of = |count: usize, one: &str, many: &str| match count {
            0 => None,
            1 => Some(format!("1 {one}")),
            _ => Some(format!("{count} {many}")),
        };
        let stops = of(
            self.closed_stops,
            "stop behind a gap counts as a spring from the start, since the loads close it: its gap is neglected",
            "stops behind gaps count as springs from the start, since the loads close them: their gaps are neglected",
        );
        let springs = of(
            self.springs_as_unloaded,
            "spring has the stiffness of the reference configuration, not that under the loads (`percuss static --path` follows it)",
            "springs have the stiffness of the reference configuration, not that under the loads (`percuss static --path` follows them)",
        );
        let foundations = of(
            self.foundations_as_unloaded,
            "foundation has the stiffness of the reference configuration, not that under the loads (`percuss static --path` follows it)",
            "foundations have the stiffness of the reference configuration, not that under the loads (`percuss static --path` follows them)",
        );
        let touching = self.touching.map(|touching| touching.to_string());
        let all = stops.into_iter().chain(springs).chain(foundations).chain(touching);
        all.map(|what| format!("linear buckling: {what}")).collect()
    }
}

/// Linear buckling factors of the loads that act at time zero: the `count` lowest positive ones, in ascending order.
///
/// `(K + factor K_g) shape = 0` about the reference configuration, with K_g the geometric stiffness of the stresses of the linear response to the
/// loads; contacts are omitted. The number of factors below any value is that of the negative eigenvalues of `K + value K_g`, so that none is
/// missed, for any negative factors.
pub fn buckling(model: &Model, count: usize) -> LinearBuckling {
    result(&model.structure(), Vec::new(), count)
}

/// The same with the active contacts of an equilibrium kept closed: rigid ones do not move, like supports, compliant ones have the stiffness of
/// their law, like stops. Open ones and those of discs are omitted.
///
/// Closing of gaps of contacts and stops under the loads is neglected, as are all other displacements. A spring between points has the stiffness of the
/// reference configuration: none behind a slack or a gap. One that has failed in the equilibrium has none.
pub fn buckling_in_contact(model: &Model, found: &Equilibrium, count: usize) -> LinearBuckling {
    let mut structure = model.structure();
    let reference = vec![[0.0; 4]; structure.node_count()];
    let extent = structure.extent();
    let mut changes = Changes::new(&structure);
    // What just touches in the reference configuration, with its law to either side, shape (such connectors) [index of a connector].
    let mut touching: Vec<(usize, [ConnectorLaw; 2])> = Vec::new();
    let each = structure.connectors.iter_mut().zip(&found.state.coordinates).enumerate();
    for (i, (c, q)) in each {
        let from = c.value(&reference, 0.0);
        let now = c.law.stiffness_at(*q);
        if c.has_failed(&found.state.memories) {
            c.law = ConnectorLaw::Linear { stiffness: 0.0, rest: from };
        } else if matches!(c.law, ConnectorLaw::Linear { .. }) {
        } else if let Some(both) = both_sides(&c.law, from, from.abs().max(extent)) {
            c.law = both[softer(&both)].clone();
            touching.push((i, both));
        } else {
            let unloaded = c.law.stiffness_at(from);
            changes.note(c, unloaded, now);
            // A closed stop is a spring, an open one is none; others have the stiffness of the reference configuration.
            let stiffness = if c.support.is_some() { now } else { unloaded };
            c.law = line(&c.law, from, stiffness);
        }
    }
    // The larger stiffness of what the loads do not move, shape (such connectors) [index of a connector].
    let mut stiffer: Vec<(usize, ConnectorLaw)> = Vec::new();
    let sides = sides(&structure, &found.held, &touching);
    for ((i, both), side) in touching.into_iter().zip(sides) {
        let c = &mut structure.connectors[i];
        match side {
            Some(side) => {
                c.law = both[side].clone();
                let now = model.connectors[i].law.stiffness_at(found.state.coordinates[i]);
                changes.note(c, stiffness_of(&c.law), now);
            }
            None => stiffer.push((i, both[1 - softer(&both)].clone())),
        }
    }
    let all = with_touching(structure, stiffer, found, count);
    let Changes { closed_stops, springs: springs_as_unloaded, foundations } = changes;
    let foundations_as_unloaded = foundations.into_iter().filter(|changes| *changes).count();
    LinearBuckling { closed_stops, springs_as_unloaded, foundations_as_unloaded, ..all }
}

/// What has another stiffness in the equilibrium than in linear buckling: numbers of closed stops and of springs.
struct Changes {
    closed_stops: usize,
    springs: usize,
    /// Whether each foundation has, shape (foundations).
    foundations: Vec<bool>,
}

impl Changes {
    fn new(model: &Model) -> Self {
        let foundations = vec![false; model.foundations.len()];
        Self { closed_stops: 0, springs: 0, foundations }
    }

    /// Notes a connector with its stiffness without loads and in the equilibrium.
    fn note(&mut self, connector: &Connector, unloaded: f64, now: f64) {
        let changes = unloaded != now;
        match (connector.support, connector.foundation) {
            (Some(_), _) => self.closed_stops += usize::from(changes && now > 0.0),
            (None, Some(foundation)) => self.foundations[foundation] |= changes,
            (None, None) => self.springs += usize::from(changes),
        }
    }
}

/// Which of both sides has the smaller stiffness.
fn softer(both: &[ConnectorLaw; 2]) -> usize {
    usize::from(stiffness_of(&both[1]) < stiffness_of(&both[0]))
}

fn stiffness_of(law: &ConnectorLaw) -> f64 {
    law.stiffness_at(0.0)
}

/// The lower result of both stiffnesses of what just touches; `structure` has the smaller ones.
fn with_touching(
    mut structure: Model,
    stiffer: Vec<(usize, ConnectorLaw)>,
    found: &Equilibrium,
    count: usize,
) -> LinearBuckling {
    let soft = result(&structure, found.held.clone(), count);
    if stiffer.is_empty() {
        return soft;
    }
    let number = stiffer.len();
    for (i, law) in stiffer {
        structure.connectors[i].law = law;
    }
    let stiff = result(&structure, found.held.clone(), count);
    let lowest = |all: &LinearBuckling| all.modes.first().map_or(f64::NAN, |mode| mode.factor);
    let [a, b] = [lowest(&soft), lowest(&stiff)];
    // What the springs alone hold up is a mechanism without them.
    let slack = a <= b || (b.is_nan() && (!a.is_nan() || soft.outcome == stiff.outcome));
    let touching = Some(JustTouching { count: number, slack, other: if slack { b } else { a } });
    LinearBuckling { touching, ..if slack { soft } else { stiff } }
}

fn result(structure: &Model, held: Vec<Held>, count: usize) -> LinearBuckling {
    let alone = held.is_empty();
    let (modes, outcome) = match find(structure, held, count) {
        Ok(modes) => (modes, BucklingOutcome::Found),
        Err(outcome) => (Vec::new(), outcome),
    };
    let follows = alone && outcome == BucklingOutcome::Follower;
    let stability = follows.then(|| follower_stability(structure));
    let (closed_stops, springs_as_unloaded, foundations_as_unloaded) = (0, 0, 0);
    LinearBuckling {
        modes,
        outcome,
        stability,
        closed_stops,
        springs_as_unloaded,
        foundations_as_unloaded,
        touching: None,
    }
}

/// Stiffness and geometric stiffness, both symmetric.
struct Buckling<'l> {
    layout: &'l Layout<'l>,
    stiffness: Matrix,
    geometric: Matrix,
}

fn find(
    model: &Model,
    held: Vec<Held>,
    count: usize,
) -> Result<Vec<BucklingMode>, BucklingOutcome> {
    if model.has_inelastic_laws() {
        return Err(BucklingOutcome::Inelastic);
    }
    let rest = State::at_rest(model, Scheme::EnergyMomentum);
    let layout = Layout::holding(model, held);
    let unloaded = StaticSearch::at(model, &rest);
    if !free_motions(&layout, &unloaded).motions.is_empty() {
        return Err(BucklingOutcome::Mechanism);
    }
    let stiffness = layout.tangent_with(&unloaded, 0.0);
    let factored = layout.factor(stiffness.clone(), true).ok_or(BucklingOutcome::Unstable)?;
    if factored.negative > 0 {
        return Err(BucklingOutcome::Unstable);
    }
    let (response, multipliers) = factored.solve_with_multipliers(&loads(model, &rest));
    let given = given_strain(model);
    if largest(&response) <= NO_LOAD * unloaded.size() && given == 0.0 {
        return Err(BucklingOutcome::Unloaded);
    }
    let stressed = stressed(model, &rest, &response, &multipliers);
    let loaded = layout.tangent(&stressed);
    if !layout.is_symmetric(&loaded) {
        return Err(BucklingOutcome::Follower);
    }
    let geometric = layout.combined(&loaded, &stiffness, -1.0);
    let strain = largest_strain(model, &stressed).max(given);
    let round_off = NO_STRAIN * largest(&response) / unloaded.size();
    let found = Buckling { layout: &layout, stiffness, geometric };
    match found.lowest(count, 1.0 / strain.max(round_off)) {
        Err(BucklingOutcome::Never { .. }) if strain < round_off => {
            Err(BucklingOutcome::Unstrained)
        }
        result => result,
    }
}

impl Buckling<'_> {
    /// Stiffness under `factor` times the loads.
    fn at(&self, factor: f64) -> Matrix {
        self.layout.combined(&self.stiffness, &self.geometric, factor)
    }

    /// Number of factors between zero and `factor`; `None` if it is one itself.
    fn below(&self, factor: f64) -> Option<usize> {
        Some(self.layout.factor(self.at(factor), true)?.negative)
    }

    /// The lowest factors up to `most`.
    fn lowest(&self, count: usize, most: f64) -> Result<Vec<BucklingMode>, BucklingOutcome> {
        let all = self.below(most).or_else(|| self.below(1.01 * most)).unwrap_or(0);
        if all == 0 {
            return Err(BucklingOutcome::Never { up_to: most });
        }
        let count = count.min(all);
        let mut shift = most / STEP;
        while self.below(shift).is_none_or(|n| n > 0) {
            shift /= STEP;
            if shift < 1e-12 * most {
                return Err(BucklingOutcome::Unfinished);
            }
        }
        let modes = self.above(shift, count).ok_or(BucklingOutcome::Unfinished)?;
        if modes.is_empty() && count > 0 { Err(BucklingOutcome::Unfinished) } else { Ok(modes) }
    }

    /// The lowest factors, all of them above `shift`: `(K + shift K_g)^-1 K` has the eigenvalues `factor / (factor - shift)`, of which only those
    /// of positive factors are above one.
    fn above(&self, shift: f64, count: usize) -> Option<Vec<BucklingMode>> {
        let factored = self.layout.factor(self.at(shift), false)?;
        let image_of = |x: &Nodal| self.layout.multiply(&self.stiffness, x);
        let solve = |image: &Nodal| factored.solve(image);
        let mut krylov = Krylov::new(self.layout.model.node_count(), &[], image_of, solve);
        (0..2).for_each(|_| _ = krylov.join());
        let factor = |ratio: f64| shift * ratio / (ratio - 1.0);
        let mut least = count;
        for _ in 0..MOST_COUNTS {
            let exhausted =
                !krylov.grow(least, 6 * count + SPARE, |k| k.settled(&k.symmetric(), count));
            let mut found = krylov.symmetric();
            found.retain(|r| r.value.re > 1.0 + 1e-12);
            if let Some(last) = found.get(count.min(found.len()).wrapping_sub(1)) {
                let above = factor(last.value.re) * (1.0 + 1e-6);
                let there = found.iter().filter(|r| factor(r.value.re) < above).count();
                if there >= count && self.below(above).is_none_or(|n| n <= there) {
                    let mode = |r: &Ritz| normalized(factor(r.value.re), krylov.shape(r).x);
                    return Some(found.iter().take(count).map(mode).collect());
                }
            }
            if exhausted {
                return None;
            }
            (0..2).for_each(|_| _ = krylov.join());
            least = krylov.size() + 12;
        }
        None
    }
}

fn normalized(factor: f64, mut shape: Vec<[f64; 4]>) -> BucklingMode {
    let most = shape.iter().fold(0.0_f64, |m, x| m.max(x[0].abs()).max(x[1].abs()));
    shape.as_flattened_mut().iter_mut().for_each(|c| *c /= most);
    BucklingMode { factor, shape }
}

/// The reference configuration under the stresses of the linear response, without its displacements.
fn stressed<'m>(
    model: &'m Model,
    rest: &State,
    response: &[[f64; 4]],
    multipliers: &[f64],
) -> StaticSearch<'m> {
    let mut search = StaticSearch::at(model, rest);
    search.forcing.set_static(model, 1.0);
    search.forcing.rest_motions();
    search.work.multiplier.copy_from_slice(multipliers);
    search.work.correction.copy_from_slice(response);
    search.foresee(false);
    search
}

/// Largest strain of the stresses foreseen: membrane strains, and those of bending at a radius of gyration.
fn largest_strain(model: &Model, search: &StaticSearch) -> f64 {
    let mut most = f64::MIN_POSITIVE;
    for (span, k, _, e) in model.each_element() {
        let law = &span.table(k).rows[1].section;
        let radius = law.gyration();
        for [membrane, bending] in search.base.strain[e] {
            most = most.max(membrane.abs()).max(radius * bending.abs());
        }
    }
    most
}

/// Largest strain that loads give to elements at time zero: a heated bar between walls is stressed without a displacement.
fn given_strain(model: &Model) -> f64 {
    let factors = given_strains::factors_at(model, 0.0);
    let mut most = 0.0_f64;
    for (load, factor) in model.loads.iter().zip(&factors) {
        if let LoadAction::Strain { elements, .. } = &load.kind {
            most = elements.iter().map(|e| (factor * e.strain).abs()).fold(most, f64::max);
        }
    }
    most
}
