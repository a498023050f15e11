//! Invariants of structures: angles of rigid corners, energy and momentum balances of a structure with all features.

use percuss::*;

use crate::check::{Checks, Report};
use crate::structure::at;

/// A node and its reference tangent.
type Tangent = (usize, [f64; 2]);

/// Angle between the tangents at two nodes [rad].
fn angle(state: &State, a: Tangent, b: Tangent) -> f64 {
    let g = |(node, t): Tangent| {
        let u = state.displacement[node];
        [t[0] + u[2], t[1] + u[3]]
    };
    let (a, b) = (g(a), g(b));
    (a[0] * b[1] - a[1] * b[0]).atan2(a[0] * b[0] + a[1] * b[1])
}

/// A free frame of a bent beam and a branch, struck: angles and positions at its joints, and its balances.
pub fn corners() -> Report {
    let mut c = Checks::new();
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("m", 2e9, 3e3));
    let section = b.section(Section::new("s", 0.1, 8.33e-5));
    let thin = b.section(Section::new("thin", 0.05, 1e-5));
    let points = [[0.0, 0.0], [2.0, 0.0], [2.5, 1.5]];
    let change = Change { at: Along::Distance(1.0), material: None, section: Some(thin) };
    let bent = Beam { changes: vec![change], ..Beam::new("bent", &points, 12, material, section) };
    let bent = b.beam(bent);
    let branch = b.beam(Beam::new("branch", &[[1.0, 0.0], [1.3, -1.0]], 4, material, section));
    let between = [
        PointRef { label: "bent@1m".into(), beam: bent, along: Along::Distance(1.0) },
        at("branch.start", branch, 0.0),
    ];
    b.joint(Joint::new("branch", JointKind::Rigid, between));
    b.initial_motion(InitialMotion { velocity: [1.0, 2.0], spin: 4.0, about: [1.0, 0.0] });
    b.projectile(Projectile {
        name: "mass".into(),
        kind: ProjectileKind::spring(7.5e5),
        mass: 200.0,
        velocity: [0.0, 20.0],
        direction: None,
        strikes: at("bent.start", bent, 0.0),
        standoff: 0.05,
        rear: None,
        local_mass: 0.0,
    });
    let model = b.build().expect("a verification case builds");
    let mut run = Simulation::new(&model, &Settings::new(0.4, 2e-4)).expect("valid settings");
    // Spans of 1 m, 1 m and 1.58 m share 12 elements as 3, 4 and 5 (largest remainders), found here by their positions.
    let nodes = model.beam_nodes("bent").unwrap_or_default();
    let twins: Vec<usize> = (0..nodes.len() - 1).filter(|i| nodes[*i] == nodes[i + 1]).collect();
    let direction = |a: [f64; 2], b: [f64; 2]| {
        let d = [b[0] - a[0], b[1] - a[1]];
        let l = d[0].hypot(d[1]);
        [d[0] / l, d[1] / l]
    };
    let along = |i: usize| {
        let j = if twins.contains(&i) || i + 1 == nodes.len() { (i - 1, i) } else { (i, i + 1) };
        direction(nodes[j.0], nodes[j.1])
    };
    let first = nodes.len();
    let mut pairs: Vec<(Tangent, Tangent)> =
        twins.iter().map(|i| ((*i, along(*i)), (i + 1, along(i + 1)))).collect();
    let arm = direction([1.0, 0.0], [1.3, -1.0]);
    pairs.extend(twins.first().map(|i| ((*i, along(*i)), (first, arm))));
    c.absolute("joints found", pairs.len() as f64, 3.0, 0.0);
    let start: Vec<f64> = pairs.iter().map(|(a, b)| angle(run.state(), *a, *b)).collect();
    let (mut turned, mut apart, mut energy) = (0.0_f64, 0.0_f64, 0.0_f64);
    let mut momentum = 0.0_f64;
    while run.state().step < run.step_count() {
        if run.advance(&mut NoRecorder).is_err() {
            turned = f64::NAN;
            break;
        }
        let state = run.state();
        for ((a, b), start) in pairs.iter().zip(&start) {
            turned = turned.max((angle(state, *a, *b) - start).abs());
            let (u, v) = (state.displacement[a.0], state.displacement[b.0]);
            apart = apart.max((u[0] - v[0]).hypot(u[1] - v[1]));
        }
        let (ledger, m) = (&state.ledger, run.measures());
        energy = energy.max((ledger.energy_residual(m) / ledger.energy_scale).abs());
        let linear = ledger.linear_residual(m);
        momentum = momentum.max(linear[0].hypot(linear[1]) / ledger.linear_scale);
        momentum = momentum.max((ledger.angular_residual(m) / ledger.angular_scale).abs());
    }
    c.at_most("change of angles [rad]", turned, 1e-12);
    c.at_most("distance of joined places [m]", apart, 1e-12);
    c.at_most("energy residual", energy, 1e-11);
    c.at_most("residual of both momenta", momentum, 1e-11);
    c.into_report()
}

