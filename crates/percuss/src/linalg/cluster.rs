//! Nodes tied to each other by constraints: a joint. Its unknowns are reduced to those the constraints leave free.

use super::dense::DenseLu;

/// A row or column of the border: its coefficients at nodes.
pub type BorderVector = Vec<(usize, [f64; 4])>;

/// A cluster of interface nodes with all constraints among them.
///
/// With `C1 x = c` at the end of the step and forces along the columns `Cm`, unknowns are `x = x0 + T1 y` with `C1 T1 = 0`,
/// and equations are taken along the columns of Tm with `Cm^T... Tm = 0`: no multiplier is left.
#[derive(Clone, Debug)]
pub struct Cluster {
    /// Slots of its nodes, ascending, shape (nodes of the cluster) \[index of a slot\].
    pub slots: Vec<usize>,
    /// Numbers of its constraints, shape (constraints of the cluster) \[index of a constraint\].
    pub constraints: Vec<usize>,
    /// First unknown in the reduced system.
    pub first: usize,
    /// Components that follow from the others, one a constraint, shape (constraints of the cluster) \[index of a component of the cluster\].
    dependent: Vec<usize>,
    /// The others, shape (free components) \[index of a component of the cluster\].
    free: Vec<usize>,
    /// T1, shape (4 nodes, free components), row by row \[unit of the row's component by that of the column's\].
    trial: Vec<f64>,
    /// Tm, likewise, shape (4 nodes, free components) \[unit of the row's component by that of the column's\].
    test: Vec<f64>,
    /// Constraints on the dependent components: `C1_d`, and `Cm_d` transposed.
    row_lu: DenseLu,
    column_lu: DenseLu,
}

impl Cluster {
    /// A cluster of the given nodes and constraints, its unknowns from `first` on.
    pub fn new(slots: Vec<usize>, constraints: Vec<usize>, first: usize) -> Self {
        let (n, m) = (4 * slots.len(), constraints.len());
        let f = n - m;
        Self {
            slots,
            constraints,
            first,
            dependent: vec![0; m],
            free: vec![0; f],
            trial: vec![0.0; n * f],
            test: vec![0.0; n * f],
            row_lu: DenseLu::default(),
            column_lu: DenseLu::default(),
        }
    }

    /// Number of unknowns left.
    pub fn size(&self) -> usize {
        self.free.len()
    }

    /// Rows of T1 (trial) of a node of the cluster, shape (4, size).
    pub fn trial(&self, node: usize) -> &[f64] {
        let f = self.size();
        &self.trial[4 * node * f..4 * (node + 1) * f]
    }

    /// Rows of Tm (test) of a node.
    pub fn test(&self, node: usize) -> &[f64] {
        let f = self.size();
        &self.test[4 * node * f..4 * (node + 1) * f]
    }

    /// Finds the reduction for the present constraints; `false` if they depend on each other.
    pub fn reduce(
        &mut self,
        rows: &[BorderVector],
        columns: &[BorderVector],
        slot_of: impl Fn(usize) -> usize,
    ) -> bool {
        let (n, m) = (4 * self.slots.len(), self.constraints.len());
        if m == 0 {
            self.free.iter_mut().enumerate().for_each(|(i, k)| *k = i);
            for i in 0..n {
                (self.trial[i * n + i], self.test[i * n + i]) = (1.0, 1.0);
            }
            return true;
        }
        let matrix = |vectors: &[BorderVector]| {
            let mut out = vec![0.0; m * n];
            for (r, c) in self.constraints.iter().enumerate() {
                for (node, values) in &vectors[*c] {
                    let slot = slot_of(*node);
                    let at = 4 * self.slots.partition_point(|s| *s < slot);
                    out[r * n + at..r * n + at + 4].copy_from_slice(values);
                }
            }
            out
        };
        let (c1, cm) = (matrix(rows), matrix(columns));
        if !self.choose(&c1, n) {
            return false;
        }
        let pick = |c: &[f64], transposed: bool| {
            let mut out = vec![0.0; m * m];
            for r in 0..m {
                for (k, d) in self.dependent.iter().enumerate() {
                    out[if transposed { k * m + r } else { r * m + k }] = c[r * n + d];
                }
            }
            out
        };
        let mut column_lu = DenseLu::default();
        let regular = self.row_lu.factor(m, &pick(&c1, false))
            && column_lu.factor(m, &pick(&cm, false))
            && self.column_lu.factor(m, &pick(&cm, true));
        let f = self.size();
        let mut right = vec![0.0; m];
        for (k, free) in self.free.iter().enumerate() {
            for (c, lu, t) in
                [(&c1, &self.row_lu, &mut self.trial), (&cm, &column_lu, &mut self.test)]
            {
                (0..n).for_each(|i| t[i * f + k] = 0.0);
                t[free * f + k] = 1.0;
                (0..m).for_each(|r| right[r] = -c[r * n + free]);
                lu.solve(&mut right);
                for (d, value) in self.dependent.iter().zip(&right) {
                    t[d * f + k] = *value;
                }
            }
        }
        regular
    }

    /// Chooses dependent components by elimination with full pivoting.
    fn choose(&mut self, c: &[f64], n: usize) -> bool {
        let m = self.dependent.len();
        let mut work = c.to_vec();
        let mut taken = vec![false; n];
        let mut open: Vec<usize> = (0..m).collect();
        for k in 0..m {
            let (mut best, mut place) = (0.0, (0, 0));
            for (i, r) in open.iter().enumerate() {
                for j in 0..n {
                    let size = work[r * n + j].abs();
                    if !taken[j] && size > best {
                        (best, place) = (size, (i, j));
                    }
                }
            }
            if best <= 1e-10 {
                return false;
            }
            let (pivot, column) = (open.swap_remove(place.0), place.1);
            taken[column] = true;
            self.dependent[k] = column;
            for r in &open {
                let factor = work[r * n + column] / work[pivot * n + column];
                if factor != 0.0 {
                    for j in 0..n {
                        work[r * n + j] -= factor * work[pivot * n + j];
                    }
                }
            }
        }
        self.dependent.sort_unstable();
        let mut free = (0..n).filter(|j| !taken[*j]);
        self.free.iter_mut().for_each(|k| *k = free.next().unwrap_or(0));
        true
    }

    /// Adds a solution of `C1 x = c` to nodal values by slot; `c` by constraint number.
    pub fn add_particular(&self, c: &[f64], x: &mut [f64]) {
        let mut right: Vec<f64> = self.constraints.iter().map(|k| c[*k]).collect();
        if right.iter().all(|r| *r == 0.0) {
            return;
        }
        self.row_lu.solve(&mut right);
        for (d, value) in self.dependent.iter().zip(&right) {
            x[4 * self.slots[d / 4] + d % 4] += value;
        }
    }

    /// Multipliers from the residual of nodal equations, by slot.
    pub fn multipliers(&self, left_over: &[f64], out: &mut [f64]) {
        if self.constraints.is_empty() {
            return;
        }
        let mut right: Vec<f64> =
            self.dependent.iter().map(|d| left_over[4 * self.slots[d / 4] + d % 4]).collect();
        self.column_lu.solve(&mut right);
        for (k, value) in self.constraints.iter().zip(&right) {
            out[*k] = *value;
        }
    }
}
