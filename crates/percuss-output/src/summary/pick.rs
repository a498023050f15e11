//! Single numbers of a summary by their path, as in `summary.json`, without writing all of it.

use percuss::{Fault, RunSummary, path_steps};
use serde_json::Value;

use super::every_event::{
    contact_with_every_event, foundation_with_every_event, joint_with_every_event,
    plastic_with_every_event, yielding_with_every_event,
};
use super::{
    audit, contact, energy, foundation, momentum, plastic, point, projectile, section_forces,
    step_control, support,
};

/// Parts of a summary that stand once, by their names.
const PLAIN: [&str; 9] = [
    "time",
    "steps",
    "solver_steps",
    "step_cuts",
    "accumulated_steps",
    "newton_iterations",
    "factorizations",
    "rows",
    "contact_residual_max",
];
/// Parts of a summary that are tables.
const TABLES: [&str; 4] = ["energy", "momentum", "audit", "step_control"];
/// Parts of a summary with one table a name.
const NAMED: [&str; 9] = [
    "projectile",
    "contact",
    "point",
    "support",
    "plastic",
    "yielding",
    "foundation",
    "joint",
    "section_forces",
];

/// The path of a number in a summary: `contact.mass.peak_force.value`, `projectile.mass.velocity_final[1]`.
///
/// Entries of lists are counted from zero; one that a run does not have, a second impact say, is NaN.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SummaryPath {
    path: String,
    pub(super) part: String,
    /// Name of the projectile, contact, ...; empty for other parts.
    pub(super) name: String,
    /// Keys and indices within the part, shape (keys).
    pub(super) keys: Vec<String>,
}

/// A number picked, and its unit.
#[derive(Clone, Debug, PartialEq)]
pub struct Picked {
    /// The path.
    pub path: String,
    /// Unit, `1` for a pure number.
    pub unit: &'static str,
}

impl SummaryPath {
    /// The number with another last key.
    pub(super) fn beside(&self, key: &str) -> Self {
        let mut keys = self.keys.clone();
        keys.pop();
        keys.push(key.to_owned());
        Self { keys, ..self.clone() }
    }

    /// Finds a path in the summaries of runs such as `sample`; the error lists all paths there are.
    ///
    /// # Errors
    /// If no such run has a number there.
    pub fn find(path: &str, sample: &RunSummary) -> Result<Self, Vec<Picked>> {
        let all = summary_paths(sample);
        let wanted = unnumbered(&spelled(path));
        // Names may hold dots (`girder@0.5`), which are spelled alike on both sides.
        if !all.iter().any(|one| unnumbered(&spelled(&one.path)) == wanted) {
            return Err(all);
        }
        Self::split(path, sample).ok_or(all)
    }

    /// The steps of a path through the summaries of runs such as `sample`: part, name, keys and indices. A name that the run has is
    /// one step, dots and all.
    pub fn steps(path: &str, sample: &RunSummary) -> Vec<String> {
        match Self::split(path, sample) {
            Some(known) if known.name.is_empty() => {
                [known.part].into_iter().chain(known.keys).collect()
            }
            Some(known) => [known.part, known.name].into_iter().chain(known.keys).collect(),
            None => path.split('.').map(str::to_owned).collect(),
        }
    }

    /// What is no path, behind the name that the run has, if the grammar of paths has something against it.
    pub fn misspelt(path: &str, sample: &RunSummary) -> Option<Fault> {
        let (_, _, rest) = Self::parts(path, sample)?;
        if rest.is_empty() { None } else { path_steps(rest).err() }
    }

    fn split(path: &str, sample: &RunSummary) -> Option<Self> {
        let (part, name, rest) = Self::parts(path, sample)?;
        let keys = if rest.is_empty() { Vec::new() } else { path_steps(rest).ok()? };
        Some(Self { path: path.into(), part: part.into(), name, keys })
    }

