//! Summaries of runs in which everything has happened that can: they show what keys there are.

use percuss::{
    ContactInterval, ContactPlace, ContactRecord, ContactSummary, EnergySplit, FirstYield,
    FoundationSummary, Impact, JointParting, JointSummary, Parting, Peak, PermanentSet,
    PlasticHinge, PlasticSummary, SectionPeak, SetOfBeam, YieldingSummary,
};

/// The contact with an interval and an impact.
pub(super) fn contact_with_every_event(contact: &ContactSummary) -> ContactSummary {
    let (nan, place, energy) = (f64::NAN, ContactPlace::default(), EnergySplit::default());
    let interval = ContactInterval {
        start: 0.0,
        end: 0.0,
        impulse: 0.0,
        tangential_impulse: 0.0,
        peak_force: Peak { value: 0.0, time: 0.0 },
        approach_velocity: nan,
        separation_velocity: nan,
        steps: 0,
        steady: true,
        one_point: true,
        torn: false,
        place,
        place_end: place,
        energy,
    };
    let impact = Impact {
        time: 0.0,
        impulse: 0.0,
        tangential_impulse: 0.0,
        points: 1,
        approach_velocity: nan,
        separation_velocity: nan,
        place,
        energy,
        fallback_law: false,
    };
    let mut contact = contact.clone();
    match &mut contact.record {
        ContactRecord::Smooth { intervals, .. } => *intervals = vec![interval],
        ContactRecord::Nonsmooth { impacts, intervals, .. } => {
            *impacts = vec![impact];
            *intervals = vec![interval];
        }
    }
    contact
}

/// The beam yielded, bent at a hinge, for good.
pub(super) fn plastic_with_every_event(beam: &PlasticSummary) -> PlasticSummary {
    let peak = SectionPeak { value: 0.0, s: 0.0, time: 0.0 };
    PlasticSummary {
        strain_max: peak,
        accumulated_max: peak,
        first_yield: Some(FirstYield { s: 0.0, time: 0.0 }),
        hinges: vec![PlasticHinge {
            s: 0.0,
            length: 0.0,
            element_length: 0.0,
            rotation: 0.0,
            dissipated: 0.0,
        }],
        parted: vec![Parting { s: 0.0, stretch: [0.0; 2], time: 0.0, energy: 0.0 }],
        permanent_set: Ok(PermanentSet { s: 0.0, displacement: [0.0; 2] }),
        ..beam.clone()
    }
}

/// The spring or hinge has bent what it acts on for good.
pub(super) fn yielding_with_every_event(connector: &YieldingSummary) -> YieldingSummary {
    let set = PermanentSet { s: 0.0, displacement: [0.0; 2] };
    let permanent_set = Ok(SetOfBeam { beam: String::new(), set });
    YieldingSummary { permanent_set, ..connector.clone() }
}

/// The foundation has yielded.
pub(super) fn foundation_with_every_event(foundation: &FoundationSummary) -> FoundationSummary {
    let plastic = SectionPeak { value: 1.0, s: 0.0, time: 0.0 };
    FoundationSummary { plastic, first_yield: Some(0.0), ..foundation.clone() }
}

/// The joint parted.
pub(super) fn joint_with_every_event(joint: &JointSummary) -> JointSummary {
    let parted = Some(JointParting { time: 0.0, force: 0.0, moment: 0.0 });
    JointSummary { parted, ..joint.clone() }
}
