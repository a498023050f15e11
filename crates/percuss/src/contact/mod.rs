//! Contact: laws, gradients of gaps over a step, the problem of impulses, the search for close pairs.

mod crush;
pub mod discrete_gradient;
pub mod free_gap;
pub mod impact;
pub mod law;
pub mod search;
