//! Section forces against the balance of free bodies and closed forms.

mod extremes;
mod motion;
mod statics;

use crate::common;

use common::rows::Rows;
use common::*;
use percuss::*;

/// A steel-like cross section so stiff that its deflections do not count.
fn stiff(b: &mut ModelBuilder) -> (MaterialId, SectionId) {
    (b.material(Material::new("m", 1e15, 1e3)), b.section(Section::rectangle("s", 0.1, 0.1)))
}

fn line_load(beam: BeamId, force: [f64; 2]) -> LoadKind {
    let stretch = [Along::Fraction(0.0), Along::Fraction(1.0)];
    LoadKind::Distributed { beam, stretch, force: [force; 2], follower: false }
}

fn point_load(at: PointRef, force: [f64; 2], moment: f64) -> LoadKind {
    LoadKind::Point { at, force, moment, follower: false }
}

fn hold(b: &mut ModelBuilder, at: PointRef, kind: SupportKind) {
    let name = at.label.clone();
    b.support(Support::new(name, at, kind));
}

fn reaction<'a>(found: &'a Equilibrium, name: &str) -> &'a [f64; 3] {
    &found.reactions.iter().find(|(n, _)| n == name).unwrap().1
}

/// Round-off of forces from an equilibrium of this size.
fn close(a: f64, b: f64, size: f64) -> bool {
    (a - b).abs() <= 1e-9 * size
}

/// Every row by channel.
#[derive(Default)]
struct Columns {
    names: Vec<String>,
    rows: Vec<Vec<f64>>,
}

impl Columns {
    fn of(&self, name: &str) -> Vec<f64> {
        let k = self.names.iter().position(|n| n == name).unwrap();
        self.rows.iter().map(|row| row[k]).collect()
    }
}

impl Recorder for Columns {
    fn begin(&mut self, channels: &[Channel]) -> Result<(), RecorderError> {
        self.names = channels.iter().map(|c| c.name.clone()).collect();
        Ok(())
    }
    fn row(&mut self, values: &[f64]) -> Result<(), RecorderError> {
        self.rows.push(values.to_vec());
        Ok(())
    }
}
