//! What the terminal prints of a run: units and terms.

use crate::common::Sandbox;

/// Stored strains may drift from the configuration only under the scheme that stores them.
#[test]
fn strain_drift_is_printed_for_the_scheme_that_stores_strains() {
    let sandbox = Sandbox::new();
    let run = |scheme: &str| {
        let scheme = format!("integrator.scheme={scheme}");
        let set = ["--set", scheme.as_str(), "--set", "time.end=0.02"];
        sandbox.percuss(&[&["run", "elastic.toml", "--no-report"][..], &set].concat())
    };
    run("strain-rate").ends_with(0).tells("strain drift");
    let conserving = run("energy-momentum");
    assert!(!conserving.ends_with(0).stderr.contains("drift"), "{}", conserving.stderr);
}

/// Quantities have prefixes of thousands in the sentences and in the table; no unit follows a power of ten.
#[test]
fn quantities_of_a_run_have_one_format() {
    let sandbox = Sandbox::empty();
    sandbox.put("bar.toml", include_str!("../../../../scenarios/yielding-beam.toml"));
    let run = sandbox.percuss(&["run", "bar.toml", "--no-report"]);
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

/// Four digits in a unit that has a prefix, as sentences have them.
fn four_digits(value: f64) -> String {
    let rounded: f64 = format!("{value:.3e}").parse().expect("a number");
    let text = format!("{rounded:.6}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// The sentences about a run say what its summary has: permanent deflection, peak moment and its place, the error of the balance.
#[test]
fn sentences_have_the_numbers_of_the_summary() {
    let sandbox = Sandbox::empty();
    sandbox.put("bar.toml", include_str!("../../../../scenarios/yielding-beam.toml"));
    let run = sandbox.percuss(&["run", "bar.toml", "--out", "out"]);
    let printed = run.ends_with(0).stderr.split_whitespace().collect::<Vec<_>>().join(" ");
    let page = std::fs::read_to_string(sandbox.path("out/report.html")).expect("a page");
    let page = page.replace('\u{a0}', " ").replace("&#39;", "'");
    let page = page.replace("<span class=\"whole\">", "").replace("</span>", "");
    let summary = sandbox.summary("out");
    let set = &summary["plastic"]["girder"];
    let down = set["permanent_set_at"]["displacement"][1].as_f64().expect("a displacement");
    assert!(down < 0.0 && set["permanent_set_at"]["s"] == 0.5, "{set}");
    let moments = &summary["section_forces"]["girder"]["moment"];
    let [low, high] = ["min", "max"].map(|end| moments[end]["value"].as_f64().expect("a moment"));
    let peak = &moments[if high > -low { "max" } else { "min" }];
    let [value, s, time] = ["value", "s", "time"].map(|key| peak[key].as_f64().expect("a number"));
    assert!((1.0..1e4).contains(&value.abs()), "no prefix: {value}");
    let energy = &summary["energy"];
    let error = energy["residual_max"].as_f64().expect("an error");
    let scale = energy["scale"].as_f64().expect("a scale");
    for said in [
        format!(
            "Permanent deflection after unloading: {} mm downwards at mid-span.",
            four_digits(-1e3 * down)
        ),
        format!(
            "Peak bending moment: {} N m in 'girder' at s = {} mm, t = {} ms",
            four_digits(value.abs()),
            four_digits(1e3 * s),
            four_digits(1e3 * time)
        ),
        format!("Energy balance error {error:.0e} of {} J.", four_digits(scale)),
    ] {
        assert!(printed.contains(&said), "{said}: {}", run.stderr);
        assert!(page.contains(&said), "{said}");
    }
}

/// Terminal and page have one line about the state of a run, with the number of warnings that its summary has.
#[test]
fn terminal_and_page_have_the_same_state_and_number_of_warnings() {
    let sandbox = Sandbox::new();
    let allow = "[allow]\nW005 = \"a property of this mesh is asked for\"\n";
    for (more, warnings) in [("", "1 warning"), (allow, "no warnings")] {
        sandbox.put("rigid.toml", format!("{STRUCK}{more}"));
        let run = sandbox.percuss(&["run", "rigid.toml", "--out", "out"]);
        let state = format!("Completed, t = 2 ms, {warnings}");
        run.ends_with(0).tells(&format!("{state}, 100 steps"));
        let page = std::fs::read_to_string(sandbox.path("out/report.html")).expect("a page");
        let line = page.lines().find(|line| line.contains("class=\"status\"")).expect("a state");
        let mut text = String::new();
        let mut inside = false;
        for c in line.replace('\u{a0}', " ").chars() {
            inside = (inside || c == '<') && c != '>';
            if !inside && c != '>' {
                text.push(c);
            }
        }
        assert_eq!(text.trim(), state);
        let shown = percuss_output::report::RunState::of(&sandbox.summary("out"));
        assert_eq!(shown.warnings_in_words(), warnings);
        assert_eq!(run.stderr.matches("warning: ").count(), shown.warnings, "{}", run.stderr);
    }
}

/// A rigid impact, whose impulse depends on the mesh.
const STRUCK: &str = r#"
[material.steel]
young = "210 GPa"
density = "7850 kg/m^3"
[section.bar]
shape = "rectangle"
width = "5 cm"
depth = "5 cm"
[beam.girder]
points = [[0, 0], ["2 m", 0]]
elements = 8
material = "steel"
section = "bar"
[support.a]
at = "girder.start"
kind = "clamp"
[support.b]
at = "girder.end"
kind = "clamp"
[projectile.mass]
kind = "rigid"
mass = "40 kg"
velocity = [0, "-1 m/s"]
strikes = "girder.mid"
restitution = 0.5
[time]
end = "2 ms"
step = "20 us"
"#;
