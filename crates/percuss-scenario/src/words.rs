//! Values that are one word out of a few, and those that mix words with numbers.

use std::marker::PhantomData;

use percuss::{
    Component, ContactForce, Curve, Ends, ImpactLaw, MultipleImpacts, RotaryInertia, Sides, Slack,
    Start, StrainMeasure, Theory,
};
use serde_json::{Value as Json, json};
use toml::de::DeValue;

use crate::code::FaultCode;
use crate::format::{Format, Inline};
use crate::layout::Described;
use crate::measure::{Length, LineInertia, Measure, Pressure, Time};
use crate::node::{Node, Reader};
use crate::quantity::Quantity;
use crate::suggest;
use crate::write;

/// A value that is one word out of a few.
pub(crate) trait Words: 'static {
    /// What it is read into.
    type Value: Copy + PartialEq + 'static;
    /// Words, what they mean and what they are about.
    const WORDS: &'static [(&'static str, Self::Value, &'static str)];
}

/// One word out of a few.
pub(crate) struct Word<W>(PhantomData<W>);

impl<W: Words> Format for Word<W> {
    type Value = W::Value;

    fn read(node: &Node<'_>, reader: &mut Reader<'_>) -> Option<W::Value> {
        let words = W::WORDS.iter().map(|w| w.0);
        let Some(text) = node.value.as_str() else {
            reader.wrong(node, node.found(), suggest::one_of("", words));
            return None;
        };
        let found = W::WORDS.iter().find(|w| w.0 == text).map(|w| w.1);
        if found.is_none() {
            reader.wrong_as(
                FaultCode::UnknownName,
                node,
                node.found(),
                suggest::one_of(text, words),
            );
        }
        found
    }

    fn placeholder() -> W::Value {
        W::WORDS[0].1
    }

    fn expected() -> String {
        suggest::one_of("", W::WORDS.iter().map(|w| w.0))
    }

    fn schema() -> Json {
        let word = |w: &(&str, W::Value, &str)| json!({ "const": w.0, "description": w.2 });
        json!({ "oneOf": W::WORDS.iter().map(word).collect::<Vec<_>>() })
    }

    fn described() -> Described {
        let words = W::WORDS.iter().map(|w| (w.0, w.2)).collect();
        Described { expected: Self::expected(), words, ..Described::default() }
    }
}

impl<W: Words> Inline for Word<W> {
    fn text(value: &W::Value) -> Option<String> {
        W::WORDS.iter().find(|w| w.1 == *value).map(|w| write::text(w.0))
    }
}

/// Strain measure.
pub(crate) struct Strain;

impl Words for Strain {
    type Value = StrainMeasure;
    const WORDS: &'static [(&'static str, StrainMeasure, &'static str)] = &[
        ("green", StrainMeasure::Green, "eps = (|x'|^2 - 1) / 2, the paper's"),
        ("engineering", StrainMeasure::Engineering, "eps = |x'| - 1"),
    ];
}

/// Sign of the stresses that a material carries.
pub(crate) struct Bears;

impl Words for Bears {
    type Value = Option<Slack>;
    const WORDS: &'static [(&'static str, Option<Slack>, &'static str)] = &[
        ("both", None, "tension and compression"),
        ("tension", Some(Slack::Compression), "tension-only: cables, thin straps"),
        (
            "compression",
            Some(Slack::Tension),
            "compression-only: masonry, concrete without reinforcement (with `yield`, its strength in compression)",
        ),
    ];
}

/// Theory of a beam.
pub(crate) struct Bending;

impl Words for Bending {
    type Value = Theory;
    const WORDS: &'static [(&'static str, Theory, &'static str)] = &[
        ("slender", Theory::Slender, "sections stay normal to the axis (Euler and Bernoulli)"),
        (
            "shear",
            Theory::Shear,
            "flexible in shear (Timoshenko; Simo and Reissner): for deep beams and for forces just after an impact; needs `poisson` or \
             `shear_modulus` of the material",
        ),
    ];
}

/// Curve through the points of a beam.
pub(crate) struct Curved;

impl Words for Curved {
    type Value = Curve;
    const WORDS: &'static [(&'static str, Curve, &'static str)] = &[
        ("polyline", Curve::Polyline, "straight from point to point, with rigid corners"),
        ("arc", Curve::Arc, "a circular arc through three points: start, between, end"),
        ("spline", Curve::Spline, "a smooth curve through all points"),
    ];
}

