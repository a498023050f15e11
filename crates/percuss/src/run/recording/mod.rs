//! Output of a run during its steps: rows of [`channels`], frames and checkpoints, for a recorder ([`record`]).

pub mod channels;
pub mod checkpoint;
mod columns;
pub mod frame;
pub mod record;
pub mod rows;
