//! Pattern of a sparse matrix by columns.

/// Columns of ascending rows.
#[derive(Clone, Debug, Default)]
pub(super) struct ColumnPattern {
    /// Start of each column in `rows`, and end of the last one, shape (columns + 1) \[number of entries\].
    pub(super) starts: Vec<usize>,
    /// Rows of the entries, column by column, shape (entries) \[index of a row\].
    pub(super) rows: Vec<usize>,
}

impl ColumnPattern {
    pub(super) fn of(columns: &[Vec<usize>]) -> Self {
        let (mut starts, mut rows) = (vec![0], Vec::new());
        for column in columns {
            rows.extend_from_slice(column);
            starts.push(rows.len());
        }
        Self { starts, rows }
    }

    pub(super) fn range(&self, column: usize) -> std::ops::Range<usize> {
        self.starts[column]..self.starts[column + 1]
    }
}
