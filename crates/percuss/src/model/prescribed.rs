//! Prescribed values that follow from others: they agree at all times, or contradict each other.

use std::collections::{BTreeMap, BTreeSet};

use super::builder::ModelBuilder;
use super::fault::Fault;
use super::frozen::{Drive, Model};
use crate::math::vec2::norm;

/// Values that differ by less than this share of the motions are the same.
const SAME: f64 = 1e-9;

/// Supports with prescribed values, and the contradictions found.
#[derive(Default)]
pub(super) struct Prescribed {
    /// Supports that fix the directions of each node, in the order of the directions, shape (directions held at the node) \[index of a support\].
    pub at_nodes: BTreeMap<usize, Vec<usize>>,
    /// Contradictions: place, and the supports in conflict.
    found: BTreeMap<String, BTreeSet<usize>>,
}

impl Prescribed {
    /// Checks the remainder of a prescribed value that the `others` imply already: it is zero at any time, or they contradict it.
    pub fn check(
        &mut self,
        builder: &ModelBuilder,
        model: &Model,
        path: &str,
        left: &Drive,
        others: impl Iterator<Item = usize>,
    ) {
        if !differs(builder, model, left) {
            return;
        }
        let moved = left.iter().filter_map(|(motion, _)| support_of(model, *motion));
        self.found.entry(path.to_owned()).or_default().extend(others.chain(moved));
    }

    /// A fault for each contradiction.
    pub fn faults(&self, model: &Model) -> Vec<Fault> {
        let fault = |(path, supports): (&String, &BTreeSet<usize>)| {
            let names: Vec<String> =
                supports.iter().map(|s| format!("`{}`", model.supports[*s].name)).collect();
            let found = format!("contradictory prescribed motions of {}", names.join(" and "));
            let expected = "supports with equal motions of their common components, at all times: remove one, or \
                            give both the same motion";
            Fault::new(path.clone(), found, expected)
        };
        self.found.iter().map(fault).collect()
    }
}

/// The support whose motion it is.
fn support_of(model: &Model, motion: usize) -> Option<usize> {
    model.supports.iter().position(|s| s.motion == Some(motion))
}

/// Whether a sum of motions differs from zero at some time.
fn differs(builder: &ModelBuilder, model: &Model, sum: &Drive) -> bool {
    let size = |motion: usize| {
        let given = support_of(model, motion).and_then(|s| builder.supports[s].motion.as_ref());
        given.map_or(1.0, |m| norm(m.displacement) + m.rotation.abs())
    };
    let mut times: Vec<f64> =
        sum.iter().flat_map(|(motion, _)| model.motions[*motion].probes()).collect();
    times.push(0.0);
    times.iter().any(|t| {
        let value = |motion: usize| model.motions[motion].value(*t);
        let total: f64 = sum.iter().map(|(m, a)| a * value(*m)).sum();
        let scale: f64 = sum.iter().map(|(m, _)| size(*m) * value(*m).abs()).sum();
        total.abs() > SAME * scale
    })
}
