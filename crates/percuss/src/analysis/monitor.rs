//! Follows a run and gathers what its summary tells: peaks, contact intervals, impacts, largest residuals.
//!
//! Between the ends of a step, gap and displacements are cubics through values and velocities: peaks and instants of contact
//! are resolved within the step.

use super::section_forces;
use crate::contact::law;
use crate::ledger::{Books, Measures};
use crate::math::hermite::{Cubic, GAUSS};
use crate::math::roots;
use crate::model::Model;
use crate::model::frozen::ContactLaw;
use crate::state::State;
use crate::summary::{
    ContactInterval, ContactRecord, Impact, Peak, Range, SectionForceSummary, SupportSummary,
};

/// Values at the start of a step that the monitor compares with those at its end.
#[derive(Clone, Debug, Default)]
struct Start {
    time: f64,
    gap: Vec<[f64; 2]>,
    points: Vec<[[f64; 2]; 2]>,
    spin: Vec<[f64; GAUSS]>,
    reactions: Vec<[f64; 3]>,
}

/// Follows one run.
#[derive(Clone, Debug)]
pub struct Monitor {
    start: Start,
    /// One record a projectile.
    pub contacts: Vec<ContactRecord>,
    /// Extremes of the recorded points.
    pub points: Vec<[Peak; 2]>,
    /// Extremes of the section forces, one entry a beam.
    pub section_forces: Vec<SectionForceSummary>,
    /// Extremes of the reactions, one entry a support.
    pub supports: Vec<SupportSummary>,
    /// Size of the last step that was not as short as an impact \[s\], and the spins at its start.
    steady: Option<(Vec<[f64; GAUSS]>, f64)>,
    /// Largest energy residual \[J\].
    pub energy_residual: f64,
    /// Largest residual of linear momentum \[kg m/s\].
    pub linear_residual: f64,
    /// Largest residual of angular momentum \[kg m^2/s\].
    pub angular_residual: f64,
    /// Largest drift of stored bending strains \[1/m\].
    pub curvature_drift: f64,
    /// Largest drift of stored membrane strains \[1\].
    pub membrane_drift: f64,
}

impl Monitor {
    /// Opens the record at the initial state.
    pub fn new(model: &Model, state: &State) -> Self {
        let contacts = model.projectiles.iter().enumerate().map(|(i, p)| match p.law {
            ContactLaw::Spring { stiffness, .. } => {
                let value = law::force(stiffness, -state.gap(model, i));
                let peak_force = Peak { value, time: state.time };
                ContactRecord::Smooth { peak_force, intervals: Vec::new() }
            }
            ContactLaw::Unilateral { .. } => ContactRecord::Nonsmooth {
                impacts: Vec::new(),
                impact_count: 0,
                impulse_total: 0.0,
                intervals: Vec::new(),
            },
        });
        let points = model
            .points
            .iter()
            .map(|p| p.value(&state.displacement).map(|value| Peak { value, time: state.time }));
        let mut monitor = Self {
            start: Start::default(),
            contacts: contacts.collect(),
            points: points.collect(),
            section_forces: section_forces::unset(model),
            supports: model.supports.iter().map(|s| unset_support(&s.name)).collect(),
            steady: None,
            energy_residual: 0.0,
            linear_residual: 0.0,
            angular_residual: 0.0,
            curvature_drift: 0.0,
            membrane_drift: 0.0,
        };
        monitor.start.gap.resize(model.projectiles.len(), [0.0; 2]);
        monitor.start.points.resize(model.points.len(), [[0.0; 2]; 2]);
        section_forces::update(model, state, None, &mut monitor.section_forces);
        monitor.begin_step(model, state);
        monitor
    }

    /// Notes the start of a step.
    pub fn begin_step(&mut self, model: &Model, state: &State) {
        self.start.time = state.time;
        for (i, gap) in self.start.gap.iter_mut().enumerate() {
            *gap = [state.gap(model, i), state.gap_rate(model, i)];
        }
        for (start, p) in self.start.points.iter_mut().zip(&model.points) {
            *start = [p.value(&state.displacement), p.value(&state.velocity)];
        }
        self.start.spin.clone_from(&state.spin);
        self.start.reactions.clone_from(&state.reactions);
    }

