//! Foundations along beams: balances under impact, lift-off, yielding, section forces, faults.

use crate::common;

use common::*;
use percuss::*;

/// Stiffness \[N/m^2\] and yield reaction \[N/m\] per length.
const STIFFNESS: f64 = 2e6;
const LIMIT: f64 = 1.5e4;

fn yields(isotropic: f64, kinematic: f64) -> Plasticity {
    Plasticity {
        curve: vec![Hardening { from: 0.0, stress: LIMIT, modulus: isotropic }],
        kinematic,
        overstress: None,
        failure_strain: None,
    }
}

fn ground(beam: BeamId, law: FoundationLaw, yielding: Option<Plasticity>) -> Foundation {
    Foundation {
        name: "ground".into(),
        beam,
        stretch: [Along::Fraction(0.0), Along::Fraction(1.0)],
        direction: None,
        law,
        damping: 0.0,
        yielding,
    }
}

fn elastic_ground() -> FoundationLaw {
    FoundationLaw::Linear { stiffness: STIFFNESS }
}

fn table() -> FoundationLaw {
    FoundationLaw::Table {
        deflection: vec![-5e-3, 0.0, 2e-3, 1e-2],
        reaction: vec![-2e3, 0.0, 8e3, 1.2e4],
    }
}

/// The paper's plank on a foundation, struck from above near its middle by a mass on a spring.
fn struck(foundation: impl FnOnce(BeamId) -> Foundation) -> Model {
    let mut b = ModelBuilder::new();
    let (material, section) = plank(&mut b);
    let plank = b.beam(beam("plank", [0.0, 0.0], [3.0, 0.0], 12, material, section));
    b.foundation(foundation(plank));
    b.projectile(elastic("mass", at("place", plank, 0.4), [0.0, -3.0]));
    b.build().unwrap()
}

fn assert_balances(summary: &RunSummary, name: &str) {
    assert!(matches!(summary.termination, Termination::Completed), "{name}: {summary:?}");
    assert!(summary.energy.residual_max < 1e-10, "{name}: {:e}", summary.energy.residual_max);
    assert!(summary.momentum.linear_residual_max < 1e-10, "{name}");
    assert!(summary.momentum.angular_residual_max < 1e-10, "{name}");
}

/// Energy and momenta balance under impact, whatever the law.
#[test]
fn balances_close_on_every_kind_of_foundation() {
    let linear = elastic_ground;
    let one_sided = |gap| FoundationLaw::Compression { stiffness: STIFFNESS, gap };
    let damped = move |beam| Foundation { damping: 2e3, ..ground(beam, one_sided(0.0), None) };
    let oblique = move |beam| Foundation {
        direction: Some([1.0, 2.0]),
        stretch: [Along::Distance(0.7), Along::Fraction(0.9)],
        ..ground(beam, linear(), None)
    };
    type Make<'a> = (&'a str, Box<dyn FnOnce(BeamId) -> Foundation>);
    let all: [Make<'_>; 9] = [
        ("linear", Box::new(move |b| ground(b, linear(), None))),
        ("one-sided", Box::new(move |b| ground(b, one_sided(0.0), None))),
        ("gap", Box::new(move |b| ground(b, one_sided(5e-3), None))),
        ("table", Box::new(move |b| ground(b, table(), None))),
        ("yields", Box::new(move |b| ground(b, linear(), Some(yields(0.0, 0.0))))),
        ("hardens", Box::new(move |b| ground(b, linear(), Some(yields(1e5, 2e5))))),
        ("gapes", Box::new(move |b| ground(b, one_sided(1e-3), Some(yields(1e5, 0.0))))),
        ("damped", Box::new(damped)),
        ("oblique", Box::new(oblique)),
    ];
    for (name, foundation) in all {
        let model = struck(foundation);
        let mut rows = MemoryRecorder::default();
        let summary = simulate(&model, &Settings::new(0.2, 2e-4), &mut rows).unwrap();
        assert_balances(&summary, name);
        let found = &summary.foundations[0];
        assert!(found.pressure.max.value > 1e3, "{name}: {found:?}");
        let own = &found.properties;
        let (kind, stiffness) = match name {
            "table" => (FoundationKind::Table, None),
            "one-sided" | "gap" | "gapes" | "damped" => {
                (FoundationKind::Compression, Some(STIFFNESS))
            }
            _ => (FoundationKind::Linear, Some(STIFFNESS)),
        };
        assert_eq!((own.beam.as_str(), own.kind, own.stiffness), ("plank", kind, stiffness));
        let [from, to] = if name == "oblique" { [0.7, 2.7] } else { [0.0, 3.0] };
        let apart = [own.stretch[0] - from, own.stretch[1] - to];
        assert!(apart.iter().all(|d| d.abs() < 1e-12), "{own:?}");
        let plastic = ["yields", "hardens", "gapes"].contains(&name);
        assert_eq!(found.first_yield.is_some(), plastic, "{name}: {found:?}");
        assert_eq!(found.dissipated > 1.0, plastic, "{name}: {found:?}");
        assert!((found.dissipated - summary.energy.plastic).abs() <= 1e-9 * found.dissipated);
        assert!((found.hardening - summary.energy.hardening).abs() <= 1e-9 * found.hardening);
        // What presses alone never pulls, and the beam lifts off.
        let lifts = ["one-sided", "gap", "gapes", "damped"].contains(&name);
        assert_eq!(found.pressure.min.value >= 0.0, lifts, "{name}: {found:?}");
        assert_eq!(found.lifted.value > 0.0, lifts, "{name}: {found:?}");
        // Its energy is all that springs have.
        let [own, all] = ["foundation.ground.energy", "energy.springs"]
            .map(|column| rows.column(column).unwrap());
        assert!(own.iter().zip(&all).all(|(a, b)| (a - b).abs() <= 1e-12 * found.energy_max.value));
    }
}

