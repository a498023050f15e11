//! Values of a scenario by their paths: `projectile.mass.velocity[1]`.
//!
//! The declarations that read a file also lead to its values, so a value set here passes the reader the file's own value would.

use crate::node::{Node, Reader};
use crate::stray::Stray;
use crate::suggest;

/// What stands at the end of a path.
pub(crate) trait Slot {
    /// SI unit of the number that stands here, empty for a pure number; `None` where no number stands.
    fn unit(&self) -> Option<&'static str>;
    /// The number that stands here.
    fn number(&self) -> Option<f64>;
    /// Puts a number here, in SI units.
    ///
    /// # Errors
    /// What would be right.
    fn set(&mut self, number: f64) -> Result<(), String>;
    /// Puts here what a file says; faults are reported to the reader.
    fn read(&mut self, node: &Node<'_>, reader: &mut Reader<'_>) -> bool;
}

/// Why a path leads nowhere.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Lost {
    /// So many steps were right, the next one is not known.
    Unknown {
        /// Steps that were right.
        depth: usize,
        /// The next one, in words.
        found: String,
        /// Steps that would be right, shape (steps).
        known: Vec<String>,
    },
    /// The file lacks the name or the entry.
    Missing(Stray),
    /// The path ends at a table.
    Table,
    /// The value decides what else stands in its table, or its table is not in the file: the file has to be read again.
    Reread,
}

/// A value, or why there is none.
pub(crate) type Reached<'c> = Result<Box<dyn Slot + 'c>, Lost>;

impl Lost {
    /// An unknown key.
    pub fn key(key: &str, known: impl IntoIterator<Item = impl Into<String>>) -> Self {
        let known = known.into_iter().map(Into::into).collect();
        Self::Unknown { depth: 0, found: format!("the unknown key `{key}`"), known }
    }

    /// A step behind something that has nothing behind it.
    pub fn behind(step: &str) -> Self {
        let found = format!("`{step}` behind a value that has no parts");
        Self::Unknown { depth: 0, found, known: Vec::new() }
    }

    /// Seen from one step further out.
    pub fn deeper(self) -> Self {
        match self {
            Self::Unknown { depth, found, known } => {
                Self::Unknown { depth: depth + 1, found, known }
            }
            other => other,
        }
    }

    /// What would be right for the step `word`.
    pub fn expected(known: &[String], word: &str) -> String {
        suggest::one_of(word, known.iter().map(String::as_str))
    }
}

/// The entry of a list that the path leads to, and the rest of the path.
pub(crate) fn entry<'c, 'p, T>(
    list: &'c mut [T],
    path: &'p [String],
) -> Result<(&'c mut T, &'p [String]), Lost> {
    let Some((step, rest)) = path.split_first() else { return Err(Lost::Table) };
    let count = list.len();
    let at = step.parse().ok().and_then(|i: usize| list.get_mut(i));
    at.map(|value| (value, rest)).ok_or_else(|| Lost::Missing(Stray::entry(step, count)))
}
