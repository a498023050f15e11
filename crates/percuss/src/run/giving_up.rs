//! Report of a step that fails at any size: the part that did not converge, and its place.

use crate::contact::search::Search;
use crate::element::beam::ElementValues;
use crate::error::Error;
use crate::math::vec2::{add, norm};
use crate::model::Model;
use crate::state::State;
use crate::step::newton::Failure;
use crate::step::tangent::Singular;
use crate::summary::PressedIn;

/// Limit of the corrections of Newton's iteration in a step, over all its parts, impacts and cuts, after which the run ends without convergence.
pub const MOST_CORRECTIONS: usize = 100_000;

/// A stretch below this is a beam that has collapsed: its curvature has no bound as the stretch vanishes.
const COLLAPSED: f64 = 0.2;

/// Reason for the end of the run after a step of the given size has failed.
pub fn give_up(
    (model, state, search): (&Model, &State, &Search),
    failure: Failure,
    step: f64,
) -> Error {
    let place = |node: usize| {
        let beam = model.beams.iter().find(|b| b.nodes.contains(&node));
        let body = || {
            let body = node.checked_sub(model.beam_node_count());
            let body = body.and_then(|i| model.bodies.get(i));
            body.map_or_else(String::new, |b| format!("`{}`", b.name))
        };
        beam.map_or_else(body, |b| {
            let element = (node - b.nodes.start).min(b.elements.len() - 1) + 1;
            format!("element {element} of {} of beam `{}`", b.elements.len(), b.name)
        })
    };
    let time = state.time;
    match failure {
        Failure::Diverged { residual, node } => {
            let (stretch, at) = least_stretch(model, state);
            let collapsed = if stretch < COLLAPSED {
                let (beam, share) = (place(at), 100.0 * stretch);
                format!(
                    " ({beam} has collapsed: its axis is compressed to {share:.1} % of its length there)"
                )
            } else {
                String::new()
            };
            let at = place(node) + &collapsed;
            let what = if residual.is_finite() {
                format!("scaled residual {residual:.3e}, largest at {at}")
            } else {
                format!("forces overflow, first at {at}")
            };
            match deepest_pressed(model, state, search) {
                Some(deep) => Error::pressed_through(time, step, format!("{what}; {deep}")),
                None => Error::no_convergence(time, step, what),
            }
        }
        Failure::Impact => {
            let what = "no impulses satisfy the conditions of all contacts";
            Error::no_convergence(time, step, what.into())
        }
        Failure::Passed => {
            Error::no_convergence(time, step, "two bodies pass through each other".into())
        }
        Failure::Endless => {
            let what = format!(
                "its impacts and cuts do not end ({MOST_CORRECTIONS} corrections in one step)"
            );
            Error::no_convergence(time, step, what)
        }
        Failure::Singular(Singular::Node(node)) => Error::singular(time, place(node)),
        Failure::Singular(Singular::Constraints) => {
            Error::singular(time, "the joints and supports".into())
        }
    }
}

/// The compliant contact with the largest penetration, in words, if that is large for its partners.
fn deepest_pressed(model: &Model, state: &State, search: &Search) -> Option<String> {
    let deep = |i: &usize| {
        let pressed = PressedIn::of(model, *i, &state.pairs[*i], state.time)?;
        pressed.is_deep().then_some((&model.contacts[model.pairs[*i].contact], pressed))
    };
    let found = search.awake().iter().filter_map(deep);
    let (contact, pressed) = found.max_by(|a, b| a.1.share().total_cmp(&b.1.share()))?;
    let [a, b] = &contact.between;
    Some(format!(
        "penetration of contact `{}` {:.4e} m, and the axes or centres of `{a}` and `{b}` meet at {:.4e} m",
        contact.name, pressed.penetration, pressed.through
    ))
}

/// The least stretch at any Gauss point, and the first node of its element.
fn least_stretch(model: &Model, state: &State) -> (f64, usize) {
    let mut least = (f64::INFINITY, 0);
    for span in &model.spans {
        for k in 0..span.elements.len() {
            let node = span.nodes.start + k;
            let [a, b] = [node, node + 1].map(|n| &state.displacement[n]);
            let u = ElementValues::new(a, b);
            for row in &span.table(k).rows {
                let stretch = norm(add(row.reference.tangent, u.at(&row.first)));
                if stretch < least.0 {
                    least = (stretch, node);
                }
            }
        }
    }
    least
}
