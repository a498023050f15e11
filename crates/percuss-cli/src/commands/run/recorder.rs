//! What receives the rows of a run.

use percuss::{Channel, Checkpoint, Flow, Frame, Recorder, RecorderError, RunStatus};
use percuss_output::checkpoint::Rows;
use percuss_output::fields::FrameStore;
use percuss_output::{HistoryWriter, TimeEstimate};

use super::checkpoints::Checkpoints;
use crate::progress::Progress;

/// Total energy over time, kept in memory.
#[derive(Clone, Debug, Default)]
pub struct EnergySeries {
    /// Times, shape (rows) \[s\].
    pub time: Vec<f64>,
    /// Total energies, shape (rows) \[J\].
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
    /// Says how a long run goes; none where nothing is to be said.
    estimate: Option<TimeEstimate>,
    checkpoints: Option<Checkpoints>,
    /// Rows up to the checkpoint that the run goes on from.
    earlier: Option<Rows>,
}

impl RunRecorder {
    /// A recorder with nothing in it.
    pub fn new(
        history: HistoryWriter,
        energy: Option<EnergySeries>,
        frames: FrameStore,
        progress: Progress,
    ) -> Self {
        let (estimate, checkpoints, earlier) = (None, None, None);
        Self { history, energy, frames, progress, estimate, checkpoints, earlier }
    }

    /// Says how a long run goes, if that is wanted.
    pub fn estimating_time(mut self, wanted: bool) -> Self {
        self.estimate = wanted.then(TimeEstimate::default);
        self
    }

    /// Takes checkpoints too; `earlier` are the rows up to the one that the run goes on from.
    pub fn with_checkpoints(mut self, own: Option<Checkpoints>, earlier: Option<Rows>) -> Self {
        (self.checkpoints, self.earlier) = (own, earlier);
        self
    }

    /// The history, to be finished, the energies kept, the frames and the checkpoints.
    pub fn into_parts(
        self,
    ) -> (HistoryWriter, Option<EnergySeries>, FrameStore, Option<Checkpoints>) {
        (self.history, self.energy, self.frames, self.checkpoints)
    }

    fn note(&mut self, values: &[f64]) -> Result<(), RecorderError> {
        if let Some(energy) = &mut self.energy {
            energy.row(values);
        }
        self.history.row(values)
    }
}

impl Recorder for RunRecorder {
    fn begin(&mut self, channels: &[Channel]) -> Result<(), RecorderError> {
        if let Some(energy) = &mut self.energy {
            energy.begin(channels)?;
        }
        self.history.begin(channels)?;
        let Some(rows) = self.earlier.take() else { return Ok(()) };
        // Those of a history are not among the rows of the checkpoints to come.
        let new = rows.are_of_history();
        rows.replay(channels.len(), &mut |values| match new {
            true => self.row(values),
            false => self.note(values),
        })
    }

    fn row(&mut self, values: &[f64]) -> Result<(), RecorderError> {
        if let Some(checkpoints) = &mut self.checkpoints {
            checkpoints.row(values)?;
        }
        self.note(values)
    }

    fn wants_status(&mut self) -> bool {
        self.estimate.as_ref().is_some_and(TimeEstimate::wants)
    }

    fn status(&mut self, status: &RunStatus<'_>) {
        if let Some(text) = self.estimate.as_mut().and_then(|watch| watch.look(status)) {
            self.progress.tell(&text);
        }
    }

    fn wants_checkpoint(&mut self, last: bool) -> bool {
        self.checkpoints.as_mut().is_some_and(|c| c.wanted(last))
    }

    fn checkpoint(&mut self, checkpoint: &Checkpoint) -> Result<(), RecorderError> {
        match &mut self.checkpoints {
            Some(checkpoints) => Ok(checkpoints.take(checkpoint, &self.frames)?),
            None => Ok(()),
        }
    }

    fn wants_frame(&mut self, time: f64, force: f64, impulse: f64) -> bool {
        self.frames.wants(time, force, impulse)
    }

    fn frame(&mut self, frame: &Frame<'_>) {
        self.frames.take(frame);
    }

    fn progress(&mut self, time: f64) -> Flow {
        self.progress.step(time)
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

    fn progress(&mut self, time: f64) -> Flow {
        self.progress.step(time)
    }
}
