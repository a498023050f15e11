//! Values that name another table of the file.

use std::marker::PhantomData;

use serde_json::{Value as Json, json};

use crate::code::FaultCode;
use crate::format::{Format, Inline, Text};
use crate::node::{Node, Reader};
use crate::preset::Presets;
use crate::profile::{self, SteelProfile};
use crate::suggest;
use crate::words::Words;
use crate::write;

/// A kind of table that others refer to by name.
pub(crate) trait Kind: 'static {
    /// Its name in the file.
    const NAME: &'static str;

    /// Whether a name is known without a table of its own.
    fn is_known(_: &str) -> bool {
        false
    }

    /// What may be meant of what is known without a table.
    fn near(_: &str) -> Option<String> {
        None
    }

    /// What was found and expected of a name that can only be meant for something known without a table.
    fn clash(_: &str) -> Option<(String, String)> {
        None
    }
}

/// `beam`.
pub(crate) struct BeamName;
/// `material`.
pub(crate) struct MaterialName;
/// `section`.
pub(crate) struct SectionName;

impl Kind for BeamName {
    const NAME: &'static str = "beam";
}

/// Materials known by name need no table.
impl Kind for MaterialName {
    const NAME: &'static str = "material";

    fn is_known(name: &str) -> bool {
        Presets::named(name).is_some()
    }

    fn near(name: &str) -> Option<String> {
        suggest::nearest(name, Presets::WORDS.iter().map(|word| word.0))
            .map(|near| format!("the preset `{near}`"))
    }
}

/// Steel profiles need no table.
impl Kind for SectionName {
    const NAME: &'static str = "section";

    fn is_known(name: &str) -> bool {
        SteelProfile::find(name).is_some()
    }

    fn near(name: &str) -> Option<String> {
        profile::near(name).first().map(|near| format!("the profile `{near}`"))
    }

    fn clash(name: &str) -> Option<(String, String)> {
        let (found, expected) = profile::clash(name)?;
        Some((found, format!("{expected}; or the name of a section")))
    }
}

/// The name of a table of some kind.
pub(crate) struct NameOf<K>(PhantomData<K>);

impl<K: Kind> Format for NameOf<K> {
    type Value = String;

    fn read(node: &Node<'_>, reader: &mut Reader<'_>) -> Option<String> {
        let name = Text::read(node, reader)?;
        if K::is_known(&name) || reader.knows(K::NAME, &name) {
            return Some(name);
        }
        // A section of the file that is called so but for a letter is meant rather than a profile.
        let alike = suggest::nearest(&name, reader.names(K::NAME).iter().copied()).is_some();
        if let Some((found, expected)) = K::clash(&name).filter(|_| !alike) {
            reader.wrong_as(FaultCode::UnknownName, node, found, expected);
            return None;
        }
        known_name_or(K::NAME, &name, K::near(&name), node, reader).then_some(name)
    }

    fn placeholder() -> String {
        String::new()
    }

    fn expected() -> String {
        format!("the name of a {}", K::NAME)
    }

    fn schema() -> Json {
        json!({ "type": "string" })
    }
}

impl<K: Kind> Inline for NameOf<K> {
    fn text(value: &String) -> Option<String> {
        Some(write::text(value))
    }
}

/// Whether a table of that kind has that name; tells the reader otherwise.
pub(crate) fn known_name(kind: &str, name: &str, node: &Node<'_>, reader: &mut Reader<'_>) -> bool {
    known_name_or(kind, name, None, node, reader)
}

/// The same, where something known without a table may be meant instead.
fn known_name_or(
    kind: &str,
    name: &str,
    near: Option<String>,
    node: &Node<'_>,
    reader: &mut Reader<'_>,
) -> bool {
    if reader.knows(kind, name) {
        return true;
    }
    let expected = if reader.names(kind).is_empty() {
        format!("a table [{kind}.{}]", write::key(name))
    } else {
        suggest::one_of(name, reader.names(kind).iter().copied())
    };
    let expected = near.map_or(expected.clone(), |near| format!("{expected}, or {near}"));
    let found = format!("the unknown {kind} {name:?}");
    reader.misplaced_as(FaultCode::UnknownName, &node.path, node.span.clone(), (found, expected));
    false
}
