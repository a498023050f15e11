//! Interaction of axial force and moment: plastic resistance of a rectangle.

use percuss::*;

use crate::check::{Checks, Report};
use crate::structure::at;
use crate::yielding::perfect;

/// Width, depth and length of the bar \[m\]: a slice, so short that the moment of the axial force about the deflected axis is negligible; a longer
/// bar in tension carries more by deflection.
const BAR: [f64; 3] = [0.02, 0.04, 2e-4];
const LIMIT: f64 = 250e6;
/// Fibres through the depth; the plastic neutral axis is between two of them.
const FIBRES: usize = 96;

/// Whether a cantilever carries an axial force and a moment at its end, which grow in proportion.
fn is_carried(axial: f64, moment: f64) -> bool {
    let [width, depth, length] = BAR;
    let mut b = ModelBuilder::new();
    let steel = b.material(perfect(200e9, 7850.0, LIMIT));
    let section = Section { fibres: FIBRES, ..Section::rectangle("bar", width, depth) };
    let section = b.section(section);
    let arm = b.beam(Beam::new("arm", &[[0.0, 0.0], [length, 0.0]], 1, steel, section));
    b.support(Support::new("root", at("root", arm, 0.0), SupportKind::Clamp));
    let kind =
        LoadKind::Point { at: at("tip", arm, 1.0), force: [axial, 0.0], moment, follower: false };
    b.load(Load::new("end", kind));
    b.build().is_ok_and(|model| equilibrium(&model).is_ok())
}

/// `M/M0 = 1 - (N/N0)^2` with `N0 = Y b h`, `M0 = Y b h^2/4`: the largest common factor of axial force and moment, along rays in tension and
/// compression.
pub fn interaction() -> Report {
    let mut c = Checks::new();
    let [width, depth, _] = BAR;
    let (axial, moment) = (LIMIT * width * depth, LIMIT * width * depth * depth / 4.0);
    for n in [0.0, 0.3, 0.6, 0.9, -0.3, -0.6, -0.9] {
        let m = 1.0 - n * n;
        let (mut low, mut high) = (0.5, 1.5);
        for _ in 0..13 {
            let share = 0.5 * (low + high);
            let borne = is_carried(share * n * axial, share * m * moment);
            *(if borne { &mut low } else { &mut high }) = share;
        }
        c.absolute(format!("N/N0 = {n}, M/M0 = {m:.2}: share borne"), low, 1.0, 3e-3);
    }
    c.into_report()
}
