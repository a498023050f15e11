//! The gap over a step: its projected discrete gradient (theory, page 3).
//!
//! The gradient in the middle of the step, for the closest point there, is corrected along the non-rigid part of the increment, so that on the
//! increment it gives the change of the gap exactly. The work of a force along it is that of its potential, and it has no resultant momentum and
//! angular momentum, for any sliding of the closest point.

use super::search::farthest_of;
use crate::geometry::configuration::Configuration;
use crate::geometry::pair::{Centre, Memory, Pair, Target};
use crate::geometry::row::{self, Row};
use crate::geometry::touch::{SearchRegion, Touch};
use crate::math::vec2::{add, cross, dot, norm, rot90, scale, sub};
use crate::model::Model;

/// A miss below this share of the positions is round-off.
const ROUND_OFF: f64 = 4.0 * f64::EPSILON;
/// A correction along a motion smaller than this share of the increment would be round-off.
const NO_MOTION: f64 = 1e-14;

/// A pair over a step.
#[derive(Clone, Copy, Debug)]
pub struct StepGap {
    /// Gaps at start and end of the step, shape (2) \[m\].
    pub gaps: [f64; 2],
    /// Form of the gap's change on the increment.
    pub row: Row,
    /// The pair in the middle of the step.
    pub middle: Touch,
    /// The pair at its end.
    pub end: Touch,
}

impl Pair {
    /// The pair over the step of `at`, from a gap of `gap_0`, with its closest point at the end within `reach`; `None` where contact is impossible.
    pub fn over_step(
        &self,
        model: &Model,
        at: &Configuration,
        memory: &Memory,
        gap_0: f64,
        projected: bool,
        reach: SearchRegion,
    ) -> Option<StepGap> {
        let mid = at.at(0.5);
        let middle = self.touch(model, &mid, memory, SearchRegion::Near)?;
        if let Target::Guided { .. } | Target::Line { .. } = self.target {
            let row = match &self.target {
                // The normal is fixed: only sections that turn make the gap nonlinear.
                Target::Line { point, normal } => self.line_row(point, *normal, at),
                // The gap is linear: its gradient is the same everywhere.
                _ => self.normal_row(&middle, &mid),
            };
            let end = self.touch(model, &at.at(1.0), memory, SearchRegion::Near)?;
            return Some(StepGap { gaps: [gap_0, end.gap], row, middle, end });
        }
        let mut row = self.normal_row(&middle, &mid);
        let end = self.at_end_from(model, at, memory, &middle, gap_0, reach)?;
        // A closest point that moves to an end, or from it, opens or closes the pair.
        let finite = |gap: f64| if gap.is_finite() { gap } else { 0.0 };
        if !gap_0.is_finite() && !end.gap.is_finite() {
            return None;
        }
        let gaps = [finite(gap_0), finite(end.gap)];
        if projected {
            let miss = (gaps[1] - gaps[0]) - row.on(at.increment);
            // A difference of gaps is known no better than the positions they are taken from.
            let place = norm(middle.closest_place) + self.reach;
            if miss.abs() > ROUND_OFF * place {
                // The end of the step may have other nodes.
                end.closest.nodes().for_each(|n| row.add(n, [0.0; 4]));
                correct(model, &mut row, at, miss);
            }
        }
        Some(StepGap { gaps, row, middle, end })
    }
}

impl Pair {
    /// Gap of a guided projectile, which is linear; `None` for other pairs, and if the struck point no longer belongs to a beam \[m\]. The same as
    /// in [`Pair::touch`], for the many evaluations within an iteration.
    pub fn guided_gap(&self, at: &Configuration) -> Option<f64> {
        let Target::Guided { point, normal, standoff } = &self.target else { return None };
        if self.source.is_parted(at) || point.is_parted(at) {
            return None;
        }
        let apart = sub(self.source.displacement(at), point.displacement(at));
        Some(standoff + dot(*normal, apart))
    }

