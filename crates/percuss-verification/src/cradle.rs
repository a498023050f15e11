//! Newton's cradle: an impact on a row of touching balls.

use percuss::*;

use crate::check::{Checks, Report};
use crate::structure::run;

/// Five equal balls in a row; the first ones move towards the others, which touch.
fn cradle(flying: usize, restitution: f64) -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("far", 1e9, 1e3));
    let section = b.section(Section::new("far", 1e-2, 1e-5));
    b.beam(Beam::new("far", &[[0.0, 9.0], [1.0, 9.0]], 1, material, section));
    let ball = |i: usize| Disc {
        name: format!("ball {i}"),
        mass: 1.0,
        inertia: None,
        radius: 0.05,
        position: [0.1 * i as f64 - if i < flying { 0.01 } else { 0.0 }, 0.0],
        velocity: [if i < flying { 1.0 } else { 0.0 }, 0.0],
        spin: 0.0,
    };
    let balls: Vec<DiscId> = (0..5).map(|i| b.disc(ball(i))).collect();
    for (i, two) in balls.windows(2).enumerate() {
        let law = TouchLaw::Rigid(RigidLaw::frictionless(restitution));
        let between = [ContactPartner::Disc(two[0]), ContactPartner::Disc(two[1])];
        b.contact(Contact::new(format!("touch {i}"), between, law));
    }
    b.build().expect("a valid model")
}

/// Final velocities for the number of incoming balls. With impacts one after another as many balls leave, and with restitution e the last of a row
/// of five leaves with ((1 + e) / 2)^4. For a simultaneous impact Newton's law gives (-3/5, 2/5, 2/5, 2/5, 2/5).
pub fn cradle_of_five() -> Report {
    let mut c = Checks::new();
    let end = |flying: usize, restitution: f64, multiple_impacts: MultipleImpacts| {
        let settings = Settings { multiple_impacts, ..Settings::new(0.03, 1e-4) };
        run(&cradle(flying, restitution), &settings)
    };
    for flying in 1..=4 {
        let found = end(flying, 1.0, MultipleImpacts::Sequential);
        for (i, ball) in found.projectiles.iter().enumerate() {
            let expected = f64::from(u8::from(i >= 5 - flying));
            let what = format!("{flying} in, ball {i} [m/s]");
            c.absolute(what, ball.velocity_final[0], expected, 1e-12);
        }
        c.at_most(format!("{flying} in: energy residual"), found.energy.residual_max, 1e-13);
    }
    let damped = end(1, 0.9, MultipleImpacts::Sequential);
    let last = damped.projectiles[4].velocity_final[0];
    c.relative("restitution 0.9: last ball [m/s]", last, 0.95_f64.powi(4), 1e-12);
    let shared = end(1, 1.0, MultipleImpacts::Simultaneous);
    for (ball, expected) in shared.projectiles.iter().zip([-0.6, 0.4, 0.4, 0.4, 0.4]) {
        c.absolute(
            format!("at once: {} [m/s]", ball.name),
            ball.velocity_final[0],
            expected,
            1e-12,
        );
    }
    c.absolute("at once: multiple impacts", shared.multiple_impacts.count as f64, 1.0, 0.0);
    c.into_report()
}
