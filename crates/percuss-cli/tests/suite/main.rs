//! All integration tests of the crate in one program: linking one for each file took gigabytes and minutes.

mod animate;
mod bad_input;
mod book;
mod bounds;
mod checkpoints;
mod codes;
mod commands;
mod common;
mod couplings;
mod disk_faults;
mod explain;
mod export;
mod interrupt;
mod long_tables;
mod modes;
mod outside;
mod plot;
mod report;
mod run;
mod scenes;
mod serving;
mod slips;
mod spectrum;
mod statics;
mod sweep;
mod told;
