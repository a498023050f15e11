//! Beams that can yield: records during a run, and their results.

use serde::{Deserialize, Serialize};

use crate::analysis::{Equilibrium, permanent_sets};
use crate::element::beam::ElementValues;
use crate::element::fibre::{Fibre, FibreState, StressLaw};
use crate::math::hermite;
use crate::model::Model;
use crate::model::frozen::{BeamData, Span, SpanFibres};
use crate::state::State;
use crate::step::fibres::{PartedElement, fibre_strains};
use crate::summary::{
    FirstYield, NoPermanentSet, Parting, PermanentSet, PlasticHinge, PlasticSummary, SAME_SIZE,
    SectionPeak,
};

/// Plastic curvature below this share of that at first yield is none: a section that is only stretched beyond yield has one of round-off.
const LEAST_BENT: f64 = 1e-6;

/// Places of a beam that have flowed as much but for this share have flowed as much.
#[doc(hidden)]
pub const SAME_FLOW: f64 = SAME_SIZE;

/// Record of a beam.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct YieldRecord {
    strain: SectionPeak,
    accumulated: SectionPeak,
    first: Option<FirstYield>,
    /// Dissipation in the static start \[J\].
    preload: f64,
    /// Fractures so far, in the order of time, shape (places).
    parted: Vec<Parting>,
}

impl YieldRecord {
    /// Enters the record of a span up to the end of a run.
    #[doc(hidden)]
    pub fn take(&mut self, first: FirstYield, strain: SectionPeak, accumulated: SectionPeak) {
        if self.first.is_none_or(|own| first.time < own.time) {
            self.first = Some(first);
        }
        for (peak, new) in [(&mut self.strain, strain), (&mut self.accumulated, accumulated)] {
            if new.value.abs() > peak.value.abs() || peak.value.is_nan() {
                *peak = new;
            }
        }
    }
}

/// A Gauss point with fibres.
struct GaussFibres<'a> {
    s: f64,
    weight: f64,
    span: &'a Span,
    of: &'a SpanFibres,
    /// Its fibres, shape (fibres of the point).
    fibres: &'a [Fibre],
    /// State variables, shape (fibres of the point).
    states: &'a [FibreState],
    /// Membrane and bending strain, shape (2) \[-, 1/m\].
    strains: [f64; 2],
}

impl GaussFibres<'_> {
    /// Dissipation of its fibres \[J\].
    fn dissipated(&self) -> f64 {
        let lost = |(fibre, s): (&Fibre, &FibreState)| fibre.area * s.dissipated;
        self.weight * self.fibres.iter().zip(self.states).map(lost).sum::<f64>()
    }
}

/// Gauss points of a beam at which it has fibres, along it; strains are evaluated if `strained`.
fn points<'a>(
    model: &'a Model,
    state: &'a State,
    beam: &BeamData,
    strained: bool,
) -> impl Iterator<Item = GaussFibres<'a>> {
    let xi = hermite::gauss_points();
    let spans = model.spans[beam.spans.clone()].iter();
    let with = spans.filter_map(|span| span.fibres.as_ref().map(|fibres| (span, fibres)));
    let all = with.flat_map(move |(span, of)| {
        (0..span.elements.len()).flat_map(move |k| {
            let a = span.nodes.start + k;
            let table = span.table(k);
            let u = &state.displacement;
            let strains = if strained {
                fibre_strains(span, k, &ElementValues::new(&u[a], &u[a + 1]))
            } else {
                Default::default()
            };
            let mut rest = &state.fibres[of.range(k)];
            of.of(k).iter().enumerate().map(move |(j, fibres)| {
                let (states, others) = rest.split_at(fibres.len());
                rest = others;
                let (from, to) = (span.stations[k], span.stations[k + 1]);
                let (s, weight) = (from + xi[j] * (to - from), table.rows[j].weight);
                let strains = strains[j];
                GaussFibres { s, weight, span, of, fibres, states, strains }
            })
        })
    });
    all.filter(|point| !point.fibres.is_empty())
}

