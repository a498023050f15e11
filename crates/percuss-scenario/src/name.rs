//! Values that name another table of the file.

use std::marker::PhantomData;

use serde_json::{Value as Json, json};

use crate::code::FaultCode;
use crate::format::{Format, Inline, Text};
use crate::node::{Node, Reader};
use crate::suggest;
use crate::write;

/// A kind of table that others refer to by name.
pub(crate) trait Kind: 'static {
    /// Its name in the file.
    const NAME: &'static str;
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

impl Kind for MaterialName {
    const NAME: &'static str = "material";
}

impl Kind for SectionName {
    const NAME: &'static str = "section";
}

/// The name of a table of some kind.
pub(crate) struct NameOf<K>(PhantomData<K>);

impl<K: Kind> Format for NameOf<K> {
    type Value = String;

    fn read(node: &Node<'_>, reader: &mut Reader<'_>) -> Option<String> {
        let name = Text::read(node, reader)?;
        known_name(K::NAME, &name, node, reader).then_some(name)
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
    if reader.knows(kind, name) {
        return true;
    }
    let expected = if reader.names(kind).is_empty() {
        format!("a table [{kind}.{}]", write::key(name))
    } else {
        suggest::one_of(name, reader.names(kind).iter().copied())
    };
    let found = format!("the unknown {kind} {name:?}");
    reader.misplaced_as(FaultCode::UnknownName, &node.path, node.span.clone(), (found, expected));
    false
}