/// A free beam that moves into a bed of compression alone with dampers: its mass per length on k and c leaves it with the share
/// `exp(-tan(phi) (pi - 2 phi))`, `sin(phi) = zeta`, of its speed, when the force becomes zero (Schwager and Poeschel 2007); the reaction never pulls.
#[test]
fn a_damped_foundation_of_compression_never_pulls() {
    for (zeta, gap, limit) in [(0.2_f64, 0.0, None), (0.6, 1e-3, None), (0.6, 0.0, Some(0.0))] {
        let mut b = ModelBuilder::new();
        let (material, section) = plank(&mut b);
        let mass = 3e3 * 0.1;
        let plank = b.beam(beam("plank", [0.0, 0.0], [3.0, 0.0], 4, material, section));
        let law = FoundationLaw::Compression { stiffness: STIFFNESS, gap };
        let damping = 2.0 * zeta * (STIFFNESS * mass).sqrt();
        let yielding = limit.map(|isotropic| yields(isotropic, 0.0));
        b.foundation(Foundation { damping, ..ground(plank, law, yielding) });
        let velocity = [0.0, -1.0];
        b.initial_motion(InitialMotion { velocity, spin: 0.0, about: [0.0; 2] });
        b.record_point(at("middle", plank, 0.5));
        let mut rows = MemoryRecorder::default();
        let model = b.build().unwrap();
        let summary = simulate(&model, &Settings::new(0.2, 5e-5), &mut rows).unwrap();
        assert_balances(&summary, "damped");
        let found = &summary.foundations[0];
        assert!(found.pressure.min.value >= 0.0, "{zeta}: {found:?}");
        let speed = rows.column("point.middle.velocity_2").unwrap();
        assert!(speed.windows(2).all(|w| w[1] - w[0] > -1e-9), "{zeta}: it is pulled");
        let phi = zeta.asin();
        let expected = (-phi.tan() * (std::f64::consts::PI - 2.0 * phi)).exp();
        let last = speed[speed.len() - 1];
        if limit.is_none() {
            assert!((last / expected - 1.0).abs() < 5e-3, "{zeta}: {last} {expected}");
        }
        // What is told as reaction is what moves the beam.
        let force = rows.column("foundation.ground.force_2").unwrap();
        let impulse: f64 = force.iter().map(|f| f * 5e-5).sum();
        assert!((impulse / (3.0 * mass * (last + 1.0)) - 1.0).abs() < 1e-2, "{zeta}: {impulse}");
    }
}

