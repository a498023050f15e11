//! Scenarios in millimetres and newtons, whose numbers are read as metres and pascals.

use super::advice::magnitude_finding;
use super::structure::BeamPlace;
use super::words::{digits, quantity};
use super::{Advice, Verdict};
use percuss::Model;

/// Young's moduli that are structural ones in N/mm^2, from plastics to tungsten; in Pa they are those of gels and foams.
const YOUNG: [f64; 2] = [5e2, 4.5e5];
/// What is so soft, so long and so deep at once is not built \[m\].
const LENGTH: f64 = 10.0;
const DEPTH: f64 = 0.5;

/// What a beam is, by its numbers.
struct Numbers {
    young: f64,
    length: f64,
    depth: f64,
}

impl Numbers {
    fn of(model: &Model, index: usize) -> Option<Self> {
        let place = BeamPlace::new(model, index, 0.0);
        let row = place.beam.spans().next()?.gauss_points(0)[1].section;
        let depth = match row.half_depth > 0.0 {
            true => 2.0 * row.half_depth,
            false => 12_f64.sqrt() * row.gyration(),
        };
        Some(Self { young: row.young, length: place.beam.length(), depth })
    }

    /// Whether they make sense in millimetres and newtons alone.
    fn fit(&self) -> bool {
        let soft = (YOUNG[0]..=YOUNG[1]).contains(&self.young);
        soft && self.length >= LENGTH && self.depth >= DEPTH
    }
}

/// The finding, where all beams have such numbers.
pub fn finding(model: &Model) -> Option<Advice> {
    let all: Vec<Numbers> =
        (0..model.beam_count()).filter_map(|index| Numbers::of(model, index)).collect();
    let first = all.first().filter(|_| all.iter().all(Numbers::fit))?;
    let text = format!(
        "beam '{}' is {} long and {} deep with a Young's modulus of {}: values appear to be in mm and N; numbers without a unit are SI \
         (m, N, Pa, kg, s). Add units, such as \"{} mm\", \"{} MPa\", to all values (lengths, areas, densities, velocities, stiffnesses)",
        model.beam(0).name(),
        quantity(first.length, "m"),
        quantity(first.depth, "m"),
        quantity(first.young, "Pa"),
        digits(first.length),
        digits(first.young),
    );
    Some(magnitude_finding("units", [first.young, YOUNG[1]], "Pa", Verdict::Warning, text))
}
