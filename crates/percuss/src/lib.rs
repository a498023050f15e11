//! Percuss: impact on geometrically exact beams, with books that close.

mod error;
mod model;
mod record;
mod settings;
mod summary;

pub use error::Error;
pub use model::*;
pub use record::{Channel, Flow, MemoryRecorder, NoRecorder, Recorder, RecorderError};
pub use settings::{ImpactResolution, Scheme, Settings};
pub use summary::*;

impl Settings {
    /// Checks the settings; paths are those of the scenario file (`time.step`).
    pub fn validate(&self, model: &Model) -> Vec<Fault> {
        let _ = model;
        Vec::new()
    }
}

/// Simulates `model` under `settings`, handing rows to `recorder`.
pub fn simulate(model: &Model, settings: &Settings, recorder: &mut dyn Recorder) -> RunSummary {
    let _ = (model, settings, recorder);
    unimplemented!()
}
