//! Shear-flexible beams: statics, frequencies, buckling, balances, and their slender limit.

use std::f64::consts::PI;

use percuss::*;

use crate::check::{Checks, Report};
use crate::structure::{at, or_nan};

/// A straight shear-flexible beam along e1.
#[derive(Clone, Copy, Debug)]
pub struct Stub {
    /// Length \[m\].
    pub length: f64,
    /// Number of elements.
    pub elements: usize,
    /// Young's modulus \[Pa\].
    pub young: f64,
    /// Density \[kg/m^3\].
    pub density: f64,
    /// Poisson's ratio \[-\].
    pub poisson: f64,
    /// Shear factor \[-\].
    pub kappa: f64,
    /// Area \[m^2\].
    pub area: f64,
    /// Second moment of area \[m^4\].
    pub inertia: f64,
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

    /// With another number of elements.
    pub fn with(self, elements: usize) -> Self {
        Self { elements, ..self }
    }

    /// A model of it, with supports at its ends.
    pub fn begun(&self, ends: [Option<SupportKind>; 2]) -> (ModelBuilder, BeamId) {
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
pub fn limit(order: i32, coarse: f64, fine: f64) -> f64 {
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

/// A simply supported beam (NAFEMS FV5), both spectra: `a w^4 - b w^2 + d = 0` with `a = rhoA rhoI / GA`,
/// `b = rhoA + (rhoI + EI rhoA / GA) k^2`, `d = EI k^4`, `k = n pi / L`; n = 0 has a second root only, the cut-off frequency.
pub fn spectra() -> Report {
    let mut c = Checks::new();
    let stub = Stub::rectangle(10.0, [2.0, 2.0], 2e11, 8000.0, 0.849673);
    let bending = stub.young * stub.inertia;
    let shear = stub.kappa * stub.young / 2.6 * stub.area;
    let (mass, rotary) = (stub.density * stub.area, stub.density * stub.inertia);
    let roots = |n: f64| {
        let k2 = (n * PI / stub.length).powi(2);
        let (a, d) = (rotary * mass / shear, bending * k2 * k2);
        let b = mass + (rotary + bending * mass / shear) * k2;
        let larger = b + (b * b - 4.0 * a * d).sqrt();
        [2.0 * d / larger, larger / (2.0 * a)].map(|square| square.sqrt() / (2.0 * PI))
    };
    let axial = |n: f64| 0.5 * n * (stub.young / stub.density).sqrt() / stub.length;
    let mut exact = vec![(roots(0.0)[1], "second spectrum", 0)];
    for n in 1..20 {
        let [first, second] = roots(f64::from(n));
        exact.push((first, "first spectrum", n));
        exact.push((second, "second spectrum", n));
        exact.push((axial(f64::from(n)), "axial", n));
    }
    exact.sort_by(|a, b| a.0.total_cmp(&b.0));
    let found = |elements: usize| -> Vec<(f64, bool)> {
        let pin = || Some(SupportKind::Pin);
        let (b, _) = stub.with(elements).begun([pin(), pin()]);
        let model = b.build().expect("a verification case builds");
        let rest = State::at_rest(&model, Scheme::EnergyMomentum);
        let modes = modes_about(&model, &rest, 16);
        modes.iter().map(|mode| (mode.frequency(), mode.is_second_spectrum(&model))).collect()
    };
    let (coarse, fine) = (found(64), found(128));
    for (k, (frequency, spectrum, waves)) in exact.into_iter().take(16).enumerate() {
        let both = [&coarse, &fine].map(|all| all.get(k).copied());
        let [a, b] = both.map(|mode| or_nan(mode.map(|(frequency, _)| frequency)));
        let what = format!("mode {}, {spectrum}, {waves} half waves", k + 1);
        c.relative(format!("{what} [Hz]"), limit(4, a, b), frequency, 1e-5);
        let named = both.iter().filter(|mode| mode.is_some_and(|(_, second)| second)).count();
        let expected = if spectrum == "second spectrum" { 2.0 } else { 0.0 };
        c.absolute(format!("{what}: meshes that name it second"), named as f64, expected, 0.0);
    }
    c.into_report()
}

/// A cantilever under a large dead force, with more and more shear stiffness: its distance from a slender one falls as 1 / GA.
pub fn slender_limit() -> Report {
    let mut c = Checks::new();
    let force = -3.0;
    let slender = {
        let stub = Stub::unit(1e6, 1.0, 64);
        let mut b = ModelBuilder::new();
        let strain = StrainMeasure::Engineering;
        let material = Material { strain, ..Material::new("m", stub.young, stub.density) };
        let material = b.material(material);
        let section = b.section(Section::new("s", stub.area, stub.inertia));
        let points = [[0.0, 0.0], [stub.length, 0.0]];
        let arm = b.beam(Beam::new("arm", &points, stub.elements, material, section));
        b.support(Support::new("root", at("root", arm, 0.0), SupportKind::Clamp));
        let tip = at("tip", arm, 1.0);
        let kind =
            LoadKind::Point { at: tip.clone(), force: [0.0, force], moment: 0.0, follower: false };
        b.load(Load::new("tip", kind));
        b.record_point(tip);
        let model = b.build().expect("a verification case builds");
        equilibrium(&model).map_or([f64::NAN; 2], |found| found.points[0].1)
    };
    let mut distances = Vec::new();
    // Distances times GA by shooting on the differential equations of both.
    for (shear, exact) in [(1e2, 1.452_780), (1e3, 1.440_026), (1e4, 1.438_761)] {
        let [coarse, fine] = [64, 128].map(|n| Stub::unit(1e6, shear, n).tip(force));
        let off = |i: usize| limit(2, coarse[i], fine[i]) - slender[i];
        let distance = off(0).hypot(off(1));
        // By own integration, with less than 1e-7 of it by the meshes: 1.45, 1.44 and 1.44 / GA.
        let what = format!("GA {shear}: distance of the tips times GA");
        c.relative(what, distance * shear, exact, 1e-3);
        distances.push([1.0 / shear, distance]);
    }
    let axes = ["EI / (GA L^2)", "distance of the tips / L"];
    let order = c.convergence("Shear-flexible and slender", axes, distances);
    c.absolute("order in 1 / GA", order, 1.0, 0.01);
    c.into_report()
}
