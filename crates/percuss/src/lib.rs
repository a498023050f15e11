//! Percuss: impact on geometrically exact beams, with books that close.

mod analysis;
mod contact;
mod element;
mod error;
mod ledger;
mod linalg;
mod math;
mod model;
mod record;
mod scalar;
mod settings;
mod state;
mod step;
mod summary;

pub use analysis::{Simulation, natural_frequencies, simulate};
pub use error::Error;
pub use ledger::{Books, Measures};
pub use model::*;
pub use record::{Channel, Flow, MemoryRecorder, NoRecorder, Recorder, RecorderError};
pub use settings::{ImpactResolution, Scheme, Settings};
pub use state::{ProjectileState, State};
pub use step::newton::Effort;
pub use summary::*;