/// A structure with all kinds of geometry, section, support, joint, load, damping and projectile.
fn everything_model() -> Model {
    let mut b = ModelBuilder::new();
    let steel = b.material(Material {
        retardation: 2e-6,
        mass_damping: 0.4,
        ..Material::new("steel", 2.1e9, 7850.0)
    });
    let strain = StrainMeasure::Engineering;
    let other =
        b.material(Material { strain, retardation: 1e-6, ..Material::new("other", 7e8, 2700.0) });
    let deep = b.section(Section::rectangle("deep", 0.05, 0.08));
    let tube = b.section(Section::tube("tube", 0.06, 0.004));
    let taper = |at: f64, depth: f64| Station {
        at,
        area: 0.05 * depth,
        inertia: 0.05 * depth.powi(3) / 12.0,
        depth: Some(depth),
        profile: Profile::Unknown,
        properties: Default::default(),
    };
    let tapered = b.section(Section {
        stations: vec![taper(0.0, 0.09), taper(0.6, 0.05), taper(1.0, 0.06)],
        ..Section::rectangle("tapered", 0.05, 0.09)
    });
    // A bent column and girder with a change of section and graded elements, an arch, a curved arm, a slender tie.
    let frame = b.beam(Beam {
        mesh: Mesh {
            grading: Some(Grading { towards: Along::Fraction(0.7), ratio: 2.5 }),
            ..Mesh::even(16)
        },
        changes: vec![Change {
            at: Along::Distance(2.5),
            material: Some(other),
            section: Some(tube),
        }],
        ..Beam::new("frame", &[[0.0, 0.0], [0.0, 2.0], [2.0, 2.0]], 16, steel, deep)
    });
    let arch = b.beam(Beam {
        curve: Curve::Arc,
        mesh: Mesh { size: ElementSize::Length(0.25), ..Mesh::even(1) },
        ..Beam::new("arch", &[[2.0, 2.0], [3.0, 2.4], [4.0, 2.0]], 1, steel, tapered)
    });
    let arm = b.beam(Beam {
        curve: Curve::Spline,
        ..Beam::new("arm", &[[2.0, 2.0], [2.2, 1.2], [1.9, 0.6], [2.1, 0.1]], 8, other, deep)
    });
    let tie = b.beam(Beam::new("tie", &[[4.0, 2.0], [4.0, 0.0]], 3, steel, deep));
    joints(&mut b, [frame, arch, arm, tie]);
    supports(&mut b, [frame, arch, arm, tie]);
    springs_and_masses(&mut b, [frame, arch, arm]);
    loads(&mut b, frame, arch, arm, tie);
    b.modal_damping(vec![0.01, 0.02, 0.005]);
    b.initial_motion(InitialMotion { velocity: [0.0, 0.05], spin: 0.02, about: [2.0, 1.0] });
    strikers(&mut b, [frame, arch, tie]);
    b.build().expect("a verification case builds")
}

/// A rigid joint, an elastic hinge and a hinge.
fn joints(b: &mut ModelBuilder, [frame, arch, arm, tie]: [BeamId; 4]) {
    let joint = |name: &str, kind, a: PointRef, b: PointRef| Joint::new(name, kind, [a, b]);
    b.joint(joint(
        "knee",
        JointKind::Rigid,
        at("frame.end", frame, 1.0),
        at("arch.start", arch, 0.0),
    ));
    let hinge = JointKind::ElasticHinge { stiffness: 3e3, damping: 4.0 };
    b.joint(joint("hinge", hinge, at("frame.end", frame, 1.0), at("arm.start", arm, 0.0)));
    b.joint(joint("pin", JointKind::Hinge, at("arch.end", arch, 1.0), at("tie.start", tie, 0.0)));
}