/// What closes the outline of a beam at its ends.
pub(crate) struct Closed;

impl Words for Closed {
    type Value = Ends;
    const WORDS: &'static [(&'static str, Ends, &'static str)] = &[
        ("flat", Ends::Flat, "a straight edge across the axis, between two corners"),
        ("round", Ends::Round, "a half circle from face to face"),
    ];
}

/// Configuration in which an analysis starts.
pub(crate) struct Started;

impl Words for Started {
    type Value = Start;
    const WORDS: &'static [(&'static str, Start, &'static str)] = &[
        ("reference", Start::Reference, "the stress-free reference configuration"),
        ("static", Start::Static, "static equilibrium under the loads that act at time zero"),
    ];
}

/// Treatment of multiple impacts.
pub(crate) struct Multiple;

impl Words for Multiple {
    type Value = MultipleImpacts;
    const WORDS: &'static [(&'static str, MultipleImpacts, &'static str)] = &[
        ("simultaneous", MultipleImpacts::Simultaneous, "the impact law for all contacts at once"),
        (
            "sequential",
            MultipleImpacts::Sequential,
            "one impact after another, fastest approach first",
        ),
    ];
}

/// Evaluation of an elastic contact force.
pub(crate) struct Force;

impl Words for Force {
    type Value = ContactForce;
    const WORDS: &'static [(&'static str, ContactForce, &'static str)] = &[
        ("conserving", ContactForce::Conserving, "conserves energy, opening and closing included"),
        (
            "plain-gradient",
            ContactForce::PlainGradient,
            "along the gradient at the middle of the step: inaccurate where the contact point moves",
        ),
        ("midpoint", ContactForce::Midpoint, "the paper's"),
    ];
}

/// Impact law.
pub(crate) struct Impact;

impl Words for Impact {
    type Value = ImpactLaw;
    const WORDS: &'static [(&'static str, ImpactLaw, &'static str)] = &[
        (
            "newton",
            ImpactLaw::Newton,
            "Newton's law; Moreau's where Newton's would increase the energy",
        ),
        (
            "moreau",
            ImpactLaw::Moreau,
            "Moreau's law: the impulses of the plastic impact, times 1 + e",
        ),
    ];
}

/// Sides of a beam.
pub(crate) struct SidesOf;

impl Words for SidesOf {
    type Value = Sides;
    const WORDS: &'static [(&'static str, Sides, &'static str)] = &[
        ("both", Sides::Both, "left and right"),
        ("left", Sides::Left, "seen along the beam, where the tangent turned by +90 deg points"),
        ("right", Sides::Right, "seen along the beam"),
    ];
}

/// A component that a support holds: a word, or 1 and 2 for the displacements.
pub(crate) struct Held;

const HELD: &[(&str, Component)] = &[
    ("displacement_1", Component::Displacement1),
    ("displacement_2", Component::Displacement2),
    ("rotation", Component::Rotation),
    ("stretch", Component::Stretch),
];

impl Format for Held {
    type Value = Component;

    fn read(node: &Node<'_>, reader: &mut Reader<'_>) -> Option<Component> {
        let word = match node.value {
            DeValue::Integer(number) if number.radix() == 10 => {
                format!("displacement_{}", number.as_str())
            }
            DeValue::String(text) => text.to_string(),
            _ => String::new(),
        };
        let held = HELD.iter().find(|h| h.0 == word).map(|h| h.1);
        if held.is_none() {
            let near =
                suggest::nearest(node.value.as_str().unwrap_or(""), HELD.iter().map(|h| h.0));
            let near = near.map(|n| format!(" (did you mean `{n}`?)")).unwrap_or_default();
            reader.wrong_as(FaultCode::UnknownName, node, node.found(), Self::expected() + &near);
        }
        held
    }

    fn placeholder() -> Component {
        Component::Rotation
    }

    fn expected() -> String {
        "1, 2, \"rotation\" or \"stretch\"".into()
    }

    fn schema() -> Json {
        let words = HELD.iter().map(|h| json!(h.0));
        let all: Vec<Json> = [json!(1), json!(2)].into_iter().chain(words).collect();
        json!({ "enum": all })
    }
}

