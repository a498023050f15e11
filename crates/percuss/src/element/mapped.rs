//! An element's constants in other numbers: the same for several elements or runs side by side, or with derivatives.

use super::beam::{ElementTable, GaussRow};
use super::membrane::MembraneTable;
use super::point::{Reference, SectionLaw};
use crate::math::hermite::GAUSS;

/// Replacement of numbers, one after the other in a fixed order.
pub trait Replacement<S, T> {
    /// Value that replaces the next number.
    fn of(&mut self, number: S) -> T;
}

impl<S, T, F: FnMut(S) -> T> Replacement<S, T> for F {
    #[inline(always)]
    fn of(&mut self, number: S) -> T {
        self(number)
    }
}

// The following code has no closures: for vector registers they are not always inlined.

impl<S: Copy> ElementTable<S> {
    /// The same with every number replaced.
    #[inline(always)]
    pub fn map<T: Copy>(&self, f: &mut impl Replacement<S, T>) -> ElementTable<T> {
        const { assert!(GAUSS == 3) }
        let [first, second, third] = &self.rows;
        ElementTable {
            length: f.of(self.length),
            rows: [first.map(f), second.map(f), third.map(f)],
            mass: rows(&self.mass, f),
            membrane: match &self.membrane {
                Some(membrane) => Some(membrane.map(f)),
                None => None,
            },
        }
    }
}

impl<S: Copy> GaussRow<S> {
    #[inline(always)]
    fn map<T: Copy>(&self, f: &mut impl Replacement<S, T>) -> GaussRow<T> {
        GaussRow {
            first: row(&self.first, f),
            second: row(&self.second, f),
            weight: f.of(self.weight),
            reference: Reference {
                tangent: row(&self.reference.tangent, f),
                bend: row(&self.reference.bend, f),
                curvature: f.of(self.reference.curvature),
            },
            weighed: self.weighed.map(f),
            section: self.section.map(f),
        }
    }
}

impl<S: Copy> SectionLaw<S> {
    #[inline(always)]
    fn map<T: Copy>(&self, f: &mut impl Replacement<S, T>) -> SectionLaw<T> {
        let (axial, bending, rotary) = (f.of(self.axial), f.of(self.bending), f.of(self.rotary));
        SectionLaw { axial, bending, rotary, measure: self.measure }
    }
}

impl<S: Copy> MembraneTable<S> {
    #[inline(always)]
    fn map<T: Copy>(&self, f: &mut impl Replacement<S, T>) -> MembraneTable<T> {
        MembraneTable {
            rows: rows(&self.rows, f),
            tangent: rows(&self.tangent, f),
            stiffness: rows(&self.stiffness, f),
            at_gauss: rows(&self.at_gauss, f),
            is_nodal: self.is_nodal,
        }
    }
}

#[inline(always)]
fn row<S: Copy, T: Copy, const N: usize>(x: &[S; N], f: &mut impl Replacement<S, T>) -> [T; N] {
    let mut out = [f.of(x[0]); N];
    for i in 1..N {
        out[i] = f.of(x[i]);
    }
    out
}

#[inline(always)]
fn rows<S: Copy, T: Copy, const N: usize, const M: usize>(
    x: &[[S; M]; N],
    f: &mut impl Replacement<S, T>,
) -> [[T; M]; N] {
    let mut out = [row(&x[0], f); N];
    for i in 1..N {
        out[i] = row(&x[i], f);
    }
    out
}
