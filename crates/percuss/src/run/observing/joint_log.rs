//! Joints of a given strength: their loads, and times of failure.

use serde::{Deserialize, Serialize};

use crate::model::Model;
use crate::model::frozen::{JointData, JointLoad};
use crate::summary::{JointParting, JointSummary, Peak};

/// Record of a joint.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct JointRecord {
    force: Peak,
    moment: Peak,
    parted: Option<JointParting>,
}

impl Default for JointRecord {
    fn default() -> Self {
        let none = Peak { value: 0.0, time: f64::NAN };
        Self { force: none, moment: none, parted: None }
    }
}

impl JointRecord {
    /// For a joint at the start of a run, torn in the initial equilibrium or intact.
    pub fn starting(torn: bool, time: f64) -> Self {
        let (force, moment) = (f64::NAN, f64::NAN);
        let parted = torn.then_some(JointParting { time, force, moment });
        Self { parted, ..Self::default() }
    }

    fn take(&mut self, load: &JointLoad, time: f64) {
        for (peak, value) in [(&mut self.force, load.force), (&mut self.moment, load.moment)] {
            if value > peak.value {
                *peak = Peak { value, time };
            }
        }
    }
}

/// Enters the loads of joints in a part of a step that ends at `time`: joints beyond their strength fail.
pub fn note(model: &Model, time: f64, loads: &[JointLoad], records: &mut [JointRecord]) {
    for ((joint, load), record) in model.joints.iter().zip(loads).zip(records) {
        if record.parted.is_some() {
            continue;
        }
        record.take(load, time);
        if joint.parts_under(load) {
            let JointLoad { force, moment } = *load;
            record.parted = Some(JointParting { time, force, moment });
        }
    }
}

/// Results of a run, one entry per joint with a strength.
pub fn summaries(model: &Model, records: &[JointRecord]) -> Vec<JointSummary> {
    let one = |(joint, record): (&JointData, &JointRecord)| JointSummary {
        name: joint.name.clone(),
        force_max: record.force,
        moment_max: record.moment,
        parted: record.parted,
    };
    model.joints.iter().zip(records).map(one).collect()
}
