//! What is round-off for people: one threshold for terminal, pages, summary text and pictures.
//!
//! Numbers in files are never changed. What a reader sees is zero, or is left out, where it is less than [`ROUND_OFF`] of the largest of its
//! kind in the run, or of what a structure has that is at rest but for round-off.

use percuss::{Equilibrium, SectionForceSummary};
use serde_json::Value;

/// What is below this share of the largest of its kind is round-off. Residuals of balances are some 1e-14 of the largest energy; velocities and
/// forces that follow from it are exact to some 1e-10.
pub const ROUND_OFF: f64 = 1e-9;

/// The kind of smallest strain, slope, and displacement as a share of a beam's length beside which others are measured: strains are
/// differences of numbers of the size of one, so that 1e-13 of them is round-off.
pub const LEAST: f64 = 1e-4;

/// Impulses of supports below this share of the momentum of the run are those of the instants in which a motion begins.
pub const SMALL_IMPULSE: f64 = 1e-6;

/// A plastic stretch that turns by less is no plastic hinge for a reader: the beam has yielded, and that is reported \[rad\].
pub const HINGE: f64 = 1e-4;

/// Share of the other place below which that of an extreme value is the start of the beam: a place at which a smooth function is largest is
/// known to the root of round-off, 1e-8.
pub const NO_DISTANCE: f64 = 1e-7;

/// Gaps below this are none \[m\].
pub const NO_GAP: f64 = 1e-12;

/// Whether a value is round-off beside `scale`; what is not a number is none.
pub fn is_round_off(value: f64, scale: f64) -> bool {
    value.abs() <= ROUND_OFF * scale.abs()
}

/// `value`, or zero where it is round-off beside `scale`.
pub fn without_round_off(value: f64, scale: f64) -> f64 {
    if is_round_off(value, scale) { 0.0 } else { value }
}

/// What the numbers of a run are measured by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scales {
    /// Largest energy \[J\]; infinite where nothing moves.
    pub energy: f64,
    /// Largest momentum \[N s\].
    pub momentum: f64,
    /// Largest angular momentum \[N m s\].
    pub angular: f64,
    /// Twice the energy over the momentum \[m/s\].
    pub velocity: f64,
    /// Largest displacement of a recorded point or permanent deflection, or a share of the longest beam \[m\].
    pub length: f64,
}

impl Scales {
    /// Those of a run, from its summary.
    pub fn of(summary: &Value) -> Self {
        let number =
            |pointer: &str| summary.pointer(pointer).and_then(Value::as_f64).unwrap_or(0.0);
        let (energy, momentum) = (number("/energy/scale"), number("/momentum/linear_scale"));
        let velocity = if momentum > 0.0 { 2.0 * energy / momentum } else { 0.0 };
        let still = is_still(summary);
        Self {
            energy: if still { f64::INFINITY } else { energy },
            momentum,
            angular: number("/momentum/angular_scale"),
            velocity,
            length: moved(summary).max(LEAST * longest(summary)),
        }
    }
}

/// Whether a run did nothing: no body but beams, none of which is strained or displaced by more than round-off.
pub fn is_still(summary: &Value) -> bool {
    let beams = summary["section_forces"].as_object().filter(|beams| !beams.is_empty());
    let bodies = summary["projectile"].as_object().is_some_and(|all| !all.is_empty());
    let points = summary["point"].as_object().is_some_and(|all| !all.is_empty());
    let known = |beam: &Value| beam["strain"]["max"]["value"].is_number();
    beams.is_some_and(|all| all.values().all(|beam| known(beam) && is_unstrained(beam)))
        && points
        && !bodies
        && is_round_off(moved(summary), LEAST * longest(summary))
}

/// Whether the strains of a beam of a summary are known and round-off; its section forces and stresses then are, too.
pub fn is_unstrained(beam: &Value) -> bool {
    let strains = ["min", "max"].map(|end| beam["strain"][end]["value"].as_f64());
    strains.iter().all(|strain| strain.is_some_and(|value| is_round_off(value, LEAST)))
}

/// What the section forces and stresses of a beam at rest are measured by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SectionScales {
    /// Largest axial or shear force: one of them alone might be round-off \[N\]. Infinite, as the others, where the beam is not strained.
    pub force: f64,
    /// Largest moment \[N m\].
    pub moment: f64,
    /// Largest fibre stress \[Pa\].
    pub stress: f64,
}

