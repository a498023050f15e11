//! Percuss: impact on geometrically exact beams, with books that close.

mod element;
mod error;
mod linalg;
mod math;
mod model;
mod record;
mod scalar;
mod settings;
mod summary;

pub use error::Error;
pub use model::*;
pub use record::{Channel, Flow, MemoryRecorder, NoRecorder, Recorder, RecorderError};
pub use settings::{ImpactResolution, Scheme, Settings};
pub use summary::*;

/// Simulates `model` under `settings`, handing rows to `recorder`.
pub fn simulate(model: &Model, settings: &Settings, recorder: &mut dyn Recorder) -> RunSummary {
    let _ = (model, settings, recorder);
    unimplemented!()
}
