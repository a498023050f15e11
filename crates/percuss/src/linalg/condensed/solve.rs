//! Solutions of a factored system.

use super::super::block;
use super::runs::NodeRun;
use super::{Condensed, Scratch, nodal, take};

impl Condensed {
    /// Solves in place with the factors: nodal values in `x`, border values in `border`.
    pub fn solve(&mut self, x: &mut [[f64; 4]], border: &mut [f64]) {
        nodal::reduce_right(&mut self.nodal, x, border);
        self.solve_reduced(x, border);
        nodal::complete(&self.nodal, x, border);
    }

    /// Solves without the constraints that are reduced inside the band.
    fn solve_reduced(&mut self, x: &mut [[f64; 4]], border: &mut [f64]) {
        if self.interface.is_empty() {
            self.chain.solve(x);
            return;
        }
        let mut scratch = std::mem::take(&mut self.scratch);
        let Scratch { right, nodal, left_over, reduced } = &mut scratch;
        right.clear();
        for node in &self.interface {
            right.extend_from_slice(&x[*node]);
        }
        for run in &self.runs {
            self.forward(run, x, right);
        }
        nodal.clear();
        nodal.resize(right.len(), 0.0);
        self.clusters.iter().for_each(|c| c.add_particular(border, nodal));
        self.leave_over(right, nodal, left_over);
        self.reduce_right(border, nodal, left_over, reduced);
        self.schur.solve(reduced);
        self.expand(reduced, nodal);
        self.leave_over(right, nodal, left_over);
        let first = self.reduced_nodes();
        for (k, c) in self.border.iter().enumerate() {
            border[*c] = reduced[first + k];
            for (node, values) in &self.columns[*c] {
                let at = 4 * self.slot(*node);
                (0..4).for_each(|i| left_over[at + i] -= values[i] * reduced[first + k]);
            }
        }
        self.clusters.iter().for_each(|c| c.multipliers(left_over, border));
        for run in &self.runs {
            self.backward(run, x, nodal);
        }
        for (i, node) in self.interface.iter().enumerate() {
            x[*node].copy_from_slice(&nodal[4 * i..4 * i + 4]);
        }
        self.scratch = scratch;
    }

    /// `right - A nodal` on the interface.
    fn leave_over(&self, right: &[f64], nodal: &[f64], out: &mut Vec<f64>) {
        out.clear();
        out.extend_from_slice(right);
        for (a, b, block) in &self.blocks {
            let x = std::array::from_fn(|k| nodal[4 * b + k]);
            take(&mut out[4 * a..], &block::apply(block, &x));
        }
    }

    /// Right side of the reduced system: `Tm^T (right - A x0)`, and the remainder of the border for x0.
    fn reduce_right(&self, border: &[f64], nodal: &[f64], left_over: &[f64], out: &mut Vec<f64>) {
        out.clear();
        for cluster in &self.clusters {
            let f = cluster.size();
            let start = out.len();
            out.resize(start + f, 0.0);
            for (i, slot) in cluster.slots.iter().enumerate() {
                let test = cluster.test(i);
                for r in 0..4 {
                    let value = left_over[4 * slot + r];
                    (0..f).for_each(|k| out[start + k] += test[r * f + k] * value);
                }
            }
        }
        for c in &self.border {
            let mut value = border[*c];
            for (node, row) in &self.rows[*c] {
                let at = 4 * self.slot(*node);
                value -= (0..4).map(|k| row[k] * nodal[at + k]).sum::<f64>();
            }
            out.push(value);
        }
    }

    /// `nodal += T1 y`.
    fn expand(&self, reduced: &[f64], nodal: &mut [f64]) {
        for cluster in &self.clusters {
            let f = cluster.size();
            let y = &reduced[cluster.first..cluster.first + f];
            for (i, slot) in cluster.slots.iter().enumerate() {
                let trial = cluster.trial(i);
                for r in 0..4 {
                    nodal[4 * slot + r] += (0..f).map(|k| trial[r * f + k] * y[k]).sum::<f64>();
                }
            }
        }
    }

    fn forward(&self, run: &NodeRun, x: &mut [[f64; 4]], right: &mut [f64]) {
        let chain = &self.chain;
        let mut carry = [0.0; 4];
        for i in run.start..run.end {
            let y = std::array::from_fn(|k| x[i][k] - carry[k]);
            let z = block::apply(&chain.diag[i], &y);
            x[i] = z;
            if let Some(left) = run.left {
                take(&mut right[4 * left..], &block::apply(&self.from_left[i], &z));
            }
            if i + 1 < run.end || run.right.is_some() {
                carry = block::apply(&chain.lower[i], &z);
            }
        }
        if let Some(slot) = run.right {
            take(&mut right[4 * slot..], &carry);
        }
    }

    fn backward(&self, run: &NodeRun, x: &mut [[f64; 4]], right: &[f64]) {
        let value = |slot: Option<usize>| {
            slot.map(|s| std::array::from_fn::<f64, 4, _>(|k| right[4 * s + k]))
        };
        let (left, mut next) = (value(run.left), value(run.right));
        for i in (run.start..run.end).rev() {
            if let Some(next) = &next {
                take(&mut x[i], &block::apply(&self.chain.upper[i], next));
            }
            if let Some(left) = &left {
                take(&mut x[i], &block::apply(&self.to_left[i], left));
            }
            next = Some(x[i]);
        }
    }
}
