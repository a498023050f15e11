#![allow(dead_code, missing_docs)]
#[path = "../../percuss/tests/suite/common/mod.rs"] mod common;
#[path = "../../percuss/tests/suite/violent_yielding.rs"] mod violent;
fn main() {
    let a: Vec<String> = std::env::args().collect();
    if let Some(n) = a.get(1) { violent::one(n.parse().unwrap()); } else { violent::all(); }
}
