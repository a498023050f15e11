//! A contact of many points: the resultant is reported.

use crate::common;

use common::beam;
use percuss::*;

const STEP: f64 = 2e-5;

/// A free strip that falls flat, or a little askew, on a floor under a smooth law.
fn strip(points_per_element: usize, lean: f64, stiffness: f64) -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("steel", 200e9, 7800.0));
    let section = Section { depth: Some(0.01), ..Section::new("strip", 1e-4, 8.3333e-10) };
    let section = b.section(section);
    let strip = b.beam(beam("strip", [0.0, 0.0061], [0.5, 0.0061 + lean], 8, material, section));
    let floor = b.obstacle(Obstacle {
        name: "floor".into(),
        shape: ObstacleShape::HalfPlane { point: [0.0, 0.0], normal: [0.0, 1.0] },
        motion: None,
    });
    let law = TouchLaw::Smooth(SmoothLaw::elastic(Potential::Linear { stiffness }));
    let contact =
        Contact::new("clap", [ContactPartner::Beam(strip), ContactPartner::Obstacle(floor)], law);
    b.contact(Contact { points_per_element, ..contact });
    b.initial_motion(InitialMotion { velocity: [0.3, -2.0], ..InitialMotion::default() });
    b.build().unwrap()
}

/// Rows of the history.
struct Run {
    summary: RunSummary,
    rows: MemoryRecorder,
}

impl Run {
    fn of(model: &Model, settings: &Settings) -> Self {
        let mut rows = MemoryRecorder::default();
        let summary = simulate(model, settings, &mut rows).unwrap();
        Self { summary, rows }
    }

    fn column(&self, name: &str) -> Vec<f64> {
        self.rows.column(name).unwrap().to_vec()
    }

    fn smooth(&self) -> (Peak, &[ContactInterval]) {
        match &self.summary.contacts[0].record {
            ContactRecord::Smooth { peak_force, intervals } => (*peak_force, intervals),
            ContactRecord::Nonsmooth { .. } => panic!("a smooth contact"),
        }
    }
}

/// The largest force of a contact is that of its curve, however many points carry it: not below any row, and above the largest by
/// no more than the force changes by between the rows around it.
#[test]
fn the_largest_force_is_that_of_all_points_together() {
    for points in [1, 2, 4, 8] {
        for lean in [0.0, 0.002] {
            let model = strip(points, lean, 2e5);
            let run = Run::of(&model, &Settings::new(4e-3, STEP));
            let force = run.column("contact.clap.force");
            let (peak, intervals) = run.smooth();
            let row = (0..force.len()).max_by(|a, b| force[*a].total_cmp(&force[*b])).unwrap();
            let around = &force[row.saturating_sub(2)..(row + 3).min(force.len())];
            let change = around.windows(2).map(|w| (w[1] - w[0]).abs()).fold(0.0, f64::max);
            assert!(peak.value >= force[row] * (1.0 - 1e-12), "{points} {lean}: {peak:?}");
            assert!(peak.value <= force[row] + change, "{points} {lean}: {peak:?} {}", force[row]);
            assert!((peak.time - run.column("time")[row]).abs() <= 2.0 * STEP);
            let largest = intervals.iter().map(|i| i.peak_force.value).fold(0.0, f64::max);
            assert_eq!(largest, peak.value);
        }
    }
}

/// An interval lasts from the closing of the first point until the opening of the last, so intervals of a contact never overlap, their number is
/// that of the humps of its force curve, and their impulse is that of the columns of the history.
#[test]
fn intervals_are_those_of_the_contact() {
    for points in [1, 4] {
        let run = Run::of(&strip(points, 0.002, 2e5), &Settings::new(6e-3, STEP));
        let (_, intervals) = run.smooth();
        assert!(intervals.windows(2).all(|w| w[0].end <= w[1].start), "{intervals:?}");
        let force = run.column("contact.clap.force");
        let humps = force.windows(2).filter(|w| w[0] == 0.0 && w[1] > 0.0).count();
        assert_eq!(intervals.len(), humps, "{points}");
        let given: f64 = intervals.iter().map(|i| i.impulse).sum();
        let rows: f64 = run.column("contact.clap.impulse").iter().sum();
        assert!((given - rows).abs() <= 1e-12 * rows, "{given} {rows}");
        for interval in intervals {
            let split = interval.energy;
            let sum = split.given[0] + split.given[1] + split.lost + split.stored;
            assert!(sum.abs() < 1e-10, "{split:?}");
        }
        // The left end is lower by two millimetres, and touches first; its corner is half a depth from the axis.
        let first = &intervals[0];
        assert!(first.place.s < 1e-9 && (first.approach_velocity - 2.0).abs() < 0.01, "{first:?}");
    }
}

/// Points of one contact that strike at one instant are one impact.
#[test]
fn points_that_strike_at_once_are_one_impact() {
    for impacts in
        [ImpactResolution::Event, ImpactResolution::TimeStepping { closed_tolerance: 1e-9 }]
    {
        let mut b = ModelBuilder::new();
        let material = b.material(Material::new("steel", 200e9, 7800.0));
        let section = Section { depth: Some(0.01), ..Section::new("strip", 1e-4, 8.3333e-10) };
        let section = b.section(section);
        let strip = b.beam(beam("strip", [0.0, 0.00605], [0.5, 0.00605], 4, material, section));
        let floor = b.obstacle(Obstacle {
            name: "floor".into(),
            shape: ObstacleShape::HalfPlane { point: [0.0, 0.0], normal: [0.0, 1.0] },
            motion: None,
        });
        let law = TouchLaw::Rigid(RigidLaw::frictionless(0.0));
        b.contact(Contact::new(
            "clap",
            [ContactPartner::Beam(strip), ContactPartner::Obstacle(floor)],
            law,
        ));
        b.initial_motion(InitialMotion { velocity: [0.0, -2.0], ..InitialMotion::default() });
        let model = b.build().unwrap();
        let settings = Settings { impacts, ..Settings::new(1e-3, 1e-5) };
        let run = Run::of(&model, &settings);
        let ContactRecord::Nonsmooth { impacts, impact_count, impulse_total, .. } =
            &run.summary.contacts[0].record
        else {
            panic!("a rigid contact");
        };
        assert_eq!(*impact_count, 1, "{impacts:?}");
        let momentum = 2.0 * 7800.0 * 1e-4 * 0.5;
        assert!((impacts[0].impulse - momentum).abs() < 1e-6 * momentum, "{:?}", impacts[0]);
        assert!(impacts[0].points >= 5, "{:?}", impacts[0]);
        assert!((impulse_total - momentum).abs() < 1e-6 * momentum, "{impulse_total}");
    }
}
