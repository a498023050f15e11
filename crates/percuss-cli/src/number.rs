//! Numbers for people.

/// Six significant digits, with an exponent where the plain form would be long.
pub fn number(x: f64) -> String {
    let x = x + 0.0; // -0 is 0
    if !x.is_finite() {
        return if x.is_nan() { "unknown".into() } else { x.to_string() };
    }
    let scientific = format!("{x:.5e}");
    let (digits, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    if x != 0.0 && !(-3..=5).contains(&exponent) {
        return format!("{}e{exponent}", without_zeros(digits));
    }
    let decimals = usize::try_from(5 - exponent).unwrap_or(0);
    without_zeros(&format!("{x:.decimals$}")).to_owned()
}

/// Two significant digits, for residuals and deviations.
pub fn small(x: f64) -> String {
    if x == 0.0 { "0".into() } else { format!("{x:.1e}") }
}

/// `1 beam`, `2 beams`.
pub fn count(n: usize, noun: &str) -> String {
    if n == 1 { format!("1 {noun}") } else { format!("{n} {noun}s") }
}

fn without_zeros(digits: &str) -> &str {
    if digits.contains('.') { digits.trim_end_matches('0').trim_end_matches('.') } else { digits }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn six_digits_are_kept_and_no_more() {
        let cases = [
            (0.0, "0"),
            (-0.0, "0"),
            (1.0, "1"),
            (0.15, "0.15"),
            (1e5, "100000"),
            (-100_123.456, "-100123"),
            (1e6, "1e6"),
            (123_456_789.0, "1.23457e8"),
            (0.001_234_567, "0.00123457"),
            (1e-4, "1e-4"),
            (999_999.9, "1e6"),
            (f64::NAN, "unknown"),
            (f64::INFINITY, "inf"),
        ];
        for (x, text) in cases {
            assert_eq!(number(x), text);
        }
    }
}
