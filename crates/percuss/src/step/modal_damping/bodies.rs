//! Bodies: parts connected by elements, joints and springs, which move as a whole if they are unsupported.

use super::ModalDamping;
use super::ground::{StepView, acts, apart};
use crate::model::Model;

/// Bodies of a structure in the current state, and the initial configuration of each.
#[derive(Clone, Debug, Default)]
pub struct Bodies {
    /// Body of each node, shape (nodes of beams) \[index of a body\].
    pub of_node: Vec<usize>,
    /// Their lengths, shape (bodies) \[m\].
    pub lengths: Vec<f64>,
    /// `M X` and `M J X` with positions and tangents X at the start, about each body's centre of mass, shape (2, nodes of beams, 4)
    /// \[kg m, kg m^2\].
    pub weighed: [Vec<[f64; 4]>; 2],
    /// Connections of nodes, shape (elements, constraints and connectors).
    links: Vec<bool>,
}

/// Connections of nodes in a step: flags of intact elements, of constraints and of connectors.
fn links(view: &StepView) -> impl Iterator<Item = bool> {
    let (model, state) = (view.model, view.state);
    let whole = model.each_element().map(|(_, _, a, _)| !state.has_parted(a));
    let springs = (0..model.connectors.len()).map(|i| acts(view, i));
    whole.chain(view.forcing.constrained.iter().copied()).chain(springs)
}

/// Root of a node among nodes that point to one another.
fn root(parent: &mut [usize], mut node: usize) -> usize {
    while parent[node] != node {
        parent[node] = parent[parent[node]];
        node = parent[node];
    }
    node
}

/// Body of each node, numbered in the order of their nodes, and the number of bodies.
fn numbered(view: &StepView, links: &[bool]) -> (Vec<usize>, usize) {
    let model = view.model;
    let mut parent: Vec<usize> = (0..model.beam_node_count()).collect();
    let mut join = |a: usize, b: usize| {
        let (a, b) = (root(&mut parent, a), root(&mut parent, b));
        parent[a.max(b)] = a.min(b);
    };
    let mut link = links.iter();
    let mut holds = || *link.next().unwrap_or(&false);
    for (_, _, a, _) in model.each_element() {
        if holds() {
            join(a, a + 1);
        }
    }
    for c in &model.constraints {
        if let (true, [a, b]) = (holds(), c.points()) {
            join(near(a), near(b));
        }
    }
    for c in &model.connectors {
        let ends: Vec<usize> = c.on_beams().map(near).collect();
        if let (true, [a, b]) = (holds(), &ends[..]) {
            join(*a, *b);
        }
    }
    let mut number = vec![usize::MAX; parent.len()];
    let mut count = 0;
    let of_node = (0..parent.len())
        .map(|node| {
            let root = root(&mut parent, node);
            if number[root] == usize::MAX {
                number[root] = count;
                count += 1;
            }
            number[root]
        })
        .collect();
    (of_node, count)
}

/// The node with the largest share of a point.
fn near(p: &crate::model::frozen::MaterialPoint) -> usize {
    p.node + usize::from(p.shape[2] > p.shape[0])
}

impl Bodies {
    /// Updates the connections that have failed, opened or closed since the last step.
    pub fn follow(&mut self, damping: &ModalDamping, view: &StepView) {
        if self.lengths.is_empty() || !links(view).eq(self.links.iter().copied()) {
            *self = Self::new(damping, view);
        }
    }

    fn new(damping: &ModalDamping, view: &StepView) -> Self {
        let links: Vec<bool> = links(view).collect();
        let (of_node, count) = numbered(view, &links);
        let start = &damping.start;
        let mut lengths = vec![0.0_f64; count];
        let mut first = vec![None; count];
        for (x, body) in start.iter().zip(&of_node) {
            let from = first[*body].get_or_insert(x);
            lengths[*body] = lengths[*body].max(apart(x, from));
        }
        let weighed = weighed(damping, &of_node, count);
        Self { of_node, lengths, weighed, links }
    }

    /// Number of bodies.
    pub fn count(&self) -> usize {
        self.lengths.len()
    }
}

/// `M X` and `M J X` about each body's centre of mass.
fn weighed(damping: &ModalDamping, of_node: &[usize], count: usize) -> [Vec<[f64; 4]>; 2] {
    let start = &damping.start;
    let unit = |k: usize| vec![std::array::from_fn(|i| f64::from(u8::from(i == k))); start.len()];
    let mass = [0, 1].map(|k| damping.mass.multiply(&unit(k)));
    let mut sums = vec![[0.0; 2]; count];
    let mut total = vec![[0.0; 2]; count];
    for (n, body) in of_node.iter().enumerate() {
        for k in 0..2 {
            let along = |x: &[f64; 4]| mass[k][n][k] * x[k] + mass[k][n][2 + k] * x[2 + k];
            sums[*body][k] += along(&start[n]);
            total[*body][k] += mass[k][n][k];
        }
    }
    let centred: Vec<[f64; 4]> = (start.iter().zip(of_node))
        .map(|(x, body)| {
            let centre = [0, 1].map(|k| sums[*body][k] / total[*body][k]);
            [x[0] - centre[0], x[1] - centre[1], x[2], x[3]]
        })
        .collect();
    let turned: Vec<[f64; 4]> = centred.iter().map(|x| [-x[1], x[0], -x[3], x[2]]).collect();
    [damping.mass.multiply(&centred), damping.mass.multiply(&turned)]
}

/// Positions and tangents of the beams' nodes in a configuration, shape (nodes of beams, 4) \[m, -\].
pub fn positions(model: &Model, u: &[[f64; 4]]) -> Vec<[f64; 4]> {
    let at = |(frame, u): (&crate::element::beam::NodeFrame, &[f64; 4])| {
        let ([x, y], [g, k]) = (frame.position, frame.tangent);
        [x + u[0], y + u[1], g + u[2], k + u[3]]
    };
    model.nodes[..model.beam_node_count()].iter().zip(u).map(at).collect()
}
