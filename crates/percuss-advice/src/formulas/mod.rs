//! Hand formulas for impact on beams, each with its source: what an engineer would write on paper before, or beside, a simulation.
//!
//! Pure functions of SI quantities; none knows a model. [`advise`](crate::advise) and [`compare`](crate::compare) put them
//! beside a model and its run.

mod bar;
mod infinite_beam;
mod modal;
mod plastic;
mod pressed;
mod single_mass;
mod span;
mod two_masses;
mod wave_controlled;
mod waves;

pub use bar::BarOnWall;
pub use infinite_beam::{InfiniteBeam, InfiniteBeamImpact};
pub use modal::{ModalImpact, ModalTarget, Striker};
pub use plastic::{collapse_excess, elements_for, hinge_pole};
pub use pressed::pressed_impact;
pub use single_mass::{
    SingleMassImpact, free_bar_mass, hertz_impact, linear_impact, reduced_mass, table_impact,
};
pub use span::{Cox, Span, SpanKind, impact_factor};
pub use two_masses::{TwoMassImpact, TwoMasses};
pub use wave_controlled::WaveControlled;
pub(crate) use waves::SHEAR_AREA;
pub use waves::{BarImpact, UniformBeam, pulse_frequency, shear_stiffness};

/// Asserts that two values agree to a relative tolerance.
#[cfg(test)]
#[track_caller]
pub(crate) fn near(found: f64, expected: f64, tolerance: f64) {
    let off = (found - expected).abs() / expected.abs();
    assert!(off <= tolerance, "{found} instead of {expected}: off by {off:.1e}");
}
