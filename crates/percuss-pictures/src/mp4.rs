//! MP4 by ffmpeg, which receives raw frames.

use std::io::{Read, Write};
use std::path::Path;
use std::process::{Child, ChildStderr, Command, Stdio};
use std::thread::JoinHandle;

use percuss_output::Unfinished;

use crate::error::Error;
use crate::mark::MARK;
use crate::pixels::Pixels;

/// A film that is written frame by frame.
pub(crate) struct Mp4 {
    child: Child,
    complaints: Option<JoinHandle<String>>,
}

impl Mp4 {
    /// A film with frames of the given size and rate in a file.
    pub fn new(program: &Path, file: &Unfinished, size: [u32; 2], fps: f64) -> Result<Self, Error> {
        let mut target = std::ffi::OsString::from("file:"); // the prefix keeps names from being read as options or addresses
        // ffmpeg opens by name the file that this process has created; another file there would not be used.
        target.push(file.path());
        let mut command = Command::new(program);
        command
            .args(["-loglevel", "error", "-y", "-f", "rawvideo", "-pixel_format", "rgb24"])
            .args(["-video_size", &format!("{}x{}", size[0], size[1])])
            .args(["-framerate", &fps.to_string(), "-i", "pipe:0", "-an"])
            // All players support chroma subsampling 4:2:0; with the index at the front a browser starts at once.
            .args(["-pix_fmt", "yuv420p", "-movflags", "+faststart"])
            .args(["-metadata", &format!("comment={MARK}"), "-f", "mp4"])
            .arg(target)
            .stdin(Stdio::piped())
            .stdout(Stdio::null())
            .stderr(Stdio::piped());
        #[cfg(unix)]
        {
            // This program handles Ctrl-C.
            std::os::unix::process::CommandExt::process_group(&mut command, 0);
        }
        let mut child = command.spawn().map_err(|e| Error::io(program, "start", &e))?;
        let listen = |stderr| std::thread::Builder::new().spawn(move || text(stderr)).ok();
        let complaints = child.stderr.take().and_then(listen);
        Ok(Self { child, complaints })
    }

    /// Appends a frame.
    pub fn push(&mut self, pixels: &Pixels) -> Result<(), Error> {
        let written = self.child.stdin.as_mut().map(|stdin| stdin.write_all(&pixels.rgb));
        match written {
            Some(Ok(())) => Ok(()),
            _ => Err(self.complaint()),
        }
    }

    /// Completes the file.
    pub fn finish(mut self) -> Result<(), Error> {
        drop(self.child.stdin.take());
        match self.child.wait() {
            Ok(status) if status.success() => Ok(()),
            _ => Err(self.complaint()),
        }
    }

    fn complaint(&mut self) -> Error {
        drop(self.child.stdin.take());
        let status = self.child.wait().map_or_else(|e| e.to_string(), |s| s.to_string());
        let said = self.complaints.take().and_then(|thread| thread.join().ok()).unwrap_or_default();
        let said = said.trim().lines().last().unwrap_or("no message").to_owned();
        Error::failed(format!("ffmpeg failed ({status}): {said}"))
    }
}

impl Drop for Mp4 {
    fn drop(&mut self) {
        if !matches!(self.child.try_wait(), Ok(Some(_))) {
            let _ = self.child.kill();
            let _ = self.child.wait();
        }
    }
}

fn text(mut stderr: ChildStderr) -> String {
    let mut bytes = Vec::new();
    let _ = stderr.read_to_end(&mut bytes);
    String::from_utf8_lossy(&bytes).into_owned()
}
