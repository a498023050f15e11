//! Nothing given is ignored: every key of a number or a switch changes the model or the settings that are made of a file.

use std::collections::BTreeMap;

use percuss_scenario::read;
use toml_edit::{DocumentMut, Item, Value};

/// The folder of the file with every key, whose files it names.
const BASE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/files/everything.toml");

/// What that file has for the sake of its keys, and what makes a model of it.
const BUILDABLE: [(&str, &str); 5] = [
    ("  { at = \"end\", material = \"steel\" },\n", ""),
    ("length = \"1 m\"\nyield_force", "length = \"1.75 m\"\nyield_force"),
    ("[integrator]\nscheme = \"generalized-alpha\"\nspectral_radius = 0.8\n", ""),
    ("[support.ground]\nat = \"rail.start\"", "[support.ground]\nat = \"rail@0.9\""),
    ("between = [\"bent\", \"rail\"]", "between = [\"arch\", \"rail\"]"),
];

/// Other models with keys that the first one has no use for, by what is replaced in it.
const OTHERS: [&[(&str, &str)]; 6] = [
    // Shear moduli and factors belong to shear-flexible beams.
    &[
        ("curve = \"arc\"", "curve = \"arc\"\ntheory = \"shear\""),
        ("rotary_inertia = false", "rotary_inertia = true"),
    ],
    &[
        ("element_length = \"10 cm\"", "element_length = \"10 cm\"\ntheory = \"shear\""),
        ("section = \"taper\"", "section = \"plain\""),
        ("rotary_inertia = false", "rotary_inertia = true"),
    ],
    // Sections and materials that no beam has.
    &[
        ("section = \"taper\"", "section = \"rolled\""),
        ("material = \"wood\"\nsection = \"rolled\"", "material = \"mild\"\nsection = \"rolled\""),
    ],
    &[("section = \"taper\"", "section = \"layered\"")],
    &[("material = \"wood\"\nsection = \"taper\"", "material = \"tabled\"\nsection = \"joist\"")],
    &[("material = \"wood\"\nsection = \"taper\"", "material = \"concrete\"\nsection = \"case\"")],
];

/// Keys of which no single number can be another one, each with its reason.
const WITHOUT: [(&str, &str); 4] = [
    ("section.*.heights", "heights count from the centroid, which one of them would move"),
    ("section.*.areas", "likewise"),
    ("spring.*.yield_force", "beside a table of hardening it is that of the first row"),
    (
        "projectile.*.direction",
        "one that is not along the velocity is refused, and its length means nothing",
    ),
];

fn replaced(text: &str, changes: &[(&str, &str)]) -> String {
    changes.iter().fold(text.to_owned(), |text, (from, to)| {
        assert!(text.contains(from), "`{from}` is not in the file");
        text.replacen(from, to, 1)
    })
}

/// All that a file says of a computation.
fn made(text: &str) -> Result<String, String> {
    let scenario = read(text, BASE).map_err(|faults| faults.to_string())?;
    let compiled = scenario.compile().map_err(|faults| faults.to_string())?;
    Ok(format!(
        "{:?} {:?} {:?} {:?}",
        compiled.model, compiled.settings, compiled.path, compiled.comparison
    ))
}

/// A key or an entry of a list on the way to a value.
#[derive(Clone, Debug)]
enum Step {
    Key(String),
    Entry(usize),
}

/// The key of a value, with `*` for the name of its table: entries of lists have that of the list.
fn key_of(steps: &[Step]) -> String {
    let keys = steps.iter().filter_map(|step| match step {
        Step::Key(key) => Some(key.as_str()),
        Step::Entry(_) => None,
    });
    let named = steps.len() > 2 && matches!(steps[1], Step::Key(_)) && is_of_names(&steps[0]);
    let starred = keys.enumerate().map(|(k, key)| if k == 1 && named { "*" } else { key });
    starred.collect::<Vec<_>>().join(".")
}

/// Whether the tables in a table have names that users give.
fn is_of_names(table: &Step) -> bool {
    let Step::Key(key) = table else { return false };
    !["time", "record", "integrator", "damping", "impacts", "path", "initial"]
        .contains(&key.as_str())
}

