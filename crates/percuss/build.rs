//! Tells the crate which sources it was built from.

fn main() {
    percuss_sources::set_build();
}