/// A long beam under a force in its middle, `w = P / (2 sqrt(b + 2 c)) (1 / (EI c) + 1 / S)` with `b = k / S`, `c = sqrt(k / EI)` and the shear
/// stiffness S (Timoshenko's beam on Winkler's foundation, by Fourier transformation).
#[test]
fn a_foundation_bears_a_shear_flexible_beam() {
    let (young, depth, force) = (2e9, 0.5, -1e3);
    let bending = young * f64::powi(depth, 3) / 12.0;
    for shear_modulus in [2e12, 1e8] {
        let mut b = ModelBuilder::new();
        let own = Some(shear_modulus);
        let material =
            b.material(Material { shear_modulus: own, ..Material::new("m", young, 3e3) });
        let factor = Some(0.8);
        let rectangle = Section::rectangle("s", 1.0, depth);
        let section = b.section(Section { shear_factor: factor, ..rectangle });
        let slender = beam("long", [0.0, 0.0], [60.0, 0.0], 240, material, section);
        let long = b.beam(Beam { theory: Theory::Shear, ..slender });
        b.foundation(ground(long, elastic_ground(), None));
        let (place, moment) = (at("middle", long, 0.5), 0.0);
        let kind = LoadKind::Point { at: place, force: [0.0, force], moment, follower: false };
        b.load(Load::new("force", kind));
        b.support(Support::new(
            "held",
            at("start", long, 0.0),
            SupportKind::Roller { direction: [0.0, 1.0] },
        ));
        b.record_point(at("middle", long, 0.5));
        let found = equilibrium(&b.build().unwrap()).unwrap();
        let stiffness = 0.8 * shear_modulus * depth;
        let (q, c) = (STIFFNESS / stiffness, (STIFFNESS / bending).sqrt());
        let exact = force / (2.0 * (q + 2.0 * c).sqrt()) * (1.0 / (bending * c) + 1.0 / stiffness);
        let [_, y] = found.points[0].1;
        assert!((y / exact - 1.0).abs() < 2e-3, "{shear_modulus:?}: {y:e} {exact:e}");
        let borne = found.foundations[0].force[1];
        assert!((borne / force + 1.0).abs() < 1e-6, "{borne}");
    }
}

/// Other schemes do not conserve energy but have the same foundation: the deflections of a resolved run agree.
#[test]
fn schemes_agree_on_a_foundation() {
    let model =
        struck(|b| ground(b, FoundationLaw::Compression { stiffness: STIFFNESS, gap: 0.0 }, None));
    let largest = |scheme| {
        let settings = Settings { scheme, ..Settings::new(0.05, 2e-5) };
        let summary = simulate(&model, &settings, &mut NoRecorder).unwrap();
        summary.foundations[0].pressure.max.value
    };
    let own = largest(Scheme::EnergyMomentum);
    for scheme in [Scheme::Midpoint, Scheme::Newmark, Scheme::StrainRate] {
        let other = largest(scheme);
        assert!((other / own - 1.0).abs() < 2e-3, "{scheme:?}: {other} {own}");
    }
}

/// A beam under its weight sinks evenly, and no section carries anything.
#[test]
fn a_beam_under_its_weight_sinks_evenly() {
    let mut b = ModelBuilder::new();
    let (material, section) = plank(&mut b);
    let plank = b.beam(beam("plank", [0.0, 0.0], [3.0, 0.0], 7, material, section));
    b.foundation(ground(plank, FoundationLaw::Linear { stiffness: STIFFNESS }, None));
    let components = vec![Component::Displacement1];
    b.support(Support::new("guide", at("left", plank, 0.0), SupportKind::Fix { components }));
    b.load(Load::new("g", LoadKind::Gravity { acceleration: [0.0, -9.81] }));
    let model = b.build().unwrap();
    let found = equilibrium(&model).unwrap();
    // Section forces of round-off have no buckling factor.
    assert_eq!(buckling(&model, 1).outcome, BucklingOutcome::Unstrained);
    let weight = 3e3 * 0.1 * 9.81;
    let ground = &found.foundations[0];
    assert!((ground.force[1] / (3.0 * weight) - 1.0).abs() < 1e-10, "{ground:?}");
    assert!((found.balance.springs[1] / (3.0 * weight) - 1.0).abs() < 1e-10);
    assert!(ground.pressure.iter().all(|p| (p / weight - 1.0).abs() < 1e-9), "{ground:?}");
    assert_eq!(ground.pressure.len(), 21);
    let energy = 0.5 * weight * weight / STIFFNESS * 3.0;
    assert!((ground.energy / energy - 1.0).abs() < 1e-9, "{ground:?}");
    let forces = &found.section_forces[0];
    assert!(forces.shear.largest().value.abs() < 1e-7 * weight, "{forces:?}");
    assert!(forces.moment.largest().value.abs() < 1e-7 * weight, "{forces:?}");
}

