//! Suspicious magnitudes: values that the mechanics accepts, but that a wrong unit is likely to have caused.
//!
//! Limits lie far beyond what is built or measured, so that a finding is worth reading; they are no errors.

use std::collections::HashMap;
use std::f64::consts::PI;

use super::advice::magnitude_finding;
use super::case::{self, Meeting};
use super::structure::{BeamPlace, gravity};
use super::words::{digits, quantity};
use super::{Advice, Verdict, millimetres, property_magnitudes};
use percuss::Settings;
use percuss::inspect::{BodyKind, ConnectorCoordinate, ConnectorLaw};
use percuss::math::vec2::norm;
use percuss::{Model, Potential};

/// Densities of solids, foams and the heaviest metals included \[kg/m^3\].
const DENSITY: [f64; 2] = [1.0, 3e4];
/// Young's moduli, from gels to twice diamond and beyond \[Pa\].
const YOUNG: [f64; 2] = [1e3, 1e13];
/// Stiffnesses and masses so many times those of a beam have nothing in common with it.
const APART: f64 = 1e9;
/// A spring so many times stiffer than the beam is lengthwise is no ordinary stop, whatever the beam is in bending.
const LENGTHWISE: f64 = 1e6;
/// Periods of a beam's lowest bending mode in one step, of which nothing can be seen.
const PERIODS: f64 = 1e4;
/// Steps that take days.
const STEPS: f64 = 1e9;
/// Accelerations of gravity on planets end here \[m/s^2\].
const GRAVITY: f64 = 500.0;

/// All suspicious magnitudes.
pub fn findings(model: &Model, settings: &Settings) -> Vec<Advice> {
    // One finding, if all values are in the wrong units.
    if let Some(whole) = millimetres::finding(model) {
        return vec![whole];
    }
    let mut all = Vec::new();
    for (index, stub) in stubs(model).into_iter().enumerate() {
        beam(&BeamPlace::new(model, index, 0.0), stub, settings, &mut all);
    }
    all.extend(property_magnitudes::findings(model));
    bodies(model, &mut all);
    springs(model, &mut all);
    let (pull, _) = gravity(model);
    if norm(pull) > GRAVITY {
        let text = format!(
            "gravity of {} m/s^2, {} times that of the earth: check the units (mm/s^2?)",
            digits(norm(pull)),
            digits(norm(pull) / 9.81)
        );
        all.push(magnitude_finding(
            "gravity",
            [norm(pull), GRAVITY],
            "m/s^2",
            Verdict::Warning,
            text,
        ));
    }
    let steps = settings.end / settings.step;
    if steps > STEPS && settings.accuracy.is_none() {
        let text = format!(
            "{} steps of {} up to {} take days: check the units",
            digits(steps),
            quantity(settings.step, "s"),
            quantity(settings.end, "s")
        );
        all.push(magnitude_finding("time", [steps, STEPS], "1", Verdict::Note, text));
    }
    all
}

/// For each beam whether it is tied to another one that is longer than deep. Where they meet both are given in the same unit, so that a
/// short one is meant: a stub that carries a hinge, say.
fn stubs(model: &Model) -> Vec<bool> {
    let long = |index: usize| {
        let place = BeamPlace::in_the_middle(model, index);
        let (length, half_depth) = (place.beam.length(), place.half_depth());
        half_depth > 0.0 && length >= 2.0 * half_depth
    };
    let long: Vec<bool> = (0..model.beam_count()).map(long).collect();
    let mut stubs = vec![false; long.len()];
    let ties = model.constraints().map(|tie| tie.points().map(|p| p.beam).collect::<Vec<_>>());
    let springs = model.connectors().map(|one| one.points().map(|p| p.beam).collect::<Vec<_>>());
    for all in ties.chain(springs) {
        for beam in &all {
            stubs[*beam] |= all.iter().any(|other| other != beam && long[*other]);
        }
    }
    stubs
}

