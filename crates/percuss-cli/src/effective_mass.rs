//! The effective mass of a struck point and its limit with mesh refinement, on which rigid impacts depend.

use percuss::EffectiveMass;

use crate::number::quantity;

/// The effective mass beside its limit.
pub fn line(mass: &EffectiveMass) -> String {
    if mass.on_mesh.is_infinite() {
        return "the struck point is supported: infinite effective mass".into();
    }
    let (on_mesh, limit) = (quantity(mass.on_mesh, "kg"), quantity(mass.limit, "kg"));
    format!("effective mass {on_mesh}, limit with mesh refinement {limit}")
}
