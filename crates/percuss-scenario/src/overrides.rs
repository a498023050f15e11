//! Changes to a scenario file by paths: `--set path=value`, keywords in Python, parameters of studies; comments are kept.

use toml::de::DeTable;
use toml_edit::{DocumentMut, Value};

use crate::code::FaultCode;
use crate::diagnostic::{Diagnostic, Diagnostics};
use crate::edit::{self, Adds};
use crate::known_path::KnownPath;
use crate::source::Source;
use crate::stray::Stray;
use crate::syntax;

/// What `--set` is called in messages.
const SET: &str = "--set";

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
    let split = |one: &String| match one.split_once('=') {
        Some((path, value)) => Ok((path.trim().to_owned(), value.trim().to_owned())),
        None => {
            let example = "path=value, such as time.step=1e-5";
            Err(fault("", Stray::new(format!("`{one}`"), example)))
        }
    };
    let (changes, faults): (Vec<_>, Vec<_>) = overrides.iter().map(split).partition(Result::is_ok);
    let changes: Vec<(String, String)> = changes.into_iter().flatten().collect();
    let faults = faults.into_iter().filter_map(Result::err).collect();
    change(text, [name, SET], &changes, Adds::Fixed, faults)
}

/// The same, of paths with their values as TOML. A table takes the place of the whole table at its path. `names` stand in messages for the
/// file and for the changes.
///
/// # Errors
/// As [`apply_overrides`].
pub fn apply_changes(
    text: &str,
    names: [&str; 2],
    changes: &[(String, String)],
    adds: Adds,
) -> Result<String, Diagnostics> {
    change(text, names, changes, adds, Vec::new())
}

/// The file without what stands at a path.
///
/// # Errors
/// If nothing stands there; the syntax errors of a file that has some.
pub fn remove_value(text: &str, name: &str, path: &str) -> Result<String, Diagnostics> {
    let mut document = document(text, name)?;
    let removed = KnownPath::find(path).and_then(|known| edit::remove(&mut document, &known));
    removed.map(|()| document.to_string()).map_err(|stray| lost(name, path, stray))
}

/// The steps of a path that a scenario can have; with the text of a file, of one at which something stands in it.
///
/// # Errors
/// The first step that leads nowhere, with the names that would lead on.
pub fn known_steps(path: &str, name: &str, text: Option<&str>) -> Result<Vec<String>, Diagnostics> {
    let known = KnownPath::find(path).map_err(|stray| lost(name, path, stray))?;
    if let Some(text) = text {
        let found = edit::require(&mut document(text, name)?, &known);
        found.map_err(|stray| lost(name, path, stray))?;
    }
    Ok(known.steps)
}

fn change(
    text: &str,
    [name, door]: [&str; 2],
    changes: &[(String, String)],
    adds: Adds,
    mut faults: Vec<Diagnostic>,
) -> Result<String, Diagnostics> {
    if changes.is_empty() && faults.is_empty() {
        return Ok(text.to_string());
    }
    let mut document = document(text, name)?;
    for (path, value) in changes {
        let value = value.parse().unwrap_or_else(|_| Value::from(value));
        match KnownPath::find(path) {
            Err(stray) => faults.push(fault(path, stray)),
            Ok(known) => {
                let strays = known.strays_in(&value);
                let set = match strays.is_empty() {
                    true => edit::set(&mut document, &known, value, adds),
                    false => Ok(()),
                };
                faults.extend(set.err().map(|stray| fault(path, stray)));
                faults.extend(strays.into_iter().map(|(path, stray)| fault(&path, stray)));
            }
        }
    }
    if faults.is_empty() {
        return Ok(document.to_string());
    }
    Err(Diagnostics::new(Source::new(door, ""), faults))
}

fn document(text: &str, name: &str) -> Result<DocumentMut, Diagnostics> {
    let source = Source::new(name, text);
    let (_, errors) = DeTable::parse_recoverable(text);
    if !errors.is_empty() {
        let all = syntax::faults(&source, &errors);
        return Err(Diagnostics::new(source, all));
    }
    text.parse().map_err(|error: toml_edit::TomlError| {
        let span = error.span().unwrap_or(0..0);
        let one =
            Diagnostic::at(FaultCode::Syntax, &source, span, "", error.message(), "valid TOML");
        Diagnostics::new(source, vec![one])
    })
}

fn lost(name: &str, path: &str, stray: Stray) -> Diagnostics {
    Diagnostics::new(Source::new(name, ""), vec![fault(path, stray)])
}

fn fault(path: &str, Stray { found, expected }: Stray) -> Diagnostic {
    Diagnostic {
        code: FaultCode::Change,
        path: path.into(),
        ..Diagnostic::of_file(found, expected)
    }
}
