//! Numbers for people.

use percuss_output::report::sheet::in_words;

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

/// A quantity with its unit as on the page, five significant digits and a prefix: `79.908 kN`, `633.7 \u{b5}s`. Units are spelled as
/// channels spell them, `N*m`.
pub fn quantity(value: f64, unit: &str) -> String {
    if value.is_finite() {
        return in_words(value, unit).replace('\u{a0}', " ");
    }
    format!("{} {}", number(value), unit.replace('*', " "))
}

/// Two significant digits, for residuals and deviations.
pub fn small(x: f64) -> String {
    if x == 0.0 { "0".into() } else { format!("{x:.1e}") }
}

/// `1 beam`, `2 beams`.
pub fn count(n: usize, noun: &str) -> String {
    if n == 1 { format!("1 {noun}") } else { format!("{n} {noun}s") }
}

/// A time by two digits, in the unit in which people say it: `3.4 s`, `12 min`, `5 h`, `3 days`.
pub fn duration(seconds: f64) -> String {
    let units = [(60.0, 1.0, "s"), (5400.0, 60.0, "min"), (172_800.0, 3600.0, "h")];
    let unit = units.iter().find(|(below, ..)| seconds < *below);
    let (_, one, name) = *unit.unwrap_or(&(0.0, 86_400.0, "days"));
    let value = seconds / one;
    if value < 10.0 { format!("{value:.1} {name}") } else { format!("{value:.0} {name}") }
}

fn without_zeros(digits: &str) -> &str {
    if digits.contains('.') { digits.trim_end_matches('0').trim_end_matches('.') } else { digits }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_reported_in_their_unit() {
        let cases = [(0.31, "0.3 s"), (42.0, "42 s"), (120.0, "2.0 min"), (5000.0, "83 min")];
        let long = [(7200.0, "2.0 h"), (864_000.0, "10 days")];
        for (seconds, text) in cases.into_iter().chain(long) {
            assert_eq!(duration(seconds), text);
        }
    }

    #[test]
    fn quantities_are_those_of_the_page() {
        let cases = [
            (79_908.03, "N", "79.908 kN"),
            (6.337_14e-4, "s", "633.71 \u{b5}s"),
            (1.489_27e8, "Pa", "148.93 MPa"),
            (0.0587, "Pa", "0.0587 Pa"),
            (-0.0, "N*m", "0 N m"),
            (f64::NAN, "m", "unknown m"),
        ];
        for (value, unit, text) in cases {
            assert_eq!(quantity(value, unit), text);
        }
    }

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
