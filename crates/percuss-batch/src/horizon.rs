//! How far the derivatives of a run reach, and what of its results is known by then.

use super::sensitivity::Horizon;
use percuss::*;

/// Impacts of the run and of its derivatives are the same ones if their times differ by less than this share of the step, and their
/// impulses by less than this share: instants are located to less, which later impacts magnify.
const SAME: f64 = 1e-3;

/// How far the impacts and times of rest of a run with derivatives are those of the run itself.
pub fn agreeing(
    own: &RunSummary,
    run: &RunSummary,
    step: f64,
    reached: Option<Horizon>,
) -> Option<Horizon> {
    let mut horizon = reached;
    for (own, run) in own.contacts.iter().zip(&run.contacts) {
        let (ContactRecord::Nonsmooth { impacts, intervals, .. }, Some((all, rests))) =
            (&own.record, rigid(run))
        else {
            continue;
        };
        let until = horizon.as_ref().map_or(f64::INFINITY, |horizon| horizon.time);
        let parted = [parting(impacts, all, step), parting_rests(intervals, rests, step)];
        let parted = parted.into_iter().flatten().reduce(f64::min);
        let Some(time) = parted.filter(|time| *time < until) else { continue };
        let rests = rests.iter().any(|interval| (interval.start - time).abs() <= step);
        let why = if rests {
            format!("the contact of `{}` stays closed from there", run.name)
        } else {
            let name = &run.name;
            format!(
                "from there on impacts of `{name}` are more sensitive than their instants known"
            )
        };
        horizon = Some(Horizon { time, why });
    }
    horizon
}

fn rigid(contact: &ContactSummary) -> Option<(&[Impact], &[ContactInterval])> {
    match &contact.record {
        ContactRecord::Nonsmooth { impacts, intervals, .. } => Some((impacts, intervals)),
        ContactRecord::Smooth { .. } => None,
    }
}

/// Time of the first impact that only one of two lists has.
fn parting(own: &[Impact], all: &[Impact], step: f64) -> Option<f64> {
    let same = own.iter().zip(all).take_while(|(a, b)| is_same(a, b, step)).count();
    let next = |list: &[Impact]| list.get(same).map_or(f64::INFINITY, |impact| impact.time);
    let kept = own.len().min(all.len()) < ContactRecord::IMPACTS_KEPT;
    let time = next(own).min(next(all));
    (time.is_finite() && (kept || same < ContactRecord::IMPACTS_KEPT)).then_some(time)
}

/// Time of the first beginning or end of a rest that only one of two lists has.
fn parting_rests(own: &[ContactInterval], all: &[ContactInterval], step: f64) -> Option<f64> {
    let known = |list: &[ContactInterval], k: usize| {
        list.get(k).map_or([f64::INFINITY; 2], |one| {
            [one.start, if one.end.is_nan() { f64::INFINITY } else { one.end }]
        })
    };
    let most = own.len().max(all.len());
    let (mine, others) =
        ((0..most).flat_map(|k| known(own, k)), (0..most).flat_map(|k| known(all, k)));
    let same = |(a, b): &(f64, f64)| a == b || (a - b).abs() <= SAME * step;
    let pairs = mine.zip(others);
    pairs
        .into_iter()
        .find(|pair| !same(pair))
        .map(|(a, b)| a.min(b))
        .filter(|time| time.is_finite())
}

fn is_same(a: &Impact, b: &Impact, step: f64) -> bool {
    let impulse = (a.impulse - b.impulse).abs() <= SAME * a.impulse.abs().max(b.impulse.abs());
    (a.time - b.time).abs() <= SAME * step && impulse
}

/// Leaves of the derivatives of a run what is known at a time before its end; `own` is the run with derivatives up to there.
pub fn withdraw(
    derivative: &mut RunSummary,
    run: &RunSummary,
    own: &RunSummary,
    until: f64,
    step: f64,
) {
    let nan = f64::NAN;
    derivative.time = nan;
    let initial = derivative.energy.initial;
    derivative.energy = EnergySummary {
        initial,
        final_: nan,
        work_loads: nan,
        work_supports: nan,
        loss_impacts: nan,
        loss_damping: nan,
        plastic: nan,
        hardening: nan,
        failure: 0.0,
        scale: nan,
        residual_max: nan,
    };
    derivative.momentum.linear_scale = nan;
    derivative.momentum.angular_scale = nan;
    for projectile in &mut derivative.projectiles {
        projectile.velocity_final = [nan; 2];
        projectile.momentum_transferred = nan;
        projectile.energy_given = nan;
        projectile.energy_received_by_others = nan;
    }
    for ((point, run), own) in derivative.points.iter_mut().zip(&run.points).zip(&own.points) {
        let both = run.displacement_max.iter().zip(&own.displacement_max);
        for (peak, both) in point.displacement_max.iter_mut().zip(both) {
            withdraw_peak(peak, both, until, step);
        }
    }
    for ((contact, run), own) in
        derivative.contacts.iter_mut().zip(&run.contacts).zip(&own.contacts)
    {
        withdraw_contact(contact, run, own, until, step);
    }
}

/// Leaves nothing of what became of a beam that yields.
pub fn withdraw_plastic(beam: &mut PlasticSummary) {
    beam.strain_max.value = f64::NAN;
    beam.accumulated_max.value = f64::NAN;
    (beam.dissipated, beam.hardening) = (f64::NAN, f64::NAN);
}

/// What is largest in the whole run has a derivative if it is what was largest so far.
fn withdraw_peak(peak: &mut Peak, (run, own): (&Peak, &Peak), until: f64, step: f64) {
    let same = (run.time - own.time).abs() <= SAME * step;
    if !(same && run.time < until) {
        *peak = Peak::default();
    }
}

fn withdraw_contact(
    contact: &mut ContactSummary,
    run: &ContactSummary,
    own: &ContactSummary,
    until: f64,
    step: f64,
) {
    match (&mut contact.record, &run.record, &own.record) {
        (
            ContactRecord::Smooth { peak_force, intervals },
            ContactRecord::Smooth { peak_force: highest, .. },
            ContactRecord::Smooth { intervals: own, peak_force: so_far },
        ) => {
            withdraw_peak(peak_force, (highest, so_far), until, step);
            // The step after an interval tells how it parted.
            let done = own.iter().take_while(|interval| interval.end + 2.0 * step < until).count();
            intervals.truncate(done);
        }
        (
            ContactRecord::Nonsmooth { impacts, impulse_total, impulse_resting, intervals, .. },
            _,
            ContactRecord::Nonsmooth { impacts: own, intervals: rests, .. },
        ) => {
            (*impulse_total, *impulse_resting) = (f64::NAN, f64::NAN);
            intervals.truncate(rests.iter().take_while(|rest| rest.end < until).count());
            impacts.truncate(own.iter().take_while(|impact| impact.time < until).count());
        }
        _ => {}
    }
}
