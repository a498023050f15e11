//! A file with every key: it reads, is written back the same, and is what the schema describes.

use percuss_scenario::{load, read, schema};
use serde_json::{Value as Json, json};

fn everything() -> percuss_scenario::Scenario {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/files/everything.toml");
    load(path).unwrap_or_else(|e| panic!("{e}"))
}

#[test]
fn a_file_with_every_key_reads_back_the_same_from_anywhere() {
    let scenario = everything();
    let written = scenario.to_toml();
    let again = read(&written, "elsewhere.toml").unwrap_or_else(|e| panic!("{written}\n{e}"));
    assert_eq!(again.content(), scenario.content());
    assert_eq!(again.to_toml(), written);
}

#[test]
fn files_it_names_are_written_out() {
    let written = everything().to_toml();
    assert!(!written.contains(".csv"), "{written}");
    for line in [
        "preset = \"steel\"",
        "young = 2.1e11  # Pa",
        "density = 8000  # kg/m^3",
        "points = [[0, 0], [1, 0.25], [2, 0.25], [3, 0]]  # m",
        "function = { kind = \"table\", times = [0, 0.002, 0.005, 0.01], \
         values = [0, 1, 0.4, 0], smooth = true }",
        "function = \"constant\"",
        "grading = { towards = \"0.75 m\", ratio = 4 }",
        "changes = [{ at = 0.25, section = \"case\" }, \
         { at = \"3.5 m\", section = \"plain\", material = \"wood\" }, \
         { at = 1, material = \"steel\" }]",
        "stretch = [0, \"1.5 m\"]",
        "between = [\"bent@2m\", [-1, 0.5]]",
        "until = { point = \"arch.mid\", component = 2, value = -0.1 }",
        "modes = 6",
        "rear = { mass = 3, stiffness = 2e6, damping = 10 }",
        "rebound = { restitution = 0.7, velocity = 2 }",
        "hertz_stiffness = 5e8  # N/m^1.5",
        "strikes = [\"rail.mid\", \"floor\"]",
        "position = [1, 0.5]  # m",
        "impact_law = \"moreau\"",
        "motion = { displacement = [0, 0.005], \
         function = { kind = \"harmonic\", frequency = 20, phase = 0 } }",
        "sides = \"left\"",
        "hertz = { young = [2.1e11, 7e10], poisson = [0.3, 0.33], \
         radius = [0.03, \"flat\"] }",
        "penetrations = [0, 0.001, 0.005]  # m",
        "forces = [0, 2000, 2500]  # N",
        "points_per_element = 2",
    ] {
        assert!(written.lines().any(|l| l == line), "`{line}` is not in\n{written}");
    }
}

#[test]
fn every_key_of_the_schema_stands_in_it() {
    let written = everything().to_toml();
    let document: toml_edit::DocumentMut = written.parse().unwrap();
    let text = concat!(include_str!("../files/everything.toml"), "\n");
    let source: toml_edit::DocumentMut = text.parse().unwrap();
    let (mut known, mut given) = (Vec::new(), Vec::new());
    keys(&schema(), &mut known);
    for document in [document, source] {
        names(&to_json(document.as_item()), &mut given);
    }
    // A factor and a displacement exclude each other, so do a step and an accuracy.
    let other = |key: &str| matches!(key, "factor" | "accuracy");
    let missing: Vec<_> = known.iter().filter(|k| !given.contains(k) && !other(k)).collect();
    assert!(missing.is_empty(), "{missing:?}");
}

