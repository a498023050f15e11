//! Layout: runs between interface nodes, blocks between them, joints. Determined once.

use super::super::block::ZERO;
use super::super::cluster::Cluster;
use super::{BorderPattern, Condensed, LARGEST_CLUSTER};

impl Condensed {
    /// Pairs of slots that share a block in the interface system.
    pub(super) fn find_blocks(&mut self) {
        let mut pairs: Vec<(usize, usize)> = (0..self.interface.len()).map(|i| (i, i)).collect();
        let both = |a: usize, b: usize| [(a, b), (b, a)];
        for (i, adjacent) in self.adjacent.iter().enumerate() {
            if *adjacent {
                pairs.extend(both(i, i + 1));
            }
        }
        for run in &self.runs {
            if let (Some(a), Some(b)) = (run.left, run.right) {
                pairs.extend(both(a, b));
            }
        }
        pairs.extend(self.couplings.iter().map(|(a, b, _)| (self.slot(*a), self.slot(*b))));
        pairs.sort_unstable();
        pairs.dedup();
        self.blocks = pairs.into_iter().map(|(a, b)| (a, b, ZERO)).collect();
    }

    /// Gathers interface nodes that permanent constraints tie to each other.
    pub(super) fn find_clusters(&mut self, border: &[BorderPattern]) {
        let n = self.interface.len();
        let mut leader: Vec<usize> = (0..n).collect();
        fn find(leader: &mut [usize], mut i: usize) -> usize {
            while leader[i] != i {
                leader[i] = leader[leader[i]];
                i = leader[i];
            }
            i
        }
        let tying = border.iter().enumerate().filter(|(k, _)| !self.is_nodal(*k));
        let tying: Vec<(usize, &BorderPattern)> = tying.collect();
        for (_, b) in tying.iter().filter(|(_, b)| b.permanent) {
            let first = find(&mut leader, self.slot(b.nodes[0]));
            for node in &b.nodes[1..] {
                let other = find(&mut leader, self.slot(*node));
                leader[first.max(other)] = first.min(other);
            }
        }
        let leaders: Vec<usize> = (0..n).map(|i| find(&mut leader, i)).collect();
        let mut members = vec![Vec::new(); n];
        leaders.iter().enumerate().for_each(|(i, l)| members[*l].push(i));
        let mut constraints = vec![Vec::new(); n];
        for (k, b) in tying {
            let l = leaders[self.slot(b.nodes[0])];
            let fits = 4 * members[l].len() <= LARGEST_CLUSTER;
            if b.permanent && fits { constraints[l].push(k) } else { self.border.push(k) }
        }
        self.home = vec![(0, 0); n];
        let mut first = 0;
        for l in 0..n {
            let reduced = std::mem::take(&mut constraints[l]);
            let slots = std::mem::take(&mut members[l]);
            let groups = if reduced.is_empty() {
                slots.into_iter().map(|s| vec![s]).collect()
            } else {
                vec![slots]
            };
            for slots in groups {
                slots
                    .iter()
                    .enumerate()
                    .for_each(|(i, s)| self.home[*s] = (self.clusters.len(), i));
                let cluster = Cluster::new(slots, reduced.clone(), first);
                first += cluster.size();
                self.clusters.push(cluster);
            }
        }
    }

    /// Places of the reduced system that are not zero.
    pub(super) fn schur_entries(&self) -> Vec<(usize, usize)> {
        let mut pairs: Vec<(usize, usize)> =
            self.blocks.iter().map(|(a, b, _)| (self.home[*a].0, self.home[*b].0)).collect();
        pairs.sort_unstable();
        pairs.dedup();
        let range = |c: usize| {
            let cluster = &self.clusters[c];
            cluster.first..cluster.first + cluster.size()
        };
        let mut entries = Vec::new();
        for (a, b) in pairs {
            entries.extend(range(a).flat_map(|i| range(b).map(move |j| (i, j))));
        }
        let first = self.reduced_nodes();
        for (k, c) in self.border.iter().enumerate() {
            entries.push((first + k, first + k));
            for (node, _) in &self.columns[*c] {
                let both = |i| [(i, first + k), (first + k, i)];
                entries.extend(range(self.home[self.slot(*node)].0).flat_map(both));
            }
        }
        entries
    }
}
