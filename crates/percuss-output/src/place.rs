//! Names in opened directories: a link at a predictable name is never followed.
//!
//! Files are made where none is, or not at all; a link in their place is an error. The directory is opened once, so that all that is
//! done about one file happens in one directory, whatever becomes of its path meanwhile.

use std::ffi::{OsStr, OsString};
use std::fs::File;
use std::io::{Error, ErrorKind, Result};
use std::path::{Component, Path, PathBuf};

/// Why a file cannot be written at a name.
const LINK: &str = "a link or special file exists there; remove it";

/// A name in a directory that is open.
#[derive(Debug)]
pub(crate) struct Place {
    folder: system::Folder,
    name: OsString,
    path: PathBuf,
}

impl Place {
    /// The last name of a path; links on the way to it are the user's, and followed.
    pub fn of(path: &Path) -> Result<Self> {
        let name = path.file_name().ok_or_else(|| Error::from(ErrorKind::InvalidInput))?.to_owned();
        let folder = system::Folder::open(parent(path))?;
        Ok(Self { folder, name, path: path.to_owned() })
    }

    /// A path within a directory: folders on the way are made where they are missing, and links among them refused.
    pub fn within(root: &Path, file: &Path) -> Result<Self> {
        let name = file.file_name().ok_or_else(|| Error::from(ErrorKind::InvalidInput))?.to_owned();
        let mut folder = system::Folder::open(root)?;
        let mut path = root.to_owned();
        for part in file.parent().into_iter().flat_map(Path::components) {
            let Component::Normal(part) = part else { return Err(ErrorKind::InvalidInput.into()) };
            path.push(part);
            folder = folder.below(part, &path)?;
        }
        path.push(&name);
        Ok(Self { folder, name, path })
    }

    /// Another name in the same directory.
    pub fn beside(&self, name: impl AsRef<OsStr>) -> Result<Self> {
        let name = name.as_ref().to_owned();
        let path = self.path.with_file_name(&name);
        Ok(Self { folder: self.folder.again()?, name, path })
    }

    /// Its path when it was opened.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Makes a file where nothing stands, not even a link.
    ///
    /// # Errors
    /// `AlreadyExists` if something does; what the system says.
    pub fn create(&self) -> Result<File> {
        system::create(self)
    }

    /// The same; what an earlier process left under a name that only this program uses is removed before.
    pub fn create_new(&self) -> Result<File> {
        for _ in 0..100 {
            match self.create() {
                Err(error) if error.kind() == ErrorKind::AlreadyExists => self.remove()?,
                made => return made,
            }
        }
        Err(ErrorKind::AlreadyExists.into())
    }

    /// Opens a regular file that has no other name, to read, or to write as well.
    ///
    /// # Errors
    /// If a link stands there; what the system says.
    pub fn open(&self, writes: bool) -> Result<File> {
        let file = system::open(self, writes)?;
        match system::is_plain(&file)? {
            true => Ok(file),
            false => Err(Error::other(LINK)),
        }
    }

    /// Removes a file, or a link, not what it leads to. What is not there is no error.
    pub fn remove(&self) -> Result<()> {
        match system::remove(self) {
            Err(error) if error.kind() != ErrorKind::NotFound => Err(error),
            _ => Ok(()),
        }
    }

    /// Gives it another name, in place of whatever bears that.
    pub fn rename(&self, to: &Self) -> Result<()> {
        system::rename(self, to)
    }

    /// Exchanges the two in one operation; false where the system has none, or one of them is not there.
    pub fn exchange(&self, other: &Self) -> bool {
        system::exchange(self, other)
    }

    /// Whether something bears the name, be it a link.
    pub fn is_taken(&self) -> bool {
        std::fs::symlink_metadata(&self.path).is_ok()
    }
}

