//! Materials and beams.

use percuss::{Along, Curve, Ends, Slack, StrainMeasure, Theory};

use serde_json::{Value as Json, json};

use super::yielding::{Hardening, RateLaw, RateText, settle_yield};

use crate::csv::Points;
use crate::format::{Count, Format, Inline, List, Maybe};
use crate::layout::Described;
use crate::measure;
use crate::name::{MaterialName, NameOf, SectionName};
use crate::node::{Body, Node, Reader};
use crate::point::Place;
use crate::preset::{Preset, Presets};
use crate::quantity::{Quantity, is_one};
use crate::reach::Reached;
use crate::table::{Braces, exclude};
use crate::words::{Bears, Bending, Closed, Curved, OfPreset, OrEndless, Strain, Word};
use crate::write::Writer;

/// Keys of other programs, and those of this one.
const POISSON: &str = "`poisson`, used by shear-flexible beams alone";
const SHEAR: &str = "`shear_modulus`, used by shear-flexible beams alone";

table! {
    /// Material of a beam.
    pub struct Material {
        /// A material or grade by name: gives `young` and `density` where these are omitted. It is elastic without `yield`; a warning says where a
        /// stress exceeds its usual strength.
        preset: Option<Preset> as Maybe<Word<Presets>> = None,
        /// Young's modulus (Pa); required without `preset`.
        young: Option<f64> as Maybe<Quantity<measure::Pressure>> = None,
        /// Density (kg/m^3); required without `preset`.
        density: Option<f64> as Maybe<Quantity<measure::Density>> = None,
        /// Poisson's ratio; used by shear-flexible beams alone, for shear modulus and shear factor.
        poisson: Option<f64> as Maybe<Quantity<measure::Poisson>> = None,
        /// Shear modulus (Pa) of a material that is not isotropic, such as timber; used by shear-flexible beams alone. Beside `poisson` it must be
        /// `young / (2 (1 + poisson))` within 2 %.
        shear_modulus: Option<f64> as Maybe<Quantity<measure::Pressure>> = None,
        /// Strain measure of the strain energy; shear-flexible beams have engineering strains, and require them of a material that yields.
        strain: StrainMeasure as Word<Strain> = StrainMeasure::Green,
        /// Retardation time of Kelvin-Voigt damping (s), which adds E times this time the strain rate to the stress: stiffness-proportional
        /// damping, Rayleigh's beta.
        retardation: f64 as Quantity<measure::Time> = 0.0,
        /// Mass-proportional damping, Rayleigh's alpha (1/s): damping force per mass and velocity.
        mass_damping: f64 as Quantity<measure::Rate> = 0.0,
        /// Thermal expansion (1/K), strain per change of temperature, for loads of `kind = "temperature"`; that of the preset if omitted (of steel 12e-6,
        /// of concrete 10e-6), else none.
        expansion: Option<f64> as Maybe<Quantity<measure::Expansion>> = None,
        /// Yield stress (Pa), or "preset" for the usual one of the preset; elastic if omitted.
        r#yield: Option<f64> as Maybe<OrEndless<OfPreset>> = None,
        /// Hardening with plastic strain; perfectly plastic if omitted.
        hardening: Option<Hardening> as Maybe<Braces<Hardening>> = None,
        /// Strain-rate dependence (Cowper-Symonds overstress), or "preset" for measured constants of the preset.
        rate: Option<RateLaw> as Maybe<RateText> = None,
        /// Fracture strain: magnitude of strain at which a fibre fails permanently; no failure if omitted.
        failure_strain: Option<f64> as Maybe<Quantity<measure::Ratio>> = None,
        /// Tension-only or compression-only material; with `yield` it opens without stress on the other side and yields on this one alone
        /// (experimental).
        bears: Option<Slack> as Word<Bears> = None,
    }
    either preset | young & density
    not {
        nu: POISSON,
        poissons_ratio: POISSON,
        poisson_ratio: POISSON,
        G: SHEAR,
    }
    then settle_material
}

/// Fills in the values of the preset.
fn settle_material(material: &mut Material, body: &Body<'_>, reader: &mut Reader<'_>) {
    settle_yield(body, reader);
    settle_presets(material, body, reader);
    if let Some(preset) = material.preset {
        material.young.get_or_insert(preset.young);
        material.density.get_or_insert(preset.density);
        return;
    }
    let mut want = |key, expected: String| {
        let unknown_preset = body.get("preset").is_some();
        if body.get(key).is_none() && !unknown_preset {
            let expected = format!("{expected}, or a `preset`");
            reader.missing(body, key, format!("no `{key}`"), expected);
        }
    };
    want("young", Quantity::<measure::Pressure>::expected());
    want("density", Quantity::<measure::Density>::expected());
}

