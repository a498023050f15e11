//! What a beam hangs together with: the beams that joints and springs tie to it, and whether anything holds them.

use percuss::Model;
use percuss::inspect::{ConnectorCoordinate, ConnectorLaw};
use percuss::math::vec2::{norm, sub};

/// Velocities that agree within this share of the larger one.
const SAME: f64 = 1e-9;

/// The beams that move together with one.
#[derive(Clone, Debug)]
pub struct Surroundings {
    /// Whether each of the model's beams is one of them, shape (beams).
    pub beams: Vec<bool>,
    /// Whether a support, a spring to the ground or a foundation holds any of them.
    pub held: bool,
}

impl Surroundings {
    /// Those of beam number `index`.
    pub fn of(model: &Model, index: usize) -> Self {
        let ties = ties(model);
        let mut beams = vec![false; model.beam_count()];
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
        let mut own = (0..beams.len()).filter(|b| beams[*b]).map(|b| model.beam(b).nodes());
        let held = own.any(|nodes| model.prescribed().any(|dofs| nodes.contains(&dofs.node)))
            || ties.iter().any(|tie| tie.to_ground && tie.beams.iter().any(|b| beams[*b]));
        Self { beams, held }
    }

    /// The velocity with which all of them start \[m/s\], where it is the same everywhere.
    pub fn start(&self, model: &Model) -> Option<[f64; 2]> {
        let nodes = self.nodes(model);
        let mut common: Option<[f64; 2]> = None;
        for node in nodes {
            let [v1, v2, ..] = model.initial_velocity(node);
            let v = [v1, v2];
            let known = *common.get_or_insert(v);
            if norm(sub(v, known)) > SAME * norm(v).max(norm(known)) {
                return None;
            }
        }
        common
    }

    /// Whether nothing in them is strained where no load acts: no spring whose natural length is another.
    pub fn is_relaxed(&self, model: &Model) -> bool {
        model.connectors().all(|one| {
            let own = one.points().any(|p| self.beams[p.beam]);
            let law = one.law();
            !own || match law {
                ConnectorLaw::Linear { rest, .. } | ConnectorLaw::Tabulated { rest, .. } => {
                    rest == 0.0 || is_distance(one.coordinate(), rest)
                }
                ConnectorLaw::OneSided { .. } => !law.acts_at(one.coordinate().reference()),
            }
        })
    }

    fn nodes<'a>(&'a self, model: &'a Model) -> impl Iterator<Item = usize> + 'a {
        let own = (0..self.beams.len()).filter(|b| self.beams[*b]);
        own.flat_map(|b| model.beam(b).nodes())
    }
}

/// Whether a spring between two places has the natural length of their distance.
fn is_distance(coordinate: ConnectorCoordinate, rest: f64) -> bool {
    let ConnectorCoordinate::Distance { reference } = coordinate else { return false };
    (reference - rest).abs() <= SAME * rest.abs()
}

/// Something that ties beams to each other or to the ground.
struct Tie {
    /// Beams that it ties, shape (beams of it) \[index of a beam\].
    beams: Vec<usize>,
    to_ground: bool,
}

fn ties(model: &Model) -> Vec<Tie> {
    let constraints = model.constraints().map(|one| {
        let beams: Vec<usize> = one.points().map(|p| p.beam).collect();
        Tie { to_ground: beams.len() == 1, beams }
    });
    let connectors = model.connectors().map(|one| {
        let beams: Vec<usize> = one.points().map(|p| p.beam).collect();
        Tie { to_ground: beams.len() == 1 && one.projectiles().next().is_none(), beams }
    });
    let founded = model.foundations().map(|one| Tie { beams: vec![one.beam()], to_ground: true });
    constraints.chain(connectors).chain(founded).collect()
}
