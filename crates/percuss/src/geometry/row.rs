//! Linear forms over the degrees of freedom of a few nodes: gradients of gaps, directions of contact forces.

/// Most nodes of a row: two of a beam that touches, and those of two elements, where the closest point is in the middle and at the end of the
/// step.
pub const CAPACITY: usize = 6;

/// A linear form over nodal values; the force it transmits acts along it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Row {
    len: usize,
    /// Its nodes, those in use first, shape (6) \[index of a node\].
    nodes: [usize; CAPACITY],
    /// Coefficients of their degrees of freedom, shape (6, 4) \[-, m for a form that is a length\].
    values: [[f64; 4]; CAPACITY],
}

impl Row {
    /// Largest change of a component along an axis from another form of the same contact; infinite if it is at other nodes.
    pub fn turned(&self, from: &Self) -> f64 {
        if self.nodes[..self.len] != from.nodes[..from.len] {
            return f64::INFINITY;
        }
        let each = self.values.iter().zip(&from.values).take(self.len);
        each.map(|(a, b)| (a[0] - b[0]).abs().max((a[1] - b[1]).abs())).fold(0.0, f64::max)
    }

    /// Adds coefficients of a node.
    pub fn add(&mut self, node: usize, coefficients: [f64; 4]) {
        let at = match self.nodes[..self.len].iter().position(|n| *n == node) {
            Some(at) => at,
            None => {
                self.nodes[self.len] = node;
                self.len += 1;
                self.len - 1
            }
        };
        (0..4).for_each(|i| self.values[at][i] += coefficients[i]);
    }

    /// Whether it has no nodes, so that no motion changes it.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// Its nodes with their coefficients.
    pub fn iter(&self) -> impl Iterator<Item = (usize, &[f64; 4])> {
        self.nodes[..self.len].iter().copied().zip(&self.values[..self.len])
    }

    /// Coefficients of a node.
    pub fn at(&self, node: usize) -> [f64; 4] {
        self.iter().find(|(n, _)| *n == node).map_or([0.0; 4], |(_, c)| *c)
    }

    /// Its nodes with their coefficients, to change.
    pub fn iter_mut(&mut self) -> impl Iterator<Item = (usize, &mut [f64; 4])> {
        self.nodes[..self.len].iter().copied().zip(&mut self.values[..self.len])
    }

    /// Its value on nodal values.
    #[inline]
    pub fn on(&self, nodal: &[[f64; 4]]) -> f64 {
        self.iter().map(|(n, c)| product(c, &nodal[n])).sum()
    }

    /// Its value on the nodes for which `belongs` holds.
    pub fn on_some(&self, nodal: &[[f64; 4]], belongs: impl Fn(usize) -> bool) -> f64 {
        self.iter().filter(|(n, _)| belongs(*n)).map(|(n, c)| product(c, &nodal[n])).sum()
    }

    /// Adds `factor` times its coefficients to nodal values.
    #[inline]
    pub fn spread(&self, factor: f64, nodal: &mut [[f64; 4]]) {
        for (n, c) in self.iter() {
            (0..4).for_each(|i| nodal[n][i] += factor * c[i]);
        }
    }
}

fn product(a: &[f64; 4], b: &[f64; 4]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]
}

/// Second derivative of a gap, or a part of it: the sum of `weights[i][j] forms[i] (x) forms[j]`.
#[derive(Clone, Copy, Debug)]
pub struct Turning {
    /// Forms on the nodes of the pair, shape (2).
    pub forms: [Row; 2],
    /// Symmetric, shape (2, 2) \[1/m between forms of motions, 1 where one is a turn, m where both are\].
    pub weights: [[f64; 2]; 2],
}
