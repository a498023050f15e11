//! Ends of beams that lie at one place and that nothing joins.

use super::words::digits;
use super::{Advice, Topic, Verdict};
use percuss::Model;
use percuss::inspect::{LooseEnds, loose_ends};

/// Every pair of ends that looks like a joint that was left out.
pub fn findings(model: &Model) -> Vec<Advice> {
    loose_ends(model).iter().map(|ends| finding(model, ends)).collect()
}

fn finding(model: &Model, ends: &LooseEnds) -> Advice {
    let ([a, b], [x, y]) = (&ends.ends, ends.position.map(digits));
    let text = format!(
        "`{a}` and `{b}` lie at one place, ({x}, {y}) m, and nothing joins them: each moves as if the other were not there; add {}",
        ends.joint()
    );
    let subject = format!("beam {}", model.beam(ends.beams[1]).name());
    Advice::new(subject, Topic::LooseEnds, [f64::NAN; 2], "m", Verdict::Warning, text)
}
