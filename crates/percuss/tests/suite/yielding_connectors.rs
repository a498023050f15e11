//! Springs and hinges that yield: the law of a fibre on a coordinate, in motion and at rest.

use crate::common;

use common::*;
use percuss::*;

/// Stiffness, yield force and both plastic moduli of the spring \[N/m, N\].
const STIFFNESS: f64 = 2e6;
const LIMIT: f64 = 1e4;
const ISOTROPIC: f64 = 5e4;
const KINEMATIC: f64 = 8e4;

/// A force or moment at which something yields, perfectly plastic.
fn perfect(limit: f64) -> Plasticity {
    Plasticity {
        curve: vec![Hardening { from: 0.0, stress: limit, modulus: 0.0 }],
        kinematic: 0.0,
        overstress: None,
        failure_strain: None,
    }
}

fn hardening() -> Plasticity {
    let mut law = perfect(LIMIT);
    law.curve[0].modulus = ISOTROPIC;
    Plasticity { kinematic: KINEMATIC, ..law }
}

/// A pinned bar of 1 m with 20 kg at its end and a spring below it, `more` added.
fn braced(law: Option<Plasticity>, more: impl FnOnce(&mut ModelBuilder, BeamId)) -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("steel", 2.05e11, 7850.0));
    let section = b.section(Section::circle("rod", 0.03));
    let bar = b.beam(beam("bar", [0.0, 0.0], [1.0, 0.0], 4, material, section));
    b.support(Support::new("pin", at("pin", bar, 0.0), SupportKind::Pin));
    let end = at("end", bar, 1.0);
    let (name, mass) = ("m".into(), 20.0);
    b.point_mass(PointMass { name, at: end.clone(), mass, rotary_inertia: 0.0 });
    b.spring(Spring {
        name: "brace".into(),
        between: [Anchor::Point(end.clone()), Anchor::Ground([1.0, -0.5])],
        stiffness: STIFFNESS,
        damping: 0.0,
        length: None,
        yielding: law,
    });
    b.record_point(end);
    more(&mut b, bar);
    b.build().unwrap()
}

/// The bar swings down at 3 rad/s.
fn swung(law: Option<Plasticity>) -> Model {
    braced(law, |b, _| {
        b.initial_motion(InitialMotion { velocity: [0.0; 2], spin: -3.0, about: [0.0; 2] });
    })
}

fn assert_balances(summary: &RunSummary, name: &str) {
    assert!(matches!(summary.termination, Termination::Completed), "{name}: {summary:?}");
    assert!(summary.energy.residual_max < 1e-10, "{name}: {:e}", summary.energy.residual_max);
    assert!(summary.momentum.linear_residual_max < 1e-10, "{name}");
    assert!(summary.momentum.angular_residual_max < 1e-10, "{name}");
}

fn run(model: &Model, settings: &Settings) -> (RunSummary, MemoryRecorder) {
    let mut rows = MemoryRecorder::default();
    let summary = simulate(model, settings, &mut rows).unwrap();
    (summary, rows)
}

#[test]
fn a_spring_flows_as_its_extension_asks() {
    let model = swung(Some(hardening()));
    let (summary, rows) = run(&model, &Settings::new(0.1, 1e-4));
    assert_balances(&summary, "swung");
    let column = |name: &str| rows.column(&format!("spring.brace.{name}")).unwrap();
    let (extension, plastic, force) =
        (column("extension"), column("plastic_extension"), column("force"));
    // The return map, which is exact at the end of a straight path.
    let (mut flow, mut sum) = (0.0, 0.0);
    let (mut pulled, mut pressed) = (false, false);
    for (k, e) in extension.iter().enumerate() {
        let relative = STIFFNESS * (e - flow) - KINEMATIC * flow;
        let beyond = relative.abs() - (LIMIT + ISOTROPIC * sum);
        if beyond > 0.0 {
            let more = beyond / (STIFFNESS + ISOTROPIC + KINEMATIC);
            flow += more * relative.signum();
            sum += more;
            (pulled, pressed) = (pulled || relative > 0.0, pressed || relative < 0.0);
        }
        assert!((plastic[k] - flow).abs() < 1e-12, "row {k}: {} {flow}", plastic[k]);
        let expected = STIFFNESS * (e - flow);
        assert!((force[k] - expected).abs() < 1e-9 * LIMIT, "row {k}: {} {expected}", force[k]);
    }
    assert!(pulled && pressed, "it yields both ways");
    let brace = &summary.yielding[0];
    assert_eq!((brace.name.as_str(), brace.turns, brace.failed), ("spring.brace", false, None));
    assert!((brace.accumulated / sum - 1.0).abs() < 1e-9 && (brace.plastic - flow).abs() < 1e-12);
    // All of the energy of plastic flow is its own: (F_y + H alpha) dalpha, and H alpha^2 / 2 + H_k p^2 / 2 is stored.
    let dissipated = LIMIT * sum;
    let stored = 0.5 * ISOTROPIC * sum * sum + 0.5 * KINEMATIC * flow * flow;
    assert!((summary.energy.plastic / dissipated - 1.0).abs() < 1e-9, "{:?}", summary.energy);
    assert!((summary.energy.hardening / stored - 1.0).abs() < 1e-9, "{:?}", summary.energy);
    assert!((brace.dissipated / summary.energy.plastic - 1.0).abs() < 1e-12, "{brace:?}");
    let given = rows.column("energy.plastic").unwrap();
    assert!(given.windows(2).all(|w| w[1] >= w[0]), "flow gives nothing back");
    let first = brace.first_yield.unwrap();
    let before = plastic.iter().position(|p| *p != 0.0).unwrap();
    assert_eq!(first, rows.column("time").unwrap()[before]);
}

