//! The program that writes MP4.

use std::path::PathBuf;

use crate::error::Error;

/// Path of ffmpeg, if it is on the search path.
pub fn ffmpeg() -> Option<PathBuf> {
    let name = format!("ffmpeg{}", std::env::consts::EXE_SUFFIX);
    let path = std::env::var_os("PATH")?;
    std::env::split_paths(&path).map(|dir| dir.join(&name)).find(|file| file.is_file())
}

/// Message for a missing ffmpeg.
pub fn no_ffmpeg() -> Error {
    Error::no_ffmpeg()
}
