//! Suspicious magnitudes of what goes with a material, a section or a beam: shear moduli, shear factors, thermal expansion, given strains, changes of
//! temperature, foundations.

use super::advice::magnitude_finding;
use super::structure::BeamPlace;
use super::words::{digits, quantity};
use super::{Advice, Verdict};
use percuss::inspect::{FoundationView, LoadView, SpanView};
use percuss::{FoundationLaw, Model};

/// Shear moduli over Young's modulus of most materials: from timber with its grain, E/16, and far below, to 1/2, of Poisson's ratio zero.
const SHEAR: [f64; 2] = [1e-2, 0.5];
/// The same, beyond which neither laminates with fibres at 45 degrees nor negative Poisson's ratios go, and below which no soft core of a sandwich
/// is.
const NO_SHEAR: [f64; 2] = [1e-3, 3.0];
/// Shear factors end at one, where the shear stress is even.
const SHEAR_FACTOR: f64 = 1.0;
/// Thermal expansions: plastics and ice have up to 2e-4 \[1/K\].
const EXPANSION: [f64; 2] = [1e-4, 1e-3];
/// Changes of temperature, from room temperature down to absolute zero and up to where steel has no strength left \[K\].
const CHANGE: [f64; 2] = [-293.15, 1000.0];
/// Strains by heat, shrinkage and prestress.
const STRAIN: f64 = 0.05;
/// Foundations so many times stiffer than a beam in bending, and as many times as springs than it is lengthwise, have nothing in common with it.
const APART: [f64; 2] = [1e9, 1e6];
/// Acceleration of gravity on earth \[m/s^2\].
const EARTH: f64 = 9.81;

