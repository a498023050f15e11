//! What a beam hangs together with: the beams that joints and springs tie to it, and whether anything holds them.

use super::structure::coordinate_points;
use crate::math::vec2::{add, norm, rot90, scale, sub};
use crate::model::Model;
use crate::model::frozen::{ConnectorLaw, Constraint, Coordinate, Place};

/// Velocities that agree within this share of the larger one.
const SAME: f64 = 1e-9;

/// The beams that move together with one.
#[derive(Clone, Debug)]
pub struct Surroundings {
    /// Whether each of the model's beams is one of them.
    pub beams: Vec<bool>,
    /// Whether a support, or a spring to the ground, holds any of them.
    pub held: bool,
}

impl Surroundings {
    /// Those of beam number `index`.
    pub fn of(model: &Model, index: usize) -> Self {
        let ties = ties(model);
        let mut beams = vec![false; model.beams.len()];
        beams[index] = true;
        for _ in 0..ties.len() {
            let mut grown = false;
            for tie in &ties {
                if tie.beams.iter().any(|b| beams[*b]) {
                    grown |= tie.beams.iter().any(|b| !beams[*b]);
                    tie.beams.iter().for_each(|b| beams[*b] = true);
                }
            }
            if !grown {
                break;
            }
        }
        let mut of_beams = model.beams.iter().zip(&beams).filter(|(_, own)| **own);
        let held = of_beams
            .any(|(beam, _)| model.holds.iter().any(|h| beam.nodes.contains(&h.node)))
            || ties.iter().any(|tie| tie.to_ground && tie.beams.iter().any(|b| beams[*b]));
        Self { beams, held }
    }

    /// The velocity with which all of them start \[m/s\], where it is the same everywhere.
    pub fn start(&self, model: &Model) -> Option<[f64; 2]> {
        let nodes = self.nodes(model);
        let mut common: Option<[f64; 2]> = None;
        for node in nodes {
            let own = model.own_motions.iter().rev().find(|(range, _)| range.contains(&node));
            let motion = own.map_or(&model.initial_motion, |(_, motion)| motion);
            let away = sub(model.nodes[node].position, motion.about);
            let v = add(motion.velocity, scale(motion.spin, rot90(away)));
            let known = *common.get_or_insert(v);
            if norm(sub(v, known)) > SAME * norm(v).max(norm(known)) {
                return None;
            }
        }
        common
    }

    /// Whether nothing in them is strained where no load acts: no spring whose natural length is another.
    pub fn is_relaxed(&self, model: &Model) -> bool {
        model.connectors.iter().all(|one| {
            let own = coordinate_points(&one.coordinate).any(|p| self.beams[p.beam]);
            !own || match one.law {
                ConnectorLaw::Linear { rest, .. } => {
                    rest == 0.0 || is_distance(&one.coordinate, rest)
                }
                ConnectorLaw::OneSided { gap, .. } => gap >= 0.0,
            }
        })
    }

    fn nodes<'a>(&'a self, model: &'a Model) -> impl Iterator<Item = usize> + 'a {
        let own = model.beams.iter().zip(&self.beams).filter(|(_, own)| **own);
        own.flat_map(|(beam, _)| beam.nodes.clone())
    }
}

/// Whether a spring between two places has the natural length of their distance.
fn is_distance(coordinate: &Coordinate, rest: f64) -> bool {
    let Coordinate::Distance { ends } = coordinate else { return false };
    let [a, b] = ends.each_ref().map(|end| match end {
        Place::Point(point) => point.position,
        Place::Ground(position) => *position,
    });
    (norm(sub(a, b)) - rest).abs() <= SAME * rest.abs()
}

/// Something that ties beams to each other or to the ground.
struct Tie {
    beams: Vec<usize>,
    to_ground: bool,
}

fn ties(model: &Model) -> Vec<Tie> {
    let constraint = |one: &Constraint| {
        let beams: Vec<usize> = one.points().iter().map(|p| p.beam).collect();
        Tie { to_ground: beams.len() == 1, beams }
    };
    let constraints = model.constraints.iter().map(constraint);
    let connectors = model.connectors.iter().map(|one| {
        let beams: Vec<usize> = coordinate_points(&one.coordinate).map(|p| p.beam).collect();
        Tie { to_ground: beams.len() == 1, beams }
    });
    constraints.chain(connectors).collect()
}
