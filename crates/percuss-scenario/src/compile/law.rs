//! Contact laws from what leads to them.

use percuss::{Fault, HertzBody, RigidLaw, SmoothLaw, TouchLaw, hunt_crossley};

use crate::content::{HertzBodies, Law, Potential, Rebound, Sliding, Smooth};
use crate::given::Given;

/// The law of the contact at `path`.
pub(super) fn touch(
    path: &str,
    law: &Law,
    given: Option<&Given>,
    faults: &mut Vec<Fault>,
) -> TouchLaw {
    match law {
        Law::Rigid { restitution, sliding } => TouchLaw::Rigid(rigid(*restitution, sliding)),
        Law::Smooth(law) => TouchLaw::Smooth(smooth(path, law, given, faults)),
    }
}

/// The smooth law of the table at `path`; after a fault a harmless one.
pub(super) fn smooth(
    path: &str,
    law: &Smooth,
    given: Option<&Given>,
    faults: &mut Vec<Fault>,
) -> SmoothLaw {
    let own = match (&law.potential, given) {
        (Potential::Given, Some(given)) => {
            given.potential(path).map_err(|fault| faults.push(fault)).ok()
        }
        _ => None,
    };
    let mut fault = |key: &str, found: String, expected: &str| {
        faults.push(Fault::new(format!("{path}.{key}"), found, expected));
    };
    let potential = own.unwrap_or_else(|| potential(&law.potential, &mut fault));
    let dissipation = match &law.rebound {
        Some(rebound) => dissipation(rebound, &mut fault),
        None => law.dissipation.unwrap_or(0.0),
    };
    SmoothLaw { potential, dissipation, force: law.force, unloading: law.potential.unloading() }
}

/// The rigid law of a coefficient of restitution and what stands beside it.
pub(super) fn rigid(restitution: f64, sliding: &Sliding) -> RigidLaw {
    let Sliding { friction, tangential_restitution, impact_law } = *sliding;
    RigidLaw { restitution, tangential_restitution, friction, impact: impact_law }
}

fn potential(
    potential: &Potential,
    fault: &mut impl FnMut(&str, String, &str),
) -> percuss::Potential {
    match potential {
        Potential::Linear { stiffness, .. } => percuss::Potential::Linear { stiffness: *stiffness },
        Potential::Hertz { hertz: Some(bodies), .. } => hertz(bodies, fault),
        Potential::Hertz { hertz_stiffness, .. } => {
            // Values that could not be read are reported already.
            percuss::Potential::Hertz { stiffness: hertz_stiffness.unwrap_or(1.0) }
        }
        Potential::Table { .. } => match potential.columns().map(|both| both.map(Vec::from)) {
            Some([penetration, force]) => percuss::Potential::Table { penetration, force },
            None => percuss::Potential::Linear { stiffness: 1.0 }, // a fault of reading
        },
        Potential::Given => percuss::Potential::Linear { stiffness: 1.0 },
    }
}

fn hertz(bodies: &HertzBodies, fault: &mut impl FnMut(&str, String, &str)) -> percuss::Potential {
    let HertzBodies { young, poisson, radius } = bodies;
    let mut valid = true;
    let mut check = |key: &str, bad: Option<f64>, unit: &str, expected: &str| {
        if let Some(bad) = bad {
            fault(&format!("hertz.{key}"), format!("{bad}{unit}"), expected);
            valid = false;
        }
    };
    let first = |values: &[f64; 2], bad: fn(f64) -> bool| values.iter().copied().find(|v| bad(*v));
    check("young", first(young, |v| v <= 0.0), " Pa", "Young's moduli above zero");
    let ratio = first(poisson, |v| v <= -1.0 || v > 0.5);
    check("poisson", ratio, "", "Poisson's ratios above -1, up to 0.5");
    check("radius", first(radius, |v| v <= 0.0), " m", "radii above zero, or \"flat\"");
    if valid && radius.iter().all(|r| r.is_infinite()) {
        fault("hertz.radius", "two flat faces".into(), "at least one that is curved");
        valid = false;
    }
    if !valid {
        return percuss::Potential::Hertz { stiffness: 1.0 };
    }
    let body = |i: usize| HertzBody { young: young[i], poisson: poisson[i], radius: radius[i] };
    percuss::Potential::hertz([body(0), body(1)])
}

/// Hunt and Crossley's factor from what it shall lead to.
fn dissipation(rebound: &Rebound, fault: &mut impl FnMut(&str, String, &str)) -> f64 {
    let Rebound { restitution, velocity } = *rebound;
    let valid = [0.0 < restitution && restitution <= 1.0, velocity > 0.0];
    if !valid[0] {
        let expected = "a coefficient above 0, up to 1";
        fault("rebound.restitution", restitution.to_string(), expected);
    }
    if !valid[1] {
        fault("rebound.velocity", format!("{velocity} m/s"), "a velocity above zero");
    }
    if valid == [true; 2] { hunt_crossley(restitution, velocity) } else { 0.0 }
}
