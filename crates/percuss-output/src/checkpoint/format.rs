//! The file of a checkpoint: a line that tells what it is, a line of JSON that tells what of, the numbers (postcard), and a SHA-256
//! of all before.

use std::fs;
use std::path::Path;

use percuss::Checkpoint;
use percuss_codes::FileCode;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use sha2::{Digest, Sha256};

use super::fingerprint;
use crate::error::Error;
use crate::fields::{FrameStore, KeptFrames};
use crate::files;

/// First line; the number is that of the format.
const MAGIC: &str = "percuss checkpoint 1\n";
/// What every format begins with.
const ANY: &str = "percuss checkpoint ";
/// Length of the checksum at the end.
const CHECKSUM: usize = 32;

/// Where the rows of a checkpoint stand.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct RowsMark {
    /// Number of columns.
    pub columns: usize,
    /// Length of the file of rows, and the SHA-256 of that part of it; none where rows are those of the history, shape (32) \[bytes, -\].
    pub bytes: Option<(u64, [u8; CHECKSUM])>,
}

/// A checkpoint with what the outputs of a run need to go on.
#[derive(Debug)]
pub struct Saved {
    /// State of the run.
    pub checkpoint: Checkpoint,
    /// Frames kept so far.
    pub frames: KeptFrames,
    /// Seconds that the run took up to the checkpoint.
    pub seconds: f64,
    pub(super) rows: RowsMark,
}

#[derive(Serialize)]
struct Written<'a> {
    checkpoint: &'a Checkpoint,
    frames: &'a KeptFrames,
    rows: &'a RowsMark,
}

#[derive(Deserialize)]
struct Read {
    checkpoint: Checkpoint,
    frames: KeptFrames,
    rows: RowsMark,
}

/// Writes a checkpoint of the run of `scenario`, the text of the scenario but for its end.
pub(super) fn write(
    path: &Path,
    scenario: &str,
    (checkpoint, frames): (&Checkpoint, &FrameStore),
    seconds: f64,
    rows: &RowsMark,
) -> Result<(), Error> {
    let head = json!({
        "version": env!("CARGO_PKG_VERSION"),
        "build": percuss::BUILD,
        "scenario": fingerprint::of(scenario),
        "step": checkpoint.step(),
        "time_s": checkpoint.time(),
        "rows": checkpoint.rows(),
        "seconds": seconds,
    });
    let mut bytes = format!("{MAGIC}{head}\n").into_bytes();
    let written = Written { checkpoint, frames: frames.kept(), rows };
    bytes = postcard::to_extend(&written, bytes)
        .map_err(|e| Error::io(path, "write", format!("numbers cannot be packed: {e}")))?;
    bytes.extend(Sha256::digest(&bytes));
    files::write_durably(path, &bytes)
}

/// Reads the checkpoint of a run of `scenario`.
pub(super) fn read(path: &Path, scenario: &str) -> Result<Saved, Error> {
    let bytes = fs::read(path).map_err(|e| Error::io(path, "read", e))?;
    let (head, numbers) = parts(path, &bytes)?;
    if head["build"] != percuss::BUILD {
        let build = head["build"].as_str().unwrap_or("unknown");
        let reason = format!(
            "written by another build ({build}, this is {}); results would not be bitwise identical. Use that build, or run from the start",
            percuss::BUILD
        );
        return Err(Error::of(FileCode::OtherCheckpoint, path, reason));
    }
    if let Some(reason) = fingerprint::difference(&head["scenario"], scenario) {
        return Err(Error::of(FileCode::OtherCheckpoint, path, reason));
    }
    let Read { checkpoint, frames, rows } =
        postcard::from_bytes(numbers).map_err(|_| damaged(path))?;
    let seconds = head["seconds"].as_f64().unwrap_or(0.0);
    Ok(Saved { checkpoint, frames, seconds, rows })
}

/// Time reached in a checkpoint \[s\], of whatever scenario; `None` where there is none.
pub(super) fn time(path: &Path) -> Option<f64> {
    let bytes = fs::read(path).ok()?;
    parts(path, &bytes).ok()?.0["time_s"].as_f64()
}

/// The line of JSON and the numbers.
fn parts<'a>(path: &Path, bytes: &'a [u8]) -> Result<(Value, &'a [u8]), Error> {
    if !bytes.starts_with(ANY.as_bytes()) {
        return Err(Error::of(FileCode::Checkpoint, path, "is not a checkpoint"));
    }
    if !bytes.starts_with(MAGIC.as_bytes()) {
        let reason =
            "is a checkpoint in a format of another version of Percuss; go on with that one";
        return Err(Error::of(FileCode::OtherCheckpoint, path, reason));
    }
    let end = bytes.len().checked_sub(CHECKSUM).ok_or_else(|| damaged(path))?;
    let (body, checksum) = bytes.split_at(end);
    if Sha256::digest(body).as_slice() != checksum {
        return Err(damaged(path));
    }
    let rest = &body[MAGIC.len()..];
    let line = rest.iter().position(|byte| *byte == b'\n').ok_or_else(|| damaged(path))?;
    let head = serde_json::from_slice(&rest[..line]).map_err(|_| damaged(path))?;
    Ok((head, &rest[line + 1..]))
}

pub(super) fn damaged(path: &Path) -> Error {
    Error::of(
        FileCode::Checkpoint,
        path,
        "the checkpoint is damaged: its checksum does not fit; run from the beginning",
    )
}
