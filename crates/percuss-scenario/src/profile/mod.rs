//! Steel profiles by name, with the standards that their dimensions come from.
//!
//! Area and second moment of area follow from the nominal dimensions with their fillets and rounded corners.

mod american;
mod european;

use serde_json::{Value as Json, json};

use crate::code::FaultCode;
use crate::format::{Format, Inline, Text};
use crate::node::{Node, Reader};
use crate::write;

/// A steel profile by name.
#[derive(Clone, Debug, PartialEq)]
pub struct SteelProfile {
    /// Its name as given.
    pub name: String,
    form: Form,
}

/// Dimensions of a profile \[m\].
#[derive(Clone, Copy, Debug, PartialEq)]
enum Form {
    /// A rolled I: depth, width, web, flange, radius of the fillets, shape (5) \[m\].
    I([f64; 5]),
    /// A hollow rectangle: depth, width, wall, shape (3) \[m\].
    Box([f64; 3]),
    /// A hollow circle: diameter, wall, shape (2) \[m\].
    Tube([f64; 2]),
}

/// Outer and inner radius of the corners of hot finished hollow sections, in thicknesses of the wall (EN 10210-2, nominal values for the
/// properties of sections).
const CORNERS: [f64; 2] = [1.5, 1.0];

const INCH: f64 = 0.0254;
const MILLIMETRE: f64 = 1e-3;

/// Names of the series of European rolled sections and their rows.
static EUROPEAN: [(&str, &[european::Row]); 3] =
    [("IPE", european::IPE), ("HEA", european::HEA), ("HEB", european::HEB)];

impl SteelProfile {
    /// The profile of a name: `IPE 200`, `HE 300 B`, `W12x26`, `RHS 200x100x8`, `SHS 100x5`, `CHS 168.3x5`; case, blanks and hyphens do not
    /// matter.
    pub fn find(name: &str) -> Option<Self> {
        let (series, sizes) = parts(name)?;
        let form = match (series.as_str(), sizes.as_slice()) {
            ("W", &[depth, weight]) => wide_flange(depth, weight)?,
            ("RHS", &[depth, width, wall]) => hollow(depth, width, wall)?,
            ("SHS", &[side, wall]) => hollow(side, side, wall)?,
            ("SHS", &[depth, width, wall]) if depth == width => hollow(depth, width, wall)?,
            ("CHS", &[diameter, wall]) if wall > 0.0 && wall < 0.5 * diameter => {
                Form::Tube([diameter, wall].map(|x| x * MILLIMETRE))
            }
            (series, &[size]) => {
                let (_, rows) = EUROPEAN.iter().find(|(name, _)| *name == series)?;
                let (_, row) = rows.iter().find(|(known, _)| *known == size)?;
                Form::I(row.map(|x| x * MILLIMETRE))
            }
            _ => return None,
        };
        Some(Self { name: name.into(), form })
    }

    /// Whether profiles of that series are known: `IPE`, `HEA`, `HEB`, `W`, `RHS`, `SHS`, `CHS`; `HE` for both of its series.
    pub fn is_series(name: &str) -> bool {
        SERIES.contains(&name.trim().to_uppercase().as_str())
    }

    /// The section, bent about the axis across its depth.
    pub fn section(&self, name: &str) -> percuss::Section {
        match self.form {
            Form::I([depth, width, web, flange, fillet]) => {
                percuss::Section::rolled_i(name, width, depth, flange, web, fillet)
            }
            Form::Box([depth, width, wall]) => {
                let radii = CORNERS.map(|corner| corner * wall);
                percuss::Section::rounded_box(name, width, depth, wall, radii)
            }
            Form::Tube([diameter, wall]) => percuss::Section::tube(name, diameter, wall),
        }
    }
}

fn wide_flange(depth: f64, weight: f64) -> Option<Form> {
    let (.., row) = american::W.iter().find(|row| (row.0, row.1) == (depth, weight))?;
    let [depth, width, web, flange, k] = row.map(|x| x * INCH);
    Some(Form::I([depth, width, web, flange, k - flange]))
}

/// A hollow section whose inner corners leave straight sides, `None` for another one.
fn hollow(depth: f64, width: f64, wall: f64) -> Option<Form> {
    let thick = 2.0 * (1.0 + CORNERS[1]) * wall >= depth.min(width);
    (wall > 0.0 && !thick).then(|| Form::Box([depth, width, wall].map(|x| x * MILLIMETRE)))
}

/// A name without what does not matter: blanks, hyphens, case, the sign between sizes.
fn plain(name: &str) -> String {
    let plain: String = name.chars().filter(|c| !matches!(c, ' ' | '-' | '_')).collect();
    plain.to_uppercase().replace(['×', '*'], "X").replace(',', ".")
}

/// Series and sizes of a name: `HE 200 A` is `HEA` and 200.
fn parts(name: &str) -> Option<(String, Vec<f64>)> {
    let plain = plain(name);
    let digits = plain.find(|c: char| c.is_ascii_digit())?;
    let (series, sizes) = plain.split_at(digits);
    let (series, sizes) = match (series, sizes.strip_suffix(['A', 'B'])) {
        ("HE", Some(size)) => (format!("HE{}", &sizes[size.len()..]), size),
        _ => (series.to_owned(), sizes),
    };
    let sizes: Result<Vec<f64>, _> = sizes.split('X').map(str::parse).collect();
    Some((series, sizes.ok()?))
}

