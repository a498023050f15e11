//! The program that makes MP4.

use std::path::PathBuf;

use crate::error::Error;

/// Where ffmpeg is, if it is on the path.
pub fn ffmpeg() -> Option<PathBuf> {
    let name = format!("ffmpeg{}", std::env::consts::EXE_SUFFIX);
    let path = std::env::var_os("PATH")?;
    std::env::split_paths(&path).map(|dir| dir.join(&name)).find(|file| file.is_file())
}

/// What is to be said where ffmpeg is wanted and not there.
pub fn no_ffmpeg() -> Error {
    Error::no_ffmpeg()
}
