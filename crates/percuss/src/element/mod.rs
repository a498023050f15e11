//! The beam element: pure functions on stack arrays.
//!
//! The schemes ([`energy_momentum`], [`strain_rate`], [`collocation`]) turn the two ends of a step into generalised forces at a
//! Gauss point, [`beam`] integrates them over an element, [`membrane`] adds the membrane strains of slender ones.

pub mod beam;
pub mod collocation;
pub mod elastic;
pub mod energy_momentum;
pub mod fibre;
pub mod mapped;
pub mod membrane;
pub mod motion;
pub mod point;
pub mod rotary;
pub mod strain;
pub mod strain_rate;
pub mod yielding;
