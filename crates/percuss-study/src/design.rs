//! Designs: which point of the unit cube a run stands for.

use std::sync::OnceLock;

use nalgebra::{Cholesky, DMatrix};
use rand::seq::SliceRandom;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use sobol::params::JoeKuoD6;
use sobol::{Sobol, SobolType};

use crate::distribution::{standard_quantile, standard_share};

/// How points are placed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Grid,
    LatinHypercube,
    Sobol,
    MonteCarlo,
    /// Listed: run k takes entry k of each parameter.
    Points,
}

/// Which point of the unit cube each run stands for.
#[derive(Clone, Debug)]
pub(crate) struct Design {
    pub kind: Kind,
    /// Points, each one run, or several where Sobol indices are wanted.
    pub points: u64,
    pub sobol_indices: bool,
    /// Number of parameters.
    pub dimension: usize,
    pub seed: u64,
    /// Lower triangle L of the correlation matrix L L' of the Gaussian variables behind the parameters, shape (variables, variables) \[-\].
    pub correlation: Option<DMatrix<f64>>,
    /// Numbers of values of each parameter, of a grid, shape (parameters) \[-\].
    pub levels: Vec<u64>,
    tables: OnceLock<Tables>,
}

/// What some designs keep for all points.
#[derive(Clone, Debug)]
enum Tables {
    None,
    /// Direction numbers and random shift of every dimension, 53 bits in the upper part of 64.
    Sobol {
        /// Direction numbers, shape (dimensions, bits) \[-\].
        directions: Vec<Vec<u64>>,
        /// Digital shifts, shape (dimensions) \[-\].
        shifts: Vec<u64>,
    },
    /// The part of its range that each run falls into, by dimension, shape (dimensions, runs) \[index of a part\].
    Latin(Vec<Vec<u32>>),
}

/// Streams of random numbers beside those of the points, which have the numbers of their points.
const TABLE_STREAM: u64 = u64::MAX;

impl Design {
    pub fn new(kind: Kind, points: u64, dimension: usize, seed: u64) -> Self {
        let (sobol_indices, correlation, levels) = (false, None, Vec::new());
        let tables = OnceLock::new();
        Self { kind, points, sobol_indices, dimension, seed, correlation, levels, tables }
    }

    /// Number of runs.
    pub fn runs(&self) -> u64 {
        match self.sobol_indices {
            true => self.points * self.runs_per_point(),
            false => self.points,
        }
    }

    /// Runs that belong together: A, B, and A with one column of B at a time (Saltelli 2010).
    pub fn runs_per_point(&self) -> u64 {
        if self.sobol_indices { self.dimension as u64 + 2 } else { 1 }
    }

    /// The point of a run: shares from 0 to 1, one a parameter. Not for grids and listed points.
    pub fn point(&self, run: u64) -> Vec<f64> {
        let d = self.dimension;
        if !self.sobol_indices {
            let point = self.cube(run, d);
            return self.correlated(point);
        }
        let both = self.cube(run / self.runs_per_point(), 2 * d);
        let (a, b) = both.split_at(d);
        match (run % self.runs_per_point()) as usize {
            0 => a.to_vec(),
            1 => b.to_vec(),
            column => {
                let mut mixed = a.to_vec();
                mixed[column - 2] = b[column - 2];
                mixed
            }
        }
    }

    /// Which value of each parameter a run of a grid takes, whose last parameter changes fastest, or a run of listed points.
    pub fn combination(&self, run: u64) -> Vec<usize> {
        if self.kind == Kind::Points {
            return vec![run as usize; self.dimension];
        }
        let mut rest = run;
        let mut out: Vec<usize> = Vec::with_capacity(self.levels.len());
        for &levels in self.levels.iter().rev() {
            out.push((rest % levels) as usize);
            rest /= levels;
        }
        out.reverse();
        out
    }

    /// A point of a cube of so many dimensions.
    fn cube(&self, point: u64, dimensions: usize) -> Vec<f64> {
        match self.tables.get_or_init(|| self.tables(dimensions)) {
            Tables::Sobol { directions, shifts } => {
                let gray = point ^ (point >> 1);
                let bits = (0..64).filter(|bit| gray >> bit & 1 == 1);
                let one = |(directions, shift): (&Vec<u64>, &u64)| {
                    let sum = bits.clone().fold(*shift, |sum, bit: usize| sum ^ directions[bit]);
                    share(sum)
                };
                directions.iter().zip(shifts).map(one).collect()
            }
            Tables::Latin(parts) => {
                let mut random = self.stream(point);
                let n = self.points as f64;
                let within = |part: &Vec<u32>| {
                    (f64::from(part[point as usize]) + share(random.next_u64())) / n
                };
                parts.iter().map(within).collect()
            }
            Tables::None => {
                let mut random = self.stream(point);
                (0..dimensions).map(|_| share(random.next_u64())).collect()
            }
        }
    }