/// Enters the state at the end of a step into the records, one per beam. Of the places that yield first in the same step, it is the one that has
/// flowed most.
pub fn note(model: &Model, state: &State, records: &mut [YieldRecord]) {
    for (beam, record) in model.beams.iter().zip(records) {
        let none = SectionPeak { value: 0.0, s: f64::NAN, time: state.time };
        let [mut strain, mut accumulated, mut first] = [none; 3];
        for point in points(model, state, beam, false) {
            for fibre in point.states {
                if fibre.plastic.abs() > strain.value.abs() {
                    strain = SectionPeak { value: fibre.plastic, s: point.s, ..strain };
                }
                if fibre.accumulated > accumulated.value {
                    let value = fibre.accumulated;
                    accumulated = SectionPeak { value, s: point.s, ..accumulated };
                    // Of two that have flowed as much but for round-off, the one before along the beam.
                    if value > first.value * (1.0 + SAME_FLOW) {
                        first = accumulated;
                    }
                }
            }
        }
        if accumulated.value > 0.0 {
            let first = FirstYield { s: first.s, time: state.time };
            record.take(first, strain, accumulated);
        }
    }
}

/// Enters the dissipation before the run into the records, one per beam.
pub fn note_preload(model: &Model, state: &State, records: &mut [YieldRecord]) {
    for (beam, record) in model.beams.iter().zip(records) {
        record.preload = points(model, state, beam, false).map(|point| point.dissipated()).sum();
    }
}

/// Enters elements that fracture at a time into the records.
pub fn note_parted(
    model: &Model,
    time: f64,
    parted: &[PartedElement],
    records: &mut [YieldRecord],
) {
    for one in parted {
        let (span, k) = model.element_of(one.node);
        let Some(i) = model.beams.iter().position(|beam| beam.nodes.contains(&one.node)) else {
            continue;
        };
        let (from, to) = (span.stations[k], span.stations[k + 1]);
        let s = from + hermite::gauss_points()[one.gauss] * (to - from);
        records[i].parted.push(Parting { s, stretch: [from, to], time, energy: one.energy });
    }
}

/// Whether a beam can yield.
fn can_yield(model: &Model, beam: &BeamData) -> bool {
    let yields = |law: &StressLaw| matches!(law, StressLaw::Plastic(_));
    let mut fibres = model.spans[beam.spans.clone()].iter().filter_map(|s| s.fibres.as_ref());
    fibres.any(|of| of.laws.iter().any(yields))
}

/// Permanent deflection of each beam, shape (beams); empty without parts that can yield.
pub fn sets(model: &Model, state: &State) -> Vec<Result<PermanentSet, NoPermanentSet>> {
    let any = model.memory_count() > 0 || model.beams.iter().any(|beam| can_yield(model, beam));
    if any { permanent_sets(model, state) } else { Vec::new() }
}

/// Results of a run, one entry per beam that can yield, from its records and the beams' permanent [`sets`].
pub fn summaries(
    model: &Model,
    state: &State,
    records: &[YieldRecord],
    sets: &[Result<PermanentSet, NoPermanentSet>],
) -> Vec<PlasticSummary> {
    let all = model.beams.iter().zip(records).zip(sets);
    let able = all.filter(|((beam, _), _)| can_yield(model, beam));
    able.map(|((beam, record), set)| {
        let none = SectionPeak { value: 0.0, s: f64::NAN, time: f64::NAN };
        let or_none = |peak: SectionPeak| if record.first.is_some() { peak } else { none };
        let mut out = PlasticSummary {
            name: beam.name.clone(),
            strain_max: or_none(record.strain),
            accumulated_max: or_none(record.accumulated),
            first_yield: record.first,
            hinges: hinges(model, state, beam),
            dissipated: 0.0,
            dissipated_by_preload: record.preload,
            hardening: 0.0,
            permanent_set: *set,
            failed: 0,
            parted: record.parted.clone(),
        };
        for point in points(model, state, beam, false) {
            for (fibre, memory) in point.fibres.iter().zip(point.states) {
                let volume = point.weight * fibre.area;
                out.dissipated += volume * memory.dissipated;
                out.hardening += volume * point.of.laws[fibre.law].hardening_energy(memory);
                out.failed += usize::from(memory.failed && fibre.carries_force);
            }
        }
        out
    })
    .collect()
}

