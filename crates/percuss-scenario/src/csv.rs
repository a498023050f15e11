//! CSV files with two columns: points of a centre line, a function of time, a contact law.

use std::path::Path;

use serde_json::{Value as Json, json};

use crate::code::FaultCode;
use crate::files::{FileAccess, WITHIN, has_sha256, is_within, sha256};
use crate::format::{self, Format, Inline, List};
use crate::header::{self, Column, Units};
use crate::measure::{self, Length};
use crate::node::{Node, Reader, count};
use crate::quantity::Vector;
use crate::reach::Reached;

/// Two numbers and the line they stand on.
pub(crate) type Row = (usize, [f64; 2]);

/// Found and expected.
type Clash = (String, String);

/// What a file has.
pub(crate) struct Loaded {
    /// Its rows: the line of the file and two numbers, shape (rows, 2) \[SI\].
    pub rows: Vec<Row>,
    /// Its SHA-256.
    pub sum: String,
    /// Whether its second column holds its other quantity.
    pub other: bool,
}

/// Reads the file whose path stands at `node`; `sum` is the SHA-256 that it must have, if any is given.
///
/// Who names a file and its SHA-256 knows what is in it, so that such a file may lie anywhere: results that name a long table can be run
/// again where they are. Of one that differs nothing is reported, not even whether it is there.
pub(crate) fn load(
    node: &Node<'_>,
    sum: Option<&str>,
    columns: (&str, &[Column; 2]),
    reader: &mut Reader<'_>,
) -> Option<Loaded> {
    let name = node.value.as_str()?;
    reader.files += 1;
    let path = reader.folder.join(name);
    if reader.access == FileAccess::OwnFolder && !is_within(&reader.folder, name) {
        match sum {
            None => {
                let found = format!("{name:?}, which lies outside the folder of this file");
                reader.wrong_as(FaultCode::File, node, found, WITHIN);
                return None;
            }
            Some(sum) if !has_sha256(&path, sum) => {
                let found = format!(
                    "{name:?}, which lies outside the folder of this file and is not there with the content that `sha256` says"
                );
                let expected =
                    format!("the file as it was when its SHA-256 was {sum}; or {WITHIN}");
                reader.wrong_as(FaultCode::Checksum, node, found, expected);
                return None;
            }
            Some(_) => {}
        }
    }
    let wrong = |(found, expected)| reader.wrong_as(FaultCode::Table, node, found, expected);
    let loaded = read(&path, name, columns).map_err(wrong).ok()?;
    let is = &loaded.sum;
    if let Some(sum) = sum.filter(|sum| *sum != is) {
        let found = format!("{name:?}, which has changed: its SHA-256 is {is}");
        let expected = format!(
            "the file as it was when its SHA-256 was {sum} (`sha256`); leave `sha256` out to take the file as it is"
        );
        reader.wrong_as(FaultCode::Checksum, node, found, expected);
        return None;
    }
    Some(loaded)
}

fn read(path: &Path, name: &str, (both, columns): (&str, &[Column; 2])) -> Result<Loaded, Clash> {
    let expected = format!("a CSV file with two columns, {both}");
    let whole = |what: &str| Err((format!("{name:?}, {what}"), expected.clone()));
    if path.is_dir() {
        return whole("which is a directory");
    }
    if path.exists() && !path.is_file() {
        return whole("which is no regular file");
    }
    let bytes = match std::fs::read(path) {
        Ok(bytes) => bytes,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
            return whole("which does not exist");
        }
        Err(error) => return whole(&format!("which cannot be read ({error})")),
    };
    let sum = sha256(&bytes);
    let Ok(text) = String::from_utf8(bytes) else { return whole("which is not UTF-8") };
    let (rows, other) = parse(&text, columns).map_err(|(line, found)| {
        let more = match found.contains("header") {
            true => format!(
                "; a header names units, such as `time [ms]`, or is one of {} and one of {}",
                columns[0].known(),
                columns[1].known()
            ),
            false => String::new(),
        };
        (format!("{found} in line {line} of {name:?}"), format!("{expected}{more}"))
    })?;
    Ok(Loaded { rows, sum, other })
}

