use percuss::*;
fn at(l: &str, b: BeamId, f: f64) -> PointRef {
    PointRef { label: l.into(), beam: b, along: Along::Fraction(f) }
}
fn smooth(k: Potential) -> ProjectileKind {
    ProjectileKind::Elastic { law: SmoothLaw::elastic(k) }
}
fn main() {
    // D1
    for n in [20, 80] {
        for e in [0.0, 1.0] {
            for hk in [100.0, 400.0] {
                let mut b = ModelBuilder::new();
                let m = b.material(Material {
                    strain: StrainMeasure::Engineering,
                    ..Material::new("m", 3e7, 0.73e-3)
                });
                let s = b.section(Section {
                    rotary_inertia: RotaryInertia::Neglected,
                    ..Section::new("s", 1.0, 1e3)
                });
                let bar = b.beam(Beam::new("bar", &[[0.01, 0.0], [10.01, 0.0]], n, m, s));
                let w = b.obstacle(Obstacle {
                    name: "wall".into(),
                    shape: ObstacleShape::HalfPlane { point: [0.0, 0.0], normal: [1.0, 0.0] },
                    motion: None,
                });
                b.contact(Contact::new(
                    "c",
                    [Party::Beam(bar), Party::Obstacle(w)],
                    TouchLaw::Rigid(RigidLaw::frictionless(e)),
                ));
                b.initial_motion(InitialMotion {
                    velocity: [-202.2, 0.0],
                    spin: 0.0,
                    about: [0.0; 2],
                });
                let model = b.build().unwrap();
                let mut r = MemoryRecorder::default();
                let s = simulate(&model, &Settings::new(2e-4, 1e-4 / hk), &mut r).unwrap();
                let (t, j) = (r.column("time").unwrap(), r.column("contact.c.impulse").unwrap());
                let total: f64 = j.iter().sum();
                let mid: f64 = t
                    .iter()
                    .zip(&j)
                    .filter(|(t, _)| **t > 6e-5 && **t < 1.4e-4)
                    .map(|x| x.1)
                    .sum::<f64>()
                    / 8e-5;
                let first = t.iter().zip(&j).find(|x| *x.1 > 0.0).map(|x| *x.0);
                let last = t.iter().zip(&j).rev().find(|x| *x.1 > 0.0).map(|x| *x.0);
                println!(
                    "D1 n{n} e{e} {:?} first {first:?} last {last:?} mean force {mid} impulse {total} (exact {}) loss {:e} res {:e} steps {}",
                    s.termination,
                    29922.867 * 9.8657e-5,
                    s.energy.loss_impacts / s.energy.initial,
                    s.energy.residual_max,
                    s.solver_steps
                );
            }
        }
    }
    // D7
    for n in [40] {
        for law in [
            TouchLaw::Rigid(RigidLaw::frictionless(0.0)),
            TouchLaw::Smooth(SmoothLaw::elastic(Potential::Linear { stiffness: 8e9 })),
        ] {
            let mut b = ModelBuilder::new();
            let m = b.material(Material {
                strain: StrainMeasure::Engineering,
                ..Material::new("m", 2e11, 7800.0)
            });
            let s = b.section(Section {
                rotary_inertia: RotaryInertia::Neglected,
                ..Section::rectangle("s", 0.02, 0.02)
            });
            let fixed = b.beam(Beam::new("fixed", &[[0.0, 0.0], [1.0, 0.0]], n, m, s));
            let flying = b.beam(Beam::new("flying", &[[1.02, 0.0], [2.02, 0.0]], n, m, s));
            b.support(Support::new("w", at("w", fixed, 0.0), SupportKind::Clamp));
            b.record_point(at("face", fixed, 1.0));
            b.record_point(at("other", flying, 0.0));
            b.contact(Contact::new("c", [Party::Beam(fixed), Party::Beam(flying)], law));
            let model = b.build().unwrap();
            let mut r = MemoryRecorder::default();
            let mut sim = Simulation::new(&model, &Settings::new(1.0e-3, 1e-6)).unwrap();
            sim.set_velocities(|n, _| if n == "flying" { [-1.0, 0.0] } else { [0.0; 2] });
            let s = sim.run(&mut r);
            let t = r.column("time").unwrap();
            for name in ["face", "other"] {
                let u = r.column(&format!("point.{name}.displacement_1")).unwrap();
                let v: Vec<f64> = [0.2e-3, 0.4e-3, 0.6e-3, 0.8e-3, 1e-3]
                    .iter()
                    .map(|x| u[t.partition_point(|y| *y < x - 1e-12).min(t.len() - 1)])
                    .collect();
                println!(
                    "D7 {name} {v:?} {:?} loss {:e}",
                    s.termination,
                    s.energy.loss_impacts / s.energy.initial
                );
            }
            let j = r.column("contact.c.impulse").unwrap();
            let mid: f64 = t
                .iter()
                .zip(&j)
                .filter(|(t, _)| **t > 0.5e-4 && **t < 3.5e-4)
                .map(|x| x.1)
                .sum::<f64>()
                / 3e-4;
            println!("  mean force {mid} vs 7899.367");
        }
    }
    // E4
    for (n, h) in [(80, 2e-6), (160, 1e-6)] {
        let mut b = ModelBuilder::new();
        let m = b.material(Material::new("m", 2e9, 3e3));
        let s = b.section(Section {
            rotary_inertia: RotaryInertia::Neglected,
            ..Section::new("s", 0.1, 8.33e-5)
        });
        let beam = b.beam(Beam::new("b", &[[0.0, 0.0], [8.0, 0.0]], n, m, s));
        b.projectile(Projectile::new(
            "p",
            ProjectileKind::spring(1e7),
            10.0,
            [0.0, 0.01],
            at("mid", beam, 0.5),
        ));
        let s = simulate(&b.build().unwrap(), &Settings::new(6e-3, h), &mut NoRecorder).unwrap();
        if let ContactRecord::Smooth { peak_force, intervals } = &s.contacts[0].record {
            println!(
                "E4 n{n} F {} at {} end {:?} v {} (95.146518557 1.514508856e-3 -8.604740827e-3)",
                peak_force.value,
                peak_force.time,
                intervals[0].end,
                s.projectiles[0].velocity_final[1]
            );
        }
    }
    // E7
    for (n, h) in [(32, 2e-7), (64, 1e-7)] {
        let mut b = ModelBuilder::new();
        let m = b.material(Material::new("m", 2.15746e11, 7960.0));
        let s = b.section(Section {
            rotary_inertia: RotaryInertia::Neglected,
            ..Section::rectangle("s", 0.01, 0.01)
        });
        let beam = b.beam(Beam::new("b", &[[0.0, 0.0], [0.1535, 0.0]], n, m, s));
        b.support(Support::new("l", at("l", beam, 0.0), SupportKind::Pin));
        b.support(Support::new(
            "r",
            at("r", beam, 1.0),
            SupportKind::Roller { direction: [1.0, 0.0] },
        ));
        let mass = 4.0 / 3.0 * std::f64::consts::PI * 1e-6 * 7960.0;
        let body = |radius| HertzBody { young: 2.15746e11, poisson: 0.3, radius };
        let d = b.disc(Disc {
            name: "s".into(),
            mass,
            inertia: None,
            radius: 0.01,
            position: [0.1535 / 2.0, 0.015],
            velocity: [0.0, -0.01],
            spin: 0.0,
        });
        let pot = Potential::hertz([body(0.01), body(f64::INFINITY)]);
        println!("{pot:?} mass {mass}");
        b.contact(Contact::new(
            "c",
            [Party::Disc(d), Party::Beam(beam)],
            TouchLaw::Smooth(SmoothLaw::elastic(pot)),
        ));
        let s = simulate(&b.build().unwrap(), &Settings::new(3e-4, h), &mut NoRecorder).unwrap();
        if let ContactRecord::Smooth { peak_force, intervals } = &s.contacts[0].record {
            println!(
                "E7 n{n} F {} at {} end {:?} v {} (4.9772 72.56us 156.40us 3.0232e-3) res {:e}",
                peak_force.value,
                peak_force.time,
                intervals[0].end,
                s.projectiles[0].velocity_final[1],
                s.energy.residual_max
            );
        }
    }
}
