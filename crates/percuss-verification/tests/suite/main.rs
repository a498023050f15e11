//! All integration tests of the crate in one program: linking one for each file took gigabytes and minutes.

mod cases;
mod headlines;
mod pinned_bits;
