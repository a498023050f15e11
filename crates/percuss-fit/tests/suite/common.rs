//! A drop test as a scenario, and records of it with noise.

use std::fmt::Write;
use std::path::Path;

use percuss::MemoryRecorder;
use percuss_fit::{Fit, FitError, Problem, Supplied};
use percuss_scenario::{FileAccess, FitFile};

/// A hammer that falls on a clamped bar, on a coarse mesh.
pub const SCENARIO: &str = r#"
[material.aluminium]
young = "70 GPa"
density = "2700 kg/m^3"
retardation = "4 us"
[section.bar]
shape = "rectangle"
width = "40 mm"
depth = "20 mm"
[beam.bar]
points = [[0, 0], ["0.8 m", 0]]
elements = 4
material = "aluminium"
section = "bar"
[support.left]
at = "bar.start"
kind = "clamp"
[support.right]
at = "bar.end"
kind = "clamp"
[projectile.hammer]
kind = "elastic"
mass = "2 kg"
stiffness = "2 MN/m"
dissipation = "0.2 s/m"
velocity = [0, "-3 m/s"]
strikes = "bar.mid"
[time]
end = "8 ms"
step = "80 us"
"#;

/// The same with other starting values in its file.
pub const FIT: &str = r#"
base = "drop.toml"
[fit]
[parameter.stiffness]
path = "projectile.hammer.stiffness"
start = "1.5 MN/m"
bounds = ["0.5 MN/m", "8 MN/m"]
spacing = "log"
[parameter.dissipation]
path = "projectile.hammer.dissipation"
start = "0.1 s/m"
bounds = [0, "1 s/m"]
[test.drop]
data = "drop.csv"
time = "t"
align = "fit"
[test.drop.channel.F]
column = "contact.hammer.force"
sigma = "30 N"
[test.drop.channel.u]
column = "point.bar.mid.displacement_2"
sigma = "20 um"
"#;

/// Standard deviations of force and displacement in records, those that the file says.
pub const SIGMA: [f64; 2] = [30.0, 20e-6];
/// Time of records at which their run starts.
pub const OFFSET: f64 = 0.4e-3;

/// Normal random numbers: splitmix64 (Steele et al. 2014) and the transform of Box and Muller, so that other programs can make the same
/// ones.
pub struct Noise(u64);

impl Noise {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    fn share(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^= z >> 31;
        ((z >> 11) as f64 + 0.5) / (1_u64 << 53) as f64
    }

    pub fn next(&mut self) -> f64 {
        let (u, v) = (self.share(), self.share());
        (-2.0 * u.ln()).sqrt() * (std::f64::consts::TAU * v).cos()
    }
}

/// Columns of a run of a scenario.
pub fn history(scenario: &str) -> MemoryRecorder {
    let scenario = percuss_scenario::read(scenario, "drop.toml").unwrap_or_else(|e| panic!("{e}"));
    let compiled = scenario.compile().unwrap_or_else(|e| panic!("{e}"));
    let mut recorder = MemoryRecorder::default();
    percuss::simulate(&compiled.model, &compiled.settings, &mut recorder).expect("a run");
    recorder
}

/// A record of a run, linear between its rows, with noise of so many standard deviations; times in ms, forces in kN, displacements in mm.
pub fn record(scenario: &str, seed: u64, deviations: f64) -> String {
    let run = history(scenario);
    let column = |name: &str| run.column(name).expect("a column");
    let (time, force) = (column("time"), column("contact.hammer.force"));
    let place = column("point.bar.mid.displacement_2");
    let at = |values: &[f64], t: f64| {
        let next = time.partition_point(|row| *row <= t).clamp(1, time.len() - 1);
        let share = ((t - time[next - 1]) / (time[next] - time[next - 1])).clamp(0.0, 1.0);
        values[next - 1] + share * (values[next] - values[next - 1])
    };
    let mut noise = Noise::new(seed);
    let mut text = "t [ms],F [kN],u [mm]\n".to_owned();
    for k in 0..110 {
        let t = 75e-6 * f64::from(k);
        let f = at(&force, t - OFFSET) + deviations * SIGMA[0] * noise.next();
        let u = at(&place, t - OFFSET) + deviations * SIGMA[1] * noise.next();
        writeln!(text, "{:?},{:?},{:?}", 1e3 * t, 1e-3 * f, 1e3 * u).expect("a String");
    }
    text
}

/// Files of a fit in a folder of their own.
pub fn desk(record: &str) -> tempfile::TempDir {
    let desk = tempfile::tempdir().expect("a folder");
    put(desk.path(), "drop.toml", SCENARIO);
    put(desk.path(), "drop.csv", record);
    desk
}

pub fn put(folder: &Path, name: &str, text: &str) {
    std::fs::write(folder.join(name), text).expect("a file");
}

/// The fit of a text whose files lie in a folder.
pub fn fitted(folder: &Path, text: &str) -> Result<Fit, FitError> {
    let problem = problem(folder, text)?;
    let minima = problem.minima(&|| true)?;
    problem.diagnose(minima, &|| true)
}

pub fn problem(folder: &Path, text: &str) -> Result<Problem, FitError> {
    let name = folder.join("fit.toml").display().to_string();
    let file = FitFile::read_with(text, &name, FileAccess::OwnFolder)?;
    Problem::new(&file, &Supplied::default(), 0, &|| true)
}

/// Value of a parameter, and whether its interval contains a number.
pub fn parameter<'f>(fit: &'f Fit, name: &str) -> &'f percuss_fit::FittedParameter {
    fit.parameters.iter().find(|one| one.name == name).expect("a parameter")
}
