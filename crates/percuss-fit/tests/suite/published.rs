//! A published row, and the template.

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

/// Its record was made with 0.9 MN/m and 2.2 GPa, 8 ms of the run before it, and noise of 2 kN and 0.5 mm.
#[test]
fn the_template_finds_the_values_behind_its_record() {
    let template = &percuss_scenario::fit_templates()[0];
    let desk = tempfile::tempdir().expect("a folder");
    template.files.iter().for_each(|(name, text)| put(desk.path(), name, text));
    let fit = fitted(desk.path(), template.text).expect("a fit");
    // As `percuss fit` gives them: each within two standard errors of what made the record.
    for (name, truth, error) in
        [("stiffness", 9e5, 1.37e3), ("young", 2.2e9, 1.79e6), ("first.offset", -8e-3, 1.66e-5)]
    {
        let found = parameter(&fit, name);
        assert!((found.value - truth).abs() < 2.0 * found.stderr, "{name}: {found:?}");
        assert!((found.stderr / error - 1.0).abs() < 0.02, "{name}: {found:?}");
    }
    assert!((fit.reduced_chi_square - 0.9596).abs() < 1e-3, "{}", fit.reduced_chi_square);
}
