//! The section of a span along its beam.

use super::definition::{RotaryInertia, SectionSize, Station, UniformSection};
use super::fibres::Make;
use crate::element::beam::{SectionValues, ShearedPlace};
use crate::element::point::SectionLaw;

/// The section of a span: constants at stations of the beam, linear between them. Elements, faces, stresses and drawings all ask it.
#[derive(Clone, Debug)]
pub struct SectionLine {
    /// Stations of the beam with the constants there, in their order along it, shape (stations) \[m, several\]; one for a uniform
    /// section.
    stations: Vec<(f64, SectionValues)>,
}

impl SectionLine {
    /// That of a part of a beam of the given arc length \[m\].
    pub(super) fn new(make: &Make, length: f64) -> Self {
        let stations = match make.section.stations.as_slice() {
            [] => vec![(0.0, values(make, &make.section.uniform()))],
            some => {
                let at = |s: &Station| (s.at * length, values(make, &make.section.station(s)));
                some.iter().map(at).collect()
            }
        };
        Self { stations }
    }

    /// Whether it is the same everywhere.
    pub fn is_uniform(&self) -> bool {
        self.stations.len() == 1
    }

    /// Constants at an arc length from the start of the beam \[m\].
    pub fn at(&self, s: f64) -> SectionValues {
        let next = self.stations.partition_point(|station| station.0 < s);
        let Some(&(to, after)) = self.stations.get(next) else {
            return self.stations[self.stations.len() - 1].1;
        };
        if next == 0 || to == s {
            return after;
        }
        let (from, before) = self.stations[next - 1];
        mixed(&before, &after, (s - from) / (to - from))
    }
}

/// Constants at a share of the length from one station to the next.
fn mixed(from: &SectionValues, to: &SectionValues, share: f64) -> SectionValues {
    let mix = |f: fn(&SectionValues) -> f64| {
        let (a, b) = (f(from), f(to));
        a + share * (b - a)
    };
    SectionValues {
        law: SectionLaw {
            axial: mix(|s| s.law.axial),
            bending: mix(|s| s.law.bending),
            rotary: mix(|s| s.law.rotary),
            measure: from.law.measure,
        },
        mass: mix(|s| s.mass),
        area: mix(|s| s.area),
        inertia: mix(|s| s.inertia),
        young: mix(|s| s.young),
        density: mix(|s| s.density),
        half_depth: mix(|s| s.half_depth),
        shear: mix(|s| s.shear),
        sheared: [0, 1].map(|k| {
            let (a, b) = (from.sheared[k], to.sheared[k]);
            let between = |a: f64, b: f64| a + share * (b - a);
            ShearedPlace { height: between(a.height, b.height), area: between(a.area, b.area) }
        }),
    }
}

/// Constants of a section, or of a station of it.
fn values(make: &Make, section: &UniformSection) -> SectionValues {
    let material = make.material;
    let SectionSize { area, inertia, depth } = section.size;
    let half_depth = depth.map_or(f64::NAN, |d| 0.5 * d);
    if let Some((law, mass)) = make.law(material.strain) {
        // Of several materials the means over the area.
        let plain = make.is_plain();
        let (young, density) = (law.axial / area, mass / area);
        let young = if plain { material.young } else { young };
        let density = if plain { material.density } else { density };
        let factor = section.shear_factor.unwrap_or(f64::NAN);
        let shear = factor * make.shear_stiffness().unwrap_or(f64::NAN);
        let sheared = [ShearedPlace::UNKNOWN; 2];
        return SectionValues {
            law,
            mass,
            area,
            inertia,
            young,
            density,
            half_depth,
            shear,
            sheared,
        };
    }
    let (young, density) = (material.young, material.density);
    let rotary = match section.rotary_inertia {
        RotaryInertia::Density => density * inertia,
        RotaryInertia::Neglected => 0.0,
        RotaryInertia::Given(value) => value,
    };
    let (axial, bending) = (young * area, young * inertia);
    let law = SectionLaw { axial, bending, rotary, measure: material.strain };
    let factor = section.shear_factor(material.poisson_in_shear());
    let shear = factor * material.shear_stiffness().unwrap_or(f64::NAN) * area;
    let mass = density * area;
    let sheared = match section.profile.shear_widths() {
        Some(places) => places.map(|one| ShearedPlace {
            height: one.height,
            area: inertia * one.width / one.moment_beyond,
        }),
        None => [ShearedPlace::UNKNOWN; 2],
    };
    SectionValues { law, mass, area, inertia, young, density, half_depth, shear, sheared }
}
