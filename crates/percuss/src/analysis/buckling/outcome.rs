//! Result of linear buckling in words.

use percuss_codes::Caution;

/// Result of linear buckling.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum BucklingOutcome {
    /// The lowest factors, none left out: by count of the negative pivots of the tangent.
    Found,
    /// No positive factor up to `up_to`, at which strains of the linear response reach one: by count, the tangent has no negative
    /// pivot there.
    Never {
        /// Largest factor in the search.
        up_to: f64,
    },
    /// The loads move the structure on its springs, and strain it by round-off only; no positive factor where this round-off has no influence.
    Unstrained,
    /// No load acts at time zero.
    Unloaded,
    /// Follower loads: they have no potential, and the structure may flutter at a load without another equilibrium. Modes about the loaded
    /// equilibrium show it.
    Follower,
    /// The unloaded structure is a mechanism.
    Mechanism,
    /// The unloaded structure is unstable, due to prestressed springs.
    Unstable,
    /// A material yields or carries stress of one sign only, so that its stiffness is not constant up to a factor; or a section is given by fibres,
    /// which the search does not support.
    Inelastic,
    /// The search did not find all counted factors.
    Unfinished,
}

impl BucklingOutcome {
    /// Its code in the catalogue, if no factor is available although loads act.
    pub fn code(self) -> Option<Caution> {
        match self {
            Self::Found | Self::Never { .. } | Self::Unstrained | Self::Unloaded => None,
            Self::Follower
            | Self::Mechanism
            | Self::Unstable
            | Self::Inelastic
            | Self::Unfinished => Some(Caution::NoBuckling),
        }
    }

    /// One sentence for people; empty if a factor was found.
    pub fn reason(self) -> Option<String> {
        Some(match self {
            Self::Found => return None,
            Self::Never { up_to } => {
                let shown = format!("{up_to:.3e}").parse::<f64>().unwrap_or(up_to);
                format!(
                    "no linear buckling: the tangent stiffness stays positive up to {shown} times the loads, where strains reach one"
                )
            }
            Self::Unstrained => "no linear buckling: the loads move the structure on its springs and do not strain it".into(),
            Self::Unloaded => "no linear buckling: no load acts".into(),
            Self::Follower => "no linear buckling factor: follower loads have no potential (flutter is possible); see the modes about the static \
                 equilibrium"
                .into(),
            Self::Mechanism => "no linear buckling factor: the unloaded structure is a mechanism".into(),
            Self::Unstable => "no linear buckling factor: the structure is unstable without loads".into(),
            Self::Inelastic => "no linear buckling factor: parts of the structure yield, bear tension or compression alone, or have fibre sections; see `percuss static --path`"
                .into(),
            Self::Unfinished => "the search did not find all linear buckling factors".into(),
        })
    }
}
