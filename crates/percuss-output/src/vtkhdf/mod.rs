//! A run for ParaView: files of the VTKHDF format, each with poly data over all frames that were kept.
//!
//! Kinds of things stand in files of their own, since what a kind carries differs: beams with section forces and stresses at
//! points of their surface, bodies and obstacles as areas, contact forces as points with vectors. Names stay text inside the
//! files; no name of a user becomes a name of a file.

mod beams;
mod bodies;
mod contacts;
mod obstacles;
mod placed;
mod poly;

use std::fs;
use std::path::Path;

use crate::directory::{Extent, Results, RunDirectory};
use crate::error::Error;
use crate::fields::{DIRECTORY as FIELDS, Fields};
use placed::Placed;

/// Writes the files into a directory, which is made if it is not there; their names, of what the run has.
///
/// # Errors
/// If nothing was kept of the run, what was kept does not fit its scene, or a file cannot be written.
pub fn write(dir: impl AsRef<Path>, fields: &Fields) -> Result<Vec<&'static str>, Error> {
    let dir = dir.as_ref();
    let unfit = |reason: String| Error::content(FIELDS, reason);
    let placed = Placed::new(fields).map_err(unfit)?;
    fs::create_dir_all(dir).map_err(|e| Error::io(dir, "create", e))?;
    let series = [
        ("beams.vtkhdf", beams::series(&placed)),
        ("bodies.vtkhdf", bodies::series(&placed)),
        ("obstacles.vtkhdf", obstacles::series(&placed)),
        ("contacts.vtkhdf", contacts::series(&placed)),
    ];
    let mut written = Vec::new();
    for (name, series) in series {
        let Some(series) = series.filter(|series| !series.is_empty()) else { continue };
        let bytes = series.bytes().map_err(|e| Error::io(dir.join(name), "write", e))?;
        crate::files::write(&dir.join(name), &bytes)?;
        written.push(name);
    }
    Ok(written)
}

/// Writes the files into a directory of their own: all or none, in place of an earlier export and of nothing else.
///
/// # Errors
/// As [`write`], or if something else stands in the directory.
pub fn export(target: impl AsRef<Path>, fields: &Fields) -> Result<Vec<&'static str>, Error> {
    let directory = RunDirectory::create_for(Results::Export, target)?;
    let names = write(directory.path(), fields)?;
    directory.commit_as(Extent::Complete)?;
    Ok(names)
}
