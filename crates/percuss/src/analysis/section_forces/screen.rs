//! Which of several elements, or of several runs' elements, may have an extreme of the beam: the others need no further look.

use super::element::FLAT;
use super::line::SectionForces;
use crate::scalar::Number;

/// Least and largest axial force, shear force and moment of a beam so far, shape (3, 2) \[N, N, N m\].
pub type BeamExtremes<S> = [[S; 2]; 3];

/// Whether elements exceed the extremes so far at their ends and in their middle, and whether they may between these.
#[inline(always)]
pub fn look_at<S: Number>(places: &[SectionForces<S>; 3], known: &BeamExtremes<S>) -> [S::Mask; 2] {
    let mut exceeds = is_outside(places[0].axial, &known[0]);
    let mut turns = !exceeds & exceeds;
    for (j, at) in places.iter().enumerate() {
        exceeds = exceeds
            | is_outside(at.axial, &known[0])
            | is_outside(at.shear, &known[1])
            | is_outside(at.moment, &known[2]);
        if j == 0 {
            continue;
        }
        let before = &places[j - 1];
        let (c, d) = (&before.rise, &at.rise);
        turns = turns
            | may_exceed([before.axial, at.axial], [c.axial, d.axial], &known[0])
            | may_exceed([before.shear, at.shear], [c.shear, d.shear], &known[1])
            | may_exceed([before.moment, at.moment], [c.moment, d.moment], &known[2]);
    }
    [exceeds, turns]
}

/// Whether something turns between two places half an element apart, given its values and rises, and may be an extreme there: further
/// than by its steepest rise it does not get.
#[inline(always)]
fn may_exceed<S: Number>([a, b]: [S; 2], rise: [S; 2], range: &[S; 2]) -> S::Mask {
    let (reach, turns) = reach([a, b], rise);
    let (most, least) = (a.max(b) + reach, -((-a).max(-b)) - reach);
    let beyond = is_outside(most, range) | is_outside(least, range);
    let flat = a.abs().max(b.abs()) * FLAT;
    beyond & flat.less(reach) & turns
}

/// How far something may get beyond its values at two places half an element apart, given these and its rises, and whether it turns
/// between them at all.
#[inline(always)]
fn reach<S: Number>([a, b]: [S; 2], rise: [S; 2]) -> (S, S::Mask) {
    let reach = rise[0].abs().max(rise[1].abs()) * 0.5;
    // It turns once, or, where the rise half-way is of another sign than at both ends, twice.
    let half_way = (b - a) * 3.0 - (rise[0] + rise[1]) * 0.25;
    let turn = (rise[0] * rise[1]).less(reach.constant(0.0));
    (reach, turn | (rise[0] * half_way).less(reach.constant(0.0)))
}

/// How far something gets beyond its values at these places at most.
#[inline(always)]
fn farther<S: Number>(values: [S; 2], rise: [S; 2]) -> S {
    let (reach, turns) = reach(values, rise);
    S::choose(turns, reach, reach.constant(0.0))
}

/// What axial force and moment make of stress in the extreme fibres at both ends and in the middle of an element, shape (3, 2)
/// \[1/m^2, 1/m^3\].
pub type Depth<S> = [[S; 2]; 3];

/// Least and largest stress at these places, shape (3, 2) \[Pa\].
#[inline(always)]
pub fn stresses_at<S: Number>(places: &[SectionForces<S>; 3], depth: &Depth<S>) -> [[S; 2]; 3] {
    let mut all = *depth;
    for j in 0..3 {
        let mean = places[j].axial * depth[j][0];
        let bent = places[j].moment.abs() * depth[j][1];
        all[j] = [mean - bent, mean + bent];
    }
    all
}

/// Whether stresses of an element may exceed those so far: at the places looked at, and between them, where axial force and moment are
/// no larger together than each is alone.
#[inline(always)]
pub fn look_at_stresses<S: Number>(
    places: &[SectionForces<S>; 3],
    depth: &Depth<S>,
    known: &[S; 2],
) -> [S::Mask; 2] {
    let stresses = stresses_at(places, depth);
    let mut exceeds = is_outside(stresses[0][0], known) | is_outside(stresses[0][1], known);
    let mut may = !exceeds & exceeds;
    for j in 1..3 {
        exceeds = exceeds | is_outside(stresses[j][0], known) | is_outside(stresses[j][1], known);
        let ([p, q], [d, e]) = ([&places[j - 1], &places[j]], [&depth[j - 1], &depth[j]]);
        let (n, m) = ([p.axial, q.axial], [p.moment.abs(), q.moment.abs()]);
        let far = farther(n, [p.rise.axial, q.rise.axial]);
        let turned = farther([p.moment, q.moment], [p.rise.moment, q.rise.moment]);
        let bent = (m[0].max(m[1]) + turned) * d[1].max(e[1]);
        let (wide, narrow) = (d[0].max(e[0]), -((-d[0]).max(-e[0])));
        let (pulled, pushed) = (n[0].max(n[1]) + far, (-n[0]).max(-n[1]) + far);
        let zero = far.constant(0.0);
        let most = pulled * zero.if_less(pulled, wide, narrow) + bent;
        let least = pushed * zero.if_less(pushed, wide, narrow) + bent;
        may = may | is_outside(most, known) | is_outside(-least, known);
    }
    [exceeds, may]
}

/// Whether values are less than the least or more than the largest so far.
#[inline(always)]
fn is_outside<S: Number>(value: S, [least, most]: &[S; 2]) -> S::Mask {
    !(least.at_most(value) & value.at_most(*most))
}
