//! Points and results as JSON: `{"speed": 20}` in, `{"results": {"force": 3e5}}` out.

use serde_json::{Map, Value, json};

use super::asked::{Answered, Asked};

/// A point by the names of its parameters.
pub fn read(text: &str) -> Result<Asked, String> {
    let value = crate::json::read(text)?;
    let table = value.as_object().ok_or("expected names and numbers, such as {\"speed\": 20}")?;
    let number = |(name, value): (&String, &Value)| match value.as_f64() {
        Some(number) => Ok((name.clone(), number)),
        None => Err(format!("`{name}` is {value}: expected a number, in SI units")),
    };
    let variables = table.iter().map(number).collect::<Result<_, _>>()?;
    Ok(Asked { variables, functions: None, by: None })
}

/// Results by their names, and derivatives by those of the parameters.
pub fn formatted(all: &[Answered]) -> String {
    let values: Map<String, Value> =
        all.iter().filter_map(|f| Some((f.name.clone(), json!(f.value?)))).collect();
    let gradient = |f: &Answered| {
        let by: Map<String, Value> =
            f.gradient.as_ref()?.iter().map(|(name, d)| (name.clone(), json!(d))).collect();
        Some((f.name.clone(), Value::Object(by)))
    };
    let derivatives: Map<String, Value> = all.iter().filter_map(gradient).collect();
    let mut value = json!({ "results": values });
    if !derivatives.is_empty() {
        value["derivatives"] = Value::Object(derivatives);
        value["means"] = json!(all.iter().find_map(|f| f.means.as_ref()));
    }
    let open: Vec<&str> = all.iter().filter(|f| f.open).map(|f| f.name.as_str()).collect();
    if !open.is_empty() {
        value["not_final"] = json!(open);
    }
    format!("{value:#}\n")
}

/// Why there are none.
pub fn failed(why: &str) -> String {
    format!("{:#}\n", json!({ "error": why }))
}
