//! Shear-flexible beams: statics, frequencies, buckling, balances, and the impact on one.

use std::f64::consts::PI;

use percuss::*;

use crate::check::{Checks, Report};
use crate::structure::{at, or_nan};

/// A straight shear-flexible beam along e1.
#[derive(Clone, Copy, Debug)]
struct Stub {
    length: f64,
    elements: usize,
    young: f64,
    density: f64,
    poisson: f64,
    /// Shear factor.
    kappa: f64,
    area: f64,
    inertia: f64,
}

impl Stub {
    /// Of length, EI and mass one, with the given axial and shear stiffness.
    fn unit(axial: f64, shear: f64, elements: usize) -> Self {
        // E = 1: area EA, second moment 1; the shear factor is GA over G A.
        let kappa = shear / (0.5 * axial);
        let (young, density, poisson) = (1.0, 1.0 / axial, 0.0);
        Self { length: 1.0, elements, young, density, poisson, kappa, area: axial, inertia: 1.0 }
    }

    /// A rectangle of the given width and depth, nu 0.3.
    fn rectangle(
        length: f64,
        [width, depth]: [f64; 2],
        young: f64,
        density: f64,
        kappa: f64,
    ) -> Self {
        let (area, inertia) = (width * depth, width * depth.powi(3) / 12.0);
        Self { length, elements: 1, young, density, poisson: 0.3, kappa, area, inertia }
    }

    fn with(self, elements: usize) -> Self {
        Self { elements, ..self }
    }

    /// A model of it, with supports at its ends.
    fn begun(&self, ends: [Option<SupportKind>; 2]) -> (ModelBuilder, BeamId) {
        let mut b = ModelBuilder::new();
        let material = b.material(Material {
            poisson: Some(self.poisson),
            ..Material::new("m", self.young, self.density)
        });
        let section = b.section(Section {
            shear_factor: Some(self.kappa),
            ..Section::new("s", self.area, self.inertia)
        });
        let points = [[0.0, 0.0], [self.length, 0.0]];
        let slender = Beam::new("stub", &points, self.elements, material, section);
        let stub = b.beam(Beam { theory: Theory::Shear, ..slender });
        for (k, kind) in ends.into_iter().enumerate() {
            let label = ["start", "end"][k];
            if let Some(kind) = kind {
                b.support(Support::new(label, at(label, stub, k as f64), kind));
            }
        }
        (b, stub)
    }

    /// A cantilever with a dead force at its tip.
    fn loaded(&self, force: [f64; 2]) -> Model {
        let (mut b, stub) = self.begun([Some(SupportKind::Clamp), None]);
        let tip = at("tip", stub, 1.0);
        let kind = LoadKind::Point { at: tip.clone(), force, moment: 0.0, follower: false };
        b.load(Load::new("tip", kind));
        b.record_point(tip);
        b.build().expect("a verification case builds")
    }

    /// Displacement of the tip of a cantilever; NaN without equilibrium.
    fn tip(&self, force: f64) -> [f64; 2] {
        let model = self.loaded([0.0, force]);
        equilibrium(&model).map_or([f64::NAN; 2], |found| found.points[0].1)
    }
}

/// The limit of values of an order on a mesh and one twice as fine.
fn limit(order: i32, coarse: f64, fine: f64) -> f64 {
    let more = f64::powi(2.0, order);
    (more * fine - coarse) / (more - 1.0)
}

