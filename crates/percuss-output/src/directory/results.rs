//! What a directory can hold, and how much of it.

/// What a directory of results holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Results {
    /// A run.
    Run,
    /// Natural modes.
    Modes,
    /// A static equilibrium.
    Static,
    /// An equilibrium path.
    Path,
    /// Files of a run for another program.
    Export,
    /// Parameters found from measurements.
    Fit,
}

impl Results {
    /// The word for it in the manifest.
    pub(super) fn kind(self) -> &'static str {
        match self {
            Self::Run => "run",
            Self::Modes => "modes",
            Self::Static => "static",
            Self::Path => "path",
            Self::Export => "export",
            Self::Fit => "fit",
        }
    }

    /// What it looks like, in words.
    pub(super) fn words(self) -> &'static str {
        match self {
            Self::Run => "the directory of a run",
            Self::Modes => "a directory of modes",
            Self::Static => "a directory of a static equilibrium",
            Self::Path => "a directory of an equilibrium path",
            Self::Export => "a directory of exported files",
            Self::Fit => "the directory of a fit",
        }
    }
}

/// Whether results are all that was asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// They are; earlier results make room for them.
    Complete,
    /// They end early, or a part is missing: they never take the place of complete ones.
    Partial,
}