    /// The part of a path, the name that the run has, dots and all, and the rest.
    fn parts<'p>(path: &'p str, sample: &RunSummary) -> Option<(&'p str, String, &'p str)> {
        let (part, rest) = path.split_once('.').unwrap_or((path, ""));
        if !NAMED.contains(&part) {
            return Some((part, String::new(), rest));
        }
        let names = names(part, sample);
        let under = |name: &&String| rest.strip_prefix(name.as_str())?.strip_prefix('.');
        let name = names.iter().filter(|n| under(n).is_some()).max_by_key(|n| n.len())?;
        Some((part, name.clone(), under(&name)?))
    }

    /// The path as given.
    pub fn path(&self) -> &str {
        &self.path
    }

    /// Unit of the number, as channels spell it; `1` for a pure number.
    pub fn unit(&self) -> &'static str {
        let mut keys: Vec<&str> = vec![&self.part];
        keys.extend(self.keys.iter().map(String::as_str));
        unit(&keys)
    }

    /// Whether it lies in the section forces or the reactions of supports, which a run may leave out.
    pub fn is_of_forces(&self) -> bool {
        ["section_forces", "support"].contains(&self.part.as_str())
            || self.keys.first().is_some_and(|key| key == "equivalent_force")
    }

    /// Whether it lies in the axial forces, shear forces or moments of beams, without their stresses and strains.
    pub fn is_of_resultants(&self) -> bool {
        let of = |key: &String| {
            let of =
                |what: &&str| key.strip_prefix(*what).is_some_and(|r| ["", "_max"].contains(&r));
            ["axial", "shear", "moment"].iter().any(of)
        };
        self.part == "section_forces" && self.keys.first().is_some_and(of)
    }

    /// Whether it lies in the stresses of beams.
    pub fn is_of_stresses(&self) -> bool {
        let of = |key: &String| ["stress", "first_beyond_strength"].contains(&key.as_str());
        self.part == "section_forces" && self.keys.first().is_some_and(of)
    }

    /// Whether it counts what the solver did, which runs side by side share.
    pub fn is_of_effort(&self) -> bool {
        ["newton_iterations", "factorizations"].contains(&self.part.as_str())
    }

    fn is_within(&self, other: &Self) -> bool {
        self.part == other.part && self.name == other.name
    }

    fn find_in<'a>(&self, part: &'a Value) -> Option<&'a Value> {
        let mut at = part;
        for key in &self.keys {
            at = match key.parse::<usize>() {
                Ok(index) if at.is_array() => at.get(index),
                _ => at.get(key),
            }?;
        }
        Some(at)
    }

    /// The number as it stands in the summary of a run.
    pub(super) fn value_in(&self, run: &RunSummary) -> Option<Value> {
        self.find_in(&part(&self.part, &self.name, run)).cloned()
    }

    fn look_up(&self, part: &Value) -> f64 {
        self.find_in(part).and_then(Value::as_f64).unwrap_or(f64::NAN)
    }
}

/// The numbers at these paths; a part of the summary that several of them lie in is looked at once.
pub fn pick(paths: &[SummaryPath], run: &RunSummary) -> Vec<f64> {
    let mut parts: Vec<(&SummaryPath, Value)> = Vec::new();
    let number = |path| {
        let known = parts.iter().position(|(other, _)| SummaryPath::is_within(path, other));
        let at = known.unwrap_or_else(|| {
            parts.push((path, part(&path.part, &path.name, run)));
            parts.len() - 1
        });
        path.look_up(&parts[at].1)
    };
    paths.iter().map(number).collect()
}

/// Every number that a summary of such runs can have; of lists that grow with a run the first entry.
pub fn summary_paths(sample: &RunSummary) -> Vec<Picked> {
    let mut all = Vec::new();
    for key in PLAIN {
        all.push(Picked { path: key.into(), unit: unit(&[key]) });
    }
    for key in TABLES {
        leaves(key, &[key], &part(key, "", sample), &mut all);
    }
    for key in NAMED {
        for name in names(key, sample) {
            let value = part_with_every_event(key, &name, sample);
            leaves(&format!("{key}.{name}"), &[key], &value, &mut all);
        }
    }
    all
}

