//! Paths that a scenario can have, by the keys of the format: the one place that knows them for changes to files, Python and studies.

use std::collections::BTreeMap;
use std::sync::{LazyLock, Mutex, PoisonError};

use percuss::{is_index, path_steps};
use serde_json::Value as Json;
use toml_edit::Value;

use crate::reference::{schema, schema_of};
use crate::stray::Stray;
use crate::suggest;
use crate::table::is_name;

/// What the format has at the end of a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum End {
    /// A value, or a list of values.
    Value,
    /// A table.
    Table,
    /// A value or a table, such as a word for one without keys.
    Either,
    /// Tables with the user's names.
    Collection,
}

/// A path with keys of the format; whether a scenario has its names and entries is another question.
#[derive(Clone, Debug)]
pub(crate) struct KnownPath {
    /// Names, keys and indices, shape (steps).
    pub steps: Vec<String>,
    /// What stands there.
    pub end: End,
    /// Whether the second step is a name of the user's.
    pub is_named: bool,
    forms: Forms,
}

impl KnownPath {
    /// Finds a path.
    ///
    /// # Errors
    /// The first step that no scenario can have there.
    pub fn find(path: &str) -> Result<Self, Stray> {
        let steps = path_steps(path).map_err(|fault| Stray::new(fault.found, fault.expected))?;
        let mut forms = Forms::root(steps.first().map_or("", String::as_str));
        let mut is_named = false;
        for (k, step) in steps.iter().enumerate() {
            is_named |= k == 1 && forms.has_names() && !forms.keys().contains(&step.as_str());
            forms = forms.behind(step, &steps[..k])?;
        }
        Ok(Self { end: forms.end(), steps, is_named, forms })
    }

    /// Keys and names in a table to be set here that no scenario can have, each with its path.
    pub fn strays_in(&self, value: &Value) -> Vec<(String, Stray)> {
        let mut strays = Vec::new();
        self.forms.check(&self.steps, value, &mut strays);
        strays
    }
}

