//! What the terminal prints of a run: units and terms.

use crate::common::Desk;

/// Stored strains may drift from the configuration only under the scheme that stores them.
#[test]
fn strain_drift_is_printed_for_the_scheme_that_stores_strains() {
    let desk = Desk::new();
    let run = |scheme: &str| {
        let scheme = format!("integrator.scheme={scheme}");
        let set = ["--set", scheme.as_str(), "--set", "time.end=0.02"];
        desk.percuss(&[&["run", "elastic.toml", "--no-report"][..], &set].concat())
    };
    run("strain-rate").ends_with(0).tells("strain drift");
    let conserving = run("energy-momentum");
    assert!(!conserving.ends_with(0).stderr.contains("drift"), "{}", conserving.stderr);
}

/// Quantities have prefixes of thousands in the sentences and in the table; no unit follows a power of ten.
#[test]
fn quantities_of_a_run_have_one_format() {
    let desk = Desk::empty();
    desk.put("bar.toml", include_str!("../../../../scenarios/yielding-beam.toml"));
    let run = desk.percuss(&["run", "bar.toml", "--no-report"]);
    let words: Vec<&str> = run.ends_with(0).stderr.split_whitespace().collect();
    for pair in words.windows(2) {
        let (number, unit) =
            (pair[0].trim_matches(['(', ',']), pair[1].trim_matches([',', '.', ';', ')']));
        let power = number.contains('e') && number.parse::<f64>().is_ok();
        assert!(!power || !["s", "m", "N", "J", "Pa"].contains(&unit), "{pair:?}: {}", run.stderr);
    }
    let text = words.join(" ");
    for said in [
        "'girder.mid' was struck by projectile 'weight' at 8 m/s, t = 0 s.",
        "Permanent deflection after unloading: ",
        " mm downwards at mid-span.",
        "plastic hinge: rotation ",
        " (same peak moment), ",
    ] {
        assert!(text.contains(said), "{said}: {}", run.stderr);
    }
}
