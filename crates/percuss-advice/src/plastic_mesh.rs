//! Whether the mesh resolves plastic hinges: before a run from the lengths of elements where they may form, after it from section forces beyond
//! what sections bear.

use super::formulas::{collapse_excess, elements_for};
use super::words::{digits, quantity};
use super::{Advice, Topic, Verdict};
use percuss::Model;
use percuss::inspect::BeamView;
use percuss::{RunSummary, SectionExcess, SectionForceSummary};

/// Shares of load or moment above those that a structure bears: worth a note, worth a warning.
const EXCESS: [f64; 2] = [0.03, 0.1];

/// An axial force is named if it times the radius of gyration is more than this share of the moment.
const LITTLE: f64 = 0.05;

/// Beams whose mesh would bear more than the structure if plastic hinges formed in them, and rigid masses that strike them between long elements.
pub fn findings(model: &Model) -> Vec<Advice> {
    let beams = (0..model.beam_count()).filter_map(|index| coarse(&model.beam(index)));
    let strikers = (0..model.guided().len()).filter_map(|k| coarse_where_struck(model, k));
    beams.chain(strikers).collect()
}

/// A stretch of a beam between neighbouring places of hinges or ends.
struct Stretch {
    from: f64,
    to: f64,
    /// Lengths of its elements at its ends, zero where no hinge can form, shape (2) \[m\].
    at: [f64; 2],
}

fn coarse(beam: &BeamView<'_>) -> Option<Advice> {
    let (worst, found, count) = worst(beam, beam.hinge_places())?;
    let text = format!(
        "beam '{}' can yield, and its elements between s = {} and {} are as long as {}: if plastic hinges form there, it bears about {} % \
         more than the structure; {} for 3 %",
        beam.name(),
        quantity(worst.from, "m"),
        quantity(worst.to, "m"),
        quantity(worst.at[0].max(worst.at[1]), "m"),
        digits(100.0 * found),
        advised(elements_for(count, found, EXCESS[0]))
    );
    Some(finding(subject(beam.name()), found, text))
}

/// A rigid mass on a guide that strikes a beam which can yield. No short elements stand there by themselves: with their mass that of the beam which
/// takes part in the impact would fall. The forces of a coarse mesh stay within what its sections bear, so that the run does not show the error.
fn coarse_where_struck(model: &Model, index: usize) -> Option<Advice> {
    let contact = model.contact(index).filter(|contact| contact.law().is_rigid())?;
    let point = model.guided().nth(index)?.point;
    let beam = model.beam(point.beam);
    beam.span_at(point.s).first_yield_strain()?;
    let mut places = beam.hinge_places().to_vec();
    let before = worst(&beam, &places).map_or(0.0, |(_, found, _)| found);
    places.push(point.s);
    places.sort_by(f64::total_cmp);
    let (worst, found, count) = worst(&beam, &places)?;
    let text = format!(
        "it strikes beam '{}', which can yield, between elements of {}: a plastic hinge at s = {} turns less than in the structure, and permanent \
         deflections may be several times too small; {}, and compare with twice as many",
        beam.name(),
        quantity(worst.at[0].max(worst.at[1]), "m"),
        quantity(point.s, "m"),
        advised(elements_for(count, found, EXCESS[0]))
    );
    // Whether it yields, the run shows.
    let finding = finding(contact.name().to_owned(), found, text);
    (found > before).then_some(Advice { verdict: Verdict::Note, ..finding })
}

/// Whether a beam that a rigid mass strikes between long elements stayed so far from yielding in a run that it would not have on any mesh.
const FAR: f64 = 0.5;

/// Gives what a run showed to the notes of rigid masses between long elements: a warning where the beam yielded, nothing where it was far from that.
pub fn settle_struck(model: &Model, advice: &mut [Advice], run: &RunSummary) {
    for (index, guided) in model.guided().enumerate() {
        let Some(contact) = model.contact(index) else { continue };
        let beam = model.beam(guided.point.beam);
        let noted =
            |one: &&mut Advice| one.topic == Topic::Unresolved && one.contact == contact.name();
        let Some(one) = advice.iter_mut().find(noted) else { continue };
        let yielded =
            |own: &percuss::PlasticSummary| own.name == beam.name() && own.first_yield.is_some();
        let forces = run.section_forces.iter().find(|forces| forces.name == beam.name());
        let strain = forces.map_or(f64::NAN, |forces| forces.strain.largest().value.abs());
        let limit = beam.span_at(guided.point.s).first_yield_strain().unwrap_or(f64::INFINITY);
        if run.plastic.iter().any(yielded) {
            if one.verdict == Verdict::Note && one.value > EXCESS[1] {
                one.verdict = Verdict::Warning;
            }
        } else if strain < FAR * limit {
            (one.verdict, one.reason) = (Verdict::Fine, None);
            one.text = format!(
                "beam '{}' did not yield, with {} % of the strain at which it would",
                beam.name(),
                digits(100.0 * strain / limit)
            );
        }
    }
}

fn finding(subject: String, found: f64, text: String) -> Advice {
    let verdict = if found > EXCESS[1] { Verdict::Warning } else { Verdict::Note };
    Advice::new(subject, Topic::Unresolved, [found, EXCESS[0]], "1", verdict, text)
}

