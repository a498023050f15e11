//! `summary.json` as documented.

use crate::synthetic;

use std::error::Error;

use percuss::{ContactRecord, EffectiveMass, ImpactResolution, Scheme, Settings, Termination};
use percuss_output::{RunInfo, SummaryPath, pick, read_summary, summary_value, write_summary};
use serde_json::{Value, json};

fn value(run: &percuss::RunSummary) -> Value {
    let settings = Settings {
        scheme: Scheme::GeneralizedAlpha { spectral_radius: 0.8 },
        impacts: ImpactResolution::TimeStepping { closed_tolerance: 1e-9 },
        ..Settings::new(0.15, 1e-4)
    };
    let name = &run.contacts[0].name;
    let (advice, comparisons) = (synthetic::advice(name), synthetic::comparisons(name));
    let info = RunInfo {
        title: "A title",
        settings: &settings,
        wall_seconds: 0.5,
        advice: &advice,
        warnings: &[],
        comparisons: &comparisons,
    };
    summary_value(run, info)
}

#[test]
fn the_documented_fields_are_there() {
    let smooth = value(&synthetic::summary("mass", synthetic::smooth()));
    assert_eq!(smooth["status"], "completed");
    assert_eq!(smooth["title"], "A title");
    assert_eq!(smooth["percuss_version"], env!("CARGO_PKG_VERSION"));
    for key in ["steps", "newton_iterations", "factorizations"] {
        assert!(smooth[key].is_u64(), "{key}");
    }
    for path in [
        "/wall_seconds",
        "/energy/initial",
        "/energy/final",
        "/energy/residual_max",
        "/momentum/linear_residual_max",
        "/momentum/angular_residual_max",
        "/audit/curvature_drift_max",
        "/audit/angular_rate_drift_max",
        "/projectile/mass/momentum_transferred",
        "/projectile/mass/energy_given",
        "/projectile/mass/energy_received_by_others",
        "/contact/mass/peak_force/value",
        "/contact/mass/peak_force/time",
        "/contact/mass/intervals/0/start",
        "/contact/mass/intervals/0/impulse",
        "/contact/mass/intervals/0/peak_force/value",
        "/contact/mass/intervals/0/approach_velocity",
        "/contact/mass/intervals/0/place/s",
        "/contact/mass/intervals/0/place/position/1",
        "/contact/mass/intervals/0/energy/given/1",
        "/contact/mass/intervals/0/energy/lost",
        "/contact_residual_max",
        "/projectile/mass/spin_final",
        "/advice/1/value",
        "/hand_formulas/0/by_hand",
        "/hand_formulas/0/difference_percent",
        "/point/girder.mid/displacement_max/component_1/value",
        "/point/girder.mid/displacement_max/component_2/time",
        "/energy/loss_damping",
        "/support/left/force_1/min/value",
        "/support/left/force_2/max/time",
        "/support/right/moment/max/value",
        "/section_forces/girder/moment_max/s",
        "/section_forces/girder/axial_max/value",
        "/section_forces/girder/shear_max/time",
        "/section_forces/girder/moment/min/value",
        "/section_forces/girder/axial/max/s",
        "/section_forces/girder/shear/min/time",
    ] {
        assert!(smooth.pointer(path).is_some_and(Value::is_f64), "{path}");
    }
    assert_eq!(smooth["projectile"]["mass"]["velocity_final"], json!([0.0, -19.10077444]));

    let girder = &smooth["section_forces"]["girder"];
    assert_eq!(girder["shear_max"], girder["shear"]["min"], "the larger magnitude, signed");
    assert_eq!(girder["moment_max"], girder["moment"]["max"]);
    let keys: Vec<&String> = girder.as_object().map(|o| o.keys().collect()).unwrap_or_default();
    let ranges = ["moment", "axial", "shear", "stress", "strain"];
    assert_eq!(keys[..3], ["moment_max", "axial_max", "shear_max"]);
    assert_eq!(keys[3..8], ranges);
    assert_eq!(keys[8..], ["shear_stress", "von_mises_max", "length"], "where the envelope ends");
    assert!(girder["stress"]["min"]["value"].is_null(), "no depth, no stress");

    let rigid = value(&synthetic::summary("hammer", synthetic::impacts(2)));
    let impact = &rigid["contact"]["hammer"]["impacts"][1];
    for key in ["time", "impulse", "tangential_impulse", "approach_velocity", "restitution"] {
        assert!(impact[key].is_f64(), "{key}");
    }
    assert_eq!(impact["energy"]["given"], json!([79_000.0, -79_000.0]));
    assert_eq!(impact["fallback_law"], false);
    assert!(impact.get("peak_force").is_none(), "an impact has no force");
    assert_eq!(rigid["contact"]["hammer"]["between"], json!(["girder.mid", "hammer"]));
    assert_eq!(rigid["contact"]["hammer"]["fallback_count"], 0);
    assert_eq!(rigid["advice"][1]["verdict"], "warning");
    assert_eq!(rigid["contact"]["hammer"]["impact_count"], 2);
    assert_eq!(rigid["settings"]["scheme"], "generalized-alpha");
    assert_eq!(rigid["settings"]["spectral_radius"], 0.8);
    assert_eq!(rigid["settings"]["closed_tolerance"], 1e-9);
}

