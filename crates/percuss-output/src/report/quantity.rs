//! Numbers with units, for people: `337.784 kN`, `66.4362 ms`, `2.1e-12`.

pub(crate) use crate::round_off::without_round_off;

/// Factor and unit in which a quantity is shown.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Scale {
    /// Shown value = SI value * factor.
    pub factor: f64,
    /// Unit as shown; empty for a pure number.
    pub unit: String,
}

/// Between a number and its unit: never broken across lines.
const NBSP: &str = "\u{a0}";

const PREFIXES: [(i32, &str); 9] = [
    (-12, "p"),
    (-9, "n"),
    (-6, "\u{b5}"),
    (-3, "m"),
    (0, ""),
    (3, "k"),
    (6, "M"),
    (9, "G"),
    (12, "T"),
];

impl Scale {
    /// The scale for values up to `largest` in magnitude, of `unit` as channels spell it.
    ///
    /// Units with a prefix keep values between 1 and 10 000; others get a power of ten outside
    /// 0.01 to 100 000.
    pub(crate) fn new(largest: f64, unit: &str) -> Self {
        let pretty = pretty(unit);
        let largest = largest.abs();
        if !(largest.is_finite() && largest > 0.0) {
            return Self { factor: 1.0, unit: pretty };
        }
        let exponent = 3 * (largest.log10() / 3.0).floor() as i32;
        if takes_prefix(unit) {
            if (1.0..1e4).contains(&largest) {
                return Self { factor: 1.0, unit: pretty };
            }
            // Stresses are never shown in millipascals: those below 1 Pa are round-off or no stresses. Nor are forces and stiffnesses per length.
            let least = if matches!(unit, "Pa" | "N/m" | "N/m^2") { 0 } else { -12 };
            let exponent = exponent.clamp(least, 12);
            let prefix = PREFIXES.iter().find(|(e, _)| *e == exponent).map_or("", |(_, p)| p);
            return Self { factor: 10f64.powi(-exponent), unit: format!("{prefix}{pretty}") };
        }
        if (1e-2..1e5).contains(&largest) {
            return Self { factor: 1.0, unit: pretty };
        }
        let power = format!("10{}", superscript(exponent));
        let unit = if pretty.is_empty() { power } else { format!("{power} {pretty}") };
        Self { factor: 10f64.powi(-exponent), unit }
    }
}

/// Whether a unit is shown with a prefix.
fn takes_prefix(unit: &str) -> bool {
    matches!(unit, "s" | "m" | "m/s" | "N" | "N*s" | "J" | "N*m" | "Pa" | "N/m" | "N/m^2")
}

/// `value` of `unit` in words, five significant digits.
pub(crate) fn quantity(value: Option<f64>, unit: &str) -> String {
    spelled(value, unit).replace(' ', NBSP)
}

fn spelled(value: Option<f64>, unit: &str) -> String {
    let Some(value) = value.filter(|v| v.is_finite()) else { return "\u{2013}".to_owned() };
    // A velocity of 50 mm/s is written 0.05 m/s beside others of the run.
    if !takes_prefix(unit) || unit == "m/s" {
        return format!("{} {}", number(value), pretty(unit)).trim_end().to_owned();
    }
    if value != 0.0 && !(1e-12..1e15).contains(&value.abs()) {
        return format!("{} {}", number(value), pretty(unit));
    }
    // The prefix is that of the number as it is shown: 9999.9999 N are 10 kN.
    let shown = format!("{value:.4e}").parse().unwrap_or(value);
    let scale = Scale::new(shown, unit);
    format!("{} {}", number(value * scale.factor), scale.unit)
}

/// Five significant digits, plain where that is short, else with an exponent.
pub(crate) fn number(value: f64) -> String {
    digits(value, 5)
}

/// Digits of what may lie close together: instants, ticks of an enlarged axis.
pub(crate) fn fine_number(value: f64) -> String {
    digits(value, 7)
}

