//! Tables of stress over plastic strain: from the test in which they were measured to the strain measure of a material.
//!
//! A test bar of unit area carries the force P at the stretch nu: with nominal stress s and strain e, `nu = 1 + e` and `P = s`; with true
//! stress and logarithmic strain, `nu = exp(e)` and `P = s / nu`, since plastic flow keeps the volume. A beam carries it with the stress
//! `P` at the engineering strain `nu - 1`, or with `P / nu` at Green's `(nu^2 - 1) / 2`.

use percuss::StrainMeasure;

use crate::content::TableStress;

/// Stresses between two points of a converted table are off by less, relative.
const CLOSE: f64 = 2e-7;
/// Halvings of a part of a table at most.
const MOST_HALVINGS: u32 = 12;
/// Forces that fall by less, relative, do not.
const LEVEL: f64 = 1e-9;
/// Nominal strains up to which the force stays the same behind the last point: in tension, in compression.
const REACH: [f64; 2] = [1.0, 0.5];

/// A table and the test in which it was measured.
pub(super) struct StressTable<'a> {
    /// Plastic strain and stress, shape (points, 2) \[-, Pa\].
    pub points: &'a [[f64; 2]],
    pub stress: TableStress,
    pub measure: StrainMeasure,
    /// Young's modulus \[Pa\].
    pub young: f64,
    /// Kinematic plastic modulus \[Pa\].
    pub kinematic: f64,
    /// Whether the test was one in compression.
    pub presses: bool,
}

/// A point of the test.
#[derive(Clone, Copy)]
struct Tested {
    /// Stretch.
    stretch: f64,
    /// Force over the area of the free bar, its magnitude \[Pa\].
    force: f64,
}

impl StressTable<'_> {
    /// Plastic strain and stress in the measure of the material.
    ///
    /// # Errors
    /// The nominal strain beyond which the force of the test falls: there a bar necks.
    pub fn converted(&self) -> Result<Vec<[f64; 2]>, f64> {
        if self.stress == TableStress::Nominal && self.measure == StrainMeasure::Engineering {
            return Ok(self.points.to_vec());
        }
        let Some(last) = self.points.last() else { return Ok(Vec::new()) };
        let mut tested: Vec<Tested> = Vec::new();
        for pair in self.points.windows(2) {
            self.add(
                &|share| self.tested(self.stress, between(pair[0], pair[1], share)),
                &mut tested,
            );
        }
        let end = self.tested(self.stress, *last);
        self.require_rise(&tested)?;
        // Behind the last point the nominal stress stays the same.
        let side = if self.presses { -1.0 } else { 1.0 };
        let strain = side * (end.stretch - 1.0);
        let flow = strain - end.force / self.young;
        let from = [flow, end.force - self.kinematic * flow];
        let reach = REACH[usize::from(self.presses)].max(strain);
        let to = [flow + (reach - strain), from[1]];
        self.add(&|share| self.tested(TableStress::Nominal, between(from, to, share)), &mut tested);
        Ok(self.begun(&tested))
    }

    /// A point of the table as tested.
    fn tested(&self, stress: TableStress, [plastic, isotropic]: [f64; 2]) -> Tested {
        let all = isotropic + self.kinematic * plastic;
        let strain = plastic + all / self.young;
        let strain = if self.presses { -strain } else { strain };
        match stress {
            TableStress::Nominal => Tested { stretch: 1.0 + strain, force: all },
            TableStress::True => Tested { stretch: strain.exp(), force: all / strain.exp() },
        }
    }

    /// Plastic strain and stress at which a fibre of the material carries what was tested.
    fn fibre(&self, of: &Tested) -> [f64; 2] {
        let nu = of.stretch;
        let (strain, stress) = match self.measure {
            StrainMeasure::Engineering => (nu - 1.0, of.force),
            StrainMeasure::Green => (0.5 * (nu - 1.0) * (nu + 1.0), of.force / nu),
        };
        let plastic = strain.abs() - stress / self.young;
        [plastic, stress - self.kinematic * plastic]
    }

    /// Adds a part of the test, in pieces that are straight in the measure of the material.
    fn add(&self, part: &impl Fn(f64) -> Tested, out: &mut Vec<Tested>) {
        out.extend(out.is_empty().then(|| part(0.0)));
        self.add_between([0.0, 1.0], MOST_HALVINGS, part, out);
    }

    fn add_between(
        &self,
        [from, to]: [f64; 2],
        halvings: u32,
        part: &impl Fn(f64) -> Tested,
        out: &mut Vec<Tested>,
    ) {
        let middle = 0.5 * (from + to);
        let [a, m, b] = [from, middle, to].map(|share| self.fibre(&part(share)));
        let chord = a[1] + (b[1] - a[1]) * (m[0] - a[0]) / (b[0] - a[0]);
        if halvings > 0 && (m[1] - chord).abs() > CLOSE * m[1].abs() {
            self.add_between([from, middle], halvings - 1, part, out);
            self.add_between([middle, to], halvings - 1, part, out);
        } else {
            out.push(part(to));
        }
    }

    /// The test goes on as long as its force does not fall.
    fn require_rise(&self, tested: &[Tested]) -> Result<(), f64> {
        let falls = |pair: &&[Tested]| pair[1].force < (1.0 - LEVEL) * pair[0].force;
        match tested.windows(2).find(falls) {
            Some(pair) if !self.presses => Err(pair[0].stretch - 1.0),
            _ => Ok(()),
        }
    }

    /// The curve of a material from no plastic strain on: where it leaves Hooke's law in its own measure.
    fn begun(&self, tested: &[Tested]) -> Vec<[f64; 2]> {
        let all: Vec<[f64; 2]> = tested.iter().map(|t| self.fibre(t)).collect();
        let first = all.partition_point(|point| point[0] <= 0.0);
        let Some(next) = all.get(first) else { return self.points.to_vec() };
        let start = match first.checked_sub(1).map(|k| all[k]) {
            Some(a) => a[1] + (next[1] - a[1]) * a[0] / (a[0] - next[0]),
            None => next[1],
        };
        let mut out = vec![[0.0, start]];
        for point in &all[first..] {
            if point[0] > out[out.len() - 1][0] {
                out.push(*point);
            }
        }
        out
    }
}

