//! The elastic example in Percuss, for `benches/peers/run`: a case as JSON in, an answer as JSON out (`case.py` describes their content).

use percuss::*;
use percuss_bench::{Addition, varied};
use serde_json::{Value, json};

/// Output interval of a free beam, equal to the sampling interval of the other programs \[s\].
const SAMPLE: f64 = 0.05;

/// Processor time of the thread \[s\].
fn user_time() -> f64 {
    let text = std::fs::read_to_string("/proc/self/schedstat").expect("Linux");
    let nanoseconds = text.split_whitespace().next().and_then(|n| n.parse::<f64>().ok());
    nanoseconds.expect("a number") * 1e-9
}

fn main() {
    let text = std::env::args().nth(1).expect("a case");
    let case: Value = serde_json::from_str(&text).expect("a case as JSON");
    let number = |key: &str| case[key].as_f64().expect("a number");
    let free = case["free"].as_bool().unwrap_or(false);
    let elements = number("elements") as usize;
    let addition = if free { Addition::Unsupported } else { Addition::None };
    let model = varied(elements, addition);
    let mut settings = Settings::new(number("end"), number("step"));
    if free {
        settings.record_every = ((SAMPLE / settings.step).round() as usize).max(1);
    }
    let mut answer = Value::Null;
    let mut user = 0.0;
    for _ in 0..case["repeat"].as_u64().unwrap_or(1) {
        let start = user_time();
        let mut recorder = MemoryRecorder::default();
        let summary = simulate(&model, &settings, &mut recorder).expect("valid settings");
        user += user_time() - start;
        let intervals = &summary.contacts[0].record.intervals();
        let force = intervals.iter().map(|i| i.peak_force.value).fold(0.0, f64::max);
        answer = json!({
            "steps": summary.steps,
            "finished": matches!(summary.termination, Termination::Completed),
            "u_max": summary.points[0].displacement_max[1].value,
            "f_max": force,
            "energy_error": summary.energy.residual_max,
        });
    }
    answer["user"] = json!(user);
    println!("{answer}");
}
