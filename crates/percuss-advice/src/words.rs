//! Numbers in sentences.

/// Three significant digits and a unit, with a prefix outside 1 to 10 000, stresses below 1 Pa and velocities without one: `51.2 ms`, `750 kN/m`,
/// `91.2 kg`.
pub fn quantity(value: f64, unit: &str) -> String {
    let prefixed =
        matches!(unit, "s" | "m" | "N" | "N/m" | "N/m^2" | "J" | "m/s" | "N m" | "N s" | "Pa");
    if value == 0.0 || !value.is_finite() || !prefixed {
        return format!("{} {unit}", digits(value)).trim_end().to_owned();
    }
    // The prefix is that of the number as it is shown: below 10 000 whole numbers have four digits.
    let whole = (1e3..1e4).contains(&value.abs());
    let rounded =
        if whole { value.round() } else { format!("{value:.2e}").parse().unwrap_or(value) };
    let shown = rounded.abs();
    let exponent = match (1.0..1e4).contains(&shown) {
        true => 0,
        false => (shown * (1.0 + 1e-9)).log10().floor().div_euclid(3.0) as i32,
    };
    let prefixes = ["p", "n", "\u{b5}", "m", "", "k", "M", "G", "T"];
    // mPa would be read as MPa.
    let least = if unit == "Pa" { 0 } else { -4 };
    let wanted = if unit == "m/s" { 0 } else { exponent.clamp(least, 4) };
    let prefix = usize::try_from(wanted + 4).ok().and_then(|k| prefixes.get(k)).unwrap_or(&"");
    format!("{} {prefix}{unit}", digits(value * 1000_f64.powi(-wanted)))
}

/// Three significant digits.
pub fn digits(value: f64) -> String {
    let value = value + 0.0; // -0 is 0
    if value == 0.0 || !value.is_finite() {
        return value.to_string();
    }
    let exponent = value.abs().log10().floor();
    if !(-3.0..5.0).contains(&exponent) {
        return format!("{value:.2e}");
    }
    let decimals = (2.0 - exponent).max(0.0) as usize;
    let text = format!("{value:.decimals$}");
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

/// `value` rounded down to one significant digit of 1, 2 or 5: a step or a length that reads well.
pub fn round_down(value: f64) -> f64 {
    let power = 10_f64.powf(value.log10().floor());
    let factor = [5.0, 2.0, 1.0].into_iter().find(|f| f * power <= value * (1.0 + 1e-9));
    factor.unwrap_or(1.0) * power
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantities_read_as_an_engineer_writes_them() {
        let cases = [
            (0.0512, "s", "51.2 ms"),
            (7.5e5, "N/m", "750 kN/m"),
            (91.158, "kg", "91.2 kg"),
            (0.0, "m", "0 m"),
            (-0.0, "kg", "0 kg"),
            (1e-4, "s", "100 \u{b5}s"),
            (0.0587, "Pa", "0.0587 Pa"),
            (1e3, "N", "1000 N"),
            (3195.4, "N", "3195 N"),
            (9999.7, "N", "10 kN"),
            (0.9996, "m", "1 m"),
            (999_600.0, "J", "1 MJ"),
            (0.002, "m/s", "0.002 m/s"),
            (3.2, "", "3.2"),
        ];
        for (value, unit, text) in cases {
            assert_eq!(quantity(value, unit), text);
        }
    }

    #[test]
    fn recommended_values_are_round_and_not_above() {
        for (value, round) in [(0.0512, 0.05), (4.9e-6, 2e-6), (1e-3, 1e-3), (1.9, 1.0)] {
            assert!((round_down(value) / round - 1.0).abs() < 1e-12, "{value}");
        }
    }
}
