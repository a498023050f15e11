//! Findings after a run: where its results are incomplete, inaccurate or depend on the mesh.

use super::case::is_on_a_spring;
use super::rows_of_contact;
use super::structure::BeamPlace;
use super::words::{digits, quantity};
use super::{Advice, Topic, Verdict, ductility, plastic_mesh, resolved};
use percuss::Settings;
use percuss::inspect::SpanView;
use percuss::{
    ContactRecord, ContactSummary, PressedIn, PulseOf, PulseSummary, RunSummary,
    SectionForceSummary, SectionPeak, Termination, WithoutLimit,
};
use percuss::{Model, Start, StrainMeasure, Strength};

/// Compressive strains from which on strain measures differ by some per cent, and by a tenth.
const STRAINS: [f64; 2] = [0.05, 0.15];

/// Findings of a finished run; `before` are those before it.
pub fn findings(
    model: &Model,
    settings: &Settings,
    run: &RunSummary,
    before: &[Advice],
) -> Vec<Advice> {
    let mut all = resolved::findings(model, settings, run, before);
    let few = |contact| rows_of_contact::coarse(contact, settings, before);
    all.extend(run.contacts.iter().filter_map(few));
    if matches!(run.termination, Termination::Completed) {
        let untouched = !run.contacts.iter().any(touched);
        let open = |(index, contact)| {
            let hangs = model.contact(index).is_some_and(|view| {
                let guided = (index < model.guided().len()).then_some(index);
                is_on_a_spring(model, &view, guided)
            });
            still_to_come(contact, settings, untouched && !hangs)
        };
        all.extend(run.contacts.iter().enumerate().filter_map(open));
        all.extend(run.still_rising().filter_map(|one| still_closed(settings, run, one)));
    }
    all.extend(run.contacts.iter().filter_map(pressed_deep));
    all.extend(run.contacts.iter().filter_map(carried_crush));
    all.extend(reactions(model, run));
    all.extend(jumps(model, run));
    all.extend((0..model.beam_count()).filter_map(|beam| compressed(model, run, beam)));
    all.extend(
        run.section_forces
            .iter()
            .filter_map(|beam| beyond_strength(model, beam, Some(settings.start))),
    );
    all.extend(plastic_mesh::exceeded(model, &run.section_forces));
    all.extend(ductility::findings(model, &run.section_forces, &run.plastic));
    all
}

/// A compliant contact with a deep penetration.
fn pressed_deep(contact: &ContactSummary) -> Option<Advice> {
    let pressed = contact.pressed_in.filter(PressedIn::is_deep)?;
    let [a, b] = &contact.between;
    let text = format!(
        "penetration of '{a}' and '{b}' {} at t = {}, and their axes or centres meet at {}: location and direction of the force are \
         unreliable at such a depth; use a stiffer law, or larger depths",
        quantity(pressed.penetration, "m"),
        quantity(pressed.time, "s"),
        quantity(pressed.through, "m")
    );
    let values = [pressed.penetration, pressed.through];
    Some(Advice::new(&contact.name, Topic::Pressed, values, "m", Verdict::Warning, text))
}

/// A contact that crushes, whose indentation moved along the face under load.
fn carried_crush(contact: &ContactSummary) -> Option<Advice> {
    let carried = contact.carried_crush?;
    let [a, b] = &contact.between;
    let text = format!(
        "the indentation between '{a}' and '{b}' moved along the face under load: {} deep, {} along the face; force and permanent \
         indentation there are too small, since the law has no tangential force",
        quantity(carried.depth, "m"),
        quantity(carried.distance, "m")
    );
    let values = [carried.depth, contact.permanent_penetration.unwrap_or(f64::NAN)];
    Some(Advice::new(&contact.name, Topic::CarriedCrush, values, "m", Verdict::Warning, text))
}

