//! Scenes the benchmarks share.

use percuss::*;

/// The paper's elastic example, clamped, with any number of elements.
///
/// # Panics
/// Never: the definitions are sound.
pub fn elastic_example(elements: usize) -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(Material {
        name: "composite".into(),
        young: 0.2e10,
        density: 3e3,
        strain: StrainMeasure::Green,
    });
    let section = b.section(Section {
        name: "plank".into(),
        area: 0.1,
        inertia: 8.33e-5,
        rotary_inertia: RotaryInertia::Density,
    });
    let points = vec![[0.0, 0.0], [3.0, 0.0]];
    let girder = b.beam(Beam { name: "girder".into(), points, elements, material, section });
    let at =
        |label: &str, f| PointRef { label: label.into(), beam: girder, along: Along::Fraction(f) };
    for (name, f) in [("left", 0.0), ("right", 1.0)] {
        b.support(Support { name: name.into(), at: at(name, f), kind: SupportKind::Clamp });
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