    /// Its gradient, as in [`Pair::normal_row`]; empty for other pairs.
    pub fn guided_row(&self, at: &Configuration) -> Row {
        let mut row = Row::default();
        if let Target::Guided { point, normal: n, .. } = &self.target {
            self.source.add_force(&mut row, *n, at);
            point.add_force(&mut row, [-n[0], -n[1]], at);
            let arm = sub(point.place(at), self.source.place(at));
            self.source.add_couple(&mut row, cross(arm, *n), at);
        }
        row
    }

    /// The form of the gap to a line through `point`: exact on the increment.
    fn line_row(&self, point: &Centre, normal: [f64; 2], at: &Configuration) -> Row {
        let mut row = Row::default();
        self.source.add_force_over(&mut row, normal, at);
        point.add_force(&mut row, scale(-1.0, normal), &at.at(0.5));
        // The force acts between the places of the source at both ends of the step.
        let [first, last] = [0.0, 1.0].map(|share| self.source.place(&at.at(share)));
        let arm = sub(scale(0.5, add(first, last)), point.place(&at.at(0.5)));
        point.add_couple(&mut row, -cross(arm, normal), at);
        row
    }

    /// The pair at the end of the step of `at`, from a gap of `gap_0`, as in the next step.
    pub fn at_end(
        &self,
        model: &Model,
        at: &Configuration,
        memory: &Memory,
        gap_0: f64,
    ) -> Option<Touch> {
        if !self.target.is_outline() {
            return self.touch_from(model, &at.at(1.0), memory, gap_0, SearchRegion::All);
        }
        let middle = self.touch(model, &at.at(0.5), memory, SearchRegion::Near)?;
        self.at_end_from(model, at, memory, &middle, gap_0, SearchRegion::All)
    }

    /// The closest point is followed over the middle of the step; another point may be nearer at its end.
    fn at_end_from(
        &self,
        model: &Model,
        at: &Configuration,
        memory: &Memory,
        middle: &Touch,
        gap_0: f64,
        reach: SearchRegion,
    ) -> Option<Touch> {
        let near = Memory { near: middle.memory.near, ..*memory };
        self.touch_from(model, &at.at(1.0), &near, gap_0, reach)
    }

    /// The pair at `end`. If it seems to have passed through, but the gap was larger than the motion of the two, it has passed around an end.
    fn touch_from(
        &self,
        model: &Model,
        end: &Configuration,
        memory: &Memory,
        gap_0: f64,
        reach: SearchRegion,
    ) -> Option<Touch> {
        let touch = self.touch(model, end, memory, reach)?;
        if touch.gap < -touch.apart.abs() && gap_0 > self.way(model, end) {
            let restarted = Memory { side: 0.0, near: touch.memory.near };
            return self.touch(model, end, &restarted, reach);
        }
        Some(touch)
    }

    /// Upper bound of the motion of the two since the start of the step \[m\].
    fn way(&self, model: &Model, at: &Configuration) -> f64 {
        let of = |c: &Centre| norm(sub(c.place(at), c.place(&at.at(0.0))));
        let target = match &self.target {
            Target::Guided { point, .. } | Target::Line { point, .. } => of(point),
            Target::Round { centre } => of(centre),
            Target::Segment { ends } => of(&ends[0]).max(of(&ends[1])),
            Target::Axis { beam, .. } => {
                let beam = &model.beams[*beam];
                at.share * farthest_of(beam, at.increment)
            }
        };
        of(&self.source) + target
    }
}

/// A node of a row in the middle of the step.
#[derive(Clone, Copy, Default)]
struct Mover {
    /// Position, shape (2) \[m\].
    position: [f64; 2],
    /// The tangent, shape (2) \[-\]; zero for a body, whose angle has no influence.
    tangent: [f64; 2],
    /// Increment of the position, shape (2) \[m\].
    moves: [f64; 2],
    /// Increment of the tangent, shape (2) \[-\].
    turns: [f64; 2],
    /// Weight of slopes: the square of a length \[m^2\].
    weight: f64,
}

impl Mover {
    fn new(model: &Model, mid: &Configuration, node: usize) -> Self {
        let (frame, u, d) = (&model.nodes[node], mid.node(node), &mid.increment[node]);
        let (position, moves) = (add(frame.position, [u[0], u[1]]), [d[0], d[1]]);
        if node >= model.beam_node_count() {
            return Self { position, moves, ..Self::default() };
        }
        Self {
            position,
            tangent: add(frame.tangent, [u[2], u[3]]),
            moves,
            turns: [d[2], d[3]],
            weight: model.node_length(node).powi(2),
        }
    }
}

