//! In every shipped scenario, each headline value is the extremum of its curve.

use std::path::{Path, PathBuf};

use percuss::*;

/// Largest number of steps of a scenario.
const STEPS: usize = 4000;

fn scenarios() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios");
    let files = |dir: PathBuf| std::fs::read_dir(dir).unwrap().map(|entry| entry.unwrap().path());
    let mut all: Vec<PathBuf> = files(root.clone()).chain(files(root.join("paper"))).collect();
    all.retain(|path| path.extension().is_some_and(|e| e == "toml"));
    all.sort();
    all
}

struct Run {
    summary: RunSummary,
    rows: MemoryRecorder,
    time: Vec<f64>,
    step: f64,
}

impl Run {
    fn of(path: &Path) -> Self {
        let text = std::fs::read_to_string(path).unwrap();
        let scenario = percuss_scenario::read(&text, &path.display().to_string()).unwrap();
        let compiled = scenario.compile().unwrap();
        let mut settings = Settings { record_every: 1, ..compiled.settings };
        settings.end = settings.end.min(STEPS as f64 * settings.step);
        let mut rows = MemoryRecorder::default();
        let summary = simulate(&compiled.model, &settings, &mut rows).unwrap();
        let time = rows.column("time").unwrap();
        Self { summary, rows, time, step: settings.step }
    }

    /// A peak agrees with the rows around it: it is no smaller than any of them, and exceeds them by no more than the change of the curve between
    /// rows, since it is located within the step.
    fn is_largest(&self, what: &str, peak: Peak, curve: &[f64]) {
        let row = (0..curve.len()).max_by(|a, b| curve[*a].total_cmp(&curve[*b])).unwrap();
        let largest = curve[row];
        // Sums have a different order.
        let round_off = 1e-12 * curve.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        assert!(peak.value >= largest - round_off, "{what}: {peak:?} below {largest}");
        let near = |t: &f64| (t - peak.time).abs() <= 2.5 * self.step;
        let around: Vec<f64> =
            self.time.iter().zip(curve).filter(|(t, _)| near(t)).map(|(_, x)| *x).collect();
        let change = around.windows(2).map(|w| (w[1] - w[0]).abs()).fold(0.0, f64::max);
        let here = around.iter().fold(f64::NEG_INFINITY, |m, x| m.max(*x));
        let most = here + change + round_off;
        assert!(peak.value <= most, "{what}: {peak:?} above {here} + {change}");
    }

    /// An extreme over a larger set than the curve is no smaller than that of the curve.
    fn holds(&self, what: &str, [min, max]: [f64; 2], curve: &[f64]) {
        let size = curve.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        let inside = |x: &&f64| **x >= min - 1e-9 * size && **x <= max + 1e-9 * size;
        let outside = curve.iter().find(|x| !inside(x));
        assert!(outside.is_none(), "{what}: {outside:?} outside of [{min}, {max}]");
    }
}

fn check(path: &Path) {
    let run = Run::of(path);
    let name = path.file_stem().unwrap().to_string_lossy().into_owned();
    for contact in &run.summary.contacts {
        let ContactRecord::Smooth { peak_force, intervals } = &contact.record else { continue };
        let what = format!("{name}: force of {}", contact.name);
        let column = |q: &str| run.rows.column(&format!("contact.{}.{q}", contact.name)).unwrap();
        run.is_largest(&what, *peak_force, &column("force"));
        let given: f64 = intervals.iter().map(|i| i.impulse).sum();
        let rows: f64 = column("impulse").iter().sum();
        assert!((given - rows).abs() <= 1e-9 * rows.abs().max(1e-12), "{what}: {given} {rows}");
        let largest = intervals.iter().map(|i| i.peak_force.value).fold(0.0, f64::max);
        assert_eq!(largest, peak_force.value, "{what}");
    }
    for point in &run.summary.points {
        for (k, peak) in point.displacement_max.iter().enumerate() {
            let column = format!("point.{}.displacement_{}", point.name, k + 1);
            let sign = if peak.value < 0.0 { -1.0 } else { 1.0 };
            let curve: Vec<f64> =
                run.rows.column(&column).unwrap().iter().map(|x| sign * x).collect();
            // The largest magnitude: no value of the other sign has a larger one.
            let farther = curve.iter().find(|x| -**x > peak.value.abs());
            assert!(farther.is_none(), "{name}: {column} {peak:?} {farther:?}");
            let peak = Peak { value: sign * peak.value, ..*peak };
            run.is_largest(&format!("{name}: {column}"), peak, &curve);
        }
    }
    for support in &run.summary.supports {
        let ranges = [support.force[0], support.force[1], support.moment];
        for (range, q) in ranges.iter().zip(["force_1", "force_2", "moment"]) {
            let column = format!("support.{}.{q}", support.name);
            let curve = run.rows.column(&column).unwrap();
            // The first row is that of the start, before any step. Rows are means over the parts of a step.
            let values = [range.min.value, range.max.value];
            run.holds(&format!("{name}: {column}"), values, &curve[1..]);
        }
    }
    for beam in &run.summary.section_forces {
        for point in &run.summary.points {
            let of = point.name.strip_prefix(beam.name.as_str());
            if !of.is_some_and(|rest| rest.starts_with(['.', '@'])) {
                continue;
            }
            for (range, q) in [(beam.axial, "axial"), (beam.moment, "moment")] {
                let column = format!("section.{}.{q}", point.name);
                let curve = run.rows.column(&column).unwrap();
                let values = [range.min.value, range.max.value];
                run.holds(&format!("{name}: {column}"), values, &curve);
            }
        }
    }
}

#[test]
fn every_headline_is_the_extremum_of_its_curve() {
    let all = scenarios();
    assert!(all.len() > 20, "{all:?}");
    all.iter().for_each(|path| check(path));
}

/// A packaged crate has no files beside it, so it contains a copy of the paper's examples.
#[test]
fn examples_that_go_with_the_crate_are_those_of_the_repository() {
    let own = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    let texts = |folder: std::path::PathBuf| {
        let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
        let named = entries.map(|path| {
            (path.file_name().unwrap().to_owned(), std::fs::read_to_string(path).unwrap())
        });
        named.collect::<std::collections::BTreeMap<_, _>>()
    };
    let copies = texts(own.join("scenarios"));
    assert!(!copies.is_empty());
    assert_eq!(copies, texts(own.join("../../scenarios/paper")), "copy scenarios/paper here");
}
