//! Linear algebra, independent of beams.

pub mod block;
pub mod chain;
pub mod cluster;
pub mod complementarity;
pub mod condensed;
pub mod dense;
pub mod elimination;
pub mod gauss_jordan;
pub mod ordering;
pub mod schur;
pub mod sparse;
pub mod wide_block;
