//! Checkpoints with changed bytes and a valid checksum.

use std::sync::OnceLock;

use percuss::{Checkpoint, Flow, Recorder, RecorderError, Simulation};
use percuss_scenario::{Compiled, read, templates};

/// Steps before the checkpoint, and after it.
const BEFORE: usize = 60;
const BEHIND: usize = 20;

/// Recorder that stores the checkpoint of one step and stops some steps later.
#[derive(Default)]
struct CheckpointRecorder {
    asked: usize,
    at: usize,
    steps: usize,
    /// The last stored checkpoint, shape (bytes) \[-\].
    kept: Vec<u8>,
}

impl Recorder for CheckpointRecorder {
    fn wants_checkpoint(&mut self, _: bool) -> bool {
        self.asked += 1;
        self.asked == self.at
    }

    fn checkpoint(&mut self, checkpoint: &Checkpoint) -> Result<(), RecorderError> {
        self.kept = postcard::to_allocvec(checkpoint)?;
        Ok(())
    }

    fn progress(&mut self, _: f64) -> Flow {
        self.steps += 1;
        if self.steps < self.at + BEHIND { Flow::Continue } else { Flow::Stop }
    }
}

/// Models of the templates that can be run, each with a checkpoint.
fn valid() -> &'static [(Compiled, Vec<u8>)] {
    static VALID: OnceLock<Vec<(Compiled, Vec<u8>)>> = OnceLock::new();
    VALID.get_or_init(|| {
        let each = templates().iter().filter_map(|template| {
            let compiled = read(template.text, template.name).ok()?.compile().ok()?;
            let simulation = Simulation::new(&compiled.model, &compiled.settings).ok()?;
            let mut recorder = CheckpointRecorder { at: BEFORE, ..CheckpointRecorder::default() };
            simulation.run(&mut recorder);
            (!recorder.kept.is_empty()).then_some((compiled, recorder.kept))
        });
        each.collect()
    })
}

/// The first byte selects a checkpoint; each following group of three bytes is a position in it and the new byte there.
pub fn checkpoint(data: &[u8]) {
    let Some((&which, changes)) = data.split_first() else { return };
    let all = valid();
    let (compiled, bytes) = &all[usize::from(which) % all.len()];
    let mut bytes = bytes.clone();
    for change in changes.chunks_exact(3).take(32) {
        let place = usize::from(u16::from_le_bytes([change[0], change[1]]));
        let count = bytes.len();
        // Half of the positions count from the end, where lists are.
        let at = if place % 2 == 0 { place % count } else { count - 1 - place % count };
        bytes[at] = change[2];
    }
    let Ok(checkpoint) = postcard::from_bytes(&bytes) else { return };
    if let Ok(run) = Simulation::resume(&compiled.model, &compiled.settings, checkpoint) {
        let _ = run.run(&mut CheckpointRecorder::default());
    }
}