/// Linear buckling has the stiffness of the unloaded foundation, and says so once for all of its springs.
#[test]
fn linear_buckling_names_a_foundation_whose_stiffness_changes() {
    let of = |law: FoundationLaw| {
        let mut b = ModelBuilder::new();
        let (material, section) = plank(&mut b);
        let plank = b.beam(beam("plank", [0.0, 0.0], [3.0, 0.0], 7, material, section));
        b.foundation(ground(plank, law, None));
        b.support(Support::new("left", at("left", plank, 0.0), SupportKind::Pin));
        let kind = SupportKind::Roller { direction: [1.0, 0.0] };
        b.support(Support::new("right", at("right", plank, 1.0), kind));
        let stretch = [Along::Fraction(0.0), Along::Fraction(1.0)];
        let force = [[-1e3, -1.5e4]; 2];
        b.load(Load::new(
            "load",
            LoadKind::Distributed { beam: plank, stretch, force, follower: false },
        ));
        let model = b.build().unwrap();
        let found = equilibrium(&model).unwrap();
        let linear = buckling_in_contact(&model, &found, 1);
        assert_eq!(linear.springs_as_unloaded, 0);
        assert_eq!(linear.assumptions().len(), linear.foundations_as_unloaded);
        linear.foundations_as_unloaded
    };
    assert_eq!(of(elastic_ground()), 0);
    assert_eq!(of(table()), 1);
}

/// A foundation that only pushes carries a beam that nothing else holds, and where a force lifts it, it lets the beam go.
#[test]
fn a_beam_rests_on_a_foundation_that_only_pushes() {
    let of = |lift: f64| {
        let mut b = ModelBuilder::new();
        let (material, section) = plank(&mut b);
        let plank = b.beam(beam("plank", [0.0, 0.0], [3.0, 0.0], 12, material, section));
        let law = FoundationLaw::Compression { stiffness: STIFFNESS, gap: 0.0 };
        b.foundation(ground(plank, law, None));
        let components = vec![Component::Displacement1];
        b.support(Support::new("guide", at("left", plank, 0.0), SupportKind::Fix { components }));
        b.load(Load::new("g", LoadKind::Gravity { acceleration: [0.0, -9.81] }));
        if lift > 0.0 {
            let (at, force) = (at("end", plank, 1.0), [0.0, lift]);
            let kind = LoadKind::Point { at, force, moment: 0.0, follower: false };
            b.load(Load::new("lift", kind));
        }
        equilibrium(&b.build().unwrap()).unwrap()
    };
    let weight = 3e3 * 0.1 * 9.81;
    let rests = &of(0.0).foundations[0];
    assert!(rests.pressure.iter().all(|p| (p / weight - 1.0).abs() < 1e-7), "{rests:?}");
    assert_eq!(rests.lifted, 0.0);
    let lifted = of(0.4 * 3.0 * weight);
    let found = &lifted.foundations[0];
    assert!((found.force[1] / (0.6 * 3.0 * weight) - 1.0).abs() < 1e-7, "{found:?}");
    assert!(found.lifted > 0.2 && found.lifted < 2.5, "{found:?}");
    assert!(found.pressure.iter().all(|p| *p >= 0.0) && lifted.stable, "{found:?}");
}

