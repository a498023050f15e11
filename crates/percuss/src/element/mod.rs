//! The beam element: pure functions on stack arrays.
//!
//! The schemes ([`energy_momentum`], [`strain_rate`], [`collocation`]) turn the two ends of a step into generalised forces at a
//! Gauss point, [`gauss`] adds them over an element, [`beam`] holds its constants, [`membrane`] adds the membrane strains of slender ones,
//! [`given_strain`] those that heat gives. Shear-flexible elements have strains of their own
//! ([`shear`]).

// Items that only `internals` re-exports have no documentation.
#[allow(missing_docs)]
pub mod beam;
#[allow(missing_docs)]
pub mod collocation;
#[allow(missing_docs)]
pub mod energy_momentum;
pub mod fibre;
#[allow(missing_docs)]
pub mod gauss;
pub mod given_strain;
#[allow(missing_docs)]
pub mod invariant;
#[allow(missing_docs)]
pub mod mapped;
#[allow(missing_docs)]
pub mod membrane;
#[allow(missing_docs)]
pub mod motion;
#[allow(missing_docs)]
pub mod point;
#[allow(missing_docs)]
pub mod rotary;
pub mod shear;
pub mod strain;
#[allow(missing_docs)]
pub mod strain_rate;
#[allow(missing_docs)]
pub mod yielding;
