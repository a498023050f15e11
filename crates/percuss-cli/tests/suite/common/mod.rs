//! Running the command in a directory of its own.
#![allow(dead_code, reason = "every test file uses its own share of these")]

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use serde_json::Value;
use tempfile::TempDir;

/// The elastic example.
pub const ELASTIC: &str = include_str!("../../files/elastic.toml");
/// The rigid example.
pub const RIGID: &str = include_str!("../../files/rigid.toml");

/// A directory with scenario files, removed at the end.
pub struct Sandbox {
    dir: TempDir,
}

/// What a command left behind.
pub struct Outcome {
    /// Exit status; none if it was killed.
    pub status: Option<i32>,
    /// Standard output.
    pub stdout: String,
    /// Standard error.
    pub stderr: String,
}

impl Sandbox {
    /// With `elastic.toml` and `rigid.toml` on it.
    pub fn new() -> Self {
        let sandbox = Self::empty();
        sandbox.put("elastic.toml", ELASTIC);
        sandbox.put("rigid.toml", RIGID);
        sandbox
    }

    /// With nothing on it.
    pub fn empty() -> Self {
        Self { dir: tempfile::tempdir().expect("a temporary directory") }
    }

    /// Puts a file on it.
    pub fn put(&self, name: &str, content: impl AsRef<[u8]>) {
        std::fs::write(self.path(name), content).expect("a file in a temporary directory");
    }

    /// Where something lies.
    pub fn path(&self, name: &str) -> PathBuf {
        self.dir.path().join(name)
    }

    /// Names of everything on it, sorted, hidden files too.
    pub fn names(&self) -> Vec<String> {
        names(self.dir.path())
    }

    /// The command, in this directory, ready to be started.
    pub fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_percuss"));
        command.args(arguments).current_dir(self.dir.path()).stdin(Stdio::null());
        command.stdout(Stdio::piped()).stderr(Stdio::piped());
        command
    }

    /// Runs the command to its end.
    pub fn percuss(&self, arguments: &[&str]) -> Outcome {
        let output = self.command(arguments).output().expect("the command starts");
        output.into()
    }

    /// `summary.json` of a run.
    pub fn summary(&self, run: &str) -> Value {
        let path = self.path(run).join("summary.json");
        let text = std::fs::read_to_string(&path).expect("a summary");
        serde_json::from_str(&text).expect("a summary in JSON")
    }
}

impl From<Output> for Outcome {
    fn from(output: Output) -> Self {
        Self {
            status: output.status.code(),
            stdout: String::from_utf8(output.stdout).expect("UTF-8 on standard output"),
            stderr: String::from_utf8(output.stderr).expect("UTF-8 on standard error"),
        }
    }
}

impl Outcome {
    /// The status is `status`; nothing panicked and no ANSI code went into a pipe.
    #[track_caller]
    pub fn ends_with(&self, status: i32) -> &Self {
        assert_eq!(self.status, Some(status), "{}{}", self.stdout, self.stderr);
        assert!(!self.stderr.contains("panicked"), "{}", self.stderr);
        for stream in [&self.stdout, &self.stderr] {
            assert!(!stream.contains('\u{1b}'), "ANSI codes in {stream:?}");
        }
        self
    }

    /// Standard error says `text`.
    #[track_caller]
    pub fn tells(&self, text: &str) -> &Self {
        assert!(self.stderr.contains(text), "no {text:?} in:\n{}", self.stderr);
        self
    }
}

/// Names in a directory, sorted; the list of what belongs to the results is left out.
pub fn names(directory: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(directory).expect("a directory");
    let name = |entry: std::io::Result<std::fs::DirEntry>| {
        entry.expect("an entry").file_name().to_string_lossy().into_owned()
    };
    let mut names: Vec<String> = entries.map(name).filter(|n| n != ".percuss.json").collect();
    names.sort();
    names
}

/// Whether suites are run as a whole, as by `scripts/check --full`, and not a sample of each.
pub fn whole() -> bool {
    std::env::var_os("PERCUSS_WHOLE").is_some()
}
