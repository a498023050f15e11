//! A scenario: its content and the file it came from.

use std::collections::BTreeSet;
use std::sync::Arc;

use crate::content::{Content, ProjectileKind};
use crate::given::Given;
use crate::source::{Places, Source};
use crate::table::to_toml;

/// A scenario without reading faults, with every default filled in.
#[derive(Clone, Debug)]
pub struct Scenario {
    pub(crate) content: Content,
    pub(crate) source: Arc<Source>,
    pub(crate) places: Arc<Places>,
    pub(crate) given: Arc<Given>,
    /// Whether the file names others, such as tables of values.
    pub(crate) names_files: bool,
    /// Paths of the keys that name files of accelerations.
    pub(crate) accelerations: Arc<BTreeSet<String>>,
}

impl Scenario {
    /// What the file contains.
    pub fn content(&self) -> &Content {
        &self.content
    }

    /// The scenario as a file with every default written out, in SI units.
    pub fn to_toml(&self) -> String {
        to_toml(&self.content)
    }

    /// The same scenario with functions for the places where it says `"given"`.
    pub fn with_given(mut self, given: Given) -> Self {
        self.given = Arc::new(given);
        self
    }

    /// The same scenario with another coefficient of restitution for every rigid projectile.
    pub fn with_restitution(&self, coefficient: f64) -> Self {
        let mut other = self.clone();
        for projectile in &mut other.content.projectile {
            if let ProjectileKind::Rigid { restitution } = &mut projectile.table.kind {
                *restitution = coefficient;
            }
        }
        other
    }
}