impl SectionScales {
    /// Those of a beam.
    pub fn of(beam: &SectionForceSummary) -> Self {
        let strains = [beam.strain.min.value, beam.strain.max.value];
        if strains.iter().all(|strain| is_round_off(*strain, LEAST)) {
            let all = f64::INFINITY;
            return Self { force: all, moment: all, stress: all };
        }
        let size = |range: &percuss::SectionRange| range.largest().value.abs();
        let stress = size(&beam.stress).max(size(&beam.shear_stress));
        Self { force: size(&beam.axial).max(size(&beam.shear)), moment: size(&beam.moment), stress }
    }

    /// A value of a unit as channels spell it, zero where it is round-off.
    pub fn plain(&self, value: f64, unit: &str) -> f64 {
        let scale = match unit {
            "N" => self.force,
            "N*m" => self.moment,
            _ => self.stress,
        };
        without_round_off(value, scale)
    }
}

/// What the displacements and forces of an equilibrium are measured by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StaticScales {
    /// Largest displacement of a recorded point, or a share of the longest beam \[m\].
    pub moved: f64,
    /// Largest rotation of one, or that of which slopes have the round-off of numbers of the size of one \[rad\].
    pub turned: f64,
    /// Largest force of a support, of a foundation, and of all springs to the ground \[N\].
    pub force: f64,
    /// That, or the largest moment of a support, if that is larger \[N m\].
    pub moment: f64,
}

impl StaticScales {
    /// Those of an equilibrium.
    pub fn of(found: &Equilibrium) -> Self {
        let reactions = || found.reactions.iter().map(|(_, reaction)| reaction);
        let forces = reactions().flat_map(|reaction| &reaction[..2]);
        let others = found.foundations.iter().flat_map(|one| &one.force);
        let force = largest(forces.chain(others).chain(&found.balance.springs));
        // The last place of an envelope is the end of its beam.
        let longest = largest(found.section_forces.iter().flat_map(|beam| &beam.envelope.s));
        let moved = largest(found.points.iter().flat_map(|(_, moved)| moved));
        Self {
            moved: moved.max(LEAST * longest),
            turned: largest(&found.rotations).max(LEAST),
            force,
            moment: largest(reactions().map(|reaction| &reaction[2])).max(force),
        }
    }
}

fn largest<'a>(values: impl IntoIterator<Item = &'a f64>) -> f64 {
    values.into_iter().fold(0.0, |most: f64, value| most.max(value.abs()))
}

/// Largest displacement of a recorded point, and permanent deflection.
fn moved(summary: &Value) -> f64 {
    let all = |part: &str| summary[part].as_object().into_iter().flat_map(|all| all.values());
    let components = ["component_1", "component_2"];
    let points =
        all("point").flat_map(|p| components.map(|c| p["displacement_max"][c]["value"].as_f64()));
    let sets = all("plastic").map(|beam| beam["permanent_set"].as_f64());
    points.chain(sets).flatten().map(f64::abs).fold(0.0, f64::max)
}

/// Length of the longest beam.
fn longest(summary: &Value) -> f64 {
    let beams = summary["section_forces"].as_object().into_iter().flat_map(|all| all.values());
    beams.filter_map(|beam| beam["length"].as_f64()).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn at_rest(strain: f64, displacement: f64) -> Value {
        json!({
            "energy": { "scale": 1e-16 }, "momentum": { "linear_scale": 0.0 },
            "point": { "a.mid": { "displacement_max": { "component_1": { "value": displacement } } } },
            "section_forces": { "a": { "length": 2.0, "strain": { "min": { "value": -strain }, "max": { "value": strain } } } },
        })
    }

    #[test]
    fn a_structure_at_rest_does_nothing_and_one_that_sounds_does() {
        assert!(is_still(&at_rest(4e-15, 3e-16)));
        assert!(!is_still(&at_rest(4e-12, 3e-16)), "1 Pa in steel is a stress");
        assert!(!is_still(&at_rest(4e-15, 3e-12)));
        assert_eq!(Scales::of(&at_rest(4e-15, 3e-16)).energy, f64::INFINITY);
    }

    #[test]
    fn round_off_is_a_billionth_of_its_kind() {
        assert_eq!(without_round_off(1e-10, 1.0), 0.0);
        assert_eq!(without_round_off(1e-8, 1.0), 1e-8);
        assert!(!is_round_off(f64::NAN, 1.0));
    }
}
