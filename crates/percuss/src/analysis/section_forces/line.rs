//! Section forces along one element, from its balance.
//!
//! What the neighbours exert on the ends of an element, and what acts along it, inertia included, determine its section
//! forces everywhere: with the force f per share of the way that accelerates the element beyond what loads do,
//!
//! `dn/dxi = f`, `dM/dxi = mu - dx/dxi x n`, `N = n . t`, `V = -n . J t`,
//!
//! t the unit tangent, J its turn by a quarter counter-clockwise, and mu the rotary inertia, spread evenly: it is what the balance of
//! moments leaves over. But for that `V = dM/ds`, s the arc length of the deformed beam. The force f is the cubic that does the same work as nodal loads and inertia on every motion the element knows, so that there is no balance error.

use pulp::Simd;
use serde::{Deserialize, Serialize};

use crate::element::shear::InsideField;
use crate::math::vec2::{add, cross, sub};
use crate::scalar::{Lanes, Real};

/// Inverse of the mass matrix of a uniform element of unit mass and length.
const UNIT_MASS_INVERSE: [[f64; 4]; 4] = [
    [16.0, -120.0, -4.0, -60.0],
    [-120.0, 1200.0, 60.0, 840.0],
    [-4.0, 60.0, 16.0, 120.0],
    [-60.0, 840.0, 120.0, 1200.0],
];

/// Places of an element that are nearer to each other than this share of it are one: which of two comes first is not for round-off to decide.
pub const SAME_PLACE: f64 = 1e-9;

/// Numbers of a [`Line`].
pub const NUMBERS: usize = 24;

/// Forces on both nodes of an element, on values and slopes \[N, N m\].
pub type OnNodes = [[f64; 4]; 2];

/// A force that acts at a place inside an element, at which the section forces jump.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct Inner {
    /// Its element.
    pub element: usize,
    /// Share of the way along it.
    pub xi: f64,
    /// The force, shape (2) \[N\].
    pub force: [f64; 2],
    /// Its couple, counter-clockwise \[N m\].
    pub couple: f64,
    /// Whether it has one: then that is what the balance of moments leaves over.
    pub has_couple: bool,
    /// What it exerts on the nodes of the element, on values and slopes, shape (2, 4) \[N, N m\].
    pub on_nodes: OnNodes,
}

/// The configuration of an element: its nodes in the reference, their displacements, its length.
#[derive(Clone, Copy, Debug)]
pub struct ElementShape<S = f64> {
    /// Tangents x' at both nodes, of a shear-flexible element their unit vectors, shape (2, 2) \[-\].
    pub tangents: [[S; 2]; 2],
    /// From the first node to the second, shape (2) \[m\].
    pub chord: [S; 2],
    /// Arc length of the reference \[m\].
    pub length: S,
}

/// Section forces of one element.
#[derive(Clone, Copy, Debug)]
pub struct Line<S = f64> {
    /// Coefficients of dx/dxi, by powers of xi, shape (3, 2) \[m\].
    way: [[S; 2]; 3],
    /// Coefficients of the force n that the part ahead exerts on the part behind, by powers of xi, shape (5, 2) \[N\].
    force: [[S; 2]; 5],
    /// Coefficients of the moment, by powers of xi, shape (8) \[N m\].
    moment: [S; 8],
}

/// Section forces at a place.
#[derive(Clone, Copy, Debug)]
pub struct SectionForces<S = f64> {
    /// Axial force, positive in tension \[N\].
    pub axial: S,
    /// Shear force, the derivative of the bending moment along the beam but for the rotary inertia \[N\].
    pub shear: S,
    /// Bending moment \[N m\].
    pub moment: S,
    /// Derivatives of these three with respect to the share of the way \[N, N, N m\].
    pub rise: Rise<S>,
}

/// How section forces change along an element.
#[derive(Clone, Copy, Debug)]
pub struct Rise<S = f64> {
    /// Of the axial force \[N\].
    pub axial: S,
    /// Of the shear force \[N\].
    pub shear: S,
    /// Of the bending moment \[N m\].
    pub moment: S,
}

