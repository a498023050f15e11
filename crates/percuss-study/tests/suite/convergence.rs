//! What repeated runs say of the limit of a result.

use percuss_scenario::read;
use percuss_study::{ConvergeError, Ladder, converge};

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenarios/");

fn ladder(results: &[&str], accuracy: Option<f64>) -> Ladder {
    let results = results.iter().map(ToString::to_string).collect();
    Ladder { results, refine: Vec::new(), levels: 4, accuracy }
}

fn of(file: &str, changes: &[&str], ladder: &Ladder) -> percuss_study::Convergence {
    let text = std::fs::read_to_string(format!("{FOLDER}{file}")).unwrap();
    let changes: Vec<String> = changes.iter().map(ToString::to_string).collect();
    let text = percuss_scenario::apply_overrides(&text, file, &changes).unwrap();
    converge(&read(&text, file).unwrap(), ladder, &|| true, &|_, _| {}).unwrap()
}

/// A disc in a uniform field against a linear spring: `F = m v w sqrt(1 + (g/(v w))^2) + m g` with `w^2 = k/m`, v at the touch.
const DROP: &str = r#"
[projectile.ball]
kind = "elastic"
contact = "surface"
mass = 2
radius = 0.1
stiffness = 2e4
position = [0, 0.1]
velocity = [0, -3]
strikes = "floor"
[obstacle.floor]
kind = "half-plane"
point = [0, 0]
normal = [0, 1]
[load.weight]
kind = "gravity"
acceleration = [0, -9.81]
[time]
end = 0.02
step = 1e-3
"#;

#[test]
fn the_limit_of_a_contact_is_its_closed_form_within_its_uncertainty() {
    let scenario = read(DROP, "drop.toml").unwrap();
    let ladder = ladder(&["contact.ball.peak_force.value"], Some(1e-9));
    let found = converge(&scenario, &ladder, &|| true, &|_, _| {}).unwrap();
    let (m, v, w, g) = (2.0, 3.0, 100.0, 9.81);
    let exact = m * v * w * f64::hypot(1.0, g / (v * w)) + m * g;
    let force = &found.results[0];
    let order = force.step.found.order.unwrap_or(f64::NAN);
    // Second order at least; nearly all of this error is that of the instant of touch.
    assert!((1.7..3.5).contains(&order), "{force:?}");
    assert!((force.limit - exact).abs() <= force.uncertainty, "{exact}: {force:?}");
    assert!(force.mesh.words.contains("no mesh"), "{}", force.mesh.words);
    // The step reported is good for the accuracy wanted, and not much better.
    let cheapest = found.cheapest.unwrap();
    let text = DROP.replace("step = 1e-3", &format!("step = {}", cheapest.step));
    let again =
        converge(&read(&text, "drop.toml").unwrap(), &ladder, &|| true, &|_, _| {}).unwrap();
    let off = (again.results[0].value / exact - 1.0).abs();
    assert!((1e-11..1e-9).contains(&off), "{off} at {}", cheapest.step);
}

#[test]
fn a_rigid_impact_on_a_bare_node_is_said_to_depend_on_the_mesh() {
    let ladder = Ladder { levels: 3, ..ladder(&["contact.hammer.impacts[0].impulse"], Some(0.01)) };
    let found =
        of("paper/rigid-clamped-e1.toml", &["time.end=2e-3", "beam.girder.elements=12"], &ladder);
    let impulse = &found.results[0];
    assert!(
        impulse.limit.is_nan() && impulse.mesh.words.contains("depends on the mesh"),
        "{impulse:?}"
    );
    assert_eq!(found.cheapest.unwrap().out_of_reach.len(), 1);
}

