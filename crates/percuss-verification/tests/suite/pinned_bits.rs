//! Five runs give the same bits as before: a hash of every row and of the summary is pinned in `tests/pinned_bits.txt`, which also describes when a
//! pinned value may change.
//!
//! Bits depend on the architecture and on the functions of the system's C library (`sin`, `exp`, `pow` and the like, which Rust
//! calls there), which differ in their last bits from one version to another. Values are therefore pinned for a fingerprint of
//! these functions; without a value for the present ones, only runs in one process are compared. `PERCUSS_PIN_BITS=1` pins the present values.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::{env, fs, hint, thread};

use percuss::*;
use percuss_batch::{Detail, simulate_batch};
use percuss_scenario::{Compiled, apply_overrides, read};
use sha2::{Digest, Sha256};

/// A run: its name, its file in `scenarios/` and changes for which it takes a second or less.
struct Pinned {
    name: &'static str,
    file: &'static str,
    changes: &'static [&'static str],
}

const RUNS: [Pinned; 5] = [
    Pinned { name: "elastic-contact", file: "paper/elastic-clamped.toml", changes: &[] },
    Pinned { name: "rigid-impacts", file: "paper/rigid-clamped-e0.5.toml", changes: &[] },
    Pinned {
        name: "friction",
        file: "tapping-cantilever.toml",
        changes: &["contact.tap.friction=0.3", "record.every=1", "time.end=\"0.3 s\""],
    },
    Pinned { name: "frame", file: "portal-frame.toml", changes: &["time.end=\"0.1 s\""] },
    Pinned { name: "side-by-side", file: "paper/elastic-clamped.toml", changes: &[] },
];

/// Velocities of the runs in lanes \[m/s\]: more than a register has lanes.
const VELOCITIES: std::ops::Range<usize> = 10..21;

/// Adds the bits of numbers to the hash; all NaN are equal.
#[derive(Default)]
struct Bits(Sha256);

impl Bits {
    fn take(&mut self, values: impl IntoIterator<Item = f64>) {
        for value in values {
            let value = if value.is_nan() { f64::NAN } else { value };
            self.0.update(value.to_bits().to_le_bytes());
        }
    }

    fn summary(&mut self, summary: &RunSummary) {
        assert!(matches!(summary.termination, Termination::Completed), "{:?}", summary.termination);
        let (energy, momentum) = (&summary.energy, &summary.momentum);
        self.take([summary.steps as f64, energy.initial, energy.final_, energy.work_loads]);
        self.take([energy.work_supports, energy.loss_impacts, energy.loss_damping, energy.scale]);
        self.take([energy.residual_max, momentum.linear_scale, momentum.linear_residual_max]);
        self.take([momentum.angular_scale, momentum.angular_residual_max]);
        for projectile in &summary.projectiles {
            self.take(projectile.velocity_final);
            self.take([projectile.momentum_transferred, projectile.energy_given]);
        }
        for contact in &summary.contacts {
            match &contact.record {
                ContactRecord::Smooth { peak_force, .. } => {
                    self.take([peak_force.value, peak_force.time]);
                }
                ContactRecord::Nonsmooth { impacts, impulse_total, .. } => {
                    let impact = |i: &Impact| [i.time, i.impulse, i.tangential_impulse];
                    self.take(impacts.iter().flat_map(impact).chain([*impulse_total]));
                }
            }
            let interval = |i: &ContactInterval| [i.start, i.end, i.impulse, i.energy.lost];
            self.take(contact.record.intervals().iter().flat_map(interval));
        }
        for point in &summary.points {
            self.take(point.displacement_max.iter().flat_map(|peak| [peak.value, peak.time]));
        }
    }

    fn finish(self) -> String {
        self.0.finalize().iter().take(16).fold(String::new(), |mut out, byte| {
            let _ = write!(out, "{byte:02x}");
            out
        })
    }
}

impl Recorder for Bits {
    fn row(&mut self, values: &[f64]) -> Result<(), RecorderError> {
        self.take(values.iter().copied());
        Ok(())
    }
}

impl Pinned {
    fn compiled(&self, more: &[String]) -> Compiled {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios").join(self.file);
        let text = fs::read_to_string(&path).expect("a scenario of the repository");
        let changes: Vec<String> =
            self.changes.iter().map(|c| (*c).to_owned()).chain(more.iter().cloned()).collect();
        let text = apply_overrides(&text, self.file, &changes).unwrap_or_else(|e| panic!("{e}"));
        let compiled = read(&text, self.file).and_then(|scenario| scenario.compile());
        compiled.unwrap_or_else(|e| panic!("{e}"))
    }

    /// The run's hash.
    fn bits(&self) -> String {
        if self.name == "side-by-side" {
            return side_by_side(&self.velocities(), usize::MAX);
        }
        let Compiled { model, settings, .. } = self.compiled(&[]);
        let mut bits = Bits::default();
        let summary = simulate(&model, &settings, &mut bits).expect("valid settings");
        bits.summary(&summary);
        bits.finish()
    }

