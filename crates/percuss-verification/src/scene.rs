//! Cases defined by scenario files.

use percuss::*;
use percuss_scenario::Compiled;

use crate::check::Checks;
use crate::structure::or_nan;

/// A file of `published/` in the crate.
macro_rules! published {
    ($name:literal) => {
        ($name, include_str!(concat!("../published/", $name, ".toml")))
    };
}
pub(crate) use published;

/// The model of a file, which is shown in the manual.
///
/// # Panics
/// If the case's file has errors.
pub fn scene(c: &mut Checks, (name, text): (&'static str, &'static str)) -> Compiled {
    c.file(name, text);
    compiled(text, name)
}

/// The model of a text that is not shown in the manual.
///
/// # Panics
/// If the text has errors.
pub fn compiled(text: &str, name: &str) -> Compiled {
    let scenario = percuss_scenario::read(text, name).unwrap_or_else(|faults| panic!("{faults}"));
    scenario.compile().unwrap_or_else(|faults| panic!("{faults}"))
}

/// A run with its history.
pub struct Recorded {
    rows: MemoryRecorder,
    /// Summary of the run.
    pub summary: RunSummary,
}

impl Recorded {
    /// Runs a scene.
    ///
    /// # Panics
    /// If the case's settings are invalid.
    pub fn of(compiled: &Compiled) -> Self {
        let mut rows = MemoryRecorder::default();
        let summary = simulate(&compiled.model, &compiled.settings, &mut rows);
        Self { rows, summary: summary.expect("a verification case has valid settings") }
    }

    /// A column over time, shape (rows, 2): \[s, unit of the column\]; empty if it does not exist.
    pub fn curve(&self, name: &str) -> Vec<[f64; 2]> {
        let time = self.rows.column("time").unwrap_or_default();
        let column = self.rows.column(name).unwrap_or_default();
        time.into_iter().zip(column).map(|(t, y)| [t, y]).collect()
    }

    /// The largest displacement of a recorded point in a direction, by magnitude.
    pub fn displacement(&self, point: &str, component: usize) -> Peak {
        let found = self.summary.points.iter().find(|p| p.name == point);
        found.map_or(Peak { value: f64::NAN, time: f64::NAN }, |p| p.displacement_max[component])
    }

    /// Checks the energy balance.
    pub fn balances(&self, c: &mut Checks) {
        c.at_most("energy residual", self.summary.energy.residual_max, 1e-10);
    }
}

/// Displacement of a recorded point in equilibrium.
pub fn displaced(found: &Equilibrium, point: &str) -> [f64; 2] {
    let point = found.points.iter().find(|(name, _)| name == point);
    point.map_or([f64::NAN; 2], |(_, u)| *u)
}

/// Moment, shear force and axial force at the start of an element in equilibrium.
pub fn at_element(found: &Equilibrium, element: usize) -> [f64; 3] {
    [0, 1, 2].map(|k| or_nan(found.element_forces.get(element).map(|ends| ends[0][k])))
}

/// Every n-th point of a curve and the last one, for a figure.
pub fn thinned(curve: &[[f64; 2]], most: usize) -> Vec<[f64; 2]> {
    let step = curve.len().div_ceil(most.max(1)).max(1);
    let mut kept: Vec<[f64; 2]> = curve.iter().step_by(step).copied().collect();
    kept.extend(curve.last().filter(|last| kept.last() != Some(last)));
    kept
}
