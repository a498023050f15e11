//! The gap over a step: its projected discrete gradient (theory, section 6).
//!
//! The gradient in the middle of the step, where the foot is found anew, is corrected along the part of the increment that is no
//! rigid motion, so that on the increment it gives the change of the gap exactly. A force along it does the work of its
//! potential, and gives no momentum and no angular momentum, wherever the foot slides to.

use super::configuration::Configuration;
use super::pair::{Centre, Memory, Pair, Target};
use super::row::Row;
use super::search::farthest;
use super::touch::{Reach, Touch};
use crate::math::vec2::{add, cross, norm, rot90, scale, sub};
use crate::model::Model;

/// A miss below this share of the positions is round-off.
const ROUND_OFF: f64 = 4.0 * f64::EPSILON;
/// A correction along a motion smaller than this share of the increment would be round-off.
const NO_MOTION: f64 = 1e-14;

/// A pair over a step.
#[derive(Clone, Copy, Debug)]
pub struct StepGap {
    /// Gaps at start and end of the step \[m\].
    pub gaps: [f64; 2],
    /// Form of the gap's change on the increment.
    pub row: Row,
    /// The pair in the middle of the step.
    pub middle: Touch,
    /// What to remember at its end.
    pub end: Memory,
    /// Gradients in the middle and at the end, where they differ from the form.
    gradients: Option<[Row; 2]>,
}

impl StepGap {
    /// Gradient in the middle.
    pub fn middle_row(&self) -> &Row {
        self.gradients.as_ref().map_or(&self.row, |[middle, _]| middle)
    }

    /// Gradient at the end.
    pub fn end_row(&self) -> &Row {
        self.gradients.as_ref().map_or(&self.row, |[_, end]| end)
    }
}

impl Pair {
    /// The pair over the step of `at`, from a gap of `gap_0`; `None` where nothing can touch.
    pub fn over_step(
        &self,
        model: &Model,
        at: &Configuration,
        memory: &Memory,
        gap_0: f64,
        projected: bool,
    ) -> Option<StepGap> {
        let (mid, end) = (at.at(0.5), at.at(1.0));
        let middle = self.touch(model, &mid, memory, Reach::Near)?;
        if let Target::Guided { .. } = self.target {
            // The gap is linear: its gradient is the same everywhere.
            let last = self.touch(model, &end, memory, Reach::Near)?;
            let row = self.normal_row(&middle, &mid);
            let gaps = [gap_0, last.gap];
            return Some(StepGap { gaps, row, middle, end: last.memory, gradients: None });
        }
        let last = self.at_end_from(model, at, memory, &middle, gap_0)?;
        let middle_row = self.normal_row(&middle, &mid);
        let end_row = self.normal_row(&last, &end);
        let mut row = middle_row;
        let gradients = Some([middle_row, end_row]);
        // A foot that leaves for an end, or comes from there, opens or closes the pair.
        let finite = |gap: f64| if gap.is_finite() { gap } else { 0.0 };
        if !gap_0.is_finite() && !last.gap.is_finite() {
            return None;
        }
        let gaps = [finite(gap_0), finite(last.gap)];
        // The gap to a straight line that does not turn is linear, too.
        let straight = matches!(self.target, Target::Line { .. });
        if projected && !straight {
            let miss = (gaps[1] - gaps[0]) - row.on(at.increment);
            // A difference of gaps is known no better than the positions they are taken from.
            let place = norm(middle.foot_place) + self.reach;
            if miss.abs() <= ROUND_OFF * place {
                return Some(StepGap { gaps, row, middle, end: last.memory, gradients });
            }
            // The ends of the step may know other nodes.
            for (node, _) in end_row.iter() {
                row.add(node, [0.0; 4]);
            }
            correct(model, &mut row, at, miss);
        }
        Some(StepGap { gaps, row, middle, end: last.memory, gradients })
    }
}

impl Pair {
    /// The pair at the end of the step of `at`, from a gap of `gap_0`, as the next step will see it.
    pub fn at_end(
        &self,
        model: &Model,
        at: &Configuration,
        memory: &Memory,
        gap_0: f64,
    ) -> Option<Touch> {
        if !matches!(self.target, Target::Axis { .. }) {
            return self.touch_from(model, &at.at(1.0), memory, gap_0);
        }
        let middle = self.touch(model, &at.at(0.5), memory, Reach::Near)?;
        self.at_end_from(model, at, memory, &middle, gap_0)
    }

