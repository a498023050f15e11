//! The JSON Schema and the reader come from the same declarations.

use percuss_scenario::{read, schema, templates};

#[test]
fn every_key_has_a_description() {
    fn walk(value: &serde_json::Value, count: &mut usize) {
        if let Some(properties) = value.get("properties").and_then(|p| p.as_object()) {
            for (name, property) in properties {
                let about = property["description"].as_str().unwrap_or_default();
                assert!(!about.is_empty(), "{name} has no description");
                *count += 1;
            }
        }
        match value {
            serde_json::Value::Object(map) => map.values().for_each(|v| walk(v, count)),
            serde_json::Value::Array(items) => items.iter().for_each(|v| walk(v, count)),
            _ => {}
        }
    }
    let mut count = 0;
    walk(&schema(), &mut count);
    assert!(count > 60, "{count}");
}

#[test]
fn required_keys_and_defaults_are_those_of_the_reader() {
    let schema = schema();
    assert_eq!(schema["required"], serde_json::json!(["time"]));
    let section = &schema["properties"]["section"]["additionalProperties"]["oneOf"][0];
    assert_eq!(section["required"], serde_json::json!(["area", "inertia"]));
    assert_eq!(section["properties"]["shape"]["const"], serde_json::json!("explicit"));
    assert_eq!(section["properties"]["rotary_inertia"]["default"], serde_json::json!(true));
    assert_eq!(section["additionalProperties"], serde_json::json!(false));
    let projectile = &schema["properties"]["projectile"]["additionalProperties"]["oneOf"];
    let words = |tag: &str| -> Vec<&str> {
        let kinds = projectile.as_array().unwrap().iter();
        kinds.map(|k| k["properties"][tag]["const"].as_str().unwrap_or("-")).collect()
    };
    // An elastic one by its law, and every one by where it touches.
    let [e, r, p, s] = ["elastic", "rigid", "point", "surface"];
    assert_eq!(words("kind"), [e, e, e, e, e, e, e, e, r, r]);
    assert_eq!(words("contact"), [p, s, p, s, p, s, p, s, p, s]);
    let laws = ["linear", "hertz", "table", "given", "-"].map(|law| [law; 2]);
    assert_eq!(words("law"), laws.as_flattened());
    let (point, surface) = (&projectile[8], &projectile[9]);
    assert_eq!(
        point["required"],
        serde_json::json!(["mass", "velocity", "kind", "restitution", "strikes"])
    );
    assert!(point["properties"].get("friction").is_none());
    assert!(surface["properties"].get("friction").is_some());
}

#[test]
fn written_out_templates_use_keys_of_the_schema_only() {
    fn check(value: &toml_edit::Item, schema: &serde_json::Value, path: &str) {
        let Some(table) = value.as_table() else { return };
        for (key, item) in table {
            let path = format!("{path}.{key}");
            let variants = schema["oneOf"].as_array().cloned().unwrap_or_default();
            let inner = [schema].into_iter().chain(&variants).find_map(|s| {
                let properties = s.get("properties").and_then(|p| p.get(key));
                properties.or(s.get("additionalProperties").filter(|a| a.is_object()))
            });
            check(item, inner.unwrap_or_else(|| panic!("{path} is not in the schema")), &path);
        }
    }
    for template in templates() {
        let text = read(template.text, template.name).unwrap().to_toml();
        let document: toml_edit::DocumentMut = text.parse().unwrap();
        check(document.as_item(), &schema(), "");
    }
}
