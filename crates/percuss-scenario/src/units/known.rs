//! The units known, their prefixes and the words people write instead.

use super::Dimension;
use crate::suggest;

/// A unit as `10^power10 * numerator / denominator` of the coherent SI unit.
#[derive(Clone, Copy)]
pub(super) struct Unit {
    pub dimension: Dimension,
    pub power10: i32,
    pub numerator: f64,
    pub denominator: f64,
}

impl Unit {
    /// The unit of a pure number.
    pub const ONE: Self = Self::new(0, 0, 0, 0, 1.0, 1.0);

    const fn new(m: i32, kg: i32, s: i32, power10: i32, numerator: f64, denominator: f64) -> Self {
        Self { dimension: Dimension::new(m, kg, s), power10, numerator, denominator }
    }

    /// Product of two units.
    pub fn times(self, other: Self) -> Self {
        Self {
            dimension: self.dimension.times(other.dimension),
            power10: self.power10.saturating_add(other.power10),
            numerator: self.numerator * other.numerator,
            denominator: self.denominator * other.denominator,
        }
    }

    /// Power of a unit.
    pub fn power(self, n: i32) -> Self {
        let mut out = Self::ONE;
        for _ in 0..n.abs() {
            out = out.times(self);
        }
        if n >= 0 {
            return out;
        }
        Self {
            dimension: out.dimension.inverse(),
            power10: out.power10.saturating_neg(),
            numerator: out.denominator,
            denominator: out.numerator,
        }
    }

    /// Square root of a unit; `None` for the root of a root.
    pub fn root(self) -> Option<Self> {
        let odd = if self.power10 % 2 == 0 { 1.0 } else { f64::sqrt(10.0) };
        Some(Self {
            dimension: self.dimension.root()?,
            power10: self.power10.div_euclid(2),
            numerator: self.numerator.sqrt() * odd,
            denominator: self.denominator.sqrt(),
        })
    }
}

/// Units that take SI prefixes.
const PREFIXABLE: &[(&str, Unit)] = &[
    ("m", Unit::new(1, 0, 0, 0, 1.0, 1.0)),
    ("g", Unit::new(0, 1, 0, -3, 1.0, 1.0)),
    ("s", Unit::new(0, 0, 1, 0, 1.0, 1.0)),
    ("N", Unit::new(1, 1, -2, 0, 1.0, 1.0)),
    ("Nm", Unit::new(2, 1, -2, 0, 1.0, 1.0)),
    ("Ns", Unit::new(1, 1, -1, 0, 1.0, 1.0)),
    ("Pa", Unit::new(-1, 1, -2, 0, 1.0, 1.0)),
    ("J", Unit::new(2, 1, -2, 0, 1.0, 1.0)),
    ("W", Unit::new(2, 1, -3, 0, 1.0, 1.0)),
    ("Hz", Unit::new(0, 0, -1, 0, 1.0, 1.0)),
    ("rad", Unit::new(0, 0, 0, 0, 1.0, 1.0)),
    ("bar", Unit::new(-1, 1, -2, 5, 1.0, 1.0)),
];

/// Units that stand alone.
const PLAIN: &[(&str, Unit)] = &[
    ("min", Unit::new(0, 0, 1, 0, 60.0, 1.0)),
    ("h", Unit::new(0, 0, 1, 0, 3600.0, 1.0)),
    ("t", Unit::new(0, 1, 0, 3, 1.0, 1.0)),
    ("deg", Unit::new(0, 0, 0, 0, std::f64::consts::PI, 180.0)),
    ("°", Unit::new(0, 0, 0, 0, std::f64::consts::PI, 180.0)),
    ("rpm", Unit::new(0, 0, -1, 0, std::f64::consts::PI, 30.0)),
    ("in", Unit::new(1, 0, 0, 0, 0.0254, 1.0)),
    ("ft", Unit::new(1, 0, 0, 0, 0.3048, 1.0)),
    ("lb", Unit::new(0, 1, 0, 0, 0.453_592_37, 1.0)),
    ("lbf", Unit::new(1, 1, -2, 0, 4.448_221_615_260_5, 1.0)),
    ("kip", Unit::new(1, 1, -2, 0, 4_448.221_615_260_5, 1.0)),
    ("psi", Unit::new(-1, 1, -2, 0, 6_894.757_293_168_361, 1.0)),
    ("ksi", Unit::new(-1, 1, -2, 0, 6_894_757.293_168_361, 1.0)),
];

/// SI prefixes; where several fit a misspelt unit, the first is suggested.
const PREFIXES: &[(&str, i32)] = &[
    ("k", 3),
    ("M", 6),
    ("G", 9),
    ("T", 12),
    ("m", -3),
    ("c", -2),
    ("d", -1),
    ("h", 2),
    ("u", -6),
    ("µ", -6), // micro sign
    ("μ", -6), // Greek mu
    ("n", -9),
    ("p", -12),
];

/// Words people write instead of symbols.
const SYNONYMS: &[(&str, &str)] = &[
    ("meter", "m"),
    ("metre", "m"),
    ("inch", "in"),
    ("foot", "ft"),
    ("feet", "ft"),
    ("sec", "s"),
    ("second", "s"),
    ("gram", "g"),
    ("kilogram", "kg"),
    ("kilo", "kg"),
    ("newton", "N"),
    ("pascal", "Pa"),
    ("joule", "J"),
    ("hour", "h"),
    ("minute", "min"),
    ("ton", "t"),
    ("tonne", "t"),
    ("lbs", "lb"),
    ("degree", "deg"),
];

/// The unit of a symbol, with or without a prefix.
pub(super) fn symbol(text: &str) -> Option<Unit> {
    let find = |list: &[(&str, Unit)], name: &str| list.iter().find(|u| u.0 == name).map(|u| u.1);
    if let Some(unit) = find(PLAIN, text).or_else(|| find(PREFIXABLE, text)) {
        return Some(unit);
    }
    PREFIXES.iter().find_map(|(prefix, power)| {
        let mut unit = find(PREFIXABLE, text.strip_prefix(prefix)?)?;
        unit.power10 += power;
        Some(unit)
    })
}

/// The unit somebody probably meant.
pub(super) fn meant(text: &str) -> Option<String> {
    let lower = text.to_lowercase();
    let singular = lower.strip_suffix('s').unwrap_or(&lower);
    if let Some(known) = SYNONYMS.iter().find(|s| s.0 == lower || s.0 == singular) {
        return Some(known.1.to_string());
    }
    let prefixed = PREFIXABLE.iter().flat_map(|(name, _)| {
        let of = move |(prefix, _): &(&str, i32)| format!("{prefix}{name}");
        PREFIXES.iter().map(of).chain([name.to_string()])
    });
    let all: Vec<String> = PLAIN.iter().map(|u| u.0.to_string()).chain(prefixed).collect();
    suggest::nearest(text, all.iter().map(String::as_str)).map(str::to_string)
}