#[test]
fn a_spring_that_does_not_reach_its_limit_is_elastic() {
    let settings = Settings::new(0.02, 1e-4);
    let (yields, _) = run(&swung(Some(perfect(1e9))), &settings);
    let (elastic, _) = run(&swung(None), &settings);
    let most = |s: &RunSummary| s.points[0].displacement_max[1].value;
    assert!((most(&yields) / most(&elastic) - 1.0).abs() < 1e-12);
    assert_eq!(yields.yielding[0].first_yield, None);
    assert_eq!((yields.energy.plastic, yields.yielding[0].plastic), (0.0, 0.0));
    assert!(elastic.yielding.is_empty());
}

#[test]
fn a_spring_that_fails_takes_its_energy_with_it() {
    let law = Plasticity { failure_strain: Some(0.006), ..hardening() };
    let (summary, rows) = run(&swung(Some(law)), &Settings::new(0.05, 1e-4));
    assert_balances(&summary, "fails");
    let brace = &summary.yielding[0];
    let failed = brace.failed.unwrap();
    let (time, force) = (rows.column("time").unwrap(), rows.column("spring.brace.force").unwrap());
    let at = time.iter().position(|t| *t == failed).unwrap();
    assert!(force[at - 1].abs() > LIMIT && force[at..].iter().all(|f| *f == 0.0), "{force:?}");
    // What it held when it let go: as far as the row before tells.
    let lost = summary.energy.failure;
    let extension = rows.column("spring.brace.extension").unwrap()[at];
    assert!(extension.abs() >= 0.006 && brace.extension_max.value == extension, "{brace:?}");
    let (flow, sum) = (brace.plastic, brace.accumulated);
    let held = 0.5 * STIFFNESS * (extension - flow).powi(2)
        + 0.5 * ISOTROPIC * sum * sum
        + 0.5 * KINEMATIC * flow * flow;
    assert!((lost / held - 1.0).abs() < 1e-9, "{lost} {held}");
    assert_eq!((summary.energy.hardening, brace.hardening), (0.0, 0.0));
}

/// The bar under a force at its end.
fn pressed(force: f64) -> Model {
    braced(Some(hardening()), |b, bar| {
        let kind = LoadKind::Point {
            at: at("end", bar, 1.0),
            force: [0.0, force],
            moment: 0.0,
            follower: false,
        };
        b.load(Load::new("weight", kind));
    })
}

#[test]
fn at_rest_a_spring_has_flowed_as_its_force_asks() {
    let found = equilibrium(&pressed(-1.2 * LIMIT)).unwrap();
    let brace = &found.yielding[0];
    // The bar pushes back by what it turns: 0.5 % of the force would already be more.
    assert!((brace.force / (-1.2 * LIMIT) - 1.0).abs() < 5e-3, "{brace:?}");
    let flow = -(brace.force.abs() - LIMIT) / (ISOTROPIC + KINEMATIC);
    assert!((brace.plastic / flow - 1.0).abs() < 1e-9, "{brace:?}");
    let extension = brace.plastic + brace.force / STIFFNESS;
    assert!((brace.extension / extension - 1.0).abs() < 1e-9, "{brace:?}");
    assert!(brace.yielded && !brace.failed && found.stable);
    let elastic = equilibrium(&pressed(-0.9 * LIMIT)).unwrap();
    assert!(!elastic.yielding[0].yielded && elastic.yielding[0].plastic == 0.0);
}

