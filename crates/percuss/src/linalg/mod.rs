//! Linear algebra that knows nothing of beams.

pub mod block;
pub mod chain;
pub mod dense;