    /// The same run at many velocities.
    fn velocities(&self) -> Vec<Compiled> {
        let at = |v| self.compiled(&[format!("projectile.mass.velocity=[0, {v}]")]);
        VELOCITIES.map(at).collect()
    }
}

/// Hash of summaries of runs in vector registers, with the given number of runs at a time.
fn side_by_side(runs: &[Compiled], at_a_time: usize) -> String {
    let mut bits = Bits::default();
    for runs in runs.chunks(at_a_time.min(runs.len())) {
        let given: Vec<_> = runs.iter().map(|c| (&c.model, &c.settings)).collect();
        for summary in simulate_batch(&given, Detail::Motion) {
            bits.summary(&summary.expect("valid settings"));
        }
    }
    bits.finish()
}

/// Architecture, and hash of the values of the C library's functions that the solver calls, at arguments of all sizes.
fn machine() -> String {
    let functions: [fn(f64) -> f64; 17] = [
        f64::sin,
        f64::cos,
        f64::tan,
        f64::exp,
        f64::exp_m1,
        |x| f64::ln(x.abs()),
        |x| f64::ln_1p(x.abs()),
        |x| f64::log10(x.abs()),
        |x| f64::asin((1.0 + x.abs()).recip()),
        f64::sinh,
        f64::cosh,
        f64::cbrt,
        |x| f64::atan2(x, 0.7),
        |x| f64::hypot(x, 0.7),
        |x| f64::powf(x.abs(), 1.5),
        |x| f64::powf(1.0 + x.abs(), -0.3),
        |x| f64::powi(x, hint::black_box(5)),
    ];
    let mut bits = Bits::default();
    for function in functions {
        // From 1e-8 to 4e2, either sign.
        let argument = |k: i32| f64::from(1 - 2 * (k % 2)) * 1e-8 * 1.0123_f64.powi(k);
        bits.take((0..2000).map(|k| function(hint::black_box(argument(k)))));
    }
    format!("{}-{}", env::consts::ARCH, &bits.finish()[..12])
}

fn file() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/pinned_bits.txt")
}

/// Pinned hashes by machine and run, and the lines before them.
fn pinned(text: &str) -> (String, BTreeMap<(String, String), String>) {
    let (head, rows): (Vec<&str>, Vec<&str>) =
        text.lines().partition(|line| line.starts_with('#') || line.is_empty());
    let rows = rows.into_iter().map(|row| match row.split_whitespace().collect::<Vec<_>>()[..] {
        [machine, run, hash] => ((machine.to_owned(), run.to_owned()), hash.to_owned()),
        _ => panic!("{row:?} is no machine with run and hash"),
    });
    (head.join("\n"), rows.collect())
}

#[test]
fn five_runs_end_in_the_bits_that_are_pinned() {
    let found: BTreeMap<&str, String> = RUNS.iter().map(|run| (run.name, run.bits())).collect();
    let machine = machine();
    let text = fs::read_to_string(file()).expect("the file of pinned bits");
    let (head, mut known) = pinned(&text);
    if env::var_os("PERCUSS_PIN_BITS").is_some() {
        known.retain(|(of, _), _| *of != machine);
        for (run, hash) in &found {
            known.insert((machine.clone(), (*run).to_owned()), hash.clone());
        }
        let rows = known.iter().map(|((of, run), hash)| format!("{of} {run} {hash}\n"));
        let text = format!("{head}\n{}", rows.collect::<String>());
        fs::write(file(), text).expect("the file can be written");
        return;
    }
    if !known.keys().any(|(of, _)| *of == machine) {
        eprintln!(
            "no bits are pinned for the C library's functions at hand ({machine}): not compared"
        );
        return;
    }
    for (run, hash) in &found {
        let before = known.get(&(machine.clone(), (*run).to_owned()));
        let name =
            format!("{run} on {machine}, found and pinned; tests/pinned_bits.txt says what to do");
        assert_eq!(Some(hash), before, "{name}");
    }
}

#[test]
fn runs_have_the_same_bits_again_and_on_any_number_of_threads() {
    let once: Vec<String> = RUNS.iter().map(Pinned::bits).collect();
    for threads in [1, 2, 5] {
        let share = RUNS.len().div_ceil(threads);
        let again: Vec<String> = thread::scope(|scope| {
            let of = |runs: &'static [Pinned]| {
                scope.spawn(|| runs.iter().map(Pinned::bits).collect::<Vec<_>>())
            };
            let all: Vec<_> = RUNS.chunks(share).map(of).collect();
            all.into_iter().flat_map(|one| one.join().expect("no panic")).collect()
        });
        assert_eq!(again, once, "{threads} threads");
    }
    let runs = RUNS[4].velocities();
    for at_a_time in [1, 3, 8] {
        assert_eq!(side_by_side(&runs, at_a_time), once[4], "{at_a_time} at a time");
    }
}
