//! Walls of sections.

/// Walls of an I or of a box, thin against its size, for its shear factor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Walls {
    /// Twice the area of a flange over that of the webs \[-\].
    pub flanges: f64,
    /// Width over the distance of the flanges' middle lines \[-\].
    pub width: f64,
    /// Whether it is a box, with a web at each side.
    pub closed: bool,
}

impl Walls {
    /// From width, depth, thickness of a flange and of a web; of a box the latter is the sum of both.
    pub(super) fn new([width, depth]: [f64; 2], flange: f64, web: f64, closed: bool) -> Self {
        let height = depth - flange;
        Self { flanges: 2.0 * width * flange / (height * web), width: width / height, closed }
    }

    /// Its shear factor, after Cowper.
    pub(super) fn shear_factor(&self, nu: f64) -> f64 {
        let (m, n2) = (self.flanges, self.width * self.width);
        let (m2, m3) = (m * m, m * m * m);
        let common = 12.0 + 72.0 * m + 150.0 * m2 + 90.0 * m3;
        let common = common + nu * (11.0 + 66.0 * m + 135.0 * m2 + 90.0 * m3);
        let sideways = match self.closed {
            true => 10.0 * n2 * ((3.0 + nu) * m + 3.0 * m2),
            false => 30.0 * n2 * (m + m2) + 5.0 * nu * n2 * (8.0 * m + 9.0 * m2),
        };
        10.0 * (1.0 + nu) * (1.0 + 3.0 * m).powi(2) / (common + sideways)
    }
}