/// Rows of a text in SI, and whether their second column holds its other quantity; blank lines and those that begin with `#` are passed over, and
/// a header says in which units the rows are, behind a `#`, too, as programs write it (`numpy.savetxt`).
fn parse(text: &str, columns: &[Column; 2]) -> Result<(Vec<Row>, bool), (usize, String)> {
    let mut rows = Vec::new();
    let (mut header, mut units) = (true, Units::default());
    let mut remarks = Vec::new();
    for (i, line) in text.trim_start_matches('\u{feff}').lines().enumerate() {
        let line = line.trim();
        if line.is_empty() || line.starts_with('#') {
            if header && !line.is_empty() {
                remarks.push((i + 1, line.trim_start_matches('#').trim()));
            }
            continue;
        }
        let cells: Vec<&str> = cells(line);
        let first = std::mem::take(&mut header);
        let [a, b] = cells[..] else {
            return Err((i + 1, count(cells.len(), "column")));
        };
        if first && cells.iter().all(|c| c.parse::<f64>().is_err()) {
            units = header::units([a, b], columns).map_err(|found| (i + 1, found))?;
            continue;
        }
        if first {
            units = remarked(&remarks, columns)?;
        }
        let number = |cell: &str, k: usize| {
            let value = header::value(cell, units.of[k]);
            value.ok_or_else(|| (i + 1, format!("{}, which is no finite number,", shown(cell))))
        };
        rows.push((i + 1, [number(a, 0)?, number(b, 1)?]));
    }
    Ok((rows, units.other))
}

/// The header that stands behind a `#` in the last line above rows that have none of their own: as many words as they have numbers.
pub(crate) fn headed<'t>(
    lines: impl Iterator<Item = &'t str>,
    cells: impl Fn(&'t str) -> Vec<&'t str>,
) -> Option<Vec<&'t str>> {
    let mut remark = None;
    for line in lines.filter(|line| !line.is_empty()) {
        match line.strip_prefix('#') {
            Some(rest) => remark = Some(rest.trim_start_matches('#').trim()),
            None => {
                let is_number = |cell: &&str| cell.parse::<f64>().is_ok();
                let (row, header) = (cells(line), cells(remark?));
                let fits = row.len() == header.len() && !header.iter().any(|c| c.is_empty());
                let headed = row.iter().all(is_number) && !header.iter().any(is_number);
                return (fits && headed).then_some(header);
            }
        }
    }
    None
}

/// Most words of a column's name in a remark; what has more is prose.
const WORDS_OF_NAME: usize = 3;

/// Units by the last of the remarks above the rows that is a header; SI units if none is. One that is a header for one of the columns alone is at
/// fault: it says of the other what is not understood.
fn remarked<'h>(
    remarks: &[(usize, &'h str)],
    columns: &[Column; 2],
) -> Result<Units<'h>, (usize, String)> {
    for (line, remark) in remarks.iter().rev() {
        let [a, b] = cells(remark)[..] else { continue };
        if [a, b].iter().any(|c| c.is_empty() || c.parse::<f64>().is_ok()) {
            continue;
        }
        let found = match header::units([a, b], columns) {
            Ok(units) => return Ok(units),
            Err(found) => found,
        };
        let separated = remark.contains([';', '\t', ',']);
        let names = [a, b].iter().all(|c| c.split_whitespace().count() <= WORDS_OF_NAME);
        if separated && names && header::is_half([a, b], columns) {
            return Err((*line, found));
        }
    }
    Ok(Units::default())
}

