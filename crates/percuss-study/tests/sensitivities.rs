//! What derivatives of computed runs leave open: the size of the step, and contacts that are about to change.

use percuss_scenario::{Scenario, read};
use percuss_study::{SensitivityError, sensitivity};

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenarios/");

fn scenario(file: &str, changes: &[&str]) -> Scenario {
    let text = std::fs::read_to_string(format!("{FOLDER}{file}")).unwrap();
    let changes: Vec<String> = changes.iter().map(ToString::to_string).collect();
    let text = percuss_scenario::apply_overrides(&text, file, &changes).unwrap();
    read(&text, file).unwrap()
}

fn one(scenario: &Scenario, parameter: &str, result: &str) -> percuss_study::Sensitivity {
    sensitivity(scenario, &[parameter.into()], &[result.into()]).unwrap()
}

/// Without weight a longer way to the first touch shifts all that follows in time and changes nothing else: the velocity at the
/// end, long after the last impact, does not depend on it. What the step makes of that lies within the uncertainty.
#[test]
fn the_artefact_of_the_step_lies_within_the_uncertainty() {
    for step in ["1e-5", "5e-6", "2e-6"] {
        let rigid = scenario("paper/rigid-clamped-e0.5.toml", &[&format!("time.step={step}")]);
        let found =
            one(&rigid, "projectile.hammer.standoff", "projectile.hammer.velocity_final[1]");
        let (derivative, uncertainty) = (found.derivatives[0][0], found.uncertainties[0][0]);
        assert!(derivative.abs() <= uncertainty, "{step}: {derivative} +- {uncertainty}");
        assert!(derivative != 0.0);
    }
}

/// A derivative of second order in the step: what half the step changes is small against it.
#[test]
fn smooth_results_have_small_uncertainties() {
    let elastic = scenario("paper/elastic-clamped.toml", &[]);
    let found = one(&elastic, "projectile.mass.velocity[1]", "contact.mass.peak_force.value");
    assert!(found.uncertainties[0][0] > 0.0);
    assert!(found.uncertainties[0][0] < 1e-3 * found.derivatives[0][0].abs());
    assert!(found.one_sided.is_empty());
}

/// Between these masses a second contact comes up: on the one side it is missed by next to nothing, on the other it is there.
#[test]
fn a_grazing_contact_makes_derivatives_one_sided() {
    let stiff = "projectile.mass.stiffness=7.5e6";
    let (path, result) = ("projectile.mass.mass", "projectile.mass.velocity_final[1]");
    for (mass, appears) in [(160.27695, true), (160.2772, false)] {
        let set = format!("projectile.mass.mass={mass}");
        let found = one(&scenario("paper/elastic-clamped.toml", &[stiff, &set]), path, result);
        let told: Vec<_> = found.one_sided.iter().filter(|one| one.appears == appears).collect();
        assert_eq!(told.len(), 1, "{mass}: {:?}", found.one_sided);
        // The contact begins at 160.27695 to 160.2770 kg; beyond, the root of the distance makes first order a poor guide.
        let at = mass + told[0].change;
        assert!((at - 160.277).abs() < 5e-3, "{mass}: {at}");
        assert_eq!((told[0].contact.as_str(), told[0].parameter.as_str()), ("mass", path));
    }
    let far = one(&scenario("paper/elastic-clamped.toml", &[stiff]), path, result);
    assert!(far.one_sided.is_empty(), "{:?}", far.one_sided);
}

#[test]
fn what_has_no_derivatives_is_refused_and_no_failure_of_the_run() {
    let plastic = scenario("paper/rigid-clamped-e0.toml", &[]);
    let path = ["projectile.hammer.mass".to_owned()];
    let refused = sensitivity(&plastic, &path, &[]);
    assert!(matches!(refused, Err(SensitivityError::Refused(why)) if why.contains("stays closed")));
    let moved = scenario("sweet-spot.toml", &[]);
    let number = ["time.step".to_owned()];
    assert!(matches!(sensitivity(&moved, &number, &[]), Err(SensitivityError::Refused(_))));
}
