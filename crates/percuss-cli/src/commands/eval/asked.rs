//! What is asked of a study, and how it is answered.

/// What is asked of the study.
pub(super) struct Asked {
    /// Names and values of the variables, shape (variables) \[unit of the variable\].
    pub(super) variables: Vec<(String, f64)>,
    /// The functions, in the order in which they are answered; none for all results of the study, shape (functions).
    pub(super) functions: Option<Vec<Wanted>>,
    /// By which variables derivatives are wanted; none for all of them, shape (variables).
    pub(super) by: Option<Vec<String>>,
}

/// A function that is asked for.
pub(super) struct Wanted {
    pub(super) name: String,
    pub(super) value: bool,
    pub(super) gradient: bool,
}

/// A function as it is answered.
pub(super) struct Answered {
    pub(super) name: String,
    pub(super) value: Option<f64>,
    /// Derivatives by the variables asked for, with their names, shape (variables) \[unit of the function by that of the variable\].
    pub(super) gradient: Option<Vec<(String, f64)>>,
    /// How the gradient was found: `exact`, or `differences: ` and why.
    pub(super) means: Option<String>,
    /// Whether a contact that is still closed at the end of the run leaves the value open.
    pub(super) open: bool,
}