/// A cell in a message: itself if it looks like a number, for the file may be none that its reader should see.
pub(crate) fn shown(cell: &str) -> String {
    let numeric = |c: char| c.is_ascii_digit() || "+-.,eE'_".contains(c);
    let named = ["nan", "inf", "infinity"].contains(&cell.to_lowercase().trim_matches(['+', '-']));
    match named || (cell.len() <= 30 && cell.chars().all(numeric)) {
        true => format!("{cell:?}"),
        false => "a text".into(),
    }
}

/// Between semicolons, tabs, commas or blanks, the first of these that the line has.
pub(crate) fn cells(line: &str) -> Vec<&str> {
    let separator = [';', '\t', ','].into_iter().find(|s| line.contains(*s));
    match separator {
        Some(separator) => line.split(separator).map(|c| c.trim().trim_matches('"')).collect(),
        None => words(line),
    }
}

/// Words of a line between spaces; a unit in brackets belongs to the word before it, as in `t [ms] F [kN]`.
fn words(line: &str) -> Vec<&str> {
    let mut out: Vec<&str> = Vec::new();
    let mut from = 0;
    for word in line.split_whitespace() {
        let at = from + line[from..].find(word).unwrap_or(0);
        from = at + word.len();
        match out.last_mut() {
            Some(last) if word.starts_with(['[', '(']) => {
                let start = line[..at].rfind(*last).unwrap_or(at);
                *last = &line[start..from];
            }
            _ => out.push(word),
        }
    }
    out
}

/// Columns of points.
const PLACES: [Column; 2] = [
    Column::of::<measure::Length>(&["x", "x1", "e1"]),
    Column::of::<measure::Length>(&["y", "z", "x2", "e2"]),
];

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
        let loaded = load(node, None, ("x and y (m)", &PLACES), reader)?;
        Some(loaded.rows.into_iter().map(|row| row.1).collect())
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
            [] => format::end::<Self>(value, path),
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::header::ACCELERATION;

    const RECORD: [Column; 2] = [
        Column::of::<measure::Time>(&["t", "time"]),
        Column::of::<measure::Ratio>(&["value", "factor"]).or(&ACCELERATION),
    ];

    /// The rows behind a text, and whether they are accelerations.
    fn read(above: &str) -> Result<([f64; 2], bool), (usize, String)> {
        let text = format!("{above}20,1\n40,0.5\n");
        parse(&text, &RECORD).map(|(rows, other)| (rows[0].1, other))
    }

    /// `numpy.savetxt` puts `# ` before its header, `pandas` nothing.
    #[test]
    fn a_header_counts_behind_a_hash_too() {
        for above in ["time (s),acceleration (g)\n", "# time (s),acceleration (g)\n"] {
            assert_eq!(read(above), Ok(([20.0, 9.80665], true)), "{above:?}");
        }
        for above in [
            "#time [ms];value\n",
            "# drop 3, tower 2\n# t_ms, factor\n",
            "# t_ms, factor\n# drop 3, tower 2\n",
            "# recorded on Monday\n# time [ms]\tfactor\n",
            "#\n# time (s), acceleration (g)\ntime [ms],factor\n",
        ] {
            assert_eq!(read(above), Ok(([0.02, 1.0], false)), "{above:?}");
        }
    }

    #[test]
    fn remarks_are_remarks() {
        for above in [
            "# recorded on Monday\n",
            "# tower 2, sensor 7\n",
            "# time history\n",
            "# time, counted from the trigger of the second recorder\n",
            "# 0,1\n",
            "",
        ] {
            assert_eq!(read(above), Ok(([20.0, 1.0], false)), "{above:?}");
        }
    }

    /// What one column of a header holds is known, and of the other it is not: no number is taken as something else.
    #[test]
    fn half_a_header_behind_a_hash_is_refused() {
        for above in ["# time (s),acceleration (gal)\n", "# time (s), force (kN)\n", "# t,a1\n"] {
            let refused = read(above).unwrap_err();
            assert_eq!(refused.0, 1, "{above:?}: {refused:?}");
        }
    }
}
