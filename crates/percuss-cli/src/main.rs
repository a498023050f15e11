//! The `percuss` command.
fn main() {}
