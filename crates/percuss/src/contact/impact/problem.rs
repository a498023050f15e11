//! Impact problem for all contacts, and the memory for its solution.

use crate::linalg::complementarity::Lemke;
use crate::linalg::dense::DenseLu;

/// A contact of the problem.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conditions {
    /// Least rate of the gap \[m/s\].
    pub bound: f64,
    /// Coefficient of friction.
    pub friction: f64,
    /// Sliding rate of a contact that sticks \[m/s\].
    pub target: f64,
    /// Impulses along normal and tangent that it has carried already, shape (2) \[N s\]: signs and limits of friction are those of the sums.
    pub carried: [f64; 2],
}

impl Conditions {
    /// Least and largest tangential impulse per unit of normal impulse; without normal impulse only the impulse that cancels the previous one.
    pub(super) fn friction_limits(&self, normal: f64) -> [f64; 2] {
        let most = (self.friction * (normal + self.carried[0])).max(0.0);
        [-most - self.carried[1], most - self.carried[1]]
    }
}

/// The problem: rows 2 i and 2 i + 1 belong to normal and tangent of contact i.
#[derive(Clone, Debug, Default)]
pub struct ImpactProblem {
    /// Contacts, shape (contacts).
    pub contacts: Vec<Conditions>,
    /// Delassus operator, shape (2 contacts, 2 contacts), column by column \[1/kg\]; without friction the tangential entries are not used.
    pub delassus: Vec<f64>,
    /// Rates without impulses, shape (2 contacts) \[m/s\].
    pub free: Vec<f64>,
    /// Rates with the current impulses, shape (2 contacts) \[m/s\].
    pub(super) rates: Vec<f64>,
    pub(super) newton: Newton,
    pub(super) direct: Direct,
}

/// The iteration stalled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stalled;

/// Memory for Newton's iteration.
#[derive(Clone, Debug, Default)]
pub(super) struct Newton {
    pub(super) lu: DenseLu,
    /// Impulses along normal and tangent, shape (2 contacts) \[N s\].
    pub(super) impulses: Vec<f64>,
    /// Rates with these impulses, shape (2 contacts) \[m/s\].
    pub(super) rates: Vec<f64>,
    /// Rates by impulses sought, row by row, shape (sought, sought) \[1/kg\].
    pub(super) matrix: Vec<f64>,
    /// Rates that are missing, then the changes of the impulses sought, shape (sought) \[m/s, then N s\].
    pub(super) right: Vec<f64>,
    /// State of each contact, shape (contacts).
    pub(super) statuses: Vec<Status>,
    /// Rows of the impulses sought, shape (sought) \[index of a row\].
    pub(super) sought: Vec<usize>,
}

/// State of a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Status {
    Open,
    Sticks,
    /// Its tangential impulse is at its limit, the upper one for 1, the lower one for -1.
    Slides(f64),
}

/// Memory for the direct solution.
#[derive(Clone, Debug, Default)]
pub(super) struct Direct {
    pub(super) lemke: Lemke,
    /// The matrix of the complementarity problem, row by row, shape (unknowns, unknowns) \[-\].
    pub(super) matrix: Vec<f64>,
    /// Complementary variables for vanishing unknowns, shape (unknowns) \[kg^(1/2)\].
    pub(super) right: Vec<f64>,
    /// The unknowns found, shape (unknowns) \[kg^(1/2)\].
    pub(super) values: Vec<f64>,
    /// Kind of each unknown, shape (unknowns).
    pub(super) unknowns: Vec<Unknown>,
    /// `1 / sqrt(W)` of each row's diagonal, shape (2 contacts) \[kg^(1/2)\]; zero for rows without mobility or friction.
    pub(super) units: Vec<f64>,
    /// Impulses along normal and tangent, shape (2 contacts) \[N s\].
    pub(super) impulses: Vec<f64>,
}

/// An unknown of the complementarity problem, and its complementary variable.
#[derive(Clone, Copy, Debug)]
pub(super) enum Unknown {
    /// Impulse along the normal of a contact; rate of the gap above its bound.
    Normal(usize),
    /// Impulse along the tangent forwards (1) or backwards (-1); sliding rate that way above the least one.
    Tangent(usize, f64),
    /// Sliding speed; impulse that friction could still give.
    Speed(usize),
}