/// A foot with prescribed displacement and rotation, one on springs, one that releases, an inclined roller between nodes, a stop.
fn supports(b: &mut ModelBuilder, [frame, arch, arm, tie]: [BeamId; 4]) {
    let mut foot = Support::new("foot", at("frame.start", frame, 0.0), SupportKind::Clamp);
    foot.motion = Some(Motion {
        displacement: [0.01, -0.004],
        rotation: 0.02,
        function: TimeFunction::Harmonic { frequency: 7.0, phase: 0.0 },
    });
    b.support(foot);
    let springs = SupportKind::Elastic {
        direction: [1.0, 0.3],
        stiffness: [4e5, 3e5],
        damping: [200.0, 100.0],
        rotational_stiffness: 5e3,
        rotational_damping: 3.0,
    };
    let mut ground = Support::new("ground", at("tie.end", tie, 1.0), springs);
    ground.motion = Some(Motion {
        displacement: [0.0, 0.005],
        rotation: 0.0,
        function: TimeFunction::Ramp { duration: 0.05 },
    });
    b.support(ground);
    let mut prop = Support::new("prop", at("arm.end", arm, 1.0), SupportKind::Pin);
    prop.until = 0.0437;
    b.support(prop);
    let roller = SupportKind::Roller { direction: [1.0, 1.0] };
    b.support(Support {
        until: 0.12,
        ..Support::new("guide", at("arch@0.37", arch, 0.37), roller)
    });
    let stop =
        SupportKind::Stop { direction: [0.0, -1.0], gap: 2e-3, stiffness: 5e5, two_sided: true };
    b.support(Support::new("stop", at("frame@0.8", frame, 0.8), stop));
}

/// Springs between points and to the ground, masses with and without rotary inertia.
fn springs_and_masses(b: &mut ModelBuilder, [frame, arch, arm]: [BeamId; 3]) {
    let (a, z) = (at("frame@0.3", frame, 0.3), at("arm@0.7", arm, 0.7));
    b.spring(Spring {
        name: "brace".into(),
        between: [Anchor::Point(a), Anchor::Point(z)],
        law: SpringLaw::Linear { stiffness: 2e5 },
        damping: 80.0,
        length: None,
        strength: None,
        yielding: None,
    });
    b.spring(Spring {
        name: "stay".into(),
        between: [Anchor::Point(at("arch@0.5", arch, 0.5)), Anchor::Ground([3.0, 4.0])],
        law: SpringLaw::Linear { stiffness: 1e5 },
        damping: 20.0,
        length: Some(1.5),
        strength: None,
        yielding: None,
    });
    let mass = |name: &str, at, mass, rotary_inertia| PointMass {
        name: name.into(),
        at,
        mass,
        rotary_inertia,
    };
    b.point_mass(mass("head", at("arm.end", arm, 1.0), 12.0, 0.3));
    b.point_mass(mass("lamp", at("arch@0.61", arch, 0.61), 5.0, 0.0));
}

/// A guided projectile of each kind.
fn strikers(b: &mut ModelBuilder, [frame, arch, tie]: [BeamId; 3]) {
    for (name, kind, strikes, velocity) in [
        ("buffer", ProjectileKind::spring(4e5), at("frame@0.5", frame, 0.5), [6.0, -3.0]),
        (
            "hammer",
            ProjectileKind::Rigid { restitution: 0.6 },
            at("arch@0.4", arch, 0.4),
            [1.0, -5.0],
        ),
        ("clay", ProjectileKind::Rigid { restitution: 0.0 }, at("tie@0.5", tie, 0.5), [-3.0, 0.0]),
    ] {
        b.projectile(Projectile {
            name: name.into(),
            kind,
            mass: 15.0,
            velocity,
            direction: None,
            strikes,
            standoff: 0.03,
            rear: None,
            local_mass: 0.0,
        });
    }
}

