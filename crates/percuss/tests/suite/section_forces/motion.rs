//! Section forces in motion: reactions at supports, contacts, spin, impacts.

use super::*;

/// Columns of a clamp at the start of a beam along the first axis, and the sign of the section forces there against its reaction:
/// tension pulls at the support, a positive shear force is the support's push upwards, a positive moment turns it the other way.
const AT_THE_START: [(&str, &str, f64); 3] =
    [("axial", "force_1", -1.0), ("shear", "force_2", 1.0), ("moment", "moment", -1.0)];

#[test]
fn viscous_stresses_are_part_of_the_section_forces() {
    // Kelvin-Voigt bar under a sudden force of 1000 N: the force at its support is the reaction, at every instant.
    let mut b = ModelBuilder::new();
    let material = Material { retardation: 0.2, ..Material::new("m", 1e9, 1e-3) };
    let m = b.material(material);
    let s = b.section(Section::rectangle("s", 0.1, 0.1));
    let bar = b.beam(beam("bar", [0.0, 0.0], [1.0, 0.0], 2, m, s));
    hold(&mut b, at("root", bar, 0.0), SupportKind::Clamp);
    b.load(Load::new("pull", point_load(at("tip", bar, 1.0), [1e3, 0.0], 0.0)));
    b.record_point(at("root", bar, 0.0));
    let model = b.build().unwrap();
    let mut log = Columns::default();
    simulate(&model, &Settings::new(0.3, 1e-3), &mut log).unwrap();
    let (axial, force) = (log.of("section.root.axial"), log.of("support.root.force_1"));
    for (n, f) in axial.iter().zip(&force).skip(1) {
        assert!((n + f).abs() < 1e-6 * 1e3, "{n} {f}");
    }
    // It is overdamped and light: the whole load has arrived.
    assert!((axial[50] - 1e3).abs() < 1.0, "{}", axial[50]);
    let summary = simulate(&model, &Settings::new(0.3, 1e-3), &mut Columns::default()).unwrap();
    let most = summary.section_forces[0].axial.max.value;
    assert!((most - 1e3).abs() < 20.0, "{most}");
}

#[test]
fn forces_at_supports_are_their_reactions_in_motion_under_every_scheme() {
    // A suddenly loaded cantilever with its weight, and a disc that rolls and bounces on it.
    for scheme in [Scheme::EnergyMomentum, Scheme::StrainRate, Scheme::Midpoint, Scheme::Newmark] {
        let mut b = ModelBuilder::new();
        let m = b.material(Material { mass_damping: 3.0, ..Material::new("m", 1e9, 1e3) });
        let s = b.section(Section::rectangle("s", 0.1, 0.05));
        let arm = b.beam(beam("arm", [0.0, 0.0], [1.0, 0.0], 5, m, s));
        hold(&mut b, at("root", arm, 0.0), SupportKind::Clamp);
        b.load(Load::new("q", line_load(arm, [20.0, -300.0])));
        b.load(Load::new("g", LoadKind::Gravity { acceleration: [0.0, -9.81] }));
        let ball = b.disc(disc("ball", 2.0, 0.1, [0.63, 0.13], [0.4, -1.0]));
        let law = TouchLaw::Smooth(SmoothLaw::elastic(Potential::Linear { stiffness: 1e5 }));
        b.contact(Contact::new("c", [ContactPartner::Disc(ball), ContactPartner::Beam(arm)], law));
        b.record_point(at("root", arm, 0.0));
        let model = b.build().unwrap();
        let mut log = Columns::default();
        let settings = Settings { scheme, ..Settings::new(0.1, 5e-4) };
        let run = simulate(&model, &settings, &mut log).unwrap();
        let peak = run.section_forces[0].shear.largest().value.abs();
        for (own, of_support, sign) in AT_THE_START {
            let own = log.of(&format!("section.root.{own}"));
            let reaction = log.of(&format!("support.root.{of_support}"));
            // Newmark has its balance at the end of a step, and reactions are reported as means: those of both ends.
            let of_step = |k: usize| match scheme {
                Scheme::Newmark => 0.5 * (own[k - 1] + own[k]),
                _ => own[k],
            };
            for k in 2..own.len() {
                let (a, b) = (of_step(k), reaction[k]);
                // The mean of two moments is the moment of the mean but for the turning between them.
                let tolerance = if scheme == Scheme::Newmark { 1e-5 } else { 1e-7 };
                let apart = a - sign * b;
                assert!(apart.abs() < tolerance * peak, "{scheme:?} {of_support} {k}: {a} {b}");
            }
        }
        // The contact was active, between nodes.
        assert!(peak > 500.0, "{peak}");
    }
}

