//! How a run ended, in one line: on its page, beside other runs, and in the terminal.

use serde_json::Value;

use super::quantity::quantity;
use super::warnings;

/// How a run ended.
#[derive(Clone, Debug, Eq, PartialEq)]
pub struct RunState {
    /// State and the time that was reached: `Completed, t = 1.4 s`.
    pub words: String,
    /// Number of warnings that the scenario does not allow, equal ones counted once.
    pub warnings: usize,
}

impl RunState {
    /// State of the run with this `summary.json`.
    pub fn of(summary: &Value) -> Self {
        Self { words: words(summary), warnings: warnings::number(summary) }
    }

    /// The number of warnings in words: `4 warnings`, `no warnings`.
    pub fn warnings_in_words(&self) -> String {
        match self.warnings {
            0 => "no warnings".to_owned(),
            1 => "1 warning".to_owned(),
            n => format!("{n} warnings"),
        }
    }
}

fn words(summary: &Value) -> String {
    let time = quantity(summary["time"].as_f64(), "s");
    match summary["status"].as_str().unwrap_or("unknown") {
        "completed" => format!("Completed, t = {time}"),
        "interrupted" => {
            format!("Interrupted at t = {time}: results up to the last accepted step")
        }
        "failed" => {
            let why = if summary["error_code"] == "E101" { " (no convergence)" } else { "" };
            format!("Stopped{why} at t = {time}: results up to the last accepted step")
        }
        "unsolved" => "Not solved".to_owned(),
        other => other.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn state(summary: &Value) -> [String; 2] {
        let state = RunState::of(summary);
        [state.words.replace('\u{a0}', " "), state.warnings_in_words()]
    }

    #[test]
    fn a_state_gives_the_time_in_its_unit_and_counts_what_is_not_allowed() {
        let one = |verdict: &str, code: &str| json!({ "verdict": verdict, "code": code });
        let mut summary = json!({
            "status": "completed", "time": 6.337e-4,
            "advice": [one("fine", "W001"), one("warning", "W002"), one("allowed", "W003")],
            "warnings": [one("warning", "W101"), one("allowed", "W102")],
        });
        assert_eq!(state(&summary), ["Completed, t = 633.7 \u{b5}s", "2 warnings"]);
        summary["warnings"] = json!([]);
        assert_eq!(state(&summary)[1], "1 warning");
        summary["advice"] = json!([]);
        assert_eq!(state(&summary)[1], "no warnings");
    }

    #[test]
    fn a_state_says_where_the_results_end() {
        let of = |status: &str, code: &str| {
            let [words, _] = state(&json!({ "status": status, "time": 0.02, "error_code": code }));
            words
        };
        let end = "at t = 20 ms: results up to the last accepted step";
        assert_eq!(of("interrupted", ""), format!("Interrupted {end}"));
        assert_eq!(of("failed", "E101"), format!("Stopped (no convergence) {end}"));
        assert_eq!(of("failed", "E108"), format!("Stopped {end}"));
        assert_eq!(of("unsolved", ""), "Not solved");
    }
}
