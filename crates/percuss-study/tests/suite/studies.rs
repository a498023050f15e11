//! What studies promise.

use percuss_study::{Folder, Input, RESULTS, Shard, Study, merge, sweep};

use crate::common::CANTILEVER;

fn study(rest: &str) -> Study {
    read(rest).unwrap_or_else(|faults| panic!("{faults}"))
}

fn read(rest: &str) -> Result<Study, percuss_scenario::Diagnostics> {
    Study::from_toml(&format!("scenario = '''{CANTILEVER}'''\n{rest}"), "study.toml")
}

const SAMPLED: &str = r#"
seed = 3
[parameter.speed]
path = "projectile.p.velocity[1]"
distribution = { kind = "uniform", from = "1 m/s", to = "3 m/s" }
[parameter.mass]
path = "projectile.p.mass"
distribution = { kind = "normal", mean = "10 kg", deviation = "2 kg", truncated = ["5 kg", "15 kg"] }
[design]
kind = "sobol"
runs = 600
[results]
force = "contact.p.peak_force.value"
deflection = "point.b.end.displacement_max.component_2.value"
end = "contact.p.intervals[0].end"
never = "contact.p.intervals[7].end"
"#;

#[test]
fn the_base_of_the_shipped_studies_is_the_scenario_of_the_paper() {
    // A study's base lies in its folder, so the file is there twice.
    let read = |name: &str| {
        let path = format!("{}/../../scenarios/{name}", env!("CARGO_MANIFEST_DIR"));
        percuss_scenario::load(std::path::Path::new(&path))
            .unwrap_or_else(|faults| panic!("{faults}"))
    };
    let [copy, original] = ["studies/elastic-clamped.toml", "paper/elastic-clamped.toml"].map(read);
    assert_eq!(copy.content(), original.content());
}

#[test]
fn files_of_runs_that_cannot_be_used_have_their_code() {
    let study = study(SAMPLED);
    let sandbox = tempfile::tempdir().unwrap();
    let folder = Folder::open(sandbox.path().join("out"), &study).unwrap();
    let missing = folder.read(&study, 1).expect_err("nothing is there");
    assert_eq!((missing.code().code, missing.is_unfit()), ("E303", true), "{missing}");
    assert_eq!(folder.finish(&study).expect_err("incomplete").code().code, "E303");
    std::fs::write(folder.path().join("shards/shard-000001.parquet"), "none").unwrap();
    let damaged = folder.read(&study, 1).expect_err("damaged");
    assert_eq!((damaged.code().code, damaged.is_unfit()), ("E302", true), "{damaged}");
}

#[test]
fn a_study_read_again_is_the_same_study() {
    let first = study(SAMPLED);
    let again = Study::from_toml(&first.to_toml(), "again.toml").expect("valid");
    assert_eq!(first.fingerprint(), again.fingerprint());
    assert_eq!(first.to_toml(), again.to_toml());
    assert_ne!(first.fingerprint(), study(&SAMPLED.replace("seed = 3", "seed = 4")).fingerprint());
    for run in [0, 17, 599] {
        assert_eq!(first.inputs(run), again.inputs(run));
    }
}

#[test]
fn a_run_of_a_study_is_the_run_of_the_changed_file() {
    let study = study(SAMPLED);
    let shard = study.run_shard(1);
    let run = study.runs_of(1).start + 3;
    let [Input::Number(speed), Input::Number(mass)] = study.inputs(run)[..] else {
        panic!("two numbers");
    };
    let changes =
        [format!("projectile.p.velocity=[0, {speed:?}]"), format!("projectile.p.mass={mass:?}")];
    let text = percuss_scenario::apply_overrides(CANTILEVER, "base", &changes).expect("valid");
    let compiled = percuss_scenario::read(&text, "base").and_then(|s| s.compile()).expect("valid");
    let detail = percuss_batch::Detail::Motion;
    let alone = percuss_batch::simulate_batch(&[(&compiled.model, &compiled.settings)], detail);
    let alone = alone.into_iter().next().expect("a run").expect("a summary");
    let percuss::ContactRecord::Smooth { peak_force, intervals } = &alone.contacts[0].record else {
        panic!("a smooth contact");
    };
    let number = |name: &str| shard.table.numbers(name).expect(name)[3].to_bits();
    assert_eq!(number("force"), peak_force.value.to_bits());
    assert_eq!(number("end"), intervals[0].end.to_bits());
    assert_eq!(number("deflection"), alone.points[0].displacement_max[1].value.to_bits());
    assert_eq!(number("audit.energy_residual"), alone.energy.residual_max.to_bits());
    assert!(shard.table.numbers("never").expect("a column")[3].is_nan());
}