fn loads(b: &mut ModelBuilder, frame: BeamId, arch: BeamId, arm: BeamId, tie: BeamId) {
    let gravity = LoadKind::Gravity { acceleration: [0.0, -9.81] };
    b.load(Load::new("gravity", gravity));
    let point = |at, force, moment, follower| LoadKind::Point { at, force, moment, follower };
    let force = point(at("frame@0.9", frame, 0.9), [200.0, -900.0], 150.0, false);
    let function = TimeFunction::Harmonic { frequency: 11.0, phase: 0.3 };
    b.load(Load { function, ..Load::new("shaker", force) });
    let follower = point(at("arm@0.95", arm, 0.95), [100.0, 400.0], 0.0, true);
    let function = TimeFunction::Triangle { duration: 0.06 };
    b.load(Load { function, from: 0.011, ..Load::new("jet", follower) });
    let spread = |beam, stretch: [f64; 2], force, follower| LoadKind::Distributed {
        beam,
        stretch: stretch.map(Along::Fraction),
        force,
        follower,
    };
    let snow = spread(frame, [0.45, 0.93], [[0.0, -800.0], [100.0, -300.0]], false);
    let table = TimeFunction::Table {
        times: vec![0.0, 0.03, 0.08, 0.15],
        values: vec![1.0, 0.4, 1.5, 0.2],
        smooth: true,
    };
    b.load(Load { function: table, ..Load::new("snow", snow) });
    let wind = spread(arch, [0.1, 1.0], [[0.0, 500.0], [50.0, 900.0]], true);
    let function = TimeFunction::HalfSine { duration: 0.04 };
    b.load(Load { function, from: 0.02, until: 0.05, ..Load::new("wind", wind) });
    let gust = spread(tie, [0.0, 1.0], [[0.0, 300.0], [0.0, 300.0]], true);
    b.load(Load { function: TimeFunction::Step { at: 0.033 }, ..Load::new("gust", gust) });
}

/// All features together, started from static equilibrium, with every scheme of the midpoint family.
pub fn everything() -> Report {
    let mut c = Checks::new();
    let model = everything_model();
    for (name, scheme, limit) in [
        ("energy-momentum", Scheme::EnergyMomentum, 1e-10),
        ("strain-rate", Scheme::StrainRate, 1e-10),
    ] {
        let settings = Settings { scheme, start: Start::Static, ..Settings::new(0.15, 1e-4) };
        let mut run = match Simulation::new(&model, &settings) {
            Ok(run) => run,
            Err(faults) => panic!("valid settings: {faults:?}"),
        };
        let (mut energy, mut momentum, mut shrinks, mut loss) = (0.0_f64, 0.0_f64, 0.0_f64, 0.0);
        let mut reached = true;
        while run.state().step < run.step_count() {
            if run.advance(&mut NoRecorder).is_err() {
                reached = false;
                break;
            }
            let (ledger, m) = (&run.state().ledger, run.measures());
            energy = energy.max((ledger.energy_residual(m) / ledger.energy_scale).abs());
            let linear = ledger.linear_residual(m);
            momentum = momentum.max(linear[0].hypot(linear[1]) / ledger.linear_scale);
            momentum = momentum.max((ledger.angular_residual(m) / ledger.angular_scale).abs());
            shrinks = shrinks.max(loss - ledger.loss_damping);
            loss = ledger.loss_damping;
        }
        let ledger = &run.state().ledger;
        c.at_least(format!("{name}: reaches its end"), reached.into(), 1.0);
        c.at_most(format!("{name}: energy residual"), energy, limit);
        c.at_most(format!("{name}: residual of both momenta"), momentum, 1e-10);
        c.at_most(format!("{name}: energy given back by damping [J]"), shrinks, 0.0);
        c.at_least(format!("{name}: energy taken by damping [J]"), loss, 1.0);
        c.at_least(format!("{name}: energy lost in impacts [J]"), ledger.loss_impacts, 1.0);
        // Every column contributes: the driven support alone does 0.91 J of work.
        c.at_least(format!("{name}: work of supports [J]"), ledger.work_supports.abs(), 0.5);
        c.at_least(format!("{name}: work of loads [J]"), ledger.work_loads.abs(), 1.0);
    }
    c.into_report()
}
