//! Definitions the tests share: the paper's plank and projectiles, a disc, a straight beam, small models of these.
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

/// A ball of 3 kg that moves at 2 m/s towards a floor with restitution 0.5 from the given gap; a beam is far from both.
pub fn ball_above_floor(gap: f64) -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("stuff", 1e9, 1e3));
    let section = b.section(Section::new("bar", 0.01, 1e-5));
    b.beam(beam("far", [0.0, 9.0], [1.0, 9.0], 1, material, section));
    let ball = b.disc(disc("ball", 3.0, 0.1, [0.0, 0.1 + gap], [0.0, -2.0]));
    let shape = ObstacleShape::HalfPlane { point: [0.0, 0.0], normal: [0.0, 1.0] };
    let floor = b.obstacle(Obstacle { name: "floor".into(), shape, motion: None });
    let between = [ContactPartner::Disc(ball), ContactPartner::Obstacle(floor)];
    let law = TouchLaw::Rigid(RigidLaw::frictionless(0.5));
    b.contact(Contact::new("c", between, law));
    b.build().unwrap()
}

/// Equilibrium of a cantilever under a moment at its tip, a recorded point.
pub fn bent_by_end_moment(
    mut b: ModelBuilder,
    arm: Beam,
    moment: f64,
) -> Result<Equilibrium, Error> {
    let arm = b.beam(arm);
    b.support(Support::new("root", at("root", arm, 0.0), SupportKind::Clamp));
    let tip = at("tip", arm, 1.0);
    b.record_point(tip.clone());
    let kind = LoadKind::Point { at: tip, force: [0.0; 2], moment, follower: false };
    b.load(Load::new("end", kind));
    equilibrium(&b.build().unwrap())
}

/// Whether suites are run as a whole, as by `scripts/check --full`, and not a sample of each.
pub fn whole() -> bool {
    std::env::var_os("PERCUSS_WHOLE").is_some()
}
