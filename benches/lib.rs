//! Scenes the benchmarks share.

use percuss::*;

/// The paper's elastic example, clamped, with any number of elements.
///
/// # Panics
/// Never: the definitions are sound.
pub fn elastic_example(elements: usize) -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("composite", 0.2e10, 3e3));
    let section = b.section(Section::new("plank", 0.1, 8.33e-5));
    let points = vec![[0.0, 0.0], [3.0, 0.0]];
    let girder = b.beam(Beam::new("girder", &points, elements, material, section));
    let at =
        |label: &str, f| PointRef { label: label.into(), beam: girder, along: Along::Fraction(f) };
    for (name, f) in [("left", 0.0), ("right", 1.0)] {
        b.support(Support::new(name, at(name, f), SupportKind::Clamp));
    }
    b.projectile(Projectile {
        name: "mass".into(),
        kind: ProjectileKind::Elastic { stiffness: 7.5e5, force: ContactForce::Conserving },
        mass: 500.0,
        velocity: [0.0, 20.0],
        direction: None,
        strikes: at("girder.mid", 0.5),
        standoff: 0.2,
    });
    b.build().expect("a sound scene")
}
