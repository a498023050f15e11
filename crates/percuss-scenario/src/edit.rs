//! Changes to the text of a scenario at paths, its comments and the order of its lines kept.

use percuss::is_index;
use toml_edit::{ArrayOfTables, DocumentMut, InlineTable, Item, Table, TableLike, Value};

use crate::known_path::{End, KnownPath};
use crate::stray::Stray;
use crate::suggest;

/// Which tables a change adds where a file lacks them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Adds {
    /// Those that stand once, and tables in braces: a change of a run, which finds what it names.
    Fixed,
    /// All, those with names too: a scenario in the making.
    Named,
}

/// Sets what stands at a path. A table takes the place of the whole table before.
pub(crate) fn set(
    document: &mut DocumentMut,
    known: &KnownPath,
    value: Value,
    adds: Adds,
) -> Result<(), Stray> {
    let is_table = value.is_inline_table();
    if !is_table && matches!(known.end, End::Table | End::Collection) {
        let found = format!("{} instead of a table", value.to_string().trim());
        return Err(Stray::new(found, "the path of a value in it, or a table in braces"));
    }
    let change = Change { known, adds };
    change.in_table(document.as_table_mut(), 0, value)
}

/// Takes away what stands at a path.
pub(crate) fn remove(document: &mut DocumentMut, known: &KnownPath) -> Result<(), Stray> {
    require(document, known)?;
    let Some((last, outer)) = known.steps.split_last() else { return Ok(()) };
    let mut at = Found::Table(document.as_table_mut());
    for step in outer {
        match at.inner(step) {
            Some(inner) => at = inner,
            None => return Ok(()),
        }
    }
    match (at, last.parse::<usize>()) {
        (Found::Table(table), _) => _ = table.remove(last),
        (Found::Value(Value::Array(list)), Ok(k)) => _ = list.remove(k),
        (Found::Tables(list), Ok(k)) => _ = list.remove(k),
        _ => {}
    }
    Ok(())
}

/// Whether something stands at a path; if not, the first step that leads nowhere.
pub(crate) fn require(document: &mut DocumentMut, known: &KnownPath) -> Result<(), Stray> {
    let mut at = Found::Table(document.as_table_mut());
    for (k, step) in known.steps.iter().enumerate() {
        let stray = at.without(step, k == 1 && known.is_named);
        at = at.inner(step).ok_or(stray)?;
    }
    Ok(())
}

/// What a step leads to.
enum Found<'d> {
    Table(&'d mut dyn TableLike),
    Tables(&'d mut ArrayOfTables),
    Value(&'d mut Value),
}

impl<'d> Found<'d> {
    fn of(item: &'d mut Item) -> Option<Self> {
        match item {
            Item::None => None,
            Item::Table(table) => Some(Self::Table(table)),
            Item::ArrayOfTables(tables) => Some(Self::Tables(tables)),
            Item::Value(value) => Some(Self::of_value(value)),
        }
    }

    fn of_value(value: &'d mut Value) -> Self {
        match value {
            Value::InlineTable(table) => Self::Table(table),
            value => Self::Value(value),
        }
    }

    fn inner(self, step: &str) -> Option<Found<'d>> {
        match (self, step.parse::<usize>()) {
            (Self::Table(table), _) => table.get_mut(step).and_then(Found::of),
            (Self::Tables(list), Ok(k)) => list.get_mut(k).map(|table| Found::Table(table)),
            (Self::Value(Value::Array(list)), Ok(k)) => list.get_mut(k).map(Found::of_value),
            _ => None,
        }
    }

    /// What is said if a step is not here.
    fn without(&self, step: &str, is_name: bool) -> Stray {
        match self {
            Self::Table(table) if is_name => no_name(table.iter(), step),
            Self::Table(table) => {
                let expected = suggest::one_of(step, names(table.iter()).into_iter());
                Stray::new(format!("no `{step}` in the file"), expected)
            }
            Self::Tables(list) => Stray::entry(step, list.len()),
            Self::Value(Value::Array(list)) => Stray::entry(step, list.len()),
            Self::Value(value) => wrong_type(value, step),
        }
    }
}

fn names<'t>(entries: impl Iterator<Item = (&'t str, &'t Item)>) -> Vec<&'t str> {
    entries.map(|(key, _)| key).collect()
}

fn no_name<'t>(entries: impl Iterator<Item = (&'t str, &'t Item)>, name: &str) -> Stray {
    Stray::name(name, names(entries).into_iter())
}

