//! Prescribed motions and supports that hold for a time, in a search and as a run has left them.

use super::search::{Motions, StaticSearch};
use crate::model::Model;
use crate::state::State;

impl<'m> StaticSearch<'m> {
    /// A structure in its state after a run, without loads: released supports and connections are removed, and supports have their current position.
    pub fn as_left(model: &'m Model, state: &State) -> Self {
        let mut search = Self::at_share(model, state, 0.0);
        search.motions = Motions::Left { time: state.time, followed: state.followed.clone() };
        search.set_share(0.0);
        search
    }
}
