//! Which of several elements, or of several runs' elements, may have an extreme of the beam: the others need no further look.

use super::element::FLAT;
use super::line::SectionForces;
use crate::scalar::Number;

/// Least and largest axial force, shear force and moment of a beam so far, shape (3, 2) \[N, N, N m\].
pub type Known<S> = [[S; 2]; 3];

/// Whether elements exceed the extremes so far at their ends and in their middle, and whether they may between these.
#[inline(always)]
pub fn look_at<S: Number>(places: &[SectionForces<S>; 3], known: &Known<S>) -> [S::Mask; 2] {
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
    let reach = rise[0].abs().max(rise[1].abs()) * 0.5;
    let (most, least) = (a.max(b) + reach, -((-a).max(-b)) - reach);
    let beyond = is_outside(most, range) | is_outside(least, range);
    let flat = a.abs().max(b.abs()) * FLAT;
    // It turns once, or, where the rise half-way is of another sign than at both ends, twice.
    let half_way = (b - a) * 3.0 - (rise[0] + rise[1]) * 0.25;
    let turn = (rise[0] * rise[1]).less(reach.constant(0.0));
    let turns = turn | (rise[0] * half_way).less(reach.constant(0.0));
    beyond & flat.less(reach) & turns
}

/// Whether values are less than the least or more than the largest so far.
#[inline(always)]
fn is_outside<S: Number>(value: S, [least, most]: &[S; 2]) -> S::Mask {
    !(least.at_most(value) & value.at_most(*most))
}
