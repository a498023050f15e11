//! Impacts and contacts on shear-flexible beams, and rigid corners with slender ones.

use super::*;

#[test]
fn what_strikes_or_presses_a_shear_flexible_beam_balances() {
    for restitution in [None, Some(0.0), Some(0.6)] {
        let mut b = ModelBuilder::new();
        let material = b.material(Material { retardation: 1e-5, ..isotropic(2e9, 3e3, 0.3) });
        let section = b.section(Section::rectangle("s", 0.2, 0.5));
        let arm = b.beam(shear(3.0, 12, material, section));
        b.support(Support::new("root", at("root", arm, 0.0), SupportKind::Clamp));
        b.support(Support::new(
            "end",
            at("end", arm, 1.0),
            SupportKind::Roller { direction: [1.0, 0.0] },
        ));
        let strikes = at("struck", arm, 0.43);
        b.projectile(match restitution {
            None => elastic("mass", strikes, [0.0, -20.0]),
            Some(e) => rigid("mass", strikes, [0.0, -20.0], e),
        });
        let model = b.build().unwrap();
        let summary = run(&model, &Settings::new(0.05, 5e-5));
        assert!(worst(&summary) < 1e-10, "{restitution:?}: {:e}", worst(&summary));
        assert!(summary.projectiles[0].velocity_final[1] > -19.9, "nothing was struck");
        assert!(summary.energy.loss_damping > 0.0);
    }
}

/// Springs without effect take the unit lengths of their nodes out of the band.
#[test]
fn unit_lengths_inside_and_outside_the_band_give_the_same_motion() {
    let struck = |tied: &[u32]| {
        let mut b = ModelBuilder::new();
        let material = b.material(isotropic(2e9, 3e3, 0.3));
        let section = b.section(Section::rectangle("s", 0.2, 0.5));
        let arm = b.beam(shear(3.0, 8, material, section));
        b.support(Support::new("root", at("root", arm, 0.0), SupportKind::Clamp));
        for k in tied {
            let ends = [at("node", arm, f64::from(*k) / 8.0), at("tip", arm, 1.0)];
            b.spring(Spring {
                name: format!("spring-{k}"),
                between: ends.map(Anchor::Point),
                law: SpringLaw::Linear { stiffness: 1e-9 },
                damping: 0.0,
                length: None,
                strength: None,
                yielding: None,
            });
        }
        b.projectile(elastic("mass", at("struck", arm, 0.43), [0.0, -20.0]));
        let summary = run(&b.build().unwrap(), &Settings::new(0.05, 5e-5));
        assert!(worst(&summary) < 1e-12, "{tied:?}: {:e}", worst(&summary));
        let velocity = summary.projectiles[0].velocity_final[1];
        [velocity, summary.momentum.linear_scale, summary.momentum.angular_scale]
    };
    let inside = struck(&[]);
    assert!(inside[0] > -19.9, "nothing was struck");
    for tied in [&[3][..], &[1, 2, 3, 4, 5, 6, 7]] {
        for (found, expected) in struck(tied).into_iter().zip(inside) {
            assert!((found / expected - 1.0).abs() < 1e-9, "{tied:?}: {found} {expected}");
        }
    }
}

#[test]
fn a_disc_rolls_on_the_face_of_a_shear_flexible_beam() {
    let mut b = ModelBuilder::new();
    let material = b.material(isotropic(2e9, 3e3, 0.3));
    let section = b.section(Section::rectangle("s", 0.2, 0.4));
    let arm = b.beam(shear(3.0, 10, material, section));
    b.support(Support::new("root", at("root", arm, 0.0), SupportKind::Clamp));
    let ball = b.disc(disc("ball", 50.0, 0.1, [2.0, 0.31], [4.0, -3.0]));
    b.contact(Contact {
        name: "ball".into(),
        between: [ContactPartner::Disc(ball), ContactPartner::Beam(arm)],
        law: TouchLaw::Rigid(RigidLaw { friction: 0.3, ..RigidLaw::frictionless(0.5) }),
        points_per_element: 2,
    });
    let summary = run(&b.build().unwrap(), &Settings::new(0.05, 1e-4));
    assert!(worst(&summary) < 1e-10, "{:e}", worst(&summary));
    assert!(summary.projectiles[0].velocity_final[1] > -2.9, "nothing was touched");
}

