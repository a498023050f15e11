//! `--set path=value`: changes to a scenario file, comments kept.

use std::sync::LazyLock;

use serde_json::Value as Json;
use toml::de::DeTable;
use toml_edit::{DocumentMut, InlineTable, Item, Table, TableLike, Value};

use crate::code::FaultCode;
use crate::diagnostic::{Diagnostic, Diagnostics};
use crate::reach;
use crate::reference::schema;
use crate::source::Source;
use crate::suggest;
use crate::syntax;

/// Sets values in a scenario file, each override as `path=value`: `time.step=1e-5 s`.
///
/// The value is TOML; what is not TOML is taken for a text. Tables that stand once are added where
/// they are missing, tables with names must exist. `name` stands for the file in messages.
///
/// # Errors
/// Every path that the format or the file does not know; the syntax errors of a file that has some.
pub fn apply_overrides(
    text: &str,
    name: &str,
    overrides: &[String],
) -> Result<String, Diagnostics> {
    if overrides.is_empty() {
        return Ok(text.to_string());
    }
    let source = Source::new(name, text);
    let (_, errors) = DeTable::parse_recoverable(text);
    if !errors.is_empty() {
        let all = syntax::faults(&source, &errors);
        return Err(Diagnostics::new(source, all));
    }
    let mut document: DocumentMut = text.parse().map_err(|error: toml_edit::TomlError| {
        let span = error.span().unwrap_or(0..0);
        let one =
            Diagnostic::at(FaultCode::Syntax, &source, span, "", error.message(), "valid TOML");
        Diagnostics::new(source, vec![one])
    })?;
    // Made once: it takes longer than all the rest.
    static SCHEMA: LazyLock<Json> = LazyLock::new(schema);
    let apply = |one: &String| apply(&mut document, &SCHEMA, one).err();
    let faults: Vec<Diagnostic> = overrides.iter().filter_map(apply).collect();
    if faults.is_empty() {
        return Ok(document.to_string());
    }
    Err(Diagnostics::new(Source::new("--set", ""), faults))
}

fn fault(path: &str, found: impl Into<String>, expected: impl Into<String>) -> Diagnostic {
    Diagnostic {
        code: FaultCode::Change,
        path: path.into(),
        ..Diagnostic::of_file(found, expected)
    }
}

fn apply(document: &mut DocumentMut, schema: &Json, text: &str) -> Result<(), Diagnostic> {
    let example = "path=value, such as time.step=1e-5";
    let (path, value) =
        text.split_once('=').ok_or_else(|| fault("", format!("`{text}`"), example))?;
    let (path, value) = (path.trim(), value.trim());
    // `velocity[1]` is `velocity.1`, as in the paths of studies.
    let steps = reach::steps(path);
    let parts: Vec<&str> = steps.iter().map(String::as_str).collect();
    let Some(top) = schema["properties"].get(parts[0]) else {
        let expected = suggest::one_of(parts[0], keys(schema).into_iter());
        return Err(fault(path, format!("the unknown key `{}`", parts[0]), expected));
    };
    let value = value.parse().unwrap_or_else(|_| Value::from(value));
    // `initial` has keys of its own beside tables with names.
    let own = parts.get(1).is_some_and(|key| top["properties"].get(*key).is_some());
    let named = top.get("additionalProperties").filter(|inner| inner.is_object() && !own);
    let inner = named.unwrap_or(top);
    match (parts.as_slice(), named.is_some(), keys(inner).is_empty()) {
        ([key], false, true) => put(document.as_table_mut(), key, value),
        ([key, ..], false, true) if indices(&parts[1..]).is_some() => {
            put_inside(path, document.as_table_mut(), &parts, value)?;
        }
        ([table, keys @ ..], false, false) if !keys.is_empty() => {
            check_keys(path, keys, inner)?;
            let root = document.as_table_mut();
            let item = root.entry(table).or_insert_with(|| Item::Table(Table::new()));
            put_inside(path, table_like(path, item)?, keys, value)?;
        }
        ([kind, name, keys @ ..], true, _) if !keys.is_empty() => {
            check_keys(path, keys, inner)?;
            put_inside(path, existing(document, path, kind, name)?, keys, value)?;
        }
        _ => {
            let form = match (named.is_some(), keys(inner).is_empty()) {
                (true, _) => format!("{}.NAME.KEY=value", parts[0]),
                (false, false) => format!("{}.KEY=value", parts[0]),
                (false, true) => format!("{}=value", parts[0]),
            };
            return Err(fault(path, format!("a path of {} parts", parts.len()), form));
        }
    }
    Ok(())
}

/// Keys of a table in the schema with their schemas, whatever its kind; none if it is no table.
fn properties(schema: &Json) -> Vec<(&str, &Json)> {
    let own = schema.get("properties").and_then(Json::as_object).into_iter().flatten();
    let mut out: Vec<(&str, &Json)> = own.map(|(key, inner)| (key.as_str(), inner)).collect();
    for choice in ["oneOf", "anyOf"] {
        let choices = schema.get(choice).and_then(Json::as_array).into_iter().flatten();
        out.extend(choices.flat_map(properties));
    }
    out
}

