//! Definitions the tests share: the paper's plank and projectiles, a disc, a straight beam.
#![allow(dead_code)] // each test file uses its own part

pub mod numbers;
pub mod rows;
pub mod straight;

use percuss::*;

/// The paper's first material and its section.
pub fn plank(b: &mut ModelBuilder) -> (MaterialId, SectionId) {
    let material = b.material(Material::new("composite", 0.2e10, 3e3));
    let section = b.section(Section::new("plank", 0.1, 8.33e-5));
    (material, section)
}

/// A straight beam.
pub fn beam(
    name: &str,
    start: [f64; 2],
    end: [f64; 2],
    elements: usize,
    material: MaterialId,
    section: SectionId,
) -> Beam {
    Beam::new(name, &[start, end], elements, material, section)
}

/// A point at a fraction of a beam.
pub fn at(label: &str, beam: BeamId, fraction: f64) -> PointRef {
    PointRef { label: label.into(), beam, along: Along::Fraction(fraction) }
}

/// A disc without spin, its mass spread evenly over it.
pub fn disc(name: &str, mass: f64, radius: f64, position: [f64; 2], velocity: [f64; 2]) -> Disc {
    Disc { name: name.into(), mass, inertia: None, radius, position, velocity, spin: 0.0 }
}

/// The paper's elastic projectile with a short standoff.
pub fn elastic(name: &str, strikes: PointRef, velocity: [f64; 2]) -> Projectile {
    Projectile {
        name: name.into(),
        kind: ProjectileKind::spring(7.5e5),
        mass: 500.0,
        velocity,
        direction: None,
        strikes,
        standoff: 0.02,
        rear: None,
        local_mass: 0.0,
    }
}

/// The paper's rigid projectile with a short standoff.
pub fn rigid(name: &str, strikes: PointRef, velocity: [f64; 2], restitution: f64) -> Projectile {
    Projectile {
        name: name.into(),
        kind: ProjectileKind::Rigid { restitution },
        mass: 100.0,
        velocity,
        direction: None,
        strikes,
        standoff: 0.02,
        rear: None,
        local_mass: 0.0,
    }
}

/// Whether suites are run as a whole, as by `scripts/check --full`, and not a sample of each.
pub fn whole() -> bool {
    std::env::var_os("PERCUSS_WHOLE").is_some()
}