impl Inline for Held {
    fn text(value: &Component) -> Option<String> {
        Some(match value {
            Component::Displacement1 => "1".into(),
            Component::Displacement2 => "2".into(),
            Component::Rotation => "\"rotation\"".into(),
            Component::Stretch => "\"stretch\"".into(),
        })
    }
}

/// `true`, `false` or a value per length.
pub(crate) struct Rotary;

impl Format for Rotary {
    type Value = RotaryInertia;

    fn read(node: &Node<'_>, reader: &mut Reader<'_>) -> Option<RotaryInertia> {
        match node.value {
            DeValue::Boolean(true) => Some(RotaryInertia::Density),
            DeValue::Boolean(false) => Some(RotaryInertia::Neglected),
            DeValue::Integer(_) | DeValue::Float(_) | DeValue::String(_) => {
                Quantity::<LineInertia>::read(node, reader).map(RotaryInertia::Given)
            }
            _ => {
                reader.wrong(node, node.found(), Self::expected());
                None
            }
        }
    }

    fn placeholder() -> RotaryInertia {
        RotaryInertia::Density
    }

    fn expected() -> String {
        format!("true, false or {}", Quantity::<LineInertia>::expected())
    }

    fn schema() -> Json {
        json!({ "type": ["boolean", "number", "string"] })
    }

    fn number(value: &RotaryInertia) -> Option<(f64, &'static str)> {
        match value {
            RotaryInertia::Given(value) => Quantity::<LineInertia>::number(value),
            _ => None,
        }
    }

    fn set_number(value: &mut RotaryInertia, number: f64) -> Result<(), String> {
        *value = RotaryInertia::Given(number);
        Ok(())
    }
}

impl Inline for Rotary {
    fn text(value: &RotaryInertia) -> Option<String> {
        Some(match value {
            RotaryInertia::Density => "true".into(),
            RotaryInertia::Neglected => "false".into(),
            RotaryInertia::Given(value) => write::number(*value),
        })
    }
}

/// A quantity that may be without end, and the word for that.
pub(crate) trait Endless: 'static {
    /// The quantity.
    type Measure: Measure;
    /// The word.
    const WORD: &'static str;
    /// SI unit that is written beside the number.
    const UNIT: &'static str = "";
}

/// A time, or `"forever"`.
pub(crate) struct Until;

impl Endless for Until {
    type Measure = Time;
    const WORD: &'static str = "forever";
}

/// A yield stress, or `"preset"`: that of the material known by name.
pub(crate) struct OfPreset;

impl Endless for OfPreset {
    type Measure = Pressure;
    const UNIT: &'static str = Pressure::UNIT;
    const WORD: &'static str = "preset";
}

/// A radius of curvature, or `"flat"`.
pub(crate) struct Curvature;

impl Endless for Curvature {
    type Measure = Length;
    const WORD: &'static str = "flat";
}

/// A quantity, or the word for one without end.
pub(crate) struct OrEndless<E>(PhantomData<E>);

impl<E: Endless> Format for OrEndless<E> {
    type Value = f64;

    fn read(node: &Node<'_>, reader: &mut Reader<'_>) -> Option<f64> {
        match node.value.as_str() {
            Some(word) if word == E::WORD => Some(f64::INFINITY),
            _ => Quantity::<E::Measure>::read(node, reader),
        }
    }

    fn placeholder() -> f64 {
        f64::INFINITY
    }

    fn expected() -> String {
        format!("\"{}\" or {}", E::WORD, Quantity::<E::Measure>::expected())
    }

    fn schema() -> Json {
        Quantity::<E::Measure>::schema()
    }

    fn described() -> Described {
        Described { expected: Self::expected(), ..Quantity::<E::Measure>::described() }
    }

    fn number(value: &f64) -> Option<(f64, &'static str)> {
        Quantity::<E::Measure>::number(value)
    }

    fn set_number(value: &mut f64, number: f64) -> Result<(), String> {
        Quantity::<E::Measure>::set_number(value, number)
    }
}

impl<E: Endless> Inline for OrEndless<E> {
    const UNIT: &'static str = E::UNIT;

    fn text(value: &f64) -> Option<String> {
        match value.is_finite() {
            true => Some(write::number(*value)),
            false => Some(write::text(E::WORD)),
        }
    }
}
