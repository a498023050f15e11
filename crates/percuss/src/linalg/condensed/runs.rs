//! Runs of nodes between interface nodes, which are eliminated onto these.

/// A run of nodes without couplings beyond the band.
#[derive(Clone, Debug)]
pub(super) struct NodeRun {
    pub(super) start: usize,
    pub(super) end: usize,
    /// Interface nodes (their slots) before and after it.
    pub(super) left: Option<usize>,
    pub(super) right: Option<usize>,
}

/// Runs of nodes between interface nodes, cut where the band is not linked.
pub(super) fn runs(n: usize, links: &impl Fn(usize) -> bool, interface: &[usize]) -> Vec<NodeRun> {
    let slot = |node: usize| interface.binary_search(&node).ok();
    let mut runs = Vec::new();
    let mut i = 0;
    while i < n {
        if slot(i).is_some() {
            i += 1;
            continue;
        }
        let start = i;
        while links(i) && i + 1 < n && slot(i + 1).is_none() {
            i += 1;
        }
        let left = if start > 0 && links(start - 1) { slot(start - 1) } else { None };
        let right = if i + 1 < n && links(i) { slot(i + 1) } else { None };
        runs.push(NodeRun { start, end: i + 1, left, right });
        i += 1;
    }
    runs
}
