//! Coincident ends of beams that are not connected.

use std::collections::{BTreeMap, HashMap, HashSet};

use super::PrescribedView;
use crate::math::vec2::{norm, sub};
use crate::model::Model;

/// Places nearer than this share of the size of the structure are one.
const ONE_PLACE: f64 = 1e-6;

/// Two ends of beams at one place that neither a joint nor a spring ties, no contact is between and supports do not both hold.
#[derive(Clone, Debug, PartialEq)]
pub struct LooseEnds {
    /// The beams, shape (2) \[index of a beam\].
    pub beams: [usize; 2],
    /// Names of the ends in a scenario, such as `top.start`, shape (2).
    pub ends: [String; 2],
    /// Where they lie, shape (2) \[m\].
    pub position: [f64; 2],
}

impl LooseEnds {
    /// The missing joint, as written in a scenario.
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
}

/// Coincident ends that are not connected, in the order of the beams: two pairs for three ends.
pub fn loose_ends(model: &Model) -> Vec<LooseEnds> {
    let near = ONE_PLACE * model.extent();
    let ends = ends(model);
    let mut groups = Groups::new(ends.len());
    tie(model, &ends, near, &mut groups);
    let touching: HashSet<[usize; 2]> = model.pairs.iter().map(|pair| pair.movers).collect();
    let touch = |[a, b]: [usize; 2]| touching.contains(&[a, b]) || touching.contains(&[b, a]);
    let mut corners = Corners { near, cells: HashMap::new() };
    let mut all = Vec::new();
    for (j, end) in ends.iter().enumerate() {
        let held = is_held(model, end);
        let loose = |i: usize| {
            let other = &ends[i];
            norm(sub(end.position, other.position)) <= near && !touch([other.beam, end.beam])
        };
        for i in corners.first_of_each_group((end.position, held), groups.of(j), &mut groups, loose)
        {
            let beams = [ends[i].beam, end.beam];
            let labels = [&ends[i], end].map(|end| label(model, end));
            all.push(LooseEnds { beams, ends: labels, position: end.position });
            groups.join(i, j);
        }
        corners.add(end.position, held, j);
    }
    all
}

/// The two ends of every beam.
fn ends(model: &Model) -> Vec<BeamEnd> {
    let of = |beam: usize| {
        let view = model.beam(beam);
        let nodes = view.nodes();
        [(0.0, nodes.start), (view.length(), nodes.end - 1)].map(|(s, node)| BeamEnd {
            beam,
            s,
            position: model.node_position(node),
        })
    };
    (0..model.beam_count()).flat_map(of).collect()
}

/// Makes groups of the ends that the points of joints, supports between nodes, springs and hinges tie at one place.
fn tie(model: &Model, ends: &[BeamEnd], near: f64, groups: &mut Groups) {
    // Places on beams by the cell of arc length that holds them, each with a member of its group.
    let mut along: HashMap<(usize, i64), Vec<(f64, usize)>> = HashMap::new();
    let mut place = |beam: usize, s: f64, groups: &mut Groups, group: usize| {
        let cell = cell(s, near);
        for next in [cell.saturating_sub(1), cell, cell.saturating_add(1)] {
            let there = along.get(&(beam, next)).into_iter().flatten();
            let same = there.filter(|(own, _)| (own - s).abs() <= near);
            same.for_each(|(_, of)| groups.join(*of, group));
        }
        let own = along.entry((beam, cell)).or_default();
        if own.iter().all(|(there, _)| *there != s) {
            own.push((s, group));
        }
    };
    for (k, end) in ends.iter().enumerate() {
        place(end.beam, end.s, groups, k);
    }
    let ties = model.constraints().map(|tie| tie.points().collect::<Vec<_>>());
    let springs = model.connectors().map(|spring| spring.points().collect::<Vec<_>>());
    for points in ties.chain(springs) {
        let own: Vec<usize> = points.iter().map(|_| groups.add()).collect();
        for (k, point) in points.iter().enumerate() {
            place(point.beam, point.s, groups, own[k]);
            for (before, group) in points.iter().zip(&own).take(k) {
                if norm(sub(before.position, point.position)) <= near {
                    groups.join(*group, own[k]);
                }
            }
        }
    }
}

/// Number of the cell of size `near` that holds a coordinate.
fn cell(x: f64, near: f64) -> i64 {
    (x / near).floor() as i64
}

/// Connected points, as sets of numbers.
struct Groups {
    /// Another member of the same group, or itself, shape (members) \[index of a member\].
    leader: Vec<usize>,
}

impl Groups {
    fn new(count: usize) -> Self {
        Self { leader: (0..count).collect() }
    }

    /// One more member, of a group of its own.
    fn add(&mut self) -> usize {
        self.leader.push(self.leader.len());
        self.leader.len() - 1
    }

    /// The group of a member.
    fn of(&mut self, mut member: usize) -> usize {
        while self.leader[member] != member {
            self.leader[member] = self.leader[self.leader[member]];
            member = self.leader[member];
        }
        member
    }

    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.of(a), self.of(b));
        self.leader[a.max(b)] = a.min(b);
    }
}

/// Ends by the cell of the plane that they lie in, so that each is held against its neighbours alone.
struct Corners {
    near: f64,
    /// Lists of ends of one group each: free ones, and those that a support holds, shape (cells, 2, lists, ends of one)
    /// \[index of a cell, index of an end\].
    cells: HashMap<[i64; 2], [Vec<Vec<usize>>; 2]>,
}

impl Corners {
    fn add(&mut self, position: [f64; 2], held: bool, end: usize) {
        let key = position.map(|x| cell(x, self.near));
        self.cells.entry(key).or_default()[usize::from(held)].push(vec![end]);
    }

    /// Of every group but `own` the first end near a position for which `loose` holds, in their order. Two ends that supports hold are no
    /// pair.
    fn first_of_each_group(
        &mut self,
        (position, held): ([f64; 2], bool),
        own: usize,
        groups: &mut Groups,
        loose: impl Fn(usize) -> bool,
    ) -> Vec<usize> {
        let mut first: BTreeMap<usize, usize> = BTreeMap::new();
        let [x, y] = position.map(|x| cell(x, self.near));
        let beside = |c: i64| [c.saturating_sub(1), c, c.saturating_add(1)];
        for key in beside(x).into_iter().flat_map(|x| beside(y).map(|y| [x, y])) {
            let Some([free, fixed]) = self.cells.get_mut(&key) else { continue };
            for lists in std::iter::once(free).chain((!held).then_some(fixed)) {
                merge(lists, groups);
                for list in lists.iter() {
                    let group = groups.of(list[0]);
                    if group != own
                        && let Some(found) = list.iter().copied().find(|end| loose(*end))
                    {
                        let least = first.entry(group).or_insert(found);
                        *least = found.min(*least);
                    }
                }
            }
        }
        let mut all: Vec<usize> = first.into_values().collect();
        all.sort_unstable();
        all
    }
}

/// Makes one list of those of one group.
fn merge(lists: &mut Vec<Vec<usize>>, groups: &mut Groups) {
    if lists.len() < 2 {
        return;
    }
    let mut by_group: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for mut list in lists.drain(..) {
        by_group.entry(groups.of(list[0])).or_default().append(&mut list);
    }
    lists.extend(by_group.into_values().map(|mut list| {
        list.sort_unstable();
        list
    }));
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

fn label(model: &Model, end: &BeamEnd) -> String {
    let which = if end.s > 0.0 { "end" } else { "start" };
    format!("{}.{which}", model.beam(end.beam).name())
}