#[test]
fn a_start_in_equilibrium_beyond_yield_is_at_rest() {
    let model = pressed(-1.2 * LIMIT);
    let settings = Settings { start: Start::Static, ..Settings::new(0.01, 1e-4) };
    let (summary, rows) = run(&model, &settings);
    assert_balances(&summary, "start");
    let found = equilibrium(&model).unwrap();
    let brace = &summary.yielding[0];
    assert!((brace.plastic / found.yielding[0].plastic - 1.0).abs() < 1e-9, "{brace:?}");
    let moved = rows.column("energy.kinetic").unwrap().into_iter().fold(0.0, f64::max);
    assert!(moved < 1e-12 * summary.energy.scale, "{moved:e} {:?}", summary.energy);
}

#[test]
fn small_motions_about_what_has_yielded_are_elastic() {
    let lowest = |model: &Model, found: &Equilibrium| {
        modes_about_equilibrium(model, found, 1)[0].frequency()
    };
    let model = pressed(-1.2 * LIMIT);
    let found = equilibrium(&model).unwrap();
    // sqrt(k / m) with what a third of the bar weighs, which is stiff: as before it yielded, not with the tangent, a third of that.
    let bar = 7850.0 * std::f64::consts::FRAC_PI_4 * 0.03 * 0.03;
    let expected = (STIFFNESS / (20.0 + bar / 3.0)).sqrt() / std::f64::consts::TAU;
    let frequency = lowest(&model, &found);
    assert!((frequency / expected - 1.0).abs() < 0.05, "{frequency} {expected}");
}

#[test]
fn a_run_that_goes_on_from_a_checkpoint_remembers_what_has_yielded() {
    let model = swung(Some(hardening()));
    let settings = Settings::new(0.04, 1e-4);
    let (whole, _) = run(&model, &settings);
    let mut part = Simulation::new(&model, &settings).unwrap();
    for _ in 0..150 {
        part.advance(&mut NoRecorder).unwrap();
    }
    let resumed = Simulation::resume(&model, &settings, part.checkpoint()).unwrap();
    let end = { resumed }.run(&mut NoRecorder);
    assert!(whole.yielding[0].first_yield.unwrap() < 0.015, "it has yielded before");
    assert_eq!(end.yielding, whole.yielding);
    assert_eq!(end.energy, whole.energy);
}

/// A stub that stands still and a bar on a hinge at its end, which turns at first.
fn hinged(law: Plasticity, spin: f64) -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("stiff", 2e11, 1000.0));
    let section = b.section(Section::new("s", 1e-2, 1e-4));
    let stub = b.beam(beam("stub", [-0.1, 0.0], [0.0, 0.0], 1, material, section));
    let bar = b.beam(beam("bar", [0.0, 0.0], [1.0, 0.0], 3, material, section));
    for f in [0.0, 1.0] {
        b.support(Support::new(format!("s{f}"), at("stub", stub, f), SupportKind::Clamp));
    }
    let kind = JointKind::ElasticHinge { stiffness: 1e5, damping: 0.0 };
    let between = [at("stub.end", stub, 1.0), at("bar.start", bar, 0.0)];
    b.joint(Joint { yielding: Some(law), ..Joint::new("hinge", kind, between) });
    let motion = InitialMotion { velocity: [0.0; 2], spin, about: [0.0; 2] };
    b.initial_motion_of("bar", motion);
    b.build().unwrap()
}

#[test]
fn a_hinge_turns_by_the_energy_it_is_given_over_its_moment() {
    // A stiff bar: K = M^2 / 2k + M theta. Either way round, and by more than a turn.
    let (moment, stiffness) = (500.0, 1e5);
    let inertia = 1000.0 * (1e-2 / 3.0 + 1e-4);
    for spin in [-20.0, 20.0, 50.0] {
        let model = hinged(perfect(moment), spin);
        let (summary, _) = run(&model, &Settings::new(1.0, 1e-3));
        assert_balances(&summary, "hinge");
        let kinetic = 0.5 * inertia * spin * spin;
        let turned = kinetic / moment - 0.5 * moment / stiffness;
        let hinge = &summary.yielding[0];
        assert!(hinge.turns && hinge.name == "joint.hinge");
        let found = hinge.plastic.abs();
        assert!((found / turned - 1.0).abs() < 5e-3, "{spin}: {found} {turned}");
        // Positive where the tangent turns counter-clockwise from the stub into the bar.
        assert!(hinge.plastic * spin > 0.0, "{hinge:?}");
    }
}