/// Cantilevers: small deflections of one element, large ones of a mesh and one twice as fine.
pub fn cantilevers() -> Report {
    let mut c = Checks::new();
    for depth in [0.5, 0.1, 0.01, 1e-3] {
        let kappa = 13.0 / 15.3;
        let stub = Stub::rectangle(1.0, [1.0, depth], 1e9, 1e3, kappa);
        let (bending, shear) = (1e9 * stub.inertia, kappa * 1e9 / 2.6 * depth);
        let force = 1e-4 * bending;
        let exact = force * (1.0 / (3.0 * bending) + 1.0 / shear);
        for elements in [1, 5] {
            let [_, y] = stub.with(elements).tip(force);
            c.relative(format!("h = L {depth}, {elements} elements, tip [m]"), y, exact, 1e-7);
        }
    }
    let deep = Stub::rectangle(2.0, [0.1, 0.5], 2.07e11, 7850.0, 0.849673);
    let cases = [
        (2, "Nachbagauer", deep, -6.25e7, [-0.1509711442, -0.7105685979]),
        (4, "GA 1e6", Stub::unit(1e6, 1e6, 1), -3.0, [-0.2544201846, -0.6032564411]),
        (2, "GA 20", Stub::unit(1e6, 20.0, 1), -3.0, [-0.2908487575, -0.6694754589]),
        (2, "GA 5", Stub::unit(1e6, 5.0, 1), -3.0, [-0.3954720920, -0.9234801478]),
    ];
    // Large displacements are of fourth order without shear, else of second.
    for (expected, name, stub, force, exact) in cases {
        let [coarse, fine] = [16, 32].map(|elements| stub.with(elements).tip(force));
        for i in 0..2 {
            let found = limit(expected, coarse[i], fine[i]);
            c.absolute(format!("{name}, tip, component {} [m]", i + 1), found, exact[i], 3e-6);
        }
        let order = ((coarse[1] - exact[1]) / (fine[1] - exact[1])).log2();
        let expected = f64::from(expected);
        c.absolute(format!("{name}, order in the element size"), order, expected, 0.1);
    }
    c.into_report()
}

/// Natural frequencies of Timoshenko's theory.
pub fn frequencies() -> Report {
    let mut c = Checks::new();
    let (pin, clamp) = (SupportKind::Pin, SupportKind::Clamp);
    let fv5 = Stub::rectangle(10.0, [2.0, 2.0], 2e11, 8000.0, 13.0 / 15.3);
    let other = Stub::rectangle(1.0, [0.1, 0.1], 2.1e11, 7800.0, 5.0 / 6.0);
    // Axial modes lie in between, at 250 Hz of the first and at 1297 Hz of the second. Each mode on a mesh that resolves it, and one twice as fine.
    for (name, stub, ends, modes) in [
        (
            "NAFEMS FV5",
            fv5,
            [Some(pin.clone()), Some(pin)],
            vec![(0, 16, 42.64490922), (1, 16, 148.14933502), (3, 32, 283.46838913)],
        ),
        (
            "cantilever",
            other,
            [Some(clamp.clone()), None],
            vec![(0, 8, 83.15962533), (1, 8, 498.40434217), (3, 16, 1310.87951750)],
        ),
        (
            "clamped",
            other,
            [Some(clamp.clone()), Some(clamp)],
            vec![(0, 8, 499.96188399), (1, 8, 1281.28042103)],
        ),
    ] {
        let found = |elements: usize| {
            let (b, _) = stub.with(elements).begun(ends.clone());
            natural_frequencies(&b.build().expect("a verification case builds"), 4)
        };
        for (k, elements, exact) in modes {
            let both = [elements, 2 * elements].map(|n| or_nan(found(n).get(k).copied()));
            c.relative(
                format!("{name}, mode {} [Hz]", k + 1),
                limit(4, both[0], both[1]),
                exact,
                5e-7,
            );
            let order = ((both[0] - exact) / (both[1] - exact)).log2();
            c.absolute(format!("{name}, mode {}, order", k + 1), order, 4.0, 0.05);
        }
    }
    c.into_report()
}

/// Columns: `P (1 + P / GA) = pi^2 EI / 4 L^2`.
pub fn columns() -> Report {
    let mut c = Checks::new();
    for shear in [1e6, 20.0, 5.0] {
        let critical = 0.5 * shear * ((1.0 + PI * PI / shear).sqrt() - 1.0);
        let found = |elements: usize| {
            let model = Stub::unit(1e9, shear, elements).loaded([-1.0, 0.0]);
            or_nan(buckling(&model, 1).modes.first().map(|mode| mode.factor))
        };
        let both = [found(16), found(32)];
        let what = format!("GA {shear}, buckling load");
        c.relative(what, limit(2, both[0], both[1]), critical, 1e-5);
    }
    c.into_report()
}