/// Results of beams that can yield in an equilibrium, one entry each, shape (beams that can yield): as after a run, but without times.
pub fn yielded_at_rest(model: &Model, found: &Equilibrium) -> Vec<PlasticSummary> {
    if !model.has_fibres() {
        return Vec::new();
    }
    let mut records = vec![YieldRecord::default(); model.beams.len()];
    note(model, &found.state, &mut records);
    let mut all = summaries(model, &found.state, &records, &sets(model, &found.state));
    for beam in &mut all {
        let index = model.beams.iter().position(|own| own.name == beam.name);
        let first = index.and_then(|k| found.first_yields.get(k).copied().flatten());
        if let Some(yielded) = &mut beam.first_yield {
            yielded.s = first.map_or(beam.accumulated_max.s, |first| first.s);
            yielded.time = f64::NAN;
        }
        beam.strain_max.time = f64::NAN;
        beam.accumulated_max.time = f64::NAN;
    }
    all
}

/// Plastic curvature at a Gauss point: the part of the bending strain that its moment does not cause.
fn plastic_curvature(point: &GaussFibres) -> f64 {
    let [membrane, bending] = point.strains;
    let (mut moment, mut stiffness) = (0.0, 0.0);
    for (fibre, memory) in point.fibres.iter().zip(point.states) {
        let law = &point.of.laws[fibre.law];
        let strain = membrane + fibre.height * bending;
        moment += fibre.area * fibre.height * law.stress(memory, strain);
        stiffness += fibre.area * fibre.height * fibre.height * law.young();
    }
    bending - moment / stiffness
}

/// Curvature at which a fibre of a Gauss point first yields in pure bending \[1/m\].
fn first_yield_curvature(point: &GaussFibres) -> f64 {
    let curvature = |fibre: &Fibre| match &point.of.laws[fibre.law] {
        StressLaw::Plastic(law) if fibre.carries_force => {
            let first = law.plasticity.curve.first().map_or(0.0, |part| part.stress);
            first / (law.young * fibre.height.abs())
        }
        _ => f64::INFINITY,
    };
    let least = point.fibres.iter().map(curvature).fold(f64::INFINITY, f64::min);
    if least.is_finite() { least } else { 0.0 }
}

/// Stretches of neighbouring Gauss points that have bent plastically to the same side.
fn hinges(model: &Model, state: &State, beam: &BeamData) -> Vec<PlasticHinge> {
    let mut out: Vec<PlasticHinge> = Vec::new();
    let mut side = 0.0;
    for point in points(model, state, beam, true) {
        let carries_force = |(fibre, s): (&Fibre, &FibreState)| fibre.carries_force && !s.failed;
        let whole = point.fibres.iter().zip(point.states).any(carries_force);
        // An open section rotates without yielding, and the moment does not distinguish the two.
        let gapes = point.of.laws.iter().any(|law| law.slack().is_some());
        let yielded = whole && !gapes && point.states.iter().any(|s| s.accumulated > 0.0);
        let curvature = if yielded { plastic_curvature(&point) } else { 0.0 };
        let bent = curvature.abs() > LEAST_BENT * first_yield_curvature(&point);
        // The bending strain counts a turn counter-clockwise as negative.
        let turned = if bent { -curvature * point.weight } else { 0.0 };
        if turned == 0.0 {
            side = 0.0;
            continue;
        }
        let lost = |(fibre, s): (&Fibre, &FibreState)| fibre.area * s.dissipated * point.weight;
        let dissipated: f64 = point.fibres.iter().zip(point.states).map(lost).sum();
        if turned.signum() != side {
            side = turned.signum();
            out.push(PlasticHinge {
                s: 0.0,
                length: 0.0,
                element_length: f64::NAN,
                rotation: 0.0,
                dissipated: 0.0,
            });
        }
        let Some(hinge) = out.last_mut() else { continue };
        hinge.s += turned * point.s;
        hinge.rotation += turned;
        hinge.length += point.weight;
        hinge.dissipated += dissipated;
        debug_assert!(point.span.fibres.is_some());
    }
    for hinge in &mut out {
        hinge.s /= hinge.rotation;
        hinge.element_length = element_length_at(model, beam, hinge.s);
    }
    out
}

/// Length of the element of a beam at an arc length; at a node that of the one before it \[m\].
fn element_length_at(model: &Model, beam: &BeamData, s: f64) -> f64 {
    let spans = model.spans[beam.spans.clone()].iter();
    let mut elements = spans.flat_map(|span| (0..span.elements.len()).map(move |k| (span, k)));
    let found = elements.find(|(span, k)| s <= span.stations[k + 1]);
    found.map_or(f64::NAN, |(span, k)| span.table(k).length)
}
