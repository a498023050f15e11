//! The directory of checkpoints beside that of the results.

use std::fs;
use std::path::{Path, PathBuf};

use percuss::Checkpoint;
use percuss_codes::FileCode;

use super::KEPT;
use super::format::{self, RowsMark, Saved};
use super::rows::{Rows, RowsFile};
use crate::error::Error;
use crate::fields::FrameStore;
use crate::files;
use crate::report::quantity::number;

const STATE: &str = "state";
const ROWS: &str = "rows";

/// Checkpoints of one run.
///
/// The lock on the directory of results keeps other processes out of this one too.
#[derive(Debug)]
pub struct CheckpointFolder {
    path: PathBuf,
    /// The scenario without its end.
    scenario: String,
    rows: Option<RowsFile>,
}

impl CheckpointFolder {
    /// The one beside the directory of results `target`, of a run of `scenario`, the text of it but for its end; nothing is
    /// touched yet.
    pub fn beside(target: &Path, scenario: String) -> Self {
        let mut name = target.file_name().unwrap_or_default().to_owned();
        name.push(".checkpoint");
        Self { path: target.with_file_name(name), scenario, rows: None }
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Time reached in the checkpoint that is there \[s\], if one is.
    pub fn time(&self) -> Option<f64> {
        format::time(&self.path.join(STATE))
    }

    /// Makes it, for a run from the beginning.
    ///
    /// # Errors
    /// If it holds a checkpoint already, or what is no checkpoint's; if it cannot be made.
    pub fn begin(&mut self) -> Result<(), Error> {
        self.refuse_what_is_not_ours()?;
        if let Some(time) = self.time() {
            let reason = format!(
                "contains a checkpoint at t = {} s: continue with --resume, or remove it",
                number(time)
            );
            return Err(Error::refused(&self.path, reason));
        }
        fs::create_dir_all(&self.path).map_err(|e| Error::io(&self.path, "create", e))?;
        self.rows = Some(RowsFile::create(&self.path.join(ROWS))?);
        Ok(())
    }

    /// The checkpoint that is there, and the rows up to it.
    ///
    /// # Errors
    /// If there is none, or it is damaged, of another scenario or of another build.
    pub fn resume(&mut self) -> Result<(Saved, Rows), Error> {
        let state = self.path.join(STATE);
        if !state.is_file() {
            let reason = "no checkpoint: a run writes one with --checkpoint, and removes it when it is complete";
            return Err(Error::of(FileCode::NoCheckpoint, &self.path, reason));
        }
        self.refuse_what_is_not_ours()?;
        let saved = format::read(&state, &self.scenario)?;
        let rows = self.path.join(ROWS);
        self.rows = Some(RowsFile::go_on(&rows, &saved.rows)?);
        let rows = Rows::of_file(&rows, &saved.rows);
        Ok((saved, rows))
    }

    /// Takes a row that was recorded.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn row(&mut self, values: &[f64]) -> Result<(), Error> {
        self.rows.as_mut().map_or(Ok(()), |rows| rows.append(values))
    }

    /// Writes a checkpoint in place of the one before, once everything it needs is on the disk.
    ///
    /// # Errors
    /// If it cannot be written; the one before then stays.
    pub fn save(
        &mut self,
        (checkpoint, frames): (&Checkpoint, &FrameStore),
        seconds: f64,
    ) -> Result<(), Error> {
        let Some(rows) = &mut self.rows else { return Ok(()) };
        let mark = rows.settle()?;
        let state = self.path.join(STATE);
        format::write(&state, &self.scenario, (checkpoint, frames), seconds, &mark)
    }

    /// Keeps a checkpoint among the results in `dir`, whose history has the rows.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn keep(
        &self,
        dir: &Path,
        (checkpoint, frames): (&Checkpoint, &FrameStore),
        seconds: f64,
    ) -> Result<(), Error> {
        let mark = RowsMark { columns: 0, bytes: None };
        format::write(&dir.join(KEPT), &self.scenario, (checkpoint, frames), seconds, &mark)
    }

    /// The checkpoint kept among the results in `dir`, and the rows up to it.
    ///
    /// # Errors
    /// If there is none, or it is damaged, of another scenario or of another build.
    pub fn kept(dir: &Path, scenario: &str) -> Result<(Saved, Rows), Error> {
        let path = dir.join(KEPT);
        if !path.is_file() {
            let reason = "contains no checkpoint: only a complete run with --checkpoint has one; run it from the start with a later \
                          time.end";
            return Err(Error::of(FileCode::NoCheckpoint, dir, reason));
        }
        let saved = format::read(&path, scenario)?;
        Rows::has_history(dir)?;
        let rows = Rows::of_history(dir, saved.checkpoint.rows());
        Ok((saved, rows))
    }

    /// Removes it: the run is complete.
    pub fn remove(mut self) {
        self.rows = None;
        // Without its rows a state is worth nothing.
        let state = fs::remove_file(self.path.join(STATE));
        if state.is_ok() || !self.path.join(STATE).exists() {
            let _ = fs::remove_file(self.path.join(ROWS));
        }
        // With anything else in it, it stays.
        let _ = fs::remove_dir(&self.path);
    }

    fn refuse_what_is_not_ours(&self) -> Result<(), Error> {
        // Its name can be foreseen by whoever writes in the same folder.
        if fs::symlink_metadata(&self.path).is_ok_and(|found| found.is_symlink()) {
            let reason = "is the checkpoint directory but a link, which is not followed";
            return Err(Error::refused(&self.path, reason));
        }
        let Ok(entries) = fs::read_dir(&self.path) else {
            return match fs::symlink_metadata(&self.path) {
                Ok(_) => Err(Error::refused(&self.path, "is the checkpoint directory but a file")),
                Err(_) => Ok(()),
            };
        };
        let temporary = files::partial(Path::new(STATE));
        for entry in entries {
            let name = entry.map_err(|e| Error::io(&self.path, "list", e))?.file_name();
            if ![STATE.as_ref(), ROWS.as_ref(), temporary.as_os_str()].contains(&name.as_os_str()) {
                let name = name.to_string_lossy();
                let reason =
                    format!("is the checkpoint directory but contains {name}; move this file");
                return Err(Error::refused(&self.path, reason));
            }
        }
        Ok(())
    }
}
