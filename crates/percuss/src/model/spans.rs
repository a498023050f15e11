//! Beams of the frozen model and their spans.

use std::ops::Range;
use std::sync::Arc;

use super::definition::{StrainMeasure, Strength};
use super::section_line::SectionLine;
use super::span_fibres::SpanFibres;
use crate::element::beam::{ElementTable, SectionValues};
use crate::element::shear::{InsideField, ShearTable};
use crate::geometry::axis::AxisElements;

/// A beam: common data of its spans.
#[derive(Clone, Debug)]
pub struct BeamData {
    pub name: String,
    pub spans: Range<usize>,
    pub nodes: Range<usize>,
    pub elements: Range<usize>,
    /// Arc length \[m\].
    pub length: f64,
    /// Places at which a plastic hinge may form, in their order; none of a beam that cannot yield, shape (such places) \[m\].
    pub hinges: Vec<f64>,
    /// Whether it has short elements there.
    pub graded: bool,
    /// Its elements for contact; copies of a model share them.
    pub axis: Arc<AxisElements>,
}

/// A part of a beam without corner, of one material and one section.
#[derive(Clone, Debug)]
pub struct Span {
    pub nodes: Range<usize>,
    pub elements: Range<usize>,
    /// One table for all elements, or one for each, shape (1 or elements).
    pub tables: Vec<ElementTable>,
    /// Its section along the beam.
    pub section: SectionLine,
    /// Arc length from the start of the beam at the nodes, shape (nodes of the span) \[m\].
    pub stations: Vec<f64>,
    pub measure: StrainMeasure,
    /// Retardation time of Kelvin-Voigt damping \[s\].
    pub retardation: f64,
    /// Mass-proportional damping \[1/s\].
    pub mass_damping: f64,
    /// Thermal expansion of its material \[1/K\].
    pub expansion: f64,
    /// Usual yield stresses of an elastic material, if known.
    pub strength: Option<Strength>,
    /// Strain at the largest force of a tension test of its material, if known.
    pub uniform_strain: Option<f64>,
    /// Shear modulus of its material \[Pa\]; `None` where neither it nor Poisson's ratio is given.
    pub shear_modulus: Option<f64>,
    /// Young's and shear modulus of each material of its section of which both are known, shape (such materials, 2) \[Pa\].
    pub moduli: Vec<[f64; 2]>,
    /// Its fibres, if its material is nonlinear or its section is given by them.
    pub fibres: Option<SpanFibres>,
    /// Elements of a shear-flexible beam, as many as tables, shape (1 or elements).
    pub shear: Option<Vec<ShearTable>>,
}

impl Span {
    /// Table of the element of number `k` in the span.
    #[inline(always)]
    pub fn table(&self, k: usize) -> &ElementTable {
        &self.tables[if self.tables.len() == 1 { 0 } else { k }]
    }

    /// The element of number `k` in the span of a shear-flexible beam.
    #[inline]
    pub fn shear_at(&self, k: usize) -> Option<&ShearTable> {
        let tables = self.shear.as_ref()?;
        Some(&tables[if tables.len() == 1 { 0 } else { k }])
    }

    /// The field inside the element of number `k` in the span, between its nodes: that of its theory.
    pub fn inside(&self, k: usize) -> InsideField {
        self.shear_at(k)
            .map_or_else(|| InsideField::slender(self.table(k).length), ShearTable::inside)
    }

    /// Section of the element of number `k` in the span at a share `xi` of its length.
    pub fn section_at(&self, k: usize, xi: f64) -> SectionValues {
        let (from, to) = (self.stations[k], self.stations[k + 1]);
        let s = if xi == 1.0 { to } else { from + xi * (to - from) };
        self.section.at(s)
    }

    /// Whether its extreme fibres are known.
    pub fn has_depth(&self) -> bool {
        !self.section.at(self.stations[0]).half_depth.is_nan()
    }

    /// Whether any part has material damping.
    pub fn is_damped(&self) -> bool {
        self.retardation > 0.0 || self.mass_damping > 0.0
    }
}
