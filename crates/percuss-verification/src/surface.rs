//! Contact on faces of beams, and impact on beams compared with theory.

use std::f64::consts::PI;

use percuss::*;

use crate::check::{Checks, Report};
use crate::structure::at;

fn run(b: &ModelBuilder, end: f64, step: f64) -> RunSummary {
    let model = b.build().expect("a verification case builds");
    simulate(&model, &Settings::new(end, step), &mut NoRecorder).expect("valid settings")
}

fn first_interval(summary: &RunSummary) -> Option<ContactInterval> {
    match &summary.contacts[0].record {
        ContactRecord::Smooth { intervals, .. } => intervals.first().copied(),
        ContactRecord::Nonsmooth { .. } => None,
    }
}

/// E7: a sphere on a steel beam (Timoshenko 1913), by a disc on its face and by a guided mass.
pub fn sphere_on_a_beam() -> Report {
    let mut c = Checks::new();
    let steel = |radius| HertzBody { young: 2.15746e11, poisson: 0.3, radius };
    let potential = Potential::hertz([steel(0.01), steel(f64::INFINITY)]);
    let mass = 4.0 / 3.0 * PI * 1e-6 * 7960.0;
    if let Potential::Hertz { stiffness } = potential {
        c.relative("Hertz stiffness [N/m^1.5]", stiffness, 1.580559e10, 1e-5);
    }
    for guided in [false, true] {
        let mut b = ModelBuilder::new();
        let material = b.material(Material::new("steel", 2.15746e11, 7960.0));
        let mut section = Section::rectangle("square", 0.01, 0.01);
        section.rotary_inertia = RotaryInertia::Neglected;
        let section = b.section(section);
        let points = [[0.0, 0.0], [0.1535, 0.0]];
        let beam = b.beam(Beam::new("beam", &points, 32, material, section));
        b.support(Support::new("left", at("left", beam, 0.0), SupportKind::Pin));
        let roller = SupportKind::Roller { direction: [1.0, 0.0] };
        b.support(Support::new("right", at("right", beam, 1.0), roller));
        let law = SmoothLaw::elastic(potential.clone());
        if guided {
            let kind = ProjectileKind::Elastic { law };
            let mid = at("mid", beam, 0.5);
            b.projectile(Projectile::new("sphere", kind, mass, [0.0, -0.01], mid));
        } else {
            let sphere = b.disc(Disc {
                name: "sphere".into(),
                mass,
                inertia: None,
                radius: 0.01,
                position: [0.1535 / 2.0, 0.015],
                velocity: [0.0, -0.01],
                spin: 0.0,
            });
            let between = [ContactPartner::Disc(sphere), ContactPartner::Beam(beam)];
            b.contact(Contact::new("blow", between, TouchLaw::Smooth(law)));
        }
        let summary = run(&b, 3e-4, 2e-7);
        let name = if guided { "guided" } else { "disc on the face" };
        if let Some(interval) = first_interval(&summary) {
            let peak = interval.peak_force;
            c.relative(format!("{name}: largest force [N]"), peak.value, 4.9772, 5e-5);
            c.relative(format!("{name}: its time [s]"), peak.time, 72.56e-6, 3e-4);
            c.relative(format!("{name}: end of contact [s]"), interval.end, 156.40e-6, 1e-4);
        }
        let v = summary.projectiles[0].velocity_final[1];
        c.relative(format!("{name}: velocity at the end [m/s]"), v, 3.0232e-3, 1e-4);
    }
    c.into_report()
}

