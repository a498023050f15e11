//! Round ends with a deep penetration of another beam: a source that moves from the cap to the adjacent faces has a continuous gap.

use crate::common;

use common::{at, beam};
use percuss::internals::geometry::configuration::Configuration;
use percuss::internals::geometry::pair::Memory;
use percuss::internals::geometry::touch::SearchRegion;
use percuss::internals::step::newton::Failure;
use percuss::*;

/// A beam between clamps, of 10 mm depth, and a rod with round ends that comes down on it at an angle, its end at `x`.
fn scene(angle: f64, x: f64, stiffness: f64) -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("m", 8e9, 7850.0));
    let section = b.section(Section::rectangle("r", 0.1, 0.01));
    let plank = b.beam(beam("plank", [0.0; 2], [1.0, 0.0], 8, material, section));
    let (y, (sine, cosine)) = (0.012, angle.to_radians().sin_cos());
    let far = [x + 0.4 * cosine, y + 0.4 * sine];
    let rod = Beam { ends: Ends::Round, ..beam("rod", [x, y], far, 4, material, section) };
    let rod = b.beam(rod);
    let motion = InitialMotion { velocity: [0.0, -4.0], spin: 0.0, about: [0.0; 2] };
    b.initial_motion_of("rod", motion);
    for (name, f) in [("left", 0.0), ("right", 1.0)] {
        b.support(Support::new(name, at(name, plank, f), SupportKind::Clamp));
    }
    let law = TouchLaw::Smooth(SmoothLaw::elastic(Potential::Linear { stiffness }));
    let between = [ContactPartner::Beam(rod), ContactPartner::Beam(plank)];
    b.contact(Contact::new("hit", between, law));
    b.build().unwrap()
}

#[test]
fn the_gap_does_not_leap_where_a_cap_that_is_left_to_others_begins() {
    let model = scene(30.0, 0.3, 1e5);
    let nodes = model.node_count();
    let rod = 9..14;
    let (mut crossed, way) = (0, 1e-5);
    // Down by 6 to 16 mm, over the half depths of both; then along, so that points of the plank come out of the cap.
    for down in [0.006, 0.009, 0.012, 0.016] {
        let mut memories = vec![Memory::default(); model.pairs.len()];
        let mut before: Vec<Option<f64>> = vec![None; model.pairs.len()];
        for step in 0..4000 {
            let mut moved = vec![[0.0; 4]; nodes];
            let along = 0.02 - way * f64::from(step);
            rod.clone().for_each(|n| moved[n] = [along, -down, 0.0, 0.0]);
            let now = Configuration::of(&moved);
            for (i, pair) in model.pairs.iter().enumerate() {
                let reach = if step == 0 { SearchRegion::All } else { SearchRegion::Near };
                let Some(touch) = pair.touch(&model, &now, &memories[i], reach) else { continue };
                memories[i] = touch.memory;
                let pressed = touch.gap.min(0.0);
                if let Some(old) = before[i].replace(pressed) {
                    // A gap changes no faster than things move.
                    assert!(
                        (pressed - old).abs() < 1.01 * way,
                        "{down} {step} pair {i}: {old} {pressed}"
                    );
                    crossed += usize::from(old == 0.0 && pressed < 0.0);
                }
            }
        }
    }
    assert!(crossed > 0);
}

#[test]
fn rods_that_come_down_obliquely_on_round_ends_are_followed_however_deep_they_press() {
    for angle in [20.0, 30.0, 40.0, 50.0] {
        for (x, stiffness) in [(0.305, 5e5), (0.305, 5e4), (0.32, 5e4)] {
            let model = scene(angle, x, stiffness);
            let peak = [5e-5, 2.5e-5].map(|step| {
                let run = simulate(&model, &Settings::new(0.01, step), &mut NoRecorder).unwrap();
                let what = format!("{angle} deg, {x} m, {stiffness} N/m, {step} s");
                assert!(matches!(run.termination, Termination::Completed), "{what}: {run:?}");
                assert!(run.energy.residual_max < 1e-11, "{what}: {}", run.energy.residual_max);
                assert!(run.momentum.angular_residual_max < 1e-11, "{what}");
                let ContactRecord::Smooth { peak_force, .. } = &run.contacts[0].record else {
                    panic!("{what}")
                };
                peak_force.value
            });
            assert!((peak[0] / peak[1] - 1.0).abs() < 0.02, "{angle} {x} {stiffness}: {peak:?}");
        }
    }
}

#[test]
fn a_run_that_ends_deep_inside_says_which_contact_is_how_deep() {
    let model = scene(30.0, 0.305, 5e4);
    let mut simulation = Simulation::new(&model, &Settings::new(0.01, 5e-5)).unwrap();
    let failed = |simulation: &Simulation<'_>| {
        simulation.give_up(Failure::Diverged { residual: 0.1, node: 0 }, 1e-9).to_string()
    };
    let before = failed(&simulation);
    assert!(before.ends_with("try a smaller step"), "{before}");
    for _ in 0..60 {
        simulation.advance(&mut NoRecorder).unwrap();
    }
    let deep = failed(&simulation);
    assert!(deep.contains("penetration of contact `hit` "), "{deep}");
    assert!(
        deep.contains("the axes or centres of `rod` and `plank` meet at 1.0000e-2 m"),
        "{deep}"
    );
    assert!(deep.ends_with("use a stiffer contact law or larger depths"), "{deep}");
}