impl<P: Simd> SectionForces<Lanes<P>> {
    /// Those of one lane.
    #[inline(always)]
    pub fn lane(&self, lane: usize) -> SectionForces {
        let Rise { axial, shear, moment } = self.rise;
        SectionForces {
            axial: self.axial.at(lane),
            shear: self.shear.at(lane),
            moment: self.moment.at(lane),
            rise: Rise { axial: axial.at(lane), shear: shear.at(lane), moment: moment.at(lane) },
        }
    }
}

// Elements side by side and those with forces inside, one by one, are to agree to the last bit: each product is rounded.
impl<S: Real> Line<S> {
    /// From the forces of the neighbours on both nodes, and what accelerates the element beyond its loads; with what the moment misses at the end.
    #[inline(always)]
    pub fn open(shape: &ElementShape<S>, ends: &[[S; 4]; 2], along: &[[S; 4]; 2]) -> (Self, S) {
        let (l, [ga, gb]) = (shape.length, &shape.tangents);
        let zero = l.constant(0.0);
        let mut line = Self { way: [[zero; 2]; 3], force: [[zero; 2]; 5], moment: [zero; 8] };
        let per_length = l.recip();
        for i in 0..2 {
            let (a, b, chord) = (l * ga[i], l * gb[i], shape.chord[i] * 6.0);
            line.way[0][i] = a;
            line.way[1][i] = chord - a * 4.0 - b * 2.0;
            line.way[2][i] = (a + b) * 3.0 - chord;
            let on = [
                along[0][i],
                along[0][2 + i] * per_length,
                along[1][i],
                along[1][2 + i] * per_length,
            ];
            let mut spread = on;
            for k in 0..4 {
                let row = &UNIT_MASS_INVERSE[k];
                spread[k] = on[0] * row[0] + on[1] * row[1] + on[2] * row[2] + on[3] * row[3];
            }
            let [f0, s0, f1, s1] = spread;
            line.force[0][i] = -ends[0][i];
            line.force[1][i] = f0;
            line.force[2][i] = s0 * 0.5;
            line.force[3][i] = (f1 - f0) - (s0 * 2.0 + s1) * (1.0 / 3.0);
            line.force[4][i] = (f0 - f1) * 0.5 + (s0 + s1) * 0.25;
        }
        line.moment[0] = -across(ga, &[ends[0][2], ends[0][3]]);
        for i in 0..3 {
            for j in 0..5 {
                let k = i + j + 1;
                line.moment[k] = line.moment[k] - across(&line.way[i], &line.force[j]);
            }
        }
        let mut sum = line.moment[0] + line.moment[1];
        for k in 2..8 {
            line.moment[k] = line.moment[k] * (1.0 / k as f64);
            sum += line.moment[k];
        }
        (line, across(gb, &[ends[1][2], ends[1][3]]) - sum)
    }

    /// Makes the moment at the end what it is there, which it misses so much of, without forces inside.
    #[inline(always)]
    pub fn close_smooth(&mut self, left: S) {
        self.moment[1] += left;
    }

    /// Section forces at a share of the way that forces inside do not jump at.
    #[inline(always)]
    pub fn smooth(&self, xi: f64) -> SectionForces<S> {
        let f = &self.force;
        let mut force = f[4];
        for i in 0..2 {
            for k in 0..4 {
                force[i] = force[i] * xi + f[3 - k][i];
            }
        }
        let mut moment = self.moment[7];
        for k in 0..7 {
            moment = moment * xi + self.moment[6 - k];
        }
        self.along(xi, &force, moment)
    }

    /// Section forces where force and moment are known.
    #[inline(always)]
    fn along(&self, xi: f64, force: &[S; 2], moment: S) -> SectionForces<S> {
        let ([a, b, c], f) = (&self.way, &self.force);
        let (mut way, mut turn_of_way, mut more) = (*a, *b, f[4]);
        for i in 0..2 {
            way[i] = a[i] + (b[i] + c[i] * xi) * xi;
            turn_of_way[i] = b[i] + c[i] * (2.0 * xi);
            more[i] = f[1][i] + (f[2][i] * 2.0 + (f[3][i] * 3.0 + f[4][i] * (4.0 * xi)) * xi) * xi;
        }
        let inverse = (way[0] * way[0] + way[1] * way[1]).sqrt().recip();
        let turn = across(force, &way);
        // What the rotary inertia adds is the difference of the first coefficients.
        let rotary = self.moment[1] + across(&self.way[0], &self.force[0]);
        let (axial, shear) = (within(&way, force) * inverse, turn * inverse);
        // The length of dx/dxi changes, too.
        let longer = within(&way, &turn_of_way) * inverse * inverse;
        let along = within(&turn_of_way, force) + within(&way, &more);
        let beside = across(force, &turn_of_way) + across(&more, &way);
        let rise = Rise {
            axial: along * inverse - axial * longer,
            shear: beside * inverse - shear * longer,
            moment: rotary + turn,
        };
        SectionForces { axial, shear, moment, rise }
    }
}