#[test]
fn forces_at_a_support_of_a_shear_flexible_beam_are_its_reactions() {
    let mut b = ModelBuilder::new();
    let plain = Material::new("m", 1e9, 1e3);
    let m = b.material(Material { poisson: Some(0.3), mass_damping: 3.0, ..plain });
    let s = b.section(Section::rectangle("s", 0.1, 0.2));
    let slender = beam("arm", [0.0, 0.0], [1.0, 0.0], 5, m, s);
    let arm = b.beam(Beam { theory: Theory::Shear, ..slender });
    hold(&mut b, at("root", arm, 0.0), SupportKind::Clamp);
    b.load(Load::new("q", line_load(arm, [20.0, -300.0])));
    b.load(Load::new("g", LoadKind::Gravity { acceleration: [0.0, -9.81] }));
    let ball = b.disc(disc("ball", 2.0, 0.1, [0.63, 0.205], [0.4, -1.0]));
    let law = TouchLaw::Smooth(SmoothLaw::elastic(Potential::Linear { stiffness: 1e5 }));
    b.contact(Contact::new("c", [ContactPartner::Disc(ball), ContactPartner::Beam(arm)], law));
    b.record_point(at("root", arm, 0.0));
    let model = b.build().unwrap();
    let mut log = Columns::default();
    let run = simulate(&model, &Settings::new(0.05, 2e-4), &mut log).unwrap();
    let peak = run.section_forces[0].shear.largest().value.abs();
    for (own, of_support, sign) in AT_THE_START {
        let own = log.of(&format!("section.root.{own}"));
        let reaction = log.of(&format!("support.root.{of_support}"));
        for k in 2..own.len() {
            let apart = own[k] - sign * reaction[k];
            assert!(apart.abs() < 1e-7 * peak, "{of_support} {k}: {} {}", own[k], reaction[k]);
        }
    }
    // The contact was active; at the free end no section force is left.
    assert!(peak > 500.0, "{peak}");
    let envelope = &run.section_forces[0].envelope;
    for forces in [&envelope.shear, &envelope.moment] {
        let last = forces[1].len() - 1;
        assert!(forces.iter().all(|side| side[last].abs() < 1e-6 * peak), "{forces:?}");
    }
}

#[test]
fn forces_at_a_driven_support_are_its_reactions_where_its_velocity_jumps_too() {
    // A clamp is pulled aside by a ramp that begins with a jump of velocity, and stops with one.
    for scheme in [Scheme::EnergyMomentum, Scheme::StrainRate, Scheme::Midpoint] {
        let mut b = ModelBuilder::new();
        let m = b.material(Material::new("m", 1e9, 1e3));
        let s = b.section(Section::rectangle("s", 0.1, 0.05));
        let arm = b.beam(beam("arm", [0.0, 0.0], [1.0, 0.0], 4, m, s));
        let root = at("root", arm, 0.0);
        let function = TimeFunction::Ramp { duration: 0.02 };
        let motion = Motion { displacement: [2e-3, 5e-3], rotation: 0.0, function };
        b.support(Support {
            motion: Some(motion),
            ..Support::new("root", root.clone(), SupportKind::Clamp)
        });
        b.record_point(root);
        let model = b.build().unwrap();
        let mut log = Columns::default();
        let settings = Settings { scheme, ..Settings::new(0.05, 1e-3) };
        simulate(&model, &settings, &mut log).unwrap();
        let time = log.of("time");
        for (own, of_support, sign) in AT_THE_START {
            let own = log.of(&format!("section.root.{own}"));
            let reaction = log.of(&format!("support.root.{of_support}"));
            let peak = reaction.iter().fold(0.0, |m: f64, r| m.max(r.abs()));
            for k in 1..time.len() {
                // Rows a jump apart hold the step before it.
                if time[k] - time[k - 1] > 0.5e-3 {
                    let off = own[k] - sign * reaction[k];
                    assert!(off.abs() < 1e-6 * peak, "{scheme:?} {of_support} {k}: {off} {peak}");
                }
            }
        }
    }
}