/// Something else in the file than the path leads through.
fn wrong_type(value: &Value, step: &str) -> Stray {
    let name = value.type_name();
    let article = if name.starts_with(['a', 'i']) { "an" } else { "a" };
    let expected = if is_index(step) { "a list" } else { "a table" };
    Stray::new(format!("{article} {name} in the file"), expected)
}

/// A change on its way along its path.
#[derive(Clone, Copy)]
struct Change<'k> {
    known: &'k KnownPath,
    adds: Adds,
}

impl Change<'_> {
    /// Sets what the steps from `depth` on lead to.
    fn in_table(self, table: &mut dyn TableLike, depth: usize, value: Value) -> Result<(), Stray> {
        let steps = &self.known.steps;
        let key = steps[depth].as_str();
        let is_name = depth == 1 && self.known.is_named;
        if is_name && self.adds == Adds::Fixed && !table.contains_key(key) {
            return Err(no_name(table.iter(), key));
        }
        let Some(next) = steps.get(depth + 1) else {
            put(table, key, value, depth, self.known.end);
            return Ok(());
        };
        let is_in_list = is_index(next) && !(depth == 0 && self.known.is_named);
        if !table.contains_key(key) && is_in_list {
            let expected = format!("a list in the file to change, or {key}=[...]");
            return Err(Stray::new(format!("no `{key}` in the file"), expected));
        }
        if depth == 0 && self.known.is_named && self.adds == Adds::Fixed && !table.contains_key(key)
        {
            return Err(Stray::name(next, std::iter::empty()));
        }
        let item = table.entry(key).or_insert_with(|| missing_table(depth, self.known.is_named));
        match Found::of(item) {
            Some(found) => self.within(found, depth + 1, value),
            None => Ok(()),
        }
    }

    fn within(self, found: Found<'_>, depth: usize, value: Value) -> Result<(), Stray> {
        let Some(step) = self.known.steps.get(depth) else { return Ok(()) };
        let stray = found.without(step, false);
        match found {
            Found::Table(table) => self.in_table(table, depth, value),
            Found::Value(Value::Array(list)) if depth + 1 == self.known.steps.len() => {
                let entry = step.parse().ok().and_then(|k: usize| list.get_mut(k)).ok_or(stray)?;
                put_value(entry, value);
                Ok(())
            }
            found => self.within(found.inner(step).ok_or(stray)?, depth + 1, value),
        }
    }
}

/// `[kind]` of tables with names is not written, other tables of the file are; deeper ones are written in braces.
fn missing_table(depth: usize, is_named: bool) -> Item {
    if depth > usize::from(is_named) {
        return Item::Value(Value::InlineTable(InlineTable::new()));
    }
    let mut table = Table::new();
    table.set_implicit(is_named && depth == 0);
    Item::Table(table)
}

/// Sets a key; the blanks and the comments round what stood there stay. Near the root a table gets a header of its own.
fn put(table: &mut dyn TableLike, key: &str, value: Value, depth: usize, end: End) {
    let headed = if end == End::Collection { depth == 0 } else { depth < 2 };
    match value {
        Value::InlineTable(inline) if headed => {
            let mut inner = with_header(inline);
            if end == End::Collection {
                inner.set_implicit(true);
                for (_, item) in inner.iter_mut() {
                    if let Some(inline) = item.as_inline_table() {
                        *item = Item::Table(with_header(inline.clone()));
                    }
                }
            }
            if let Some(old) = table.get(key).and_then(Item::as_table) {
                inner.set_position(old.position());
                *inner.decor_mut() = old.decor().clone();
            }
            table.insert(key, Item::Table(inner));
        }
        mut value => match table.get_mut(key) {
            Some(Item::Value(old)) => put_value(old, value),
            Some(old) => {
                value.decor_mut().clear();
                *old = Item::Value(value);
            }
            None => {
                value.decor_mut().clear();
                table.insert(key, Item::Value(value));
            }
        },
    }
}

fn with_header(inline: InlineTable) -> Table {
    let mut table = inline.into_table();
    table.decor_mut().clear();
    table
}

/// Puts a value where another one stood.
fn put_value(at: &mut Value, mut value: Value) {
    *value.decor_mut() = at.decor().clone();
    *at = value;
}
