//! Linear algebra that knows nothing of beams.

pub mod block;
pub mod chain;
pub mod condensed;
pub mod dense;
pub mod sparse;
