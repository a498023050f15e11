//! Motions in which parts of the structure start.

use std::fmt;

use super::Fault;
use super::builder::ModelBuilder;
use super::definition::InitialMotion;
use super::frozen::Model;
use crate::math::vec2::{add, norm, rot90, scale, sub};

/// Velocities that differ by less than this share are the same.
const SAME: f64 = 1e-9;

impl ModelBuilder {
    /// Motions of beams, then those of point masses, which beams do not overrule.
    pub(super) fn place_motions(&self, model: &mut Model) -> Result<(), Vec<Fault>> {
        let mut faults = Vec::new();
        let mut of_masses = Vec::new();
        for (name, motion) in &self.own_motions {
            if let Some(beam) = self.beams.iter().position(|beam| beam.name == *name) {
                model.own_motions.push((model.beams[beam].nodes.clone(), *motion));
            }
            let Some(mass) = self.masses.iter().position(|mass| mass.name == *name) else {
                continue;
            };
            let point = &model.masses[mass].point;
            // Nodes of its beam where it is: one, or two where spans meet.
            let near = 1e-9 * model.beams[point.beam].length;
            let at = |node: &usize| {
                let place = model.nodes[*node].position;
                norm([place[0] - point.position[0], place[1] - point.position[1]]) <= near
            };
            let first = point.node.saturating_sub(1);
            let last = (point.node + 3).min(model.beams[point.beam].nodes.end);
            let nodes: Vec<usize> = (first..last).filter(at).collect();
            if nodes.is_empty() {
                let path = format!("initial.{name}");
                let found = "a point mass between nodes, where it has no velocity of its own";
                faults.push(Fault::new(path, found, "a point mass at a node of its beam"));
            }
            of_masses.extend(nodes.into_iter().map(|node| (node..node + 1, *motion)));
        }
        faults.extend(self.contradicting_motions(model));
        model.own_motions.extend(of_masses);
        if faults.is_empty() { Ok(()) } else { Err(faults) }
    }

    /// Motions of point masses that contradict another motion given by name at the same place, which has one velocity.
    fn contradicting_motions(&self, model: &Model) -> Vec<Fault> {
        let placed = |name: &String| {
            let mass = self.masses.iter().position(|mass| mass.name == *name)?;
            Some(&model.masses[mass].point)
        };
        let mut faults = Vec::new();
        for (k, (name, motion)) in self.own_motions.iter().enumerate() {
            let Some(point) = placed(name) else { continue };
            let others = self.own_motions.iter().enumerate().filter(|(i, (other, _))| {
                match placed(other) {
                    None => self.beams[point.beam].name == *other,
                    // Of two masses the later one is reported.
                    Some(at) => {
                        *i < k && at.beam == point.beam && (at.s - point.s).abs() <= SAME * at.s
                    }
                }
            });
            let own = PointVelocity::new(motion, point.position);
            for (_, (other, given)) in others {
                let given = PointVelocity::new(given, point.position);
                if !own.agrees(&given) {
                    let found = format!("{own} where it is, but {given} by [initial.{other}]");
                    let expected = format!(
                        "one velocity at this location: the same in both, or only one of [initial.{name}] and [initial.{other}]"
                    );
                    faults.push(Fault::new(format!("initial.{name}"), found, expected));
                }
            }
        }
        faults
    }
}

/// Velocity of a place in a motion.
struct PointVelocity {
    /// Velocity, shape (2) \[m/s\].
    velocity: [f64; 2],
    /// Angular velocity \[rad/s\].
    spin: f64,
}

impl PointVelocity {
    fn new(motion: &InitialMotion, place: [f64; 2]) -> Self {
        let turned = scale(motion.spin, rot90(sub(place, motion.about)));
        Self { velocity: add(motion.velocity, turned), spin: motion.spin }
    }

    fn agrees(&self, other: &Self) -> bool {
        let apart = norm(sub(self.velocity, other.velocity));
        let size = norm(self.velocity).max(norm(other.velocity));
        let spin = self.spin.abs().max(other.spin.abs());
        apart <= SAME * size && (self.spin - other.spin).abs() <= SAME * spin
    }
}

impl fmt::Display for PointVelocity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [v1, v2] = self.velocity;
        write!(f, "({v1}, {v2}) m/s at {} rad/s", self.spin)
    }
}