#[test]
fn runs_side_by_side_tell_what_each_tells_alone() {
    // Long enough that the first ones are far away while the last ones still touch.
    let base = CANTILEVER.replace("end = 5e-3", "end = 40e-3");
    let speed = r#"
        [parameter.speed]
        path = "projectile.p.velocity[1]"
        range = { from = 0.5, to = 5, count = 20 }
        [parameter.mass]
        path = "projectile.p.mass"
        range = { from = 1, to = 30, count = 3 }
        [design]
        kind = "grid"
        [results]
        force = "contact.p.peak_force.value"
        time = "contact.p.peak_force.time"
        last = "projectile.p.velocity_final[1]"
    "#;
    let read = |more: &str| {
        let text = format!("scenario = \"\"\"{base}\"\"\"\n{speed}\n{more}");
        Study::from_toml(&text, "study").unwrap_or_else(|faults| panic!("{faults}"))
    };
    // Section forces are reported by single runs only.
    let (lanes, single) = (read(""), read("moment = \"section_forces.b.moment_max.value\""));
    for shard in 0..lanes.shard_count() {
        let (lanes, single) = (lanes.run_shard(shard).table, single.run_shard(shard).table);
        for name in ["force", "time", "last"] {
            let (a, b) = (lanes.numbers(name).expect(name), single.numbers(name).expect(name));
            for (row, (a, b)) in a.iter().zip(&b).enumerate() {
                // Two orders of summation over 800 steps.
                assert!((a - b).abs() < 1e-8 * b.abs(), "shard {shard}, row {row}: {name} {a} {b}");
            }
        }
    }
}

/// What is counted is what a run alone counts, the solver's own effort, too.
#[test]
fn studies_count_what_single_runs_count() {
    let rest = r#"
        [parameter.mass]
        path = "projectile.p.mass"
        range = { from = 1, to = 30, count = 5 }
        [design]
        kind = "grid"
        [results]
        iterations = "newton_iterations"
        factors = "factorizations"
        steps = "solver_steps"
        rows = "rows"
        closed = "contact.p.intervals[0].steps"
    "#;
    let counted = |rest: &str| study(rest).run_shard(0).table;
    let (all, few) = (counted(rest), counted(&rest.replace("iterations =", "# iterations =")));
    let (few, single) = (
        [few.numbers("steps"), few.numbers("rows"), few.numbers("closed")],
        [all.numbers("steps"), all.numbers("rows"), all.numbers("closed")],
    );
    assert_eq!(few, single);
    let masses = [1.0, 8.25, 15.5, 22.75, 30.0];
    for (k, mass) in masses.iter().enumerate() {
        let text = CANTILEVER.replace("mass = 10", &format!("mass = {mass}"));
        let compiled = percuss_scenario::read(&text, "base").and_then(|s| s.compile());
        let compiled = compiled.unwrap_or_else(|faults| panic!("{faults}"));
        let run = percuss::simulate(&compiled.model, &compiled.settings, &mut percuss::NoRecorder);
        let run = run.expect("a run");
        let wanted = [run.newton_iterations, run.factorizations, run.solver_steps, run.rows];
        let names = ["iterations", "factors", "steps", "rows"];
        let found = names.map(|name| all.numbers(name).expect(name)[k]);
        assert_eq!(found, wanted.map(|n| n as f64), "{mass}");
    }
}

