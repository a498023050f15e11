//! Fibres of the elements of a span.

use std::ops::Range;

use crate::element::fibre::{Fibre, LawShape, StressLaw};
use crate::math::hermite::GAUSS;

/// The fibres of a span.
#[derive(Clone, Debug)]
pub struct SpanFibres<S = f64> {
    /// Laws of its materials, shape (laws).
    pub laws: Vec<StressLaw<S>>,
    /// Fibres at the Gauss points, one entry for all elements or one for each, shape (1 or elements, Gauss points, fibres at one); those of a shape end with two
    /// without area, at the lower and the upper surface. Elements of shear-flexible beams have fibres at the second point, their middle, alone.
    pub at: Vec<[Vec<Fibre<S>>; GAUSS]>,
    /// Fibres of an element, all its Gauss points together.
    pub count: usize,
    /// Number of its first fibre in the state.
    pub first: usize,
}

/// Common data of layouts of fibres of one kind.
#[derive(Clone, Debug, PartialEq)]
pub struct FibreShape {
    /// Their laws, shape (laws).
    laws: Vec<LawShape>,
    /// Laws of the fibres at the Gauss points, shape (tables, Gauss points, fibres) \[index of a law\].
    at: Vec<[Vec<usize>; GAUSS]>,
}

impl<S> SpanFibres<S> {
    /// Fibres of the element of number `k` in the span.
    #[inline(always)]
    pub fn of(&self, k: usize) -> &[Vec<Fibre<S>>; GAUSS] {
        &self.at[if self.at.len() == 1 { 0 } else { k }]
    }

    /// Position of the fibres of that element in the state.
    pub fn range(&self, k: usize) -> Range<usize> {
        let first = self.first + k * self.count;
        first..first + self.count
    }
}

impl SpanFibres {
    /// The yield stress, if it is one for all its materials and changes neither with strain nor with its rate \[Pa\].
    pub fn plateau(&self) -> Option<f64> {
        let mut all = self.laws.iter().map(|law| match law {
            StressLaw::Plastic(law) => law.plasticity.plateau(),
            StressLaw::Elastic { .. } | StressLaw::OneSided { .. } => None,
        });
        let first = all.next().flatten()?;
        all.all(|other| other == Some(first)).then_some(first)
    }
}

impl<S: Copy> SpanFibres<S> {
    /// The same with every number replaced.
    pub fn map<T>(&self, f: &mut impl FnMut(S) -> T) -> SpanFibres<T> {
        let laws = self.laws.iter().map(|law| law.map(f)).collect();
        let mut at = Vec::new();
        for points in &self.at {
            at.push(points.each_ref().map(|own| own.iter().map(|fibre| fibre.map(f)).collect()));
        }
        SpanFibres { laws, at, count: self.count, first: self.first }
    }

    /// All their properties that are not numbers.
    pub fn shape(&self) -> FibreShape {
        let laws = self.laws.iter().map(|law| law.shape()).collect();
        let of = |points: &[Vec<Fibre<S>>; GAUSS]| {
            points.each_ref().map(|own| own.iter().map(|fibre: &Fibre<S>| fibre.law).collect())
        };
        FibreShape { laws, at: self.at.iter().map(of).collect() }
    }
}
