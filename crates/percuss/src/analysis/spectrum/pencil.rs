//! Lowest eigenvalues of stiffness against mass.

use nalgebra::Complex;

use super::krylov::{ImagePair, Krylov, Nodal, Ritz};
use super::matrix::{Layout, Matrix};
use crate::linalg::chain::Chain;

/// Additional vectors of a subspace, beside six for each requested eigenvalue.
const SPARE: usize = 60;
/// Number of attempts to find missing eigenvalues.
const MOST_COUNTS: usize = 8;
/// Eigenvalues above this many times the lowest of a search have lost digits: another search begins there.
const REACH: f64 = 1e8;
/// Imaginary part of an eigenvalue, as a share of it, that is more than the round-off of a double one.
const COMPLEX: f64 = 1e-6;
/// Inverses of eigenvalues and their imaginary parts below this share of the largest inverse are round-off: of a small structure, the subspace has
/// vectors beyond the rank of mass and constraints.
const NOTHING: f64 = 1e-14;

/// Stiffness and mass of a structure.
pub struct Pencil<'l> {
    pub layout: &'l Layout<'l>,
    pub stiffness: &'l Matrix,
    pub mass: &'l Chain,
}

/// An eigenvalue of `K x = lambda M x` \[1/s^2\] and its vector.
#[derive(Clone, Debug)]
pub struct Eigen {
    pub value: Complex<f64>,
    pub pair: ImagePair,
}

impl Pencil<'_> {
    /// Stiffness plus `shift` times mass.
    fn shifted(&self, shift: f64) -> Matrix {
        let mut matrix = self.stiffness.clone();
        if shift != 0.0 {
            self.layout.add_band(&mut matrix, self.mass, shift);
        }
        matrix
    }

    /// Number of eigenvalues below `value`, by the signs of pivots; `None` if it is one itself.
    pub fn below(&self, value: f64) -> Option<usize> {
        Some(self.layout.factor(self.shifted(-value), true)?.negative)
    }

    /// The `count` lowest eigenvalues above minus `shift`, in ascending order, complete by count. `springs` replace missing stiffness of motions;
    /// those of `deflated` are omitted.
    pub fn lowest(
        &self,
        shift: f64,
        springs: &[(usize, usize, f64)],
        deflated: &[ImagePair],
        count: usize,
    ) -> Option<Vec<Eigen>> {
        let mut found: Vec<Eigen> = Vec::new();
        let (mut shift, mut left_out) = (shift, deflated.to_vec());
        while found.len() < count {
            let wanted = count - found.len();
            let more = self.slice(shift, springs, &left_out, wanted)?;
            let Some(least) = more.first().map(|e| e.value.re) else { break };
            // Eigenvalues that are not found are searched with a closer shift.
            let reach = REACH * (least + shift) - shift;
            let near = more.iter().take_while(|e| e.value.re <= reach).cloned();
            let before = found.len();
            found.extend(near);
            let Some(last) = found.last().map(|e| e.value.re) else { break };
            left_out.extend(found[before..].iter().map(|e| e.pair.clone()));
            if found.len() >= count || self.below(1e16 * last) == Some(left_out.len()) {
                break;
            }
            shift = -last * (1.0 + 1e-3);
        }
        Some(found)
    }

    /// One search: the lowest `count` above minus `shift` and not deflated.
    fn slice(
        &self,
        shift: f64,
        springs: &[(usize, usize, f64)],
        deflated: &[ImagePair],
        count: usize,
    ) -> Option<Vec<Eigen>> {
        let mut matrix = self.shifted(shift);
        for (node, component, value) in springs {
            self.layout.add_stiffness(&mut matrix, *node, *component, *value);
        }
        let factored = self.layout.factor(matrix, false)?;
        let image_of = |x: &Nodal| self.mass.multiply(x);
        let solve = |image: &Nodal| factored.solve(image);
        let mut krylov = Krylov::new(self.layout.model.node_count(), deflated, image_of, solve);
        (0..2).for_each(|_| _ = krylov.join());
        let value = |r: &Ritz| 1.0 / r.value.re - shift;
        let mut least = count;
        let mut counted = 0;
        let found = loop {
            let exhausted = !krylov.grow(least, 6 * count + SPARE, |k| {
                let found = k.symmetric();
                k.settled(&found, count)
            });
            let mut found = krylov.symmetric();
            found.retain(|r| r.value.re > 0.0);
            counted += 1;
            let Some(last) = found.get(count.min(found.len()).wrapping_sub(1)).map(value) else {
                break found;
            };
            let above = last + 1e-6 * (last.abs() + shift.abs());
            let there = found.iter().filter(|r| value(r) < above).count() + deflated.len();
            let missing = self.below(above).is_some_and(|expected| expected > there);
            if exhausted || !missing || counted == MOST_COUNTS {
                break found;
            }
            (0..2).for_each(|_| _ = krylov.join());
            least = krylov.size() + 8;
        };
        let eigen = |r: &Ritz| Eigen { value: value(r).into(), pair: krylov.shape(r) };
        Some(found.iter().take(count).map(eigen).collect())
    }

    /// Eigenvalues nearest to minus `shift` where stiffness is not symmetric; of a complex pair the one with positive imaginary
    /// part.
    pub fn nearest(&self, shift: f64, count: usize) -> Option<Vec<Eigen>> {
        let factored = self.layout.factor(self.shifted(shift), false)?;
        let image_of = |x: &Nodal| self.mass.multiply(x);
        let solve = |image: &Nodal| factored.solve(image);
        let mut krylov = Krylov::new(self.layout.model.node_count(), &[], image_of, solve);
        (0..2).for_each(|_| _ = krylov.join());
        // Some additional ones: unstable eigenvalues may come after stable ones.
        let wanted = count + 4;
        krylov.grow(wanted, 6 * wanted + SPARE, |k| {
            let found = k.general();
            let there = wanted.min(found.len());
            k.settled(&found, there)
        });
        let found = krylov.general();
        let nothing = NOTHING * found.first().map_or(0.0, |r| r.value.norm());
        let eigen = |r: &Ritz| {
            let inverse: Complex<f64> = r.value;
            let mut value = inverse.inv() - shift;
            let complex = value.im.abs() > COMPLEX * value.norm() && inverse.im.abs() > nothing;
            // The conjugate's conjugate.
            value.im = if complex { value.im.abs() } else { 0.0 };
            Eigen { value, pair: krylov.shape(r) }
        };
        let settled = |r: &&Ritz| krylov.settled(std::slice::from_ref(r), 1);
        let there = found.iter().filter(|r| r.value.norm() > nothing).filter(settled);
        let mut found: Vec<Eigen> = there.map(eigen).collect();
        found.sort_by(|a, b| a.value.re.total_cmp(&b.value.re));
        found.truncate(count);
        Some(found)
    }
}
