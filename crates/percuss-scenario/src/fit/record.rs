//! Records of tests: CSV files with any number of columns, whose first row names them and their units.

use std::path::Path;

use super::dimension::dimension;
use crate::csv::{cells, headed, shown};
use crate::header::{parts, value};
use crate::measure;
use crate::units;

/// A record of a test.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    /// Its columns, shape (columns).
    pub columns: Vec<RecordColumn>,
}

/// What is wrong with the text of a record.
#[derive(Debug)]
struct Wrong {
    /// Line, from 1; 0 for the whole.
    line: usize,
    found: String,
    /// What would be right, if that is not a record in general.
    expected: Option<&'static str>,
}

/// A column of a record.
#[derive(Clone, Debug, PartialEq)]
pub struct RecordColumn {
    /// Its header as it stands in the file.
    pub header: String,
    /// Its name without the unit.
    pub name: String,
    /// Its unit, if the header has one.
    pub unit: Option<String>,
    /// Values as they stand in the file, shape (rows) \[unit of the header\].
    pub values: Vec<f64>,
}

impl RecordColumn {
    /// A column from its header and values.
    pub fn new(header: &str, values: Vec<f64>) -> Self {
        let (name, unit) = parts(header);
        let unit = unit.map(str::to_owned);
        Self { header: header.trim().into(), name: name.into(), unit, values }
    }

    /// Values in an SI unit; without a unit in the header they are in that unit.
    ///
    /// # Errors
    /// What was found and what would be right, where the header names another quantity.
    pub fn in_unit(&self, si: &str) -> Result<Vec<f64>, (String, String)> {
        let header = &self.header;
        let unit = match self.unit.as_deref() {
            None | Some("") => return Ok(self.values.clone()),
            Some("-" | "1") if matches!(si, "" | "1") => return Ok(self.values.clone()),
            // The gram in every file, and standard gravity to those who measure accelerations.
            Some("g") if si == "m/s^2" => "kgf/kg",
            Some(unit) => unit,
        };
        let expected = format!(
            "a header with a unit of the dimension of {si}, such as `{} [{si}]`",
            self.name
        );
        let Ok(one) = units::parse(&format!("1 {unit}")) else {
            return Err((format!("the header `{header}`, whose unit is not known"), expected));
        };
        if one.dimension != dimension(si) {
            let what = measure::name(one.dimension);
            return Err((format!("the header `{header}`, which is {what}"), expected));
        }
        Ok(self.values.iter().map(|x| x * one.value).collect())
    }
}

impl Record {
    /// Reads a record.
    ///
    /// # Errors
    /// What was found and what would be right, with the line.
    pub fn read(path: &Path) -> Result<Self, (String, String)> {
        let name = path.display();
        let expected = || {
            "a CSV file whose first row names the columns and their units, such as `t [ms],F [kN]`"
                .to_owned()
        };
        if !path.is_file() {
            return Err((format!("\"{name}\", where there is no file"), expected()));
        }
        let bytes = std::fs::read(path)
            .map_err(|error| (format!("\"{name}\", which cannot be read ({error})"), expected()))?;
        let text = String::from_utf8(bytes)
            .map_err(|_| (format!("\"{name}\", which is not UTF-8"), expected()))?;
        Self::parse(&text).map_err(|Wrong { line, found, expected: own }| {
            let at = if line > 0 { format!("line {line} of ") } else { String::new() };
            (format!("{found} in {at}\"{name}\""), own.map_or_else(expected, str::to_owned))
        })
    }

    /// Reads the text of a record.
    fn parse(text: &str) -> Result<Self, Wrong> {
        let wrong = |line: usize, found: &str| Wrong { line, found: found.into(), expected: None };
        let lines = text.trim_start_matches('\u{feff}').lines().enumerate();
        let remark = headed(lines.clone().map(|(_, line)| line.trim()), cells);
        let mut lines = lines.filter(|(_, line)| {
            let line = line.trim();
            !line.is_empty() && !line.starts_with('#')
        });
        let mut rows = lines.clone();
        let Some((first, header)) = rows.next() else { return Err(wrong(0, "no rows")) };
        let headers = match remark {
            Some(headers) => headers,
            None => {
                lines = rows;
                cells(header.trim())
            }
        };
        if headers.iter().any(|cell| cell.parse::<f64>().is_ok()) {
            return Err(wrong(first + 1, "a first row of numbers"));
        }
        let mut columns: Vec<RecordColumn> =
            headers.iter().map(|header| RecordColumn::new(header, Vec::new())).collect();
        for (k, line) in lines {
            let row = cells(line.trim());
            if row.len() != columns.len() {
                let (here, there) = (row.len(), columns.len());
                let columns = if here == 1 { "column" } else { "columns" };
                return Err(wrong(
                    k + 1,
                    &format!("{here} {columns} where the header has {there}"),
                ));
            }
            for (column, cell) in columns.iter_mut().zip(row) {
                let number = value(cell, None).ok_or_else(|| {
                    let (found, expected) = cell_at_fault(&column.header, cell);
                    Wrong { line: k + 1, found, expected: Some(expected) }
                })?;
                column.values.push(number);
            }
        }
        Ok(Self { columns })
    }

