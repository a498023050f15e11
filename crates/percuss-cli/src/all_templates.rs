//! Templates of all kinds.

use percuss_scenario::{Template, fit_templates, study_templates, templates};

/// Scenarios, then studies, then fits.
pub fn all_templates() -> impl Iterator<Item = &'static Template> {
    templates().iter().chain(study_templates()).chain(fit_templates())
}