#[test]
fn a_contact_lasts_from_touch_to_release_or_is_not_over() {
    let mut run = synthetic::summary("mass", synthetic::smooth());
    assert!(value(&run)["contact"]["mass"]["duration"].is_null(), "still closed");
    let ContactRecord::Smooth { intervals, .. } = &mut run.contacts[0].record else { panic!() };
    intervals[0].end = 0.0725;
    assert_eq!(value(&run)["contact"]["mass"]["duration"], 0.0725 - 0.01);
    let paths = percuss_output::summary_paths(&run);
    let listed = paths.iter().find(|one| one.path == "contact.mass.duration");
    assert_eq!(listed.map(|one| one.unit), Some("s"));
    let ContactRecord::Smooth { intervals, .. } = &mut run.contacts[0].record else { panic!() };
    intervals.clear();
    assert!(value(&run)["contact"]["mass"]["duration"].is_null(), "never closed");
}

#[test]
fn nan_is_written_as_null() {
    let mut run = synthetic::summary("mass", synthetic::smooth());
    run.energy.residual_max = f64::NAN;
    run.contacts[0].effective_mass = Some(EffectiveMass { on_mesh: f64::INFINITY, limit: 1.0 });
    run.termination = Termination::Interrupted { time: 0.1 };
    let value = value(&run);
    assert!(value["energy"]["residual_max"].is_null());
    assert!(value["contact"]["mass"]["effective_mass"].is_null());
    assert!(value["contact"]["mass"]["intervals"][0]["end"].is_null());
    assert!(value["contact"]["mass"]["intervals"][0]["restitution"].is_null());
    assert_eq!(value["status"], "interrupted");
}

#[test]
fn a_contact_between_free_things_has_no_effective_mass() {
    let mut run = synthetic::summary("mass", synthetic::smooth());
    run.contacts[0].effective_mass = None;
    let value = value(&run);
    assert!(value["contact"]["mass"].get("effective_mass").is_none());
}

#[test]
fn a_summary_reads_back_and_a_damaged_one_does_not() -> Result<(), Box<dyn Error>> {
    let dir = tempfile::tempdir()?;
    let written = value(&synthetic::summary("mass", synthetic::smooth()));
    write_summary(dir.path(), &written)?;
    assert_eq!(read_summary(dir.path())?, written);
    std::fs::write(dir.path().join("summary.json"), "[1, 2]")?;
    assert!(read_summary(dir.path()).is_err_and(|e| e.is_content()));
    std::fs::write(dir.path().join("summary.json"), "{\"status\": ")?;
    assert!(read_summary(dir.path()).is_err_and(|e| e.is_content()));
    Ok(())
}

/// Every number of a summary by its path, as `jq` would write it.
fn leaves(path: &str, value: &Value, out: &mut Vec<(String, Option<f64>)>) {
    let join = |key: &str| if path.is_empty() { key.to_owned() } else { format!("{path}.{key}") };
    match value {
        Value::Object(map) => map.iter().for_each(|(k, v)| leaves(&join(k), v, out)),
        Value::Array(list) => {
            list.iter().enumerate().for_each(|(i, v)| leaves(&format!("{path}[{i}]"), v, out));
        }
        Value::Number(_) | Value::Null => out.push((path.to_owned(), value.as_f64())),
        _ => {}
    }
}

#[test]
fn every_number_of_a_summary_can_be_picked_by_its_path() {
    for record in [synthetic::smooth(), synthetic::impacts(3)] {
        let run = synthetic::summary("mass", record);
        let mut all = Vec::new();
        leaves("", &value(&run), &mut all);
        // What a single number cannot say: how the run was carried out, and what was said about it.
        let others = ["settings", "advice", "hand_formulas", "multiple_impacts", "wall_seconds"];
        all.retain(|(path, _)| !others.iter().any(|other| path.starts_with(other)));
        assert!(all.len() > 50);
        let found = |(path, _): &(String, _)| {
            SummaryPath::find(path, &run).unwrap_or_else(|_| panic!("no {path}"))
        };
        let paths: Vec<SummaryPath> = all.iter().map(found).collect();
        for ((path, expected), picked) in all.iter().zip(pick(&paths, &run)) {
            let bits = expected.map(f64::to_bits);
            assert_eq!(picked.is_finite().then(|| picked.to_bits()), bits, "{path}");
        }
    }
}

#[test]
fn unknown_paths_of_a_summary_are_refused() {
    let run = synthetic::summary("mass", synthetic::smooth());
    for path in
        ["", "energy", "contact.mass", "contact.none.peak_force.value", "status", "settings.step"]
    {
        assert!(SummaryPath::find(path, &run).is_err(), "{path}");
    }
    let late = SummaryPath::find("contact.mass.intervals[99].impulse", &run).expect("an interval");
    assert!(pick(&[late], &run)[0].is_nan());
    let unit = |path: &str| SummaryPath::find(path, &run).expect(path).unit();
    assert_eq!(unit("contact.mass.peak_force.value"), "N");
    assert_eq!(unit("contact.mass.peak_force.time"), "s");
    assert_eq!(unit("contact.mass.intervals[0].energy.lost"), "J");
    assert_eq!(unit("projectile.mass.velocity_final.1"), "m/s");
    assert_eq!(unit("energy.residual_max"), "1");
}
