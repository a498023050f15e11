//! Every scheme, both strain measures: conserved quantities; supports; loads; step cuts.

use crate::common;

use common::*;
use percuss::*;

const SCHEMES: [Scheme; 5] = [
    Scheme::EnergyMomentum,
    Scheme::StrainRate,
    Scheme::Midpoint,
    Scheme::Newmark,
    Scheme::GeneralizedAlpha { spectral_radius: 0.8 },
];

fn free_beam(strain: StrainMeasure) -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(Material { strain, ..Material::new("m", 0.2e10, 3e3) });
    let section = plank(&mut b).1;
    let girder = b.beam(beam("girder", [0.0, 0.0], [2.4, 1.8], 6, material, section));
    b.projectile(elastic("mass", at("girder@0.3", girder, 0.3), [2.0, 20.0]));
    b.build().unwrap()
}

fn run(model: &Model, scheme: Scheme, end: f64, step: f64) -> RunSummary {
    let settings = Settings { scheme, ..Settings::new(end, step) };
    let summary = simulate(model, &settings, &mut NoRecorder).unwrap();
    assert!(matches!(summary.termination, Termination::Completed), "{scheme:?} {summary:?}");
    summary
}

#[test]
fn energy_momentum_schemes_close_every_balance() {
    for strain in [StrainMeasure::Green, StrainMeasure::Engineering] {
        for scheme in [Scheme::EnergyMomentum, Scheme::StrainRate] {
            let s = run(&free_beam(strain), scheme, 0.5, 1e-3);
            assert!(s.energy.residual_max < 1e-11, "{scheme:?} {:e}", s.energy.residual_max);
            assert!(s.momentum.linear_residual_max < 1e-11);
            assert!(s.momentum.angular_residual_max < 1e-11);
        }
    }
}

#[test]
fn every_scheme_keeps_linear_momentum_and_converges_to_the_same_motion() {
    let model = free_beam(StrainMeasure::Green);
    let reference = run(&model, Scheme::EnergyMomentum, 0.15, 5e-6).projectiles[0].velocity_final;
    for scheme in SCHEMES {
        let error = |step: f64| {
            let s = run(&model, scheme, 0.15, step);
            assert!(s.momentum.linear_residual_max < 1e-10, "{scheme:?}");
            (s.projectiles[0].velocity_final[1] - reference[1]).abs()
        };
        let (coarse, fine) = (error(1e-4), error(2.5e-5));
        assert!(fine < 2e-5, "{scheme:?} {fine:e}");
        assert!(fine < 0.2 * coarse, "{scheme:?} {coarse:e} {fine:e}");
    }
}

#[test]
fn other_schemes_show_their_energy_error_in_the_balance() {
    let model = free_beam(StrainMeasure::Green);
    for scheme in &SCHEMES[2..] {
        let error = |step: f64| run(&model, *scheme, 0.15, step).energy.residual_max;
        let (coarse, fine) = (error(4e-4), error(1e-4));
        assert!(coarse > 1e-9, "{scheme:?} {coarse:e}");
        assert!(fine < 0.3 * coarse, "{scheme:?} {coarse:e} {fine:e}");
    }
}

#[test]
fn dissipation_of_generalized_alpha_grows_as_its_radius_shrinks() {
    let model = free_beam(StrainMeasure::Green);
    let kept = |spectral_radius: f64| {
        run(&model, Scheme::GeneralizedAlpha { spectral_radius }, 0.5, 1e-3).energy.final_
    };
    assert!(kept(0.0) < kept(0.2) && kept(0.2) < kept(0.95));
}

#[test]
fn accelerations_and_impulses_do_not_mix() {
    let mut b = ModelBuilder::new();
    let (material, section) = plank(&mut b);
    let girder = b.beam(beam("girder", [0.0, 0.0], [3.0, 0.0], 2, material, section));
    b.projectile(rigid("hammer", at("girder.mid", girder, 0.5), [0.0, -1.0], 1.0));
    let model = b.build().unwrap();
    let settings = Settings { scheme: Scheme::Newmark, ..Settings::new(1.0, 1e-3) };
    let faults = simulate(&model, &settings, &mut NoRecorder).unwrap_err();
    assert_eq!(faults[0].path, "integrator.scheme");
}

