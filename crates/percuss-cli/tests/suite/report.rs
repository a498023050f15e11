//! `percuss report`: of one run again, of several on one page.

use crate::common;

use common::Sandbox;

const STOPPED: &str = r#"
[material.steel]
young = "210 GPa"
density = "7850 kg/m^3"

[section.bar]
shape = "rectangle"
width = "30 mm"
depth = "10 mm"

[beam.strip]
points = [[0, 0], [1, 0]]
elements = 10
material = "steel"
section = "bar"

[support.root]
at = "strip.start"
kind = "clamp"

[support.bracket]
at = "strip.end"
kind = "stop"
direction = [0, -1]
gap = "2 mm"
stiffness = "100 kN/m"

[projectile.mass]
kind = "elastic"
mass = "0.2 kg"
stiffness = "50 kN/m"
velocity = [0, "-2 m/s"]
strikes = "strip.mid"

[time]
end = "40 ms"
step = "0.1 ms"
"#;

#[test]
fn runs_are_laid_over_each_other_on_one_page() {
    let sandbox = Sandbox::empty();
    sandbox.put("a.toml", STOPPED);
    sandbox.percuss(&["run", "a.toml", "--out", "a"]).ends_with(0);
    sandbox
        .percuss(&["run", "a.toml", "--out", "b", "--set", "projectile.mass.mass=0.4"])
        .ends_with(0);
    let reported = sandbox.percuss(&["report", "a", "b", "--out", "both.html"]);
    reported.ends_with(0);
    assert!(reported.stderr.contains("both.html compares 2 runs"), "{}", reported.stderr);
    let page = std::fs::read_to_string(sandbox.path("both.html")).expect("a page");
    let peak = |run: &str| {
        let value = &sandbox.summary(run)["contact"]["mass"]["peak_force"];
        value["value"].as_f64().expect("a force")
    };
    let percent = 100.0 * (peak("b") / peak("a") - 1.0);
    let row = page.split("<tr>").find(|row| row.contains("peak contact force")).expect("a row");
    let shown: f64 = row
        .split("+")
        .nth(1)
        .and_then(|r| r.split('\u{a0}').next()?.parse().ok())
        .expect("a difference");
    assert!((shown / percent - 1.0).abs() < 0.006, "{shown} % for {percent} %");
    // Both scenes, and once more into the same page, which is ours.
    assert_eq!(page.matches("\"contact_count\"").count(), 2);
    sandbox.percuss(&["report", "b", "a", "--out", "both.html"]).ends_with(0);
}

#[test]
fn a_comparison_replaces_no_file_that_is_not_one() {
    let sandbox = Sandbox::empty();
    sandbox.put("a.toml", STOPPED);
    sandbox.percuss(&["run", "a.toml", "--out", "a", "--no-report"]).ends_with(0);
    sandbox.put("comparison.html", "my own page");
    let reported = sandbox.percuss(&["report", "a", "a"]);
    reported.ends_with(2);
    assert!(
        reported.stderr.contains("comparison.html") && reported.stderr.contains("--out"),
        "{}",
        reported.stderr
    );
    assert_eq!(std::fs::read(sandbox.path("comparison.html")).expect("the page"), b"my own page");
    assert!(sandbox.percuss(&["report", "a", "nothing"]).ends_with(2).stderr.contains("nothing"));
}

#[test]
fn the_log_has_the_touches_of_a_stop_as_its_reaction_shows_them() {
    let sandbox = Sandbox::empty();
    sandbox.put("a.toml", STOPPED);
    sandbox.percuss(&["run", "a.toml", "--out", "a", "--history", "csv"]).ends_with(0);
    let summary = sandbox.summary("a");
    let touches = summary["support"]["bracket"]["intervals"].as_array().expect("touches").clone();
    assert!(summary["support"]["root"]["intervals"].is_null(), "a clamp is no stop");
    let history = std::fs::read_to_string(sandbox.path("a/history.csv")).expect("a history");
    let mut lines = history.lines();
    let header: Vec<&str> = lines.next().expect("a header").split(',').collect();
    let column = |name: &str| header.iter().position(|h| *h == name).expect("a column");
    let (time, force) = (column("time"), column("support.bracket.force_2"));
    let rows: Vec<[f64; 2]> = lines
        .map(|line| {
            let cells: Vec<&str> = line.split(',').collect();
            [time, force].map(|k| cells[k].parse().expect("a number"))
        })
        .collect();
    // By hand from the column: runs of steps with a force, their sums and largest values.
    let mut by_hand: Vec<[f64; 4]> = Vec::new();
    let mut open = false;
    for pair in rows.windows(2) {
        let ([from, _], [to, f]) = (pair[0], pair[1]);
        if f != 0.0 && !open {
            by_hand.push([from, to, 0.0, 0.0]);
        }
        if let Some(last) = by_hand.last_mut().filter(|_| f != 0.0) {
            *last = [last[0], to, last[2] + f.abs() * (to - from), last[3].max(f.abs())];
        }
        open = f != 0.0;
    }
    assert!(
        !by_hand.is_empty() && by_hand.len() == touches.len(),
        "{} {}",
        by_hand.len(),
        touches.len()
    );
    for (touch, [from, to, impulse, peak]) in touches.iter().zip(by_hand) {
        let near = |value: &serde_json::Value, wanted: f64| {
            let value = value.as_f64().unwrap_or(rows[rows.len() - 1][0]);
            assert!(
                (value - wanted).abs() <= 1e-9 * wanted.abs().max(1e-3),
                "{value} for {wanted}"
            );
        };
        near(&touch["start"], from);
        near(&touch["end"], to);
        near(&touch["impulse"], impulse);
        near(&touch["peak_force"]["value"], peak);
    }
    let log = std::fs::read_to_string(sandbox.path("a/impacts.csv")).expect("a log");
    assert_eq!(
        log.lines().filter(|l| l.starts_with("bracket,") && l.contains(",stop,")).count(),
        touches.len()
    );
    let page = std::fs::read_to_string(sandbox.path("a/report.html")).expect("a page");
    assert!(page.contains("<td>bracket</td>"));
}

#[cfg(unix)]
#[test]
fn the_page_is_opened_where_something_can_open_it() {
    use std::os::unix::fs::PermissionsExt as _;
    let sandbox = Sandbox::empty();
    sandbox.put("a.toml", STOPPED);
    sandbox.put("xdg-open", "#!/bin/sh\necho \"$1\" > opened\n");
    let program = sandbox.path("xdg-open");
    std::fs::set_permissions(&program, std::fs::Permissions::from_mode(0o755)).expect("a program");
    let here = program.parent().expect("a folder").to_owned();
    let path = format!("{}:/usr/bin:/bin", here.display());
    let run = |path: &str| {
        let mut command = sandbox.command(&["run", "a.toml", "--out", "a", "--open"]);
        command.env("PATH", path).output().expect("the command runs")
    };
    let done = run(&path);
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    let opened =
        || std::fs::read_to_string(sandbox.path("opened")).ok().filter(|t| t.ends_with('\n'));
    let limit = std::time::Instant::now() + std::time::Duration::from_secs(20);
    while opened().is_none() && std::time::Instant::now() < limit {
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    assert!(opened().expect("it was opened").trim().ends_with("a/report.html"));
    let nothing = run("/nowhere");
    assert!(nothing.status.success(), "the run is done all the same");
    let reported = String::from_utf8_lossy(&nothing.stderr).into_owned();
    assert!(reported.contains("in a browser") && reported.contains("report.html"), "{reported}");
}