#[test]
fn forces_of_a_contact_inside_an_element_make_the_shear_force_jump_there() {
    // Simply supported, without weight, a disc on it at 0.37 L, off every node: the moment under its force F
    // is F a b / L, and the shear force jumps from F b / L to -F a / L.
    let mut b = ModelBuilder::new();
    let m = b.material(Material { mass_damping: 200.0, ..Material::new("m", 1e11, 1e-3) });
    let s = b.section(Section::rectangle("s", 0.1, 0.05));
    let girder = b.beam(beam("girder", [0.0, 0.0], [1.0, 0.0], 4, m, s));
    hold(&mut b, at("a", girder, 0.0), SupportKind::Pin);
    hold(&mut b, at("b", girder, 1.0), SupportKind::Roller { direction: [1.0, 0.0] });
    let law = SmoothLaw::elastic(Potential::Linear { stiffness: 1e5 });
    let ball = b.disc(disc("ball", 10.0, 0.1, [0.37, 0.1251], [0.0; 2]));
    b.contact(Contact::new(
        "c",
        [ContactPartner::Disc(ball), ContactPartner::Beam(girder)],
        TouchLaw::Smooth(law),
    ));
    b.load(Load::new("g", LoadKind::Gravity { acceleration: [0.0, -9.81] }));
    let model = b.build().unwrap();
    let run = simulate(&model, &Settings::new(0.02, 1e-4), &mut Columns::default()).unwrap();
    let f = &run.section_forces[0];
    let ContactRecord::Smooth { peak_force, .. } = &run.contacts[0].record else { panic!() };
    let peak = peak_force.value;
    assert!((f.moment.largest().value.abs() / (peak * 0.37 * 0.63) - 1.0).abs() < 1e-2);
    assert!((f.moment.largest().s - 0.37).abs() < 1e-3);
    let (least, most) = (f.shear.min.value, f.shear.max.value);
    assert!((most / (peak * 0.63) - 1.0).abs() < 1e-2, "{most} {peak}");
    assert!((least / (peak * -0.37) - 1.0).abs() < 1e-2, "{least} {peak}");
}

#[test]
fn forces_of_a_beam_that_spins_are_those_that_keep_its_parts_on_their_circles() {
    // N(s) = rho A omega^2 (L^2 / 4 - (s - L/2)^2) / 2, largest in the middle.
    let omega = 3.0;
    for elements in [3, 4] {
        let mut b = ModelBuilder::new();
        let m = b.material(Material::new("m", 1e13, 1e3));
        let s = b.section(Section::rectangle("s", 0.1, 0.1));
        b.beam(beam("stick", [-1.0, 0.0], [1.0, 0.0], elements, m, s));
        b.initial_motion(InitialMotion { spin: omega, ..InitialMotion::default() });
        let model = b.build().unwrap();
        // Unstressed at first, it breathes about the steady spin with the period 4 L / c = 8e-5 s: in the mean over that.
        let mut log = Columns::default();
        let run = simulate(&model, &Settings::new(8e-3, 2e-5), &mut log).unwrap();
        let steady = 10.0 * omega * omega / 2.0;
        let most = run.section_forces[0].axial.max;
        assert!(most.value > steady && most.value < 2.2 * steady, "{most:?} {steady}");
        let e = &run.section_forces[0].envelope;
        let last = e.s.len() - 1;
        for i in [0, last] {
            assert!(e.axial[1][i].abs() < 1e-6 * steady && e.axial[0][i].abs() < 1e-6 * steady);
        }
    }
}

#[test]
fn nothing_of_an_impulse_enters_forces_at_any_step() {
    // A plank struck by a rigid mass: forces right after the impact do not grow with decreasing step.
    let shear = |step: f64, impacts: ImpactResolution| {
        let mut b = ModelBuilder::new();
        let m = b.material(Material::new("stiff", 0.2e12, 3e3));
        let s = b.section(Section::new("plank", 0.1, 8.33e-5));
        let girder = b.beam(beam("girder", [0.0, 0.0], [3.0, 0.0], 6, m, s));
        hold(&mut b, at("left", girder, 0.0), SupportKind::Clamp);
        hold(&mut b, at("right", girder, 1.0), SupportKind::Clamp);
        b.projectile(rigid("hammer", at("mid", girder, 0.5), [0.0, -40.0], 1.0));
        b.record_point(at("mid", girder, 0.5));
        let model = b.build().unwrap();
        let mut log = Columns::default();
        // Until two steps after the impact.
        let blow = 0.02 / 40.0;
        let settings = Settings { impacts, ..Settings::new(blow + 2.5 * step, step) };
        let run = simulate(&model, &settings, &mut log).unwrap();
        let ContactRecord::Nonsmooth { impacts, .. } = &run.contacts[0].record else { panic!() };
        assert_eq!(impacts.len(), 1);
        let rows = log.of("section.mid.shear");
        let largest = rows.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        (largest, run.section_forces[0].shear.largest().value.abs())
    };
    let event = [1e-5, 1e-6, 1e-7].map(|h| shear(h, ImpactResolution::Event));
    // The impulse over the step would be 3815 N s / 1e-7 s = 4e10 N; stresses have had no time to rise.
    for (row, extreme) in event {
        assert!(row <= extreme * (1.0 + 1e-12) && extreme < 5e7, "{event:?}");
    }
    assert!(event[2].1 < 1.1 * event[0].1.max(event[1].1), "{event:?}");
    let tolerance = ImpactResolution::CLOSED_TOLERANCE;
    let stepping = ImpactResolution::TimeStepping { closed_tolerance: tolerance };
    let paper = [1e-5, 1e-6].map(|h| shear(h, stepping));
    assert!(paper[1].1 < 1.1 * paper[0].1.max(1.0) + 5e7, "{paper:?}");
}
