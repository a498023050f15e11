//! The beam element: pure functions on stack arrays.
//!
//! [`kinematics`] interpolates, the schemes ([`energy_momentum`], [`strain_rate`], [`collocation`]) turn the two ends of a
//! step into generalised forces at a Gauss point, [`beam`] integrates them over an element.

pub mod beam;
pub mod collocation;
pub mod energy_momentum;
pub mod membrane;
pub mod point;
pub mod rotary;
pub mod strain;
pub mod strain_rate;