/// Length (unless it is a stub), section, material of a beam, and its lowest period against the step.
fn beam(place: &BeamPlace<'_>, stub: bool, settings: &Settings, all: &mut Vec<Advice>) {
    let data = place.beam;
    let each = data.spans().flat_map(|span| {
        // The elements of a span without taper are all alike.
        let count = if span.varies() { span.element_count() } else { 1 };
        (0..count).map(move |k| span.gauss_points(k)[1].section)
    });
    let (name, length) = (format!("beam {}", data.name()), data.length());
    let mut reported = [false; 4];
    for row in each {
        let gyration = row.gyration();
        let depth =
            if row.half_depth > 0.0 { 2.0 * row.half_depth } else { 12_f64.sqrt() * gyration };
        let found = [
            slender(&name, length, depth, row.half_depth > 0.0).filter(|_| !stub),
            section(&name, gyration, row.half_depth),
            density(&name, row.density),
            young(&name, row.young),
        ];
        for (reported, found) in reported.iter_mut().zip(found) {
            if let (false, Some(found)) = (*reported, found) {
                *reported = true;
                all.push(found);
            }
        }
    }
    // Of the pinned beam; other supports make it a few times longer or shorter.
    let constants = place.section();
    let period = 2.0 / PI * length.powi(2) * (constants.mass / constants.bending).sqrt();
    let given = settings.accuracy.is_none();
    if given && settings.step > PERIODS * period && period > 0.0 {
        let text = format!(
            "the step of {} is {} periods of the lowest mode ({}): check the units of time, stiffness and length",
            quantity(settings.step, "s"),
            digits(settings.step / period),
            quantity(period, "s")
        );
        all.push(magnitude_finding(&name, [settings.step, period], "s", Verdict::Warning, text));
    }
}

fn slender(name: &str, length: f64, depth: f64, given: bool) -> Option<Advice> {
    if length >= depth || !depth.is_finite() {
        return None;
    }
    let deep = if given { "its section is" } else { "by its inertia its section is about" };
    let text = format!(
        "length {}, and {deep} {} deep: a beam is longer than deep; check the units",
        quantity(length, "m"),
        quantity(depth, "m")
    );
    Some(magnitude_finding(name, [length, depth], "m", Verdict::Warning, text))
}

/// No part of a section lies farther from its centre line than half its depth: neither does its radius of gyration.
fn section(name: &str, gyration: f64, half_depth: f64) -> Option<Advice> {
    let text = if gyration > (1.0 + 1e-6) * half_depth {
        format!(
            "radius of gyration {} (from inertia and area) is impossible for the depth {}: check the units",
            quantity(gyration, "m"),
            quantity(2.0 * half_depth, "m")
        )
    } else if gyration < 1e-3 * half_depth {
        format!(
            "radius of gyration {} (from inertia and area) is too small for the depth {}: check the units",
            quantity(gyration, "m"),
            quantity(2.0 * half_depth, "m")
        )
    } else {
        return None;
    };
    Some(magnitude_finding(name, [gyration, half_depth], "m", Verdict::Warning, text))
}

fn density(name: &str, density: f64) -> Option<Advice> {
    // Nothing at all is meant so; what is not known cannot be judged.
    if density == 0.0 || density.is_nan() || (DENSITY[0]..=DENSITY[1]).contains(&density) {
        return None;
    }
    let units =
        [("t/mm^3", 1e12), ("kg/mm^3", 1e9), ("g/mm^3", 1e6), ("g/cm^3", 1e3), ("g/m^3", 1e-3)];
    let meant = units.iter().find(|(_, factor)| (300.0..=2.5e4).contains(&(density * factor)));
    let (verdict, reference) = match density < DENSITY[0] {
        true => (Verdict::Note, DENSITY[0]),
        false => (Verdict::Warning, DENSITY[1]),
    };
    let meant = meant.map_or(String::new(), |(unit, factor)| {
        format!("; in {unit} it would be {} kg/m^3", digits(density * factor))
    });
    let text = format!("density {} kg/m^3, solids have 1 to 30 000{meant}", digits(density));
    Some(magnitude_finding(name, [density, reference], "kg/m^3", verdict, text))
}

fn young(name: &str, young: f64) -> Option<Advice> {
    if young.is_nan() || (YOUNG[0]..=YOUNG[1]).contains(&young) {
        return None;
    }
    let units = [("GPa", 1e9), ("MPa", 1e6), ("mPa", 1e-3)];
    let meant = units.iter().find(|(_, factor)| (1e6..=1.3e12).contains(&(young * factor)));
    let meant = meant.map_or(String::new(), |(unit, factor)| {
        format!("; in {unit} it would be {} Pa", digits(young * factor))
    });
    let reference = YOUNG[usize::from(young > YOUNG[1])];
    let text = format!("Young's modulus {} Pa, solids have 1e3 to 1e13{meant}", digits(young));
    Some(magnitude_finding(name, [young, reference], "Pa", Verdict::Warning, text))
}