    fn tables(&self, dimensions: usize) -> Tables {
        let mut random = self.stream(TABLE_STREAM);
        match self.kind {
            Kind::Sobol => {
                let parameters = JoeKuoD6::standard();
                let bits = <f64 as SobolType>::MAX_RESOLUTION;
                let directions = Sobol::<f64>::init_direction_vals(dimensions, bits, &parameters);
                let shifts = (0..dimensions).map(|_| random.next_u64()).collect();
                Tables::Sobol { directions, shifts }
            }
            Kind::LatinHypercube => {
                let mut parts = || {
                    let mut parts: Vec<u32> = (0..self.points as u32).collect();
                    parts.shuffle(&mut random);
                    parts
                };
                let parts: Vec<Vec<u32>> = (0..dimensions).map(|_| parts()).collect();
                let paired = self.correlation.as_ref().and_then(|lower| paired(&parts, lower));
                Tables::Latin(paired.unwrap_or(parts))
            }
            Kind::MonteCarlo | Kind::Grid | Kind::Points => Tables::None,
        }
    }

    fn stream(&self, stream: u64) -> ChaCha8Rng {
        let mut random = ChaCha8Rng::seed_from_u64(self.seed);
        random.set_stream(stream);
        random
    }

    /// Whether a Latin hypercube has points enough to be paired as its correlation asks.
    pub fn can_be_paired(&self) -> bool {
        let latin = self.kind == Kind::LatinHypercube && self.correlation.is_some();
        // Below some multiple of the dimension the scores of a sample are nearly dependent, and pairing them means little.
        !latin || self.points >= 4 * self.dimension as u64
    }

    /// The same point for parameters that are correlated: a Gaussian copula. A Latin hypercube is paired instead, which keeps one
    /// point in each part of each range.
    fn correlated(&self, point: Vec<f64>) -> Vec<f64> {
        if self.kind == Kind::LatinHypercube { point } else { self.copula(point) }
    }

    /// Shares of independent parameters as those of correlated ones: a Gaussian copula.
    pub fn copula(&self, point: Vec<f64>) -> Vec<f64> {
        let Some(lower) = &self.correlation else { return point };
        let z: Vec<f64> = point.iter().map(|u| standard_quantile(*u)).collect();
        let row = |i: usize| (0..=i).map(|j| lower[(i, j)] * z[j]).sum::<f64>();
        (0..z.len()).map(|i| standard_share(row(i))).collect()
    }
}

/// Points of a Latin hypercube: shares from 0 to 1, shape (points, dimension) \[-\]; the same for the same seed.
pub fn latin_hypercube(points: usize, dimension: usize, seed: u64) -> Vec<Vec<f64>> {
    let design = Design::new(Kind::LatinHypercube, points as u64, dimension, seed);
    (0..points as u64).map(|k| design.point(k)).collect()
}

/// The parts of each range, put in another order such that they are correlated: ranks follow those of Gaussian scores with the
/// correlation L L'.
///
/// Iman and Conover (1982), A distribution-free approach to inducing rank correlation among input variables, Commun. Statist. Simul.
/// Comput. 11. `None` if the scores of the sample depend on each other.
fn paired(parts: &[Vec<u32>], lower: &DMatrix<f64>) -> Option<Vec<Vec<u32>>> {
    let (n, d) = (parts[0].len(), parts.len());
    let score = |part: u32| standard_quantile((f64::from(part) + 0.5) / n as f64);
    let scores: Vec<Vec<f64>> =
        parts.iter().map(|column| column.iter().map(|part| score(*part)).collect()).collect();
    let sample = DMatrix::from_fn(d, d, |i, j| {
        scores[i].iter().zip(&scores[j]).map(|(a, b)| a * b).sum::<f64>() / n as f64
    });
    // Scores of the sample become uncorrelated by the inverse of its own factor, then correlated as wanted.
    let transform = lower * Cholesky::new(sample)?.l().try_inverse()?;
    let column = |i: usize| {
        let mixed = |run: usize| (0..=i).map(|j| transform[(i, j)] * scores[j][run]).sum::<f64>();
        let mixed: Vec<f64> = (0..n).map(mixed).collect();
        let mut order: Vec<u32> = (0..n as u32).collect();
        order.sort_by(|a, b| mixed[*a as usize].total_cmp(&mixed[*b as usize]));
        let mut ranks = vec![0; n];
        order.iter().zip(0..).for_each(|(run, rank)| ranks[*run as usize] = rank);
        ranks
    };
    Some((0..d).map(column).collect())
}

/// Random bits as a number between 0 and 1, neither of them included.
fn share(bits: u64) -> f64 {
    ((bits >> 12) as f64 + 0.5) / (1u64 << 52) as f64
}