/// `a . b`, each product rounded.
#[inline(always)]
fn within<S: Real>(a: &[S; 2], b: &[S; 2]) -> S {
    a[0] * b[0] + a[1] * b[1]
}

/// `a x b`, each product rounded.
#[inline(always)]
fn across<S: Real>(a: &[S; 2], b: &[S; 2]) -> S {
    a[0] * b[1] - a[1] * b[0]
}

impl<S: Real> Line<S> {
    /// Its numbers in a fixed order.
    #[inline(always)]
    pub fn numbers(&self) -> [S; NUMBERS] {
        let mut numbers = [self.moment[0]; NUMBERS];
        for i in 0..3 {
            (numbers[2 * i], numbers[2 * i + 1]) = (self.way[i][0], self.way[i][1]);
        }
        for i in 0..5 {
            (numbers[6 + 2 * i], numbers[7 + 2 * i]) = (self.force[i][0], self.force[i][1]);
        }
        numbers[16..].copy_from_slice(&self.moment);
        numbers
    }

    /// From its numbers.
    #[inline(always)]
    pub fn from_numbers(numbers: [S; NUMBERS]) -> Self {
        let zero = [numbers[0]; 2];
        let mut line = Self { way: [zero; 3], force: [zero; 5], moment: [numbers[0]; 8] };
        for i in 0..3 {
            line.way[i] = [numbers[2 * i], numbers[2 * i + 1]];
        }
        for i in 0..5 {
            line.force[i] = [numbers[6 + 2 * i], numbers[7 + 2 * i]];
        }
        line.moment.copy_from_slice(&numbers[16..]);
        line
    }
}

impl Line {
    /// The same with forces inside, already taken out of `ends`.
    pub fn new(shape: &ElementShape, ends: &OnNodes, along: &OnNodes, inner: &mut [Inner]) -> Self {
        let (mut line, left) = Self::open(shape, ends, along);
        line.close(left, inner);
        line
    }

    /// Of a shear-flexible element, whose vectors d are given as tangents: the moments at its ends are those on d, and N and V are along and across d
    /// everywhere, which between its nodes is that of the field inside. The force along it is linear; rotary inertia is what the balance of moments
    /// leaves over.
    pub fn sheared(
        shape: &ElementShape,
        inside: InsideField,
        [ends, along]: [&OnNodes; 2],
        inner: &mut [Inner],
    ) -> Self {
        let mut line = Self { way: [[0.0; 2]; 3], force: [[0.0; 2]; 5], moment: [0.0; 8] };
        let (l, [da, db]) = (shape.length, &shape.tangents);
        let shear = inside.sheared([[0.0; 2], shape.chord], shape.tangents);
        for i in 0..2 {
            let (a, b) = (l * (da[i] + shear[i]), l * (db[i] + shear[i]));
            let chord = 6.0 * shape.chord[i];
            line.way[0][i] = a;
            line.way[1][i] = chord - 4.0 * a - 2.0 * b;
            line.way[2][i] = 3.0 * (a + b) - chord;
            let (on_a, on_b) = (along[0][i], along[1][i]);
            line.force[0][i] = -ends[0][i];
            line.force[1][i] = 4.0 * on_a - 2.0 * on_b;
            line.force[2][i] = 3.0 * (on_b - on_a);
        }
        line.moment[0] = -across(da, &[ends[0][2], ends[0][3]]);
        for (i, way) in line.way.iter().enumerate() {
            for (j, force) in line.force.iter().enumerate() {
                line.moment[i + j + 1] -= across(way, force) / (i + j + 1) as f64;
            }
        }
        let sum: f64 = line.moment.iter().sum();
        line.close(across(db, &[ends[1][2], ends[1][3]]) - sum, inner);
        line.turn_with_sections(shape, inside.bent, inner);
        line
    }

