//! The units known, their prefixes and the words people write instead.

use std::f64::consts::PI;

use super::dimension::Dimension;

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

    /// A unit with one radian in it, over a power of the second.
    const fn angle(s: i32, numerator: f64, denominator: f64) -> Self {
        let dimension = Dimension::new(0, 0, s).with_radian(1);
        Self { dimension, power10: 0, numerator, denominator }
    }

    /// The kelvin, of differences of temperature.
    const fn kelvin() -> Self {
        let dimension = Dimension::new(0, 0, 0).with_kelvin(1);
        Self { dimension, power10: 0, numerator: 1.0, denominator: 1.0 }
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
    ("rad", Unit::angle(0, 1.0, 1.0)),
    ("bar", Unit::new(-1, 1, -2, 5, 1.0, 1.0)),
];

/// Pound-force and foot in SI \[N, m\].
const LBF: f64 = 4.448_221_615_260_5;
const FOOT: f64 = 0.3048;
const INCH: f64 = 0.0254;

/// Units that stand alone.
const PLAIN: &[(&str, Unit)] = &[
    ("min", Unit::new(0, 0, 1, 0, 60.0, 1.0)),
    ("h", Unit::new(0, 0, 1, 0, 3600.0, 1.0)),
    ("t", Unit::new(0, 1, 0, 3, 1.0, 1.0)),
    ("%", Unit::new(0, 0, 0, -2, 1.0, 1.0)),
    ("deg", Unit::angle(0, PI, 180.0)),
    ("°", Unit::angle(0, PI, 180.0)),
    ("K", Unit::kelvin()),
    ("rev", Unit::angle(0, 2.0 * PI, 1.0)),
    ("rpm", Unit::angle(-1, PI, 30.0)),
    // Gravitational metric units: standard gravity is 9.80665 m/s^2 by definition.
    ("kp", Unit::new(1, 1, -2, 0, 9.806_65, 1.0)),
    ("kgf", Unit::new(1, 1, -2, 0, 9.806_65, 1.0)),
    ("tf", Unit::new(1, 1, -2, 3, 9.806_65, 1.0)),
    ("dyn", Unit::new(1, 1, -2, -5, 1.0, 1.0)),
    ("atm", Unit::new(-1, 1, -2, 0, 101_325.0, 1.0)),
    // Inch and pound are exact by the agreement of 1959.
    ("in", Unit::new(1, 0, 0, 0, INCH, 1.0)),
    ("ft", Unit::new(1, 0, 0, 0, FOOT, 1.0)),
    ("yd", Unit::new(1, 0, 0, 0, 0.9144, 1.0)),
    ("mph", Unit::new(1, 0, -1, 0, 1609.344, 3600.0)),
    ("lb", Unit::new(0, 1, 0, 0, 0.453_592_37, 1.0)),
    ("slug", Unit::new(0, 1, 0, 0, LBF, FOOT)),
    ("pcf", Unit::new(-3, 1, 0, 0, 0.453_592_37, FOOT * FOOT * FOOT)),
    ("pci", Unit::new(-3, 1, 0, 0, 0.453_592_37, INCH * INCH * INCH)),
    ("lbf", Unit::new(1, 1, -2, 0, LBF, 1.0)),
    ("kip", Unit::new(1, 1, -2, 3, LBF, 1.0)),
    ("plf", Unit::new(0, 1, -2, 0, LBF, FOOT)),
    ("pli", Unit::new(0, 1, -2, 0, LBF, INCH)),
    ("klf", Unit::new(0, 1, -2, 3, LBF, FOOT)),
    ("psf", Unit::new(-1, 1, -2, 0, LBF, FOOT * FOOT)),
    ("ksf", Unit::new(-1, 1, -2, 3, LBF, FOOT * FOOT)),
    ("psi", Unit::new(-1, 1, -2, 0, 6_894.757_293_168_361, 1.0)),
    ("ksi", Unit::new(-1, 1, -2, 0, 6_894_757.293_168_361, 1.0)),
    ("Msi", Unit::new(-1, 1, -2, 6, 6_894.757_293_168_361, 1.0)),
];

/// SI prefixes.
const PREFIXES: &[(&str, i32)] = &[
    ("k", 3),
    ("M", 6),
    ("G", 9),
    ("T", 12),
    ("m", -3),
    ("c", -2),
    ("d", -1),
    ("da", 1),
    ("h", 2),
    ("u", -6),
    ("µ", -6), // micro sign
    ("μ", -6), // Greek mu
    ("n", -9),
    ("p", -12),
];

