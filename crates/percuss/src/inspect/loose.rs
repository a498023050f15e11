//! Ends of beams that lie at one place and that nothing ties together.

use super::{MovingPartner, PrescribedView};
use crate::math::vec2::{norm, sub};
use crate::model::Model;

/// Places nearer than this share of the size of the structure are one.
const ONE_PLACE: f64 = 1e-6;

/// Two ends of beams at one place that neither a joint nor a spring ties, no contact is between and supports do not both hold.
#[derive(Clone, Debug, PartialEq)]
pub struct LooseEnds {
    /// The beams, shape (2) \[index of a beam\].
    pub beams: [usize; 2],
    /// What a scenario calls the ends, such as `top.start`, shape (2).
    pub ends: [String; 2],
    /// Where they lie, shape (2) \[m\].
    pub position: [f64; 2],
}

impl LooseEnds {
    /// The joint that is missing, as a scenario says it.
    pub fn joint(&self) -> String {
        let [a, b] = &self.ends;
        let beam = |end: &str| end.rsplit_once('.').map_or(end, |(beam, _)| beam).to_owned();
        let name = format!("{}-{}", beam(a), beam(b));
        format!(
            "[joint.{name}] with kind = \"rigid\" (or \"hinge\") and between = [\"{a}\", \"{b}\"]"
        )
    }
}

/// A place along a beam.
struct BeamEnd {
    beam: usize,
    s: f64,
    /// Where it is, shape (2) \[m\].
    position: [f64; 2],
    /// What is tied has one number.
    group: usize,
}

/// Ends at one place that nothing ties, in the order of the beams: of three that nothing ties two pairs.
pub fn loose_ends(model: &Model) -> Vec<LooseEnds> {
    let near = ONE_PLACE * model.extent();
    let mut ends = ends(model);
    let count = ends.len();
    tie(model, &mut ends, near);
    let mut all = Vec::new();
    for j in 0..count {
        for i in 0..j {
            let (a, b) = (&ends[i], &ends[j]);
            let beams = [a.beam, b.beam];
            let apart = norm(sub(a.position, b.position)) > near;
            let held = [a, b].iter().all(|end| is_held(model, end));
            if a.group == b.group || apart || held || touch(model, beams) {
                continue;
            }
            let position = b.position;
            all.push(LooseEnds { beams, ends: [a, b].map(|end| label(model, end)), position });
            join(&mut ends, [i, j]);
        }
    }
    all
}

/// The two ends of every beam, each a group of its own.
fn ends(model: &Model) -> Vec<BeamEnd> {
    let of = |beam: usize| {
        let view = model.beam(beam);
        let nodes = view.nodes();
        [(0.0, nodes.start), (view.length(), nodes.end - 1)].map(|(s, node)| BeamEnd {
            beam,
            s,
            position: model.node_position(node),
            group: 0,
        })
    };
    let mut all: Vec<BeamEnd> = (0..model.beam_count()).flat_map(of).collect();
    all.iter_mut().enumerate().for_each(|(k, place)| place.group = k);
    all
}

/// Adds the points of joints, supports between nodes, springs and hinges, and makes groups of what they tie at one place.
fn tie(model: &Model, places: &mut Vec<BeamEnd>, near: f64) {
    let ties = model.constraints().map(|tie| tie.points().collect::<Vec<_>>());
    let springs = model.connectors().map(|spring| spring.points().collect::<Vec<_>>());
    for points in ties.chain(springs) {
        let first = places.len();
        for point in points {
            let (beam, s, position, group) = (point.beam, point.s, point.position, places.len());
            places.push(BeamEnd { beam, s, position, group });
            let new = places.len() - 1;
            for k in 0..new {
                let (a, b) = (&places[k], &places[new]);
                let same = a.beam == b.beam && (a.s - b.s).abs() <= near;
                let tied = k >= first && norm(sub(a.position, b.position)) <= near;
                if same || tied {
                    join(places, [k, new]);
                }
            }
        }
    }
}

fn join(places: &mut [BeamEnd], [a, b]: [usize; 2]) {
    let (keep, drop) = (places[a].group, places[b].group);
    places.iter_mut().filter(|place| place.group == drop).for_each(|place| place.group = keep);
}

/// Whether a support holds both displacements of an end.
fn is_held(model: &Model, end: &BeamEnd) -> bool {
    let nodes = model.beam(end.beam).nodes();
    let node = if end.s > 0.0 { nodes.end - 1 } else { nodes.start };
    let places = |held: &PrescribedView<'_>| {
        let moves = |d: &&[f64; 4]| d[2] == 0.0 && d[3] == 0.0;
        held.directions.iter().filter(moves).count()
    };
    model.prescribed_at(node).is_some_and(|held| places(&held) >= 2)
}

/// Whether a contact is between two beams.
fn touch(model: &Model, [a, b]: [usize; 2]) -> bool {
    let both = [a, b].map(MovingPartner::Beam);
    let is_theirs =
        |partners: &[MovingPartner; 2]| *partners == both || partners.iter().rev().eq(both.iter());
    model.contacts().any(|contact| contact.pairs().any(|(partners, _)| is_theirs(&partners)))
}

fn label(model: &Model, end: &BeamEnd) -> String {
    let which = if end.s > 0.0 { "end" } else { "start" };
    format!("{}.{which}", model.beam(end.beam).name())
}
