//! What repeated runs say of the limit of a result.

use percuss_scenario::read;
use percuss_study::{ConvergeError, Ladder, converge};

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenarios/");

fn ladder(results: &[&str], accuracy: Option<f64>) -> Ladder {
    let results = results.iter().map(ToString::to_string).collect();
    Ladder { results, levels: 4, accuracy }
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
    assert!((force.limit - exact).abs() <= 1.5 * force.uncertainty, "{exact}: {force:?}");
    assert!(force.mesh.words.contains("no mesh"), "{}", force.mesh.words);
    // The step told is good for the accuracy wanted, and not much better.
    let cheapest = found.cheapest.unwrap();
    let text = DROP.replace("step = 1e-3", &format!("step = {}", cheapest.step));
    let again =
        converge(&read(&text, "drop.toml").unwrap(), &ladder, &|| true, &|_, _| {}).unwrap();
    let off = (again.results[0].value / exact - 1.0).abs();
    assert!((1e-11..1e-9).contains(&off), "{off} at {}", cheapest.step);
}

#[test]
fn a_rigid_blow_on_a_bare_node_is_said_to_depend_on_the_mesh() {
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

#[test]
fn what_would_never_end_is_refused_and_a_wish_to_stop_is_heard() {
    let scenario = read(&DROP.replace("1e-3", "1e-11"), "drop.toml").unwrap();
    let refused = converge(&scenario, &ladder(&[], None), &|| true, &|_, _| {});
    assert!(matches!(refused, Err(ConvergeError::Refused(_))));
    let scenario = read(DROP, "drop.toml").unwrap();
    let stopped = converge(&scenario, &ladder(&[], None), &|| false, &|_, _| {});
    assert!(matches!(stopped, Err(ConvergeError::Interrupted)));
}
