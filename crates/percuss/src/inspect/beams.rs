//! Views of beams and their sections.

use std::ops::Range;

use crate::element::beam::SectionValues;
use crate::element::fibre::StressLaw;
use crate::element::point::SectionLaw;
use crate::math::hermite;
use crate::model::frozen::{BeamData, Span};
use crate::model::{Model, StrainMeasure, Strength};

/// A beam.
#[derive(Clone, Copy, Debug)]
pub struct BeamView<'m> {
    pub(super) model: &'m Model,
    pub(super) data: &'m BeamData,
}

impl<'m> BeamView<'m> {
    /// Its name.
    pub fn name(&self) -> &'m str {
        &self.data.name
    }

    /// Arc length \[m\].
    pub fn length(&self) -> f64 {
        self.data.length
    }

    /// Its nodes in the row of all nodes.
    pub fn nodes(&self) -> Range<usize> {
        self.data.nodes.clone()
    }

    /// Arc lengths at which a plastic hinge may form, in their order; none of a beam that cannot yield \[m\].
    pub fn hinge_places(&self) -> &'m [f64] {
        &self.data.hinges
    }

    /// Whether it has short elements there.
    pub fn has_short_elements(&self) -> bool {
        self.data.graded
    }

    /// Its spans, start to end.
    pub fn spans(&self) -> impl Iterator<Item = SpanView<'m>> + Clone + use<'m> {
        self.model.spans[self.data.spans.clone()].iter().map(|data| SpanView { data })
    }
}

impl<'m> BeamView<'m> {
    /// The span at an arc length `s` from its start \[m\]; at a corner that before it.
    pub fn span_at(&self, s: f64) -> SpanView<'m> {
        let spans = &self.model.spans[self.data.spans.clone()];
        let ends_before = |span: &Span| span.stations.last().is_some_and(|end| *end < s);
        SpanView { data: &spans[spans.partition_point(ends_before).min(spans.len() - 1)] }
    }

    /// The span of a node, if it is one of the beam's.
    pub fn span_of(&self, node: usize) -> Option<SpanView<'m>> {
        let spans = &self.model.spans[self.data.spans.clone()];
        let found = spans.get(spans.partition_point(|span| span.nodes.end <= node))?;
        found.nodes.contains(&node).then_some(SpanView { data: found })
    }
}

/// A span: a part of a beam without corner, of one material and one section.
#[derive(Clone, Copy, Debug)]
pub struct SpanView<'m> {
    pub(super) data: &'m Span,
}

impl<'m> SpanView<'m> {
    /// Its nodes in the row of all nodes.
    pub fn nodes(&self) -> Range<usize> {
        self.data.nodes.clone()
    }

    /// Number of its elements.
    pub fn element_count(&self) -> usize {
        self.data.elements.len()
    }

