//! Changes to the text of a scenario, its comments and the order of its lines kept.

use pyo3::exceptions::{PyKeyError, PyValueError};
use pyo3::prelude::*;
use toml_edit::{DocumentMut, InlineTable, Item, Table, TableLike, Value};

/// The text with a value; tables on the way are made where they are missing.
///
/// Parameters
/// ----------
/// text : str
///     TOML.
/// path : str
///     Where, with dots.
/// value : str
///     The value in TOML.
///
/// Returns
/// -------
/// str
///     TOML with all comments.
///
/// Raises
/// ------
/// KeyError
///     If the way leads through a value.
///
/// Examples
/// --------
/// >>> print(percuss._percuss.set("", "time.end", "0.1"))
/// [time]
/// end = 0.1
#[pyfunction]
pub fn set(text: &str, path: &str, value: &str) -> PyResult<String> {
    let mut document = parse(text)?;
    let value: Value =
        value.parse().map_err(|error| PyValueError::new_err(format!("{path}: {error}")))?;
    let parts: Vec<&str> = path.split('.').collect();
    let mut table: &mut dyn TableLike = document.as_table_mut();
    let (key, outer) = parts.split_last().ok_or_else(|| PyKeyError::new_err(path.to_owned()))?;
    for (depth, part) in outer.iter().enumerate() {
        let item = table.entry(part).or_insert_with(|| missing_table(depth));
        table = item.as_table_like_mut().ok_or_else(|| {
            PyKeyError::new_err(format!("{path}: `{part}` is a value without keys"))
        })?;
    }
    put(table, key, value, parts.len());
    Ok(document.to_string())
}

/// The text without the value at a path.
///
/// Parameters
/// ----------
/// text : str
///     TOML.
/// path : str
///     Where, with dots.
///
/// Returns
/// -------
/// str
///     TOML with all other comments.
///
/// Raises
/// ------
/// KeyError
///     If there is no value.
///
/// Examples
/// --------
/// >>> percuss._percuss.remove('title = "a"', "title")
/// ''
#[pyfunction]
pub fn remove(text: &str, path: &str) -> PyResult<String> {
    let mut document = parse(text)?;
    let parts: Vec<&str> = path.split('.').collect();
    let missing = || PyKeyError::new_err(path.to_owned());
    let mut table: &mut dyn TableLike = document.as_table_mut();
    let (key, outer) = parts.split_last().ok_or_else(missing)?;
    for part in outer {
        table = table.get_mut(part).and_then(Item::as_table_like_mut).ok_or_else(missing)?;
    }
    table.remove(key).ok_or_else(missing)?;
    Ok(document.to_string())
}

fn parse(text: &str) -> PyResult<DocumentMut> {
    text.parse().map_err(|error: toml_edit::TomlError| PyValueError::new_err(error.to_string()))
}

/// `[kind]` is not written, `[kind.name]` is; deeper tables are written in braces.
fn missing_table(depth: usize) -> Item {
    match depth {
        0 => {
            let mut table = Table::new();
            table.set_implicit(true);
            Item::Table(table)
        }
        1 => Item::Table(Table::new()),
        _ => Item::Value(Value::InlineTable(InlineTable::new())),
    }
}

/// Sets a key; blanks and a comment round an old value stay. Near the root a table gets a header of its own.
fn put(table: &mut dyn TableLike, key: &str, mut value: Value, depth: usize) {
    value.decor_mut().clear();
    if depth <= 2
        && let Value::InlineTable(inline) = value
    {
        table.insert(key, Item::Table(inline.into_table()));
        return;
    }
    let old = table.get(key).and_then(Item::as_value).map(|old| old.decor().clone());
    if let Some(decor) = old {
        *value.decor_mut() = decor;
    }
    table.insert(key, Item::Value(value));
}
