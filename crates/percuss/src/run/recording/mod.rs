//! Output of a run during its steps: rows of [`channels`], frames and checkpoints, for a recorder ([`record`]).

mod balances;
pub mod channels;
pub mod checkpoint;
pub mod frame;
mod now;
pub mod record;
pub mod rows;