#[test]
fn a_file_with_every_key_is_valid_by_the_schema_before_and_after() {
    let schema = schema();
    for text in [include_str!("../files/everything.toml").to_string(), everything().to_toml()] {
        let document: toml_edit::DocumentMut = text.parse().unwrap();
        check(&to_json(document.as_item()), &schema).unwrap_or_else(|e| panic!("{e}"));
    }
    for (text, why) in [
        ("[beam.b]\npoints = 3", "Points of the centre line"),
        ("[beam.b]\nelemets = 3", "elemets"),
        ("[material.m]\nyoung = 1", "density"),
        ("[load.l]\nkind = \"point\"\nat = \"b.mid\"\nfunction = { kind = \"ramp\" }", "function"),
        (
            "[support.s]\nkind = \"stop\"\nat = \"b.mid\"\nstiffness = [1, 2]\ndirection = [1, 0]",
            "",
        ),
        ("[section.s]\nshape = \"tube\"\ndiameter = 1", "section"),
        ("[material.m]\npreset = \"stele\"", "A material or grade by name"),
    ] {
        let document: toml_edit::DocumentMut =
            format!("{text}\n[time]\nend = 1\nstep = 1\n").parse().unwrap();
        let fault = check(&to_json(document.as_item()), &schema).expect_err(text);
        assert!(fault.contains(why), "{text}: {fault}");
    }
}

#[test]
fn faults_of_the_core_land_on_their_lines() {
    let scenario = everything();
    let text = include_str!("../files/everything.toml");
    let line_of = |table: &str, key: &str| {
        let from = text.find(&format!("[{table}]\n")).expect(table);
        let at = from + text[from..].find(&format!("\n{key} = ")).expect(key) + 1;
        text[..at].matches('\n').count() + 1
    };
    for (table, key) in [
        ("material.steel", "retardation"),
        ("section.taper", "stations"),
        ("beam.arch", "element_length"),
        ("beam.arch", "curve"),
        ("beam.arch", "points"),
        ("beam.bent", "elements"),
        ("beam.bent", "changes"),
        ("beam.bent", "grading"),
        ("support.soft", "stiffness"),
        ("support.foot", "motion"),
        ("support.foot", "until"),
        ("load.snow", "stretch"),
        ("load.push", "function"),
        ("spring.stay", "between"),
        ("mass.bob", "at"),
        ("damping", "modal"),
        ("projectile.marble", "radius"),
        ("projectile.puck", "friction"),
        ("obstacle.bracket", "gap"),
        ("contact.arch-fence", "between"),
    ] {
        let fault = percuss::Fault::new(format!("{table}.{key}"), "this", "that");
        let all = scenario.diagnostics(vec![fault]);
        assert_eq!(all.all()[0].line, line_of(table, key), "{all}");
    }
}

#[test]
fn faults_of_discs_contacts_and_laws_land_on_the_keys_of_the_file() {
    let scenario = everything();
    for (path, key) in [
        ("disc.marble.radius", "projectile.marble.radius"),
        ("disc.puck.position", "projectile.puck.position"),
        ("contact.puck-marble.friction", "projectile.puck.friction"),
        ("contact.marble-rail.between", "projectile.marble.strikes"),
        ("contact.marble-floor.stiffness", "projectile.marble.hertz_stiffness"),
        ("contact.marble-floor.dissipation", "projectile.marble.rebound"),
        ("contact.rail-post.dissipation", "contact.rail-post.dissipation"),
        ("contact.arch-fence.restitution", "contact.arch-fence.restitution"),
        ("contact.rail-post.stiffness", "contact.rail-post.stiffness"),
        ("contact.rail-bracket.stiffness", "contact.rail-bracket.hertz"),
        ("contact.frame-rail.penetration", "contact.frame-rail.penetrations"),
        ("contact.frame-rail.force", "contact.frame-rail.forces"),
        ("contact.marble-floor", "projectile.marble"),
    ] {
        let all = scenario.diagnostics(vec![percuss::Fault::new(path, "this", "that")]);
        assert_eq!(all.all()[0].path, key);
        assert!(all.all()[0].line > 1, "{all}");
    }
}

