//! How the area of a section lies about its centre line, and fibres laid out over it.
//!
//! Fibres are at the points of Gauss rules over the upper and the lower half: with two points or more in each, area, second moment of area and
//! plastic moment are exact, since `1`, `y^2` and `|y|` are polynomials of low degree over a half.

use nalgebra::{DMatrix, SymmetricEigen};

use super::MaterialId;

/// How the area of a section lies about its centre line.
#[derive(Clone, Debug, PartialEq)]
pub enum Profile {
    /// Not known: such a section cannot yield.
    Unknown,
    /// Strips of uniform width in the upper half, mirrored in the lower one, from the centre line outwards, shape (strips).
    Strips(Vec<Strip>),
    /// A circle with a round hole.
    Ring {
        /// Outer radius \[m\].
        outer: f64,
        /// Inner radius, zero for a full circle \[m\].
        inner: f64,
    },
    /// Fibres as given, of one material or of several, shape (fibres): such a section is made of them whatever its materials do.
    Fibres(Vec<SectionFibre>),
}

/// A fibre of a section that is given fibre by fibre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SectionFibre {
    /// Height above the centre line, along the normal to the left of the beam's direction \[m\].
    pub height: f64,
    /// Area \[m^2\].
    pub area: f64,
    /// Its material; that of the beam without.
    pub material: Option<MaterialId>,
}

/// A part of a section of uniform width.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strip {
    /// Height above the centre line at which it begins \[m\].
    pub from: f64,
    /// Height at which it ends \[m\].
    pub to: f64,
    /// Width across the plane of bending \[m\].
    pub width: f64,
}

/// Points of the rules that moments of a round half are summed with.
const FINE: usize = 48;

impl Profile {
    /// A web of the clear height between two flanges.
    pub(super) fn flanged(width: f64, depth: f64, clear: f64, web: f64) -> Self {
        Self::Strips(vec![
            Strip { from: 0.0, to: 0.5 * clear, width: web },
            Strip { from: 0.5 * clear, to: 0.5 * depth, width },
        ])
    }

    /// Heights \[m\] and areas \[m^2\] of about `count` fibres through the depth; none if the profile is not known.
    pub(crate) fn fibres(&self, count: usize) -> Vec<[f64; 2]> {
        let half = (count / 2).max(2);
        let upper = match self {
            Self::Unknown => Vec::new(),
            Self::Fibres(given) => return given.iter().map(|f| [f.height, f.area]).collect(),
            Self::Strips(strips) => {
                let thin = 2 * (strips.len() - 1);
                let fibres = |(i, strip): (usize, &Strip)| {
                    let strip = *strip;
                    let points = if i == 0 { half.saturating_sub(thin).max(2) } else { 2 };
                    let (middle, length) = (0.5 * (strip.from + strip.to), strip.to - strip.from);
                    legendre(points).into_iter().map(move |[x, w]| {
                        [middle + 0.5 * length * x, 0.5 * w * length * strip.width]
                    })
                };
                strips.iter().enumerate().flat_map(fibres).collect()
            }
            Self::Ring { outer, inner } => round(*outer, *inner, half),
        };
        let lower = upper.iter().rev().map(|[y, area]| [-y, *area]);
        lower.chain(upper.iter().copied()).collect()
    }
}

/// Gauss points and weights of the upper half of a ring.
fn round(outer: f64, inner: f64, points: usize) -> Vec<[f64; 2]> {
    let width =
        |y: f64| 2.0 * ((outer * outer - y * y).sqrt() - (inner * inner - y * y).max(0.0).sqrt());
    let mut fine = Vec::new();
    // With y = r sin(t) the root at the rim is smooth.
    let angle = if inner > 0.0 { (inner / outer).asin() } else { 0.0 };
    let quarter = std::f64::consts::FRAC_PI_2;
    for (radius, from) in [(inner, 0.0), (outer, angle)] {
        for [x, w] in legendre(FINE) {
            let t = from + 0.5 * (x + 1.0) * (quarter - from);
            let y = radius * t.sin();
            let weight = 0.5 * w * (quarter - from) * radius * t.cos() * width(y);
            if weight > 0.0 {
                fine.push([y, weight]);
            }
        }
    }
    gauss_of(&fine, points)
}

