//! Krylov subspaces of an operator that is symmetric in some inner product, or of one that is not.
//!
//! Lanczos's and Arnoldi's processes with all vectors stored and orthogonalised twice. Vectors are queued for their images, so that new directions
//! can be added at any time: multiple eigenvalues need as many.

use nalgebra::{Complex, DMatrix, DVector, SymmetricEigen};

use crate::linalg::block::inner;

/// Nodal values.
pub type Nodal = Vec<[f64; 4]>;

/// A vector and its image under the matrix of the inner product.
#[derive(Clone, Debug)]
pub struct ImagePair {
    /// The vector, shape (nodes, 4) \[-, 1/m, to a common factor\].
    pub x: Nodal,
    /// Its image, shape (nodes, 4) \[unit of the matrix times that of the vector\].
    pub image: Nodal,
}

/// The remainder of a vector after orthogonalisation below this share of it is round-off.
const DEPENDENT: f64 = 1e-11;
/// Residual of an eigenvalue that has settled, as a share of it; eigenvalues are better by its square.
const SETTLED: f64 = 1e-9;
/// Round-off of residuals, as a share of the largest eigenvalue.
const ROUND_OFF: f64 = 4e-16;

/// An orthonormal basis with the operator's matrix in it.
pub struct Krylov<'a> {
    /// The matrix of the inner product.
    image_of: Box<dyn Fn(&Nodal) -> Nodal + 'a>,
    /// The operator: from the image of a vector.
    solve: Box<dyn Fn(&Nodal) -> Nodal + 'a>,
    /// Directions left out, shape (such directions).
    deflated: &'a [ImagePair],
    /// The vectors of the basis with their images, shape (size of the basis).
    basis: Vec<ImagePair>,
    /// Coordinates of the images of the basis, for the vectors whose images are formed, shape (images, coefficients of one) \[unit of the
    /// operator's eigenvalues\].
    columns: Vec<Vec<f64>>,
    seed: u64,
    nodes: usize,
}

/// Nodal values that are orthogonal to no motion.
pub fn random(nodes: usize, seed: &mut u64) -> Nodal {
    let mut next = || {
        *seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (*seed >> 33) as f64 / (1_u64 << 31) as f64 - 0.5
    };
    (0..nodes).map(|_| std::array::from_fn(|_| next())).collect()
}

/// An eigenvalue with its vector's coordinates in the basis.
#[derive(Clone, Debug)]
pub struct Ritz {
    pub value: Complex<f64>,
    /// Coordinates of the vector in the basis, shape (size of the basis) \[-\].
    coordinates: DVector<Complex<f64>>,
    residual: f64,
}

impl<'a> Krylov<'a> {
    pub fn new(
        nodes: usize,
        deflated: &'a [ImagePair],
        image_of: impl Fn(&Nodal) -> Nodal + 'a,
        solve: impl Fn(&Nodal) -> Nodal + 'a,
    ) -> Self {
        let (image_of, solve) = (Box::new(image_of), Box::new(solve));
        let (basis, columns) = (Vec::new(), Vec::new());
        Self { image_of, solve, deflated, basis, columns, seed: 1, nodes }
    }

    /// Adds a new direction; `false` if the operator yields no new one.
    pub fn join(&mut self) -> bool {
        let x = random(self.nodes, &mut self.seed);
        let mut pair = self.pair(x);
        // Twice: the remainder is smooth and within the operator's range.
        for _ in 0..2 {
            self.deflate(&mut pair);
            pair = self.pair((self.solve)(&pair.image));
        }
        self.deflate(&mut pair);
        self.append(pair, &mut Vec::new())
    }

    fn pair(&self, x: Nodal) -> ImagePair {
        let image = (self.image_of)(&x);
        ImagePair { x, image }
    }

    fn deflate(&self, pair: &mut ImagePair) {
        for other in self.deflated {
            let along = inner(&pair.x, &other.image);
            subtract(pair, along, other);
        }
    }

    /// Appends a vector to the basis and returns its coordinates; `false` if it depends on the basis.
    fn append(&mut self, mut pair: ImagePair, coordinates: &mut Vec<f64>) -> bool {
        coordinates.clear();
        coordinates.resize(self.basis.len(), 0.0);
        let before = inner(&pair.x, &pair.image).max(0.0).sqrt();
        for _ in 0..2 {
            self.deflate(&mut pair);
            for (other, c) in self.basis.iter().zip(coordinates.iter_mut()) {
                let along = inner(&pair.x, &other.image);
                subtract(&mut pair, along, other);
                *c += along;
            }
            // Computed again: differences of vectors and images would grow from step to step.
            pair.image = (self.image_of)(&pair.x);
        }
        let size = inner(&pair.x, &pair.image).max(0.0).sqrt();
        if !(size > DEPENDENT * before && size.is_normal()) {
            return false;
        }
        for x in [&mut pair.x, &mut pair.image] {
            x.as_flattened_mut().iter_mut().for_each(|c| *c /= size);
        }
        coordinates.push(size);
        self.basis.push(pair);
        true
    }

