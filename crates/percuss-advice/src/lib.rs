//! The advisor: what hand calculation says about a run before it, and beside its results after it.
//!
//! It reads a model and judges; it changes nothing and no result depends on it. Every estimate is for the first touch of what is
//! at rest or in the motion it starts with.

mod after;
mod audit;
mod before;
mod case;
mod duration;
mod end_on;
mod ends;
mod expected;
mod faces;
pub mod formulas;
mod millimetres;
mod resolution;
mod review;
mod shear;
mod slips;
mod stability;
mod structure;
mod surroundings;
mod taper;
#[cfg(test)]
mod tests;
mod touch;
mod words;

use percuss::{FirstTouches, Model, RunSummary, SectionForceSummary, Settings, massless};
use percuss_codes::Code;
pub use percuss_codes::{Caution, Topic};

/// How much a finding weighs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Verdict {
    /// As it should be.
    Fine,
    /// Found, and allowed by the author of the scenario.
    Allowed,
    /// Worth knowing when results are read.
    Note,
    /// Results are likely to mislead.
    Warning,
}

/// A finding about one contact, or about what looks like a slip of a unit, before the run.
#[derive(Clone, Debug, PartialEq)]
pub struct Advice {
    /// Name of the contact; for a slip, of the part it is in.
    pub contact: String,
    /// What it is about.
    pub topic: Topic,
    /// The quantity found, in `unit`.
    pub value: f64,
    /// What it is held against, in `unit`.
    pub reference: f64,
    /// Unit of both.
    pub unit: &'static str,
    /// How much it weighs.
    pub verdict: Verdict,
    /// What it means and, unless it is fine, what to do.
    pub text: String,
    /// Why it is allowed, in the words of whoever allowed it.
    pub reason: Option<String>,
}

/// A result beside a hand formula.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// Name of the contact.
    pub contact: String,
    /// What the formula is called.
    pub formula: &'static str,
    /// Where it comes from.
    pub source: &'static str,
    /// What is compared.
    pub quantity: &'static str,
    /// Unit of both values.
    pub unit: &'static str,
    /// By the formula.
    pub by_hand: f64,
    /// By the run.
    pub simulated: f64,
    /// `(simulated - by_hand) / by_hand`, in per cent.
    pub difference_percent: f64,
    /// The formula's assumptions, and for each whether it is met here.
    pub holds_if: String,
}

impl Advice {
    /// A finding that nobody has allowed so far; `values` are what is found and what it is held against.
    pub(crate) fn new(
        contact: impl Into<String>,
        topic: Topic,
        values: [f64; 2],
        unit: &'static str,
        verdict: Verdict,
        text: String,
    ) -> Self {
        let [value, reference] = values;
        Self { contact: contact.into(), topic, value, reference, unit, verdict, text, reason: None }
    }
}

/// Something that the audit of a finished run warns of.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AuditWarning {
    /// What it is about.
    pub caution: Caution,
    /// A warning, unless it is allowed.
    pub verdict: Verdict,
    /// What was found, and what to do.
    pub text: String,
    /// Why it is allowed, in the words of whoever allowed it.
    pub reason: Option<String>,
}

impl Verdict {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Fine => "fine",
            Self::Allowed => "allowed",
            Self::Note => "note",
            Self::Warning => "warning",
        }
    }
}

/// What looks like a slip of a unit, then what hand calculation says about each contact of a run that is still to be made.
pub fn advise(model: &Model, settings: &Settings) -> Vec<Advice> {
    if !massless(model).is_empty() {
        // No run in time, so no contact either.
        let mut all = slips::findings(model, settings);
        all.extend(ends::findings(model));
        return all;
    }
    let masses = model.effective_masses();
    let modes = duration::Modes::new(model);
    let trials = expected::Trials::new(model, settings);
    let cases = (0..model.contacts().len()).filter_map(|k| case::read(model, k, None));
    let mut touches = FirstTouches::new(model);
    let mut all = slips::findings(model, settings);
    all.extend(ends::findings(model));
    all.extend(taper::findings(model));
    all.extend(stability::of_the_start(model, settings));
    for case in cases {
        let mass = match case.guided {
            Some(k) => masses.get(k).copied(),
            None => touches.effective_mass(case.index),
        };
        all.extend(before::findings(model, settings, &case, mass, (&modes, &trials)));
    }
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

/// Puts what a run showed of first touches in the place of what was expected of them before it; the reasons of [`allow`] are still to be
/// given to them.
pub fn settle(advice: &mut [Advice], settings: &Settings, summary: &RunSummary) {
    touch::settle(advice, settings, summary);
}

/// What the audit of a finished run warns of: conditions of contacts, things inside each other, blows that were shared, impulses that are
/// properties of the mesh (unless `advice`, all that was found, has it), balances that do not close. `reason` is that of [`allow`].
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

/// Beams of an equilibrium that are stressed beyond what their materials usually bear.
pub fn beyond_strength(section_forces: &[SectionForceSummary]) -> Vec<Advice> {
    section_forces.iter().filter_map(review::beyond_strength).collect()
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
