//! Stiffness of a structure about an equilibrium, from elements, springs, contacts and constraints.

use super::super::static_search::StaticSearch;
use super::matrix::{Layout, Matrix, RULE, Stored, times};
use super::wide_element::{element, unit};
use crate::linalg::block;
use crate::linalg::condensed::BorderVector;
use crate::math::vec2::{dot, dot4};
use crate::model::frozen::{Connector, Span};
use crate::scalar::Wide;
use crate::step::connectors::{self, ConnectorStep};
use crate::step::constraint::{self, ConstraintStep};
use crate::step::external;
use crate::step::fibres::equivalent_strains;
use crate::step::tangent::Tangent;

/// Constraints at the base of a search.
fn at_rest<'a>(search: &'a StaticSearch, still: &'a [[f64; 4]]) -> ConstraintStep<'a> {
    let (start, forcing) = (&search.base.displacement[..], &search.forcing);
    ConstraintStep { start, increment: still, forcing, share: 1.0 }
}

/// Whether stress and stiffness are those of the structure, or left out for unit bending stiffness and springs to match beams
/// of the given length.
#[derive(Clone, Copy, Debug)]
pub enum StressTerms {
    Taken,
    Left(f64),
}

impl StressTerms {
    /// Stiffness of a spring.
    fn of_spring(self, spring: &Connector, stiffness: f64) -> f64 {
        match self {
            Self::Left(length) if stiffness != 0.0 => {
                let turns = spring.attachments().any(|(_, (_, gradient))| gradient);
                length.powi(if turns { -1 } else { -3 })
            }
            _ => stiffness,
        }
    }
}

/// Strains whose stresses stiffen an element: of one that has yielded, those that elastically go with its forces.
fn stressed(search: &StaticSearch, span: &Span, k: usize, e: usize) -> Stored {
    equivalent_strains(&search.base, span, k).unwrap_or(search.base.strain[e])
}

/// Whether an element is a gap after the failure of all its fibres: its nodes are not connected.
fn is_gap(search: &StaticSearch, span: &Span, k: usize) -> bool {
    let fibres = span.fibres.as_ref();
    fibres.is_some_and(|of| search.base.fibres[of.range(k)].iter().all(|state| state.failed))
}

