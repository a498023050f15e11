//! Structures at rest, and slowly strained ones between supports that push against each other: balances are judged by what passes, and round-off is
//! no motion.

use percuss::{Channel, Flow, NoRecorder, Recorder, RecorderError, RunSummary, simulate};

fn run(text: &str) -> RunSummary {
    let compiled = percuss_scenario::read(text, "rest.toml").unwrap().compile().unwrap();
    simulate(&compiled.model, &compiled.settings, &mut NoRecorder).unwrap()
}

fn balances_close(summary: &RunSummary) {
    let (energy, momentum) = (&summary.energy, &summary.momentum);
    let residuals =
        [energy.residual_max, momentum.linear_residual_max, momentum.angular_residual_max];
    assert!(residuals.iter().all(|r| *r < 1e-10), "{residuals:?}");
}

/// A bar between two pins.
const BAR: &str = r#"
[material.m]
young = "210 GPa"
density = "7850 kg/m^3"
expansion = "12e-6 1/K"
strain = "engineering"
[section.s]
shape = "rectangle"
width = "50 mm"
depth = "50 mm"
[beam.b]
points = [[0, 0], ["2 m", 0]]
elements = 5
material = "m"
section = "s"
[support.l]
at = "b.start"
kind = "pin"
[support.r]
at = "b.end"
kind = "pin"
"#;

/// Supports that push against each other pass much, though together nothing.
#[test]
fn bars_that_press_on_two_walls_keep_their_balances() {
    let heated = r#"
[load.h]
kind = "temperature"
on = "b"
change = "20 K"
function = { kind = "ramp", duration = "0.1 s" }
[time]
end = "0.1 s"
step = "1 ms"
"#;
    let found = run(&format!("{BAR}{heated}"));
    balances_close(&found);
    // EA alpha dT = 126 kN, less what the forces change the length by.
    let force = found.supports[0].force[0].max.value;
    assert!((force / 126e3 - 1.0).abs() < 0.01, "{force}");
    // Each end passes the mean of a ramp.
    let passed = found.momentum.linear_scale / (2.0 * 0.5 * 126e3 * 0.1);
    assert!((passed - 1.0).abs() < 0.02, "{passed}");
    let prestressed = r#"
[load.s]
kind = "strain"
on = "b"
strain = -5e-4
[time]
end = "0.1 s"
step = "0.1 ms"
start = "static"
"#;
    balances_close(&run(&format!("{BAR}{prestressed}")));
}

#[test]
fn round_off_in_a_damped_frame_at_rest_is_no_error_of_its_balance() {
    balances_close(&run(include_str!("../at_rest/frame.toml")));
}

#[test]
fn a_structure_at_rest_needs_no_shorter_steps() {
    let found = run(include_str!("../at_rest/hinges.toml"));
    assert_eq!(found.step_cuts, 0);
    assert!(found.newton_iterations < 20 * found.steps, "{}", found.newton_iterations);
    balances_close(&found);
}

/// A strip on a compression-only bed that it touches without force at the start, and sinks into.
const STRIP: &str = r#"
[material.m]
young = "30 GPa"
density = "2500 kg/m^3"
[section.s]
shape = "rectangle"
width = "1 m"
depth = "0.5 m"
[beam.b]
points = [[0, 0], ["2 m", 0]]
elements = 2
material = "m"
section = "s"
[foundation.bed]
on = "b"
law = "compression"
stiffness = "5 MN/m^2"
damping = "300 kN*s/m^2"
[load.g]
kind = "gravity"
acceleration = [0, "-9.81 m/s^2"]
[time]
end = "0.3 s"
step = "0.1 ms"
"#;

#[test]
fn what_touches_a_bed_without_force_has_not_lifted_off() {
    assert_eq!(run(STRIP).foundations[0].lifted.value, 0.0);
    let off = run(&STRIP.replace("\"-9.81 m/s^2\"", "\"0.1 m/s^2\""));
    assert!(
        (off.foundations[0].lifted.value - 2.0).abs() < 1e-12,
        "{:?}",
        off.foundations[0].lifted
    );
}

/// A stiff post on ground that shakes with 4 m/s^2 at 3 Hz: it moves with the ground, whose velocity is `a/w (1 - cos w t)`.
#[test]
fn absolute_velocities_are_those_of_the_base_and_of_the_motion_on_it() {
    const POST: &str = r#"
[material.m]
young = "200 GPa"
density = "7850 kg/m^3"
retardation = "1e-5 s"
[section.s]
shape = "rectangle"
width = "0.2 m"
depth = "0.2 m"
[beam.b]
points = [[0, 0], [0, "0.5 m"]]
elements = 2
material = "m"
section = "s"
[support.l]
at = "b.start"
kind = "clamp"
[load.quake]
kind = "base"
acceleration = ["4 m/s^2", 0]
function = { kind = "harmonic", frequency = "3 Hz" }
[record]
points = ["b.end"]
every = 5
[time]
end = "1 s"
step = "1 ms"
"#;
    #[derive(Default)]
    struct Rows {
        columns: [usize; 2],
        rows: Vec<[f64; 3]>,
    }
    impl Recorder for Rows {
        fn begin(&mut self, channels: &[Channel]) -> Result<(), RecorderError> {
            let at = |name: &str| channels.iter().position(|c| c.name == name).expect(name);
            self.columns = [at("point.b.end.velocity_1"), at("point.b.end.absolute_velocity_1")];
            Ok(())
        }
        fn row(&mut self, values: &[f64]) -> Result<(), RecorderError> {
            let [relative, absolute] = self.columns.map(|k| values[k]);
            self.rows.push([values[0], relative, absolute]);
            Ok(())
        }
        fn progress(&mut self, _time: f64) -> Flow {
            Flow::Continue
        }
    }
    let compiled = percuss_scenario::read(POST, "post.toml").unwrap().compile().unwrap();
    let mut rows = Rows::default();
    simulate(&compiled.model, &compiled.settings, &mut rows).unwrap();
    let w = 6.0 * std::f64::consts::PI;
    assert_eq!(rows.rows.len(), 201);
    for [time, relative, absolute] in rows.rows {
        let base = 4.0 / w * (1.0 - (w * time).cos());
        assert!((absolute - relative - base).abs() < 1e-12, "{time}: {absolute} {relative} {base}");
        assert!((absolute - base).abs() < 1e-4, "{time}: {absolute} {base}");
    }
}