/// E4: a mass and spring on an infinite beam; E9: supports have no effect before waves return from them.
pub fn infinite_beam() -> Report {
    let mut c = Checks::new();
    let scene = |length: f64, support: Option<SupportKind>, stiffness: f64| {
        let mut b = ModelBuilder::new();
        let material = b.material(Material::new("composite", 2e9, 3e3));
        let mut section = Section::new("plank", 0.1, 8.33e-5);
        section.rotary_inertia = RotaryInertia::Neglected;
        let section = b.section(section);
        let points = [[0.0, 0.0], [length, 0.0]];
        let elements = (20.0 * length) as usize;
        let beam = b.beam(Beam::new("beam", &points, elements, material, section));
        for (name, end) in [("left", 0.0), ("right", 1.0)] {
            if let Some(kind) = &support {
                b.support(Support::new(name, at(name, beam, end), kind.clone()));
            }
        }
        let kind = ProjectileKind::spring(stiffness);
        b.projectile(Projectile::new("mass", kind, 10.0, [0.0, 0.01], at("mid", beam, 0.5)));
        b
    };
    let long = run(&scene(8.0, None, 1e7), 4e-3, 1e-6);
    if let Some(interval) = first_interval(&long) {
        let peak = interval.peak_force;
        c.relative("E4: largest force [N]", peak.value, 95.146518557, 1e-7);
        // The force is stationary at its peak.
        c.relative("E4: its time [s]", peak.time, 1.514508856e-3, 5e-6);
        // Contact ends at x = 3.0748... of tau = 1e-3 s: from the same curve.
        c.relative(
            "E4: rebound [m/s]",
            long.projectiles[0].velocity_final[1],
            -8.604740827e-3,
            1e-6,
        );
    }
    let peaks: Vec<f64> = [None, Some(SupportKind::Pin), Some(SupportKind::Clamp)]
        .into_iter()
        .filter_map(|s| first_interval(&run(&scene(5.0, s, 1e7), 4e-3, 2e-6)))
        .flat_map(|i| [i.peak_force.value, i.impulse])
        .collect();
    for k in 0..2 {
        let each: Vec<f64> = peaks.iter().copied().skip(k).step_by(2).collect();
        let spread = each.iter().fold(0.0_f64, |m, x| m.max((x - each[0]).abs())) / each[0];
        let what = ["largest force", "impulse"][k];
        c.at_most(
            format!("E9: spread of the {what} over free, pinned, clamped ends"),
            spread,
            1e-4,
        );
    }
    // E9: the first reaction of a simply supported beam is directed towards the impact; with a soft spring, so that the dispersive waves that
    // arrive earlier, whose sign is undetermined, are weak.
    let model =
        scene(3.0, Some(SupportKind::Pin), 1e5).build().expect("a verification case builds");
    let mut rows = MemoryRecorder::default();
    let _ = simulate(&model, &Settings::new(8e-2, 1e-4), &mut rows).expect("valid settings");
    let reaction = rows.column("support.left.force_2").unwrap_or_default();
    let first = reaction.iter().find(|r| r.abs() > 1.0).copied().unwrap_or(f64::NAN);
    c.at_least("E9: first reaction, in the direction of the impact [N]", first, 0.0);
    c.into_report()
}

/// A disc thrown obliquely at a free beam, step 1e-3 s: its contact crosses element borders (theory, page 3).
pub fn oblique_throw() -> Report {
    let mut c = Checks::new();
    let throw = |force: ContactForce| {
        let mut b = ModelBuilder::new();
        let material = b.material(Material::new("soft", 2e8, 1e3));
        let section = Section { depth: Some(0.1), ..Section::new("bar", 0.01, 8.33e-6) };
        let section = b.section(section);
        let points = [[0.0, 0.0], [3.0, 0.0]];
        let beam = b.beam(Beam::new("beam", &points, 12, material, section));
        let ball = b.disc(Disc {
            name: "ball".into(),
            mass: 5.0,
            inertia: None,
            radius: 0.05,
            position: [0.6, 0.13],
            velocity: [8.0, -4.0],
            spin: 0.0,
        });
        let law = SmoothLaw { force, ..SmoothLaw::elastic(Potential::Linear { stiffness: 2e4 }) };
        let between = [ContactPartner::Disc(ball), ContactPartner::Beam(beam)];
        b.contact(Contact::new("throw", between, TouchLaw::Smooth(law)));
        run(&b, 0.3, 1e-3)
    };
    let exact = throw(ContactForce::Conserving);
    let borders = first_interval(&exact).map_or(f64::NAN, |i| (i.place_end.s - i.place.s) / 0.25);
    c.at_least("elements the contact slides over", borders, 1.0);
    c.at_most("projected gradient: energy residual", exact.energy.residual_max, 1e-11);
    c.at_most("projected gradient: linear momentum", exact.momentum.linear_residual_max, 1e-11);
    c.at_most("projected gradient: angular momentum", exact.momentum.angular_residual_max, 1e-11);
    let plain = throw(ContactForce::PlainGradient);
    c.at_least("plain midpoint gradient: energy residual", plain.energy.residual_max, 1e-6);
    c.into_report()
}
