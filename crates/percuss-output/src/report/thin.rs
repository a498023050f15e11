//! Fewer rows while they go by: what [`decimate::rows`] does to columns in memory.

use super::decimate;

/// Rows of a bin held before they are reduced to its ends and extremes.
const HELD: usize = 4096;

/// Keeps, per bin of consecutive rows, the first, the last, and those where a curve is smallest or
/// largest; all rows if there are few.
#[derive(Debug)]
pub(super) struct Thinner {
    n_rows: usize,
    bins: usize,
    /// Bin being filled, and rows seen so far.
    bin: usize,
    seen: usize,
    /// Rows of the bin, and rows kept for good; shape (1 + n_curves, ..), abscissa first.
    held: Vec<Vec<f64>>,
    kept: Vec<Vec<f64>>,
}

impl Thinner {
    /// For `n_curves` curves of `n_rows` rows.
    pub(super) fn new(n_curves: usize, n_rows: usize, bins: usize) -> Self {
        let few = n_rows <= bins * (2 + 2 * n_curves);
        let bins = if few { n_rows } else { bins }.max(1);
        let empty = vec![Vec::new(); 1 + n_curves];
        Self { n_rows, bins, bin: 0, seen: 0, held: empty.clone(), kept: empty }
    }

    /// Takes the next rows; `piece` has the shape of `held`.
    pub(super) fn push(&mut self, piece: &[Vec<f64>]) {
        let length = piece.iter().map(Vec::len).min().unwrap_or(0);
        let mut start = 0;
        while start < length {
            let bin_end = (self.bin + 1).saturating_mul(self.n_rows) / self.bins;
            let end = length.min(start + bin_end.saturating_sub(self.seen).max(1));
            for (held, column) in self.held.iter_mut().zip(piece) {
                held.extend_from_slice(&column[start..end]);
            }
            self.seen += end - start;
            start = end;
            if self.seen >= bin_end {
                self.close_bin();
            } else if self.held[0].len() >= HELD {
                self.reduce();
            }
        }
    }

    /// The rows kept: the abscissa, then the curves.
    pub(super) fn finish(mut self) -> (Vec<f64>, Vec<Vec<f64>>) {
        self.close_bin();
        let curves = self.kept.split_off(1);
        (self.kept.pop().unwrap_or_default(), curves)
    }

    fn close_bin(&mut self) {
        self.reduce();
        for (kept, held) in self.kept.iter_mut().zip(&mut self.held) {
            kept.append(held);
        }
        self.bin += 1;
    }

    /// To ends and extremes; doing so again loses nothing.
    fn reduce(&mut self) {
        let curves: Vec<&[f64]> = self.held[1..].iter().map(Vec::as_slice).collect();
        let rows = decimate::rows(&curves, self.held[0].len(), 1);
        for column in &mut self.held {
            for (to, &from) in rows.iter().enumerate() {
                column[to] = column[from]; // ascending, so never one that was overwritten
            }
            column.truncate(rows.len());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_give_what_the_whole_gives() {
        let n = 100_000;
        let x: Vec<f64> = (0..n).map(f64::from).collect();
        let y: Vec<f64> = x.iter().map(|x| (x * 0.37).sin() + (x * 0.01).cos()).collect();
        let z: Vec<f64> = x.iter().map(|x| (x * 0.71).cos()).collect();
        for bins in [1, 7, 50, 100_000] {
            let whole = decimate::rows(&[&y, &z], x.len(), bins);
            for length in [1, 999, 8192, 100_000] {
                let mut thinner = Thinner::new(2, x.len(), bins);
                for start in (0..x.len()).step_by(length) {
                    let piece = |c: &[f64]| c[start..x.len().min(start + length)].to_vec();
                    thinner.push(&[piece(&x), piece(&y), piece(&z)]);
                }
                let (kept, curves) = thinner.finish();
                let rows: Vec<usize> = kept.iter().map(|x| *x as usize).collect();
                assert_eq!(rows, whole, "{bins} bins, pieces of {length}");
                assert!(rows.iter().zip(&curves[0]).all(|(&row, value)| y[row] == *value));
            }
        }
    }
}
