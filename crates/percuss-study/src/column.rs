//! Tables by columns.

/// What a column of a study says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// The number of the run.
    Run,
    /// The value of a parameter.
    Input,
    /// A result.
    Result,
    /// How the run ended: `completed`, `failed` (no convergence) or `invalid` (the scenario has faults).
    Status,
    /// Why it did not end well; empty if it did.
    Reason,
    /// Balance errors of the run, and its cost.
    Audit,
    /// What a result has come to where a contact that is still closed at the end leaves it open: the least value of a duration or force, a
    /// velocity that is not yet the one after it; NaN in all other runs.
    Open,
}

/// What stands in a column.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// Whole numbers, shape (runs) \[-\].
    Whole(Vec<i64>),
    /// Numbers; NaN where a run has none, shape (runs) \[SI unit of the column\].
    Number(Vec<f64>),
    /// Texts, shape (runs).
    Text(Vec<String>),
}

/// A column without its values.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Column {
    /// Its name.
    pub name: String,
    /// Unit, `1` for a pure number.
    pub unit: String,
    /// What it says.
    pub role: Role,
    /// Where it comes from: a path in the scenario or the summary.
    pub about: String,
}

/// Rows of a study, a column at a time.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// The columns, shape (columns).
    pub columns: Vec<Column>,
    /// Their values, one entry a column, shape (columns).
    pub values: Vec<Values>,
}

impl Role {
    /// Its name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Run => "run",
            Self::Input => "input",
            Self::Result => "result",
            Self::Status => "status",
            Self::Reason => "reason",
            Self::Audit => "audit",
            Self::Open => "open",
        }
    }
}

impl Values {
    /// Number of rows.
    pub fn len(&self) -> usize {
        match self {
            Self::Whole(values) => values.len(),
            Self::Number(values) => values.len(),
            Self::Text(values) => values.len(),
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// An empty column of the same kind.
    pub(crate) fn like(&self) -> Self {
        match self {
            Self::Whole(_) => Self::Whole(Vec::new()),
            Self::Number(_) => Self::Number(Vec::new()),
            Self::Text(_) => Self::Text(Vec::new()),
        }
    }

    /// Appends the rows of another column of the same kind.
    pub(crate) fn append(&mut self, other: Self) {
        match (self, other) {
            (Self::Whole(own), Self::Whole(mut more)) => own.append(&mut more),
            (Self::Number(own), Self::Number(mut more)) => own.append(&mut more),
            (Self::Text(own), Self::Text(mut more)) => own.append(&mut more),
            _ => debug_assert!(false, "columns of different kinds"),
        }
    }
}

impl Table {
    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.values.first().map_or(0, Values::len)
    }

    /// Numbers of a column; `None` if there is none of that name or it holds texts.
    pub fn numbers(&self, name: &str) -> Option<Vec<f64>> {
        match self.column(name)? {
            Values::Number(values) => Some(values.clone()),
            Values::Whole(values) => Some(values.iter().map(|v| *v as f64).collect()),
            Values::Text(_) => None,
        }
    }

    /// Texts of a column; `None` if there is none of that name or it holds numbers.
    pub fn texts(&self, name: &str) -> Option<&[String]> {
        match self.column(name)? {
            Values::Text(values) => Some(values),
            _ => None,
        }
    }

    fn column(&self, name: &str) -> Option<&Values> {
        let at = self.columns.iter().position(|column| column.name == name)?;
        self.values.get(at)
    }
}
