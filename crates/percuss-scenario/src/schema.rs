//! JSON Schema of the scenario file, from the declarations that also read it.

use serde_json::{Map, Value as Json, json};

use crate::layout::{Key, Kinds, Layout, Variant};

/// Schema of a table; one that comes in kinds is one of several objects.
pub(crate) fn of_table(mut layout: Layout) -> Json {
    if !layout.choices.is_empty() {
        let about = std::mem::take(&mut layout.about);
        let objects = alternatives(&layout).into_iter().map(Object::finish);
        return json!({ "description": about, "oneOf": objects.collect::<Vec<_>>() });
    }
    let either: Vec<Json> = layout.either.iter().map(|keys| json!({ "required": keys })).collect();
    let mut object = Object::of(&layout).finish();
    if !either.is_empty() {
        object["anyOf"] = json!(either);
    }
    object
}

/// Schema of tables with the user's names.
pub(crate) fn of_collection(layout: Layout) -> Json {
    json!({ "type": "object", "additionalProperties": of_table(layout) })
}

/// A table in the making, of one kind.
#[derive(Clone)]
struct Object {
    about: String,
    properties: Map<String, Json>,
    /// Keys that must be there, shape (keys).
    required: Vec<&'static str>,
}

/// Every combination of kinds.
fn alternatives(layout: &Layout) -> Vec<Object> {
    let mut all = vec![Object::of(layout)];
    for kinds in &layout.choices {
        let of_kind = |variant: &Variant| {
            let mut inner = alternatives(&variant.layout);
            inner.iter_mut().for_each(|object| object.tag(kinds, variant.word));
            inner
        };
        let inner: Vec<Object> = kinds.variants.iter().flat_map(of_kind).collect();
        all = all.iter().flat_map(|outer| inner.iter().map(|i| outer.joined(i))).collect();
    }
    all
}

impl Object {
    fn of(layout: &Layout) -> Self {
        Self {
            about: layout.about.clone(),
            required: layout.keys.iter().filter(|k| k.required).map(|k| k.name).collect(),
            properties: layout.keys.iter().map(|k| (k.name.into(), property(k))).collect(),
        }
    }

    /// Adds the key that says of which kind it is.
    fn tag(&mut self, kinds: &Kinds, word: &str) {
        let schema = json!({ "const": word, "description": kinds.about });
        self.properties.insert(kinds.tag.into(), schema);
        let implied = kinds.implied.is_some_and(|(_, implied)| implied == word);
        if kinds.default != Some(word) && !implied {
            self.required.insert(0, kinds.tag);
        }
    }

    /// Both in one.
    fn joined(&self, other: &Self) -> Self {
        let mut out = self.clone();
        out.about = format!("{} {}", self.about, other.about).trim().to_string();
        out.properties.extend(other.properties.clone());
        out.required.extend(&other.required);
        out
    }

    fn finish(self) -> Json {
        json!({
            "type": "object",
            "description": self.about,
            "properties": self.properties,
            "required": self.required,
            "additionalProperties": false,
        })
    }
}

fn property(key: &Key) -> Json {
    let mut schema = (key.schema)();
    schema["description"] = json!(&key.about);
    if let Some(default) =
        key.default.as_ref().and_then(|text| text.parse::<toml_edit::Value>().ok())
    {
        schema["default"] = to_json(&default);
    }
    schema
}

fn to_json(value: &toml_edit::Value) -> Json {
    match value {
        toml_edit::Value::String(text) => json!(text.value()),
        toml_edit::Value::Integer(number) => json!(number.value()),
        toml_edit::Value::Float(number) => json!(number.value()),
        toml_edit::Value::Boolean(value) => json!(value.value()),
        toml_edit::Value::Array(items) => items.iter().map(to_json).collect(),
        _ => Json::Null,
    }
}