#[test]
fn analyses_without_yielding_connectors_say_so() {
    let model = swung(Some(hardening()));
    let settings = Settings { scheme: Scheme::StrainRate, ..Settings::new(0.01, 1e-4) };
    let faults = Simulation::new(&model, &settings).err().unwrap();
    assert!(faults[0].expected.contains("the work of plastic flow is exact only in it"));
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("m", 2e11, 1e3));
    let section = b.section(Section::new("s", 1e-2, 1e-4));
    let bar = b.beam(beam("bar", [0.0, 0.0], [1.0, 0.0], 2, material, section));
    let spring = |name: &str, stiffness: f64, law: Plasticity| Spring {
        name: name.into(),
        between: [Anchor::Point(at("end", bar, 1.0)), Anchor::Ground([2.0, 1.0])],
        stiffness,
        damping: 1.0,
        length: None,
        yielding: Some(law),
    };
    b.spring(spring("loose", 0.0, perfect(1.0)));
    b.spring(spring("weak", 10.0, Plasticity { failure_strain: Some(0.05), ..perfect(1.0) }));
    b.spring(spring("soft", 10.0, Plasticity { kinematic: -1.0, ..perfect(1.0) }));
    let mut softens = perfect(1.0);
    softens.curve[0].modulus = -2.0;
    b.spring(spring("softens", 10.0, softens));
    b.spring(spring("backwards", 10.0, perfect(-1.0)));
    b.spring(Spring { length: Some(1.0), ..spring("tight", 10.0, perfect(1.0)) });
    let faults = b.build().err().unwrap();
    let paths: Vec<&str> = faults.iter().map(|fault| fault.path.as_str()).collect();
    let expected = [
        "spring.loose.stiffness",
        "spring.weak.failure_extension",
        "spring.soft.hardening.kinematic",
        "spring.softens.hardening",
        "spring.backwards.yield_force",
        "spring.tight.length",
    ];
    assert_eq!(paths, expected, "{faults:?}");
}

/// Two beams that meet in an elastic hinge, in whatever order the joint names them and whichever way they run: its moment is the bending
/// moment of the first beam that ends there, and its rotation goes along with it.
#[test]
fn rotation_and_moment_of_a_hinge_count_as_the_section_moment_beside_it() {
    let law = perfect(1e6);
    for (turned, swapped) in [(false, false), (false, true), (true, false), (true, true)] {
        let mut b = ModelBuilder::new();
        let material = b.material(Material::new("m", 2e11, 7850.0));
        let section = b.section(Section::rectangle("s", 0.05, 0.05));
        let left = b.beam(beam("left", [0.0, 0.0], [1.0, 0.0], 4, material, section));
        let ends = if turned { [[2.0, 0.0], [1.0, 0.0]] } else { [[1.0, 0.0], [2.0, 0.0]] };
        let right = b.beam(beam("right", ends[0], ends[1], 4, material, section));
        let (meets, held) = if turned { (1.0, 0.0) } else { (0.0, 1.0) };
        b.support(Support::new("a", at("a", left, 0.0), SupportKind::Clamp));
        b.support(Support::new("z", at("z", right, held), SupportKind::Clamp));
        let mut between = [at("left.end", left, 1.0), at("right", right, meets)];
        if swapped {
            between.reverse();
        }
        let kind = JointKind::ElasticHinge { stiffness: 2e4, damping: 0.0 };
        b.joint(Joint { yielding: Some(law.clone()), ..Joint::new("hinge", kind, between) });
        let force = [0.0, -2e3];
        let place = at("load", left, 0.7);
        b.load(Load::new("p", LoadKind::Point { at: place, force, moment: 0.0, follower: false }));
        b.record_point(at("left.end", left, 1.0));
        b.record_point(at("right", right, meets));
        let model = b.build().unwrap();
        let found = equilibrium(&model).unwrap();
        let hinge = &found.yielding[0];
        // The right beam has four elements, the last ones.
        let split = found.element_forces.len() - 4;
        let beside = match (swapped, turned) {
            (false, _) => found.element_forces[split - 1][1][2],
            (true, false) => found.element_forces[split][0][2],
            (true, true) => found.element_forces[split + 3][1][2],
        };
        assert!(beside.abs() > 10.0, "{beside}");
        assert!(
            (hinge.force / beside - 1.0).abs() < 1e-6,
            "{turned} {swapped}: {hinge:?} {beside}"
        );
        assert!((hinge.extension / (hinge.force / 2e4) - 1.0).abs() < 1e-9, "{hinge:?}");
        // A run says the same.
        let settings = Settings { start: Start::Static, ..Settings::new(1e-4, 1e-5) };
        let (summary, rows) = run(&model, &settings);
        let own = summary.yielding[0].extension_max.value;
        assert!((own / hinge.extension - 1.0).abs() < 1e-6, "{own} {hinge:?}");
        let column = rows.column("joint.hinge.moment").unwrap();
        assert!((column[0] / hinge.force - 1.0).abs() < 1e-6, "{} {hinge:?}", column[0]);
    }
}
