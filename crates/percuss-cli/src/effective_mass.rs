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
