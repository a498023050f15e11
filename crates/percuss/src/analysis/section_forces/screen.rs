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
        let [axial, shear, moment] = may_exceed_between([&places[j - 1], at], 0.5, known);
        turns = turns | axial | shear | moment;
    }
    [exceeds, turns]
}

/// Whether axial force, shear force and moment between two places so many elements apart may be an extreme there, shape (3).
#[inline(always)]
pub fn may_exceed_between<S: Number>(
    [a, b]: [&SectionForces<S>; 2],
    apart: f64,
    known: &BeamExtremes<S>,
) -> [S::Mask; 3] {
    let (c, d) = (&a.rise, &b.rise);
    let piece = |values: [S; 2], rise: [S; 2]| CurvePiece { values, rise, apart };
    [
        piece([a.axial, b.axial], [c.axial, d.axial]).may_exceed(&known[0]),
        piece([a.shear, b.shear], [c.shear, d.shear]).may_exceed(&known[1]),
        piece([a.moment, b.moment], [c.moment, d.moment]).may_exceed(&known[2]),
    ]
}

/// A quantity between two places of an element.
#[derive(Clone, Copy)]
struct CurvePiece<S> {
    /// Its values at both, shape (2) \[in its unit\].
    values: [S; 2],
    /// Its derivatives there with respect to the share of the element's length, shape (2) \[in its unit\].
    rise: [S; 2],
    /// Distance of the places as a share of the element's length \[-\].
    apart: f64,
}

impl<S: Number> CurvePiece<S> {
    /// Whether it turns and may be an extreme.
    #[inline(always)]
    fn may_exceed(&self, range: &[S; 2]) -> S::Mask {
        let ([a, b], [c, d]) = (self.values, self.rise);
        let [least, most] = self.bounds();
        let beyond = is_outside(most, range) | is_outside(least, range);
        let flat = a.abs().max(b.abs()) * FLAT;
        beyond & flat.less(c.abs().max(d.abs()) * self.apart) & self.turns()
    }

    /// Least and largest that it may be. A cubic with these values and rises lies between the values and the points at a third of the way
    /// along the tangents at both ends (its Bezier control points). Section forces are of higher degree, so points at twice this distance
    /// are taken: no proof, but `no_recorded_point_shows_more_than_the_extremes_of_its_beam` and `scripts/audit-scenes` find no extreme beyond.
    #[inline(always)]
    fn bounds(&self) -> [S; 2] {
        let ([a, b], [c, d]) = (self.values, self.rise);
        let way = 2.0 / 3.0 * self.apart;
        let (p, q) = (a + c * way, b - d * way);
        [least(least(a, b), least(p, q)), a.max(b).max(p.max(q))]
    }

    /// Whether it turns: once, or, where the rise half-way is of another sign than at both ends, twice.
    #[inline(always)]
    fn turns(&self) -> S::Mask {
        let ([a, b], [c, d]) = (self.values, self.rise);
        let zero = a.constant(0.0);
        let half_way = (b - a) * (1.5 / self.apart) - (c + d) * 0.25;
        (c * d).less(zero) | (c * half_way).less(zero)
    }

    /// How far it gets beyond its values at both places at most.
    #[inline(always)]
    fn farther(&self) -> S {
        let ([a, b], [lower, upper]) = (self.values, self.bounds());
        let beyond = (upper - a.max(b)).max(least(a, b) - lower);
        S::choose(self.turns(), beyond, a.constant(0.0))
    }
}

#[inline(always)]
fn least<S: Number>(a: S, b: S) -> S {
    a.if_less(b, a, b)
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

/// Whether stresses of an element exceed those so far at the places looked at, and whether they may between them.
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
        let pair = [&places[j - 1], &places[j]];
        may = may | stress_may_exceed(pair, 0.5, [depth[j - 1], depth[j]], known);
    }
    [exceeds, may]
}

/// Whether stresses between two places so many elements apart may exceed those so far: axial force and moment are no larger together
/// than each is alone.
#[inline(always)]
pub fn stress_may_exceed<S: Number>(
    [a, b]: [&SectionForces<S>; 2],
    apart: f64,
    [d, e]: [[S; 2]; 2],
    known: &[S; 2],
) -> S::Mask {
    let n = [a.axial, b.axial];
    let pulling = CurvePiece { values: n, rise: [a.rise.axial, b.rise.axial], apart };
    let bending =
        CurvePiece { values: [a.moment, b.moment], rise: [a.rise.moment, b.rise.moment], apart };
    let far = pulling.farther();
    let most_bent = a.moment.abs().max(b.moment.abs()) + bending.farther();
    let bent = most_bent * d[1].max(e[1]);
    let (wide, narrow) = (d[0].max(e[0]), least(d[0], e[0]));
    let (pulled, pushed) = (n[0].max(n[1]) + far, (-n[0]).max(-n[1]) + far);
    let zero = far.constant(0.0);
    let most = pulled * zero.if_less(pulled, wide, narrow) + bent;
    let least = pushed * zero.if_less(pushed, wide, narrow) + bent;
    is_outside(most, known) | is_outside(-least, known)
}

/// Whether values are less than the least or more than the largest so far.
#[inline(always)]
fn is_outside<S: Number>(value: S, [least, most]: &[S; 2]) -> S::Mask {
    !(least.at_most(value) & value.at_most(*most))
}