fn between(a: [f64; 2], b: [f64; 2], share: f64) -> [f64; 2] {
    [0, 1].map(|k| a[k] + share * (b[k] - a[k]))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Stress of the material at a plastic strain.
    fn on(curve: &[[f64; 2]], plastic: f64) -> f64 {
        let next = curve.partition_point(|p| p[0] < plastic).clamp(1, curve.len() - 1);
        let (a, b) = (curve[next - 1], curve[next]);
        a[1] + (b[1] - a[1]) * (plastic - a[0]) / (b[0] - a[0])
    }

    /// A bar of unit area, pulled or pressed to a stretch, carries the force of the test: by bisection for the plastic strain.
    fn force(table: &StressTable, stretch: f64) -> f64 {
        let curve = table.converted().unwrap();
        let green = table.measure == StrainMeasure::Green;
        let strain = if green { 0.5 * (stretch * stretch - 1.0) } else { stretch - 1.0 }.abs();
        let (mut low, mut high) = (0.0, strain);
        for _ in 0..200 {
            let p = 0.5 * (low + high);
            let carried = table.young * (strain - p) - table.kinematic * p;
            if carried > on(&curve, p) { low = p } else { high = p }
        }
        table.young * (strain - low) * if green { stretch } else { 1.0 }
    }

    #[test]
    fn a_test_gives_back_its_table_in_every_measure() {
        let points = [[0.0, 300e6], [0.02, 350e6], [0.1, 460e6], [0.2, 560e6]];
        for stress in [TableStress::Nominal, TableStress::True] {
            for measure in [StrainMeasure::Green, StrainMeasure::Engineering] {
                for (presses, kinematic) in [(false, 0.0), (true, 0.0), (false, 5e8)] {
                    let table = StressTable {
                        points: &points,
                        stress,
                        measure,
                        young: 200e9,
                        kinematic,
                        presses,
                    };
                    for plastic in [0.003, 0.02, 0.05, 0.137, 0.2] {
                        let own = on(&points, plastic) + kinematic * plastic;
                        let strain = (plastic + own / 200e9) * if presses { -1.0 } else { 1.0 };
                        let (stretch, expected) = match stress {
                            TableStress::Nominal => (1.0 + strain, own),
                            TableStress::True => (strain.exp(), own / strain.exp()),
                        };
                        let found = force(&table, stretch);
                        let name = format!("{stress:?} {measure:?} {presses} {plastic}");
                        assert!((found / expected - 1.0).abs() < 1e-6, "{name}: {found:e}");
                    }
                }
            }
        }
    }

    /// A true stress that stays the same: the force falls from first yield on.
    #[test]
    fn a_true_stress_whose_force_falls_is_no_table() {
        let points = [[0.0, 300e6], [0.2, 400e6], [0.4, 401e6]];
        let table = StressTable {
            points: &points,
            stress: TableStress::True,
            measure: StrainMeasure::Green,
            young: 200e9,
            kinematic: 0.0,
            presses: false,
        };
        let strain = table.converted().unwrap_err();
        let expected = (0.2_f64 + 400e6 / 200e9).exp() - 1.0;
        assert!((strain - expected).abs() < 1e-9, "{strain}");
    }
}
