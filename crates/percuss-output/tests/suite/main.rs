//! All integration tests of the crate in one program: linking one for each file took gigabytes and minutes.

mod directory;
mod history;
mod impacts;
mod report;
mod summary;
mod synthetic;
