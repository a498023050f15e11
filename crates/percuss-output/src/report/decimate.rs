//! Fewer rows without a lost extreme.

/// Rows that draw the same picture as all of them: per bin of consecutive rows the first, the last,
/// and those where a column is smallest or largest. Ascending; all rows if there are few.
pub(crate) fn rows(columns: &[&[f64]], n_rows: usize, bins: usize) -> Vec<usize> {
    let n_rows = columns.iter().map(|c| c.len()).fold(n_rows, usize::min);
    let kept_per_bin = 2 + 2 * columns.len();
    if n_rows <= bins * kept_per_bin {
        return (0..n_rows).collect();
    }
    let mut kept = Vec::with_capacity(bins * kept_per_bin);
    let mut of_bin = Vec::with_capacity(kept_per_bin);
    for bin in 0..bins {
        let (start, end) = (bin * n_rows / bins, (bin + 1) * n_rows / bins);
        of_bin.clear();
        of_bin.extend([start, end - 1]);
        for column in columns {
            of_bin.extend(extremes(&column[start..end]).into_iter().map(|row| start + row));
        }
        of_bin.sort_unstable();
        of_bin.dedup();
        kept.append(&mut of_bin);
    }
    kept
}

/// Where `values` is smallest and where largest, NaN left aside.
fn extremes(values: &[f64]) -> [usize; 2] {
    let first = values.iter().position(|v| !v.is_nan()).unwrap_or(0);
    let (mut at, mut low, mut high) = ([first; 2], values[first], values[first]);
    // Few values are extremes: one comparison settles most of them. Comparisons with NaN are false.
    for (row, &value) in values.iter().enumerate().skip(first) {
        if value < low || value > high {
            if value < low {
                (low, at[0]) = (value, row);
            } else {
                (high, at[1]) = (value, row);
            }
        }
    }
    at
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_histories_are_kept_whole() {
        let y: Vec<f64> = (0..400).map(f64::from).collect();
        assert_eq!(rows(&[&y], y.len(), 100), (0..400).collect::<Vec<_>>());
    }

    #[test]
    fn no_extreme_and_no_end_is_lost() {
        let mut y: Vec<f64> = (0..100_000).map(|i| (f64::from(i) * 0.37).sin()).collect();
        y[12_345] = 7.0;
        y[12_347] = -9.0;
        y[50_000] = f64::NAN;
        let kept = rows(&[&y], y.len(), 50);
        assert!(kept.len() <= 200);
        assert!(kept.windows(2).all(|pair| pair[0] < pair[1]));
        for row in [0, 12_345, 12_347, 99_999] {
            assert!(kept.contains(&row), "row {row} is lost");
        }
    }

    #[test]
    fn nan_is_no_extreme() {
        assert_eq!(extremes(&[f64::NAN, 2.0, f64::NAN, -1.0, 5.0, 5.0, -1.0]), [3, 4]);
        assert_eq!(extremes(&[f64::NAN; 3]), [0, 0]);
        assert_eq!(extremes(&[3.0]), [0, 0]);
    }

    #[test]
    fn several_columns_share_their_rows() {
        let mut columns = [vec![0.0; 10_000], vec![0.0; 10_000]];
        columns[0][3_333] = 1.0;
        columns[1][7_777] = -1.0;
        let kept = rows(&[&columns[0], &columns[1]], 10_000, 10);
        assert!(kept.contains(&3_333) && kept.contains(&7_777));
    }
}
