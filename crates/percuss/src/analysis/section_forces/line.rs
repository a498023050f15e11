//! Section forces along one element, from its balance.
//!
//! What the neighbours exert on the ends of an element, and what acts along it, inertia included, determine its section
//! forces everywhere: with the force f per share of the way that accelerates the element beyond what loads do,
//!
//! `dn/dxi = f`, `dM/dxi = mu - dx/dxi x n`, `N = n . t`, `V = n . J t`,
//!
//! t the unit tangent and mu the rotary inertia, spread evenly: it is what the balance of moments leaves over. The force f
//! is the cubic that does the same work as nodal loads and inertia on every motion the element knows, so the balance closes.

use serde::{Deserialize, Serialize};

use crate::math::vec2::{add, cross, dot, sub};

/// Inverse of the mass matrix of a uniform element of unit mass and length.
const UNIT_MASS_INVERSE: [[f64; 4]; 4] = [
    [16.0, -120.0, -4.0, -60.0],
    [-120.0, 1200.0, 60.0, 840.0],
    [-4.0, 60.0, 16.0, 120.0],
    [-60.0, 840.0, 120.0, 1200.0],
];

/// Forces on both nodes of an element, on values and slopes \[N, N m\].
pub type OnNodes = [[f64; 4]; 2];

/// A force that acts at a place inside an element, at which the section forces jump.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct Inner {
    /// Its element.
    pub element: usize,
    /// Share of the way along it.
    pub xi: f64,
    /// The force \[N\].
    pub force: [f64; 2],
    /// Its couple, counter-clockwise \[N m\].
    pub couple: f64,
    /// Whether it has one: then that is what the balance of moments leaves over.
    pub has_couple: bool,
    /// What it exerts on the nodes of the element.
    pub on_nodes: OnNodes,
}

/// The configuration of an element: its nodes in the reference, their displacements, its length.
#[derive(Clone, Copy, Debug)]
pub struct ElementShape {
    /// Tangents x' at both nodes.
    pub tangents: [[f64; 2]; 2],
    /// From the first node to the second \[m\].
    pub chord: [f64; 2],
    /// Arc length of the reference \[m\].
    pub length: f64,
}

/// Section forces of one element.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub struct Line {
    /// Coefficients of dx/dxi \[m\].
    way: [[f64; 2]; 3],
    /// Coefficients of the force n that the part ahead exerts on the part behind \[N\].
    force: [[f64; 2]; 5],
    /// Coefficients of the moment \[N m\].
    moment: [f64; 8],
}

/// Section forces at a place.
#[derive(Clone, Copy, Debug)]
pub struct SectionForces {
    /// Axial force, positive in tension \[N\].
    pub axial: f64,
    /// Shear force \[N\].
    pub shear: f64,
    /// Bending moment \[N m\].
    pub moment: f64,
    /// Its derivative with respect to the share of the way \[N m\].
    pub rise: f64,
}

impl Line {
    /// From the forces of the neighbours on both nodes, and what accelerates the element beyond its loads; `inner` are the
    /// forces inside it, already taken out of both.
    pub fn new(shape: &ElementShape, ends: &OnNodes, along: &OnNodes, inner: &mut [Inner]) -> Self {
        let (l, [ga, gb]) = (shape.length, shape.tangents);
        let mut line = Self::default();
        for i in 0..2 {
            let (a, b, chord) = (l * ga[i], l * gb[i], 6.0 * shape.chord[i]);
            line.way[0][i] = a;
            line.way[1][i] = chord - 4.0 * a - 2.0 * b;
            line.way[2][i] = 3.0 * (a + b) - chord;
            let on = [along[0][i], along[0][2 + i] / l, along[1][i], along[1][2 + i] / l];
            let [f0, s0, f1, s1] =
                UNIT_MASS_INVERSE.map(|row| (0..4).map(|k| row[k] * on[k]).sum::<f64>());
            line.force[0][i] = -ends[0][i];
            line.force[1][i] = f0;
            line.force[2][i] = 0.5 * s0;
            line.force[3][i] = (f1 - f0) - (2.0 * s0 + s1) / 3.0;
            line.force[4][i] = 0.5 * (f0 - f1) + 0.25 * (s0 + s1);
        }
        line.moment[0] = -cross(ga, [ends[0][2], ends[0][3]]);
        for (i, way) in line.way.iter().enumerate() {
            for (j, force) in line.force.iter().enumerate() {
                line.moment[i + j + 1] -= cross(*way, *force);
            }
        }
        for k in 2..8 {
            line.moment[k] /= k as f64;
        }
        line.close(cross(gb, [ends[1][2], ends[1][3]]), inner);
        line
    }

    /// Makes the moment at the end what it is there.
    fn close(&mut self, end: f64, inner: &mut [Inner]) {
        let mut left = end - self.moment.iter().sum::<f64>();
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
        let [a, b, c] = self.way;
        let way = [0, 1].map(|i| a[i] + xi * (b[i] + xi * c[i]));
        let mut force = [0, 1].map(|i| {
            let f = |k: usize| self.force[k][i];
            f(0) + xi * (f(1) + xi * (f(2) + xi * (f(3) + xi * f(4))))
        });
        let mut moment = self.moment.iter().rev().fold(0.0, |sum, c| sum * xi + c);
        for one in inner.iter().filter(|one| one.xi < xi || (ahead && one.xi == xi)) {
            force = sub(force, one.force);
            moment += cross(self.between(one.xi, xi), one.force) - one.couple;
        }
        let inverse = 1.0 / dot(way, way).sqrt();
        let turn = cross(way, force);
        // What the rotary inertia adds is the difference of the first coefficients.
        let rotary = self.moment[1] + cross(self.way[0], self.force[0]);
        SectionForces {
            axial: dot(way, force) * inverse,
            shear: turn * inverse,
            moment,
            rise: rotary - turn,
        }
    }

    /// Where the moment is largest or smallest between two places, if it is so inside.
    pub fn stationary(&self, [from, to]: [f64; 2], inner: &[Inner]) -> Option<f64> {
        let rise = |xi: f64| self.at(xi, inner, false).rise;
        let (mut a, mut b) = ((from, self.at(from, inner, true).rise), (to, rise(to)));
        if a.1 * b.1 >= 0.0 {
            return None;
        }
        // The zero of a curve that is nearly straight: a few secants between brackets.
        for _ in 0..12 {
            let x = a.0 + (b.0 - a.0) * (a.1 / (a.1 - b.1)).clamp(0.01, 0.99);
            let f = rise(x);
            if f.abs() <= 1e-9 * (a.1.abs() + b.1.abs()) {
                return Some(x);
            }
            if f * a.1 > 0.0 { a = (x, f) } else { b = (x, f) }
        }
        Some(0.5 * (a.0 + b.0))
    }
}

/// Share of the way at which the shape functions give the second node this share of a force.
pub fn place_of(share: f64) -> f64 {
    0.5 - ((1.0 - 2.0 * share).asin() / 3.0).sin()
}

/// Sum of the forces on the values of both nodes.
pub fn resultant(on: &OnNodes) -> [f64; 2] {
    add([on[0][0], on[0][1]], [on[1][0], on[1][1]])
}