#[test]
fn supports_hold_and_their_impulses_are_on_the_balance() {
    let kinds = [
        SupportKind::Clamp,
        SupportKind::Pin,
        SupportKind::Roller { direction: [2.0, 1.0] },
        SupportKind::Fix { components: vec![Component::Displacement2, Component::Rotation] },
        SupportKind::Fix { components: vec![Component::Stretch] },
    ];
    for kind in kinds {
        // At a node, and at a point inside an element.
        for place in [0.5, 0.43] {
            let mut b = ModelBuilder::new();
            let (material, section) = plank(&mut b);
            let girder = b.beam(beam("girder", [0.0, 0.0], [2.4, 1.8], 6, material, section));
            b.support(Support::new("held", at("held", girder, place), kind.clone()));
            b.projectile(elastic("mass", at("tip", girder, 1.0), [3.0, -20.0]));
            b.record_point(at("held", girder, place));
            let model = b.build().unwrap();
            for scheme in [Scheme::EnergyMomentum, Scheme::StrainRate] {
                let s = run(&model, scheme, 0.2, 1e-3);
                let name = format!("{kind:?} at {place}, {scheme:?}");
                assert!(s.energy.residual_max < 1e-10, "{name} {:e}", s.energy.residual_max);
                assert!(s.momentum.linear_residual_max < 1e-10, "{name}");
                assert!(s.momentum.angular_residual_max < 1e-10, "{name}");
                let held = &s.points.iter().find(|p| p.name == "held").unwrap().displacement_max;
                let [u1, u2] = [held[0].value.abs(), held[1].value.abs()];
                match kind {
                    SupportKind::Clamp | SupportKind::Pin => assert!(u1.max(u2) < 1e-12, "{name}"),
                    SupportKind::Roller { .. } => {
                        assert!(u1 > 1e-3 && (u1 - 2.0 * u2).abs() < 1e-11, "{name} {u1} {u2}");
                    }
                    _ => {}
                }
            }
        }
    }
}

#[test]
fn loads_put_their_work_and_impulse_on_the_balance() {
    let mut b = ModelBuilder::new();
    let (material, section) = plank(&mut b);
    let girder = b.beam(beam("girder", [0.0, 0.0], [3.0, 0.0], 5, material, section));
    let point = |f: f64, force, moment| LoadKind::Point {
        at: at("p", girder, f),
        force,
        moment,
        follower: false,
    };
    for (i, (kind, from, until)) in [
        (LoadKind::Gravity { acceleration: [1.0, -9.81] }, 0.0, f64::INFINITY),
        (point(0.37, [1e4, -2e4], 0.0), 0.0123, 0.0789),
        (point(1.0, [0.0, 0.0], 3e3), 0.05, 0.2),
    ]
    .into_iter()
    .enumerate()
    {
        b.load(Load { from, until, ..Load::new(format!("load{i}"), kind) });
    }
    b.projectile(elastic("mass", at("mid", girder, 0.5), [0.0, 10.0]));
    let model = b.build().unwrap();
    for scheme in [Scheme::EnergyMomentum, Scheme::StrainRate] {
        let settings = Settings { scheme, ..Settings::new(0.3, 1e-3) };
        let mut simulation = Simulation::new(&model, &settings).unwrap();
        while simulation.state().step < simulation.step_count() {
            simulation.advance(&mut NoRecorder).unwrap();
        }
        let (ledger, measures) = (&simulation.state().ledger, simulation.measures());
        assert!(ledger.work_loads.abs() > 100.0);
        assert!(ledger.energy_residual(measures).abs() < 1e-10 * ledger.energy_scale);
        assert!(ledger.angular_residual(measures).abs() < 1e-10 * ledger.angular_scale);
        // Closed form of the impulse: mass of beam (900 kg) and projectile times gravity, and the force for as long as it acts.
        let expected = [
            (900.0 + 500.0) * 0.3 + 1e4 * (0.0789 - 0.0123),
            -9.81 * (900.0 + 500.0) * 0.3 - 2e4 * (0.0789 - 0.0123),
        ];
        for i in 0..2 {
            let impulse = ledger.impulse_loads[i];
            assert!((impulse - expected[i]).abs() < 1e-9 * expected[i].abs(), "{impulse}");
            let residual = ledger.linear_residual(measures)[i];
            assert!(residual.abs() < 1e-10 * ledger.linear_scale);
        }
    }
}