/// Words people write instead of symbols that take a prefix.
const WORDS: &[(&str, &str)] = &[
    ("meter", "m"),
    ("metre", "m"),
    ("gram", "g"),
    ("gramme", "g"),
    ("sec", "s"),
    ("second", "s"),
    ("newton", "N"),
    ("pascal", "Pa"),
    ("joule", "J"),
    ("watt", "W"),
    ("hertz", "Hz"),
    ("radian", "rad"),
];

/// The same for prefixes.
const PREFIX_WORDS: &[(&str, &str)] = &[
    ("kilo", "k"),
    ("mega", "M"),
    ("giga", "G"),
    ("milli", "m"),
    ("centi", "c"),
    ("deci", "d"),
    ("deca", "da"),
    ("hecto", "h"),
    ("micro", "u"),
    ("nano", "n"),
];

/// Other words and abbreviations; a `ton` may be any of three, so it stands for none.
const SYNONYMS: &[(&str, &str)] = &[
    ("inch", "`in`"),
    ("inches", "`in`"),
    ("foot", "`ft`"),
    ("feet", "`ft`"),
    ("yard", "`yd`"),
    ("kilo", "`kg`"),
    ("hour", "`h`"),
    ("hr", "`h`"),
    ("minute", "`min`"),
    ("tonne", "`t`"),
    ("ton", "`t` (1000 kg), or 2000 lb, or 2240 lb"),
    ("lbm", "`lb`"),
    ("pound", "`lb` (mass), or `lbf` (force)"),
    ("kilopond", "`kp`"),
    ("kpsi", "`ksi`"),
    ("degree", "`deg`"),
    ("revolution", "`rev`"),
    ("percent", "`%`"),
    ("kelvin", "`K`"),
    ("degc", "`K`, of a difference of temperatures"),
    ("celsius", "`K`, of a difference of temperatures"),
    ("°c", "`K`, of a difference of temperatures"),
    ("mp", "`m/s`"), // mps, its `s` taken for a plural's
    ("mps", "`m/s`"),
    ("kmh", "`km/h`"),
    ("kph", "`km/h`"),
    ("fps", "`ft/s`"),
    ("rps", "`rev/s`"),
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

/// The unit somebody probably meant, in words for a message.
///
/// By another spelling of the same unit only: of symbols that look alike most differ by a power of ten or belong to another system, and
/// who follows the suggestion would not notice.
pub(super) fn meant(text: &str) -> Option<String> {
    let lower = text.to_lowercase();
    let synonym = |word: &str| SYNONYMS.iter().find(|s| s.0 == word).map(|s| s.1.to_string());
    let singular = lower.strip_suffix('s').filter(|s| s.len() > 1);
    let known = synonym(&lower).or_else(|| singular.and_then(synonym));
    known.or_else(|| spelt_out(singular.unwrap_or(&lower))).or_else(|| other_case(&lower))
}

/// `kilonewton`, or `kilonewtn`: a word for a symbol, with at most one letter amiss.
fn spelt_out(word: &str) -> Option<String> {
    let whole = ("", "");
    PREFIX_WORDS.iter().chain([&whole]).find_map(|(prefix, symbol)| {
        let rest = word.strip_prefix(prefix)?;
        let near = |name: &str| {
            rest == name
                || name.len() > 4 && rest.len() > 4 && strsim::damerau_levenshtein(rest, name) == 1
        };
        let unit = WORDS.iter().find(|(name, _)| near(name))?.1;
        Some(format!("`{symbol}{unit}`"))
    })
}

/// Symbols that differ from what was written in the case of their letters: all of them, for `MPa` is not `mPa`.
fn other_case(lower: &str) -> Option<String> {
    let prefixed = PREFIXABLE.iter().flat_map(|(name, _)| {
        let of = move |(prefix, _): &(&str, i32)| format!("{prefix}{name}");
        PREFIXES.iter().map(of).chain([name.to_string()])
    });
    let plain = PLAIN.iter().map(|u| u.0.to_string());
    let alike: Vec<String> = plain
        .chain(prefixed)
        .filter(|known| known.to_lowercase() == lower)
        .map(|known| format!("`{known}`"))
        .collect();
    (!alike.is_empty()).then(|| alike.join(" or "))
}
