//! Fibres of spans with a nonlinear material, or with a section given by its fibres.

use super::definition::{
    Inelasticity, Material, MaterialId, Profile, RotaryInertia, Section, SectionFibre, SectionSize,
    StrainMeasure,
};
use super::frozen::SpanFibres;
use crate::element::fibre::{Fibre, StressLaw};
use crate::element::point::SectionLaw;
use crate::element::shear::MIDDLE;
use crate::math::hermite::{self, GAUSS};

/// Least length of an element at a plastic hinge over the depth of the section: in Green strains, in engineering strains.
const SHARPEST: [f64; 2] = [0.5, 0.25];

/// Position of the elements of a span.
pub(super) struct Stretch<'a> {
    /// Arc length from the start of the beam at its nodes, shape (nodes of the span) \[m\].
    pub stations: &'a [f64],
    /// Arc length of the beam \[m\].
    pub total: f64,
    /// Whether its section is the same all along.
    pub uniform: bool,
    /// Number of its elements.
    pub count: usize,
    /// Whether they have fibres in their middle alone.
    pub in_middle: bool,
}

/// Material and section of a span.
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

    /// Least length of an element at a plastic hinge at a fraction of the beam's length \[m\]; none if no part of the section can yield. In Green
    /// strains fibres have less resistance the more they are compressed, and elements that are bent too sharply buckle by themselves.
    pub fn hinge_length(&self, fraction: f64) -> Option<f64> {
        if !self.can_yield() {
            return None;
        }
        let known = self.section.given_fibres().map(|fibres| {
            let heights = fibres.iter().map(|fibre| fibre.height);
            heights.clone().fold(f64::MIN, f64::max) - heights.fold(f64::MAX, f64::min)
        });
        let depth = known.or(self.section.depth_at(fraction)).unwrap_or(0.0);
        Some(match self.material.strain {
            StrainMeasure::Green => SHARPEST[0] * depth,
            StrainMeasure::Engineering => SHARPEST[1] * depth,
        })
    }

    /// Whether any of it can yield.
    fn can_yield(&self) -> bool {
        let yields = |material: &Material| {
            let law = material.inelasticity.as_ref();
            law.is_some_and(|law| !matches!(law, Inelasticity::OneSided(_)))
        };
        match self.section.given_fibres() {
            Some(fibres) => fibres.iter().any(|fibre| yields(self.of(fibre))),
            None => yields(self.material),
        }
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

    /// Sum of shear moduli times areas over its fibres, if they are given one by one; NaN if a modulus is unknown \[N\].
    pub fn shear_stiffness(&self) -> Option<f64> {
        let of = |f: &SectionFibre| self.of(f).shear_stiffness().unwrap_or(f64::NAN) * f.area;
        Some(self.section.given_fibres()?.iter().map(of).sum())
    }

    /// Young's and shear modulus of each of its materials of which both are known, shape (such materials, 2) \[Pa\].
    pub fn moduli(&self) -> Vec<[f64; 2]> {
        let mut out = Vec::new();
        let mut add = |material: &Material| {
            let Some(shear) = material.shear_stiffness() else { return };
            let pair = [material.young, shear];
            if !out.contains(&pair) {
                out.push(pair);
            }
        };
        match self.section.given_fibres() {
            Some(fibres) => fibres.iter().for_each(|fibre| add(self.of(fibre))),
            None => add(self.material),
        }
        out
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
    let layout = ProfileLayout::new(make.section);
    let points = hermite::gauss_points();
    let element = |k: usize| -> [Vec<Fibre>; GAUSS] {
        let (a, b) = (stretch.stations[k], stretch.stations[k + 1]);
        std::array::from_fn(|j| match &given {
            _ if stretch.in_middle && j != MIDDLE => Vec::new(),
            Some(fibres) => fibres.clone(),
            None => layout.at((a + points[j] * (b - a)) / stretch.total),
        })
    };
    let at: Vec<_> = (0..if stretch.uniform { 1 } else { stretch.count }).map(element).collect();
    let count = at[0].iter().map(Vec::len).sum();
    Some(SpanFibres { laws, at, count, first })
}

/// Fibres that are given one by one; `add` adds the law of another material and returns its number.
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
    let fibre = |f: &SectionFibre| Fibre::bearing(f.height, f.area, number(f));
    Some(fibres.map(fibre).collect())
}

/// Fibres of a section that follow from its shape.
struct ProfileLayout<'a> {
    section: &'a Section,
    /// Fibres of its profiles, each of unit area and unit radius of gyration, as (height, area), shape (profiles, fibres, 2) \[-\]: all stations
    /// share one if they differ only in size.
    profiles: Vec<Vec<[f64; 2]>>,
}

/// Heights and areas of two profiles that differ by less, relative, differ only in size.
const ALIKE: f64 = 1e-9;