    /// Forms the image of the next vector of the basis; `false` if all have theirs.
    pub fn advance(&mut self) -> bool {
        let Some(next) = self.basis.get(self.columns.len()) else { return false };
        let image = self.pair((self.solve)(&next.image));
        let mut column = Vec::new();
        self.append(image, &mut column);
        self.columns.push(column);
        true
    }

    /// Extends the subspace until `done` or `most` vectors; `false` if the operator yields no new direction.
    pub fn grow(&mut self, least: usize, most: usize, done: impl Fn(&Self) -> bool) -> bool {
        while self.size() < most.max(least) {
            if !self.advance() && !self.join() {
                return false;
            }
            if self.size() >= least && self.size().is_multiple_of(4) && done(self) {
                return true;
            }
        }
        true
    }

    /// Vectors whose images are known.
    pub fn size(&self) -> usize {
        self.columns.len()
    }

    fn entry(&self, i: usize, j: usize) -> f64 {
        self.columns[j].get(i).copied().unwrap_or(0.0)
    }

    /// Eigenvalues of a symmetric operator in the basis, descending.
    pub fn symmetric(&self) -> Vec<Ritz> {
        let n = self.size();
        if n == 0 {
            return Vec::new(); // a structure without mass or stiffness, or with NaN, yields no direction
        }
        let matrix = DMatrix::from_fn(n, n, |i, j| 0.5 * (self.entry(i, j) + self.entry(j, i)));
        let eigen = SymmetricEigen::new(matrix);
        let mut all: Vec<Ritz> = (0..n)
            .map(|k| {
                let coordinates = eigen.eigenvectors.column(k).map(|c| Complex::new(c, 0.0));
                self.ritz(Complex::new(eigen.eigenvalues[k], 0.0), coordinates)
            })
            .collect();
        all.sort_by(|a, b| b.value.re.total_cmp(&a.value.re));
        all
    }

    /// Eigenvalues of any operator in the basis, by descending magnitude; of a conjugate pair the one with positive imaginary
    /// part.
    pub fn general(&self) -> Vec<Ritz> {
        let n = self.size();
        if n == 0 {
            return Vec::new();
        }
        let matrix = DMatrix::from_fn(n, n, |i, j| self.entry(i, j));
        let mut values: Vec<Complex<f64>> =
            matrix.complex_eigenvalues().iter().copied().filter(|v| v.im >= 0.0).collect();
        values.sort_by(|a, b| b.norm().total_cmp(&a.norm()));
        let complex = matrix.map(|x| Complex::new(x, 0.0));
        let vector = |value: &Complex<f64>| {
            // Inverse iteration beside the eigenvalue.
            let shift = value * (1.0 + 1e-10);
            let shifted = &complex - DMatrix::identity(n, n) * shift;
            let lu = shifted.lu();
            let mut x = DVector::from_fn(n, |i, _| Complex::new(1.0 / (1.0 + i as f64), 0.0));
            for _ in 0..3 {
                x = lu.solve(&x).unwrap_or(x);
                let size = x.norm();
                x /= Complex::new(size, 0.0);
            }
            x
        };
        values.iter().map(|v| self.ritz(*v, vector(v))).collect()
    }

    fn ritz(&self, value: Complex<f64>, coordinates: DVector<Complex<f64>>) -> Ritz {
        let n = self.size();
        let outside = (n..self.basis.len()).map(|i| {
            let along: Complex<f64> = (0..n).map(|j| coordinates[j] * self.entry(i, j)).sum();
            along.norm_sqr()
        });
        let residual = outside.sum::<f64>().sqrt();
        Ritz { value, coordinates, residual }
    }

    /// Whether the first `count` have settled.
    pub fn settled(&self, found: &[Ritz], count: usize) -> bool {
        let most = found.first().map_or(0.0, |r| r.value.norm());
        found.len() >= count
            && found[..count]
                .iter()
                .all(|r| r.residual <= SETTLED * r.value.norm() + ROUND_OFF * most)
    }

    /// The real part of an eigenvector, turned in the complex plane to where that is largest.
    pub fn shape(&self, ritz: &Ritz) -> ImagePair {
        let square: Complex<f64> = ritz.coordinates.iter().map(|c| c * c).sum();
        let turn = Complex::from_polar(1.0, -0.5 * square.arg());
        let mut sum =
            ImagePair { x: vec![[0.0; 4]; self.nodes], image: vec![[0.0; 4]; self.nodes] };
        for (c, v) in ritz.coordinates.iter().zip(&self.basis) {
            subtract(&mut sum, -(c * turn).re, v);
        }
        sum
    }
}

/// `pair -= factor other`.
pub fn subtract(pair: &mut ImagePair, factor: f64, other: &ImagePair) {
    for (x, y) in [(&mut pair.x, &other.x), (&mut pair.image, &other.image)] {
        for (x, y) in x.as_flattened_mut().iter_mut().zip(y.as_flattened()) {
            *x -= factor * y;
        }
    }
}