/// Ways to every number and switch of a table.
fn leaves(item: &Item, way: &mut Vec<Step>, out: &mut Vec<Vec<Step>>) {
    if let Some(table) = item.as_table_like() {
        for (key, inner) in table.iter() {
            way.push(Step::Key(key.to_owned()));
            leaves(inner, way, out);
            way.pop();
        }
    } else if let Some(list) = item.as_array() {
        for (at, inner) in list.iter().enumerate() {
            way.push(Step::Entry(at));
            leaves(&Item::Value(inner.clone()), way, out);
            way.pop();
        }
    } else if item.as_value().is_some_and(|value| !others(value).is_empty()) {
        out.push(way.clone());
    }
}

/// Other values of the same kind.
fn others(value: &Value) -> Vec<Value> {
    let numbers = |x: f64| match x {
        0.0 => vec![1e-3, -1e-3],
        _ => vec![1.01 * x, 0.99 * x, 1.5 * x, 0.5 * x],
    };
    match value {
        Value::Integer(n) => {
            let n = *n.value();
            let whole = [n + 1, n - 1, 2 * n].map(Value::from);
            whole.into_iter().chain(numbers(n as f64).into_iter().map(Value::from)).collect()
        }
        Value::Float(x) => numbers(*x.value()).into_iter().map(Value::from).collect(),
        Value::Boolean(b) => vec![Value::from(!b.value())],
        Value::String(text) => {
            let text = text.value();
            let end = text.find(' ').unwrap_or(text.len());
            let Ok(x) = text[..end].parse::<f64>() else { return Vec::new() };
            let with_unit = |x: f64| Value::from(format!("{x}{}", &text[end..]));
            numbers(x).into_iter().map(with_unit).collect()
        }
        _ => Vec::new(),
    }
}

/// The value at the end of a way, if there is one.
fn at<'d>(document: &'d mut DocumentMut, way: &[Step]) -> Option<&'d mut Value> {
    let (mut item, mut rest) = (document.as_item_mut(), way);
    while let [Step::Key(key), then @ ..] = rest {
        item = item.get_mut(key.as_str())?;
        rest = then;
    }
    let mut value = item.as_value_mut()?;
    for step in rest {
        value = match step {
            Step::Entry(at) => value.as_array_mut()?.get_mut(*at)?,
            Step::Key(key) => value.as_inline_table_mut()?.get_mut(key)?,
        };
    }
    Some(value)
}

/// Whether some other value at the end of a way changes what is made; `None` where no other value can stand there.
fn is_heeded(text: &str, made_of: &str, way: &[Step]) -> Option<bool> {
    let base: DocumentMut = text.parse().unwrap();
    let own = at(&mut base.clone(), way)?.clone();
    let mut known = None;
    for other in others(&own) {
        let mut changed = base.clone();
        *at(&mut changed, way)? = other;
        if let Ok(other) = made(&changed.to_string()) {
            known = Some(other != made_of);
            if known == Some(true) {
                break;
            }
        }
    }
    known
}

#[test]
fn every_key_of_a_number_or_a_switch_changes_what_is_made_of_a_file() {
    let text = replaced(&std::fs::read_to_string(BASE).unwrap(), &BUILDABLE);
    let texts: Vec<String> =
        [text.clone()].into_iter().chain(OTHERS.map(|changes| replaced(&text, changes))).collect();
    let models: Vec<String> =
        texts.iter().map(|text| made(text).unwrap_or_else(|faults| panic!("{faults}"))).collect();
    let document: DocumentMut = text.parse().unwrap();
    let mut ways = Vec::new();
    leaves(document.as_item(), &mut Vec::new(), &mut ways);
    let mut keys: BTreeMap<String, Option<bool>> = BTreeMap::new();
    for way in &ways {
        let known = keys.entry(key_of(way)).or_default();
        for (text, made_of) in texts.iter().zip(&models) {
            if *known == Some(true) {
                break;
            }
            *known = is_heeded(text, made_of, way).or(*known);
        }
    }
    let all = |is: Option<bool>| -> Vec<&str> {
        let those = keys.iter().filter(|(_, found)| **found == is).map(|(key, _)| key.as_str());
        those.filter(|key| !WITHOUT.iter().any(|(known, _)| known == key)).collect()
    };
    let (ignored, fixed) = (all(Some(false)), all(None));
    println!("{} numbers and switches of {} keys", ways.len(), keys.len());
    assert!(ways.len() > 250, "{}", ways.len());
    assert!(ignored.is_empty(), "ignored: {ignored:#?}");
    assert!(fixed.is_empty(), "no other value possible: {fixed:#?}");
}
