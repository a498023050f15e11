//! The manifest of a directory of results: the files that belong to them, with size and checksum.

use std::fs::{self, File};
use std::io::Read as _;
use std::path::{Path, PathBuf};

use serde_json::{Map, Value, json};
use sha2::{Digest, Sha256};

use super::results::{Extent, Results};
use crate::error::Error;
use crate::files;

/// Its name. Whoever removes it keeps the files as his own.
pub(crate) const NAME: &str = ".percuss.json";

/// What belongs to results.
#[derive(Clone, Debug)]
pub(crate) struct Manifest {
    pub kind: String,
    pub complete: bool,
    files: Map<String, Value>,
}

impl Manifest {
    /// Of files in a directory, by their paths within it; some may be described already.
    pub fn of(
        dir: &Path,
        files: &[PathBuf],
        results: Results,
        extent: Extent,
        known: &Map<String, Value>,
    ) -> Result<Self, Error> {
        let mut described_files = Map::new();
        for file in files {
            let name = name_of(file);
            let description = match known.get(&name) {
                Some(description) => description.clone(),
                None => described(&dir.join(file))?,
            };
            described_files.insert(name, description);
        }
        let complete = extent == Extent::Complete;
        Ok(Self { kind: results.kind().to_owned(), complete, files: described_files })
    }

    /// The manifest of a directory; `None` where there is none, or nothing that could be one.
    pub fn read(dir: &Path) -> Result<Option<Self>, Error> {
        let path = dir.join(NAME);
        let Ok(text) = fs::read_to_string(&path) else { return Ok(None) };
        let Ok(mut value) = serde_json::from_str::<Value>(&text) else { return Ok(None) };
        let files = value["files"].as_object_mut().map(std::mem::take);
        let kind = value["kind"].as_str().map(str::to_owned);
        Ok(kind.zip(files).map(|(kind, files)| Self {
            kind,
            complete: value["complete"] == true,
            files,
        }))
    }

    /// Writes it.
    pub fn write(&self, dir: &Path) -> Result<(), Error> {
        let value = json!({
            "about": "Files that Percuss wrote here and may replace; it leaves everything else alone.",
            "version": env!("CARGO_PKG_VERSION"),
            "kind": self.kind,
            "complete": self.complete,
            "files": self.files,
        });
        let path = dir.join(NAME);
        files::write(&path, format!("{value:#}\n").as_bytes())
    }

    /// Whether a file, by its path within the directory, belongs to the results.
    pub fn lists(&self, file: &Path) -> bool {
        file == Path::new(NAME) || self.files.contains_key(&name_of(file))
    }

    /// Whether a file in a directory, by its path within it, is listed and still what was written.
    pub fn is_as_written(&self, dir: &Path, file: &Path) -> Result<bool, Error> {
        Ok(self.lists(file) && self.is_described(file, &described(&dir.join(file))?))
    }

    /// Whether that is what it says of a file.
    pub fn is_described(&self, file: &Path, description: &Value) -> bool {
        !description.is_null() && self.files.get(&name_of(file)) == Some(description)
    }

    /// The files that it lists.
    pub fn listed(&self) -> impl Iterator<Item = &Path> {
        self.files.keys().map(Path::new)
    }

    /// The first of its files that is no longer what was written; what is missing is no loss.
    pub fn changed(&self, dir: &Path) -> Result<Option<String>, Error> {
        for (name, written) in &self.files {
            let path = dir.join(name);
            if fs::symlink_metadata(&path).is_ok() && described(&path)? != *written {
                return Ok(Some(name.clone()));
            }
        }
        Ok(None)
    }

    /// Takes in the files of another directory, under their names there.
    pub fn add(&mut self, dir: &Path, files: &[PathBuf]) -> Result<(), Error> {
        for file in files {
            self.files.insert(name_of(file), described(&dir.join(file))?);
        }
        Ok(())
    }
}

/// A path with slashes, as the manifest has it. Names that are no text are never ours.
fn name_of(file: &Path) -> String {
    let parts: Vec<_> = file.iter().map(|part| part.to_str().unwrap_or("\u{0}")).collect();
    parts.join("/")
}

/// Size and checksum of a file.
pub(super) fn described(path: &Path) -> Result<Value, Error> {
    let fault = |e: std::io::Error| Error::io(path, "read", e);
    let kind = fs::symlink_metadata(path).map_err(fault)?;
    if !kind.is_file() {
        return Ok(Value::Null); // something else stands there now
    }
    let mut file = File::open(path).map_err(fault)?;
    let (mut hash, mut bytes, mut piece) = (Sha256::new(), 0_u64, vec![0; 1 << 16]);
    loop {
        match file.read(&mut piece).map_err(fault)? {
            0 => break,
            n => {
                hash.update(&piece[..n]);
                bytes += n as u64;
            }
        }
    }
    let digits: String = hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect();
    Ok(json!({ "bytes": bytes, "sha256": digits }))
}