/// Names under a part of the summary.
fn names(part: &str, run: &RunSummary) -> Vec<String> {
    match part {
        "projectile" => run.projectiles.iter().map(|p| p.name.clone()).collect(),
        "contact" => run.contacts.iter().map(|c| c.name.clone()).collect(),
        "point" => run.points.iter().map(|p| p.name.clone()).collect(),
        "support" => run.supports.iter().map(|s| s.name.clone()).collect(),
        "plastic" => run.plastic.iter().map(|beam| beam.name.clone()).collect(),
        "yielding" => run.yielding.iter().map(|c| c.name.clone()).collect(),
        "foundation" => run.foundations.iter().map(|f| f.name.clone()).collect(),
        "joint" => run.joints.iter().map(|joint| joint.name.clone()).collect(),
        "section_forces" => run.section_forces.iter().map(|s| s.name.clone()).collect(),
        _ => Vec::new(),
    }
}

/// A part of the summary as it stands in `summary.json`.
fn part(part: &str, name: &str, run: &RunSummary) -> Value {
    fn one<'a, T>(all: &'a [T], is: impl Fn(&T) -> bool, value: fn(&'a T) -> Value) -> Value {
        all.iter().find(|one| is(one)).map_or(Value::Null, value)
    }
    match part {
        "time" => run.time.into(),
        "steps" => run.steps.into(),
        "solver_steps" => run.solver_steps.into(),
        "step_cuts" => run.step_cuts.into(),
        "accumulated_steps" => run.accumulated_steps.into(),
        "newton_iterations" => run.newton_iterations.into(),
        "factorizations" => run.factorizations.into(),
        "rows" => run.rows.into(),
        "contact_residual_max" => run.contact_residual_max.into(),
        "energy" => energy(run),
        "momentum" => momentum(run),
        "audit" => audit(run),
        "step_control" => step_control(run),
        "projectile" => one(&run.projectiles, |p| p.name == name, projectile),
        "contact" => one(&run.contacts, |c| c.name == name, contact::value),
        "point" => one(&run.points, |p| p.name == name, point),
        "support" => one(&run.supports, |s| s.name == name, support),
        "plastic" => one(&run.plastic, |beam| beam.name == name, plastic::value),
        "yielding" => one(&run.yielding, |c| c.name == name, plastic::yielding),
        "foundation" => one(&run.foundations, |f| f.name == name, foundation),
        "joint" => one(&run.joints, |joint| joint.name == name, plastic::joint),
        "section_forces" => one(&run.section_forces, |s| s.name == name, section_forces),
        _ => Value::Null,
    }
}

/// A part of the summary of a run in which everything has happened that can, so that every key shows.
fn part_with_every_event(key: &str, name: &str, run: &RunSummary) -> Value {
    let contact = run.contacts.iter().find(|c| key == "contact" && c.name == name);
    let beam = run.plastic.iter().find(|beam| key == "plastic" && beam.name == name);
    let joint = run.joints.iter().find(|joint| key == "joint" && joint.name == name);
    if let Some(joint) = joint {
        return plastic::joint(&joint_with_every_event(joint));
    }
    if let Some(own) = run.foundations.iter().find(|f| key == "foundation" && f.name == name) {
        return foundation(&foundation_with_every_event(own));
    }
    if let Some(own) = run.yielding.iter().find(|c| key == "yielding" && c.name == name) {
        return plastic::yielding(&yielding_with_every_event(own));
    }
    match (contact, beam) {
        (Some(contact), _) => contact::value(&contact_with_every_event(contact)),
        (_, Some(beam)) => plastic::value(&plastic_with_every_event(beam)),
        _ => part(key, name, run),
    }
}

/// Every number in a value; unset ones are numbers too.
fn leaves(path: &str, keys: &[&str], value: &Value, all: &mut Vec<Picked>) {
    let below = |key: &str| [keys, &[key]].concat().iter().map(|k| k.to_string()).collect();
    let mut go = |path: String, key: &str, value: &Value| {
        let keys: Vec<String> = below(key);
        let keys: Vec<&str> = keys.iter().map(String::as_str).collect();
        leaves(&path, &keys, value, all);
    };
    match value {
        Value::Object(map) => map.iter().for_each(|(k, v)| go(format!("{path}.{k}"), k, v)),
        Value::Array(list) => {
            let each = list.iter().enumerate();
            each.for_each(|(i, v)| go(format!("{path}[{i}]"), &i.to_string(), v));
        }
        Value::Number(_) | Value::Null => all.push(Picked { path: path.into(), unit: unit(keys) }),
        Value::String(_) | Value::Bool(_) => {}
    }
}

