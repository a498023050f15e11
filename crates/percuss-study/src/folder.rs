//! The directory of a study: what is done is kept, whatever happens.

use std::fs;
use std::hash::{BuildHasher, RandomState};
use std::path::{Path, PathBuf};

use percuss_codes::RequestCode;
use percuss_output::{create_new, write_new};

use crate::column::Table;
use crate::error::Error;
use crate::merge::{merge, missing};
use crate::parquet;
use crate::shard::Shard;
use crate::study::Study;

/// The study as one text that names no other file.
const STUDY: &str = "study.toml";
/// The table of all runs.
pub const RESULTS: &str = "results.parquet";
/// The page.
pub const REPORT: &str = "report.html";
/// Directory of the runs that were kept whole.
pub const KEPT: &str = "kept";
/// Directory of the shards.
const SHARDS: &str = "shards";

/// The directory of a study: `study.toml`, `shards/`, and at the end `results.parquet`.
///
/// Every file appears whole or not at all, so a study may be killed at any moment.
#[derive(Clone, Debug)]
pub struct Folder {
    path: PathBuf,
}

impl Folder {
    /// Opens the directory of a study, or makes it.
    ///
    /// # Errors
    /// If there is something else, such as another study, or the operating system reports an error.
    pub fn open(path: impl AsRef<Path>, study: &Study) -> Result<Self, Error> {
        let folder = Self { path: path.as_ref().into() };
        let own = folder.path.join(STUDY);
        let text = study.to_toml();
        match fs::read_to_string(&own) {
            Ok(found) if found == text => {}
            Ok(_) => {
                let what = "belongs to another study, or to an earlier state of this one";
                return Err(folder.refused(RequestCode::OtherStudy, what));
            }
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
                if folder.is_taken()? {
                    let what = "is not empty and contains no study";
                    return Err(folder.refused(RequestCode::OtherStudy, what));
                }
                fs::create_dir_all(folder.path.join(SHARDS))
                    .map_err(|e| Error::io(&folder.path, "create", e))?;
                replace(&own, text.as_bytes())?;
            }
            Err(error) => return Err(Error::io(&own, "read", error)),
        }
        fs::create_dir_all(folder.path.join(SHARDS))
            .map_err(|e| Error::io(&folder.path, "create", e))?;
        Ok(folder)
    }

    fn is_taken(&self) -> Result<bool, Error> {
        match fs::read_dir(&self.path) {
            // Another process of the same study may just have begun.
            Ok(entries) => Ok(entries.flatten().any(|entry| {
                let name = entry.file_name().to_string_lossy().into_owned();
                name != SHARDS && !name.starts_with('.')
            })),
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(false),
            Err(error) => Err(Error::io(&self.path, "list", error)),
        }
    }

    fn refused(&self, code: RequestCode, what: &str) -> Error {
        let path = self.path.display();
        Error::unfit(
            code,
            format!("{path} {what}; choose another --out, or remove it to start again"),
        )
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    fn shard_path(&self, index: u64) -> PathBuf {
        self.path.join(SHARDS).join(format!("shard-{index:06}.parquet"))
    }

    /// A shard that has been done; an error where it has not, or is damaged.
    ///
    /// # Errors
    /// If the shard is not there, damaged, or of another study.
    pub fn read(&self, study: &Study, index: u64) -> Result<Shard, Error> {
        let path = self.shard_path(index);
        let bytes = fs::read(&path).map_err(|e| match e.kind() {
            std::io::ErrorKind::NotFound => missing(index),
            _ => Error::io(&path, "read", e),
        })?;
        let shard = Shard::from_parquet(&bytes, study).map_err(|e| e.at(&path))?;
        match shard.index == index {
            true => Ok(shard),
            false => {
                let text = format!("{} is shard {}", path.display(), shard.index);
                Err(Error::unfit(RequestCode::Shard, text))
            }
        }
    }

    /// Whether a shard has been done and is whole.
    pub fn has(&self, study: &Study, index: u64) -> bool {
        self.read(study, index).is_ok()
    }

    /// Keeps a shard.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn keep(&self, study: &Study, shard: &Shard) -> Result<(), Error> {
        replace(&self.shard_path(shard.index), &shard.to_parquet(study)?)
    }

    /// Puts the shards together into `results.parquet`.
    ///
    /// # Errors
    /// If one is missing, or the file cannot be written.
    pub fn finish(&self, study: &Study) -> Result<(), Error> {
        let path = self.path.join(RESULTS);
        let staging = staging(&path);
        let file = create_new(&staging).map_err(|e| Error::io(&staging, "create", e))?;
        let shards = (0..study.shard_count()).map(|index| self.read(study, index));
        let merged = merge(study, shards, std::io::BufWriter::new(file));
        if let Err(error) = merged {
            let _ = fs::remove_file(&staging);
            return Err(error);
        }
        settle(&staging, &path)?;
        self.tidy_up();
        Ok(())
    }

    /// Removes what processes that died were writing: with all shards done, nothing of it is needed. A process that still writes one
    /// finds it done ([`settle`]).
    fn tidy_up(&self) {
        for folder in [self.path.clone(), self.path.join(SHARDS)] {
            for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
                if is_staging(&entry.file_name().to_string_lossy()) {
                    let _ = fs::remove_file(entry.path());
                }
            }
        }
    }

    /// The table of all runs.
    ///
    /// # Errors
    /// If the study is not finished or the table damaged.
    pub fn results(&self, study: &Study) -> Result<Table, Error> {
        let path = self.path.join(RESULTS);
        let bytes = fs::read(&path).map_err(|e| Error::io(&path, "read", e))?;
        parquet::read_table(&bytes, study)
    }

    /// Numbers of the runs that were kept whole, in their order, and their pages by the path from that of the study.
    pub fn kept(&self) -> Vec<(u64, String)> {
        let Ok(entries) = fs::read_dir(self.path.join(KEPT)) else { return Vec::new() };
        let number = |entry: fs::DirEntry| {
            let name = entry.file_name().into_string().ok()?;
            let number = name.strip_prefix("run-")?.parse().ok()?;
            let page = format!("{KEPT}/{name}/{REPORT}");
            self.path.join(&page).is_file().then_some((number, page))
        };
        let mut all: Vec<(u64, String)> = entries.flatten().filter_map(number).collect();
        all.sort_unstable();
        all
    }

    /// Writes a file of the directory, whole or not at all.
    ///
    /// # Errors
    /// If the operating system reports an error.
    pub fn write(&self, name: &str, bytes: &[u8]) -> Result<(), Error> {
        replace(&self.path.join(name), bytes)
    }
}

