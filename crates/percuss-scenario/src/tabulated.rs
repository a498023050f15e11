//! Two columns from a file of their own, or from lists.
//!
//! Those of a short file become lists, so that a scenario that is written needs no other file. A long one stays where it is: what is
//! written then names it, with the SHA-256 that tells whether it is still the same.

use std::marker::PhantomData;

use serde_json::{Value as Json, json};

use crate::code::FaultCode;
use crate::csv::{Loaded, Row, load};
use crate::format::{Format, Inline};
use crate::header::{ACCELERATION, Column};
use crate::measure;
use crate::node::{Body, Node, Reader, count};
use crate::write;

/// What the columns of a file hold.
pub(crate) trait Columns: 'static {
    /// Both.
    const BOTH: &'static str;
    /// The first, whose values increase, and its unit.
    const FIRST: (&'static str, &'static str);
    /// What headers say of them.
    const OF: [Column; 2];
    /// Both where the second column may hold accelerations instead.
    const ACCELERATED: &'static str = Self::BOTH;
}

/// A function of time.
pub(crate) struct Pulse;

impl Columns for Pulse {
    const BOTH: &'static str = "time (s) and value";
    const ACCELERATED: &'static str = "time (s) and value or acceleration (m/s^2)";
    const FIRST: (&'static str, &'static str) = ("times", "s");
    const OF: [Column; 2] = [
        Column::of::<measure::Time>(&["t", "time", "times"]),
        Column::of::<measure::Ratio>(&["value", "values", "factor", "factors", "ratio", "y", "f"]),
    ];
}

/// A contact law.
pub(crate) struct Characteristic;

impl Columns for Characteristic {
    const BOTH: &'static str = "penetration (m) and force (N)";
    const FIRST: (&'static str, &'static str) = ("penetrations", "m");
    const OF: [Column; 2] = [
        Column::of::<measure::Length>(&["penetration", "penetrations", "p", "displacement", "x"]),
        Column::of::<measure::Force>(&["force", "forces", "f", "load"]),
    ];
}

/// A long table in a file of its own.
#[derive(Clone, Debug, PartialEq)]
pub struct TableFile {
    /// Its absolute path, links followed; as given while it has not been read.
    pub path: String,
    /// Its columns, in SI units; empty while it has not been read, shape (2, rows) \[SI unit of the column\].
    pub columns: [Vec<f64>; 2],
}

/// The path of a file with two columns.
pub(crate) struct File<C>(PhantomData<C>);

impl<C: Columns> Format for File<C> {
    type Value = TableFile;

    fn read(node: &Node<'_>, reader: &mut Reader<'_>) -> Option<Self::Value> {
        let path = node.value.as_str().map(str::to_owned);
        if path.is_none() {
            reader.wrong(node, node.found(), Self::expected());
        }
        Some(TableFile { path: path?, columns: [Vec::new(), Vec::new()] })
    }

    fn placeholder() -> Self::Value {
        TableFile { path: String::new(), columns: [vec![0.0, 1.0], vec![1.0, 1.0]] }
    }

    fn expected() -> String {
        format!("the path of a CSV file with two columns, {}", C::BOTH)
    }

    fn schema() -> Json {
        json!({ "type": "string" })
    }
}

impl<C: Columns> Inline for File<C> {
    fn text(value: &Self::Value) -> Option<String> {
        Some(write::text(&value.path))
    }
}

/// A SHA-256 in hexadecimal digits.
pub(crate) struct Sum;

impl Format for Sum {
    type Value = String;

    fn read(node: &Node<'_>, reader: &mut Reader<'_>) -> Option<String> {
        let is_sum = |text: &&str| text.len() == 64 && text.chars().all(|c| c.is_ascii_hexdigit());
        let sum = node.value.as_str().filter(is_sum).map(str::to_ascii_lowercase);
        if sum.is_none() {
            reader.wrong(node, node.found(), Self::expected());
        }
        sum
    }

    fn placeholder() -> String {
        String::new()
    }

    fn expected() -> String {
        "the SHA-256 of the file, 64 hexadecimal digits, as `sha256sum FILE` prints it".into()
    }

    fn schema() -> Json {
        json!({ "type": "string", "pattern": "^[0-9a-fA-F]{64}$" })
    }
}

