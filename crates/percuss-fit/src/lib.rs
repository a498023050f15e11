//! Parameters of a scenario from measured curves: nonlinear least squares, and what its result is worth.
//!
//! A [`Problem`] has the scenarios of one or several tests, the parameters to be found and the records that the runs are compared with;
//! its [`residuals`](Problem::residuals) and [`jacobian`](Problem::jacobian) are functions of the free parameters, for any optimiser.
//! [`Problem::minima`] finds minima by that of `basin`, from one or several starting points; [`Problem::diagnose`] makes a [`Fit`] of
//! them: standard errors, correlations, goodness by channel, and what speaks against the result.

mod align;
mod channel;
mod covariance;
mod curve;
mod doubts;
mod error;
mod exact;
mod fit;
mod goodness;
mod jacobian;
mod json;
mod least_costs;
mod loss;
mod page;
mod parameter;
mod problem;
mod profile;
mod resolve;
mod run;
mod solve;
mod spikes;
mod spread;
mod text;
mod write;

pub use doubts::{Doubt, DoubtKind};
pub use error::{FitError, Stop};
pub use fit::{Fit, FittedParameter, Overlay};
pub use goodness::Goodness;
pub use json::fit_value;
pub use least_costs::Profile;
pub use page::fit_page;
pub use parameter::Adjustable;
pub use problem::Problem;
pub use resolve::Supplied;
pub use solve::Minimum;
pub use text::fit_text;
pub use write::write_fit;