#[test]
fn a_step_too_long_for_newton_is_cut_and_the_balances_still_close() {
    let mut b = ModelBuilder::new();
    let (material, section) = plank(&mut b);
    let girder = b.beam(beam("girder", [0.0, 0.0], [3.0, 0.0], 6, material, section));
    b.projectile(elastic("mass", at("mid", girder, 0.5), [0.0, 200.0]));
    let model = b.build().unwrap();
    let summary = run(&model, Scheme::EnergyMomentum, 1.0, 0.05);
    assert!(summary.step_cuts > 0, "the step was short enough after all");
    assert_eq!(summary.steps, 20);
    assert!((summary.time - 1.0).abs() < 1e-12);
    assert!(summary.energy.residual_max < 1e-10, "{:e}", summary.energy.residual_max);
}

#[test]
fn a_run_that_ends_between_steps_ends_with_a_shorter_one() {
    let summary = run(&free_beam(StrainMeasure::Green), Scheme::EnergyMomentum, 0.0105, 1e-3);
    assert_eq!(summary.steps, 11);
    assert_eq!(summary.time, 0.0105);
}

#[test]
fn rows_are_recorded_at_the_pace_asked_for() {
    let settings = Settings { record_every: 7, ..Settings::new(0.1, 1e-3) };
    let mut memory = MemoryRecorder::default();
    let model = free_beam(StrainMeasure::Green);
    simulate(&model, &settings, &mut memory).unwrap();
    let time = memory.column("time").unwrap();
    assert_eq!(time.len(), 1 + 100 / 7 + 1);
    assert_eq!(time[1], 7.0 * 1e-3);
    assert_eq!(*time.last().unwrap(), 0.1);
}

#[test]
fn a_run_that_gives_up_says_where_and_keeps_what_it_has() {
    let mut b = ModelBuilder::new();
    let (material, section) = plank(&mut b);
    let girder = b.beam(beam("girder", [0.0, 0.0], [3.0, 0.0], 6, material, section));
    b.support(Support::new("s", at("s", girder, 0.0), SupportKind::Clamp));
    let kind = LoadKind::Point {
        at: at("tip", girder, 1.0),
        force: [0.0, 1e25],
        moment: 0.0,
        follower: false,
    };
    b.load(Load { from: 0.05, until: 0.06, ..Load::new("blow", kind) });
    let model = b.build().unwrap();
    let mut memory = MemoryRecorder::default();
    let summary = simulate(&model, &Settings::new(0.1, 1e-2), &mut memory).unwrap();
    let Termination::Failed(error) = &summary.termination else { panic!("{summary:?}") };
    assert!(error.is_no_convergence());
    let message = error.to_string();
    for part in ["t = 5.0", "step of", "residual", "element", "of beam `girder`"] {
        assert!(message.contains(part), "{message}");
    }
    assert!((summary.time - 0.05).abs() < 1e-12 && summary.steps == 5);
    assert_eq!(memory.column("time").unwrap().len(), 6);
}

