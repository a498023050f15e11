//! Strains and stresses beyond what materials follow their laws to.

use super::words::{digits, quantity};
use super::{Advice, Topic, Verdict};
use percuss::inspect::{BeamView, SpanView};
use percuss::{Model, PlasticHinge, PlasticSummary, SectionForceSummary, SectionPeak};

/// Strain up to which the law of a material without failure strain is taken to hold \[-\].
const STRAIN: f64 = 0.05;
/// Stress over Young's modulus that no usual material bears \[-\].
const STRESS: f64 = 0.1;

/// Beams strained or stressed beyond that, one finding each: the gravest.
pub fn findings(
    model: &Model,
    section_forces: &[SectionForceSummary],
    plastic: &[PlasticSummary],
) -> Vec<Advice> {
    let of = |forces: &SectionForceSummary| {
        let beam =
            (0..model.beam_count()).map(|i| model.beam(i)).find(|b| b.name() == forces.name)?;
        let own = plastic.iter().find(|one| one.name == forces.name);
        let own = own.filter(|one| one.first_yield.is_some());
        stressed(&beam, forces).or_else(|| strained(&beam, forces, own?))
    };
    section_forces.iter().filter_map(of).collect()
}

/// The span of a place, of two the one for which a number is known.
fn span_of<'m>(
    beam: &BeamView<'m>,
    s: f64,
    fits: impl Fn(&SpanView<'m>) -> bool,
) -> Option<SpanView<'m>> {
    let near = 1e-9 * beam.length();
    let here = |span: &SpanView<'_>| match span.stations() {
        [first, .., last] => (first - near..=last + near).contains(&s),
        _ => false,
    };
    beam.spans().find(|span| here(span) && fits(span))
}

/// A place and a time in words; an equilibrium has none.
fn at(peak: &SectionPeak) -> String {
    let s = format!("s = {}", quantity(peak.s, "m"));
    if peak.time > 0.0 { format!("{s}, t = {}", quantity(peak.time, "s")) } else { s }
}

/// A stress beyond a tenth of Young's modulus: of the extreme fibres, or the mean where they are not known.
fn stressed(beam: &BeamView<'_>, forces: &SectionForceSummary) -> Option<Advice> {
    let mut peak = forces.stress.largest();
    if peak.value.is_nan() {
        peak = forces.axial.largest();
        let span = span_of(beam, peak.s, |_| true)?;
        peak.value /= span.section_at(peak.s).area;
    }
    let young = span_of(beam, peak.s, |_| true)?.section_at(peak.s).young;
    let share = peak.value.abs() / young;
    if share.is_nan() || share <= STRESS {
        return None;
    }
    let text = format!(
        "stress of beam '{}' {} at {}: {} of Young's modulus ({}); no material bears more than a tenth of it: check loads, section and \
         units, and the law of the material",
        beam.name(),
        quantity(peak.value, "Pa"),
        at(&peak),
        times(share),
        quantity(young, "Pa")
    );
    Some(finding(beam, [share, STRESS], text, Verdict::Warning))
}

/// A share as a percentage, or a multiple.
fn times(share: f64) -> String {
    if share < 1.0 {
        format!("{} %", digits(100.0 * share))
    } else {
        format!("{} times", digits(share))
    }
}

/// A beam that yielded, without failure strain, beyond the strain at the largest force of its material, or beyond 5 %.
fn strained(
    beam: &BeamView<'_>,
    forces: &SectionForceSummary,
    plastic: &PlasticSummary,
) -> Option<Advice> {
    let flow = &plastic.strain_max;
    // A real hinge is about as long as the section is deep: a shorter one has its strain from the mesh.
    let verdict = |most: &SectionPeak, limit: f64| {
        let depth = 2.0 * beam.span_at(most.s).section_at(most.s).half_depth;
        let at = |hinge: &&PlasticHinge| (hinge.s - most.s).abs() <= hinge.length;
        let length = plastic.hinges.iter().find(at).map_or(f64::INFINITY, |hinge| hinge.length);
        let share = if length < depth { length / depth } else { 1.0 };
        if most.value.abs() * share > limit { Verdict::Warning } else { Verdict::Note }
    };
    let endless = |span: &SpanView<'_>| span.yields_without_failure();
    let limit = span_of(beam, flow.s, endless).and_then(|span| span.uniform_strain());
    if let Some(limit) = limit.filter(|limit| flow.value.abs() > *limit) {
        let text = format!(
            "plastic strain of beam '{}' {} % at {}, beyond the strain at the largest force of its material, {} %: it necks or tears \
             before; set `failure_strain` (without `hardening` a hinge is as short as an element, and its strain grows with refinement)",
            beam.name(),
            digits(100.0 * flow.value),
            at(flow),
            digits(100.0 * limit)
        );
        return Some(finding(beam, [flow.value.abs(), limit], text, verdict(flow, limit)));
    }
    let most = forces.strain.largest();
    // A gap is no strain of the material.
    let gapes = span_of(beam, most.s, |span| span.is_one_sided()).is_some();
    let most = if most.value.abs() > flow.value.abs() && !gapes { most } else { *flow };
    if most.value.abs() <= STRAIN || span_of(beam, most.s, endless).is_none() {
        return None;
    }
    let text = format!(
        "strain of beam '{}' {} % at {}, beyond 5 %, and its material has no failure strain: set `failure_strain`, or a `hardening.table` \
         measured up to it",
        beam.name(),
        digits(100.0 * most.value),
        at(&most)
    );
    Some(finding(beam, [most.value.abs(), STRAIN], text, verdict(&most, STRAIN)))
}

fn finding(beam: &BeamView<'_>, values: [f64; 2], text: String, verdict: Verdict) -> Advice {
    let subject = format!("beam {}", beam.name());
    Advice::new(subject, Topic::Ductility, values, "1", verdict, text)
}
