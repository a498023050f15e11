//! Cubic Hermite interpolation on an interval, and Gauss points for it.
//!
//! Values are ordered (value at a, slope at a, value at b, slope at b), slopes taken with respect to arc length.

/// Shape functions at `xi` in \[0, 1\] of an interval of the given length.
pub fn shape(xi: f64, length: f64) -> [f64; 4] {
    let (x2, x3) = (xi * xi, xi * xi * xi);
    [
        1.0 - 3.0 * x2 + 2.0 * x3,
        length * (xi - 2.0 * x2 + x3),
        3.0 * x2 - 2.0 * x3,
        length * (x3 - x2),
    ]
}

/// First derivatives of the shape functions with respect to arc length.
pub fn slope(xi: f64, length: f64) -> [f64; 4] {
    let x2 = xi * xi;
    let value = 6.0 * (xi - x2) / length;
    [-value, 1.0 - 4.0 * xi + 3.0 * x2, value, 3.0 * x2 - 2.0 * xi]
}

/// Second derivatives of the shape functions with respect to arc length.
pub fn curvature(xi: f64, length: f64) -> [f64; 4] {
    let value = (6.0 - 12.0 * xi) / (length * length);
    [-value, (6.0 * xi - 4.0) / length, value, (6.0 * xi - 2.0) / length]
}

/// Integrals of products of shape functions, `int density N_a N_b ds`, with a density by the share of the interval; exact for
/// densities up to third degree.
pub fn mass(length: f64, density: impl Fn(f64) -> f64) -> [[f64; 4]; 4] {
    let mut sum = [[0.0; 4]; 4];
    for (xi, weight) in FIVE_POINTS {
        let n = shape(xi, length);
        let m = weight * length * density(xi);
        for a in 0..4 {
            for b in 0..4 {
                sum[a][b] += m * (n[a] * n[b]);
            }
        }
    }
    sum
}

/// Abscissae in \[0, 1\] and weights of the five-point Gauss rule.
const FIVE_POINTS: [(f64, f64); 5] = [
    (0.046_910_077_030_668_004, 0.118_463_442_528_094_54),
    (0.230_765_344_947_158_45, 0.239_314_335_249_683_23),
    (0.5, 0.284_444_444_444_444_44),
    (0.769_234_655_052_841_5, 0.239_314_335_249_683_23),
    (0.953_089_922_969_332, 0.118_463_442_528_094_54),
];

/// Number of Gauss points of an element; two are not enough, more have no effect.
pub const GAUSS: usize = 3;

/// Abscissae in \[0, 1\] of the three-point Gauss rule.
pub fn gauss_points() -> [f64; GAUSS] {
    let d = 0.5 * (0.6_f64).sqrt();
    [0.5 - d, 0.5, 0.5 + d]
}

/// Half-way between the first two Gauss points: `1/2 - sqrt(3/5)/4`.
const BETWEEN: f64 = 0.306_350_832_689_629_15;

/// The Gauss point nearest to a place of \[0, 1\].
#[inline(always)]
pub fn nearest_gauss_point(xi: f64) -> usize {
    usize::from(xi > BETWEEN) + usize::from(xi > 1.0 - BETWEEN)
}

/// The same, twice; or the two that are as near: which of them is not for round-off to decide.
pub fn nearest_gauss_points(xi: f64) -> [usize; 2] {
    [xi - 1e-9, xi + 1e-9].map(nearest_gauss_point)
}

/// Weights of the three-point Gauss rule on \[0, 1\].
pub const GAUSS_WEIGHTS: [f64; GAUSS] = [5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0];

/// A scalar cubic on `[0, h]` through values and slopes at both ends.
#[derive(Clone, Copy, Debug)]
pub struct Cubic {
    /// Length of the interval.
    pub h: f64,
    /// Value and slope at 0, shape (2) \[unit of the value, and that by the unit of `h`\].
    pub start: [f64; 2],
    /// Value and slope at `h`, shape (2) \[unit of the value, and that by the unit of `h`\].
    pub end: [f64; 2],
}