/// Whether Sobol sequences have so many dimensions.
pub(crate) const SOBOL_DIMENSIONS: usize = 1000;
/// Most points of a Latin hypercube, whose parts are kept in memory.
pub(crate) const LATIN_POINTS: usize = 100_000_000;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sobol_sequence_puts_one_point_into_each_elementary_interval() {
        let design = Design::new(Kind::Sobol, 1024, 5, 7);
        for dimension in 0..5 {
            let mut seen = vec![false; 1024];
            for run in 0..1024 {
                let part = (design.point(run)[dimension] * 1024.0) as usize;
                assert!(!std::mem::replace(&mut seen[part], true), "part {part} twice");
            }
        }
        // The first two dimensions are a (0, 10, 2)-net: one point in each box of 32 by 32.
        let mut seen = vec![false; 1024];
        for run in 0..1024 {
            let point = design.point(run);
            let part = (point[0] * 32.0) as usize * 32 + (point[1] * 32.0) as usize;
            assert!(!std::mem::replace(&mut seen[part], true), "box {part} twice");
        }
    }

    #[test]
    fn a_latin_hypercube_puts_one_point_into_each_part_of_each_range() {
        let design = Design::new(Kind::LatinHypercube, 100, 3, 7);
        for dimension in 0..3 {
            let mut parts: Vec<usize> =
                (0..100).map(|run| (design.point(run)[dimension] * 100.0) as usize).collect();
            parts.sort_unstable();
            assert_eq!(parts, (0..100).collect::<Vec<_>>());
        }
    }

    #[test]
    fn points_depend_on_seed_and_number_alone() {
        for kind in [Kind::Sobol, Kind::LatinHypercube, Kind::MonteCarlo] {
            let (one, same) = (Design::new(kind, 64, 2, 1), Design::new(kind, 64, 2, 1));
            let backwards: Vec<_> = (0..64).rev().map(|run| same.point(run)).collect();
            let forwards: Vec<_> = (0..64).map(|run| one.point(run)).collect();
            assert!(forwards.iter().eq(backwards.iter().rev()));
            assert_ne!(forwards[5], Design::new(kind, 64, 2, 2).point(5));
        }
    }

    #[test]
    fn runs_for_sobol_indices_differ_from_the_first_in_one_column() {
        let mut design = Design::new(Kind::Sobol, 8, 3, 1);
        design.sobol_indices = true;
        assert_eq!(design.runs(), 40);
        for point in 0..8 {
            let run = |k| design.point(5 * point + k);
            let (a, b) = (run(0), run(1));
            for column in 0..3 {
                let mixed = run(2 + column as u64);
                for j in 0..3 {
                    assert_eq!(mixed[j], if j == column { b[j] } else { a[j] });
                }
            }
        }
    }

    #[test]
    fn correlated_parameters_have_the_coefficient_asked_for() {
        let mut design = Design::new(Kind::Sobol, 1 << 14, 2, 3);
        design.correlation = Some(DMatrix::from_row_slice(2, 2, &[1.0, 0.0, 0.6, 0.8]));
        let z = |run| design.point(run).iter().map(|u| standard_quantile(*u)).collect::<Vec<_>>();
        let sum: f64 = (0..1 << 14).map(z).map(|z| z[0] * z[1]).sum();
        let coefficient = sum / f64::from(1 << 14);
        // A Sobol sequence of 16384 points integrates the product to a few parts in a thousand.
        assert!((coefficient - 0.6).abs() < 5e-3, "{coefficient}");
    }

    #[test]
    fn a_correlated_latin_hypercube_keeps_its_parts_and_has_the_coefficient() {
        let mut design = Design::new(Kind::LatinHypercube, 500, 3, 11);
        let wanted = [[1.0, 0.6, -0.3], [0.6, 1.0, 0.2], [-0.3, 0.2, 1.0]];
        let matrix = DMatrix::from_fn(3, 3, |i, j| wanted[i][j]);
        design.correlation = Cholesky::new(matrix).map(|c| c.l());
        let points: Vec<Vec<f64>> = (0..500).map(|run| design.point(run)).collect();
        for dimension in 0..3 {
            let mut parts: Vec<usize> =
                points.iter().map(|p| (p[dimension] * 500.0) as usize).collect();
            parts.sort_unstable();
            assert_eq!(parts, (0..500).collect::<Vec<_>>());
        }
        for (i, j) in [(0, 1), (0, 2), (1, 2)] {
            let z = |p: &Vec<f64>, k: usize| standard_quantile(p[k]);
            let sum: f64 = points.iter().map(|p| z(p, i) * z(p, j)).sum();
            // Ranks are paired, not scores: the sample's coefficient differs by some 1/n.
            assert!((sum / 500.0 - wanted[i][j]).abs() < 0.01, "{i} {j}: {}", sum / 500.0);
        }
    }
}
