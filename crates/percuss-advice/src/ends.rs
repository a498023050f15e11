//! Coincident ends of beams that are not connected.

use super::words::digits;
use super::{Advice, Topic, Verdict};
use percuss::Model;
use percuss::inspect::{LooseEnds, loose_ends};

/// Every pair of ends where a joint is likely missing.
pub fn findings(model: &Model) -> Vec<Advice> {
    loose_ends(model).iter().map(|ends| finding(model, ends)).collect()
}

fn finding(model: &Model, ends: &LooseEnds) -> Advice {
    let ([a, b], [x, y]) = (&ends.ends, ends.position.map(digits));
    let text = format!(
        "'{a}' and '{b}' coincide at ({x}, {y}) m but are not connected; add {}",
        ends.joint()
    );
    let subject = format!("beam {}", model.beam(ends.beams[1]).name());
    Advice::new(subject, Topic::LooseEnds, [f64::NAN; 2], "m", Verdict::Warning, text)
}