#[test]
fn corners_between_shear_flexible_and_slender_beams_are_rigid() {
    let mut b = ModelBuilder::new();
    let material = b.material(isotropic(2e9, 3e3, 0.3));
    let section = b.section(Section::rectangle("s", 0.1, 0.3));
    let column = Beam {
        theory: Theory::Shear,
        ..beam("column", [0.0, 0.0], [0.0, 3.0], 5, material, section)
    };
    let column = b.beam(column);
    let girder = b.beam(beam("girder", [0.0, 3.0], [2.0, 4.0], 4, material, section));
    b.support(Support::new("foot", at("column.start", column, 0.0), SupportKind::Clamp));
    let between = [at("column.end", column, 1.0), at("girder.start", girder, 0.0)];
    b.joint(Joint::new("knee", JointKind::Rigid, between));
    b.projectile(elastic("mass", at("girder@0.6", girder, 0.6), [0.0, -20.0]));
    let model = b.build().unwrap();
    let summary = run(&model, &Settings::new(0.2, 5e-4));
    assert!(worst(&summary) < 1e-10, "{:e}", worst(&summary));
    let mut simulation = Simulation::new(&model, &Settings::new(0.2, 5e-4)).unwrap();
    let reference = 1.0_f64.atan2(2.0) - std::f64::consts::FRAC_PI_2;
    let mut turned = 0.0_f64;
    while simulation.state().step < simulation.step_count() {
        simulation.advance(&mut NoRecorder).unwrap();
        let u = &simulation.state().displacement;
        let size = 5.0_f64.sqrt();
        let (a, b) = ([u[5][2], 1.0 + u[5][3]], [2.0 / size + u[6][2], 1.0 / size + u[6][3]]);
        let angle = (a[0] * b[1] - a[1] * b[0]).atan2(a[0] * b[0] + a[1] * b[1]);
        assert!((angle - reference).abs() < 1e-12, "{:e}", angle - reference);
        turned = turned.max(a[0].atan2(a[1]).abs());
    }
    assert!(turned > 1e-3, "the corner turned by {turned} only");
}

#[test]
fn the_force_after_a_rigid_impact_has_a_limit() {
    // The section of the paper's second example, with shear: velocity of the mass by Laplace inversion.
    let exact = [(5.0, 34.8562072), (10.0, 30.570388), (20.0, 24.5604188)];
    let errors = |elements: usize, step: f64| {
        let mut b = ModelBuilder::new();
        let material = b.material(isotropic(2e11, 3e3, 0.3));
        let section = Section { shear_factor: Some(5.0 / 6.0), ..Section::new("s", 0.1, 8.33e-5) };
        let section = b.section(section);
        let arm = b.beam(shear(3.0, elements, material, section));
        for (name, f) in [("left", 0.0), ("right", 1.0)] {
            b.support(Support::new(name, at(name, arm, f), SupportKind::Clamp));
        }
        // It touches after one step and a half.
        let mass = rigid("mass", at("struck", arm, 0.5), [0.0, -40.0], 0.0);
        b.projectile(Projectile { standoff: 60.0 * step, ..mass });
        let model = b.build().unwrap();
        let mut simulation = Simulation::new(&model, &Settings::new(22e-6, step)).unwrap();
        let mut places = vec![0.0];
        while simulation.state().step < simulation.step_count() {
            simulation.advance(&mut NoRecorder).unwrap();
            let place = simulation.state().projectile(&model, 0).unwrap().position[1];
            if simulation.state().offset == 0.0 {
                places.push(place);
            }
        }
        exact.map(|(microseconds, velocity)| {
            let k = (microseconds * 1e-6 / step).round() as usize + 1;
            (places[k] - places[k + 1]) / step / velocity - 1.0
        })
    };
    let (coarse, fine) = (errors(300, 2e-7), errors(600, 1e-7));
    for k in 0..3 {
        assert!(coarse[k].abs() < 2e-3 && fine[k].abs() < 8e-4, "{coarse:?} {fine:?}");
    }
}
