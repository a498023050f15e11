//! Contact: laws, gaps and their gradients, the problem of impulses, the search for what is near.

pub mod axis;
pub mod configuration;
pub mod discrete_gradient;
pub mod edge;
pub mod effective_mass;
pub mod free_gap;
pub mod impact;
pub mod law;
pub mod pair;
pub mod placed;
pub mod row;
pub mod search;
pub mod touch;
pub mod turning;
