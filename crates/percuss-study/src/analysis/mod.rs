//! What came out of a study: sensitivities, distributions, response curves.

mod bootstrap;
mod confidence;
mod population;
mod sobol;
mod spread;

pub use bootstrap::Estimate;
pub use confidence::share_interval;
pub use population::Population;
pub use sobol::{NoIndices, SobolIndices, sobol_indices, sobol_indices_of};
pub use spread::{Histogram, Spread};
