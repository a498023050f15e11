//! What leaves a run while it steps: rows of [`channels`], frames and checkpoints, handed to a recorder ([`record`]).

pub mod channels;
pub mod checkpoint;
pub mod frame;
pub mod record;
pub mod rows;