    /// The column with this header, or with this name before its unit.
    ///
    /// # Errors
    /// What was found and what would be right.
    pub fn column(&self, name: &str) -> Result<&RecordColumn, (String, String)> {
        let name = name.trim();
        let headers = self.columns.iter().map(|column| column.header.as_str());
        let called: [fn(&RecordColumn, &str) -> bool; 2] =
            [|one, name| one.header == name, |one, name| one.name == name];
        for is in called {
            match self.columns.iter().filter(|one| is(one, name)).collect::<Vec<_>>()[..] {
                [] => {}
                [column] => return Ok(column),
                [..] => {
                    let found = format!("`{name}`, which several columns of the record are called");
                    let all: Vec<String> = headers.map(|header| format!("`{header}`")).collect();
                    return Err((
                        found,
                        format!("one column of that name among {}", all.join(", ")),
                    ));
                }
            }
        }
        let found = format!("`{name}`, which is no column of the record");
        Err((found, crate::suggest::one_of(name, headers)))
    }
}

/// What was found in a cell that is no number, and what would be right.
fn cell_at_fault(header: &str, cell: &str) -> (String, &'static str) {
    let dotted = cell.replacen(',', ".", 1);
    if cell.is_empty() {
        let expected = "a number in every cell: rows in which one is missing have to be left out";
        return (format!("an empty cell of `{header}`"), expected);
    }
    if cell.contains(',') && dotted.parse::<f64>().is_ok() {
        let expected = "a decimal point, such as 0.5";
        return (format!("a comma in the number {} of `{header}`", shown(cell)), expected);
    }
    let expected =
        "a finite number in every cell below the first row; units stand in the first row";
    (format!("{}, which is no finite number, in a cell of `{header}`", shown(cell)), expected)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// As `numpy.savetxt` writes it.
    #[test]
    fn a_header_counts_behind_a_hash_too() {
        let record = Record::parse("# a drop test\n# t [ms] F [kN]\n0 1\n0.5 2\n");
        let record = record.unwrap_or_else(|fault| panic!("{fault:?}"));
        let force = record.column("F").and_then(|column| column.in_unit("N"));
        assert_eq!(force, Ok(vec![1000.0, 2000.0]));
        assert!(Record::parse("# a drop test\n0,1\n0.5,2\n").is_err());
    }

    #[test]
    fn values_are_in_the_units_of_their_headers() {
        let record = Record::parse("# a drop test\nt [ms]; F [kN]; a [g]\n0; 1; 1\n0.5; 2; 0\n");
        let record = record.unwrap_or_else(|fault| panic!("{fault:?}"));
        let times = record.column("t").and_then(|column| column.in_unit("s"));
        assert_eq!(times, Ok(vec![0.0, 0.5 * 1e-3]));
        let force = record.column("F [kN]").and_then(|column| column.in_unit("N"));
        assert_eq!(force, Ok(vec![1000.0, 2000.0]));
        let acceleration = record.column("a").and_then(|column| column.in_unit("m/s^2"));
        assert_eq!(acceleration, Ok(vec![9.80665, 0.0]));
        let wrong = record.column("F").and_then(|column| column.in_unit("m"));
        assert!(wrong.is_err_and(|(found, _)| found.contains("a force")));
        assert!(record.column("G").is_err_and(|(_, expected)| expected.contains("F [kN]")));
    }

    #[test]
    fn a_name_of_two_columns_is_refused_and_a_whole_header_distinguishes_them() {
        let record = Record::parse("t [s],F [N],F [kN],u,u\n0,1,2,3,4\n");
        let record = record.unwrap_or_else(|fault| panic!("{fault:?}"));
        for name in ["F", "u"] {
            let refused = record.column(name);
            assert!(refused.is_err_and(|(found, _)| found.contains("several columns")), "{name}");
        }
        assert_eq!(record.column("F [kN]").map(|column| column.values[0]), Ok(2.0));
    }

    #[test]
    fn a_cell_at_fault_is_shown_with_what_would_be_right() {
        for (cell, found, expected) in [
            ("", "an empty cell of `F [N]`", "rows in which one is missing"),
            ("0,5", "a comma in the number \"0,5\"", "a decimal point"),
            ("NaN", "\"NaN\", which is no finite number", "a finite number"),
            ("kN", "a text, which is no finite number", "units stand in the first row"),
        ] {
            let wrong = Record::parse(&format!("t [s];F [N]\n0;{cell}\n"));
            let Err(wrong) = wrong else { panic!("{cell:?} was read") };
            assert!(wrong.line == 2 && wrong.found.contains(found), "{wrong:?}");
            assert!(wrong.expected.is_some_and(|text| text.contains(expected)), "{wrong:?}");
        }
    }

    #[test]
    fn a_record_without_header_or_with_gaps_is_refused_with_its_line() {
        for (text, line) in [("0,1\n1,2\n", 1), ("t,F\n0,1\n1\n", 3), ("t,F\n0,x\n", 2), ("", 0)] {
            assert_eq!(Record::parse(text).map_err(|fault| fault.line), Err(line), "{text:?}");
        }
    }
}
