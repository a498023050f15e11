//! Values from a CSV file with two columns: points of a centre line, a function of time, a contact law.

use std::marker::PhantomData;

use serde_json::{Value as Json, json};

use crate::code::FaultCode;
use crate::files::{FileAccess, is_within};
use crate::format::{Format, Inline, List};
use crate::measure::Length;
use crate::node::{Body, Node, Reader, count};
use crate::quantity::Vector;
use crate::reach::{self, Reached};

/// Two numbers and the line they stand on.
type Row = (usize, [f64; 2]);

/// Found and expected.
type Clash = (String, String);

/// Reads the file whose path stands at `node`.
fn load(node: &Node<'_>, columns: &str, reader: &mut Reader<'_>) -> Option<Vec<Row>> {
    let name = node.value.as_str()?;
    reader.files += 1;
    if reader.access == FileAccess::OwnFolder && !is_within(&reader.folder, name) {
        let found = format!("{name:?}, which lies outside the folder of this file");
        let expected = "a file in that folder or below; others are read only where that is allowed (--allow-outside, allow_outside=True)";
        reader.wrong_as(FaultCode::File, node, found, expected);
        return None;
    }
    let rows = read(&reader.folder.join(name), name, columns);
    rows.map_err(|(found, expected)| reader.wrong_as(FaultCode::Table, node, found, expected)).ok()
}

fn read(path: &std::path::Path, name: &str, columns: &str) -> Result<Vec<Row>, Clash> {
    let expected = format!("a CSV file with two columns, {columns}");
    let whole = |what: &str| Err((format!("{name:?}, {what}"), expected.clone()));
    if path.is_dir() {
        return whole("which is a directory");
    }
    if path.exists() && !path.is_file() {
        return whole("which is no regular file");
    }
    let text = match std::fs::read(path).map(String::from_utf8) {
        Ok(Ok(text)) => text,
        Ok(Err(_)) => return whole("which is not UTF-8"),
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
            return whole("which does not exist");
        }
        Err(error) => return whole(&format!("which cannot be read ({error})")),
    };
    parse(&text).map_err(|(line, found)| (format!("{found} in line {line} of {name:?}"), expected))
}

/// Rows of a text; blank lines and those that begin with `#` are passed over, as is a header.
fn parse(text: &str) -> Result<Vec<Row>, (usize, String)> {
    let mut rows = Vec::new();
    let mut header = true;
    for (i, line) in text.trim_start_matches('\u{feff}').lines().enumerate() {
        let line = line.trim();
        if line.is_empty() || line.starts_with('#') {
            continue;
        }
        let cells: Vec<&str> = cells(line);
        let first = std::mem::take(&mut header);
        if first && cells.iter().all(|c| c.parse::<f64>().is_err()) {
            continue;
        }
        let [a, b] = cells[..] else {
            return Err((i + 1, count(cells.len(), "column")));
        };
        let number = |cell: &str| {
            let value = cell.parse().ok().filter(|v: &f64| v.is_finite());
            value.ok_or_else(|| (i + 1, format!("{}, which is no finite number,", shown(cell))))
        };
        rows.push((i + 1, [number(a)?, number(b)?]));
    }
    Ok(rows)
}

/// A cell in a message: itself if it looks like a number, for the file may be none that its reader should see.
fn shown(cell: &str) -> String {
    let numeric = |c: char| c.is_ascii_digit() || "+-.,eE'_".contains(c);
    let named = ["nan", "inf", "infinity"].contains(&cell.to_lowercase().trim_matches(['+', '-']));
    match named || (cell.len() <= 30 && cell.chars().all(numeric)) {
        true => format!("{cell:?}"),
        false => "a text".into(),
    }
}

/// Between semicolons, tabs, commas or blanks, the first of these that the line has.
fn cells(line: &str) -> Vec<&str> {
    let separator = [';', '\t', ','].into_iter().find(|s| line.contains(*s));
    match separator {
        Some(separator) => line.split(separator).map(|c| c.trim().trim_matches('"')).collect(),
        None => line.split_whitespace().collect(),
    }
}

/// Points as a list, or the path of a file that lists them.
pub(crate) struct Points;

type Listed = List<Vector<Length>>;

