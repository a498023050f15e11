//! Largest values with their times.

use percuss::Peak;
use serde_json::{Value, json};

pub(super) fn peak(peak: &Peak) -> Value {
    json!({ "value": peak.value, "time": peak.time })
}
