//! Cross sections.

use super::profile::{Profile, SectionFibre, Strip};
use super::rounding::Moments;
use super::walls::Walls;

/// Rotary inertia per unit length of a section, rhoI \[kg m\].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum RotaryInertia {
    /// `density * inertia`.
    #[default]
    Density,
    /// None: an Euler-Bernoulli beam in the narrow sense.
    Neglected,
    /// Given directly \[kg m\].
    Given(f64),
}

/// Cross section of a beam.
#[derive(Clone, Debug, PartialEq)]
pub struct Section {
    /// The user's name for it.
    pub name: String,
    /// Area A \[m^2\].
    pub area: f64,
    /// Second moment of area I \[m^4\].
    pub inertia: f64,
    /// Depth between the extreme fibres, the centroid half-way \[m\]; without it no fibre strains are reported.
    pub depth: Option<f64>,
    /// Rotary inertia per unit length.
    pub rotary_inertia: RotaryInertia,
    /// Stations of a tapered section, shape (stations); empty for a uniform one, whose values are given above. Area, inertia and depth vary
    /// linearly between stations.
    pub stations: Vec<Station>,
    /// Distribution of its area about the centre line; that of the first station of a tapered one.
    pub profile: Profile,
    /// Fibres through the depth where it can yield; an even number.
    pub fibres: usize,
    /// Shear factor kappa in place of that of its shape \[-\].
    pub shear_factor: Option<f64>,
    /// Its walls, if it is an I or a box.
    pub walls: Option<Walls>,
}

/// A tapered section at a fraction of the beam's length.
#[derive(Clone, Debug, PartialEq)]
pub struct Station {
    /// Fraction of the beam's arc length.
    pub at: f64,
    /// Area A \[m^2\].
    pub area: f64,
    /// Second moment of area I \[m^4\].
    pub inertia: f64,
    /// Depth between the extreme fibres \[m\].
    pub depth: Option<f64>,
    /// Distribution of its area about the centre line there.
    pub profile: Profile,
    /// Properties of its own.
    pub properties: StationProperties,
}

/// Properties of a station that do not follow from its size; those given of the tapered section as a whole come first.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StationProperties {
    /// Rotary inertia per unit length.
    pub rotary_inertia: RotaryInertia,
    /// Shear factor kappa in place of that of its shape \[-\].
    pub shear_factor: Option<f64>,
    /// Its walls, if it is an I or a box.
    pub walls: Option<Walls>,
}

/// A section without change along a beam: one that is uniform, or a station of a tapered one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct UniformSection<'a> {
    /// Its size.
    pub size: SectionSize,
    /// Distribution of its area.
    pub profile: &'a Profile,
    /// Rotary inertia per unit length.
    pub rotary_inertia: RotaryInertia,
    /// Shear factor, if it is given \[-\].
    pub shear_factor: Option<f64>,
    /// Its walls, if it is an I or a box.
    pub walls: Option<&'a Walls>,
}

/// The size of a section.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SectionSize {
    /// Area \[m^2\].
    pub area: f64,
    /// Second moment of area \[m^4\].
    pub inertia: f64,
    /// Depth between the extreme fibres \[m\].
    pub depth: Option<f64>,
}

impl SectionSize {
    /// Radius of gyration \[m\].
    pub fn gyration(&self) -> f64 {
        (self.inertia / self.area).sqrt()
    }
}

impl Station {
    /// The size of the section there.
    pub(crate) fn size(&self) -> SectionSize {
        SectionSize { area: self.area, inertia: self.inertia, depth: self.depth }
    }
}

impl Section {
    /// Default number of fibres through the depth.
    pub const FIBRES: usize = 16;

    /// Most fibres through the depth.
    pub const MOST_FIBRES: usize = 200;

    /// A uniform section of given area and second moment of area.
    pub fn new(name: impl Into<String>, area: f64, inertia: f64) -> Self {
        Self {
            name: name.into(),
            area,
            inertia,
            depth: None,
            rotary_inertia: RotaryInertia::Density,
            stations: Vec::new(),
            profile: Profile::Unknown,
            fibres: Self::FIBRES,
            shear_factor: None,
            walls: None,
        }
    }

    /// A section of given depth.
    fn deep(name: impl Into<String>, area: f64, inertia: f64, depth: f64) -> Self {
        Self { depth: Some(depth), ..Self::new(name, area, inertia) }
    }