/// Names of these keys, each once.
fn keys(schema: &Json) -> Vec<&str> {
    let mut out: Vec<&str> = Vec::new();
    for (key, _) in properties(schema) {
        if !out.contains(&key) {
            out.push(key);
        }
    }
    out
}

/// Whether a table knows a key, the table behind it the next, and so on.
fn check_keys(path: &str, given: &[&str], table: &Json) -> Result<(), Diagnostic> {
    let [key, rest @ ..] = given else { return Ok(()) };
    let inner: Vec<&Json> =
        properties(table).into_iter().filter(|p| p.0 == *key).map(|p| p.1).collect();
    if inner.is_empty() {
        let names = keys(table);
        let expected = suggest::one_of(key, names.into_iter());
        return Err(fault(path, format!("the unknown key `{key}`"), expected));
    }
    if rest.is_empty() || indices(rest).is_some() && inner.iter().all(|i| keys(i).is_empty()) {
        return Ok(());
    }
    let Some(table) = inner.into_iter().find(|schema| !keys(schema).is_empty()) else {
        return Err(fault(path, format!("`{}` behind `{key}`", rest[0]), format!("{key}=value")));
    };
    check_keys(path, rest, table)
}

/// Sets a key of a table, or of a table in braces within it.
fn put_inside(
    path: &str,
    table: &mut dyn TableLike,
    keys: &[&str],
    value: Value,
) -> Result<(), Diagnostic> {
    match keys {
        [] => Ok(()),
        [key] => {
            put(table, key, value);
            Ok(())
        }
        [key, rest @ ..] if indices(rest).is_some() && !is_table(table, key) => {
            let item = table.get_mut(key).and_then(Item::as_value_mut);
            let Some(list) = item else {
                let expected = format!("a list in the file to change, or {key}=[...]");
                return Err(fault(path, format!("no `{key}` in the file"), expected));
            };
            put_entry(path, list, &indices(rest).unwrap_or_default(), value)
        }
        [key, rest @ ..] => {
            let braces = || Item::Value(Value::InlineTable(InlineTable::new()));
            let inner = table.entry(key).or_insert_with(braces);
            put_inside(path, table_like(path, inner)?, rest, value)
        }
    }
}

/// The steps as indices of lists, if all of them are; there is one at least.
fn indices(steps: &[&str]) -> Option<Vec<usize>> {
    let all: Option<Vec<usize>> = steps.iter().map(|step| step.parse().ok()).collect();
    all.filter(|all| !all.is_empty())
}

fn is_table(table: &dyn TableLike, key: &str) -> bool {
    table.get(key).is_some_and(Item::is_table_like)
}

/// Sets an entry of a list, or of a list within it.
fn put_entry(
    path: &str,
    at: &mut Value,
    indices: &[usize],
    mut value: Value,
) -> Result<(), Diagnostic> {
    let [index, rest @ ..] = indices else {
        *value.decor_mut() = at.decor().clone();
        *at = value;
        return Ok(());
    };
    let found = format!("a {} in the file", at.type_name());
    let Some(list) = at.as_array_mut() else { return Err(fault(path, found, "a list")) };
    let found = format!("the entry {index} of a list of {}", list.len());
    let expected = format!("an entry from 0 to {}", list.len().saturating_sub(1));
    let entry = list.get_mut(*index).ok_or_else(|| fault(path, found, expected))?;
    put_entry(path, entry, rest, value)
}

fn table_like<'d>(path: &str, item: &'d mut Item) -> Result<&'d mut dyn TableLike, Diagnostic> {
    let found = format!("a {} in the file", item.type_name());
    item.as_table_like_mut().ok_or_else(|| fault(path, found, "a table"))
}

fn existing<'d>(
    document: &'d mut DocumentMut,
    path: &str,
    kind: &str,
    name: &str,
) -> Result<&'d mut dyn TableLike, Diagnostic> {
    let names: Vec<String> = document
        .get(kind)
        .and_then(Item::as_table_like)
        .map(|table| table.iter().map(|(name, _)| name.to_string()).collect())
        .unwrap_or_default();
    if !names.iter().any(|n| n == name) {
        let found = format!("no [{kind}.{name}] in the file");
        let expected = suggest::one_of(name, names.iter().map(String::as_str));
        return Err(fault(path, found, expected));
    }
    match document.get_mut(kind).and_then(|table| table.get_mut(name)) {
        Some(item) => table_like(path, item),
        None => Err(fault(path, format!("no [{kind}.{name}] in the file"), "an existing table")),
    }
}

/// Sets a key; the blanks and the comment round the old value stay.
fn put(table: &mut dyn TableLike, key: &str, mut value: Value) {
    value.decor_mut().clear();
    match table.get_mut(key) {
        Some(item) => {
            if let Some(old) = item.as_value() {
                *value.decor_mut() = old.decor().clone();
            }
            *item = Item::Value(value);
        }
        None => {
            table.insert(key, Item::Value(value));
        }
    }
}