/// The path with `.1` written `[1]`.
fn spelled(path: &str) -> String {
    let mut out = String::new();
    for (i, part) in path.split('.').enumerate() {
        match part.parse::<usize>() {
            Ok(index) if i > 0 => out.push_str(&format!("[{index}]")),
            _ if i > 0 => out.push_str(&format!(".{part}")),
            _ => out.push_str(part),
        }
    }
    out
}

/// The path of the first entry wherever a list grows with the run.
fn unnumbered(path: &str) -> String {
    let mut out = path.to_string();
    for list in [".intervals[", ".impacts[", ".hinges[", ".parted["] {
        if let Some((before, after)) = out.clone().split_once(list)
            && let Some((index, rest)) = after.split_once(']')
            && index.parse::<usize>().is_ok()
        {
            out = format!("{before}{list}0]{rest}");
        }
    }
    out
}

/// Unit of the number at these keys.
fn unit(keys: &[&str]) -> &'static str {
    let last = keys.iter().rev().find(|key| key.parse::<usize>().is_err()).copied().unwrap_or("");
    let has = |key: &str| keys.contains(&key);
    match last {
        "force" if has("joint") => "N",
        "moment" if has("joint") => "N*m",
        "energy" if has("parted") => "J",
        "stretch" => "m",
        "stiffness" => "N/m^2",
        "value" if has("displacement_max") || has("penetration") => "m",
        "value" if has("extension_max") || has("plastic_extension_max") => "m",
        "value" if has("rotation_max") || has("plastic_rotation_max") => "rad",
        "plastic_extension" | "accumulated_extension" => "m",
        "plastic_rotation" | "accumulated_rotation" => "rad",
        "dissipated" | "dissipated_by_preload" | "hardening" | "friction_work" => "J",
        "value" if has("pressure") || has("pressure_max") => "N/m",
        "value" if has("lifted_max") || has("plastic_deflection") => "m",
        "value" if has("energy_max") => "J",
        "value" if has("stress") || has("shear_stress") || has("von_mises_max") => "Pa",
        "value" if has("first_beyond_strength") || has("von_mises_beyond_strength") => "Pa",
        "value" if has("strain") => "1",
        "value" if has("moment") || has("moment_max") => "N*m",
        "value" => "N",
        "moment" | "deflection" if has("equivalent_force") => "N",
        "distance" | "depth" if has("carried_crush") => "m",
        "permanent_penetration" | "permanent_set" | "displacement" => "m",
        "sliding_distance" => "m",
        "length" | "element_length" => "m",
        "rotation" => "rad",
        "time" | "start" | "end" | "duration" => "s",
        "s" | "position" => "m",
        "approach_velocity" | "separation_velocity" | "velocity_final" => "m/s",
        "spin_final" => "rad/s",
        "impulse" | "tangential_impulse" | "impulse_total" | "impulse_resting" | "impulse_1"
        | "impulse_2" => "N*s",
        "impulse_moment" => "N*m*s",
        "momentum_transferred" | "linear_scale" => "kg*m/s",
        "angular_scale" => "kg*m^2/s",
        "effective_mass" | "effective_mass_limit" => "kg",
        "energy_given" | "energy_received_by_others" | "given" | "lost" | "stored" | "scheme" => {
            "J"
        }
        "residual_max" => "1",
        _ if has("energy") => "J",
        "curvature_drift_max" => "1/m",
        _ => "1",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_may_write_indices_either_way() {
        assert_eq!(
            spelled("projectile.mass.velocity_final.1"),
            "projectile.mass.velocity_final[1]"
        );
        assert_eq!(unnumbered("contact.m.intervals[12].impulse"), "contact.m.intervals[0].impulse");
    }
}