/// The limit of Timoshenko's theory, by Laplace inversion: `percuss verify shear-impact`.
#[test]
fn a_mass_that_stays_on_a_shear_flexible_beam_has_a_limit() {
    let ladder = Ladder { levels: 3, ..ladder(&["projectile.hammer.velocity_final[1]"], None) };
    let changes = [
        "projectile.hammer.restitution=0",
        "projectile.hammer.standoff=0",
        "time.end=1e-4",
        "time.step=1e-6",
        "beam.girder.elements=100",
        "material.stiff.poisson=0.3",
        "section.plank.shear_factor=0.8333333333333333",
        "beam.girder.theory=shear",
    ];
    let found = of("paper/rigid-clamped-e1.toml", &changes, &ladder);
    let velocity = &found.results[0];
    // Its displacements are small; those of 40 m/s change the velocity by 5e-5.
    assert!((velocity.limit + 14.139_457_9).abs() < 2e-3, "{velocity:?}");
}

#[test]
fn endless_convergence_is_refused_and_a_wish_to_stop_is_heard() {
    let scenario = read(&DROP.replace("1e-3", "1e-11"), "drop.toml").unwrap();
    let refused = converge(&scenario, &ladder(&[], None), &|| true, &|_, _| {});
    assert!(matches!(refused, Err(ConvergeError::Refused(_))));
    let scenario = read(DROP, "drop.toml").unwrap();
    let stopped = converge(&scenario, &ladder(&[], None), &|| false, &|_, _| {});
    assert!(matches!(stopped, Err(ConvergeError::Interrupted)));
}

/// A cantilever that yields under a heavy impact, with four fibres only.
const YIELDS: &str = r#"
[material.m]
preset = "steel"
yield = "235 MPa"
hardening = { isotropic = "2 GPa" }
[section.s]
shape = "rectangle"
width = 0.04
depth = 0.05
fibres = 4
[beam.b]
points = [[0, 0], [1, 0]]
elements = 4
material = "m"
section = "s"
[support.a]
at = "b.start"
kind = "clamp"
[projectile.p]
kind = "elastic"
mass = 60
stiffness = 2e5
velocity = [0, -3]
strikes = "b.end"
[time]
end = 0.08
step = 1e-3
"#;

/// Sixteen times the steps, elements and fibres give a set of 25.4278 mm and a velocity of 1.95994 m/s.
#[test]
fn fibres_are_refined_where_sections_yield() {
    let scenario = read(YIELDS, "yields.toml").unwrap();
    let wanted = ["plastic.b.permanent_set", "projectile.p.velocity_final[1]"];
    let found = converge(&scenario, &ladder(&wanted, Some(0.03)), &|| true, &|_, _| {}).unwrap();
    assert_eq!(found.fibres, [4, 8, 16, 32]);
    for (one, truth) in found.results.iter().zip([0.025_427_783, 1.959_939_6]) {
        let sequences = [&one.step, &one.mesh, &one.fibres, &one.together];
        assert!(
            sequences.iter().all(|one| one.values.len() == 4 && !one.found.constant),
            "{one:?}"
        );
        assert!((one.limit - truth).abs() <= one.uncertainty, "{truth}: {one:?}");
        assert!(one.uncertainty < 0.01 * truth, "{one:?}");
    }
    // The given settings are within 1.5 % of both limits.
    let cheapest = found.cheapest.unwrap();
    assert!(cheapest.cost <= 1.0 && cheapest.out_of_reach.is_empty(), "{cheapest:?}");
    let stays = YIELDS.replace("235 MPa", "2 GPa");
    let scenario = read(&stays, "stays.toml").unwrap();
    let found = converge(&scenario, &ladder(&wanted[1..], None), &|| true, &|_, _| {}).unwrap();
    assert_eq!(found.fibres, [1]);
    assert!(found.results[0].fibres.words.contains("no yielding section"), "{found:?}");
}

