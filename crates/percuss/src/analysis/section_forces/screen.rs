//! Which of several elements, or of several runs' elements, may have an extreme of the beam: the others need no further look.

use super::element::FLAT;
use super::line::SectionForces;
use crate::element::beam::SectionValues;
use crate::scalar::Number;
use crate::summary::SectionRange;

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
        let [axial, shear, moment] = may_exceed_between(&places[j - 1], at, known);
        turns = turns | axial | shear | moment;
    }
    [exceeds, turns]
}

/// Whether axial force, shear force and moment between two places half an element apart may be an extreme there, shape (3).
#[inline(always)]
pub fn may_exceed_between<S: Number>(
    a: &SectionForces<S>,
    b: &SectionForces<S>,
    known: &BeamExtremes<S>,
) -> [S::Mask; 3] {
    let (c, d) = (&a.rise, &b.rise);
    [
        may_exceed([a.axial, b.axial], [c.axial, d.axial], &known[0]),
        may_exceed([a.shear, b.shear], [c.shear, d.shear], &known[1]),
        may_exceed([a.moment, b.moment], [c.moment, d.moment], &known[2]),
    ]
}

/// Whether something turns between two places half an element apart, given its values and rises, and may be an extreme there.
#[inline(always)]
fn may_exceed<S: Number>(values: [S; 2], rise: [S; 2], range: &[S; 2]) -> S::Mask {
    let [least, most] = bounds(values, rise);
    let beyond = is_outside(most, range) | is_outside(least, range);
    let flat = values[0].abs().max(values[1].abs()) * FLAT;
    beyond & flat.less(rise[0].abs().max(rise[1].abs()) * 0.5) & turns(values, rise)
}

/// Least and largest that something may be between two places half an element apart. A cubic with these values and rises stays between
/// the values and what a third of the way along the tangents at both ends leads to (Bezier's points, a sixth of an element from them);
/// twice as far along these tangents what is of fifth degree stays, too.
#[inline(always)]
fn bounds<S: Number>([a, b]: [S; 2], rise: [S; 2]) -> [S; 2] {
    let (p, q) = (a + rise[0] * (1.0 / 3.0), b - rise[1] * (1.0 / 3.0));
    [least(least(a, b), least(p, q)), a.max(b).max(p.max(q))]
}

#[inline(always)]
fn least<S: Number>(a: S, b: S) -> S {
    a.if_less(b, a, b)
}

/// Whether something turns between two places: once, or, where the rise half-way is of another sign than at both ends, twice.
#[inline(always)]
fn turns<S: Number>([a, b]: [S; 2], rise: [S; 2]) -> S::Mask {
    let zero = a.constant(0.0);
    let half_way = (b - a) * 3.0 - (rise[0] + rise[1]) * 0.25;
    (rise[0] * rise[1]).less(zero) | (rise[0] * half_way).less(zero)
}

/// How far something gets beyond its values at these places at most.
#[inline(always)]
fn farther<S: Number>(values: [S; 2], rise: [S; 2]) -> S {
    let [lower, upper] = bounds(values, rise);
    let [a, b] = values;
    let beyond = (upper - a.max(b)).max(least(a, b) - lower);
    S::choose(turns(values, rise), beyond, a.constant(0.0))
}

/// What axial force and moment make of stress in the extreme fibres at both ends and in the middle of an element, shape (3, 2)
/// \[1/m^2, 1/m^3\].
pub type Depth<S> = [[S; 2]; 3];

/// The same of a section.
pub fn depth_of(section: &SectionValues) -> [f64; 2] {
    [section.area.recip(), section.half_depth / section.inertia]
}

/// Least and largest so far, shape (2).
pub fn extremes(range: &SectionRange) -> [f64; 2] {
    [range.min.value, range.max.value]
}

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
        let (wide, narrow) = (d[0].max(e[0]), least(d[0], e[0]));
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
