//! What foundations did.

use serde_json::Value;

use super::words::{instant, place, quantity};

/// Largest reaction, lift-off and yielding of the foundation that reacts most.
pub(super) fn foundations(summary: &Value) -> Option<String> {
    let all = summary["foundation"].as_object()?;
    let pressure = |one: &Value| one["pressure_max"]["value"].as_f64().unwrap_or(0.0);
    let (name, most) =
        all.iter().max_by(|a, b| pressure(a.1).abs().total_cmp(&pressure(b.1).abs()))?;
    if pressure(most) == 0.0 {
        return None; // a foundation of damping alone, or one that was never touched
    }
    let peak = &most["pressure_max"];
    let (s, time) = (place(peak["s"].as_f64()), instant(peak["time"].as_f64()));
    let of = if all.len() > 1 { "foundations" } else { "foundation" };
    let largest = quantity(Some(pressure(most).abs()), "N/m");
    let pulls = if pressure(most) < 0.0 { ", tensile," } else { "" };
    let mut out =
        format!("Largest reaction of the {of}: {largest}{pulls} in '{name}' at {s}, {time}");
    if let Some(lifted) = most["lifted_max"]["value"].as_f64().filter(|lifted| *lifted > 0.0) {
        out.push_str(&format!("; lift-off over up to {}", quantity(Some(lifted), "m")));
    }
    if let Some(plastic) = most["plastic_deflection"]["value"].as_f64() {
        let lost = quantity(most["dissipated"].as_f64(), "J");
        let plastic = quantity(Some(plastic), "m");
        out.push_str(&format!("; plastic deflection {plastic}, {lost} dissipated"));
    }
    out.push('.');
    Some(out)
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn the_sentence_is_of_the_foundation_that_reacts_most() {
        let of = |pressure: f64, lifted: f64, plastic: Value| {
            json!({
                "pressure_max": { "value": pressure, "s": 2.0, "time": 5e-3 },
                "lifted_max": { "value": lifted, "time": 0.0 },
                "plastic_deflection": plastic,
                "dissipated": 40.0,
            })
        };
        let sentence = |all: Value| foundations(&all).map(|text| text.replace('\u{a0}', " "));
        assert_eq!(sentence(json!({})), None);
        assert_eq!(
            sentence(json!({ "foundation": { "damper": of(0.0, 0.0, Value::Null) } })),
            None
        );
        let soft = of(-2e3, 0.0, Value::Null);
        let text = sentence(json!({ "foundation": { "pad": soft } })).unwrap();
        assert!(
            text.starts_with("Largest reaction of the foundation: 2000 N/m, tensile, in 'pad'"),
            "{text}"
        );
        assert!(!text.contains("lift-off") && !text.contains("plastic"), "{text}");
        let hard = of(3e4, 1.5, json!({ "value": 4e-3, "s": 2.0, "time": 0.1 }));
        let text = sentence(json!({ "foundation": { "pad": soft, "bed": hard } })).unwrap();
        assert!(
            text.starts_with("Largest reaction of the foundations: 30 kN/m in 'bed'"),
            "{text}"
        );
        assert!(text.contains("in 'bed'") && text.contains("lift-off over up to 1.5"), "{text}");
        assert!(
            text.contains("plastic deflection 4") && text.contains("40 J dissipated"),
            "{text}"
        );
    }
}