/// A contact that is closed at the end, or that never closed where none did; a projectile on a spring may be meant to touch nothing.
fn still_to_come(contact: &ContactSummary, settings: &Settings, untouched: bool) -> Option<Advice> {
    let (ContactRecord::Smooth { intervals, .. } | ContactRecord::Nonsmooth { intervals, .. }) =
        &contact.record;
    let end = quantity(settings.end, "s");
    let (since, verdict, text) = match contact.cut_short() {
        Some(last) => {
            let since = quantity(settings.end - last.start, "s");
            // A rigid contact has impulses, and no peak force.
            let peak = match contact.record {
                ContactRecord::Smooth { .. } => " and the peak force may follow",
                ContactRecord::Nonsmooth { .. } => "",
            };
            let text = format!(
                "contact still closed at the end ({end}), {since} after it closed: duration and impulse are incomplete{peak}"
            );
            (last.start, Verdict::Note, text)
        }
        None if untouched && intervals.is_empty() && impacts(contact) == 0 => {
            let text = format!("no contact up to the end of the run ({end})");
            (f64::NAN, Verdict::Note, text)
        }
        _ => return None,
    };
    Some(Advice::new(&contact.name, Topic::Ending, [since, settings.end], "s", verdict, text))
}

/// A stop, a spring or a foundation that is closed at the end with its largest force since it closed.
fn still_closed(
    settings: &Settings,
    run: &RunSummary,
    (of, since): (PulseOf, f64),
) -> Option<Advice> {
    let slight = |pulse: &PulseSummary| pulse.of == of && resolved::is_slight(pulse, run);
    if run.pulses.iter().any(slight) {
        return None;
    }
    let (subject, _) = resolved::named(&of)?;
    let text = format!(
        "still closed at the end ({}), {} after it closed, with the largest force since then: the peak force may follow",
        quantity(settings.end, "s"),
        quantity(settings.end - since, "s")
    );
    let values = [since, settings.end];
    Some(Advice::new(subject, Topic::Ending, values, "s", Verdict::Note, text))
}

/// Number of impacts.
fn impacts(contact: &ContactSummary) -> usize {
    match contact.record {
        ContactRecord::Nonsmooth { impact_count, .. } => impact_count,
        ContactRecord::Smooth { .. } => 0,
    }
}

fn touched(contact: &ContactSummary) -> bool {
    let (ContactRecord::Smooth { intervals, .. } | ContactRecord::Nonsmooth { intervals, .. }) =
        &contact.record;
    !intervals.is_empty() || impacts(contact) > 0
}

/// Reactions of supports in a run with rigid impacts on beams.
///
/// A rigid impact gives a point a velocity at once. The waves that it sends out have no shortest length but that of the elements,
/// and the largest reaction that they make grows as elements and steps become shorter: of the paper's clamped beam 10 MN with 6
/// elements, 17 with 12, 33 with 24, 43 with 48 and 52 with 96.
fn reactions(model: &Model, run: &RunSummary) -> Option<Advice> {
    let impact = run.forces_without_limit(model).into_iter().find_map(|one| match one {
        WithoutLimit::Impact(contact) => Some(contact),
        WithoutLimit::Jump(_) => None,
    });
    let contact = &run.contacts[impact?];
    let forces =
        run.supports.iter().flat_map(|s| s.force.iter().flat_map(|f| [f.min.value, f.max.value]));
    let largest = forces.filter(|f| f.is_finite()).fold(0.0_f64, |m, f| m.max(f.abs()));
    if largest == 0.0 {
        return None;
    }
    let text = format!(
        "peak reaction ({}) and section forces depend on mesh and step (rigid impact): reactions and shear forces grow with refinement, \
         bending moments little or not at all (percuss converge); use impulses and displacements, or a compliant contact",
        quantity(largest, "N")
    );
    let values = [largest, f64::NAN];
    Some(Advice::new(&contact.name, Topic::Reactions, values, "N", Verdict::Note, text))
}

/// Reactions of driven supports whose velocity jumps, at the ends of a ramp say.
///
/// A jump gives the end of a beam a velocity at once, as a rigid impact does, and the impulse of the support is its share of the beam's
/// mass: half an element's.
fn jumps(model: &Model, run: &RunSummary) -> Option<Advice> {
    let jump = run.forces_without_limit(model).into_iter().find_map(|one| match one {
        WithoutLimit::Jump(support) => Some(support),
        WithoutLimit::Impact(_) => None,
    });
    let support = run.supports.get(jump?)?;
    let forces = support.force.iter().flat_map(|f| [f.min.value, f.max.value]);
    let largest = forces.filter(|f| f.is_finite()).fold(0.0_f64, |m, f| m.max(f.abs()));
    let moments = [support.moment.min.value, support.moment.max.value];
    let moment = moments.into_iter().filter(|m| m.is_finite()).fold(0.0_f64, |a, m| a.max(m.abs()));
    let peak = if largest > 0.0 { quantity(largest, "N") } else { quantity(moment, "N m") };
    let text = format!(
        "velocity jump of support '{}' (at the ends of a ramp, for example): peak reaction ({peak}) and section forces depend on mesh \
         and step: reactions of a rigid support and shear forces grow with refinement, bending moments little or not at all (percuss converge), and \
         the force of an elastic one lacks the jump of its damper (damping times velocity) within a step; use a motion that starts and ends with \
         zero velocity (a table with smooth = true, for example), or displacements",
        support.name,
    );
    let values = [largest, f64::NAN];
    let subject = format!("support {}", support.name);
    Some(Advice::new(subject, Topic::Reactions, values, "N", Verdict::Note, text))
}