/// With the given step the largest moment is a hogging one, with half the step and ever after a sagging one; with a thirty-second of the
/// step, and 320 elements, it is 926.52 N m.
#[test]
fn a_largest_magnitude_has_the_sign_of_the_finest_run() {
    let text = r#"
[material.m]
preset = "aluminium"
retardation = "10 us"
[section.s]
shape = "rectangle"
width = "29.5 mm"
depth = "39.5 mm"
[beam.b]
points = [[0, 0], ["1.429 m", 0]]
elements = 10
material = "m"
section = "s"
[support.a]
at = "b.start"
kind = "clamp"
[support.z]
at = "b.end"
kind = "stop"
direction = [0, -1]
gap = "0.99 mm"
stiffness = "1.45e6 N/m"
[projectile.p]
kind = "elastic"
contact = "surface"
radius = "0.039 m"
mass = "1.74 kg"
stiffness = "2.718e6 N/m"
position = ["0.7145 m", "0.05884 m"]
velocity = ["0.852 m/s", "-3.48 m/s"]
strikes = "b"
[load.g]
kind = "gravity"
acceleration = [0, -9.81]
[time]
end = 0.02268
step = 0.00025
"#;
    let scenario = read(text, "hogs.toml").unwrap();
    let ladder = ladder(&["section_forces.b.moment_max.value"], None);
    let found = converge(&scenario, &ladder, &|| true, &|_, _| {}).unwrap();
    let moment = &found.results[0];
    // Magnitudes are compared, with the sign of the finest run, as the limit has it.
    assert!((839.0..840.0).contains(&moment.value), "{moment:?}");
    assert_eq!(moment.together.values[0], -moment.value);
    assert!((moment.limit - 926.5210526).abs() <= moment.uncertainty, "{moment:?}");
    assert!(
        moment.uncertainty < 3.0
            && moment.step.words.contains("the sign of the largest magnitude changes"),
        "{moment:?}"
    );
}

/// A cantilever whose clamp is moved along a ramp: the velocity jumps at its ends.
const JUMPS: &str = r#"
[material.m]
preset = "steel"
[section.s]
shape = "rectangle"
width = "5 cm"
depth = "5 cm"
[beam.b]
points = [[0, 0], [1, 0]]
elements = 4
material = "m"
section = "s"
[support.left]
at = "b.start"
kind = "clamp"
motion = { displacement = [0, "1 mm"], function = { kind = "ramp", duration = "2 ms" } }
[time]
end = "3 ms"
step = "20 us"
"#;

/// What the run itself says has no limit (W013) has none here; the displacement has one.
#[test]
fn reactions_and_shear_forces_after_velocity_jumps_have_no_limit() {
    let paths = [
        "support.left.force_2.max.value",
        "section_forces.b.shear_max.value",
        "section_forces.b.moment_max.value",
    ];
    let ladder = Ladder { levels: 3, ..ladder(&paths, None) };
    let found =
        converge(&read(JUMPS, "jumps.toml").unwrap(), &ladder, &|| true, &|_, _| {}).unwrap();
    for one in &found.results[..2] {
        assert!(one.limit.is_nan() && one.uncertainty.is_nan(), "{one:?}");
        assert!(one.mesh.words.contains("velocity jump of support 'left'"), "{}", one.mesh.words);
    }
    assert!(!found.results[2].mesh.words.contains("W013"), "{:?}", found.results[2]);
}

/// The force of a ball on a spring, a half sine: rows every sixth of it meet its top by chance only, and the run knows it.
#[test]
fn largest_values_of_columns_are_those_of_the_run_not_of_its_rows() {
    let text = format!(
        "{}[record]\nevery = 5\n",
        DROP.replace("step = 1e-3", "step = 2e-3").replace("end = 0.02", "end = 0.04")
    );
    let ladder = ladder(&["projectile.ball.velocity_2", "contact.ball.force"], None);
    let found =
        converge(&read(&text, "drop.toml").unwrap(), &ladder, &|| true, &|_, _| {}).unwrap();
    let (m, v, w, g) = (2.0, 3.0, 100.0, 9.81);
    let exact = m * v * w * f64::hypot(1.0, g / (v * w)) + m * g;
    let force = &found.results[1];
    assert!((force.limit / exact - 1.0).abs() < 0.01, "{exact}: {force:?}");
    assert!((force.limit - exact).abs() <= force.uncertainty, "{exact}: {force:?}");
}
