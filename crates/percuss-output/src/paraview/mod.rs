//! A run for ParaView: poly data over all frames that were kept.
//!
//! Kinds of things stand in files of their own, since what a kind carries differs: beams with section forces and stresses at
//! points of their surface, bodies and obstacles as areas, supports as lines, contact forces as points with vectors. Names stay text inside the
//! files; no name of a user becomes a name of a file.

mod beams;
mod bodies;
mod contacts;
mod obstacles;
mod placed;
mod poly;
mod supports;
#[cfg(feature = "vtkhdf")]
mod vtkhdf;
mod vtp;

use std::fs;
use std::path::Path;

use crate::directory::{Extent, Results, RunDirectory};
use crate::error::Error;
use crate::fields::{DIRECTORY as FIELDS, Fields};
use crate::files;
use placed::Placed;
use poly::PolySeries;

/// Format of the files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// One HDF5 file a kind of things: ParaView 5.12 and later. Needs the feature `vtkhdf`.
    Vtkhdf,
    /// A list of VTP files a kind of things, one file an instant: any ParaView.
    Pvd,
}

impl Format {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::Vtkhdf, Self::Pvd];

    /// Whether this build writes it.
    pub fn is_built(self) -> bool {
        self == Self::Pvd || cfg!(feature = "vtkhdf")
    }

    /// Its name, which its files end with.
    pub fn name(self) -> &'static str {
        match self {
            Self::Vtkhdf => "vtkhdf",
            Self::Pvd => "pvd",
        }
    }
}

/// What makes the poly data of a kind of things, if a run has any.
type Kind = fn(&Placed<'_>) -> Option<PolySeries>;

/// Whether there are frames, and each of them fits the scene.
///
/// # Errors
/// What does not fit.
pub fn check(fields: &Fields) -> Result<(), Error> {
    Placed::new(fields).map(drop).map_err(|reason| Error::content(FIELDS, reason))
}

/// Writes the files into a directory, which is made if it is not there; names of those to open, of what the run has.
///
/// # Errors
/// If nothing was kept of the run, what was kept does not fit its scene, or a file cannot be written.
pub fn write(dir: impl AsRef<Path>, fields: &Fields, format: Format) -> Result<Vec<String>, Error> {
    let dir = dir.as_ref();
    let placed = Placed::new(fields).map_err(|reason| Error::content(FIELDS, reason))?;
    fs::create_dir_all(dir).map_err(|e| Error::io(dir, "create", e))?;
    let kinds: [(&str, Kind); 5] = [
        ("beams", beams::series),
        ("bodies", bodies::series),
        ("obstacles", obstacles::series),
        ("supports", supports::series),
        ("contacts", contacts::series),
    ];
    let mut written = Vec::new();
    for (name, series) in kinds {
        let Some(series) = series(&placed).filter(|series| !series.is_empty()) else { continue };
        let file = dir.join(format!("{name}.{}", format.name()));
        match format {
            #[cfg(feature = "vtkhdf")]
            Format::Vtkhdf => {
                let bytes = series.bytes().map_err(|e| Error::io(&file, "write", e))?;
                files::write(&file, &bytes)?;
            }
            #[cfg(not(feature = "vtkhdf"))]
            Format::Vtkhdf => {
                return Err(Error::content(dir, "this build writes no HDF5"));
            }
            Format::Pvd => {
                let beside = dir.join(name);
                fs::create_dir_all(&beside).map_err(|e| Error::io(&beside, "create", e))?;
                for frame in 0..series.file_count() {
                    files::write(&beside.join(vtp::file_name(frame)), &series.file(frame))?;
                }
                files::write(&file, series.list(name).as_bytes())?;
            }
        }
        written.push(format!("{name}.{}", format.name()));
    }
    Ok(written)
}

/// Writes the files into a directory of their own: all or none, in place of an earlier export and of nothing else.
///
/// # Errors
/// As [`write()`], or if something else stands in the directory.
pub fn export(
    target: impl AsRef<Path>,
    fields: &Fields,
    format: Format,
) -> Result<Vec<String>, Error> {
    let directory = RunDirectory::create_for(Results::Export, target)?;
    let names = write(directory.path(), fields, format)?;
    directory.commit_as(Extent::Complete)?;
    Ok(names)
}