/// Findings of all beams, loads and foundations.
pub fn findings(model: &Model) -> Vec<Advice> {
    let mut all = Vec::new();
    for index in 0..model.beam_count() {
        let beam = model.beam(index);
        let name = format!("beam {}", beam.name());
        let checks: [fn(&str, SpanView<'_>) -> Option<Advice>; 3] =
            [shear_modulus, shear_factor, expansion];
        // Each once for a beam.
        all.extend(
            checks.iter().filter_map(|check| beam.spans().find_map(|span| check(&name, span))),
        );
    }
    all.extend(model.loads().filter_map(|load| strain(load)));
    all.extend(model.foundations().filter_map(|one| foundation(model, one)));
    all
}

/// Of each material its own moduli: fibres may be of other materials than the beam.
fn shear_modulus(name: &str, span: SpanView<'_>) -> Option<Advice> {
    span.moduli().iter().find_map(|&moduli| of_material(name, moduli))
}

fn of_material(name: &str, [young, modulus]: [f64; 2]) -> Option<Advice> {
    let ratio = modulus / young;
    if !ratio.is_finite() || (SHEAR[0]..=SHEAR[1] * (1.0 + 1e-9)).contains(&ratio) {
        return None;
    }
    let beyond = !(NO_SHEAR[0]..=NO_SHEAR[1]).contains(&ratio);
    let verdict = if beyond { Verdict::Warning } else { Verdict::Note };
    let high = ratio > SHEAR[1];
    let (what, reference) = match high {
        true => (format!("{} times", digits(ratio)), SHEAR[1]),
        false => (format!("1/{} of", digits(1.0 / ratio)), SHEAR[0]),
    };
    let text = format!(
        "shear modulus {} is {what} Young's modulus ({}); isotropic solids have 1/3 to 1/2, timber about 1/16: check the units",
        quantity(modulus, "Pa"),
        quantity(young, "Pa")
    );
    Some(magnitude_finding(name, [modulus, reference * young], "Pa", verdict, text))
}

fn shear_factor(name: &str, span: SpanView<'_>) -> Option<Advice> {
    let (section, modulus) = (span.gauss_points(0)[1].section, span.shear_modulus()?);
    let factor = section.shear / (modulus * section.area);
    // The shear modulus of fibres need not be that of the beam's material.
    if span.has_fibres() || !factor.is_finite() || factor <= SHEAR_FACTOR * (1.0 + 1e-9) {
        return None;
    }
    let text = format!(
        "shear factor {}: that of a section is one at most, 0.83 to 0.87 of a rectangle; it is no area",
        digits(factor)
    );
    Some(magnitude_finding(name, [factor, SHEAR_FACTOR], "1", Verdict::Warning, text))
}

fn expansion(name: &str, span: SpanView<'_>) -> Option<Advice> {
    let value = span.expansion();
    if !value.is_finite() || value.abs() <= EXPANSION[0] {
        return None;
    }
    let verdict = if value.abs() > EXPANSION[1] { Verdict::Warning } else { Verdict::Note };
    let text = format!(
        "thermal expansion {} 1/K; metals have 5e-6 to 3e-5, plastics up to 2e-4: check the unit",
        digits(value)
    );
    Some(magnitude_finding(name, [value, EXPANSION[0]], "1/K", verdict, text))
}

fn strain(load: LoadView<'_>) -> Option<Advice> {
    let name = format!("load {}", load.name());
    if let Some(change) = load.temperature_change()
        && !(CHANGE[0]..=CHANGE[1]).contains(&change)
    {
        let reference = CHANGE[usize::from(change > 0.0)];
        let why = match change > 0.0 {
            true => "metals soften or melt, and moduli do not depend on the temperature here",
            false => "absolute zero is 293 K below room temperature",
        };
        let text = format!("change of temperature by {} K: {why}; check the unit", digits(change));
        return Some(magnitude_finding(&name, [change, reference], "K", Verdict::Warning, text));
    }
    let strain = load.given_strain().filter(|strain| strain.abs() > STRAIN)?;
    let text = format!(
        "a strain without forces of {}, that is {} %; heat, shrinkage and prestress give below {} %: check the unit",
        digits(strain),
        digits(100.0 * strain),
        digits(100.0 * STRAIN)
    );
    Some(magnitude_finding(&name, [strain, STRAIN], "1", Verdict::Warning, text))
}

/// A foundation into which a beam would sink by more than its own length under its weight, one that is stiff beyond any beam, a table of deflections
/// longer than the beam.
fn foundation(model: &Model, one: FoundationView<'_>) -> Option<Advice> {
    let place = BeamPlace::in_the_middle(model, one.beam());
    let (section, length) = (place.section(), place.beam.length());
    let name = format!("foundation {}", one.name());
    if let FoundationLaw::Table { deflection, .. } = one.law() {
        let most = deflection.iter().fold(0.0, |most: f64, one| most.max(one.abs()));
        let text = format!(
            "deflections up to {} of a beam of {}: check the unit (mm?)",
            quantity(most, "m"),
            quantity(length, "m")
        );
        let found = || magnitude_finding(&name, [most, length], "m", Verdict::Warning, text);
        return (most > length).then(found);
    }
    let stiffness = one.law().stiffness();
    let settlement = section.mass * EARTH / stiffness;
    let bending = section.bending / length.powi(4);
    let hard =
        stiffness > APART[0] * bending && stiffness > APART[1] * section.axial / (length * length);
    let (verdict, reference, what) = if settlement > length {
        let what = format!(
            "the beam of {} would sink by {} under its weight",
            quantity(length, "m"),
            quantity(settlement, "m")
        );
        (Verdict::Note, section.mass * EARTH / length, what)
    } else if hard {
        let what = format!("{} times the EI/L^4 of its beam", digits(stiffness / bending));
        (Verdict::Warning, bending, what)
    } else {
        return None;
    };
    let text =
        format!("stiffness per length {}: {what}; check the unit", quantity(stiffness, "N/m^2"));
    Some(magnitude_finding(&name, [stiffness, reference], "N/m^2", verdict, text))
}