fn digits(value: f64, significant: i32) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let exponent = value.abs().log10().floor();
    if !(-4.0..9.0).contains(&exponent) {
        let text = format!("{value:.3e}");
        let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
        return format!("{}e{exponent}", trim(digits));
    }
    let value = if exponent < f64::from(significant) {
        value
    } else {
        format!("{value:.*e}", significant as usize - 1).parse().unwrap_or(value)
    };
    let decimals = (f64::from(significant - 1) - exponent).max(0.0) as usize;
    trim(&format!("{value:.decimals$}")).to_owned()
}

fn trim(digits: &str) -> &str {
    if digits.contains('.') { digits.trim_end_matches('0').trim_end_matches('.') } else { digits }
}

/// `kg*m^2/s` as `kg m\u{b2}/s`.
pub(crate) fn pretty(unit: &str) -> String {
    match unit {
        "1" => String::new(),
        _ => unit.replace('*', " ").replace("^2", "\u{b2}").replace("^4", "\u{2074}"),
    }
}

fn superscript(exponent: i32) -> String {
    let digit = |c: char| match c {
        '-' => '\u{207b}',
        '1' => '\u{b9}',
        '2' => '\u{b2}',
        '3' => '\u{b3}',
        other => char::from_u32(0x2070 + other.to_digit(10).unwrap_or(0)).unwrap_or(other),
    };
    exponent.to_string().chars().map(digit).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantities_read_as_an_engineer_writes_them() {
        let quantity = |value, unit| super::quantity(value, unit).replace(NBSP, " ");
        assert_eq!(quantity(Some(337_784.605), "N"), "337.78 kN");
        assert_eq!(quantity(Some(3814.98), "N*s"), "3815 N s");
        // The prefix is that of the rounded number.
        assert_eq!(quantity(Some(9999.9999), "N"), "10 kN");
        assert_eq!(quantity(Some(-0.999_999_9), "m"), "-1 m");
        assert_eq!(quantity(Some(0.0664362), "s"), "66.436 ms");
        assert_eq!(quantity(Some(-19.10077444), "m/s"), "-19.101 m/s");
        assert_eq!(quantity(Some(0.050_62), "m/s"), "0.05062 m/s");
        assert_eq!(quantity(Some(10_000.0), "kg*m/s"), "10000 kg m/s");
        assert_eq!(quantity(Some(163_849.3), "1"), "163850");
        assert_eq!(quantity(Some(2.13e-12), "1"), "2.13e-12");
        assert_eq!(quantity(Some(0.0), "m"), "0 m");
        assert_eq!(quantity(Some(0.0587), "Pa"), "0.0587 Pa");
        assert_eq!(quantity(Some(-4.2e-9), "Pa"), "-4.2e-9 Pa");
        assert_eq!(quantity(Some(2.35e8), "Pa"), "235 MPa");
        assert_eq!(quantity(None, "m"), "\u{2013}");
        assert_eq!(quantity(Some(f64::INFINITY), "kg"), "\u{2013}");
        assert_eq!(quantity(Some(1e-300), "J"), "1e-300 J");
    }

    /// The same cases test the scripts of the page (scene.test.mjs) and the Python package (test_words.py).
    #[test]
    fn quantities_are_the_same_everywhere() {
        let cases: Vec<(f64, String, String)> =
            serde_json::from_str(include_str!("../../tests/quantities.json")).unwrap();
        for (value, unit, text) in cases {
            assert_eq!(super::quantity(Some(value), &unit).replace(NBSP, " "), text);
        }
    }

    #[test]
    fn axes_keep_their_ticks_short() {
        let scale = |largest, unit| {
            let s = Scale::new(largest, unit);
            (s.factor.log10().round() as i32, s.unit)
        };
        assert_eq!(scale(0.15, "s"), (3, "ms".to_owned()));
        assert_eq!(scale(1e5, "J"), (-3, "kJ".to_owned()));
        assert_eq!(scale(-4000.0, "kg*m/s"), (0, "kg m/s".to_owned()));
        assert_eq!(scale(2e-13, "1"), (15, "10\u{207b}\u{b9}\u{2075}".to_owned()));
        assert_eq!(scale(0.0, "N"), (0, "N".to_owned()));
        assert_eq!(scale(3e-20, "m"), (12, "pm".to_owned()));
    }
}