fn parent(path: &Path) -> &Path {
    path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

#[cfg(unix)]
mod system {
    use super::{Error, File, LINK, OsStr, Path, Place, Result};
    use rustix::fs::{
        AtFlags, CWD, FileType, Mode, OFlags, fstat, mkdirat, openat, renameat, unlinkat,
    };
    use rustix::io::Errno;
    use std::os::fd::OwnedFd;

    /// An open directory.
    #[derive(Debug)]
    pub(super) struct Folder(OwnedFd);

    /// Names in it can be used; it need not be listed.
    #[cfg(any(target_os = "linux", target_os = "android"))]
    const FOLDER: OFlags = OFlags::PATH.union(OFlags::DIRECTORY).union(OFlags::CLOEXEC);
    #[cfg(not(any(target_os = "linux", target_os = "android")))]
    const FOLDER: OFlags = OFlags::DIRECTORY.union(OFlags::CLOEXEC);

    impl Folder {
        pub fn open(path: &Path) -> Result<Self> {
            Ok(Self(openat(CWD, path, FOLDER, Mode::empty())?))
        }

        /// A folder in it, made if it is not there.
        pub fn below(&self, name: &OsStr, _path: &Path) -> Result<Self> {
            let open = || openat(&self.0, name, FOLDER | OFlags::NOFOLLOW, Mode::empty());
            let opened = match open() {
                Err(Errno::NOENT) => match mkdirat(&self.0, name, Mode::from_raw_mode(0o777)) {
                    Ok(()) | Err(Errno::EXIST) => open(),
                    Err(error) => Err(error),
                },
                opened => opened,
            };
            match opened {
                Err(Errno::LOOP | Errno::NOTDIR) => Err(Error::other(LINK)),
                opened => Ok(Self(opened?)),
            }
        }

        pub fn again(&self) -> Result<Self> {
            Ok(Self(self.0.try_clone()?))
        }
    }

    pub(super) fn create(place: &Place) -> Result<File> {
        let flags = OFlags::RDWR | OFlags::CREATE | OFlags::EXCL | OFlags::NOFOLLOW;
        let mode = Mode::from_raw_mode(0o666);
        Ok(openat(&place.folder.0, &place.name, flags | OFlags::CLOEXEC, mode)?.into())
    }

    pub(super) fn open(place: &Place, writes: bool) -> Result<File> {
        let access = if writes { OFlags::RDWR } else { OFlags::RDONLY };
        // A pipe put there must not make the program wait.
        let flags = access | OFlags::NOFOLLOW | OFlags::NONBLOCK | OFlags::CLOEXEC;
        match openat(&place.folder.0, &place.name, flags, Mode::empty()) {
            Err(Errno::LOOP) => Err(Error::other(LINK)),
            opened => Ok(opened?.into()),
        }
    }

    pub(super) fn is_plain(file: &File) -> Result<bool> {
        let stat = fstat(file)?;
        // A file that was removed meanwhile has no name at all.
        Ok(FileType::from_raw_mode(stat.st_mode).is_file() && stat.st_nlink <= 1)
    }

    pub(super) fn remove(place: &Place) -> Result<()> {
        Ok(unlinkat(&place.folder.0, &place.name, AtFlags::empty())?)
    }

    pub(super) fn rename(from: &Place, to: &Place) -> Result<()> {
        Ok(renameat(&from.folder.0, &from.name, &to.folder.0, &to.name)?)
    }

    #[cfg(target_os = "linux")]
    pub(super) fn exchange(a: &Place, b: &Place) -> bool {
        use rustix::fs::{RenameFlags, renameat_with};
        let flags = RenameFlags::EXCHANGE;
        renameat_with(&a.folder.0, &a.name, &b.folder.0, &b.name, flags).is_ok()
    }

    #[cfg(not(target_os = "linux"))]
    pub(super) fn exchange(_a: &Place, _b: &Place) -> bool {
        false
    }
}

#[cfg(not(unix))]
mod system {
    use super::{Error, File, LINK, OsStr, Path, Place, Result};
    use std::fs;

    /// Directories cannot be opened here: names are looked up by their paths.
    #[derive(Debug)]
    pub(super) struct Folder;

    impl Folder {
        pub fn open(_path: &Path) -> Result<Self> {
            Ok(Self)
        }

        pub fn below(&self, _name: &OsStr, path: &Path) -> Result<Self> {
            match fs::symlink_metadata(path) {
                Ok(found) if found.is_dir() => Ok(Self),
                Ok(_) => Err(Error::other(LINK)),
                Err(_) => fs::create_dir(path).map(|()| Self),
            }
        }

        pub fn again(&self) -> Result<Self> {
            Ok(Self)
        }
    }

    pub(super) fn create(place: &Place) -> Result<File> {
        File::options().read(true).write(true).create_new(true).open(&place.path)
    }

    pub(super) fn open(place: &Place, writes: bool) -> Result<File> {
        if fs::symlink_metadata(&place.path)?.is_symlink() {
            return Err(Error::other(LINK));
        }
        File::options().read(true).write(writes).open(&place.path)
    }

    pub(super) fn is_plain(file: &File) -> Result<bool> {
        Ok(file.metadata()?.is_file())
    }

    pub(super) fn remove(place: &Place) -> Result<()> {
        fs::remove_file(&place.path)
    }

    pub(super) fn rename(from: &Place, to: &Place) -> Result<()> {
        fs::rename(&from.path, &to.path)
    }

    pub(super) fn exchange(_a: &Place, _b: &Place) -> bool {
        false
    }
}
