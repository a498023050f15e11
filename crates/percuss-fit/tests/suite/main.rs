//! Fits end to end.

mod common;
mod doubts;
mod faults;
mod found;
mod published;
mod twin;