#[test]
fn threads_workers_and_order_leave_no_trace_in_the_results() {
    let study = study(SAMPLED);
    let sandbox = tempfile::tempdir().expect("a directory");
    let results = |name: &str, jobs: usize| {
        let folder = Folder::open(sandbox.path().join(name), &study).expect("a folder");
        let shards: Vec<u64> = (0..study.shard_count()).collect();
        sweep(&study, &folder, &shards, jobs, &|_| true).expect("done");
        folder.finish(&study).expect("written");
        std::fs::read(sandbox.path().join(name).join(RESULTS)).expect("a table")
    };
    let one = results("one", 1);
    assert!(one == results("three", 3), "other bytes on three threads");

    let remote = Study::from_toml(&study.to_toml(), "remote").expect("valid");
    let backwards: Vec<Vec<u8>> = (0..remote.shard_count())
        .rev()
        .map(|index| remote.run_shard(index).to_parquet(&remote).expect("bytes"))
        .collect();
    let shards = backwards.iter().rev().map(|bytes| Shard::from_parquet(bytes, &study));
    let mut merged = Vec::new();
    merge(&study, shards, &mut merged).expect("merged");
    assert!(one == merged, "other bytes from elsewhere");
}

#[test]
fn damaged_shards_and_those_of_other_studies_are_done_again() {
    let study = study(SAMPLED);
    let sandbox = tempfile::tempdir().expect("a directory");
    let folder = Folder::open(sandbox.path().join("out"), &study).expect("a folder");
    let shards: Vec<u64> = (0..study.shard_count()).collect();
    sweep(&study, &folder, &shards, 2, &|_| true).expect("done");
    folder.finish(&study).expect("written");
    let table = sandbox.path().join("out").join(RESULTS);
    let before = std::fs::read(&table).expect("a table");

    let shard = |k: u64| sandbox.path().join(format!("out/shards/shard-{k:06}.parquet"));
    let mut bytes = std::fs::read(shard(2)).expect("a shard");
    let middle = bytes.len() / 3;
    bytes[middle] ^= 1;
    std::fs::write(shard(2), &bytes).expect("written");
    std::fs::write(shard(3), b"").expect("written");
    std::fs::copy(shard(5), shard(4)).expect("copied");
    assert!([2, 3, 4].iter().all(|k| !folder.has(&study, *k)));
    assert!(folder.finish(&study).is_err());
    sweep(&study, &folder, &shards, 2, &|_| true).expect("done");
    folder.finish(&study).expect("written");
    assert!(before == std::fs::read(&table).expect("a table"));
}

#[test]
fn a_directory_of_another_study_is_left_alone() {
    let sandbox = tempfile::tempdir().expect("a directory");
    Folder::open(sandbox.path().join("out"), &study(SAMPLED)).expect("a folder");
    let other = study(&SAMPLED.replace("seed = 3", "seed = 4"));
    let refused =
        Folder::open(sandbox.path().join("out"), &other).expect_err("refused").to_string();
    assert!(refused.contains("another study") && refused.contains("--out"), "{refused}");
    std::fs::create_dir(sandbox.path().join("mine")).expect("a directory");
    std::fs::write(sandbox.path().join("mine/letter.txt"), "dear").expect("written");
    assert!(Folder::open(sandbox.path().join("mine"), &other).expect_err("refused").is_unfit());
}

#[test]
fn a_run_that_is_no_valid_scenario_is_a_row_with_a_reason() {
    let study = study(
        r#"
        [parameter.mass]
        path = "projectile.p.mass"
        values = [10, -1, 5]
        [design]
        kind = "grid"
        [results]
        force = "contact.p.peak_force.value"
        "#,
    );
    let (invalid, looked_at) = study.check_sample(100);
    assert_eq!((invalid.len(), invalid[0].run, looked_at), (1, 1, 3));
    let table = study.run_shard(0).table;
    assert_eq!(table.texts("status").expect("texts"), ["completed", "invalid", "completed"]);
    let reason = &table.texts("reason").expect("texts")[1];
    assert!(reason.starts_with("projectile.p.mass: found -1"), "{reason}");
    let force = table.numbers("force").expect("numbers");
    assert!(force[0].is_finite() && force[1].is_nan() && force[2].is_finite());
}