/// Names of all profiles of tables, with what tells how near two of a series are.
fn tabulated() -> impl Iterator<Item = (&'static str, [f64; 2], String)> {
    let european = EUROPEAN.iter().flat_map(|&(series, rows)| {
        rows.iter().map(move |(size, _)| (series, [*size, 0.0], format!("{series} {size}")))
    });
    let american = american::W
        .iter()
        .map(|&(depth, weight, _)| ("W", [depth, weight], format!("W{depth}x{weight}")));
    european.chain(american)
}

/// Names near one that no profile has, at most three, those of the nearest size first; none where it is of no series with a table. A size beyond
/// all of its series is a typing error: those that differ from it in the fewest letters come first.
pub(crate) fn near(name: &str) -> Vec<String> {
    let Some((series, sizes)) = parts(name) else { return Vec::new() };
    let size = |i: usize| sizes.get(i).copied().unwrap_or(0.0);
    let of_series = || tabulated().filter(|(known, ..)| *known == series);
    let beyond = of_series().all(|(_, [first, _], _)| first < size(0))
        || of_series().all(|(_, [first, _], _)| first > size(0));
    let written = plain(name);
    let letters = |other: &str| match beyond {
        true => strsim::damerau_levenshtein(&written, &plain(other)),
        false => 0,
    };
    let mut all: Vec<(usize, [f64; 2], String)> = of_series()
        .map(|(_, [a, b], name)| (letters(&name), [(a - size(0)).abs(), (b - size(1)).abs()], name))
        .collect();
    let nearer = |a: &[f64; 2], b: &[f64; 2]| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1]));
    all.sort_by(|(m, a, _), (n, b, _)| m.cmp(n).then(nearer(a, b)));
    all.into_iter().take(3).map(|(.., name)| name).collect()
}

/// Series of profiles; `HE` is what a name of the series HEA or HEB begins with where its last letter is left out.
const SERIES: [&str; 8] = ["IPE", "HEA", "HEB", "HE", "W", "RHS", "SHS", "CHS"];

/// What was found and expected of a name that begins with a series, as that of a profile does, but is of none; a `W` alone may be any name.
pub(crate) fn clash(name: &str) -> Option<(String, String)> {
    let plain: String = name.chars().filter(|c| !matches!(c, ' ' | '-' | '_')).collect();
    let letters: String = plain.chars().take_while(char::is_ascii_alphabetic).collect();
    let sized = plain[letters.len()..].starts_with(|c: char| c.is_ascii_digit());
    let begins = SteelProfile::is_series(&letters);
    let whole = letters.len() == plain.len() && letters != "W" && letters != "w";
    (begins && (sized || whole)).then(|| (unknown(name), right(name)))
}

fn unknown(name: &str) -> String {
    format!("the unknown profile {name:?}")
}

/// What would be right in place of a name that no profile has.
fn right(name: &str) -> String {
    match (near(name).as_slice(), parts(name)) {
        ([first, rest @ ..], _) if !rest.is_empty() => {
            let rest: Vec<String> = rest.iter().map(|name| format!("`{name}`")).collect();
            format!("a profile of its series, such as `{first}`, {}", rest.join(", "))
        }
        (_, Some((series, _))) if series == "HE" => {
            "a profile of the series HEA or HEB, such as `HEA 200` or `HEB 200`".into()
        }
        (_, Some((series, _))) if series == "RHS" => {
            "depth, width and wall in mm, such as `RHS 200x100x8`, the wall below a quarter of the smaller side".into()
        }
        (_, Some((series, _))) if series == "SHS" => {
            "side and wall in mm, such as `SHS 100x5`, the wall below a quarter of the side".into()
        }
        (_, Some((series, _))) if series == "CHS" => {
            "diameter and wall in mm, such as `CHS 168.3x5`, the wall below half the diameter".into()
        }
        _ => ProfileName::expected(),
    }
}

/// The name of a steel profile.
pub(crate) struct ProfileName;

impl Format for ProfileName {
    type Value = SteelProfile;

    fn read(node: &Node<'_>, reader: &mut Reader<'_>) -> Option<SteelProfile> {
        let name = Text::read(node, reader)?;
        let found = SteelProfile::find(&name);
        if found.is_none() {
            reader.wrong_as(FaultCode::UnknownName, node, unknown(&name), right(&name));
        }
        found
    }

    fn placeholder() -> SteelProfile {
        SteelProfile { name: String::new(), form: Form::Tube([0.1, 0.01]) }
    }

    fn expected() -> String {
        "a profile of the series IPE, HEA, HEB, W, RHS, SHS or CHS, such as \"IPE 200\", \"W12x26\", \"RHS 200x100x8\" or \"CHS 168.3x5\""
            .into()
    }

    fn schema() -> Json {
        let names: Vec<String> = tabulated().map(|(.., name)| name).collect();
        // Names of hollow sections and other ways to write a name are texts, too.
        json!({ "anyOf": [{ "enum": names }, { "type": "string" }] })
    }
}

impl Inline for ProfileName {
    fn text(value: &SteelProfile) -> Option<String> {
        Some(write::text(&value.name))
    }
}
