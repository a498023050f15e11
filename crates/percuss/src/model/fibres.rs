//! Fibres of spans whose material does more than Hooke's law says, or whose section is given by its fibres.

use super::definition::{
    Material, MaterialId, RotaryInertia, Section, SectionFibre, Station, StrainMeasure,
};
use super::frozen::SpanFibres;
use crate::element::fibre::{Fibre, StressLaw};
use crate::element::point::SectionLaw;
use crate::math::hermite::{self, GAUSS};

/// Where the elements of a span lie.
pub(super) struct Stretch<'a> {
    /// Arc length from the start of the beam at its nodes, shape (nodes of the span) \[m\].
    pub stations: &'a [f64],
    /// Arc length of the beam \[m\].
    pub total: f64,
    /// Whether all its elements are alike.
    pub uniform: bool,
    /// Number of its elements.
    pub count: usize,
}

/// What a span is made of.
#[derive(Clone, Copy)]
pub(super) struct Make<'a> {
    /// The beam's material there.
    pub material: &'a Material,
    /// Its section.
    pub section: &'a Section,
    /// All materials, to which fibres may refer, shape (materials).
    pub materials: &'a [Material],
}

/// Sums over fibres that are given one by one, each with its own material.
#[derive(Clone, Copy, Debug)]
pub(super) struct Weighed {
    /// Axial stiffness, its first and its second moment about the centre line, shape (3) \[N, N m, N m^2\].
    pub stiffness: [f64; 3],
    /// Mass per length and its second moment about the centre line, shape (2) \[kg/m, kg m\].
    pub mass: [f64; 2],
}

impl Make<'_> {
    /// Whether its elements are made of fibres.
    pub fn has_fibres(&self) -> bool {
        self.material.inelasticity.is_some() || self.section.given_fibres().is_some()
    }

    /// The material of a fibre; the beam's own where it has none.
    pub fn of(&self, fibre: &SectionFibre) -> &Material {
        let own = fibre.material.and_then(|id| self.materials.get(id.0 as usize));
        own.unwrap_or(self.material)
    }

    /// Whether all of it is of the beam's material.
    pub fn is_plain(&self) -> bool {
        let fibres = self.section.given_fibres().unwrap_or_default();
        fibres.iter().all(|f| f.material.is_none())
    }

    /// Sums over its fibres, if they are given one by one.
    pub fn weighed(&self) -> Option<Weighed> {
        let mut out = Weighed { stiffness: [0.0; 3], mass: [0.0; 2] };
        for fibre in self.section.given_fibres()? {
            let (material, y) = (self.of(fibre), fibre.height);
            let (stiffness, mass) = (material.young * fibre.area, material.density * fibre.area);
            out.stiffness[0] += stiffness;
            out.stiffness[1] += stiffness * y;
            out.stiffness[2] += stiffness * y * y;
            out.mass[0] += mass;
            out.mass[1] += mass * y * y;
        }
        Some(out)
    }

    /// Section law and mass per length \[kg/m\] of a section that is given by its fibres.
    pub fn law(&self, measure: StrainMeasure) -> Option<(SectionLaw<f64>, f64)> {
        let Weighed { stiffness: [axial, _, bending], mass: [mass, turning] } = self.weighed()?;
        let rotary = match self.section.rotary_inertia {
            RotaryInertia::Density => turning,
            RotaryInertia::Neglected => 0.0,
            RotaryInertia::Given(value) => value,
        };
        Some((SectionLaw { axial, bending, rotary, measure }, mass))
    }
}

/// The fibres of a span, the first one of number `first`; none for an elastic one of one material.
pub(super) fn of_span(make: &Make, stretch: &Stretch, first: usize) -> Option<SpanFibres> {
    if !make.has_fibres() {
        return None;
    }
    let law = |m: &Material| StressLaw::new(m.young, m.inelasticity.as_ref());
    let mut laws = vec![law(make.material)];
    let given = given(make, |m| {
        laws.push(law(m));
        laws.len() - 1
    });
    let points = hermite::gauss_points();
    let element = |k: usize| -> [Vec<Fibre>; GAUSS] {
        let (a, b) = (stretch.stations[k], stretch.stations[k + 1]);
        points.map(|xi| match &given {
            Some(fibres) => fibres.clone(),
            None => layout(make.section, (a + xi * (b - a)) / stretch.total),
        })
    };
    let at: Vec<_> = (0..if stretch.uniform { 1 } else { stretch.count }).map(element).collect();
    let count = at[0].iter().map(Vec::len).sum();
    Some(SpanFibres { laws, at, count, first })
}

/// Fibres that are given one by one; `add` takes the law of another material and tells its number.
fn given(make: &Make, mut add: impl FnMut(&Material) -> usize) -> Option<Vec<Fibre>> {
    let mut known: Vec<(MaterialId, usize)> = Vec::new();
    let mut number = |fibre: &SectionFibre| {
        let Some(id) = fibre.material else { return 0 };
        if let Some((_, law)) = known.iter().find(|(k, _)| *k == id) {
            return *law;
        }
        known.push((id, add(make.of(fibre))));
        known[known.len() - 1].1
    };
    let fibres = make.section.given_fibres()?.iter();
    Some(fibres.map(|f| Fibre { height: f.height, area: f.area, law: number(f) }).collect())
}

/// Fibres at a fraction of the beam's length: the profile scaled to the area and the radius of gyration there; then those of no area
/// at both surfaces.
fn layout(section: &Section, fraction: f64) -> Vec<Fibre> {
    let (here, base) = (section.at(fraction), section.at(0.0));
    let gyration = |s: &Station| (s.inertia / s.area).sqrt();
    let (taller, larger) = (gyration(&here) / gyration(&base), here.area / base.area);
    let fibre = |[y, area]: [f64; 2]| Fibre { height: y * taller, area: area * larger, law: 0 };
    let mut out: Vec<Fibre> =
        section.profile.fibres(section.fibres).into_iter().map(fibre).collect();
    let most = out.iter().map(|f| f.height).fold(0.0, f64::max);
    let half = here.depth.map_or(most, |d| 0.5 * d);
    out.extend([-half, half].map(|height| Fibre { height, area: 0.0, law: 0 }));
    out
}
