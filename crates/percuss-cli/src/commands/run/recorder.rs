//! What receives the rows of a run.

use percuss::{Channel, Flow, Frame, Recorder, RecorderError};
use percuss_output::HistoryWriter;
use percuss_output::fields::FrameStore;

use crate::progress::Progress;

/// Total energy over time, kept in memory.
#[derive(Clone, Debug, Default)]
pub struct EnergySeries {
    /// Times \[s\].
    pub time: Vec<f64>,
    /// Total energies \[J\].
    pub energy: Vec<f64>,
    column: usize,
}

impl EnergySeries {
    fn begin(&mut self, channels: &[Channel]) -> Result<(), RecorderError> {
        let column = channels.iter().position(|c| c.name == "energy.total");
        self.column = column.ok_or("the history has no total energy")?;
        Ok(())
    }

    fn row(&mut self, values: &[f64]) {
        self.time.push(values[0]);
        self.energy.push(values[self.column]);
    }
}

/// Rows of the run itself: to the history, energies kept if they are to be compared.
#[derive(Debug)]
pub struct RunRecorder {
    history: HistoryWriter,
    energy: Option<EnergySeries>,
    frames: FrameStore,
    progress: Progress,
}

impl RunRecorder {
    /// A recorder with nothing in it.
    pub fn new(
        history: HistoryWriter,
        energy: Option<EnergySeries>,
        frames: FrameStore,
        progress: Progress,
    ) -> Self {
        Self { history, energy, frames, progress }
    }

    /// The history, to be finished, the energies kept and the frames.
    pub fn into_parts(self) -> (HistoryWriter, Option<EnergySeries>, FrameStore) {
        (self.history, self.energy, self.frames)
    }
}

impl Recorder for RunRecorder {
    fn begin(&mut self, channels: &[Channel]) -> Result<(), RecorderError> {
        if let Some(energy) = &mut self.energy {
            energy.begin(channels)?;
        }
        self.history.begin(channels)
    }

    fn row(&mut self, values: &[f64]) -> Result<(), RecorderError> {
        if let Some(energy) = &mut self.energy {
            energy.row(values);
        }
        self.history.row(values)
    }

    fn wants_frame(&mut self, time: f64, contact: f64, impulsive: bool) -> bool {
        self.frames.wants(time, contact, impulsive)
    }

    fn frame(&mut self, frame: &Frame<'_>) {
        self.frames.take(frame);
    }

    fn progress(&mut self, _time: f64) -> Flow {
        self.progress.step()
    }
}

/// Rows of a run that is only compared: energies, nothing on disk.
#[derive(Debug)]
pub struct EnergyRecorder {
    /// The energies.
    pub energy: EnergySeries,
    /// Where the run is.
    pub progress: Progress,
}

impl Recorder for EnergyRecorder {
    fn begin(&mut self, channels: &[Channel]) -> Result<(), RecorderError> {
        self.energy.begin(channels)
    }

    fn row(&mut self, values: &[f64]) -> Result<(), RecorderError> {
        self.energy.row(values);
        Ok(())
    }

    fn progress(&mut self, _time: f64) -> Flow {
        self.progress.step()
    }
}