/// Writes a file beside its place and moves it there, so that it is whole or not there, even if power fails.
fn replace(path: &Path, bytes: &[u8]) -> Result<(), Error> {
    let staging = staging(path);
    if let Err(error) = write_new(&staging, bytes) {
        let _ = fs::remove_file(&staging);
        return Err(Error::io(&staging, "write", error));
    }
    settle(&staging, path)
}

fn settle(staging: &Path, path: &Path) -> Result<(), Error> {
    let synced = fs::File::open(staging).and_then(|file| file.sync_all());
    let Err(error) = synced.and_then(|()| fs::rename(staging, path)) else { return Ok(()) };
    // Another process has done the same meanwhile, and tidied up.
    if error.kind() == std::io::ErrorKind::NotFound && path.is_file() {
        return Ok(());
    }
    let _ = fs::remove_file(staging);
    Err(Error::io(path, "write", error))
}

/// Whether a name is one of [`staging`].
fn is_staging(name: &str) -> bool {
    let parts = name.strip_prefix('.').and_then(|rest| rest.rsplit_once('.'));
    parts.is_some_and(|(of, number)| {
        let ours = [STUDY, RESULTS, REPORT].contains(&of)
            || (of.starts_with("shard-") && of.ends_with(".parquet"));
        ours && number.len() == 16 && number.bytes().all(|b| b.is_ascii_hexdigit())
    })
}

/// A name beside `path` that no other process uses, on whatever machine.
fn staging(path: &Path) -> PathBuf {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let number = RandomState::new().hash_one(std::process::id());
    path.with_file_name(format!(".{name}.{number:016x}"))
}
