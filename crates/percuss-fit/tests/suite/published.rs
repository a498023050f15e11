//! A published row.

use std::path::Path;

use crate::common::{fitted, parameter, put};

/// Displacements of code_aster's SDNL32 need a modulus of 67 GPa, which is found from 60.7 GPa.
#[test]
fn the_published_displacements_of_a_swinging_beam_need_their_modulus() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/fits");
    let read = |name: &str| std::fs::read_to_string(folder.join(name)).expect(name);
    let desk = tempfile::tempdir().expect("a folder");
    // A step five times as long moves the modulus by 1e-4.
    put(desk.path(), "swinging-beam.toml", &read("swinging-beam.toml").replace("10 us", "50 us"));
    put(desk.path(), "swinging-beam.csv", &read("swinging-beam.csv"));
    let fit = fitted(desk.path(), &read("young-of-a-swinging-beam.toml")).expect("a fit");
    let young = parameter(&fit, "young");
    // Known to two digits; rounded displacements leave 0.12 % of standard error.
    assert!((young.value / 67e9 - 1.0).abs() < 2e-3, "{}", young.value);
    assert!(young.interval[0] < 67e9 && 67e9 < young.interval[1]);
    assert!((young.stderr / young.value / 1.24e-3 - 1.0).abs() < 0.05, "{}", young.stderr);
}