/// The reaction enters the balance of the elements: the shear force at a clamp is its reaction, and free ends carry nothing.
#[test]
fn section_forces_hold_the_reaction_in_balance() {
    let mut b = ModelBuilder::new();
    let (material, section) = plank(&mut b);
    let arm = b.beam(beam("arm", [0.0, 0.0], [3.0, 0.0], 6, material, section));
    b.support(Support::new("root", at("root", arm, 0.0), SupportKind::Clamp));
    let stretch = [Along::Distance(1.2), Along::Fraction(1.0)];
    let law = FoundationLaw::Linear { stiffness: 1e5 };
    b.foundation(Foundation { stretch, ..ground(arm, law, None) });
    let force = [0.0, -50.0];
    let tip = at("tip", arm, 1.0);
    b.load(Load::new("P", LoadKind::Point { at: tip, force, moment: 0.0, follower: false }));
    let found = equilibrium(&b.build().unwrap()).unwrap();
    let root = found.reactions[0].1;
    // Tension, the push upwards, and the other turn: as the support has them on the other side of the cut.
    let [axial, shear, moment] = found.element_forces[0][0];
    for (own, other) in [(axial, -root[0]), (shear, root[1]), (moment, -root[2])] {
        assert!((own - other).abs() < 1e-8 * 50.0, "{own} {other}");
    }
    let tip = found.element_forces.last().unwrap()[1];
    // The end turns by a thousandth, and the shear force with it.
    assert!((tip[1] - 50.0).abs() < 1e-3 && tip[2].abs() < 1e-6, "{tip:?}");
    let vertical = root[1] + found.foundations[0].force[1] - 50.0;
    assert!(vertical.abs() < 1e-6, "{vertical}");
    assert!(found.foundations[0].s.iter().all(|s| *s > 1.2));
}

/// A run goes on from a checkpoint as it would have without.
#[test]
fn a_yielding_foundation_is_a_part_of_the_state() {
    let law = FoundationLaw::Compression { stiffness: STIFFNESS, gap: 0.0 };
    let model = struck(|b| ground(b, law, Some(yields(0.0, 0.0))));
    let settings = Settings::new(0.06, 2e-4);
    let whole = simulate(&model, &settings, &mut NoRecorder).unwrap();
    let mut first = Simulation::new(&model, &settings).unwrap();
    for _ in 0..150 {
        first.advance(&mut NoRecorder).unwrap();
    }
    let second = Simulation::resume(&model, &settings, first.checkpoint()).unwrap();
    let end = second.run(&mut NoRecorder);
    assert_eq!(format!("{:?}", end.foundations), format!("{:?}", whole.foundations));
}

#[test]
fn faults_of_foundations_name_their_key() {
    let fault = |change: &dyn Fn(&mut Foundation)| {
        let mut b = ModelBuilder::new();
        let (material, section) = plank(&mut b);
        let plank = b.beam(beam("plank", [0.0, 0.0], [3.0, 0.0], 7, material, section));
        let mut own = ground(plank, FoundationLaw::Linear { stiffness: STIFFNESS }, None);
        change(&mut own);
        b.foundation(own);
        b.build().unwrap_err().into_iter().map(|f| f.path).collect::<Vec<_>>()
    };
    let compression = |gap| FoundationLaw::Compression { stiffness: STIFFNESS, gap };
    for (key, change) in [
        (
            "stretch",
            &(|f: &mut Foundation| f.stretch = [Along::Fraction(0.5), Along::Distance(1.0)])
                as &dyn Fn(&mut Foundation),
        ),
        ("direction", &|f| f.direction = Some([0.0, 0.0])),
        ("damping", &|f| f.damping = -1.0),
        ("stiffness", &|f| f.law = FoundationLaw::Linear { stiffness: 0.0 }),
        ("stiffness", &|f| f.law = FoundationLaw::Linear { stiffness: -1.0 }),
        ("gap", &move |f| f.law = compression(-1.0)),
        ("yield_force", &|f| {
            f.law = table();
            f.yielding = Some(yields(0.0, 0.0));
        }),
        ("hardening.kinematic", &move |f| {
            f.law = compression(0.0);
            f.yielding = Some(yields(0.0, 1e3));
        }),
        ("reactions", &|f| {
            let (deflection, reaction) = (vec![0.0, 0.1], vec![1.0, 2.0]);
            f.law = FoundationLaw::Table { deflection, reaction };
        }),
        ("deflections", &|f| {
            let (deflection, reaction) = (vec![0.0, 0.0], vec![0.0, 2.0]);
            f.law = FoundationLaw::Table { deflection, reaction };
        }),
    ] {
        assert_eq!(fault(change), [format!("foundation.ground.{key}")]);
    }
}