table! {
    /// A beam: a centre line with material, section and finite elements.
    pub struct Beam {
        /// Points of the centre line (m), or the path of a CSV file with two columns, x and y (m).
        points: Vec<[f64; 2]> as Points,
        /// Curve through the points.
        curve: Curve as Word<Curved> = Curve::Polyline,
        /// Smallest number of finite elements (there are also nodes at supports, joints and loads); this or `element_length`. Of a beam that can yield,
        /// those at supports, joints, corners, loads and struck points are short (see `grading`).
        elements: Option<usize> as Maybe<Count> = None,
        /// Largest length of a finite element (m); this or `elements`.
        element_length: Option<f64> as Maybe<Quantity<measure::Length>> = None,
        /// Mesh grading: smaller elements towards a location, or 1 for equal ones. By default a beam that can yield has short elements at places at which
        /// plastic hinges may form, if their number allows: a tenth of the mean, and at least half the depth of the section (a quarter with
        /// `strain = "engineering"`).
        grading: Option<Grading> as Maybe<GradingText> = None,
        /// Name of its material, or a material or grade known by name, such as "S355".
        material: String as NameOf<MaterialName>,
        /// Name of its section, or a steel profile, such as "IPE 200".
        section: String as NameOf<SectionName>,
        /// Locations from which it has another material or section, in their order.
        changes: Vec<Change> as List<Braces<Change>> = Vec::new(),
        /// Shape of both ends for contact, within its length.
        ends: Ends as Word<Closed> = Ends::Flat,
        /// Theory of bending: whether its sections stay normal to the axis.
        theory: Theory as Word<Bending> = Theory::Slender,
    }
    either elements | element_length
    then settle_beam
}

/// Number of elements or their length, one of the two.
fn settle_beam(_: &mut Beam, body: &Body<'_>, reader: &mut Reader<'_>) {
    let keys = ["elements", "element_length"];
    exclude(body, keys, reader);
    if !keys.iter().any(|key| body.get(key).is_some() || reader.excuses(body, key)) {
        let expected = "`elements`, such as 6, or `element_length`, such as \"0.1 m\"";
        reader.missing(body, "elements", "no number of elements", expected);
    }
}

table! {
    /// Elements smaller towards a place.
    pub struct Grading {
        /// Where the elements are smallest: "start", "mid", "end", a fraction or a length.
        towards: Along as Place,
        /// Ratio of the largest to the smallest element length; above one.
        ratio: f64 as Quantity<measure::Ratio>,
    }
}

impl Grading {
    /// Equal elements: `grading = 1`.
    pub const EVEN: Self = Self { towards: Along::Fraction(0.0), ratio: 1.0 };
}

/// A grading in braces, or 1.
pub(crate) struct GradingText;

impl Format for GradingText {
    type Value = Grading;

    fn read(node: &Node<'_>, reader: &mut Reader<'_>) -> Option<Grading> {
        if is_one(node.value) {
            return Some(Grading::EVEN);
        }
        if Body::of(node).is_none() {
            reader.wrong(node, node.found(), Self::expected());
            return None;
        }
        Braces::<Grading>::read(node, reader)
    }

    fn placeholder() -> Grading {
        Braces::<Grading>::placeholder()
    }

    fn expected() -> String {
        format!("1 or {}", Braces::<Grading>::expected())
    }

    fn schema() -> Json {
        json!({ "anyOf": [{ "const": 1 }, Braces::<Grading>::schema()] })
    }

    fn described() -> Described {
        Described { expected: Self::expected(), ..Braces::<Grading>::described() }
    }

    fn reach<'c>(value: &'c mut Grading, path: &[String]) -> Reached<'c> {
        Braces::<Grading>::reach(value, path)
    }
}

impl Inline for GradingText {
    fn text(value: &Grading) -> Option<String> {
        match *value == Grading::EVEN {
            true => Some("1".to_owned()),
            false => Braces::<Grading>::text(value),
        }
    }
}

table! {
    /// Another material or section of a beam from a location on.
    pub struct Change {
        /// Where it begins: "start", "mid", "end", a fraction or a length.
        at: Along as Place,
        /// Name of the section from there on; the one before if none is given.
        section: Option<String> as Maybe<NameOf<SectionName>> = None,
        /// Name of the material from there on; the one before if none is given.
        material: Option<String> as Maybe<NameOf<MaterialName>> = None,
    }
    either section | material
    then settle_change
}

fn settle_change(_: &mut Change, body: &Body<'_>, reader: &mut Reader<'_>) {
    let excused = reader.excuses(body, "section") || reader.excuses(body, "material");
    if body.get("section").is_none() && body.get("material").is_none() && !excused {
        let found = "a change without a section or material";
        reader.misplaced(&body.path, body.span.clone(), found, "`section`, `material` or both");
    }
}

/// Puts the values of the preset in the place of `"preset"`.
pub(super) fn settle_presets(material: &mut Material, body: &Body<'_>, reader: &mut Reader<'_>) {
    let preset = material.preset;
    // One that could not be read is reported already.
    let unknown = preset.is_none() && body.get("preset").is_some();
    let mut refuse = |key: &str, what: &str| {
        let Some(node) = body.get(key).filter(|_| !unknown) else { return };
        let found = match preset {
            Some(known) => format!("\"preset\", and no {what} of {} known", known.name),
            None => "\"preset\" of a material without one".into(),
        };
        let expected = match key {
            "yield" => Quantity::<measure::Pressure>::expected(),
            _ => Braces::<RateLaw>::expected(),
        };
        reader.misplaced(&node.path, node.span.clone(), found, expected);
    };
    if material.r#yield == Some(f64::INFINITY) {
        material.r#yield = preset.and_then(|known| known.yields);
        if material.r#yield.is_none() {
            refuse("yield", "yield stress");
        }
    }
    if material.rate.as_ref().is_some_and(|rate| rate.C == f64::INFINITY) {
        let known = preset.and_then(|known| known.rate);
        material.rate = known.map(|[c, q]| RateLaw { C: c, q });
        if material.rate.is_none() {
            refuse("rate", "rate constants");
        }
    }
}
