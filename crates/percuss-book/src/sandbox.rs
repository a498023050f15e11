//! A folder in which the commands of a page run.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::{env, fs, io};

/// A folder, and the command that pages call `percuss`.
#[derive(Clone, Debug)]
pub struct Sandbox {
    folder: PathBuf,
    percuss: PathBuf,
}

/// What a command left behind.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Outcome {
    /// Whether it succeeded.
    pub success: bool,
    /// What it printed, as a terminal shows it.
    pub text: String,
}

impl Sandbox {
    /// An empty folder; what was there before is removed. `percuss` is the path of the command.
    ///
    /// # Errors
    /// The folder cannot be made.
    pub fn new(folder: PathBuf, percuss: &Path) -> io::Result<Self> {
        if folder.exists() {
            fs::remove_dir_all(&folder)?;
        }
        fs::create_dir_all(&folder)?;
        Ok(Self { folder, percuss: percuss.canonicalize()? })
    }

    /// Where a file lies.
    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }

    /// Writes a file, and the folders that it names.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn put(&self, name: &str, text: &str) -> io::Result<()> {
        let path = self.path(name);
        if let Some(folder) = path.parent() {
            fs::create_dir_all(folder)?;
        }
        fs::write(path, text)
    }

    /// Runs a line of the shell.
    ///
    /// # Errors
    /// There is no shell.
    pub fn run(&self, line: &str) -> io::Result<Outcome> {
        let own = self.percuss.parent().unwrap_or(Path::new("."));
        let before = env::var_os("PATH").unwrap_or_default();
        let paths = [own.to_path_buf()].into_iter().chain(env::split_paths(&before));
        let path = env::join_paths(paths).map_err(io::Error::other)?;
        let mut command = Command::new("sh");
        command.args(["-c", &format!("exec 2>&1\n{line}")]).current_dir(&self.folder);
        command.env("PATH", path).env("NO_COLOR", "1").env("COLUMNS", "100");
        let output = command.stdin(Stdio::null()).output()?;
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        Ok(Outcome { success: output.status.success(), text })
    }
}