impl Format for Points {
    type Value = Vec<[f64; 2]>;

    fn read(node: &Node<'_>, reader: &mut Reader<'_>) -> Option<Self::Value> {
        if node.value.as_str().is_none() {
            if node.elements().is_none() {
                reader.wrong(node, node.found(), Self::expected());
                return None;
            }
            return Listed::read(node, reader);
        }
        let rows = load(node, "x and y (m)", reader)?;
        Some(rows.into_iter().map(|row| row.1).collect())
    }

    fn placeholder() -> Self::Value {
        Listed::placeholder()
    }

    fn expected() -> String {
        format!("{}; or the path of a CSV file", Listed::expected())
    }

    fn schema() -> Json {
        json!({ "anyOf": [{ "type": "string" }, Listed::schema()] })
    }

    fn reach<'c>(value: &'c mut Self::Value, path: &[String]) -> Reached<'c> {
        match path {
            [] => reach::end::<Self>(value, path),
            _ => Listed::reach(value, path),
        }
    }
}

impl Inline for Points {
    const UNIT: &'static str = Listed::UNIT;

    fn text(value: &Self::Value) -> Option<String> {
        Listed::text(value)
    }
}

/// What the columns of a file hold.
pub(crate) trait Columns: 'static {
    /// Both.
    const BOTH: &'static str;
    /// The first, whose values increase, and its unit.
    const FIRST: (&'static str, &'static str);
}

/// A function of time.
pub(crate) struct Pulse;

impl Columns for Pulse {
    const BOTH: &'static str = "time (s) and value";
    const FIRST: (&'static str, &'static str) = ("times", "s");
}

/// A contact law.
pub(crate) struct Characteristic;

impl Columns for Characteristic {
    const BOTH: &'static str = "penetration (m) and force (N)";
    const FIRST: (&'static str, &'static str) = ("penetrations", "m");
}

/// Two columns from a file; they are written out as lists, never as a file again.
pub(crate) struct File<C>(PhantomData<C>);

impl<C: Columns> Format for File<C> {
    type Value = [Vec<f64>; 2];

    fn read(node: &Node<'_>, reader: &mut Reader<'_>) -> Option<Self::Value> {
        if node.value.as_str().is_none() {
            reader.wrong(node, node.found(), Self::expected());
        }
        let rows = load(node, C::BOTH, reader)?;
        let name = node.value.as_str().unwrap_or_default();
        if rows.len() < 2 {
            let found = format!("{name:?} with {}", count(rows.len(), "row"));
            reader.wrong_as(FaultCode::Table, node, found, "at least two rows");
            return None;
        }
        let fallen = rows.windows(2).find(|pair| pair[1].1[0] <= pair[0].1[0]);
        if let Some([(_, before), (line, after)]) = fallen {
            let (what, unit) = C::FIRST;
            let found = format!(
                "{} {unit} after {} {unit} in line {line} of {name:?}",
                after[0], before[0]
            );
            reader.wrong_as(
                FaultCode::Table,
                node,
                found,
                format!("{what} that increase from row to row"),
            );
            return None;
        }
        Some([0, 1].map(|column| rows.iter().map(|row| row.1[column]).collect()))
    }

    fn placeholder() -> Self::Value {
        [vec![0.0, 1.0], vec![1.0, 1.0]]
    }

    fn expected() -> String {
        format!("the path of a CSV file with two columns, {}", C::BOTH)
    }

    fn schema() -> Json {
        json!({ "type": "string" })
    }
}

impl<C: Columns> Inline for File<C> {
    fn text(_: &Self::Value) -> Option<String> {
        None
    }
}

/// Rows come from the key `file` or from two lists, not from both; those of a file move into the lists.
pub(crate) fn settle(
    file: &mut Option<[Vec<f64>; 2]>,
    lists: [(&str, &mut Option<Vec<f64>>); 2],
    body: &Body<'_>,
    reader: &mut Reader<'_>,
) {
    let node = body.get("file");
    let both = format!("`{}` and `{}`", lists[0].0, lists[1].0);
    let mut columns = file.take().into_iter().flatten();
    for (key, list) in lists {
        if let Some(column) = columns.next() {
            *list = Some(column);
        }
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
}