    fn with(self, profile: Profile) -> Self {
        Self { profile, ..self }
    }

    /// A rectangle; `depth` is in the plane of bending.
    pub fn rectangle(name: impl Into<String>, width: f64, depth: f64) -> Self {
        let section = Self::deep(name, width * depth, width * depth.powi(3) / 12.0, depth);
        section.with(Profile::Strips(vec![Strip { from: 0.0, to: 0.5 * depth, width }]))
    }

    /// A full circle.
    pub fn circle(name: impl Into<String>, diameter: f64) -> Self {
        let pi = std::f64::consts::PI;
        let (area, inertia) = (pi * diameter.powi(2) / 4.0, pi * diameter.powi(4) / 64.0);
        let profile = Profile::Ring { outer: 0.5 * diameter, inner: 0.0 };
        Self::deep(name, area, inertia, diameter).with(profile)
    }

    /// A circular tube.
    pub fn tube(name: impl Into<String>, diameter: f64, thickness: f64) -> Self {
        let (pi, inner) = (std::f64::consts::PI, diameter - 2.0 * thickness);
        let area = pi * (diameter.powi(2) - inner.powi(2)) / 4.0;
        let inertia = pi * (diameter.powi(4) - inner.powi(4)) / 64.0;
        let profile = Profile::Ring { outer: 0.5 * diameter, inner: 0.5 * inner };
        Self::deep(name, area, inertia, diameter).with(profile)
    }

    /// A doubly symmetric I without fillets, bent about its strong axis.
    pub fn i_shape(name: impl Into<String>, width: f64, depth: f64, flange: f64, web: f64) -> Self {
        let clear = depth - 2.0 * flange;
        let area = 2.0 * width * flange + web * clear;
        let inertia = (width * depth.powi(3) - (width - web) * clear.powi(3)) / 12.0;
        let profile = Profile::flanged(width, depth, clear, web);
        let walls = Some(Walls::new([width, depth], flange, web, false));
        Self { walls, ..Self::deep(name, area, inertia, depth).with(profile) }
    }

    /// A rectangular box of uniform wall thickness.
    pub fn hollow_box(name: impl Into<String>, width: f64, depth: f64, thickness: f64) -> Self {
        let (w, d) = (width - 2.0 * thickness, depth - 2.0 * thickness);
        let inertia = (width * depth.powi(3) - w * d.powi(3)) / 12.0;
        let profile = Profile::flanged(width, depth, d, 2.0 * thickness);
        let walls = Some(Walls::new([width, depth], thickness, 2.0 * thickness, true));
        Self { walls, ..Self::deep(name, width * depth - w * d, inertia, depth).with(profile) }
    }

    /// A rolled I: as [`i_shape`](Self::i_shape), with fillets of a radius between web and flanges, half the clear height at most.
    pub fn rolled_i(
        name: impl Into<String>,
        width: f64,
        depth: f64,
        flange: f64,
        web: f64,
        fillet: f64,
    ) -> Self {
        let plain = Self::i_shape(name, width, depth, flange, web);
        if fillet <= 0.0 {
            return plain;
        }
        let inner = 0.5 * depth - flange;
        let corner = Moments::corner(inner, fillet);
        let root = Moments::rectangle(web, inner - fillet, inner).with(2.0, corner);
        let web = Strip { from: 0.0, to: inner - fillet, width: web };
        let strips = vec![web, root.strip(), Strip { from: inner, to: 0.5 * depth, width }];
        plain.added(corner, 4.0).with(Profile::Strips(strips))
    }

    /// A hollow rectangle of uniform wall thickness with corners of given outer and inner radius, half the inner sides at most.
    pub fn rounded_box(
        name: impl Into<String>,
        width: f64,
        depth: f64,
        thickness: f64,
        [outer, inner]: [f64; 2],
    ) -> Self {
        let plain = Self::hollow_box(name, width, depth, thickness);
        let (top, face) = (0.5 * depth, 0.5 * depth - thickness);
        let [cut, filled] = [Moments::corner(top, outer), Moments::corner(face, inner)];
        let walls = Moments::rectangle(2.0 * thickness, face - inner, face);
        let flange = walls.with(1.0, Moments::rectangle(width, face, top));
        let web = Strip { from: 0.0, to: face - inner, width: 2.0 * thickness };
        let strips = vec![web, flange.with(-2.0, cut).with(2.0, filled).strip()];
        plain.added(filled, 4.0).added(cut, -4.0).with(Profile::Strips(strips))
    }