/// Adds `miss / (q.W q) W q` with q the increment of the row's nodes less its rigid part, W = 1 for positions and the square of a
/// length for slopes.
fn correct(model: &Model, row: &mut Row, at: &Configuration, miss: f64) {
    let mid = at.at(0.5);
    let mut store = [Mover::default(); row::CAPACITY];
    let mut count = 0;
    for (mover, (n, _)) in store.iter_mut().zip(row.iter()) {
        *mover = Mover::new(model, &mid, n);
        count += 1;
    }
    let movers = &mut store[..count];
    let share = 1.0 / count as f64;
    let mean = |of: fn(&Mover) -> [f64; 2]| scale(share, movers.iter().map(of).fold([0.0; 2], add));
    let (centre, drift) = (mean(|m| m.position), mean(|m| m.moves));
    let (mut turn, mut inertia, mut size) = (0.0, 0.0, 0.0);
    for m in movers.iter_mut() {
        size += dot(m.moves, m.moves);
        m.position = sub(m.position, centre);
        m.moves = sub(m.moves, drift);
        turn += cross(m.position, m.moves) + m.weight * cross(m.tangent, m.turns);
        inertia += dot(m.position, m.position) + m.weight * dot(m.tangent, m.tangent);
    }
    let spin = if inertia > 0.0 { turn / inertia } else { 0.0 };
    let mut squared = 0.0;
    for m in movers.iter_mut() {
        m.moves = sub(m.moves, scale(spin, rot90(m.position)));
        m.turns = sub(m.turns, scale(spin, rot90(m.tangent)));
        squared += dot(m.moves, m.moves) + m.weight * dot(m.turns, m.turns);
    }
    if squared <= NO_MOTION * NO_MOTION * size || squared == 0.0 {
        return;
    }
    let factor = miss / squared;
    for ((_, c), m) in row.iter_mut().zip(movers) {
        (0..2).for_each(|i| c[i] += factor * m.moves[i]);
        (0..2).for_each(|i| c[2 + i] += factor * m.weight * m.turns[i]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Along, Beam, Material, PointRef, Projectile, ProjectileKind, Section};
    use crate::model::{Model, ModelBuilder};

    /// A beam struck obliquely between two nodes.
    fn model() -> Model {
        let mut b = ModelBuilder::new();
        let material = b.material(Material::new("m", 2e9, 3e3));
        let section = b.section(Section::new("s", 0.1, 8.33e-5));
        let girder = b.beam(Beam::new("girder", &[[0.0, 0.0], [3.0, 0.5]], 4, material, section));
        let at = PointRef { label: "struck".into(), beam: girder, along: Along::Fraction(0.3) };
        b.projectile(Projectile::new(
            "mass",
            ProjectileKind::spring(7.5e5),
            500.0,
            [3.0, 20.0],
            at,
        ));
        b.build().expect("a valid scene")
    }

    #[test]
    fn a_guided_gap_and_its_form_are_those_of_any_pair() {
        let model = model();
        let mut seed = 1_u64;
        let mut noise = |size: f64| -> Vec<[f64; 4]> {
            let mut next = || {
                seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
                size * ((seed >> 33) as f64 / (1_u64 << 30) as f64 - 1.0)
            };
            (0..model.node_count()).map(|_| std::array::from_fn(|_| next())).collect()
        };
        let (start, increment) = (noise(0.1), noise(0.01));
        let pair = &model.pairs[0];
        for share in [0.0, 0.5, 1.0] {
            let step = Configuration { increment: &increment, ..Configuration::of(&start) };
            let at = step.at(share);
            let touch = pair.touch(&model, &at, &Memory::default(), SearchRegion::Near).unwrap();
            assert_eq!(pair.guided_gap(&at), Some(touch.gap));
            assert_eq!(pair.guided_row(&at), pair.normal_row(&touch, &at));
        }
    }
}
