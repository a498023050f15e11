//! Where a path ends.

use crate::model::Model;
use crate::settings::PathEnd;

/// Condition that ends a path.
pub(super) enum Goal {
    Factor(f64),
    Displacement { point: usize, component: usize, value: f64 },
}

impl Goal {
    pub(super) fn new(model: &Model, end: &PathEnd) -> Option<Self> {
        Some(match end {
            PathEnd::Factor(factor) => Self::Factor(*factor),
            PathEnd::Displacement { point, component, value } => Self::Displacement {
                point: model.points.iter().position(|p| p.label == *point)?,
                component: component.checked_sub(1).filter(|c| *c < 2)?,
                value: *value,
            },
        })
    }
}
