//! Slack tension-only and compression-only members, and open stops.

use crate::element::beam::ElementValues;
use crate::model::Model;
use crate::model::frozen::Span;
use crate::state::State;
use crate::step::fibres::fibre_strains;

/// A beam that is slack, entirely or in part: sections without stress in any fibre have mass and no stiffness.
#[derive(Clone, Debug, PartialEq)]
pub struct SlackMember {
    /// The beam.
    pub beam: String,
    /// Length of its elements that are slack \[m\].
    pub slack: f64,
    /// Its length \[m\].
    pub length: f64,
}

/// Beams that are slack in a state.
pub fn slack_members(model: &Model, state: &State) -> Vec<SlackMember> {
    let members = model.beams.iter().map(|beam| {
        let spans = model.spans[beam.spans.clone()].iter();
        let elements = spans.flat_map(|span| (0..span.elements.len()).map(move |k| (span, k)));
        let slack = elements.filter(|(span, k)| is_slack(span, *k, state));
        SlackMember {
            beam: beam.name.clone(),
            slack: slack.map(|(span, k)| span.table(k).length).sum(),
            length: beam.length,
        }
    });
    members.filter(|member| member.slack > 0.0).collect()
}

/// Whether all fibres at every Gauss point of an element are free of stress, strained to the side without resistance.
fn is_slack(span: &Span, k: usize, state: &State) -> bool {
    let Some(fibres) = &span.fibres else { return false };
    let (a, u) = (span.nodes.start + k, &state.displacement);
    let u = ElementValues::new(&u[a], &u[a + 1]);
    let strains = fibre_strains(span, k, &u);
    let of = state.fibres_of(fibres, k);
    strains.iter().enumerate().all(|(j, [membrane, bending])| {
        let own = of.at(j).filter(|(fibre, _)| fibre.carries_force);
        own.into_iter().all(|(fibre, memory)| {
            fibres.laws[fibre.law].is_slack(memory, membrane + fibre.height * bending)
        })
    })
}

/// A stop in a state.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StopState {
    /// The support's name.
    pub name: String,
    /// Whether it is closed, on either side of a two-sided one: its stiffness then acts in small motions. An open stop has none.
    pub closed: bool,
}

/// Stops in a state, in the model's order, shape (stops).
pub fn stops(model: &Model, state: &State) -> Vec<StopState> {
    let closed = |support: usize| {
        let own = model.connectors.iter().zip(&state.coordinates);
        own.filter(|(c, _)| c.support == Some(support)).any(|(c, q)| c.law.acts_at(*q))
    };
    let all = model.supports.iter().enumerate().filter(|(_, support)| support.stops);
    all.map(|(i, support)| StopState { name: support.name.clone(), closed: closed(i) }).collect()
}