/// The Gauss rule of `points` points that has the moments of a finer one: recurrence of its orthogonal polynomials (Stieltjes), then
/// eigenvalues of its Jacobi matrix (Golub, Welsch 1969).
fn gauss_of(fine: &[[f64; 2]], points: usize) -> Vec<[f64; 2]> {
    let (mut before, mut now) = (vec![0.0; fine.len()], vec![1.0; fine.len()]);
    let (mut last, mut diagonal, mut off) = (1.0, Vec::new(), Vec::new());
    for k in 0..points {
        let sum =
            |f: &dyn Fn(usize) -> f64| (0..fine.len()).map(|i| fine[i][1] * f(i)).sum::<f64>();
        let norm = sum(&|i| now[i] * now[i]);
        let a = sum(&|i| fine[i][0] * now[i] * now[i]) / norm;
        let b = if k == 0 { 0.0 } else { norm / last };
        diagonal.push(a);
        off.push(b);
        let next = (0..fine.len()).map(|i| (fine[i][0] - a) * now[i] - b * before[i]).collect();
        (before, now, last) = (now, next, norm);
    }
    let total: f64 = fine.iter().map(|p| p[1]).sum();
    golub_welsch(&diagonal, &off[1..], total)
}

/// Points and weights of the Gauss-Legendre rule on `[-1, 1]`.
fn legendre(points: usize) -> Vec<[f64; 2]> {
    let off: Vec<f64> = (1..points).map(|k| (k * k) as f64 / (4 * k * k - 1) as f64).collect();
    golub_welsch(&vec![0.0; points], &off, 2.0)
}

/// Points and weights from the recurrence of orthogonal polynomials, `off` their squared off-diagonal coefficients.
fn golub_welsch(diagonal: &[f64], off: &[f64], total: f64) -> Vec<[f64; 2]> {
    let n = diagonal.len();
    let jacobi = DMatrix::from_fn(n, n, |i, j| match i.abs_diff(j) {
        0 => diagonal[i],
        1 => off[i.min(j)].sqrt(),
        _ => 0.0,
    });
    let eigen = SymmetricEigen::new(jacobi);
    let weight = |k: usize| total * eigen.eigenvectors[(0, k)].powi(2);
    let mut rule: Vec<[f64; 2]> = (0..n).map(|k| [eigen.eigenvalues[k], weight(k)]).collect();
    rule.sort_by(|a, b| a[0].total_cmp(&b[0]));
    rule
}

#[cfg(test)]
mod tests {
    use super::super::Section;

    #[test]
    fn fibres_have_area_inertia_and_plastic_moment_of_their_shape() {
        let (d, i) = (0.2_f64, 0.16_f64);
        let cases = [
            (Section::rectangle("r", 0.1, d), 0.1 * d * d / 4.0),
            (Section::circle("c", d), d.powi(3) / 6.0),
            (Section::tube("t", d, 0.02), (d.powi(3) - i.powi(3)) / 6.0),
            (
                Section::i_shape("i", 0.1, d, 0.02, 0.01),
                0.1 * 0.02 * 0.18 + 0.01 * 0.16_f64.powi(2) / 4.0,
            ),
            (Section::hollow_box("b", 0.1, d, 0.02), (0.1 * d * d - 0.06 * i * i) / 4.0),
            // Published: IPE 200, Wpl = 220.6 cm^3 (EN 10365); RHS 200x100x8, Wpl = 282 cm^3 (EN 10210-2); here with all digits.
            (Section::rolled_i("ri", 0.1, d, 8.5e-3, 5.6e-3, 12e-3), 2.206_386_473_017_04e-4),
            (Section::rounded_box("rb", 0.1, d, 8e-3, [12e-3, 8e-3]), 2.819_503_933_339_24e-4),
        ];
        for (section, plastic) in cases {
            for count in [4, 8, 12, 24] {
                let fibres = section.profile.fibres(count);
                let sum = |f: fn(f64) -> f64| fibres.iter().map(|[y, a]| a * f(*y)).sum::<f64>();
                let near = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-11;
                assert!(near(sum(|_| 1.0), section.area), "{} {count}", section.name);
                assert!(near(sum(|y| y * y), section.inertia), "{} {count}", section.name);
                assert!(near(sum(f64::abs), plastic), "{} {count}", section.name);
                assert!(sum(|y| y).abs() < 1e-15 && fibres.iter().all(|[_, a]| *a > 0.0));
            }
        }
    }
}