/// A free beam that turns by half a radian a step: balances, and lengths of vectors.
pub fn tumbling() -> Report {
    let mut c = Checks::new();
    let stub = Stub {
        area: 1.0,
        inertia: 0.01,
        young: 400.0,
        density: 1.0,
        poisson: 0.2,
        kappa: 0.9,
        ..Stub::unit(1.0, 1.0, 6)
    };
    let (mut b, _) = stub.begun([None, None]);
    b.initial_motion(InitialMotion { velocity: [1.0, 0.5], spin: 10.0, about: [0.3, 0.1] });
    let model = b.build().expect("a verification case builds");
    let mut run = Simulation::new(&model, &Settings::new(500.0, 0.05)).expect("valid settings");
    let (mut energy, mut momentum, mut length) = (0.0_f64, 0.0_f64, 0.0_f64);
    while run.state().step < run.step_count() {
        if run.advance(&mut NoRecorder).is_err() {
            energy = f64::NAN;
            break;
        }
        let (ledger, m) = (&run.state().ledger, run.measures());
        energy = energy.max((ledger.energy_residual(m) / ledger.energy_scale).abs());
        let linear = ledger.linear_residual(m);
        momentum = momentum.max(linear[0].hypot(linear[1]) / ledger.linear_scale);
        momentum = momentum.max((ledger.angular_residual(m) / ledger.angular_scale).abs());
        for u in &run.state().displacement {
            length = length.max(((1.0 + u[2]).hypot(u[3]) - 1.0).abs());
        }
    }
    c.at_most("energy residual in 10 000 steps", energy, 1e-10);
    c.at_most("residual of both momenta", momentum, 1e-10);
    c.at_most("change of length of a vector", length, 1e-12);
    c.into_report()
}

/// A rigid mass on the section of the paper's second example, with shear: velocity and momentum transferred after the impact.
pub fn impact() -> Report {
    let mut c = Checks::new();
    let stub = Stub {
        length: 3.0,
        elements: 400,
        young: 2e11,
        density: 3e3,
        poisson: 0.3,
        kappa: 5.0 / 6.0,
        area: 0.1,
        inertia: 8.33e-5,
    };
    let step = 1e-7;
    let clamp = Some(SupportKind::Clamp);
    let (mut b, id) = stub.begun([clamp.clone(), clamp]);
    b.projectile(Projectile {
        name: "mass".into(),
        kind: ProjectileKind::Rigid { restitution: 0.0 },
        mass: 100.0,
        velocity: [0.0, -40.0],
        direction: None,
        strikes: at("struck", id, 0.5),
        // It touches after one step and a half.
        standoff: 60.0 * step,
        rear: None,
        local_mass: 0.0,
    });
    let model = b.build().expect("a verification case builds");
    let mut run = Simulation::new(&model, &Settings::new(1.02e-4, step)).expect("valid settings");
    let mut places = vec![0.0];
    while run.state().step < run.step_count() {
        if run.advance(&mut NoRecorder).is_err() {
            break;
        }
        let state = run.state();
        if state.offset == 0.0 {
            places.push(state.projectile(&model, 0).map_or(f64::NAN, |mass| mass.position[1]));
        }
    }
    for (microseconds, exact) in
        [(5.0, 34.8562072), (10.0, 30.570388), (20.0, 24.5604188), (100.0, 14.1394579)]
    {
        let k = (microseconds * 1e-6 / step).round() as usize + 1;
        let found = match places.get(k..k + 2) {
            Some([before, after]) => (before - after) / step,
            _ => f64::NAN,
        };
        c.relative(format!("velocity after {microseconds} us [m/s]"), found, exact, 1e-3);
    }
    c.into_report()
}