/// Every key that the schema knows, at any depth.
fn keys(schema: &Json, out: &mut Vec<String>) {
    match schema {
        Json::Object(map) => {
            for (key, value) in map {
                if key == "properties" {
                    out.extend(value.as_object().unwrap().keys().cloned());
                }
                keys(value, out);
            }
        }
        Json::Array(items) => items.iter().for_each(|i| keys(i, out)),
        _ => {}
    }
}

/// Every key of a file, at any depth.
fn names(value: &Json, out: &mut Vec<String>) {
    match value {
        Json::Object(map) => {
            for (key, value) in map {
                out.push(key.clone());
                names(value, out);
            }
        }
        Json::Array(items) => items.iter().for_each(|i| names(i, out)),
        _ => {}
    }
}

fn to_json(item: &toml_edit::Item) -> Json {
    use toml_edit::{Item, Value};
    fn table(table: &dyn toml_edit::TableLike) -> Json {
        table.iter().map(|(k, v)| (k.to_string(), to_json(v))).collect()
    }
    match item {
        Item::Value(Value::String(s)) => json!(s.value()),
        Item::Value(Value::Integer(n)) => json!(n.value()),
        Item::Value(Value::Float(n)) => json!(n.value()),
        Item::Value(Value::Boolean(b)) => json!(b.value()),
        Item::Value(Value::Array(items)) => {
            items.iter().map(|v| to_json(&Item::Value(v.clone()))).collect()
        }
        other => table(other.as_table_like().expect("no dates")),
    }
}

/// Whether a value is what a schema describes, as far as this schema uses the language.
fn check(value: &Json, schema: &Json) -> Result<(), String> {
    let wrong = |what: &str| Err(format!("{value} against {what} of {schema}"));
    for (word, rule) in schema.as_object().unwrap() {
        let list = || rule.as_array().cloned().unwrap_or_default();
        match word.as_str() {
            "type" => {
                let kind = match value {
                    Json::Null => "null",
                    Json::Bool(_) => "boolean",
                    Json::Number(n) if n.is_i64() => "integer",
                    Json::Number(_) => "number",
                    Json::String(_) => "string",
                    Json::Array(_) => "array",
                    Json::Object(_) => "object",
                };
                let fits = |k: &Json| k == kind || (k == "number" && kind == "integer");
                if !fits(rule) && !list().iter().any(fits) {
                    return wrong("type");
                }
            }
            "const" if value != rule => return wrong("const"),
            "enum" if !list().contains(value) => return wrong("enum"),
            "oneOf" if list().iter().filter(|s| check(value, s).is_ok()).count() != 1 => {
                return wrong("oneOf");
            }
            "anyOf" if !list().iter().any(|s| check(value, s).is_ok()) => return wrong("anyOf"),
            "items" => {
                value.as_array().into_iter().flatten().try_for_each(|v| check(v, rule))?;
            }
            "minItems" if value.as_array().unwrap().len() < rule.as_u64().unwrap() as usize => {
                return wrong("minItems");
            }
            "maxItems" if value.as_array().unwrap().len() > rule.as_u64().unwrap() as usize => {
                return wrong("maxItems");
            }
            "minimum" if value.as_f64() < rule.as_f64() => return wrong("minimum"),
            "required" => {
                if let Some(absent) =
                    list().iter().find(|k| value.get(k.as_str().unwrap()).is_none())
                {
                    return wrong(&format!("{absent}"));
                }
            }
            "properties" | "additionalProperties" => {
                let known = |k: &String| schema["properties"].get(k).is_some();
                for (key, inner) in value.as_object().into_iter().flatten() {
                    match (rule, word.as_str()) {
                        (rule, "properties") if known(key) => check(inner, &rule[key])?,
                        (Json::Bool(false), _) if !known(key) => return wrong(key),
                        (Json::Object(_), "additionalProperties") if !known(key) => {
                            check(inner, rule)?;
                        }
                        _ => {}
                    }
                }
            }
            _ => {}
        }
    }
    Ok(())
}