    /// Angular rates at the start of the last step that was not as short as an impact, and its size.
    pub fn before(&self) -> section_forces::Before<'_> {
        self.steady.as_ref().map(|(spin, h)| (spin.as_slice(), *h))
    }

    /// Takes in the end of a step of size `h` with its smooth contact forces; `brief` if it is as short as an impact, so that
    /// quotients over it are impulsive.
    pub fn end_step(&mut self, model: &Model, state: &State, h: f64, force: &[f64], brief: bool) {
        if brief {
            section_forces::update(model, state, None, &mut self.section_forces);
        } else {
            self.reactions(state, h);
            let (spin, size) = self.steady.get_or_insert_default();
            spin.clone_from(&self.start.spin);
            *size = h;
            let before = self.steady.as_ref().map(|(spin, h)| (spin.as_slice(), *h));
            section_forces::update(model, state, before, &mut self.section_forces);
        }
        for (i, p) in model.projectiles.iter().enumerate() {
            if let ContactLaw::Spring { stiffness, .. } = p.law {
                let end = [state.gap(model, i), state.gap_rate(model, i)];
                let gap = Cubic { h, start: self.start.gap[i], end };
                self.smooth_contact(i, stiffness, &gap, h * force[i]);
            }
        }
        for (k, p) in model.points.iter().enumerate() {
            let (u, v) = (p.value(&state.displacement), p.value(&state.velocity));
            let [u0, v0] = self.start.points[k];
            for c in 0..2 {
                let path = Cubic { h, start: [u0[c], v0[c]], end: [u[c], v[c]] };
                update_peak(&mut self.points[k][c], &path, self.start.time);
            }
        }
    }

    fn reactions(&mut self, state: &State, h: f64) {
        let impulses = state.reactions.iter().zip(&self.start.reactions);
        for (summary, (now, then)) in self.supports.iter_mut().zip(impulses) {
            let mean = |i: usize| (now[i] - then[i]) / h;
            summary.force[0].take(mean(0), state.time);
            summary.force[1].take(mean(1), state.time);
            summary.moment.take(mean(2), state.time);
        }
    }

    fn smooth_contact(&mut self, i: usize, stiffness: f64, gap: &Cubic, impulse: f64) {
        let start = self.start.time;
        let ContactRecord::Smooth { peak_force, intervals } = &mut self.contacts[i] else { return };
        if gap.start[0] >= 0.0 && gap.end[0] >= 0.0 {
            return;
        }
        for t in gap.stationary().chain([gap.h]) {
            let value = law::force(stiffness, -gap.value(t));
            if value > peak_force.value {
                *peak_force = Peak { value, time: start + t };
            }
        }
        let keep = intervals.len() < ContactRecord::IMPACTS_KEPT;
        let open = intervals.last().is_some_and(|last| last.end.is_nan());
        if !open && keep {
            let opens = if gap.start[0] >= 0.0 { crossing(gap) } else { 0.0 };
            intervals.push(ContactInterval { start: start + opens, end: f64::NAN, impulse: 0.0 });
        }
        if let Some(last) = intervals.last_mut().filter(|last| last.end.is_nan()) {
            last.impulse += impulse;
            if gap.end[0] >= 0.0 {
                last.end = start + crossing(gap);
            }
        }
    }

    /// Notes an impact of projectile `i`.
    pub fn impact(&mut self, i: usize, impact: Impact) {
        if let ContactRecord::Nonsmooth { impacts, impact_count, impulse_total, .. } =
            &mut self.contacts[i]
        {
            *impact_count += 1;
            *impulse_total += impact.impulse;
            if impacts.len() < ContactRecord::IMPACTS_KEPT {
                impacts.push(impact);
            }
        }
    }

    /// Notes the impulse of a persistent contact over the step that ends at `state`; `closed` tells whether it still is.
    pub fn persistent(&mut self, i: usize, impulse: f64, end: f64, closed: bool) {
        let start = self.start.time;
        let ContactRecord::Nonsmooth { impulse_total, intervals, .. } = &mut self.contacts[i]
        else {
            return;
        };
        *impulse_total += impulse;
        let open = intervals.last().is_some_and(|last| last.end.is_nan());
        if !open && impulse > 0.0 && intervals.len() < ContactRecord::IMPACTS_KEPT {
            intervals.push(ContactInterval { start, end: f64::NAN, impulse: 0.0 });
        }
        if let Some(last) = intervals.last_mut().filter(|last| last.end.is_nan()) {
            last.impulse += impulse;
            if !closed {
                last.end = end;
            }
        }
    }

    /// Takes the measures of a new state into the largest residuals.
    pub fn audit(&mut self, books: &Books, m: &Measures) {
        let linear = books.linear_residual(m);
        self.energy_residual = larger(self.energy_residual, books.energy_residual(m));
        self.linear_residual = larger(self.linear_residual, linear[0].hypot(linear[1]));
        self.angular_residual = larger(self.angular_residual, books.angular_residual(m));
        self.curvature_drift = larger(self.curvature_drift, m.curvature_drift);
        self.membrane_drift = larger(self.membrane_drift, m.membrane_drift);
    }
}

fn unset_support(name: &str) -> SupportSummary {
    let none = Range::default();
    SupportSummary { name: name.into(), force: [none; 2], moment: none }
}

/// The larger magnitude; NaN stays, so that a broken book cannot look closed.
fn larger(a: f64, b: f64) -> f64 {
    if b.abs() > a || b.is_nan() { b.abs() } else { a }
}

fn update_peak(peak: &mut Peak, path: &Cubic, start: f64) {
    let reach = path.start[0].abs().max(path.end[0].abs());
    let overshoot = (path.start[1].abs() + path.end[1].abs()) * path.h;
    if reach + overshoot <= peak.value.abs() {
        return;
    }
    for t in path.stationary().chain([path.h]) {
        let value = path.value(t);
        if value.abs() > peak.value.abs() {
            *peak = Peak { value, time: start + t };
        }
    }
}

/// The first instant within the step at which the gap changes sign.
fn crossing(gap: &Cubic) -> f64 {
    let opening = gap.start[0] < 0.0;
    let sign = if opening { -1.0 } else { 1.0 };
    let f = |t: f64| sign * gap.value(t);
    // If both ends have the same sign, the cubic dips between them: search up to the dip.
    let ends = [f(0.0), f(gap.h)];
    let until = if ends[1] > 0.0 {
        gap.stationary().find(|t| f(*t) <= 0.0).unwrap_or(gap.h)
    } else {
        gap.h
    };
    if ends[0] <= 0.0 {
        return 0.0;
    }
    let end = f(until);
    let guess = until * ends[0] / (ends[0] - end);
    let search = roots::bracketed((0.0, ends[0]), (until, end), guess, 0.0, 0.0, |t| {
        Ok::<f64, std::convert::Infallible>(f(t))
    });
    match search {
        Ok(t) => t,
    }
}
