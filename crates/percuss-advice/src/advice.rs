//! What the advisor says: findings before a run, warnings and comparisons after it.

use percuss_codes::{Caution, Topic};

/// How much a finding weighs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Verdict {
    /// Not known: no estimate applies.
    Unchecked,
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
    /// `(simulated - by_hand) / by_hand`, in per cent; of a bound no error.
    pub difference_percent: f64,
    /// Whether the formula gives an upper bound where its assumptions are met, below which the result may be far.
    pub bound: bool,
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

impl Comparison {
    /// Assumptions that are not met, in words, shape (assumptions).
    pub fn unmet(&self) -> Vec<&str> {
        self.holds_if.split("; ").filter_map(|one| one.strip_suffix(" (not met)")).collect()
    }
}

impl Verdict {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Unchecked => "not checked",
            Self::Fine => "fine",
            Self::Allowed => "allowed",
            Self::Note => "note",
            Self::Warning => "warning",
        }
    }
}

/// What looks like a slip of a unit.
pub(crate) fn magnitude_finding(
    part: &str,
    values: [f64; 2],
    unit: &'static str,
    verdict: Verdict,
    text: String,
) -> Advice {
    Advice::new(part, Topic::Magnitude, values, unit, verdict, text)
}
