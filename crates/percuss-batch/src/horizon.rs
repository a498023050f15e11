//! Horizon of the derivatives of a run, and the results that are final at that time.

use percuss::*;

/// Impacts of the run and of its derivatives correspond if their times differ by less than this share of the step, and their impulses by less than
/// this share: instants are located more accurately, and later impacts magnify their errors.
const SAME: f64 = 1e-3;

/// Impacts with less than this share of the largest previous impulse are slight: accumulating impacts are many, round-off adds or removes one, and
/// the following motion depends only on their decay. It agrees as well, relative to its scale.
const SLIGHT: f64 = 1e-3;

/// Runs end in the same state if energies and velocities differ by less than this share of the energy and of the fastest approach.
const ALIKE: f64 = 1e-4;

/// The projectile rebounds in an impact whose separation velocity exceeds this share of its approach velocity.
const BOUNCES: f64 = 1e-3;

/// Time up to which the derivatives of a run are valid.
#[derive(Clone, Debug, PartialEq)]
pub struct Horizon {
    /// End of the valid derivatives \[s\].
    pub time: f64,
    /// Reason why later derivatives are not valid.
    pub why: String,
}

/// Time up to which impacts and resting contacts of a run with derivatives agree with those of the run itself.
pub fn agreeing(
    own: &RunSummary,
    run: &RunSummary,
    step: f64,
    reached: Option<Horizon>,
) -> Option<Horizon> {
    let mut horizon = reached;
    for (mine, all) in own.contacts.iter().zip(&run.contacts) {
        let (Some((impacts, intervals)), Some((others, rests))) = (rigid(mine), rigid(all)) else {
            continue;
        };
        let until = horizon.as_ref().map_or(f64::INFINITY, |horizon| horizon.time);
        let matched = Matched::of(impacts, others, step);
        let unlike = matched.slight.filter(|_| horizon.is_none() && !ends_alike(own, run));
        let again = strikes_again(others, rests);
        let parted = [matched.parted, unlike, parting_rests(intervals, rests, step), again];
        let parted = parted.into_iter().flatten().reduce(f64::min);
        let Some(time) = parted.filter(|time| *time < until) else { continue };
        let rests = rests.iter().any(|interval| (interval.start - time).abs() <= step);
        let why = if again == Some(time) {
            format!(
                "where `{}` rebounds after its release, at an instant known only to within a step",
                all.name
            )
        } else if rests {
            format!("where the contact of `{}` begins to stay closed", all.name)
        } else {
            let name = &all.name;
            format!("where impacts of `{name}` become too sensitive to their instants")
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

/// Whether two runs end in the same state: equal energies and equal velocities of projectiles.
fn ends_alike(own: &RunSummary, run: &RunSummary) -> bool {
    let energy = (own.energy.final_ - run.energy.final_).abs() <= ALIKE * run.energy.scale;
    let fastest = run.contacts.iter().filter_map(rigid).flat_map(|(impacts, _)| impacts);
    let fastest = fastest.map(|impact| impact.approach_velocity).fold(0.0, f64::max);
    let velocities = |s: &RunSummary| -> Vec<f64> {
        s.projectiles.iter().flat_map(|p| p.velocity_final).collect()
    };
    let alike = |(a, b): (f64, f64)| (a - b).abs() <= ALIKE * fastest;
    energy && velocities(own).into_iter().zip(velocities(run)).all(alike)
}

/// Corresponding impacts of two runs.
struct Matched {
    /// Their numbers in both runs, shape (such impacts, 2) \[index of an impact\].
    pairs: Vec<[usize; 2]>,
    /// Time of the first slight impact that only one of the runs has, and of the first such impact that is not slight \[s\].
    slight: Option<f64>,
    parted: Option<f64>,
}

impl Matched {
    fn of(own: &[Impact], all: &[Impact], step: f64) -> Self {
        let mut found = Self { pairs: Vec::new(), slight: None, parted: None };
        let (mut i, mut j, mut largest) = (0, 0, 0.0_f64);
        while i.min(j) < ContactRecord::IMPACTS_KEPT {
            let (a, b) = (own.get(i), all.get(j));
            if let (Some(a), Some(b)) = (a, b)
                && is_same(a, b, step)
            {
                found.pairs.push([i, j]);
                largest = largest.max(b.impulse);
                (i, j) = (i + 1, j + 1);
                continue;
            }
            let time = |impact: Option<&Impact>| impact.map_or(f64::INFINITY, |one| one.time);
            let slight =
                |impact: Option<&Impact>| impact.is_some_and(|one| one.impulse <= SLIGHT * largest);
            let first = time(a).min(time(b));
            let earlier = if time(a) <= time(b) { [a, b] } else { [b, a] };
            let skipped = earlier.into_iter().find(|impact| slight(*impact)).flatten();
            let Some(skipped) = skipped else {
                found.parted = Some(first).filter(|time| time.is_finite());
                break;
            };
            found.slight = found.slight.or(Some(first));
            let mine = a.is_some_and(|a| std::ptr::eq(a, skipped));
            (i, j) = if mine { (i + 1, j) } else { (i, j + 1) };
        }
        found
    }
}

/// Time of the first impact with a rebound after the end of a resting contact. A resting contact ends at the end of a step; rebounds magnify the
/// error of this instant, until the results depend on the grid of steps.
fn strikes_again(impacts: &[Impact], rests: &[ContactInterval]) -> Option<f64> {
    let released = rests.iter().map(|rest| rest.end).find(|end| end.is_finite())?;
    let bounces =
        |impact: &&Impact| impact.separation_velocity > BOUNCES * impact.approach_velocity;
    let after = impacts.iter().filter(|impact| impact.time > released);
    after.filter(bounces).map(|impact| impact.time).reduce(f64::min)
}

/// Time of the first start or end of a resting contact that only one of two lists has.
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

/// Assigns derivatives to the impacts of a run; impacts without a counterpart in the run with derivatives, `own`, have none.
pub fn align(derivative: &mut RunSummary, run: &RunSummary, own: &RunSummary, step: f64) {
    for ((derivative, run), own) in
        derivative.contacts.iter_mut().zip(&run.contacts).zip(&own.contacts)
    {
        let (Some((own, _)), Some((all, _))) = (rigid(own), rigid(run)) else { continue };
        let ContactRecord::Nonsmooth { impacts, impact_count, .. } = &mut derivative.record else {
            continue;
        };
        let mut aligned = vec![underived(); all.len()];
        for [i, j] in Matched::of(own, all, step).pairs {
            aligned[j] = impacts[i];
        }
        (*impacts, *impact_count) = (aligned, count(run));
    }
}

fn count(contact: &ContactSummary) -> usize {
    match &contact.record {
        ContactRecord::Nonsmooth { impact_count, .. } => *impact_count,
        ContactRecord::Smooth { intervals, .. } => intervals.len(),
    }
}

/// An impact without derivatives.
fn underived() -> Impact {
    let nan = f64::NAN;
    Impact {
        time: nan,
        impulse: nan,
        tangential_impulse: nan,
        points: 1,
        approach_velocity: nan,
        separation_velocity: nan,
        place: ContactPlace::default(),
        energy: EnergySplit { given: [nan; 2], lost: nan, failure: nan, stored: nan, scheme: nan },
        fallback_law: false,
    }
}

/// Removes the derivatives of all results that are not final at the time `until`; `own` is the run with derivatives up to there.
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

/// Removes the derivatives of a beam that yields.
pub fn withdraw_plastic(beam: &mut PlasticSummary) {
    beam.strain_max.value = f64::NAN;
    beam.accumulated_max.value = f64::NAN;
    (beam.dissipated, beam.hardening) = (f64::NAN, f64::NAN);
}

/// The peak of the whole run has a derivative if it occurs before the horizon.
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
            // The separation velocity of an interval follows from the next step.
            let done = own.iter().take_while(|interval| interval.end + 2.0 * step < until).count();
            intervals.truncate(done);
        }
        (
            ContactRecord::Nonsmooth { impacts, impulse_total, impulse_resting, intervals, .. },
            ContactRecord::Nonsmooth { impacts: all, .. },
            ContactRecord::Nonsmooth { intervals: rests, .. },
        ) => {
            (*impulse_total, *impulse_resting) = (f64::NAN, f64::NAN);
            intervals.truncate(rests.iter().take_while(|rest| rest.end < until).count());
            impacts.truncate(all.iter().take_while(|impact| impact.time < until).count());
        }
        _ => {}
    }
}
