//! Where a run comes from: what a reader needs to make it again.

use std::fs;
use std::time::SystemTime;

use chrono::{DateTime, SecondsFormat, Utc};
use serde_json::{Value, json};

/// The scenario's name as it was given, what was changed of it, when the run started (UTC), and on what kind of machine.
pub fn provenance(scenario: &str, overrides: &[String], started: SystemTime) -> Value {
    json!({
        "scenario": scenario,
        "overrides": overrides,
        "started": DateTime::<Utc>::from(started).to_rfc3339_opts(SecondsFormat::Secs, true),
        "machine": machine(),
    })
}

/// System, architecture, and the processor where the system tells its name.
fn machine() -> String {
    let (system, architecture) = (std::env::consts::OS, std::env::consts::ARCH);
    match processor() {
        Some(name) => format!("{system} {architecture}, {name}"),
        None => format!("{system} {architecture}"),
    }
}

fn processor() -> Option<String> {
    let text = fs::read_to_string("/proc/cpuinfo").ok()?;
    let line = text.lines().find(|line| line.starts_with("model name"))?;
    Some(line.split_once(':')?.1.trim().to_owned())
}
