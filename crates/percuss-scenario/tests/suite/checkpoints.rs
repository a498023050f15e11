//! A run that is stopped time and again and goes on from checkpoints ends in the bits of one that was never stopped.

use std::path::{Path, PathBuf};

use percuss::{
    Channel, Checkpoint, Flow, Frame, Model, Recorder, RecorderError, ResumeError, RunSummary,
    Settings, Simulation, Termination,
};
use percuss_scenario::{apply_overrides, read};

/// Stops of a run, each with a checkpoint before it.
const STOPS: usize = 25;
/// Longer runs are shortened to so many steps.
const MOST_STEPS: usize = 1500;

/// Rows and frames as bits, and the checkpoint taken before step `stop`.
struct Bits {
    rows: Vec<Vec<u64>>,
    frames: Vec<Vec<u64>>,
    /// Rows and frames that were there when the checkpoint was taken.
    kept: (usize, usize),
    /// Number of the next step.
    step: usize,
    stop: usize,
    /// Steps that are still made after the checkpoint, and lost.
    beyond: usize,
    checkpoint: Option<Vec<u8>>,
}

impl Bits {
    fn until(stop: usize, beyond: usize) -> Self {
        let (rows, frames) = (Vec::new(), Vec::new());
        Self { rows, frames, kept: (0, 0), step: 0, stop, beyond, checkpoint: None }
    }

    /// Goes on where the checkpoint was taken: what came later is lost.
    fn goes_on(&mut self, stop: usize) {
        self.rows.truncate(self.kept.0);
        self.frames.truncate(self.kept.1);
        (self.stop, self.checkpoint) = (stop, None);
    }
}

impl Recorder for Bits {
    fn begin(&mut self, _: &[Channel]) -> Result<(), RecorderError> {
        Ok(())
    }

    fn row(&mut self, values: &[f64]) -> Result<(), RecorderError> {
        self.rows.push(values.iter().map(|x| x.to_bits()).collect());
        Ok(())
    }

    fn wants_frame(&mut self, _: f64, _: f64, _: f64) -> bool {
        true
    }

    fn frame(&mut self, frame: &Frame<'_>) {
        let nodes = frame.displacement.iter().chain(frame.velocity).flatten();
        let sections = frame.section_forces.iter().flatten().flatten();
        let contacts = frame.contact_forces.iter().flat_map(|c| c.position.iter().chain(&c.force));
        let all = nodes.chain(sections).chain(contacts).chain(frame.load_factors);
        self.frames.push(all.map(|x| x.to_bits()).collect());
    }

    fn wants_checkpoint(&mut self, _: bool) -> bool {
        self.step += 1;
        self.step - 1 == self.stop
    }

    fn checkpoint(&mut self, checkpoint: &Checkpoint) -> Result<(), RecorderError> {
        assert_eq!((checkpoint.step(), checkpoint.rows()), (self.stop, self.rows.len()));
        self.kept = (self.rows.len(), self.frames.len());
        self.checkpoint = Some(postcard::to_allocvec(checkpoint)?);
        Ok(())
    }

    fn progress(&mut self, _: f64) -> Flow {
        if self.step > self.stop.saturating_add(self.beyond) { Flow::Stop } else { Flow::Continue }
    }
}

fn read_back(bytes: &[u8]) -> Checkpoint {
    postcard::from_bytes(bytes).unwrap()
}

/// Runs in pieces; each is stopped some steps after its checkpoint.
fn in_pieces(model: &Model, settings: &Settings, stops: &[usize]) -> (Bits, RunSummary) {
    let mut bits = Bits::until(stops[0], 3);
    let mut simulation = Simulation::new(model, settings).unwrap();
    for next in stops[1..].iter().chain([&usize::MAX]) {
        let summary = simulation.run(&mut bits);
        let Some(bytes) = bits.checkpoint.take() else { return (bits, summary) };
        let checkpoint = read_back(&bytes);
        bits.step = checkpoint.step();
        bits.goes_on(*next);
        simulation = Simulation::resume(model, settings, checkpoint).unwrap();
    }
    bits.beyond = 0;
    let summary = simulation.run(&mut bits);
    (bits, summary)
}

