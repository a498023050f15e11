//! The advisor: what hand calculation says about a run before it, and beside its results after it.
//!
//! It reads a model and judges; it changes nothing and no result depends on it. Every estimate is for the first touch of what is
//! at rest or in the motion it starts with.

mod advice;
mod after;
mod audit;
mod beds;
mod before;
mod case;
mod ductility;
mod duration;
mod end_on;
mod ends;
mod expected;
mod faces;
mod first_contact;
pub mod formulas;
mod magnitudes;
mod millimetres;
mod neglected_shear;
mod planned;
mod plastic_mesh;
mod property_magnitudes;
mod resolution;
mod resolved;
mod review;
mod rows_of_contact;
mod shear;
mod stability;
mod straight;
mod structure;
mod surroundings;
mod taper;
#[cfg(test)]
mod tests;
mod words;

pub use advice::{Advice, AuditWarning, Comparison, Verdict};
use percuss::{Equilibrium, FirstTouches, Model, RunSummary, Settings, massless, yielded_at_rest};
use percuss_codes::Code;
pub use percuss_codes::{Caution, Topic};

/// What looks like a slip of a unit, then what hand calculation says about each contact of a run that is still to be made.
pub fn advise(model: &Model, settings: &Settings) -> Vec<Advice> {
    if !massless(model).is_empty() {
        // No run in time, so no contact either.
        let mut all = magnitudes::findings(model, settings);
        all.extend(ends::findings(model));
        all.extend(plastic_mesh::findings(model));
        all.extend(beds::findings(model));
        return all;
    }
    let masses = model.effective_masses();
    let modes = duration::Modes::new(model);
    let trials = expected::Trials::new(model, settings);
    let cases = (0..model.contacts().len()).filter_map(|k| case::read(model, k, None));
    let mut touches = FirstTouches::new(model);
    let mut all = magnitudes::findings(model, settings);
    all.extend(ends::findings(model));
    all.extend(beds::findings(model));
    all.extend(taper::findings(model));
    all.extend(plastic_mesh::findings(model));
    all.extend(stability::of_the_start(model, settings));
    all.extend(straight::under_loads(model, settings));
    let mut estimated = Vec::new();
    for case in cases {
        let mass = match case.guided {
            Some(k) => masses.get(k).copied(),
            None => touches.effective_mass(case.index),
        };
        let found = before::findings(model, settings, &case, mass, (&modes, &trials));
        if let case::Meeting::Struck(struck) = &case.meeting
            && found.iter().any(|advice| advice.topic == Topic::Shear)
        {
            estimated.push(struck.place.index);
        }
        all.extend(found);
    }
    all.extend(shear::of_other_beams(model, &modes, &estimated));
    all
}

/// Takes their weight from notes and warnings that are allowed: `reason` gives the reason for a code, where there is one. They stay
/// among the findings, with it. What is fine stays fine.
pub fn allow<'r>(advice: &mut [Advice], reason: impl Fn(Code) -> Option<&'r str>) {
    for one in advice.iter_mut().filter(|one| one.verdict > Verdict::Allowed) {
        if let Some(reason) = reason(one.topic.into()) {
            one.verdict = Verdict::Allowed;
            one.reason = Some(reason.to_owned());
        }
    }
}

/// Findings of a finished run.
#[derive(Clone, Debug)]
pub struct Findings {
    /// Those before the run, with what the run showed of them, then those after it, shape (findings).
    pub advice: Vec<Advice>,
    /// Number of those before the run.
    pub before: usize,
    /// Warnings of the audit, shape (warnings).
    pub warnings: Vec<AuditWarning>,
}

impl Findings {
    /// Those after the run, shape (findings).
    pub fn after(&self) -> &[Advice] {
        &self.advice[self.before..]
    }
}

/// Findings of a finished run from those `before` it ([`advise`], then [`allow`]); `reason` is that of [`allow`].
pub fn conclude<'r>(
    model: &Model,
    settings: &Settings,
    summary: &RunSummary,
    before: Vec<Advice>,
    reason: impl Fn(Code) -> Option<&'r str>,
) -> Findings {
    let mut advice = before;
    let after = review(model, settings, summary, &advice);
    settle(&mut advice, settings, summary);
    plastic_mesh::settle_struck(model, &mut advice, summary);
    advice.retain(|one| !resolved::is_settled(one, &after));
    let before = advice.len();
    advice.extend(after);
    allow(&mut advice, &reason);
    let warnings = audit(summary, &advice, reason);
    Findings { advice, before, warnings }
}

/// Puts what a run showed of first touches, and of rigid contacts without impacts, in the place of what was expected of them before it; the
/// reasons of [`allow`] are still to be given to them.
pub fn settle(advice: &mut [Advice], settings: &Settings, summary: &RunSummary) {
    first_contact::settle(advice, settings, summary);
    review::settle(advice, summary);
    plastic_mesh::settle(advice, summary);
}

/// What the audit of a finished run warns of: conditions of contacts, initial interpenetration, multiple impacts, impulses that are
/// properties of the mesh (unless `advice`, all that was found, has it), balance errors. `reason` is that of [`allow`].
pub fn audit<'r>(
    run: &RunSummary,
    advice: &[Advice],
    reason: impl Fn(Code) -> Option<&'r str>,
) -> Vec<AuditWarning> {
    let warning = |(caution, text): (Caution, String)| {
        let reason = reason(caution.into()).map(str::to_owned);
        let verdict = if reason.is_some() { Verdict::Allowed } else { Verdict::Warning };
        AuditWarning { caution, verdict, text, reason }
    };
    audit::warnings(run, advice).into_iter().map(warning).collect()
}

/// The results of a run beside the hand formulas whose case they are, contact after contact.
pub fn compare(model: &Model, settings: &Settings, summary: &RunSummary) -> Vec<Comparison> {
    let mut all = Vec::new();
    let modes = duration::Modes::new(model);
    for k in 0..summary.contacts.len() {
        all.extend(after::comparisons(model, settings, summary, &modes, k));
    }
    all
}

/// Beams of an equilibrium that are stressed beyond what their materials usually bear, or that their mesh or the law of their material does not
/// describe as far as they yielded.
pub fn at_rest(model: &Model, found: &Equilibrium) -> Vec<Advice> {
    let forces = &found.section_forces;
    let mut all: Vec<Advice> =
        forces.iter().filter_map(|beam| review::beyond_strength(model, beam, None)).collect();
    all.extend(plastic_mesh::exceeded(model, forces));
    all.extend(ductility::findings(model, forces, &yielded_at_rest(model, found)));
    all
}

/// What is worth knowing of a finished run before its results are used: contacts still closed or never reached at its end,
/// or of too few steps, reactions that no mesh settles, strains beyond what their measure can be trusted with. What `before` has, the findings
/// before the run, is not said again.
pub fn review(
    model: &Model,
    settings: &Settings,
    summary: &RunSummary,
    before: &[Advice],
) -> Vec<Advice> {
    review::findings(model, settings, summary, before)
}