    /// With so many equal areas more, symmetric about both axes.
    fn added(self, one: Moments, count: f64) -> Self {
        let (area, inertia) = (self.area + count * one.area, self.inertia + count * one.second);
        Self { area, inertia, ..self }
    }

    /// Fibres one by one; the centre line of the beam is their elastic centroid, and the depth is twice the largest of their
    /// distances from it.
    pub fn of_fibres(name: impl Into<String>, fibres: Vec<SectionFibre>) -> Self {
        let sum = |f: fn(&SectionFibre) -> f64| fibres.iter().map(f).sum::<f64>();
        let (area, inertia) = (sum(|f| f.area), sum(|f| f.area * f.height * f.height));
        let most = fibres.iter().map(|f| f.height.abs()).fold(0.0, f64::max);
        // Fibres at no height are a fault of their own.
        let depth = (most > 0.0).then_some(2.0 * most);
        Self { depth, ..Self::new(name, area, inertia) }.with(Profile::Fibres(fibres))
    }

    /// Fibres given one by one, if it is made of such.
    pub(crate) fn given_fibres(&self) -> Option<&[SectionFibre]> {
        match &self.profile {
            Profile::Fibres(fibres) => Some(fibres),
            _ => None,
        }
    }

    /// Its size; that of its first station if it is tapered.
    pub(crate) fn size(&self) -> SectionSize {
        SectionSize { area: self.area, inertia: self.inertia, depth: self.depth }
    }

    /// Stations before and after a fraction of the beam's length, and its relative distance from the first to the second; `None` for a uniform
    /// section.
    pub(crate) fn stations_about(&self, fraction: f64) -> Option<([&Station; 2], f64)> {
        let (first, last) = (self.stations.first()?, self.stations.last()?);
        let next = self.stations.partition_point(|s| s.at < fraction);
        let (a, b) = match next {
            0 => (first, first),
            _ => (&self.stations[next - 1], self.stations.get(next).unwrap_or(last)),
        };
        let share = if b.at > a.at { (fraction - a.at) / (b.at - a.at) } else { 0.0 };
        Some(([a, b], share))
    }

    /// Its size at a fraction of the beam's length.
    pub(crate) fn at(&self, fraction: f64) -> SectionSize {
        let Some(([a, b], share)) = self.stations_about(fraction) else { return self.size() };
        let mix = |a: f64, b: f64| a + share * (b - a);
        SectionSize {
            area: mix(a.area, b.area),
            inertia: mix(a.inertia, b.inertia),
            depth: a.depth.zip(b.depth).map(|(a, b)| mix(a, b)),
        }
    }

    /// What it is made of: itself, or its stations.
    pub(crate) fn parts(&self) -> impl Iterator<Item = UniformSection<'_>> {
        let own = self.stations.is_empty().then(|| self.uniform());
        own.into_iter().chain(self.stations.iter().map(|s| self.station(s)))
    }

    /// Itself, not tapered.
    pub(crate) fn uniform(&self) -> UniformSection<'_> {
        UniformSection {
            size: self.size(),
            profile: &self.profile,
            rotary_inertia: self.rotary_inertia,
            shear_factor: self.shear_factor,
            walls: self.walls.as_ref(),
        }
    }

    /// One of its stations: what is given of the whole section comes first.
    pub(crate) fn station<'a>(&self, station: &'a Station) -> UniformSection<'a> {
        let own = &station.properties;
        UniformSection {
            size: station.size(),
            profile: &station.profile,
            rotary_inertia: match self.rotary_inertia {
                RotaryInertia::Density => own.rotary_inertia,
                given => given,
            },
            shear_factor: self.shear_factor.or(own.shear_factor),
            walls: own.walls.as_ref(),
        }
    }

    /// Profiles that it is made of, one or one a station, with the sizes they have there.
    pub(crate) fn profiles(&self) -> impl Iterator<Item = (&Profile, SectionSize)> {
        let own = self.stations.is_empty().then(|| (&self.profile, self.size()));
        own.into_iter().chain(self.stations.iter().map(|s| (&s.profile, s.size())))
    }
}
