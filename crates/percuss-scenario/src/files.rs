//! Reading files: which of those that a scenario names, and what is no regular file.

use std::fs;
use std::io::{Error, ErrorKind, Read, Result};
use std::path::{Component, Path, PathBuf};
use std::sync::mpsc;
use std::thread;
use std::time::Duration;

use sha2::{Digest, Sha256};

/// A pipe that gives nothing for so long will not.
const PATIENCE: Duration = Duration::from_secs(10);
/// Most that is read from a pipe or a device, which may have no end \[bytes\].
const MOST: usize = 1 << 28;

/// Which files a scenario may name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FileAccess {
    /// Those in its own folder and below: it may come from someone else.
    #[default]
    OwnFolder,
    /// Any.
    Anywhere,
}

/// What is right of a file that lies outside.
pub(crate) const WITHIN: &str = "a file in that folder or below; others are read only where that is allowed (--allow-outside, allow_outside=True)";

/// Where the files lie that a text names, which of them it may name, and how many rows of one are written out as lists.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Files<'p> {
    /// What their paths begin from.
    pub folder: &'p Path,
    /// Which may be read.
    pub access: FileAccess,
    /// A table with more rows is written as the name of its file.
    pub most_rows: usize,
}

/// Most rows of a file that are written out as lists.
const MOST_ROWS: usize = 1000;

impl<'p> Files<'p> {
    /// The files of a scenario: those of long tables are named where it is written.
    pub fn named(folder: &'p Path, access: FileAccess) -> Self {
        Self { folder, access, most_rows: MOST_ROWS }
    }

    /// The files of a text that shall need no others where it is written, whatever its length.
    pub fn taken_in(folder: &'p Path, access: FileAccess) -> Self {
        Self { folder, access, most_rows: usize::MAX }
    }
}

/// The SHA-256 of bytes, in hexadecimal digits.
pub(crate) fn sha256(bytes: &[u8]) -> String {
    hexadecimal(&Sha256::digest(bytes))
}

/// Whether a regular file is there with that SHA-256. Files beyond the limit for pipes are not looked at: this is asked of what the
/// author of a text has no right to but by knowing it.
pub(crate) fn has_sha256(path: &Path, expected: &str) -> bool {
    let looked_at = fs::metadata(path).is_ok_and(|m| m.is_file() && m.len() <= MOST as u64);
    let mut hash = Sha256::new();
    let read = || std::io::copy(&mut fs::File::open(path)?, &mut hash);
    looked_at && { read }().is_ok() && hexadecimal(&hash.finalize()) == expected
}

fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// The bytes of a file; a pipe or a device is read once, as long as it gives something every ten seconds.
///
/// # Errors
/// What the system says; `TimedOut` where nothing came, `FileTooLarge` where there was no end.
pub fn read_bytes(path: &Path) -> Result<Vec<u8>> {
    if fs::metadata(path)?.is_file() {
        return fs::read(path);
    }
    let path = path.to_owned();
    // Opening a pipe waits as well.
    read_in_time(move || fs::File::open(path), PATIENCE)
}

/// The bytes of what `open` gives, within limits of time and memory.
///
/// # Errors
/// As [`read_bytes`].
pub fn read_in_time<R: Read>(
    open: impl FnOnce() -> Result<R> + Send + 'static,
    patience: Duration,
) -> Result<Vec<u8>> {
    let (sender, pieces) = mpsc::channel::<Result<Vec<u8>>>();
    // Left behind where it waits for ever; it holds nothing.
    thread::Builder::new().spawn(move || {
        let mut from = match open() {
            Ok(from) => from,
            Err(error) => return sender.send(Err(error)).unwrap_or(()),
        };
        let mut piece = vec![0; 1 << 16];
        loop {
            let read = from.read(&mut piece).map(|n| piece[..n].to_vec());
            let ends = read.as_ref().map_or(true, Vec::is_empty);
            if sender.send(read).is_err() || ends {
                return;
            }
        }
    })?;
    let mut bytes = Vec::new();
    loop {
        let piece = pieces.recv_timeout(patience).map_err(|_| {
            let text = format!("no input for {} s", patience.as_secs_f64());
            Error::new(ErrorKind::TimedOut, text)
        })??;
        if piece.is_empty() {
            return Ok(bytes);
        }
        bytes.extend(piece);
        if bytes.len() > MOST {
            let text = format!("input exceeds {} MB", MOST >> 20);
            return Err(Error::new(ErrorKind::FileTooLarge, text));
        }
    }
}

/// Whether a file that a text in `folder` names lies in that folder or below, links followed.
pub(crate) fn is_within(folder: &Path, name: &str) -> bool {
    if escapes(Path::new(name)) {
        return false;
    }
    let here = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let real = |path: PathBuf| path.canonicalize();
    match (real(here.to_owned()), real(here.join(name))) {
        (Ok(folder), Ok(file)) => file.starts_with(folder),
        // A missing file is reported as missing.
        _ => true,
    }
}

/// Whether a path, taken by its words, leads out of where it begins.
fn escapes(path: &Path) -> bool {
    let mut depth = 0_i64;
    for part in path.components() {
        match part {
            Component::Normal(_) => depth += 1,
            Component::ParentDir => depth -= 1,
            Component::CurDir => {}
            Component::RootDir | Component::Prefix(_) => return true,
        }
        if depth < 0 {
            return true;
        }
    }
    false
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_that_gives_nothing_is_given_up() {
        let waits = || {
            thread::sleep(Duration::from_secs(2));
            Ok(std::io::empty())
        };
        let error = read_in_time(waits, Duration::from_millis(20)).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::TimedOut);
    }

    #[test]
    fn a_file_without_end_is_given_up() {
        let error = read_in_time(|| Ok(std::io::repeat(b' ')), PATIENCE).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::FileTooLarge);
        let text = read_in_time(|| Ok("all".as_bytes()), PATIENCE).unwrap();
        assert_eq!(text, b"all");
    }

    #[test]
    fn paths_that_lead_out_do_so_by_their_words() {
        for out in ["/etc/passwd", "../x.csv", "a/../../x.csv", "./.."] {
            assert!(escapes(Path::new(out)), "{out}");
        }
        for within in ["x.csv", "./a/x.csv", "a/../x.csv", "a/b/../../x.csv"] {
            assert!(!escapes(Path::new(within)), "{within}");
        }
    }
}