/// The stretch of a beam between places of hinges whose elements are longest for it, if its excess is worth a note, the excess, and the number of
/// elements of the beam.
fn worst(beam: &BeamView<'_>, hinges: &[f64]) -> Option<(Stretch, f64, usize)> {
    let stations: Vec<f64> = beam.spans().flat_map(|span| span.stations()).copied().collect();
    let elements: Vec<[f64; 2]> =
        stations.windows(2).map(|w| [w[0], w[1]]).filter(|[a, b]| b > a).collect();
    let excess = |one: &Stretch| collapse_excess(one.to - one.from, one.at);
    let all = stretches(beam, hinges, &elements);
    let worst = all.into_iter().max_by(|a, b| excess(a).total_cmp(&excess(b)))?;
    let found = excess(&worst);
    (found > EXCESS[0]).then_some((worst, found, elements.len()))
}

fn advised(elements: usize) -> String {
    format!("use about {elements} elements")
}

fn subject(beam: &str) -> String {
    format!("beam {beam}")
}

fn stretches(beam: &BeamView<'_>, hinges: &[f64], elements: &[[f64; 2]]) -> Vec<Stretch> {
    if hinges.is_empty() {
        return Vec::new();
    }
    let near = 1e-6 * beam.length();
    let mut ends = vec![0.0];
    ends.extend(hinges.iter().copied().filter(|s| *s > near && *s < beam.length() - near));
    ends.push(beam.length());
    let forms = |s: f64| hinges.iter().any(|hinge| (hinge - s).abs() <= near);
    let length_at = |s: f64, side: usize| {
        let own = elements.iter().find(|element| match side {
            0 => element[0] <= s + near && element[1] > s + near,
            _ => element[0] < s - near && element[1] >= s - near,
        });
        own.filter(|_| forms(s)).map_or(0.0, |[a, b]| b - a)
    };
    let stretch = |w: &[f64]| {
        let at = [length_at(w[0], 0), length_at(w[1], 1)];
        Stretch { from: w[0], to: w[1], at }
    };
    ends.windows(2).map(stretch).collect()
}

/// Beams whose section forces exceed what their sections bear with the strain that they have.
pub fn exceeded(model: &Model, section_forces: &[SectionForceSummary]) -> Vec<Advice> {
    let beams = section_forces.iter().filter_map(|beam| Some((beam, beam.excess?)));
    let beyond = beams.filter(|(_, excess)| excess.ratio > 1.0 + EXCESS[0]);
    beyond.map(|(beam, excess)| exceeds(model, &beam.name, &excess)).collect()
}

fn exceeds(model: &Model, name: &str, found: &SectionExcess) -> Advice {
    let own = (0..model.beam_count()).map(|index| model.beam(index)).find(|b| b.name() == name);
    let count: usize =
        own.iter().flat_map(|beam| beam.spans()).map(|span| span.element_count()).sum();
    let gyration = own.map_or(0.0, |beam| beam.span_at(found.s).section_at(found.s).gyration());
    let excess = found.ratio - 1.0;
    let mut forces = Vec::new();
    if found.moment.abs() > LITTLE * found.axial.abs() * gyration {
        forces.push(format!("moment {}", quantity(found.moment, "N m")));
    }
    if found.axial.abs() * gyration > LITTLE * found.moment.abs() {
        forces.push(format!("axial force {}", quantity(found.axial, "N")));
    }
    // An equilibrium has no time.
    let time = match found.time > 0.0 {
        true => format!(", t = {}", quantity(found.time, "s")),
        false => String::new(),
    };
    // The front of a rigid impact exceeds what a section bears on any mesh, for a time as short as its elements.
    let struck = model.guided().enumerate().any(|(k, guided)| {
        let rigid = model.contact(k).is_some_and(|contact| contact.law().is_rigid());
        let there = (guided.point.s - found.s).abs() <= found.element;
        rigid && there && model.beam(guided.point.beam).name() == name
    });
    let cure = match struck {
        true => {
            "compare permanent deflections with those of twice as many (forces just after a rigid impact exceed it on any mesh)"
                .to_owned()
        }
        false => format!("{} for 3 %", advised(elements_for(count, excess, EXCESS[0]))),
    };
    let text = format!(
        "{} of beam '{name}' at s = {}{time} {} {} % above what the section can bear with the strain that it has (error of the mesh, elements \
         of {} there): the structure yields earlier, deflects more and may collapse; {cure}",
        forces.join(" and "),
        quantity(found.s, "m"),
        if forces.len() > 1 { "are" } else { "is" },
        digits(100.0 * excess),
        quantity(found.element, "m"),
    );
    let verdict = if excess > EXCESS[1] && !struck { Verdict::Warning } else { Verdict::Note };
    Advice::new(subject(name), Topic::Unresolved, [excess, EXCESS[0]], "1", verdict, text)
}

/// Takes the weight from estimates of beams that did not yield in a run, or of which it shows more.
pub fn settle(advice: &mut [Advice], run: &RunSummary) {
    for one in advice.iter_mut().filter(|one| one.topic == Topic::Unresolved) {
        let own = run.plastic.iter().find(|beam| one.contact == subject(&beam.name));
        let forces = run.section_forces.iter().find(|beam| one.contact == subject(&beam.name));
        let excess = forces.and_then(|beam| beam.excess).map_or(0.0, |excess| excess.ratio - 1.0);
        let what = match own {
            Some(beam) if beam.first_yield.is_none() => "the beam did not yield",
            Some(_) if excess > EXCESS[0] => "the run exceeds what its section bears",
            Some(_) => "section forces stayed within 3 % of what the section bears",
            None => continue,
        };
        (one.verdict, one.reason) = (Verdict::Fine, None);
        one.text = format!(
            "{what} (elements at plastic hinges: {} % estimated)",
            digits(100.0 * one.value)
        );
    }
}
