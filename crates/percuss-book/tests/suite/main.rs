//! What the book promises of itself.

mod fragments;
mod gallery;
mod mutations;
mod paper;
mod plain_words;
mod release;
mod scenario;
mod theory;

use std::path::Path;

fn repository() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}
