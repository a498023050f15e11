//! The one error type of an analysis.

use std::fmt;

use percuss_codes::AnalysisCode;

/// An error of a recorder, passed through the run to its caller.
pub type RecorderError = Box<dyn std::error::Error + Send + Sync>;

/// Reason why an analysis has no result.
#[derive(Debug)]
pub struct Error {
    kind: ErrorKind,
    /// Previous failures, in words; empty without any.
    after: String,
}

#[derive(Debug)]
enum ErrorKind {
    NoConvergence { time: f64, step: f64, what: String, cure: &'static str },
    NoEquilibrium { share: f64 },
    UnsettledContacts { share: f64 },
    MomentBeyondLaw { share: f64, beam: String, most: f64 },
    NothingHolds { body: String },
    Overlap { what: String },
    NothingLeft { share: f64, what: String },
    Unbalanced { left: f64, gross: f64 },
    Singular { time: f64, place: String },
    Grown { time: f64, made: f64, came: f64 },
    Recorder(RecorderError),
}

impl Error {
    /// Newton's iteration failed down to the smallest step; `what` did not converge.
    pub(crate) fn no_convergence(time: f64, step: f64, what: String) -> Self {
        Self::of(ErrorKind::NoConvergence { time, step, what, cure: "try a smaller step" })
    }

    /// The same where a compliant contact is pressed in so deep that its geometry may be why.
    pub(crate) fn pressed_through(time: f64, step: f64, what: String) -> Self {
        let cure = "use a stiffer contact law or larger depths";
        Self::of(ErrorKind::NoConvergence { time, step, what, cure })
    }

    /// No equilibrium was found beyond a share of the loads.
    pub(crate) fn no_equilibrium(share: f64) -> Self {
        Self::of(ErrorKind::NoEquilibrium { share })
    }

    /// The same in a model with rigid contacts, whose forces may be the part that does not converge.
    pub(crate) fn unsettled_contacts(share: f64) -> Self {
        Self::of(ErrorKind::UnsettledContacts { share })
    }

    /// No equilibrium beyond a share of the loads, since a section in Green strains carries no larger moment.
    pub(crate) fn moment_beyond_law(share: f64, beam: String, most: f64) -> Self {
        Self::of(ErrorKind::MomentBeyondLaw { share, beam, most })
    }

    /// Loads accelerate an unsupported rigid body.
    pub(crate) fn nothing_holds(body: String) -> Self {
        Self::of(ErrorKind::NothingHolds { body })
    }

    /// Bodies overlap before any load acts.
    pub(crate) fn overlap(what: String) -> Self {
        Self::of(ErrorKind::Overlap { what })
    }

    /// There is no equilibrium after a failure, given in words, at a share of the loads.
    pub(crate) fn nothing_left(share: f64, what: String) -> Self {
        Self::of(ErrorKind::NothingLeft { share, what })
    }

    /// Unbalanced external forces in the solution: `left` \[N\] of `gross` \[N\].
    pub(crate) fn unbalanced(left: f64, gross: f64) -> Self {
        Self::of(ErrorKind::Unbalanced { left, gross })
    }

    fn of(kind: ErrorKind) -> Self {
        Self { kind, after: String::new() }
    }

    /// The same after failures during loading, given in words.
    pub(crate) fn after(mut self, failures: &str) -> Self {
        if !failures.is_empty() {
            self.after = format!("; before: {failures}");
        }
        self
    }

    /// The tangent cannot be factorised.
    pub(crate) fn singular(time: f64, place: String) -> Self {
        Self::of(ErrorKind::Singular { time, place })
    }

    /// Energy growth beyond any valid result in a scheme that does not conserve energy: `made` \[J\] more than the supplied energy `came` \[J\].
    pub(crate) fn grown(time: f64, made: f64, came: f64) -> Self {
        Self::of(ErrorKind::Grown { time, made, came })
    }

    /// The recorder failed.
    pub(crate) fn recorder(source: RecorderError) -> Self {
        Self::of(ErrorKind::Recorder(source))
    }

