//! A configuration within a step: its start and a share of its increment.

/// Displacements `u + share d` of the nodes.
#[derive(Clone, Copy, Debug)]
pub struct Configuration<'a> {
    /// Displacements at the start of the step, shape (nodes, 4) \[m, -, rad\].
    pub start: &'a [[f64; 4]],
    /// Their increments, shape (nodes, 4) \[m, -, rad\].
    pub increment: &'a [[f64; 4]],
    /// Share of the increment.
    pub share: f64,
    /// Length that no element of a beam exceeds at any share, one a beam, shape (beams) \[m\]; empty if not known. It is for speed alone.
    pub arcs: &'a [f64],
    /// Whether there is a gap without a surface from a node to the next one, shape (beam nodes); empty without fractured beams.
    pub parted: &'a [bool],
}

impl<'a> Configuration<'a> {
    /// Current displacements.
    pub fn of(displacement: &'a [[f64; 4]]) -> Self {
        Self { start: displacement, increment: &[], share: 0.0, arcs: &[], parted: &[] }
    }

    /// Whether there is a gap without a surface from a node to the next one.
    #[inline]
    pub fn is_parted(&self, node: usize) -> bool {
        self.parted.get(node).is_some_and(|parted| *parted)
    }

    /// The same step at another share.
    pub fn at(self, share: f64) -> Self {
        Self { share, ..self }
    }

    /// Displacements of a node.
    #[inline]
    pub fn node(&self, n: usize) -> [f64; 4] {
        let u = &self.start[n];
        if self.share == 0.0 {
            return *u;
        }
        let d = &self.increment[n];
        let s = self.share;
        [u[0] + s * d[0], u[1] + s * d[1], u[2] + s * d[2], u[3] + s * d[3]]
    }
}
