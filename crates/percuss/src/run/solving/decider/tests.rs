//! A mass and a wall, without a solver: decisions for given motions.

use super::*;

fn first_step() -> Decider {
    let settings = Settings::new(1.0, 0.1);
    Decider::new(&settings, 1.0, settings.size_behind(0))
}

fn rigid_pair(contact: usize, gap: f64, rate: f64) -> RigidPair {
    let (closed, approach_max, restitution) = (false, 0.0, [0.5, 0.0]);
    RigidPair { contact, gap, rate, closed, approach_max, restitution }
}

fn moment(offset: f64, contacts: &[RigidPair]) -> Moment {
    Moment {
        offset,
        cut: f64::INFINITY,
        jumps: false,
        located: None,
        contacts: contacts.to_vec(),
        nothing: Negligible { rate: 1e-12, gap: 1e-12, gap_difference: 1e-12 },
    }
}

#[test]
fn a_size_that_failed_is_tried_again_behind_a_whole_part_alone() {
    let mut decider = first_step();
    let at = moment(0.0, &[]);
    assert!(decider.goes_on(&at) && decider.part.size == 0.1);
    assert!(decider.halve());
    for _ in 0..2 {
        decider.spend(true);
        assert!(decider.goes_on(&at) && decider.part.size == 0.05);
    }
    assert_eq!(decider.events_left, MOST_EVENTS - 2);
    decider.spend(false);
    assert!(decider.goes_on(&at) && decider.part.size == 0.1);
}

/// A mass in free motion towards a wall: its path replaces the solution.
#[test]
fn an_instant_of_contact_is_located_and_then_struck_until_impacts_accumulate() {
    let mut decider = first_step();
    let (gap, rate) = (0.03, -1.0);
    assert!(decider.goes_on(&moment(0.0, &[rigid_pair(4, gap, rate)])));
    assert_eq!(decider.part.resolution, Resolution::Free);
    let end = loop {
        let h = decider.h();
        let seen = Seen { contact: 4, start: [gap, rate], end: [gap + h * rate, rate] };
        match decider.judge(&[seen], |_| None) {
            Verdict::Again => {}
            Verdict::Ends { located } => break (h, located),
            Verdict::Passed => panic!(),
        }
    };
    // The instant is the middle of the impact interval that follows.
    let interval = 0.1 * IMPACT_INTERVAL;
    assert!((end.0 + 0.5 * interval - gap).abs() <= 1e-3 * interval, "{end:?}");
    assert_eq!(end.1, Some(4));
    decider.spend(true);
    let near = [rigid_pair(4, 0.5 * interval, rate), rigid_pair(5, 1.0, rate)];
    let at = Moment { located: Some(4), ..moment(end.0, &near) };
    assert!(decider.goes_on(&at));
    assert_eq!((decider.part.resolution, decider.h()), (Resolution::Impact, interval));
    let phase = Phase::Impact { restitution: 0.5, tangential: 0.0 };
    assert_eq!(decider.part.active, [ActiveContact { pair: 4, phase }]);
    (1..MOST_EVENTS).for_each(|_| decider.spend(true));
    assert!(decider.accumulates() && decider.goes_on(&at));
    assert_eq!(decider.part.resolution, Resolution::Accumulated);
    assert_eq!(decider.part.active, [ActiveContact::resting(4)]);
    // A contact that would overlap at the end is held as well.
    let inside = Seen { contact: 5, start: [1.0, rate], end: [-0.1, rate] };
    assert_eq!(decider.judge(&[inside], |_| None), Verdict::Again);
    assert_eq!(decider.part.active[1..], [ActiveContact::resting(5)]);
}

#[test]
fn what_approaches_too_slowly_does_not_bounce() {
    let mut decider = first_step();
    let slow = RigidPair { approach_max: 1.0, ..rigid_pair(0, -1e-9, -0.5 * STICK) };
    assert!(decider.goes_on(&moment(0.0, &[slow])));
    let phase = Phase::Impact { restitution: 0.0, tangential: 0.0 };
    assert_eq!(decider.part.active, [ActiveContact { pair: 0, phase }]);
}