impl Cubic {
    /// Value at `t`.
    pub fn value(&self, t: f64) -> f64 {
        let n = shape(t / self.h, self.h);
        n[0] * self.start[0] + n[1] * self.start[1] + n[2] * self.end[0] + n[3] * self.end[1]
    }

    /// Slope at `t`.
    pub fn slope(&self, t: f64) -> f64 {
        let n = slope(t / self.h, self.h);
        n[0] * self.start[0] + n[1] * self.start[1] + n[2] * self.end[0] + n[3] * self.end[1]
    }

    /// Interior points where the slope vanishes, in order; at most two.
    pub fn stationary(&self) -> impl Iterator<Item = f64> {
        // Slope in xi: a xi^2 + b xi + c, by Horner coefficients of the cubic.
        let h = self.h;
        let rise = self.end[0] - self.start[0];
        let (s0, s1) = (self.start[1] * h, self.end[1] * h);
        let (a, b, c) = (3.0 * (s0 + s1 - 2.0 * rise), 2.0 * (3.0 * rise - 2.0 * s0 - s1), s0);
        let discriminant = b * b - 4.0 * a * c;
        let mut roots = [f64::NAN; 2];
        if discriminant >= 0.0 {
            let q = -0.5 * (b + discriminant.sqrt().copysign(b));
            roots = [q / a, c / q];
            if roots[0] > roots[1] {
                roots.swap(0, 1);
            }
        }
        roots.into_iter().filter(|xi| *xi > 0.0 && *xi < 1.0).map(move |xi| xi * h)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shape_functions_reproduce_a_cubic_and_its_derivatives() {
        let f = |s: f64| 1.0 - 2.0 * s + 0.5 * s * s + 3.0 * s * s * s;
        let d = |s: f64| -2.0 + s + 9.0 * s * s;
        let dd = |s: f64| 1.0 + 18.0 * s;
        let l = 0.7;
        let nodal = [f(0.0), d(0.0), f(l), d(l)];
        let combine = |n: [f64; 4]| (0..4).map(|k| n[k] * nodal[k]).sum::<f64>();
        for xi in [0.0, 0.21, 0.5, 0.93, 1.0] {
            assert!((combine(shape(xi, l)) - f(xi * l)).abs() < 1e-14);
            assert!((combine(slope(xi, l)) - d(xi * l)).abs() < 1e-13);
            assert!((combine(curvature(xi, l)) - dd(xi * l)).abs() < 1e-12);
        }
    }

    #[test]
    fn mass_is_the_integral_of_products_of_shape_functions() {
        let l = 1.3;
        let found = mass(l, |_| 1.0);
        let f = l / 420.0;
        let exact = [
            [156.0 * f, 22.0 * l * f, 54.0 * f, -13.0 * l * f],
            [22.0 * l * f, 4.0 * l * l * f, 13.0 * l * f, -3.0 * l * l * f],
            [54.0 * f, 13.0 * l * f, 156.0 * f, -22.0 * l * f],
            [-13.0 * l * f, -3.0 * l * l * f, -22.0 * l * f, 4.0 * l * l * f],
        ];
        for a in 0..4 {
            for b in 0..4 {
                assert!((found[a][b] - exact[a][b]).abs() < 1e-15);
            }
        }
    }

    #[test]
    fn stationary_points_of_a_cubic() {
        // t^3 - 3 t on [0, 2]: slope vanishes at 1.
        let c = Cubic { h: 2.0, start: [0.0, -3.0], end: [2.0, 9.0] };
        let found: Vec<f64> = c.stationary().collect();
        assert_eq!(found.len(), 1);
        assert!((found[0] - 1.0).abs() < 1e-14 && (c.value(1.0) + 2.0).abs() < 1e-14);
    }
}
