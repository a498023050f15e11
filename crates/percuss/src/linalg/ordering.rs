//! The order in which the unknowns of a sparse system are eliminated.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};

/// Nodes that each of `n` nodes is coupled with, ascending and without itself, shape (nodes, such nodes) \[index of a node\].
pub fn neighbours(n: usize, couplings: impl Iterator<Item = (usize, usize)>) -> Vec<Vec<usize>> {
    let mut known: Vec<Vec<usize>> = vec![Vec::new(); n];
    for (a, b) in couplings.filter(|(a, b)| a != b) {
        known[a].push(b);
        known[b].push(a);
    }
    for k in &mut known {
        k.sort_unstable();
        k.dedup();
    }
    known
}

/// Nodes in the order of their elimination, each time one of least degree (Tinney and Walker 1967; the first of several), and the nodes coupled
/// with each at its elimination, shape (nodes, such nodes) \[index of a node\]; `sizes` are the unknowns of the nodes, `known` their coupled nodes,
/// as [`neighbours`] gives them.
pub fn least_degree(sizes: &[usize], mut known: Vec<Vec<usize>>) -> (Vec<usize>, Vec<Vec<usize>>) {
    let n = sizes.len();
    let weight = |known: &[usize]| known.iter().map(|j| sizes[*j]).sum::<usize>();
    let mut heap: BinaryHeap<_> = (0..n).map(|g| Reverse((weight(&known[g]), g))).collect();
    let (mut order, mut gone) = (Vec::with_capacity(n), vec![false; n]);
    while let Some(Reverse((w, g))) = heap.pop() {
        if gone[g] || w != weight(&known[g]) {
            continue;
        }
        gone[g] = true;
        order.push(g);
        let left = known[g].clone();
        for i in &left {
            let mut merged: Vec<usize> =
                known[*i].iter().chain(&left).copied().filter(|j| *j != g && j != i).collect();
            merged.sort_unstable();
            merged.dedup();
            known[*i] = merged;
            heap.push(Reverse((weight(&known[*i]), *i)));
        }
    }
    (order, known)
}

/// Unknowns in an order of least degree, whose neighbours are `known`; those with the same neighbours, as of one joint, go together.
pub fn least_degree_of_unknowns(known: &[Vec<usize>]) -> Vec<usize> {
    let mut alike: BTreeMap<Vec<usize>, usize> = BTreeMap::new();
    let mut members: Vec<Vec<usize>> = Vec::new();
    let mut node_of = Vec::with_capacity(known.len());
    for (unknown, others) in known.iter().enumerate() {
        let mut all = others.clone();
        all.insert(all.partition_point(|other| *other < unknown), unknown);
        let node = *alike.entry(all).or_insert(members.len());
        if node == members.len() {
            members.push(Vec::new());
        }
        members[node].push(unknown);
        node_of.push(node);
    }
    let one = members.iter().map(|members| members[0]);
    let couplings =
        one.flat_map(|unknown| known[unknown].iter().map(move |other| (unknown, other)));
    let couplings = couplings.map(|(a, b)| (node_of[a], node_of[*b]));
    let sizes: Vec<usize> = members.iter().map(Vec::len).collect();
    let (order, _) = least_degree(&sizes, neighbours(members.len(), couplings));
    order.into_iter().flat_map(|node| members[node].iter().copied()).collect()
}