/// A beam of Green's strain that is compressed so far that another measure would say something else.
///
/// Of an engineering strain e Green's is `e + e^2/2`: smaller by `-e/2` of it where it is compressive. Its law softens, and has no
/// more to give at -0.42.
fn compressed(model: &Model, run: &RunSummary, index: usize) -> Option<Advice> {
    let beam = model.beam(index);
    let least = run.section_forces.iter().find(|f| f.name == beam.name())?.axial.min;
    let place = BeamPlace::new(model, index, least.s);
    if place.measure() != StrainMeasure::Green || !least.value.is_finite() {
        return None;
    }
    // The force is EA times the strain times the stretch; the strain itself to first order.
    let strain = -least.value / place.section().axial;
    if strain < STRAINS[0] {
        return None;
    }
    let verdict = if strain < STRAINS[1] { Verdict::Note } else { Verdict::Warning };
    let text = format!(
        "compressive strain of beam '{}' {} % at s = {}, t = {}: Green's strain and the engineering strain, and the forces with them, \
         differ by about {} %; compare with strain = \"engineering\"",
        beam.name(),
        digits(100.0 * strain),
        quantity(least.s, "m"),
        quantity(least.time, "s"),
        digits(50.0 * strain / (1.0 - 0.5 * strain).max(0.5))
    );
    let contact = format!("beam {}", beam.name());
    Some(Advice::new(contact, Topic::Strain, [strain, STRAINS[0]], "1", verdict, text))
}

/// Takes the weight from the effective masses of rigid contacts that had no impact in a run: nothing depends on them.
pub fn settle(advice: &mut [Advice], run: &RunSummary) {
    for one in advice.iter_mut().filter(|one| one.topic == Topic::EffectiveMass) {
        let own = run.contacts.iter().find(|c| c.name == one.contact);
        let without = own
            .is_some_and(|c| matches!(c.record, ContactRecord::Nonsmooth { impact_count: 0, .. }));
        if without && one.verdict > Verdict::Fine {
            // What was allowed before the run stays allowed: without that it would be reported before the next one.
            if one.verdict != Verdict::Allowed {
                (one.verdict, one.reason) = (Verdict::Fine, None);
            }
            one.text = format!(
                "effective mass {} on this mesh, tends to {} with refinement; no impact in this run",
                quantity(one.value, "kg"),
                quantity(one.reference, "kg")
            );
        }
    }
}

/// The usual strength that a stress at `s` exceeds, in tension or compression, its magnitude \[Pa\]; where materials change, that of either.
fn strength_passed(model: &Model, name: &str, s: f64, stress: f64) -> Option<f64> {
    let index = (0..model.beam_count()).find(|&i| model.beam(i).name() == name)?;
    let beam = model.beam(index);
    let near = 1e-9 * beam.length();
    let here = |span: &SpanView<'_>| match span.stations() {
        [first, .., last] => (first - near..=last + near).contains(&s),
        _ => false,
    };
    let passed = beam.spans().filter(here).filter_map(|span| span.strength());
    let passed = passed.filter(|strength| strength.is_passed(stress));
    let limit = |strength: Strength| match stress < 0.0 {
        true => strength.compression,
        false => strength.tension,
    };
    passed.map(limit).min_by(f64::total_cmp)
}

/// Place and instant of a stress; an equilibrium has no time, and the start of a run is named elsewhere.
fn at(peak: &SectionPeak) -> String {
    match peak.time > 0.0 {
        true => format!("s = {}, t = {}", quantity(peak.s, "m"), quantity(peak.time, "s")),
        false => format!("s = {}", quantity(peak.s, "m")),
    }
}