#[test]
fn words_lists_points_and_counts_vary_too() {
    let study = study(
        r#"
        [parameter.scheme]
        path = "integrator.scheme"
        values = ["energy-momentum", "midpoint"]
        [parameter.place]
        path = "projectile.p.strikes"
        range = { from = "50 cm", to = "1 m", count = 2 }
        [parameter.elements]
        path = "beam.b.elements"
        values = [2, 4]
        [parameter.length]
        path = "beam.b.points[1][0]"
        values = ["1 m", "1.5 m"]
        [parameter.material]
        path = "material.m.preset"
        values = ["steel", "aluminium"]
        [design]
        kind = "grid"
        [results]
        energy = "energy.initial"
        force = "contact.p.peak_force.value"
        steps = "steps"
        "#,
    );
    assert_eq!(study.run_count(), 32);
    let shards = (0..study.shard_count()).map(|k| study.run_shard(k).table);
    let tables: Vec<_> = shards.collect();
    let rows =
        |name: &str| tables.iter().flat_map(|t| t.numbers(name).expect(name)).collect::<Vec<_>>();
    let reasons: Vec<_> = tables.iter().flat_map(|t| t.texts("reason").expect("texts")).collect();
    assert!(reasons.iter().all(|reason| reason.is_empty()), "{reasons:?}");
    let force = rows("force");
    // The last parameter changes fastest: steel and aluminium side by side, and what else differs.
    for (parameter, stride) in [("material", 1), ("length", 2), ("elements", 4), ("place", 8)] {
        assert_ne!(force[0], force[stride], "{parameter} changes nothing");
    }
    assert_eq!(rows("place")[8], 1.0);
    assert_eq!(tables[2].texts("scheme").expect("texts")[0], "midpoint");
    assert_eq!(tables[0].columns[2].unit, "m");
}

#[track_caller]
fn refused(rest: &str, wanted: &[&str]) {
    let faults = read(rest).expect_err("faults").to_string();
    for text in wanted {
        assert!(faults.contains(text), "no {text:?} in\n{faults}");
    }
}

#[test]
fn every_fault_is_reported_with_what_would_be_right() {
    refused(
        r#"
        [parameter.speed]
        path = "projectile.p.velocty[1]"
        values = [1]
        [parameter.who]
        path = "projectile.q.mass"
        values = [1]
        [parameter.far]
        path = "projectile.p.velocity[2]"
        values = [1]
        [parameter.mass]
        path = "projectile.p.mass"
        range = { from = "1 m", to = "2 kg" }
        [parameter.young]
        path = "material.m.young"
        distribution = { kind = "normal", mean = "200 GPa", deviation = "-1 GPa" }
        [design]
        kind = "sobol"
        runs = 0
        [results]
        force = "contact.p.peak_forc.value"
        table = "contact.p.peak_force"
        deep = "steps.more"
        mass = "time"
        "#,
        &[
            "`velocity`?)",
            "the unknown name `q`",
            "`p`",
            "the entry `2` of a list of 2",
            "\"1 m\", which is a length (m), expected a mass (kg)",
            "a deviation above zero",
            "design.runs: found 0",
            "did you mean `peak_force`?",
            "which is a table of the summary, expected one of `value`, `time`",
            "`more` behind a number",
            "the name `mass`, which another column",
        ],
    );
    refused("[design]\nkind = \"grid\"\n[results]\nt = \"time\"\n", &["parameter"]);
    refused(
        "[parameter.m]\npath = \"projectile.p.mass\"\ndistribution = { kind = \"normal\", mean = 1, deviation = 1 }\n\
         [design]\nkind = \"grid\"\n[results]\nt = \"time\"\n",
        &["a distribution in a grid"],
    );
}

