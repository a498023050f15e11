//! Prescribed motions and supports that hold for a time, in a search and as a run has left them.

use super::search::{Motions, StaticSearch};
use crate::model::Model;
use crate::state::State;

impl<'m> StaticSearch<'m> {
    /// A structure as a run has left it, without loads: what has let go by then holds it no more, and supports stand where they are.
    pub fn as_left(model: &'m Model, state: &State) -> Self {
        let mut search = Self::at_share(model, state, 0.0);
        search.motions = Motions::Left { time: state.time, followed: state.followed.clone() };
        search.set_share(0.0);
        search
    }
}