impl<'a> ProfileLayout<'a> {
    fn new(section: &'a Section) -> Self {
        let most = |count: usize| {
            section
                .profiles()
                .map(|(profile, _)| profile.fibres(count).len())
                .max()
                .unwrap_or(count)
        };
        // Equal numbers of fibres at every station, so that sets can be interpolated.
        let count = most(section.fibres);
        let unit = |(profile, size): (&Profile, SectionSize)| -> Vec<[f64; 2]> {
            let scaled = |[y, area]: [f64; 2]| [y / size.gyration(), area / size.area];
            profile.fibres(count).into_iter().map(scaled).collect()
        };
        let mut profiles: Vec<Vec<[f64; 2]>> = section.profiles().map(unit).collect();
        let alike = |a: &[[f64; 2]], b: &[[f64; 2]]| {
            let pairs = a.as_flattened().iter().zip(b.as_flattened());
            a.len() == b.len() && pairs.into_iter().all(|(x, y)| (x - y).abs() <= ALIKE * x.abs())
        };
        if profiles.iter().all(|other| alike(&profiles[0], other)) {
            profiles.truncate(1);
        }
        Self { section, profiles }
    }

    /// Fibres at a fraction of the beam's length: the profiles of the adjacent stations, both scaled to the area and the radius of gyration there
    /// and weighted by the distances to them; then those at both surfaces, without area.
    fn at(&self, fraction: f64) -> Vec<Fibre> {
        let here = self.section.at(fraction);
        let mut out = Vec::new();
        let mut add = |unit: &[[f64; 2]], weight: f64| {
            let (taller, larger) = (here.gyration(), weight * here.area);
            let fibre = |[y, area]: &[f64; 2]| Fibre::bearing(y * taller, area * larger, 0);
            out.extend(unit.iter().map(fibre));
        };
        match (self.profiles.as_slice(), self.section.stations_about(fraction)) {
            (profiles @ [_, _, ..], Some(([before, _], share))) => {
                let stations = &self.section.stations;
                let first = stations.iter().position(|s| s.at == before.at).unwrap_or(0);
                add(&profiles[first], 1.0 - share);
                add(&profiles[(first + 1).min(profiles.len() - 1)], share);
            }
            (profiles, _) => profiles.iter().for_each(|unit| add(unit, 1.0)),
        }
        let most = out.iter().map(|f| f.height).fold(0.0, f64::max);
        let half = here.depth.map_or(most, |d| 0.5 * d);
        out.extend([-half, half].map(Fibre::at_surface));
        out
    }
}

#[cfg(test)]
mod tests {
    use super::super::definition::Station;
    use super::*;

    fn tapered(sections: &[(f64, Section)]) -> Section {
        let station = |(at, s): &(f64, Section)| Station {
            at: *at,
            area: s.area,
            inertia: s.inertia,
            depth: s.depth,
            profile: s.profile.clone(),
            properties: Default::default(),
        };
        Section { stations: sections.iter().map(station).collect(), ..sections[0].1.clone() }
    }

    fn sum(fibres: &[Fibre], f: impl Fn(f64) -> f64) -> f64 {
        fibres.iter().map(|fibre| fibre.area * f(fibre.height)).sum()
    }

    /// Plastic moments over the yield stress: `b d^2 / 4` of the rectangle, `b tf (d - tf) + tw (d - 2 tf)^2 / 4` of the I.
    #[test]
    fn a_taper_from_one_shape_to_another_has_the_plastic_moment_of_either_at_its_ends() {
        let [rectangle, i] =
            [Section::rectangle("r", 0.1, 0.2), Section::i_shape("i", 0.1, 0.1, 0.01, 0.006)];
        let plastic = [0.1 * 0.2 * 0.2 / 4.0, 0.1 * 0.01 * 0.09 + 0.006 * 0.08 * 0.08 / 4.0];
        for count in [4, 6, 16] {
            let taper = tapered(&[(0.0, rectangle.clone()), (1.0, i.clone())]);
            let section = Section { fibres: count, ..taper };
            let layout = ProfileLayout::new(&section);
            for (fraction, expected) in [(0.0, plastic[0]), (1.0, plastic[1])] {
                let found = sum(&layout.at(fraction), f64::abs);
                assert!((found / expected - 1.0).abs() < 1e-11, "{fraction}: {found:e}");
            }
            let number = layout.at(0.0).len();
            for fraction in [0.1, 0.35, 0.5, 0.9] {
                let (fibres, size) = (layout.at(fraction), section.at(fraction));
                assert_eq!(fibres.len(), number);
                assert!((sum(&fibres, |_| 1.0) / size.area - 1.0).abs() < 1e-12);
                assert!((sum(&fibres, |y| y * y) / size.inertia - 1.0).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn tapers_of_one_shape_have_the_fibres_of_that_shape() {
        let taper =
            [(0.0, Section::rectangle("a", 0.1, 0.1)), (1.0, Section::rectangle("b", 0.1, 0.3))];
        let section = tapered(&taper);
        assert_eq!(ProfileLayout::new(&section).at(0.5).len(), section.fibres + 2);
    }
}
