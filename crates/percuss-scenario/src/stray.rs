//! Why a path leads nowhere.

use crate::suggest;

/// What was found instead of a path that leads somewhere, and what would be right.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Stray {
    pub found: String,
    pub expected: String,
}

impl Stray {
    pub fn new(found: impl Into<String>, expected: impl Into<String>) -> Self {
        Self { found: found.into(), expected: expected.into() }
    }

    /// A table without a name that the path has.
    pub fn name<'n>(name: &str, known: impl Iterator<Item = &'n str> + Clone) -> Self {
        Self::new(format!("the unknown name `{name}`"), suggest::one_of(name, known))
    }

    /// An entry beyond the end of a list.
    pub fn entry(step: &str, count: usize) -> Self {
        let expected = match count {
            0 => "a list with entries".to_owned(),
            _ => format!("an entry from 0 to {}", count - 1),
        };
        Self::new(format!("the entry `{step}` of a list of {count}"), expected)
    }
}
