//! Points of a study from a CSV file: a column for each parameter, a row for each run.

use std::path::Path;

use super::content::{Design, Parameter, StudyContent};
use super::given::Given;
use crate::code::FaultCode;
use crate::csv::headed;
use crate::files::{FileAccess, WITHIN, is_within, read_bytes};
use crate::suggest::one_of;
use crate::table::{Named, is_name};

/// What is wrong with a file of points.
pub(super) struct Unread {
    pub code: FaultCode,
    pub found: String,
    pub expected: String,
}

/// Makes the columns of the file of `[design] kind = "points"` the values of the parameters; the study then needs no file.
///
/// # Errors
/// Why it cannot be read, or which column or parameter has no partner.
pub(super) fn take_in(
    content: &mut StudyContent,
    folder: &Path,
    access: FileAccess,
) -> Result<(), Unread> {
    let Design::Points { file } = &mut content.design else { return Ok(()) };
    let Some(name) = file.take() else { return Ok(()) };
    let wrong = |found: String, expected: &str| Unread {
        code: FaultCode::Table,
        found,
        expected: expected.to_owned(),
    };
    if access == FileAccess::OwnFolder && !is_within(folder, &name) {
        let found = format!("{name:?}, which lies outside the folder of this file");
        return Err(Unread { code: FaultCode::File, ..wrong(found, WITHIN) });
    }
    let expected =
        "a CSV file: a header with the names or paths of the parameters, and a row for each run";
    let bytes = read_bytes(&folder.join(&name))
        .map_err(|error| wrong(format!("{name:?}, which cannot be read ({error})"), expected))?;
    let Ok(text) = String::from_utf8(bytes) else {
        return Err(wrong(format!("{name:?}, which is not UTF-8"), expected));
    };
    let columns = columns(&text)
        .map_err(|(line, found)| wrong(format!("{found} in line {line} of {name:?}"), expected))?;
    assign(&mut content.parameter, columns)
        .map_err(|(found, expected)| wrong(format!("{found} in {name:?}"), &expected))
}

/// A column: its header without the unit, and its values.
struct Column {
    header: String,
    /// Values, shape (points).
    values: Vec<Given>,
}

/// The columns of a text; else a line and what was found there.
fn columns(text: &str) -> Result<Vec<Column>, (usize, String)> {
    let lines = text.trim_start_matches('\u{feff}').lines().map(str::trim).enumerate();
    let separator = |line: &str| [';', '\t', ','].into_iter().find(|s| line.contains(*s));
    let remark = headed(lines.clone().map(|(_, line)| line), |line| split(line, separator(line)));
    let mut lines = lines.filter(|(_, line)| !line.is_empty() && !line.starts_with('#'));
    let mut rows = lines.clone();
    let Some((at, line)) = rows.next() else { return Err((1, "no header".into())) };
    let separator = separator(line);
    let header = match remark {
        Some(header) => header,
        None => {
            lines = rows;
            split(line, separator)
        }
    };
    if header.iter().any(|cell| cell.is_empty() || cell.parse::<f64>().is_ok()) {
        return Err((at + 1, "no header".into()));
    }
    let (mut columns, units): (Vec<Column>, Vec<Option<&str>>) = header
        .iter()
        .map(|cell| {
            let (name, unit) = named(cell);
            (Column { header: name.to_owned(), values: Vec::new() }, unit)
        })
        .unzip();
    for (at, line) in lines {
        let row = split(line, separator);
        if row.len() != columns.len() {
            let found = format!("{} cells for {} columns", row.len(), columns.len());
            return Err((at + 1, found));
        }
        for ((column, unit), cell) in columns.iter_mut().zip(&units).zip(row) {
            column.values.push(given(cell, *unit));
        }
    }
    match columns[0].values.is_empty() {
        true => Err((at + 1, "a header without rows".into())),
        false => Ok(columns),
    }
}

/// The cells of a line. Blanks separate nothing, for values may have some in them: `20 m/s`.
fn split(line: &str, separator: Option<char>) -> Vec<&str> {
    let cells: Vec<&str> = match separator {
        Some(separator) => line.split(separator).collect(),
        None => vec![line],
    };
    cells.into_iter().map(|cell| cell.trim().trim_matches('"')).collect()
}

/// Name and unit of a header: `mass [kg]`, and no unit in `projectile.mass.velocity[1]`.
fn named(header: &str) -> (&str, Option<&str>) {
    match header.strip_suffix(']').and_then(|rest| rest.rsplit_once(" [")) {
        Some((name, unit)) => (name.trim(), Some(unit.trim())),
        None => (header, None),
    }
}

