//! What derivatives are of, and by.

/// A parameter, where it stands.
#[derive(Clone, Debug, PartialEq)]
pub struct Differentiated {
    /// Path of the parameter, or of the result in the summary.
    pub path: String,
    /// Value.
    pub value: f64,
    /// SI unit, empty or `1` for a pure number.
    pub unit: String,
}
