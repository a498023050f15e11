//! What a directory is besides its content: whose it is, who may use it, on which disk it lies, who stands in it.

use std::path::Path;

use crate::error::Error;

/// Whether a directory must stay itself and be filled in place, since another one in its stead would be another: a disk of its own, or
/// the directory in which this command was started, whose shell would find itself in one that is gone.
pub(super) fn stays_itself(directory: &Path) -> bool {
    let here = std::env::current_dir().and_then(|here| here.canonicalize());
    is_mount_point(directory) || here.is_ok_and(|here| here.starts_with(directory))
}

#[cfg(unix)]
pub(super) fn is_mount_point(directory: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let device = |path: &Path| std::fs::metadata(path).map(|m| m.dev()).ok();
    directory.parent().is_some_and(|parent| device(parent) != device(directory))
}

#[cfg(not(unix))]
pub(super) fn is_mount_point(_directory: &Path) -> bool {
    false
}

/// Gives a new directory owner, group and permissions of another one; whether it is like it now.
#[cfg(unix)]
pub(super) fn make_like(new: &Path, model: &Path) -> bool {
    use std::os::unix::fs::{MetadataExt, PermissionsExt};
    let of = |path: &Path| std::fs::metadata(path).map(|m| (m.uid(), m.gid(), m.mode() & 0o7777));
    let Ok((owner, group, mode)) = of(model) else { return false };
    // Each may be refused; what counts is what comes of it.
    let _ = std::os::unix::fs::lchown(new, Some(owner), Some(group));
    let _ = std::fs::set_permissions(new, std::fs::Permissions::from_mode(mode));
    of(new).is_ok_and(|found| found == (owner, group, mode)) && !has_more(model)
}

#[cfg(not(unix))]
pub(super) fn make_like(_new: &Path, _model: &Path) -> bool {
    true
}

/// Whether there is more to a directory than owner, group and permissions: lists of access, attributes of the user's.
#[cfg(target_os = "linux")]
fn has_more(directory: &Path) -> bool {
    let mut names = [0_u8; 4096];
    match rustix::fs::listxattr(directory, &mut names[..]) {
        // Labels of the system are given to every directory by its place.
        Ok(length) => names[..length]
            .split(|byte| *byte == 0)
            .any(|name| !name.is_empty() && !name.starts_with(b"security.")),
        Err(error) => error == rustix::io::Errno::RANGE,
    }
}

#[cfg(all(unix, not(target_os = "linux")))]
fn has_more(_directory: &Path) -> bool {
    false
}

/// Temporary directories are their owner's alone; results are as readable as other directories.
#[cfg(unix)]
pub(super) fn make_readable(dir: &Path) -> Result<(), Error> {
    use std::fs;
    use std::os::unix::fs::PermissionsExt;
    // What the system gives a new directory, its mask applied.
    let probe = dir.join(".mode");
    fs::create_dir(&probe).map_err(|e| Error::io(&probe, "create", e))?;
    let mode = fs::metadata(&probe).map(|m| m.permissions().mode());
    let _ = fs::remove_dir(&probe);
    let mode = mode.map_err(|e| Error::io(&probe, "look at", e))?;
    let set = fs::set_permissions(dir, fs::Permissions::from_mode(mode));
    set.map_err(|e| Error::io(dir, "set permissions of", e))
}

#[cfg(not(unix))]
pub(super) fn make_readable(_dir: &Path) -> Result<(), Error> {
    Ok(())
}