fn compare(path: &Path, changes: &[&str]) {
    let changes: Vec<String> = changes.iter().map(|c| (*c).to_owned()).collect();
    let name = path.display().to_string();
    let text = std::fs::read_to_string(path).unwrap();
    let text = apply_overrides(&text, &name, &changes).unwrap_or_else(|e| panic!("{e}"));
    let compiled = read(&text, &name).and_then(|s| s.compile()).unwrap_or_else(|e| panic!("{e}"));
    let (model, mut settings) = (&compiled.model, compiled.settings);
    settings.end = settings.end.min(MOST_STEPS as f64 * settings.step);
    let mut whole = Bits::until(usize::MAX, 0);
    let expected = Simulation::new(model, &settings).unwrap().run(&mut whole);
    assert!(!matches!(expected.termination, Termination::Interrupted { .. }), "{name}");
    // Unevenly, so that stops fall on all kinds of steps.
    let last = expected.steps.max(2) - 1;
    let mut stops: Vec<usize> = (1..=STOPS).map(|k| (k * k * last) / (STOPS * STOPS)).collect();
    stops.dedup();
    let (pieces, found) = in_pieces(model, &settings, &stops);
    let row = whole.rows.iter().zip(&pieces.rows).position(|(a, b)| a != b);
    assert_eq!(row, None, "{name} {changes:?}: rows differ from this one on");
    let frame = whole.frames.iter().zip(&pieces.frames).position(|(a, b)| a != b);
    assert_eq!(frame, None, "{name} {changes:?}: frames differ from this one on");
    assert_eq!(
        (whole.rows.len(), whole.frames.len()),
        (pieces.rows.len(), pieces.frames.len()),
        "{name}"
    );
    // As text, in which every float is exact and NaN equals itself.
    assert_eq!(format!("{found:?}"), format!("{expected:?}"), "{name} {changes:?}");
}

fn scenarios() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios")
}

fn compare_all(folder: &Path) {
    let mut count = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|e| e == "toml") {
            compare(&path, &[]);
            count += 1;
        }
    }
    assert!(count > 9, "{count}");
}

#[test]
fn every_scenario_goes_on_from_checkpoints_as_if_it_had_not_stopped() {
    compare_all(&scenarios());
}

#[test]
fn so_does_every_run_of_the_paper() {
    compare_all(&scenarios().join("paper"));
}

#[test]
fn so_do_all_schemes_rows_now_and_then_and_a_start_in_equilibrium() {
    let (beams, frame) =
        (scenarios().join("crossing-beams.toml"), scenarios().join("portal-frame.toml"));
    for scheme in ["strain-rate", "midpoint", "newmark", "generalized-alpha"] {
        compare(&beams, &[&format!("integrator.scheme=\"{scheme}\""), "record.every=7"]);
    }
    compare(&frame, &["time.start=\"static\"", "record.every=13"]);
    let chain = scenarios().join("disc-chain.toml");
    compare(&chain, &["time.impacts=\"time-stepping\""]);
    compare(&chain, &["time.multiple_impacts=\"sequential\"", "record.every=10"]);
    let violent = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/violent");
    compare(&violent.join("knotted.toml"), &[]);
}

#[test]
fn so_does_a_shear_flexible_beam_that_yields() {
    let beam = scenarios().join("yielding-beam.toml");
    compare(&beam, &["beam.girder.theory=\"shear\"", "material.steel.poisson=0.3"]);
}

#[test]
fn a_run_goes_on_beyond_the_end_it_was_given_first() {
    let path = scenarios().join("rattling-tube.toml");
    let text = std::fs::read_to_string(&path).unwrap();
    let compiled = read(&text, "tube.toml").unwrap().compile().unwrap();
    let (model, settings) = (&compiled.model, compiled.settings);
    // The first end lies within a step, so that the last one is shorter.
    let (first, second) = (
        Settings { end: 200.4 * settings.step, ..settings },
        Settings { end: 500.0 * settings.step, ..settings },
    );
    let mut bits = Bits::until(200, 1);
    Simulation::new(model, &first).unwrap().run(&mut bits);
    let checkpoint = read_back(&bits.checkpoint.take().unwrap());
    bits.step = checkpoint.step();
    bits.goes_on(usize::MAX);
    bits.beyond = 0;
    let found = Simulation::resume(model, &second, checkpoint).unwrap().run(&mut bits);
    let mut whole = Bits::until(usize::MAX, 0);
    let expected = Simulation::new(model, &second).unwrap().run(&mut whole);
    assert!(whole.rows == bits.rows && whole.frames == bits.frames);
    assert_eq!(format!("{found:?}"), format!("{expected:?}"));
}

#[test]
fn a_checkpoint_of_another_model_is_refused() {
    let compiled = |name: &str| {
        let text = std::fs::read_to_string(scenarios().join(name)).unwrap();
        read(&text, name).unwrap().compile().unwrap()
    };
    let (tube, chain) = (compiled("rattling-tube.toml"), compiled("disc-chain.toml"));
    let mut bits = Bits::until(5, 0);
    Simulation::new(&tube.model, &tube.settings).unwrap().run(&mut bits);
    let bytes = bits.checkpoint.unwrap();
    let other = Simulation::resume(&chain.model, &chain.settings, read_back(&bytes));
    assert_eq!(other.unwrap_err(), ResumeError::Foreign);
    // Nor one of another scheme, or beyond the end.
    let mut settings = tube.settings;
    settings.scheme = percuss::Scheme::StrainRate;
    let other = Simulation::resume(&tube.model, &settings, read_back(&bytes));
    assert_eq!(other.unwrap_err(), ResumeError::Foreign);
    let early = Settings { end: 3.0 * tube.settings.step, ..tube.settings };
    let other = Simulation::resume(&tube.model, &early, read_back(&bytes));
    assert_eq!(other.unwrap_err(), ResumeError::Foreign);
}
