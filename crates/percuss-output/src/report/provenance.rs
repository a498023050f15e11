//! Where a run comes from: scenario, changes made to it, program, date and machine.

use serde_json::Value;

use super::html::table;

/// A table of what is known; nothing of runs that do not say.
pub(super) fn render(summary: &Value) -> String {
    let from = &summary["provenance"];
    let text = |key: &str| from[key].as_str().map(str::to_owned);
    let overrides = from["overrides"].as_array().filter(|list| !list.is_empty());
    let overrides = overrides.map(|list| {
        let each: Vec<&str> = list.iter().filter_map(Value::as_str).collect();
        each.join(", ")
    });
    let version = summary["percuss_version"].as_str().map(|v| format!("Percuss {v}"));
    let rows = [
        ("scenario", text("scenario")),
        ("overrides (--set)", overrides),
        ("program", version),
        ("started", text("started")),
        ("machine", text("machine")),
    ];
    let known = rows.into_iter().filter_map(|(label, value)| Some(vec![label.to_owned(), value?]));
    table("Provenance", &[], &known.collect::<Vec<_>>())
}