    /// Its code in the catalogue.
    pub fn code(&self) -> AnalysisCode {
        match self.kind {
            ErrorKind::NoConvergence { .. } => AnalysisCode::Convergence,
            ErrorKind::NoEquilibrium { .. } => AnalysisCode::Equilibrium,
            ErrorKind::UnsettledContacts { .. } => AnalysisCode::UnsettledContacts,
            ErrorKind::MomentBeyondLaw { .. } => AnalysisCode::MomentBeyondLaw,
            ErrorKind::NothingHolds { .. } => AnalysisCode::NothingHolds,
            ErrorKind::Overlap { .. } => AnalysisCode::Overlap,
            ErrorKind::NothingLeft { .. } => AnalysisCode::NothingLeft,
            ErrorKind::Unbalanced { .. } => AnalysisCode::Equilibrium,
            ErrorKind::Singular { .. } => AnalysisCode::Singular,
            ErrorKind::Grown { .. } => AnalysisCode::Growth,
            ErrorKind::Recorder(_) => AnalysisCode::Recorder,
        }
    }

    /// Whether Newton's iteration failed down to the smallest step (of time, or of load).
    pub fn is_no_convergence(&self) -> bool {
        matches!(
            self.kind,
            ErrorKind::NoConvergence { .. }
                | ErrorKind::NoEquilibrium { .. }
                | ErrorKind::UnsettledContacts { .. }
                | ErrorKind::MomentBeyondLaw { .. }
                | ErrorKind::Unbalanced { .. }
        )
    }

    /// Whether the recorder failed (for instance because the disk is full).
    pub fn is_recorder(&self) -> bool {
        matches!(self.kind, ErrorKind::Recorder(_))
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.kind {
            ErrorKind::NoConvergence { time, step, what, cure } => write!(
                f,
                "no convergence at t = {time:.9e} s with a step of {step:.3e} s: {what}; {cure}"
            ),
            ErrorKind::NoEquilibrium { share } => write!(
                f,
                "no equilibrium beyond load factor {:.4}: limit point (see `percuss static --path`), or overload",
                share
            ),
            ErrorKind::UnsettledContacts { share } => write!(
                f,
                "no equilibrium beyond load factor {share:.4}: limit point, overload, or no convergence of the forces of rigid \
                 contacts (use a compliant law)"
            ),
            ErrorKind::MomentBeyondLaw { share, beam, most } => write!(
                f,
                "no equilibrium beyond load factor {share:.4}: a section of beam `{beam}` in Green strains \
                 (strain = \"green\") carries a bending moment of at most {most:.6e} N m, \
                 2/3 EI / sqrt(6 I/A); engineering strains (strain = \"engineering\") have no such limit"
            ),
            ErrorKind::NothingHolds { body } => {
                write!(f, "no equilibrium: `{body}` is not supported (no friction in statics)")
            }
            ErrorKind::Overlap { what } => write!(f, "{what}"),
            ErrorKind::NothingLeft { share, what } => write!(
                f,
                "no equilibrium at load factor {share:.6}: {what}, and the remaining structure cannot carry the loads"
            ),
            ErrorKind::Unbalanced { left, gross } => {
                write!(f, "no equilibrium: unbalanced force {left:.3e} N of {gross:.3e} N")
            }
            ErrorKind::Singular { time, place } => {
                write!(f, "singular tangent at t = {time:.9e} s, at {place}")
            }
            ErrorKind::Grown { time, made, came } => write!(
                f,
                "energy growth: at t = {time:.6e} s {made:.4e} J above the {came:.4e} J of the start and the loads (limit: ten times). This \
                 scheme does not conserve energy; use integrator.scheme = \"energy-momentum\" or a smaller time.step"
            ),
            ErrorKind::Recorder(source) => write!(f, "the results could not be written: {source}"),
        }?;
        f.write_str(&self.after)
    }
}

impl std::error::Error for Error {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match &self.kind {
            ErrorKind::Recorder(source) => Some(source.as_ref()),
            _ => None,
        }
    }
}
