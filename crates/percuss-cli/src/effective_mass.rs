//! The effective mass of a struck point against its limit: what a mesh does to rigid impacts.

use percuss::{ContactSummary, Model, Recorder, RecorderError, Settings, simulate};

use crate::number::number;

/// Beyond this share of the limit the mesh decides about impulses.
const TOLERATED: f64 = 0.5;

/// The effective mass beside its limit.
pub fn line(contact: &ContactSummary) -> String {
    let (mass, limit) = (contact.effective_mass, contact.effective_mass_limit);
    if mass.is_infinite() {
        return "the point struck is held: its effective mass is infinite".into();
    }
    format!("effective mass {} kg, on ever finer meshes {} kg", number(mass), number(limit))
}

/// What to say where the two differ by more than half of the limit.
pub fn warning(contact: &ContactSummary) -> Option<String> {
    let (mass, limit) = (contact.effective_mass, contact.effective_mass_limit);
    let differs = mass.is_finite() && (mass - limit).abs() > TOLERATED * limit;
    differs.then(|| {
        format!(
            "the mass of the point that `{}` strikes is off its limit by more than half: \
             on this mesh impulses depend on the size of the elements",
            contact.name
        )
    })
}

/// The contacts of a model that has not run: their effective masses, nothing else.
pub fn of_model(model: &Model, settings: &Settings) -> Vec<ContactSummary> {
    let mut none = Standstill;
    simulate(model, settings, &mut none).map(|summary| summary.contacts).unwrap_or_default()
}

/// Ends a run before its first step.
struct Standstill;

impl Recorder for Standstill {
    fn begin(&mut self, _: &[percuss::Channel]) -> Result<(), RecorderError> {
        Err("not to be run".into())
    }
}
