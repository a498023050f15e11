//! What the advisor says of compliant contacts that are pressed in deep, or slide on in what they have crushed.

use crate::common;

use common::{at, disc};
use percuss::*;
use percuss_advice::*;

const MASS: f64 = 10.0;
const SPEED: f64 = 5.0;

/// A disc of 20 mm radius on a bar of 50 mm depth between clamps.
fn struck(stiffness: f64) -> (Vec<Advice>, RunSummary, Vec<Advice>) {
    let law = SmoothLaw::elastic(Potential::Linear { stiffness });
    of(disc("ball", MASS, 0.02, [0.5, 0.0451], [0.0, -SPEED]), law, 0.0)
}

fn of(ball: Disc, law: SmoothLaw, gravity: f64) -> (Vec<Advice>, RunSummary, Vec<Advice>) {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("steel", 2.1e11, 7850.0));
    let section = b.section(Section::rectangle("bar", 0.05, 0.05));
    let bar = b.beam(Beam::new("bar", &[[0.0; 2], [1.0, 0.0]], 8, material, section));
    for end in [0.0, 1.0] {
        b.support(Support::new(format!("at {end}"), at("end", bar, end), SupportKind::Clamp));
    }
    let ball = b.disc(ball);
    let between = [ContactPartner::Disc(ball), ContactPartner::Beam(bar)];
    b.contact(Contact::new("blow", between, TouchLaw::Smooth(law)));
    if gravity > 0.0 {
        b.load(Load::new("g", LoadKind::Gravity { acceleration: [0.0, -gravity] }));
    }
    let (model, settings) = (b.build().unwrap(), Settings::new(0.06, 1e-4));
    let before = advise(&model, &settings);
    let run = simulate(&model, &settings, &mut NoRecorder).unwrap();
    let after = review(&model, &settings, &run, &before);
    (before, run, after)
}

fn reported(all: &[Advice], topic: Topic) -> Option<&Advice> {
    all.iter().find(|one| one.topic == topic)
}

#[test]
fn a_contact_pressed_in_by_half_of_what_touches_is_reported_before_and_after() {
    // Up to 71 mm of the 45 that radius and half depth are together; the bar gives way a little.
    let (before, run, after) = struck(5e4);
    let predicted = reported(&before, Topic::Pressed).expect("a note");
    assert_eq!((predicted.verdict, predicted.reference), (Verdict::Note, 0.045));
    let most = SPEED * (MASS / 5e4_f64).sqrt();
    assert!((predicted.value / most - 1.0).abs() < 1e-12, "{predicted:?}");
    let found = reported(&after, Topic::Pressed).expect("a warning");
    let pressed = run.contacts[0].pressed_in.unwrap();
    assert_eq!((found.verdict, found.value), (Verdict::Warning, pressed.penetration));
    assert!(pressed.penetration < most && pressed.penetration > 0.95 * most, "{pressed:?}");
    assert!(pressed.through == 0.045, "{pressed:?}");
    // The force of a linear law tells how deep it was: to the way between two steps about the largest.
    let ContactRecord::Smooth { peak_force, .. } = &run.contacts[0].record else { panic!() };
    assert!((peak_force.value / 5e4 / pressed.penetration - 1.0).abs() < 1e-3, "{pressed:?}");
    let (before, run, after) = struck(5e6);
    let pressed = run.contacts[0].pressed_in.unwrap();
    assert!(pressed.penetration > 1e-3 && !pressed.is_deep(), "{pressed:?}");
    assert!([before, after].iter().all(|all| reported(all, Topic::Pressed).is_none()));
}

#[test]
fn a_dent_that_is_carried_along_is_reported_with_its_depth_and_way() {
    let law = |unloading| SmoothLaw {
        unloading,
        ..SmoothLaw::elastic(Potential::Linear { stiffness: 1e5 })
    };
    let slides = |along: f64, unloading: Option<f64>| {
        of(disc("ball", 2.0, 0.05, [0.4, 0.075], [along, 0.0]), law(unloading), 9.81).2
    };
    let all = slides(3.0, Some(9e5));
    let found = reported(&all, Topic::CarriedCrush).expect("a warning");
    assert!(found.verdict == Verdict::Warning && found.value > 0.0, "{found:?}");
    assert!(found.reference > found.value && found.text.contains("along the face"), "{found:?}");
    for (along, unloading) in [(0.0, Some(9e5)), (3.0, None)] {
        assert!(reported(&slides(along, unloading), Topic::CarriedCrush).is_none(), "{along}");
    }
}
