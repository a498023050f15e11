//! Whether a run starts from an equilibrium that it can leave by itself.

use super::{Advice, Topic, Verdict};
use percuss::Model;
use percuss::equilibrium;
use percuss::{Settings, Start};

/// Elements beyond which the equilibrium is left to the run.
const ELEMENTS: usize = 3000;

/// An unstable equilibrium at the start. A structure without imperfection stays in it until something disturbs it, and what it
/// does then depends on nothing that is known.
pub fn of_the_start(model: &Model, settings: &Settings) -> Option<Advice> {
    let loaded = settings.start == Start::Static && model.loads().len() > 0;
    if !loaded || model.element_count() > ELEMENTS {
        return None;
    }
    let found = equilibrium(model).ok()?;
    if found.stable {
        return None;
    }
    let text = "the static equilibrium that the run starts from is unstable, the loads are beyond those under which the structure \
                buckles: the least disturbance takes it away from there; see `percuss static` for the load factor"
        .to_owned();
    let (topic, verdict) = (Topic::Stability, Verdict::Warning);
    Some(Advice::new("start", topic, [f64::NAN; 2], "1", verdict, text))
}