/// A cell as TOML; an empty one is a run without this number.
fn given(cell: &str, unit: Option<&str>) -> Given {
    let unit = unit.filter(|unit| !["", "-", "1"].contains(unit));
    let number = if cell.is_empty() { Some(f64::NAN) } else { cell.parse::<f64>().ok() };
    let toml = match (number, unit) {
        (Some(number), _) if number.is_nan() => "nan".to_owned(),
        (Some(number), None) => format!("{number:?}"),
        (Some(number), Some(unit)) => format!("\"{number:?} {unit}\""),
        (None, _) if ["true", "false"].contains(&cell) => cell.to_owned(),
        (None, _) => serde_json::Value::from(cell).to_string(),
    };
    Given { toml }
}

/// Gives each parameter the column that has its name or path; a column with another path makes a parameter.
fn assign(
    parameters: &mut Vec<Named<Parameter>>,
    columns: Vec<Column>,
) -> Result<(), (String, String)> {
    let declared = parameters.len();
    let mut taken = vec![false; declared];
    for Column { header, values } in columns {
        let own = |p: &Named<Parameter>| p.name == header || p.table.path == header;
        match parameters.iter().position(own) {
            Some(at) if at >= declared || taken[at] => {
                return Err((
                    format!("a second column {header:?}"),
                    "one column for each parameter".into(),
                ));
            }
            Some(at) => {
                taken[at] = true;
                let table = &mut parameters[at].table;
                *table = Parameter { path: std::mem::take(&mut table.path), ..listed(values) };
            }
            None if header.contains('.') => {
                let table = Parameter { path: header.clone(), ..listed(values) };
                parameters.push(Named { name: name_of(&header), table });
            }
            None => {
                let path = "the path of a value, such as `projectile.mass.mass`";
                let known = parameters.iter().map(|p| p.name.as_str());
                let expected = match declared {
                    0 => path.to_owned(),
                    _ => format!("the name of a parameter, {}, or {path}", one_of(&header, known)),
                };
                return Err((format!("the column {header:?}"), expected));
            }
        }
    }
    match taken.iter().position(|taken| !taken) {
        Some(at) => {
            let Named { name, table } = &parameters[at];
            let expected = format!("a column `{name}` or `{}`", table.path);
            Err((format!("no column for the parameter `{name}`"), expected))
        }
        None => Ok(()),
    }
}

fn listed(values: Vec<Given>) -> Parameter {
    Parameter { path: String::new(), values: Some(values), range: None, distribution: None }
}

/// The name of a parameter with this path: `projectile_mass_velocity_1`.
fn name_of(path: &str) -> String {
    let parts = path.split(|c: char| !is_name(c.encode_utf8(&mut [0; 4])));
    parts.filter(|part| !part.is_empty()).collect::<Vec<_>>().join("_")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_values_in_the_form_of_the_scenario() {
        let text =
            "# made elsewhere\nspeed; mass [g] ;projectile.p.velocity[1]\n1;2;3\n;inf;\"4 m/s\"\n";
        let columns = columns(text).unwrap_or_else(|(line, found)| panic!("{line}: {found}"));
        let found: Vec<(&str, Vec<&str>)> = columns
            .iter()
            .map(|c| (c.header.as_str(), c.values.iter().map(|v| v.toml.as_str()).collect()))
            .collect();
        assert_eq!(found[0], ("speed", vec!["1.0", "nan"]));
        assert_eq!(found[1], ("mass", vec!["\"2.0 g\"", "\"inf g\""]));
        assert_eq!(found[2], ("projectile.p.velocity[1]", vec!["3.0", "\"4 m/s\""]));
        assert_eq!(name_of("projectile.p.velocity[1]"), "projectile_p_velocity_1");
    }

    #[test]
    fn a_file_that_is_no_table_is_reported_with_its_line() {
        let reported = |text| columns(text).err().map(|(line, found)| format!("{line}: {found}"));
        assert_eq!(reported("1,2\n3,4\n").as_deref(), Some("1: no header"));
        assert_eq!(reported("a,b\n\n1,2\n3\n").as_deref(), Some("4: 1 cells for 2 columns"));
        assert_eq!(reported("a,b\n").as_deref(), Some("1: a header without rows"));
        assert_eq!(reported("").as_deref(), Some("1: no header"));
    }
}