/// When a strength was first exceeded: at the start of a run, or at a place and an instant of its own where the largest stresses came `later`.
fn first_exceeded(first: &SectionPeak, later: bool, start: Option<Start>) -> String {
    match start {
        Some(Start::Static) if first.time == 0.0 => {
            "; exceeded already at the start, under the permanent loads".to_owned()
        }
        Some(_) if first.time == 0.0 => "; exceeded already at the start".to_owned(),
        _ if first.time > 0.0 && later => format!("; first exceeded at {}", at(first)),
        _ => String::new(),
    }
}

/// What a von Mises stress inside a section is called.
const INSIDE: &str = "von Mises stress";

/// An elastic beam whose stress exceeds the usual strength of its material: that of the extreme fibres, in tension and in compression, or the von Mises
/// stress inside where that is larger. `start` is that of a run; an equilibrium has none.
pub fn beyond_strength(
    model: &Model,
    beam: &SectionForceSummary,
    start: Option<Start>,
) -> Option<Advice> {
    let strength_at = |peak: &SectionPeak| strength_passed(model, &beam.name, peak.s, peak.value);
    let inside = beam.beyond_inside.map(|first| (first, beam.von_mises_inside));
    let in_fibres = beam.beyond.map(|first| {
        let sides = [(beam.stress.max, "tension"), (beam.stress.min, "compression")];
        let beyond = sides.into_iter().filter(|(most, _)| strength_at(most).is_some());
        (first, beyond.collect::<Vec<_>>())
    });
    let (first, reached) = match (in_fibres, inside) {
        (Some(own), _) if !beam.shear_governs() => own,
        (_, Some((first, most))) => (first, vec![(most, INSIDE)]),
        (own, None) => own?,
    };
    // Where materials change, what is largest need not be what exceeds.
    let reached = if reached.is_empty() { vec![(first, "stress")] } else { reached };
    let strength = |most: &SectionPeak| strength_at(most).unwrap_or(f64::NAN);
    let stress = |value: f64| quantity(value, "Pa");
    let later = reached.iter().all(|(most, _)| most.time != first.time);
    let since = first_exceeded(&first, later, start);
    let limit = strength(&reached[0].0);
    let reported = if reached.iter().all(|(most, _)| strength(most) == limit) {
        let larger = |a: &&(SectionPeak, &str), b: &&(SectionPeak, &str)| {
            a.0.value.abs().total_cmp(&b.0.value.abs())
        };
        let (most, what) = reached.iter().max_by(larger)?;
        let what = if *what == INSIDE { "von Mises stress " } else { "" };
        let limit = stress(limit);
        format!(
            "{what}{} at {} (strength of the material {limit}){since}",
            stress(most.value),
            at(most)
        )
    } else {
        let side = |(most, what): &(SectionPeak, &str)| {
            let limit = stress(strength(most));
            format!("{what} {} at {} (strength {limit})", stress(most.value), at(most))
        };
        format!("{}{since}", reached.iter().map(side).collect::<Vec<_>>().join(" and "))
    };
    let text = format!(
        "{reported}. The material is modelled as elastic: set `yield`, or accept this in [allow] with the strength of your material",
    );
    // The side that is farthest beyond.
    let share = |most: &SectionPeak| most.value.abs() / strength(most);
    let worst =
        reached.iter().map(|(most, _)| most).max_by(|a, b| share(a).total_cmp(&share(b)))?;
    let values = [worst.value, strength(worst)];
    let subject = format!("beam {}", beam.name);
    Some(Advice::new(subject, Topic::Strength, values, "Pa", Verdict::Warning, text))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_strength_exceeded_at_the_start_is_reported_so() {
        let at = |time: f64| SectionPeak { value: 3e8, s: 2.0, time };
        let words = |time: f64, start| first_exceeded(&at(time), true, start);
        let permanent = "; exceeded already at the start, under the permanent loads";
        assert_eq!(words(0.0, Some(Start::Static)), permanent);
        assert_eq!(words(0.0, Some(Start::Reference)), "; exceeded already at the start");
        let late = words(0.25, Some(Start::Static));
        assert_eq!(late, "; first exceeded at s = 2 m, t = 250 ms");
        assert_eq!(first_exceeded(&at(0.25), false, Some(Start::Static)), "");
        // An equilibrium has no time.
        assert_eq!(words(0.0, None), "");
    }
}
