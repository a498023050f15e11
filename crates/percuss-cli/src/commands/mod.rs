//! The commands, one file each.

pub mod animate;
pub mod book;
pub mod check;
pub mod completions;
pub mod converge;
pub mod eval;
pub mod explain;
pub mod export;
pub mod fit;
pub mod man;
pub mod modes;
pub mod new;
pub mod plot;
pub mod report;
pub mod run;
pub mod schema;
pub mod sensitivity;
pub mod serve;
pub mod spectrum;
pub mod statics;
pub mod sweep;
pub mod verify;
