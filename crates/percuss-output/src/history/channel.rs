//! Channels of a history, its rows in memory, and the files it stands in.

/// Parquet file of a history.
pub(crate) const PARQUET: &str = "history.parquet";

/// CSV file of a history.
pub(crate) const CSV: &str = "history.csv";

/// Units and descriptions beside the CSV file.
pub(crate) const CSV_UNITS: &str = "history.units.json";

/// A column of a history that was read back.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Channel {
    /// Name in the form `<kind>.<name>.<quantity>`.
    pub name: String,
    /// Unit in plain ASCII.
    pub unit: String,
    /// One sentence that says what the column holds.
    pub description: String,
}

impl From<&percuss::Channel> for Channel {
    fn from(channel: &percuss::Channel) -> Self {
        Self {
            name: channel.name.clone(),
            unit: channel.unit.to_owned(),
            description: channel.description.clone(),
        }
    }
}

/// A history in memory.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct History {
    /// The columns' names and units, shape (channels).
    pub channels: Vec<Channel>,
    /// Values, shape (n_channels, n_rows) \[unit of the channel\], column by column.
    pub columns: Vec<Vec<f64>>,
    /// Name of the file it was read from; empty if it never was in one.
    pub source: String,
}

impl History {
    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.columns.first().map_or(0, Vec::len)
    }

    /// The column called `name`, if there is one.
    pub fn column(&self, name: &str) -> Option<&[f64]> {
        let k = self.channels.iter().position(|c| c.name == name)?;
        self.columns.get(k).map(Vec::as_slice)
    }
}

impl From<&percuss::MemoryRecorder> for History {
    fn from(recorder: &percuss::MemoryRecorder) -> Self {
        let n = recorder.channels.len();
        let column = |k| recorder.values.iter().skip(k).step_by(n.max(1)).copied().collect();
        Self {
            channels: recorder.channels.iter().map(Channel::from).collect(),
            columns: (0..n).map(column).collect(),
            source: String::new(),
        }
    }
}