impl Layout<'_> {
    /// The tangent at the base of a search; beams that have yielded count as they unload, elastically.
    pub fn tangent(&self, search: &StaticSearch) -> Matrix {
        self.tangent_with(search, 1.0)
    }

    /// The same where contacts press with a share of their forces.
    pub fn tangent_with(&self, search: &StaticSearch, pressed: f64) -> Matrix {
        let mut matrix = self.zeros();
        self.add_elements(&mut matrix, search, |span, k, e| {
            (Wide::ONE, Some(stressed(search, span, k, e)))
        });
        let mut rest = Tangent::new(self.model);
        let (base, forcing) = (&search.base, &search.forcing);
        let still = vec![[0.0; 4]; base.displacement.len()];
        self.add_turning(search, &still, &mut rest);
        let add = |c: &Connector, s: &ConnectorStep| self.add_spring(&mut matrix, c, s, s.slope);
        let mut turning = Tangent::new(self.model);
        connectors::apply_turning(self.model, base, &RULE, forcing, &mut turning, add);
        self.add_blocks(&mut matrix, &rest);
        if search.stressed {
            self.add_blocks(&mut matrix, &turning);
        }
        self.add_held(&mut matrix, pressed);
        self.add_border(&mut matrix, search);
        matrix
    }

    /// A tangent that was assembled, on the nodes of the beams, with the constraints at the base of a search.
    pub fn assembled(&self, search: &StaticSearch, tangent: &Tangent) -> Matrix {
        let mut matrix = self.zeros();
        self.add_blocks(&mut matrix, tangent);
        self.add_border(&mut matrix, search);
        matrix
    }

    /// Stress-free stiffness of the same geometry and supports with unit bending stiffness throughout: motions that it leaves free have no
    /// stiffness for any beam stiffness. `length` makes the stiffness of springs comparable with that of beams.
    pub fn kinematic(&self, search: &StaticSearch, length: f64) -> Matrix {
        let mut matrix = self.zeros();
        self.add_elements(&mut matrix, search, |span, k, _| (unit(span.table(k)), None));
        let add = |c: &Connector, s: &ConnectorStep| {
            self.add_spring(&mut matrix, c, s, StressTerms::Left(length).of_spring(c, s.slope));
        };
        if !self.model.connectors.is_empty() {
            let mut unused = Tangent::new(self.model);
            let (base, forcing) = (&search.base, &search.forcing);
            connectors::apply_turning(self.model, base, &RULE, forcing, &mut unused, add);
        }
        self.add_held_kinematic(&mut matrix, length);
        self.add_border(&mut matrix, search);
        matrix
    }

    fn add_elements(
        &self,
        matrix: &mut Matrix,
        search: &StaticSearch,
        weigh: impl Fn(&Span, usize, usize) -> (Wide, Option<Stored>),
    ) {
        let u = &search.base.displacement;
        // The matrix of an element that is equal to the previous one is known.
        let mut known = None;
        for (span, k, a, e) in self.model.each_element() {
            if is_gap(search, span, k) {
                continue;
            }
            let (factor, stored) = weigh(span, k, e);
            let of = (std::ptr::from_ref(span.table(k)), u[a], u[a + 1], stored);
            let blocks = match known {
                Some((before, blocks)) if before == of => blocks,
                _ => {
                    let none = [[Wide::ZERO; 4]; 4];
                    let blocks =
                        element(span, k, a, u, stored.as_ref()).nodal_tangent(&none, Wide::ZERO);
                    blocks.map(|block| block.map(|row| row.map(|x| x * factor)))
                }
            };
            known = Some((of, blocks));
            let places = [(a, a), (a, a + 1), (a + 1, a), (a + 1, a + 1)];
            places.iter().zip(&blocks).for_each(|((i, j), block)| self.add(matrix, *i, *j, block));
        }
    }

    /// Twice the energy of small motions `x` in each element and spring, and the contribution of loads and rotation.
    pub fn each_energy(
        &self,
        search: &StaticSearch,
        x: &[[f64; 4]],
        stress: StressTerms,
        mut each: impl FnMut(f64),
    ) {
        for (span, k, a, e) in self.model.each_element() {
            if is_gap(search, span, k) {
                continue;
            }
            let (factor, stored) = match stress {
                StressTerms::Taken => (1.0, Some(stressed(search, span, k, e))),
                StressTerms::Left(_) => (unit(span.table(k)).round(), None),
            };
            let sums = element(span, k, a, &search.base.displacement, stored.as_ref());
            let (p, q) = (&x[a], &x[a + 1]);
            let d = [q[0] - p[0], q[1] - p[1], p[2], p[3], q[2], q[3]];
            let mut sum = Wide::ZERO;
            for (row, di) in sums.tangent.iter().zip(d) {
                for (k, dj) in row.iter().zip(d) {
                    sum += *k * di * dj;
                }
            }
            each(factor * sum.round());
        }
        let mut rest = Tangent::new(self.model);
        let (base, forcing) = (&search.base, &search.forcing);
        let still = vec![[0.0; 4]; base.displacement.len()];
        if let StressTerms::Taken = stress {
            self.add_turning(search, &still, &mut rest);
        }
        for held in &self.held {
            let stiffness = match stress {
                StressTerms::Taken => held.stiffness,
                StressTerms::Left(length) => length.powi(-3),
            };
            each(stiffness * held.row.on(x).powi(2));
        }
        let add = |c: &Connector, s: &ConnectorStep| {
            let moved: f64 = c
                .attachments()
                .map(|(g, (p, slope))| {
                    dot(s.forms[g], if slope { p.gradient(x) } else { p.value(x) })
                })
                .sum();
            each(stress.of_spring(c, s.slope) * moved * moved);
        };
        match stress {
            StressTerms::Taken => {
                let mut unstressed = Tangent::new(self.model);
                let turning = if search.stressed { &mut rest } else { &mut unstressed };
                connectors::apply_turning(self.model, base, &RULE, forcing, turning, add);
                for (i, j, block) in rest.blocks() {
                    each(dot4(&block::apply(block, &x[j]), &x[i]));
                }
            }
            StressTerms::Left(_) => {
                let mut unused = Tangent::new(self.model);
                connectors::apply_turning(self.model, base, &RULE, forcing, &mut unused, add);
            }
        }
    }

    /// Adds the terms of follower loads and rotating joints to the tangent.
    fn add_turning(&self, search: &StaticSearch, still: &[[f64; 4]], rest: &mut Tangent) {
        let (base, forcing) = (&search.base, &search.forcing);
        let mut residual = still.to_vec();
        external::apply::<true>(self.model, base, forcing, &RULE, still, &mut residual, rest);
        let step = at_rest(search, still);
        for (i, c) in self.model.constraints.iter().enumerate() {
            rest.add_constraint(i, c, &step, search.work.multiplier[i]);
        }
    }

    /// Adds `stiffness form (x) form`, products in Wide numbers.
    fn add_spring(&self, m: &mut Matrix, c: &Connector, step: &ConnectorStep, stiffness: f64) {
        let ends: Vec<(usize, [Wide; 4])> = c
            .attachments()
            .flat_map(|(g, (p, gradient))| {
                let n = if gradient { &p.slope } else { &p.shape };
                let (form, n) = (step.forms[g], *n);
                [0, 1].map(move |end| {
                    let w = |k: usize| Wide::from(n[2 * end + k / 2]) * form[k % 2];
                    (p.node + end, std::array::from_fn(w))
                })
            })
            .collect();
        for (i, left) in &ends {
            for (j, right) in &ends {
                self.add(m, *i, *j, &left.map(|l| right.map(|r| l * r * stiffness)));
            }
        }
    }

    fn add_blocks(&self, matrix: &mut Matrix, rest: &Tangent) {
        // Bodies follow the beams.
        let nodes = self.model.node_count();
        for (i, j, block) in rest.blocks().filter(|(i, j, _)| *i.max(j) < nodes) {
            let largest = block.as_flattened().iter().fold(0.0_f64, |m, x| m.max(x.abs()));
            matrix.turning = matrix.turning.max(largest);
            self.add(matrix, i, j, &block.map(|row| row.map(Wide::from)));
        }
    }

    fn add_border(&self, matrix: &mut Matrix, search: &StaticSearch) {
        let still = vec![[0.0; 4]; self.model.node_count()];
        let step = at_rest(search, &still);
        for (i, c) in self.model.constraints.iter().enumerate() {
            let (group, own) = self.multiplier[i];
            let (start, stride) = self.pattern.place(group, group);
            if !search.forcing.constrained[i] {
                matrix.values[start + own * stride + own] += Wide::ONE;
                continue;
            }
            matrix.constrained += 1;
            let mut vector: BorderVector =
                constraint::nodes(c).into_iter().map(|node| (node, [0.0; 4])).collect();
            step.border(c, true, &mut vector);
            for (node, values) in vector {
                let (_, at) = self.home[node];
                let row = values.map(Wide::from);
                let row = self.hold[node].map_or(row, |h| times(&row, &self.free[h]));
                for k in 0..4 {
                    matrix.values[start + own * stride + at + k] += row[k];
                    matrix.values[start + (at + k) * stride + own] += row[k];
                }
            }
        }
    }
}
