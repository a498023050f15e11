//! Passes the hash of the crate's sources to its compilation.

fn main() {
    percuss_sources::set_build();
}
