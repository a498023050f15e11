//! The largest value of a quantity, and when.

use serde::{Deserialize, Serialize};

/// A largest value and when it occurred.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Peak {
    /// The value of largest magnitude, signed.
    pub value: f64,
    /// Its time \[s\].
    pub time: f64,
}

impl Default for Peak {
    fn default() -> Self {
        Self { value: f64::NAN, time: f64::NAN }
    }
}