    /// Puts the direction of the sections in the place of that of the axis. The arms of forces inside are then without shear; what the moment at
    /// the end lacks of them is spread along the element.
    fn turn_with_sections(&mut self, shape: &ElementShape, bent: f64, inner: &[Inner]) {
        let moments = |line: &Self| -> f64 {
            inner.iter().map(|one| cross(line.between(one.xi, 1.0), one.force)).sum()
        };
        let before = moments(self);
        let (l, [da, db]) = (shape.length, &shape.tangents);
        for i in 0..2 {
            let turned = 6.0 * bent * (shape.chord[i] - 0.5 * l * (da[i] + db[i]));
            self.way[0][i] = l * da[i];
            self.way[1][i] = l * (db[i] - da[i]) + turned;
            self.way[2][i] = -turned;
        }
        self.moment[1] += before - moments(self);
    }

    /// Makes the moment at the end what it is there.
    fn close(&mut self, mut left: f64, inner: &mut [Inner]) {
        for force in inner.iter() {
            left -= cross(self.between(force.xi, 1.0), force.force);
        }
        match inner.iter_mut().find(|force| force.has_couple) {
            Some(force) => force.couple = -left,
            None => self.moment[1] += left,
        }
    }

    /// The way from one place to another \[m\].
    fn between(&self, from: f64, to: f64) -> [f64; 2] {
        let at = |xi: f64| {
            [0, 1].map(|i| {
                let [a, b, c] = [self.way[0][i], self.way[1][i], self.way[2][i]];
                xi * (a + xi * (0.5 * b + xi * c / 3.0))
            })
        };
        sub(at(to), at(from))
    }

    /// Section forces at a share of the way, at a force inside those behind or ahead of it.
    #[inline]
    pub fn at(&self, xi: f64, inner: &[Inner], ahead: bool) -> SectionForces {
        let smooth = self.smooth(xi);
        let mut before = inner.iter().filter(|one| is_behind(one, xi, ahead)).peekable();
        if before.peek().is_none() {
            return smooth;
        }
        let mut moment = smooth.moment;
        let mut force = [0, 1].map(|i| {
            let f = |k: usize| self.force[k][i];
            f(0) + xi * (f(1) + xi * (f(2) + xi * (f(3) + xi * f(4))))
        });
        for one in before {
            force = sub(force, one.force);
            moment += cross(self.between(one.xi, xi), one.force) - one.couple;
        }
        self.along(xi, &force, moment)
    }

    /// Where a section force is largest or smallest between two places, each with its derivative there, of which one is negative; `of` tells
    /// it elsewhere.
    pub fn stationary(
        &self,
        [mut a, mut b]: [(f64, f64); 2],
        inner: &[Inner],
        of: fn(&Rise) -> f64,
    ) -> f64 {
        // The zero of a curve that is nearly straight: a few secants between brackets.
        for _ in 0..12 {
            let x = a.0 + (b.0 - a.0) * (a.1 / (a.1 - b.1)).clamp(0.01, 0.99);
            let f = of(&self.at(x, inner, false).rise);
            if f.abs() <= 1e-9 * (a.1.abs() + b.1.abs()) {
                return x;
            }
            if f * a.1 > 0.0 { a = (x, f) } else { b = (x, f) }
        }
        0.5 * (a.0 + b.0)
    }
}

/// Whether a force inside acts behind a place, or at it where what is ahead of it is asked for.
fn is_behind(one: &Inner, xi: f64, ahead: bool) -> bool {
    let beyond = if ahead { SAME_PLACE } else { -SAME_PLACE };
    one.xi < xi + beyond
}

/// Share of the way at which the shape functions give the second node this share of a force.
pub fn place_of(share: f64) -> f64 {
    0.5 - ((1.0 - 2.0 * share).asin() / 3.0).sin()
}

/// Sum of the forces on the values of both nodes.
pub fn resultant(on: &OnNodes) -> [f64; 2] {
    add([on[0][0], on[0][1]], [on[1][0], on[1][1]])
}