/// Masses against those of beams they go with, and speeds against those of waves.
fn bodies(model: &Model, all: &mut Vec<Advice>) {
    let mut masses: HashMap<usize, f64> = HashMap::new();
    let mut apart = |name: &str, mass: f64, place: &BeamPlace<'_>| {
        let own = *masses.entry(place.index).or_insert_with(|| place.mass());
        apart(name, mass, (place, own))
    };
    for mass in model.point_masses() {
        let place = BeamPlace::new(model, mass.point.beam, mass.point.s);
        all.extend(apart(&format!("mass at {}", mass.point.label), mass.mass, &place));
    }
    for k in 0..model.contacts().len() {
        let Some(case) = case::read(model, k, None) else { continue };
        match &case.meeting {
            Meeting::Struck(struck) => {
                all.extend(apart(case.name, struck.mass, &struck.place));
                all.extend(struck.rear.and_then(|rear| apart(case.name, rear.mass, &struck.place)));
                all.extend(fast(case.name, struck.speed.abs(), &struck.place));
            }
            Meeting::Beams(beams) => {
                all.extend(fast(case.name, norm(beams.velocity), &beams.place))
            }
            Meeting::Bodies(_) => {}
        }
    }
}

fn apart(name: &str, mass: f64, (place, own): (&BeamPlace<'_>, f64)) -> Option<Advice> {
    if !(mass > 0.0 && own > 0.0) || (1.0 / APART..=APART).contains(&(mass / own)) {
        return None;
    }
    let text = format!(
        "a mass of {} on beam '{}' of {}: check the units",
        quantity(mass, "kg"),
        place.beam.name(),
        quantity(own, "kg")
    );
    Some(magnitude_finding(name, [mass, own], "kg", Verdict::Warning, text))
}

fn fast(name: &str, speed: f64, place: &BeamPlace<'_>) -> Option<Advice> {
    let wave = place.section().bar_speed();
    if speed <= wave || speed.is_nan() || wave.is_nan() {
        return None;
    }
    let text = format!(
        "{} exceeds the wave speed of beam '{}' ({}): check velocity, stiffness and density",
        quantity(speed, "m/s"),
        place.beam.name(),
        quantity(wave, "m/s")
    );
    Some(magnitude_finding(name, [speed, wave], "m/s", Verdict::Warning, text))
}

/// Springs of contacts and between points, against the beams they press on.
fn springs(model: &Model, all: &mut Vec<Advice>) {
    for k in 0..model.contacts().len() {
        let Some(case) = case::read(model, k, None) else { continue };
        let place = match &case.meeting {
            Meeting::Struck(struck) => &struck.place,
            Meeting::Beams(beams) => &beams.place,
            Meeting::Bodies(_) => continue,
        };
        if let Some(law) = case.law.smooth()
            && let Potential::Linear { stiffness } = law.potential
        {
            all.extend(spring(case.name, stiffness, place));
        }
    }
    for body in model.bodies() {
        if let BodyKind::Rear { stiffness, .. } = body.kind
            && let Some(first) = model.guided().next()
        {
            let place = BeamPlace::new(model, first.point.beam, first.point.s);
            all.extend(spring("spring of a rear mass", stiffness, &place));
        }
    }
    for one in model.connectors() {
        let (ConnectorLaw::Linear { stiffness, .. } | ConnectorLaw::OneSided { stiffness, .. }) =
            one.law()
        else {
            continue;
        };
        if one.coordinate() == ConnectorCoordinate::Displacement
            && let Some(point) = one.points().next()
        {
            let place = BeamPlace::new(model, point.beam, point.s);
            all.extend(spring(&format!("spring at {}", point.label), stiffness, &place));
        }
    }
}

fn spring(name: &str, stiffness: f64, place: &BeamPlace<'_>) -> Option<Advice> {
    let (section, length) = (place.section(), place.beam.length());
    let own = section.bending / length.powi(3);
    let soft = stiffness < own / APART;
    let hard = stiffness > own * APART && stiffness > LENGTHWISE * section.axial / length;
    if !(stiffness > 0.0 && own > 0.0) || !(soft || hard) {
        return None;
    }
    let (ratio, than) =
        if soft { (own / stiffness, "softer") } else { (stiffness / own, "stiffer") };
    let text = format!(
        "a spring of {} is {} times {than} than beam '{}' in bending (EI/L^3 = {}): check the units",
        quantity(stiffness, "N/m"),
        digits(ratio),
        place.beam.name(),
        quantity(own, "N/m")
    );
    Some(magnitude_finding(name, [stiffness, own], "N/m", Verdict::Warning, text))
}
