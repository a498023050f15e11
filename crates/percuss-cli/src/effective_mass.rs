//! The effective mass of a struck point against its limit: what a mesh does to rigid impacts.

use percuss::EffectiveMass;

use crate::number::number;

/// The effective mass beside its limit.
pub fn line(mass: &EffectiveMass) -> String {
    if mass.on_mesh.is_infinite() {
        return "the point struck is held: its effective mass is infinite".into();
    }
    let (on_mesh, limit) = (number(mass.on_mesh), number(mass.limit));
    format!("effective mass {on_mesh} kg, on ever finer meshes {limit} kg")
}

/// What to say where the two differ by more than half of the limit.
pub fn warning(projectile: &str, mass: &EffectiveMass) -> Option<String> {
    mass.depends_on_mesh().then(|| {
        format!(
            "the mass of the point that `{projectile}` strikes is off its limit by more than half: \
             on this mesh impulses depend on the size of the elements"
        )
    })
}