    /// Arc length from the start of the beam at its nodes, shape (number of nodes) \[m\].
    pub fn stations(&self) -> &'m [f64] {
        &self.data.stations
    }

    /// Strain measure.
    pub fn measure(&self) -> StrainMeasure {
        self.data.measure
    }

    /// Stresses up to which its material is known to be elastic.
    pub fn strength(&self) -> Option<Strength> {
        self.data.strength
    }

    /// Strain at the largest force of a tension test of its material, if known.
    pub fn uniform_strain(&self) -> Option<f64> {
        self.data.uniform_strain
    }

    /// The least strain at which a fibre yields; none where none can \[-\].
    pub fn first_yield_strain(&self) -> Option<f64> {
        let laws = self.data.fibres.iter().flat_map(|fibres| &fibres.laws);
        let strain = |law: &StressLaw| match law {
            StressLaw::Plastic(law) => Some(law.plasticity.first_yield() / law.young),
            StressLaw::Elastic { .. } | StressLaw::OneSided { .. } => None,
        };
        laws.filter_map(strain).reduce(f64::min)
    }

    /// Whether a fibre that can yield has no failure strain.
    pub fn yields_without_failure(&self) -> bool {
        let laws = self.data.fibres.iter().flat_map(|fibres| &fibres.laws);
        let endless = |law: &StressLaw| match law {
            StressLaw::Plastic(law) => law.plasticity.failure_strain.is_none(),
            StressLaw::Elastic { .. } | StressLaw::OneSided { .. } => false,
        };
        laws.into_iter().any(endless)
    }

    /// Whether a fibre bears no tension or no compression.
    pub fn is_one_sided(&self) -> bool {
        let mut laws = self.data.fibres.iter().flat_map(|fibres| &fibres.laws);
        laws.any(|law| law.slack().is_some())
    }

    /// Whether its material damps.
    pub fn is_damped(&self) -> bool {
        self.data.is_damped()
    }

    /// Shear stiffness kappa G A at an arc length from the start of the beam \[N\]; of shear-flexible beams alone.
    pub fn shear_stiffness_at(&self, s: f64) -> Option<f64> {
        self.data.shear.as_ref().map(|_| self.data.section.at(s).shear)
    }

    /// Shear modulus of its material, as given or by Poisson's ratio, of slender beams too \[Pa\]; `None` where neither is given.
    pub fn shear_modulus(&self) -> Option<f64> {
        self.data.shear_modulus
    }

    /// Young's and shear modulus of each material of its section of which both are known, shape (such materials, 2) \[Pa\].
    pub fn moduli(&self) -> &'m [[f64; 2]] {
        &self.data.moduli
    }

    /// Thermal expansion of its material, strain per change of temperature \[1/K\]; zero where none is given.
    pub fn expansion(&self) -> f64 {
        self.data.expansion
    }

    /// Whether it is computed by fibres: its material is nonlinear or its section is given by them.
    pub fn has_fibres(&self) -> bool {
        self.data.fibres.is_some()
    }

    /// Whether its section varies from element to element.
    pub fn varies(&self) -> bool {
        !self.data.section.is_uniform()
    }

    /// Length of the element of number `k` in the span \[m\].
    pub fn element_length(&self, k: usize) -> f64 {
        self.data.table(k).length
    }

    /// Coefficients of the displacement inside the element of number `k` in the span, at a share of its length, on the displacements and slopes of its
    /// nodes, order (u_a, u_a', u_b, u_b'), shape (4) \[-, m, -, m\].
    pub fn interpolation(&self, k: usize, share: f64) -> [f64; 4] {
        self.data.inside(k).axis(share)
    }

    /// The beam at the Gauss points of the element of number `k` in the span; the second one is its middle.
    pub fn gauss_points(&self, k: usize) -> [GaussPointView; 3] {
        let (rows, shares) = (&self.data.table(k).rows, hermite::gauss_points());
        std::array::from_fn(|j| GaussPointView {
            weight: rows[j].weight,
            tangent: rows[j].reference.tangent,
            section: SectionConstants::of(&self.data.section_at(k, shares[j])),
        })
    }

    /// Constants of the section at both ends of the element of number `k` in the span.
    pub fn end_sections(&self, k: usize) -> [SectionConstants; 2] {
        [0.0, 1.0].map(|xi| SectionConstants::of(&self.data.section_at(k, xi)))
    }

    /// Constants of the section at an arc length from the start of the beam \[m\].
    pub fn section_at(&self, s: f64) -> SectionConstants {
        SectionConstants::of(&self.data.section.at(s))
    }
}

/// Constants of a section, per length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SectionConstants {
    /// Axial stiffness EA \[N\].
    pub axial: f64,
    /// Bending stiffness EI \[N m^2\].
    pub bending: f64,
    /// Rotary inertia rhoI \[kg m\].
    pub rotary: f64,
    /// Mass rhoA \[kg/m\].
    pub mass: f64,
    /// Area \[m^2\].
    pub area: f64,
    /// Second moment of area about the centre line \[m^4\].
    pub inertia: f64,
    /// Young's modulus; of several materials its mean over the area \[Pa\].
    pub young: f64,
    /// Density; of several materials its mean over the area \[kg/m^3\].
    pub density: f64,
    /// Distance of the extreme fibres from the centre line \[m\]; NaN if unknown.
    pub half_depth: f64,
    /// Shear stiffness kappa G A, of slender beams too \[N\]; NaN if shear modulus or shear factor is unknown.
    pub shear: f64,
}

impl SectionConstants {
    /// Radius of gyration, the root of bending over axial stiffness \[m\].
    pub fn gyration(&self) -> f64 {
        (self.bending / self.axial).sqrt()
    }

    pub(super) fn of(values: &SectionValues) -> Self {
        let SectionValues { law, mass, area, inertia, young, density, half_depth, shear, .. } =
            *values;
        let SectionLaw { axial, bending, rotary, .. } = law;
        Self { axial, bending, rotary, mass, area, inertia, young, density, half_depth, shear }
    }
}

/// A Gauss point of an element.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GaussPointView {
    /// Integration weight \[m\].
    pub weight: f64,
    /// Tangent of the reference, shape (2) \[-\].
    pub tangent: [f64; 2],
    /// The section there.
    pub section: SectionConstants,
}