impl Inline for Sum {
    fn text(value: &String) -> Option<String> {
        Some(write::text(value))
    }
}

/// Where the columns of a table come from.
pub(crate) struct Given<'t> {
    pub file: &'t mut Option<TableFile>,
    pub sum: &'t mut Option<String>,
    /// Names and values of the lists, shape (2, rows) \[SI unit of the list\].
    pub lists: [(&'static str, &'t mut Option<Vec<f64>>); 2],
}

/// Columns come from the key `file` or from two lists, not from both. The file is read here; a short one moves into the lists.
pub(crate) fn settle<C: Columns>(given: Given<'_>, body: &Body<'_>, reader: &mut Reader<'_>) {
    let Given { file, sum, lists } = given;
    let node = body.get("file");
    let both = format!("`{}` and `{}`", lists[0].0, lists[1].0);
    for (key, _) in &lists {
        match (&node, body.get(key)) {
            (Some(_), Some(given)) => {
                let found = format!("`{key}` besides `file`");
                reader.misplaced(&given.path, given.span, found, format!("`file`, or {both}"));
            }
            (None, None) if !reader.excuses(body, "file") => {
                reader.missing(body, key, format!("no `{key}`"), format!("{both}, or `file`"));
            }
            _ => {}
        }
    }
    if let (None, Some(given)) = (&node, body.get("sha256")) {
        let found = "`sha256` without `file`";
        reader.misplaced(&given.path, given.span, found, "the path of the file, or no `sha256`");
    }
    // Of a sum that could not be read enough has been reported.
    let unread = body.get("sha256").is_some() && sum.is_none();
    let (Some(node), Some(named), false) = (&node, file.take(), unread) else { return };
    let accelerates = reader.base_functions.contains(&body.path);
    let sum_given = sum.take();
    let Some((columns, is)) = columns::<C>(node, sum_given.as_deref(), accelerates, reader) else {
        reader.tainted.insert(node.path.clone());
        return;
    };
    let whole = reader.folder.join(&named.path).canonicalize();
    let path = whole.ok().and_then(|path| path.into_os_string().into_string().ok());
    match path.filter(|_| columns[0].len() > reader.most_rows) {
        Some(path) => {
            *file = Some(TableFile { path, columns });
            *sum = Some(is);
        }
        None => {
            for ((_, list), column) in lists.into_iter().zip(columns) {
                *list = Some(column);
            }
        }
    }
}

/// Both columns of the file at `node`, and its SHA-256. A file whose second column holds accelerations, where it may, is noted.
fn columns<C: Columns>(
    node: &Node<'_>,
    sum: Option<&str>,
    accelerates: bool,
    reader: &mut Reader<'_>,
) -> Option<([Vec<f64>; 2], String)> {
    let [first, second] = C::OF;
    let of = match accelerates {
        true => (C::ACCELERATED, &[first, second.or(&ACCELERATION)]),
        false => (C::BOTH, &[first, second]),
    };
    let Loaded { rows, sum: is, other } = load(node, sum, of, reader)?;
    if other {
        reader.accelerations.insert(node.path.clone());
    }
    let name = node.value.as_str().unwrap_or_default();
    if rows.len() < 2 {
        let found = format!("{name:?} with {}", count(rows.len(), "row"));
        reader.wrong_as(FaultCode::Table, node, found, "at least two rows");
        return None;
    }
    if let Some((line, [before, after])) = fallen(&rows) {
        let (what, unit) = C::FIRST;
        let found = format!("{after} {unit} after {before} {unit} in line {line} of {name:?}");
        let expected = format!("{what} that increase from row to row");
        reader.wrong_as(FaultCode::Table, node, found, expected);
        return None;
    }
    let column = |k: usize| rows.iter().map(|row| row.1[k]).collect();
    Some(([column(0), column(1)], is))
}

/// The first line whose first value is not above that of the row before, with both.
fn fallen(rows: &[Row]) -> Option<(usize, [f64; 2])> {
    let pair = rows.windows(2).find(|pair| pair[1].1[0] <= pair[0].1[0])?;
    Some((pair[1].0, [pair[0].1[0], pair[1].1[0]]))
}
