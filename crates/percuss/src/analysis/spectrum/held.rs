//! Contacts that press in an equilibrium: in small motions about it they stay closed.

use super::matrix::{Layout, Matrix};
use crate::geometry::row::Row;
use crate::geometry::turning::Turning;
use crate::scalar::Wide;

/// A contact that stays closed.
#[derive(Clone, Debug)]
pub struct Held {
    /// Gradient of its gap on the nodes that move.
    pub row: Row,
    /// Of its law, or far above that of the beams \[N/m\].
    pub stiffness: f64,
    /// Its force \[N\].
    pub force: f64,
    /// How its direction turns: parts of the second derivative of the gap, shape (such parts).
    pub turnings: Vec<Turning>,
}

impl Held {
    pub(super) fn nodes(&self) -> Vec<usize> {
        let turned = self.turnings.iter().flat_map(|t| &t.forms);
        let mut nodes: Vec<usize> = std::iter::once(&self.row)
            .chain(turned)
            .flat_map(|row| row.iter().map(|(node, _)| node))
            .collect();
        nodes.sort_unstable();
        nodes.dedup();
        nodes
    }
}

impl Layout<'_> {
    /// Adds contacts held closed, with what the turning of the given share of their forces does.
    pub fn add_held(&self, matrix: &mut Matrix, share: f64) {
        for held in &self.held {
            self.add_product(matrix, [&held.row; 2], held.stiffness);
            for turning in &held.turnings {
                for (a, weights) in turning.forms.iter().zip(&turning.weights) {
                    for (b, weight) in turning.forms.iter().zip(weights) {
                        self.add_product(matrix, [a, b], -share * held.force * weight);
                    }
                }
            }
        }
    }

    /// The same with springs as stiff as beams of a length and of unit bending stiffness.
    pub(super) fn add_held_kinematic(&self, matrix: &mut Matrix, length: f64) {
        for held in &self.held {
            self.add_product(matrix, [&held.row; 2], length.powi(-3));
        }
    }

    /// Adds `factor a (x) b`, products in Wide numbers.
    fn add_product(&self, matrix: &mut Matrix, [a, b]: [&Row; 2], factor: f64) {
        if factor == 0.0 {
            return;
        }
        for (i, left) in a.iter() {
            for (j, right) in b.iter() {
                let block = left.map(|l| right.map(|r| Wide::from(l) * r * factor));
                self.add(matrix, i, j, &block);
            }
        }
    }
}