    /// The foot is followed over the middle of the step; what else is near may be nearer by its end.
    fn at_end_from(
        &self,
        model: &Model,
        at: &Configuration,
        memory: &Memory,
        middle: &Touch,
        gap_0: f64,
    ) -> Option<Touch> {
        let near = Memory { near: middle.memory.near, ..*memory };
        self.touch_from(model, &at.at(1.0), &near, gap_0)
    }

    /// The pair at `end`. What seems to have gone through, but was further away than the two have moved, has gone round an end.
    fn touch_from(
        &self,
        model: &Model,
        end: &Configuration,
        memory: &Memory,
        gap_0: f64,
    ) -> Option<Touch> {
        let touch = self.touch(model, end, memory, Reach::All)?;
        if touch.gap < -touch.apart.abs() && gap_0 > self.way(model, end) {
            let anew = Memory { side: 0.0, near: touch.memory.near };
            return self.touch(model, end, &anew, Reach::All);
        }
        Some(touch)
    }

    /// How far the two have moved since the start of the step, at most \[m\].
    fn way(&self, model: &Model, at: &Configuration) -> f64 {
        let of = |c: &Centre| norm(sub(c.place(at), c.place(&at.at(0.0))));
        let target = match &self.target {
            Target::Guided { point, .. } | Target::Line { point, .. } => of(point),
            Target::Round { centre } => of(centre),
            Target::Segment { ends } => of(&ends[0]).max(of(&ends[1])),
            Target::Axis { beam, .. } => {
                let beam = &model.beams[*beam];
                at.share * farthest(&at.increment[beam.nodes.clone()], beam.axis.longest)
            }
        };
        of(&self.source) + target
    }
}

/// Adds `miss / (q.W q) W q` with q the increment of the row's nodes less its rigid part, W = 1 for positions and the square of a
/// length for slopes.
fn correct(model: &Model, row: &mut Row, at: &Configuration, miss: f64) {
    let mid = at.at(0.5);
    let beams = model.beam_node_count();
    let length = |n: usize| if n < beams { model.node_length(n) } else { 0.0 };
    let count = row.iter().count() as f64;
    let place = |n: usize| {
        let (frame, u) = (&model.nodes[n], mid.node(n));
        (add(frame.position, [u[0], u[1]]), add(frame.tangent, [u[2], u[3]]))
    };
    let (mut centre, mut drift) = ([0.0; 2], [0.0; 2]);
    for (n, _) in row.iter() {
        let d = &at.increment[n];
        centre = add(centre, scale(1.0 / count, place(n).0));
        drift = add(drift, scale(1.0 / count, [d[0], d[1]]));
    }
    let (mut turn, mut inertia, mut size) = (0.0, 0.0, 0.0);
    for (n, _) in row.iter() {
        let (d, l2) = (&at.increment[n], length(n).powi(2));
        let (x, g) = place(n);
        let arm = sub(x, centre);
        let own = sub([d[0], d[1]], drift);
        turn += cross(arm, own);
        inertia += norm(arm).powi(2);
        size += norm([d[0], d[1]]).powi(2);
        if l2 > 0.0 {
            turn += l2 * cross(g, [d[2], d[3]]);
            inertia += l2 * norm(g).powi(2);
        }
    }
    let spin = if inertia > 0.0 { turn / inertia } else { 0.0 };
    let rest = |n: usize| {
        let d = &at.increment[n];
        let (x, g) = place(n);
        let own = sub(sub([d[0], d[1]], drift), scale(spin, rot90(sub(x, centre))));
        let slope = if n < beams { sub([d[2], d[3]], scale(spin, rot90(g))) } else { [0.0; 2] };
        [own[0], own[1], slope[0], slope[1]]
    };
    let weighed = |n: usize| {
        let (q, l2) = (rest(n), length(n).powi(2));
        [q[0], q[1], l2 * q[2], l2 * q[3]]
    };
    let squared: f64 = row
        .iter()
        .map(|(n, _)| rest(n).iter().zip(weighed(n)).map(|(a, b)| a * b).sum::<f64>())
        .sum();
    if squared <= NO_MOTION * NO_MOTION * size || squared == 0.0 {
        return;
    }
    for (n, c) in row.iter_mut() {
        let q = weighed(n);
        (0..4).for_each(|i| c[i] += miss / squared * q[i]);
    }
}
