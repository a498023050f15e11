//! Linear buckling with springs and stops that just touch: round-off alone would decide whether they act.

use std::fmt;

use crate::model::frozen::ConnectorLaw;

/// Gaps below this share of the length of a spring or the size of the structure are round-off: the spring touches.
pub(super) const TOUCHING: f64 = 1e-9;

/// Springs and stops of a structure in linear buckling that just touch, with different stiffnesses on either side, and that the loads do not move:
/// whether they act is decided by the buckling mode. The lower of both factors is the result.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JustTouching {
    /// Their number; those of foundations are counted one by one.
    pub count: usize,
    /// Whether the factor found is that with the smaller of their stiffnesses, as slack ones.
    pub slack: bool,
    /// The lowest factor with the other stiffness; NaN if there is none.
    pub other: f64,
}

impl fmt::Display for JustTouching {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { count, slack, other } = *self;
        let are = match count {
            1 => {
                "1 spring or stop just touches, and the loads do not move it: it counts".to_owned()
            }
            _ => format!(
                "{count} springs and stops just touch, and the loads do not move them: they count"
            ),
        };
        let [this, that] = match slack {
            true => ["slack, which gives the lower factor", "taut"],
            false => ["taut, since the structure has no factor without", "slack"],
        };
        write!(f, "{are} as {this}")?;
        match other.is_nan() {
            true => write!(f, "; as {that} there is no factor"),
            false => {
                let shown = format!("{other:.5e}").parse::<f64>().unwrap_or(other);
                write!(f, "; as {that} the lowest is {shown}")
            }
        }
    }
}

/// The smaller and the larger stiffness of a law on either side of the reference configuration, where they differ and the loads move it by
/// round-off alone.
pub(super) fn touching_laws(
    law: &ConnectorLaw,
    [from, to]: [f64; 2],
    scale: f64,
) -> Option<[ConnectorLaw; 2]> {
    if matches!(law, ConnectorLaw::Linear { .. }) || (to - from).abs() > TOUCHING * scale {
        return None;
    }
    let force = law.collocated(from, 0.0, 1.0)[0];
    let mut stiffness =
        [-1.0, 1.0].map(|side| law.stiffness_at(from + 2.0 * side * TOUCHING * scale));
    stiffness.sort_by(f64::total_cmp);
    let line = |stiffness: f64| ConnectorLaw::Linear {
        stiffness,
        rest: if stiffness == 0.0 { from } else { from - force / stiffness },
    };
    (stiffness[0] < stiffness[1]).then(|| stiffness.map(line))
}
