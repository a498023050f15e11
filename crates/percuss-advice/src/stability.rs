//! Whether a run starts from an equilibrium that it can leave by itself.

use super::words::quantity;
use super::{Advice, Topic, Verdict};
use percuss::math::vec2::{norm, sub};
use percuss::{Equilibrium, Model, Settings, Start, equilibrium};

/// Elements beyond which the equilibrium is left to the run.
const ELEMENTS: usize = 3000;

/// Share of the structure's size beyond which the equilibrium is far from the reference configuration.
const FAR: f64 = 0.1;

/// Findings about the static start of a run: whether it is unstable, and how far it is from the reference configuration.
pub fn of_the_start(model: &Model, settings: &Settings) -> Vec<Advice> {
    let loaded = settings.start == Start::Static && model.loads().len() > 0;
    if !loaded || model.element_count() > ELEMENTS {
        return Vec::new();
    }
    let Ok(found) = equilibrium(model) else { return Vec::new() };
    unstable(&found).into_iter().chain(far(model, &found)).collect()
}

/// An unstable one. A structure without imperfection stays in it until something disturbs it, and what it
/// does then depends on nothing that is known.
fn unstable(found: &Equilibrium) -> Option<Advice> {
    if found.stable {
        return None;
    }
    let text = "the static start is an unstable equilibrium (loads above buckling); see `percuss static` for the load factor"
        .to_owned();
    let (topic, verdict) = (Topic::Stability, Verdict::Warning);
    Some(Advice::new("start", topic, [f64::NAN; 2], "1", verdict, text))
}

/// An equilibrium far from the reference configuration: most likely a part is free to rotate, and this start is not intended.
fn far(model: &Model, found: &Equilibrium) -> Option<Advice> {
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    let (mut farthest, mut place) = (0.0, String::new());
    for beam in (0..model.beam_count()).map(|k| model.beam(k)) {
        let nodes = beam.spans().flat_map(|span| span.nodes().zip(span.stations()));
        for (node, s) in nodes {
            let at = model.node_position(node);
            for i in 0..2 {
                (low[i], high[i]) = (low[i].min(at[i]), high[i].max(at[i]));
            }
            let moved = norm([0, 1].map(|i| found.state.displacement[node][i]));
            if moved > farthest {
                let name = beam.name();
                (farthest, place) = (moved, format!("beam '{name}', s = {}", quantity(*s, "m")));
            }
        }
    }
    // Projectiles and discs on springs or contacts take part in statics; others stay where they are.
    for (k, body) in model.bodies().iter().enumerate().filter(|(_, body)| body.kind.strikes()) {
        let node = model.body_node(k);
        let moved = norm([0, 1].map(|i| found.state.displacement[node][i]));
        if moved > farthest {
            let kind = if body.kind.is_disc() { "disc" } else { "projectile" };
            (farthest, place) = (moved, format!("{kind} '{}'", body.name));
        }
    }
    let size = norm(sub(high, low));
    if farthest.is_nan() || farthest <= FAR * size {
        return None;
    }
    let text = format!(
        "the static start differs from the reference configuration by {} at {place} (structure size {}); set time.start = \
         \"reference\" if not intended",
        quantity(farthest, "m"),
        quantity(size, "m")
    );
    let (topic, verdict) = (Topic::StaticStart, Verdict::Warning);
    Some(Advice::new("start", topic, [farthest, size], "m", verdict, text))
}
