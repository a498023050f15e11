//! What came out of a study: sensitivities, distributions, response curves.

mod bootstrap;
mod sobol;
mod spread;

pub use bootstrap::Estimate;
pub use sobol::{SobolIndices, sobol_indices, sobol_indices_of};
pub use spread::{Histogram, Spread};
