//! JSON Schema of the scenario file, from the declarations that also read it.

use serde_json::{Map, Value as Json, json};

use crate::content::Content;
use crate::table::{Key, Table};

/// JSON Schema of the scenario file, for completion in editors.
pub fn schema() -> Json {
    let mut schema = of_table::<Content>();
    schema["$schema"] = json!("http://json-schema.org/draft-07/schema#");
    schema["title"] = json!("Percuss scenario");
    schema
}

/// Schema of a table; one that comes in kinds is one of several objects.
pub(crate) fn of_table<T: Table>() -> Json {
    let Some(kinds) = T::kinds() else {
        let mut object = object(&T::about(), T::keys());
        let either: Vec<Json> =
            T::either().into_iter().map(|keys| json!({ "required": keys })).collect();
        if !either.is_empty() {
            object["anyOf"] = json!(either);
        }
        return object;
    };
    let common = T::keys;
    let variants = kinds.variants.into_iter().map(|variant| {
        let keys = common().into_iter().chain(variant.keys);
        let mut object = object(&variant.about, keys.collect());
        object["properties"][kinds.tag] =
            json!({ "const": variant.word, "description": kinds.about });
        if kinds.default != Some(variant.word)
            && let Some(required) = object["required"].as_array_mut()
        {
            required.insert(0, json!(kinds.tag));
        }
        object
    });
    json!({ "description": T::about(), "oneOf": variants.collect::<Vec<_>>() })
}

/// Schema of tables with the user's names.
pub(crate) fn of_collection<T: Table>() -> Json {
    json!({ "type": "object", "additionalProperties": of_table::<T>() })
}

fn object(about: &str, keys: Vec<Key>) -> Json {
    let required: Vec<&str> = keys.iter().filter(|k| k.required).map(|k| k.name).collect();
    let required = json!(required);
    let properties: Map<String, Json> =
        keys.into_iter().map(|key| (key.name.to_string(), property(key))).collect();
    json!({
        "type": "object",
        "description": about,
        "properties": properties,
        "required": required,
        "additionalProperties": false,
    })
}

fn property(key: Key) -> Json {
    let mut schema = (key.schema)();
    schema["description"] = json!(key.about);
    if let Some(default) = key.default.and_then(|text| text.parse::<toml_edit::Value>().ok()) {
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