/// Forms in which something may stand at a place: schemas without choices, shape (forms).
#[derive(Clone, Debug)]
struct Forms(Vec<&'static Json>);

impl Forms {
    /// The file, with the key that is the first step alone, or if there is none with all of them. Each is made once, and only if asked for: the
    /// schema of the whole file takes longer than all the rest.
    fn root(first: &str) -> Self {
        static ALL: LazyLock<Json> = LazyLock::new(schema);
        static PARTS: Mutex<BTreeMap<&str, &Json>> = Mutex::new(BTreeMap::new());
        let mut parts = PARTS.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(known) = parts.get(first) {
            return Self::of([*known]);
        }
        let Some((name, part)) = schema_of(first) else { return Self::of([&*ALL]) };
        let part: &'static Json = Box::leak(Box::new(part));
        parts.insert(name, part);
        Self::of([part])
    }

    fn of(schemas: impl IntoIterator<Item = &'static Json>) -> Self {
        let mut forms = Vec::new();
        for schema in schemas {
            let is_table = schema.get("properties").is_some();
            let choices = ["oneOf", "anyOf"].map(|word| schema.get(word).and_then(Json::as_array));
            let choices: Vec<&Json> = choices.into_iter().flatten().flatten().collect();
            // Beside the keys of a table, choices only say which of them are required.
            if is_table || choices.is_empty() {
                forms.push(schema);
            } else {
                forms.extend(Self::of(choices).0);
            }
        }
        Self(forms)
    }

    /// Forms of what stands behind a step; `before` are the steps up to here.
    fn behind(&self, step: &str, before: &[String]) -> Result<Self, Stray> {
        let entries = self.0.iter().flat_map(|form| entries(form));
        let entries: Vec<&Json> = entries.filter(|_| is_index(step)).collect();
        let own = self.0.iter().filter_map(|form| form.get("properties")?.get(step));
        let own: Vec<&Json> = own.collect();
        let of_name: Vec<&Json> = self.0.iter().filter_map(|form| names(form)).collect();
        match [entries, own, of_name].into_iter().find(|forms| !forms.is_empty()) {
            Some(forms) => Ok(Self::of(forms)),
            None => Err(self.stray(step, before)),
        }
    }

    fn stray(&self, step: &str, before: &[String]) -> Stray {
        let keys = self.keys();
        match before.last() {
            Some(last) if keys.is_empty() => {
                let path = before.join(".");
                Stray::new(format!("`{step}` behind `{last}`"), format!("the path `{path}`"))
            }
            _ => {
                let expected = suggest::one_of(step, keys.into_iter());
                Stray::new(format!("the unknown key `{step}`"), expected)
            }
        }
    }

    /// Keys of all tables, each once.
    fn keys(&self) -> Vec<&'static str> {
        let mut out: Vec<&str> = Vec::new();
        let tables = self.0.iter().filter_map(|form| form.get("properties")?.as_object());
        for key in tables.flat_map(|table| table.keys()) {
            if !out.contains(&key.as_str()) {
                out.push(key);
            }
        }
        out
    }

    fn has_names(&self) -> bool {
        self.0.iter().any(|form| names(form).is_some())
    }

    fn end(&self) -> End {
        let is_table = |form: &&Json| form.get("properties").is_some();
        match (self.0.iter().all(is_table), self.0.iter().any(is_table)) {
            _ if self.has_names() => End::Collection,
            (true, _) => End::Table,
            (_, true) => End::Either,
            _ => End::Value,
        }
    }

    fn check(&self, at: &[String], value: &Value, strays: &mut Vec<(String, Stray)>) {
        let below = |step: &str| [at, &[step.to_owned()]].concat();
        match value {
            Value::InlineTable(table) if self.has_names() || !self.keys().is_empty() => {
                for (key, inner) in table {
                    let at = below(key);
                    match self.behind(key, at.split_last().map_or(&[], |(_, before)| before)) {
                        _ if !is_name(key) => {
                            let expected = "a name of letters, digits, `_` and `-`";
                            let stray = Stray::new(format!("the name `{key}`"), expected);
                            strays.push((at.join("."), stray));
                        }
                        Ok(forms) => forms.check(&at, inner, strays),
                        Err(stray) => strays.push((at.join("."), stray)),
                    }
                }
            }
            Value::Array(list) => {
                for (k, inner) in list.iter().enumerate() {
                    let at = below(&k.to_string());
                    if let Ok(forms) = self.behind(&k.to_string(), &[]) {
                        forms.check(&at, inner, strays);
                    }
                }
            }
            _ => {}
        }
    }
}

/// Forms of the entries of a list.
fn entries(form: &'static Json) -> Vec<&'static Json> {
    let each = form.get("prefixItems").and_then(Json::as_array).into_iter().flatten();
    each.chain(form.get("items")).collect()
}

/// The form of a table with the user's name.
fn names(form: &'static Json) -> Option<&'static Json> {
    form.get("additionalProperties").filter(|form| form.is_object())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_end_of_a_path_is_known() {
        for (path, end, is_named) in [
            ("title", End::Value, false),
            ("time", End::Table, false),
            ("time.step", End::Value, false),
            ("beam", End::Collection, false),
            ("beam.any", End::Table, true),
            ("beam.any.points[1][0]", End::Value, true),
            ("beam.1.elements", End::Value, true),
            ("initial", End::Collection, false),
            ("load.l.function", End::Either, true),
            ("load.l.function.duration", End::Value, true),
            ("allow.W105", End::Value, false),
        ] {
            let known = KnownPath::find(path).unwrap_or_else(|stray| panic!("{path}: {stray:?}"));
            assert_eq!((known.end, known.is_named), (end, is_named), "{path}");
        }
    }

    #[test]
    fn every_unknown_key_of_a_table_is_found() {
        let known = KnownPath::find("support").expect("known");
        let value = "{ left = { att = 1, motion = { knid = 2 } }, 'a b' = { at = 1 } }";
        let strays = known.strays_in(&value.parse().expect("TOML"));
        let paths: Vec<&str> = strays.iter().map(|(path, _)| path.as_str()).collect();
        assert_eq!(paths, ["support.left.att", "support.left.motion.knid", "support.a b"]);
    }
}