/// Displacements and velocities of the tip of a cantilever at the end of a run, shape (4).
fn tip(scheme: Scheme, load: &Load, step: f64) -> [f64; 4] {
    let mut b = ModelBuilder::new();
    let (material, section) = plank(&mut b);
    let arm = b.beam(beam("arm", [0.0, 0.0], [3.0, 0.0], 1, material, section));
    b.support(Support::new("root", at("root", arm, 0.0), SupportKind::Clamp));
    b.record_point(at("tip", arm, 1.0));
    b.load(load.clone());
    let model = b.build().unwrap();
    let settings = Settings { scheme, ..Settings::new(0.02, step) };
    let mut rows = MemoryRecorder::default();
    simulate(&model, &settings, &mut rows).unwrap();
    let last = |name: &str| *rows.column(&format!("point.tip.{name}")).unwrap().last().unwrap();
    ["displacement_1", "displacement_2", "velocity_1", "velocity_2"].map(last)
}

/// Loads of every kind with a harmonic factor, and a force with every function of time, kinks and jumps between steps included.
fn loads_in_time() -> Vec<(String, Load)> {
    use TimeFunction::*;
    let mut b = ModelBuilder::new();
    let (material, section) = plank(&mut b);
    let arm = b.beam(beam("arm", [0.0, 0.0], [3.0, 0.0], 1, material, section));
    let point = |force, moment, follower| LoadKind::Point {
        at: at("tip", arm, 1.0),
        force,
        moment,
        follower,
    };
    let spread = |follower| LoadKind::Distributed {
        beam: arm,
        stretch: [Along::Fraction(0.0), Along::Fraction(1.0)],
        force: [[2e3, -5e4]; 2],
        follower,
    };
    let kinds = [
        ("gravity", LoadKind::Gravity { acceleration: [20.0, -100.0] }),
        ("force", point([1e4, -5e4], 0.0, false)),
        ("follower force", point([1e4, -5e4], 0.0, true)),
        ("moment", point([0.0; 2], 1e5, false)),
        ("spread force", spread(false)),
        ("pressure", spread(true)),
    ];
    let harmonic = Harmonic { frequency: 40.0, phase: 0.7 };
    let mut all: Vec<(String, Load)> = (kinds.into_iter())
        .map(|(name, kind)| {
            (name.to_owned(), Load { function: harmonic.clone(), ..Load::new(name, kind) })
        })
        .collect();
    // A third of a step before or behind its end, whatever the step.
    let between = (60.0 + 1.0 / 3.0) * 8e-5;
    let table = |smooth| Table {
        times: vec![0.0, 0.5 * between, between, 0.02],
        values: vec![0.3, 1.0, -0.5, 0.2],
        smooth,
    };
    for (name, function) in [
        ("constant", Constant),
        ("step", Step { at: between }),
        ("ramp", Ramp { duration: between }),
        ("half sine", HalfSine { duration: between }),
        ("triangle", Triangle { duration: 2.0 * between }),
        ("table", table(false)),
        ("smooth table", table(true)),
        ("code", TimeFunction::function(|t| (300.0 * t).cos())),
    ] {
        let load = Load::new(name, point([0.0, -5e4], 0.0, false));
        all.push((name.to_owned(), Load { function, ..load }));
    }
    let from = Load {
        from: between,
        until: 2.0 * between,
        ..Load::new("f", point([0.0, -5e4], 0.0, false))
    };
    all.push(("for a time".to_owned(), from));
    all
}

#[test]
fn every_scheme_is_of_second_order_with_every_load() {
    let mut wrong = Vec::new();
    for (name, load) in loads_in_time() {
        let limit = tip(Scheme::EnergyMomentum, &load, 1e-5);
        for scheme in SCHEMES {
            let [coarse, middle, fine] = [4e-5, 2e-5, 1e-5].map(|step| tip(scheme, &load, step));
            let apart =
                |a: &[f64; 4], b: &[f64; 4], k: usize| (a[k] - b[k]).hypot(a[k + 1] - b[k + 1]);
            for k in [0, 2] {
                let ratio = apart(&coarse, &middle, k) / apart(&middle, &fine, k);
                let off = apart(&fine, &limit, k) / limit[k].hypot(limit[k + 1]);
                // Four at second order, two at first; axial waves along the one element are just resolved.
                if !((ratio > 2.8 || off < 1e-7) && off < 1e-3) {
                    wrong.push(format!("{name}, {scheme:?}, {k}: {ratio:.2}, off by {off:.1e}"));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