#[test]
fn correlations_are_checked() {
    let with = |correlation: &str| {
        format!("correlation = [{correlation}]\n{}", SAMPLED.trim_start_matches("\nseed = 3"))
    };
    refused(
        &with(r#"{ between = ["speed", "mas"], coefficient = 0.5 }"#),
        &["the unknown parameter \"mas\"", "`mass`"],
    );
    refused(
        &with(r#"{ between = ["speed", "mass"], coefficient = 1.5 }"#),
        &["a coefficient from -1 to 1"],
    );
    let correlated = study(&with(r#"{ between = ["speed", "mass"], coefficient = 0.9 }"#));
    let pairs: Vec<(f64, f64)> = (0..600)
        .map(|run| match correlated.inputs(run)[..] {
            [Input::Number(speed), Input::Number(mass)] => (speed - 2.0, mass - 10.0),
            _ => panic!("two numbers"),
        })
        .collect();
    let moment = |f: &dyn Fn(&(f64, f64)) -> f64| pairs.iter().map(f).sum::<f64>();
    let r = moment(&|p| p.0 * p.1) / (moment(&|p| p.0 * p.0) * moment(&|p| p.1 * p.1)).sqrt();
    // A uniform and a truncated normal variable correlate a little less than the Gaussian ones behind them.
    assert!((0.82..0.9).contains(&r), "{r}");
}

#[test]
fn every_study_at_hand_is_valid_and_so_are_its_runs() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenarios/studies");
    let mut count = 0;
    for entry in std::fs::read_dir(folder).expect("studies") {
        let path = entry.expect("an entry").path();
        if !percuss_scenario::is_study(&std::fs::read_to_string(&path).expect("a text")) {
            continue; // what they vary lies among them
        }
        let study = Study::load(&path).unwrap_or_else(|faults| panic!("{faults}"));
        let (invalid, _) = study.check_sample(20);
        assert!(invalid.is_empty(), "{}: {invalid:?}", path.display());
        count += 1;
    }
    assert!(count >= 4, "{count}");
}

#[test]
fn keys_set_by_two_parameters_are_refused() {
    let with = |path: &str| {
        let second = format!("[parameter.again]\npath = \"{path}\"\nvalues = [1]\n[design]");
        read(&SAMPLED.replace("[design]", &second)).expect_err(path).to_string()
    };
    for path in ["projectile.p.mass", "projectile.p.velocity[1]", "projectile.p.velocity.1"] {
        assert!(with(path).contains("sets too"), "{path}: {}", with(path));
    }
    // A list and its entry.
    let list = SAMPLED.replace(
        "[design]",
        "[parameter.all]\npath = \"projectile.p.velocity\"\nvalues = [[0, 2]]\n[design]",
    );
    let text = read(&list).expect_err("a list").to_string();
    assert!(text.contains("`speed` sets too (`projectile.p.velocity[1]`)"), "{text}");
}

#[test]
fn a_correlation_reported_twice_is_refused() {
    let one = "[[correlation]]\nbetween = [\"speed\", \"mass\"]\ncoefficient = 0.5\n";
    let other = one.replace("0.5", "0.2").replace("\"speed\", \"mass\"", "\"mass\", \"speed\"");
    assert!(read(&format!("{SAMPLED}{one}")).is_ok());
    let text = read(&format!("{SAMPLED}{one}{other}")).expect_err("twice").to_string();
    assert!(text.contains("a second coefficient for \"mass\" and \"speed\""), "{text}");
    let few = SAMPLED.replace("\"sobol\"\nruns = 600", "\"latin-hypercube\"\nruns = 5");
    let text = read(&format!("{few}{one}")).expect_err("too few").to_string();
    assert!(text.contains("5 runs of 2 correlated parameters"), "{text}");
}

#[test]
fn points_with_a_dot_in_their_name_have_results() {
    let base = CANTILEVER.replace("[time]", "[record]\npoints = [\"b@0.5\", \"b@0.25m\"]\n[time]");
    let with = |path: &str| {
        let text = SAMPLED.replace("contact.p.intervals[7].end", path);
        Study::from_toml(&format!("scenario = \'\'\'{base}\'\'\'\n{text}"), "study.toml")
    };
    for name in ["b@0.5", "b@0.25m"] {
        let study = with(&format!("point.{name}.displacement_max.component_2.value"));
        let study = study.unwrap_or_else(|faults| panic!("{faults}"));
        let values = study.run_shard(0).table.numbers("never").expect("numbers");
        assert!(values.iter().all(|v| v.is_finite() && *v != 0.0), "{name}: {values:?}");
    }
    let text = with("point.b@0.4.displacement_max.component_2.value").expect_err("").to_string();
    assert!(text.contains("`b@0.5`") && text.contains("`b@0.25m`"), "{text}");
    let text = with("point.b@0.5.displacement").expect_err("").to_string();
    assert!(
        text.contains("(did you mean `displacement_max`?)") || text.contains("`displacement_max`"),
        "{text}"
    );
}

#[test]
fn shares_are_of_the_completed_runs_and_the_three_counts_are_reported() {
    // In 5 ms at 1 to 3 m/s some do not reach the beam.
    let far = SAMPLED.replace("path = \"projectile.p.mass\"", "path = \"projectile.p.standoff\"").replace(
        "{ kind = \"normal\", mean = \"10 kg\", deviation = \"2 kg\", truncated = [\"5 kg\", \"15 kg\"] }",
        "{ kind = \"uniform\", from = \"0 mm\", to = \"20 mm\" }",
    );
    let far =
        far.replace("runs = 600", "runs = 8").replace("intervals[0].end", "intervals[0].start");
    let base = CANTILEVER.replace("mass = 10\n", "mass = 10\nstandoff = 0\n");
    let study = Study::from_toml(&format!("scenario = \'\'\'{base}\'\'\'\n{far}"), "study.toml");
    let study = study.unwrap_or_else(|faults| panic!("{faults}"));
    let table = study.run_shard(0).table;
    let ends = table.numbers("end").expect("numbers");
    let touched = ends.iter().filter(|end| end.is_finite()).count();
    assert!(touched > 1 && touched < 7, "{touched}");
    // What did not touch has no force, not one of zero.
    let forces = table.numbers("force").expect("numbers");
    let both = forces.iter().zip(&ends);
    assert!(both.clone().all(|(force, end)| force.is_nan() == end.is_nan()), "{forces:?}");
    let page = percuss_study::report(&study, &table, &[]);
    let counts = format!("8 runs, 8 completed, {touched} of them with a value");
    assert!(page.contains(&counts), "{counts}");
    let population =
        percuss_study::analysis::Population::of(&study, &table, "end").expect("a result");
    assert_eq!((population.with_value(), population.completed, population.runs), (touched, 8, 8));
}

#[test]
fn indices_of_too_few_points_are_refused() {
    use percuss_study::analysis::{NoIndices, sobol_indices_of};
    use percuss_study::{Table, Values};
    let arranged = SAMPLED.replace("runs = 600", "runs = 20\nsobol_indices = true");
    let study = study(&arranged);
    // 20 points of a run for A, one for B and one a parameter; runs of `lost` points have no value.
    let table = |lost: u64| {
        let value = |run: u64| match run / 4 < lost && run % 4 == 1 {
            true => f64::NAN,
            false => ((run * 7919) % 101) as f64,
        };
        let columns = study.columns();
        let values = columns.iter().map(|c| match c.name == "force" {
            true => Values::Number((0..study.run_count()).map(value).collect()),
            false => Values::Number(Vec::new()),
        });
        Table { values: values.collect(), columns: columns.clone() }
    };
    assert_eq!(study.run_count(), 80);
    let points = |lost: u64| sobol_indices_of(&study, &table(lost), "force").map(|i| i.points);
    assert_eq!(points(0), Ok(20));
    assert_eq!(points(4), Ok(16), "a fifth is lost");
    assert_eq!(points(5), Err(NoIndices::TooFew { points: 15, of: 20 }));
    assert_eq!(points(20), Err(NoIndices::TooFew { points: 0, of: 20 }));
    let why = NoIndices::TooFew { points: 2, of: 64 }.to_string();
    assert!(why.contains("only 2 of 64 points"), "{why}");
}
