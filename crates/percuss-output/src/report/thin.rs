//! Fewer rows while they go by: what [`decimate::rows`] does to columns in memory.

use super::decimate;

/// Rows of a bin held before they are reduced to its ends and extremes.
const HELD: usize = 4096;

/// Bins of consecutive rows: even ones, and finer ones while anything touches.
#[derive(Clone, Debug, Default)]
pub(super) struct Bins {
    /// Row behind the last one of each bin, ascending; the last is the number of rows, shape (bins) \[index of a row\].
    ends: Vec<usize>,
    /// As many bins as were asked for.
    asked: usize,
}

impl Bins {
    /// `bins` bins of `n_rows` rows.
    pub(super) fn even(n_rows: usize, bins: usize) -> Self {
        let bins = bins.clamp(1, n_rows.max(1));
        Self { ends: (1..=bins).map(|k| k * n_rows / bins).collect(), asked: bins }
    }

    /// About `bins` bins in effort of drawing, half of them spread over all rows and half over those within `windows` (from, to) of
    /// time, where each row is a bin of its own if they are few enough; what is zoomed into there is the curve as it was recorded.
    pub(super) fn finer_within(time: &[f64], windows: &[[f64; 2]], bins: usize) -> Self {
        let within = rows_within(time, windows);
        let rows: usize = within.iter().map(|[from, to]| to - from).sum();
        if rows == 0 {
            return Self::even(time.len(), bins);
        }
        // A bin of one row keeps one row, others at least four.
        let size = if rows <= 2 * bins { 1 } else { rows.div_ceil((bins / 2).max(1)) };
        let mut ends = Self::even(time.len(), (bins / 2).max(1)).ends;
        for [from, to] in within {
            ends.extend((from..to).step_by(size).filter(|end| *end > 0));
            ends.push(to);
        }
        ends.sort_unstable();
        ends.dedup();
        Self { ends, asked: bins }
    }

    fn rows(&self) -> usize {
        self.ends.last().copied().unwrap_or(0)
    }
}

/// Ranges of rows within the windows, apart and ascending; `time` ascends.
fn rows_within(time: &[f64], windows: &[[f64; 2]]) -> Vec<[usize; 2]> {
    let row = |t: f64| time.partition_point(|other| *other < t);
    let mut ranges: Vec<[usize; 2]> =
        windows.iter().map(|[from, to]| [row(*from), (row(*to) + 1).min(time.len())]).collect();
    ranges.sort_unstable();
    let mut apart: Vec<[usize; 2]> = Vec::new();
    for [from, to] in ranges.into_iter().filter(|[from, to]| from < to) {
        match apart.last_mut() {
            Some(last) if from <= last[1] => last[1] = last[1].max(to),
            _ => apart.push([from, to]),
        }
    }
    apart
}

/// Keeps, per bin of consecutive rows, the first, the last, and those where a curve is smallest or
/// largest; all rows if there are few.
#[derive(Debug)]
pub(super) struct Thinner<'a> {
    bins: &'a Bins,
    /// Whether all rows stay.
    whole: bool,
    /// Bin being filled, and rows seen so far.
    bin: usize,
    seen: usize,
    /// Rows of the bin, and rows kept for good; shape (1 + n_curves, ..) \[unit of the curve\], abscissa first.
    held: Vec<Vec<f64>>,
    /// Rows kept for good, abscissa first, shape (1 + n_curves, rows kept) \[unit of the curve\].
    kept: Vec<Vec<f64>>,
}

impl<'a> Thinner<'a> {
    /// For `n_curves` curves over the rows of `bins`.
    pub(super) fn new(n_curves: usize, bins: &'a Bins) -> Self {
        let whole = bins.rows() <= bins.asked * (2 + 2 * n_curves);
        let empty = vec![Vec::new(); 1 + n_curves];
        Self { bins, whole, bin: 0, seen: 0, held: empty.clone(), kept: empty }
    }

    /// Takes the next rows; `piece` has the shape of `held`.
    pub(super) fn push(&mut self, piece: &[Vec<f64>]) {
        let length = piece.iter().map(Vec::len).min().unwrap_or(0);
        if self.whole {
            return self.keep_all(piece);
        }
        let mut start = 0;
        while start < length {
            let bin_end = self.bins.ends.get(self.bin).copied().unwrap_or(usize::MAX);
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

    fn keep_all(&mut self, piece: &[Vec<f64>]) {
        for (kept, column) in self.kept.iter_mut().zip(piece) {
            kept.extend_from_slice(column);
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
                let even = Bins::even(x.len(), bins);
                let mut thinner = Thinner::new(2, &even);
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

    #[test]
    fn rows_of_a_contact_are_all_kept() {
        let n = 200_000;
        let time: Vec<f64> = (0..n).map(|i| 1e-5 * f64::from(i)).collect();
        let y: Vec<f64> = time.iter().map(|t| (2e4 * t).sin()).collect();
        let window = [0.50001, 0.50999]; // 1000 rows
        let bins = Bins::finer_within(&time, &[window, [0.505, 0.506]], 1000);
        let mut thinner = Thinner::new(1, &bins);
        thinner.push(&[time.clone(), y]);
        let (kept, _) = thinner.finish();
        let inside = |t: &&f64| (window[0]..=window[1]).contains(*t);
        assert_eq!(kept.iter().filter(inside).count(), time.iter().filter(inside).count());
        assert!(kept.len() < 4000, "{} rows", kept.len());
        assert_eq!((kept[0], kept[kept.len() - 1]), (time[0], time[time.len() - 1]));
    }

    #[test]
    fn long_contacts_do_not_take_more_than_their_half() {
        let n = 200_000;
        let time: Vec<f64> = (0..n).map(f64::from).collect();
        let bins = Bins::finer_within(&time, &[[0.0, 150_000.0]], 1000);
        assert!(bins.ends.len() <= 1002, "{}", bins.ends.len());
        assert_eq!(bins.rows(), time.len());
    }
}
