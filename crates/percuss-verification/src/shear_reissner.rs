//! Simo and Vu-Quoc's beams, and Lee's frame, with shear.

use percuss::*;

use crate::check::{Checks, Report};
use crate::motion::{root_angle, turning_root};
use crate::shear::limit;
use crate::structure::{at, lee, or_nan};

/// A straight uniform beam.
struct Straight {
    /// Start and end, shape (2, 2) \[m\].
    points: [[f64; 2]; 2],
    /// EA, shear stiffness and EI, shape (3) \[N, N, N m^2\].
    stiffness: [f64; 3],
    /// rhoA and rhoI, shape (2) \[kg/m, kg m\].
    inertia: [f64; 2],
}

impl Straight {
    fn begun(&self, elements: usize) -> (ModelBuilder, BeamId) {
        let [axial, shear, bending] = self.stiffness;
        let mut b = ModelBuilder::new();
        let material = b.material(Material {
            shear_modulus: Some(shear),
            ..Material::new("m", axial, self.inertia[0])
        });
        let section = b.section(Section {
            shear_factor: Some(1.0),
            rotary_inertia: RotaryInertia::Given(self.inertia[1]),
            ..Section::new("s", 1.0, bending / axial)
        });
        let slender = Beam::new("beam", &self.points, elements, material, section);
        let beam = b.beam(Beam { theory: Theory::Shear, ..slender });
        (b, beam)
    }
}

/// Advances a run by a step and keeps the largest energy residual, NaN if the step fails; whether it succeeded.
fn advanced(run: &mut Simulation<'_>, residual: &mut f64) -> bool {
    let fine = run.advance(&mut NoRecorder).is_ok();
    let ledger = &run.state().ledger;
    let now = (ledger.energy_residual(run.measures()) / ledger.energy_scale).abs();
    *residual = if fine { residual.max(now) } else { f64::NAN };
    fine
}

/// Least axial and transverse displacement of the tip in the spin-up manoeuvre, and the mean stretch after it \[m\]; energy residual.
fn spun(elements: usize) -> [f64; 4] {
    let beam = Straight {
        points: [[0.0, 0.0], [10.0, 0.0]],
        stiffness: [2.8e7, 1e7, 1.4e4],
        inertia: [1.2, 6e-4],
    };
    let (mut b, arm) = beam.begun(elements);
    b.support(turning_root(arm));
    let model = b.build().expect("a verification case builds");
    let mut run = Simulation::new(&model, &Settings::new(20.0, 1e-2)).expect("valid settings");
    let (mut least, mut stretch, mut residual) = ([0.0_f64; 2], Vec::new(), 0.0);
    while run.state().step < run.step_count() && advanced(&mut run, &mut residual) {
        let (u, t) = (run.state().displacement[elements], run.state().time);
        let (sine, cosine) = root_angle(t).sin_cos();
        let x = [10.0 + u[0], u[1]];
        let along = cosine * x[0] + sine * x[1] - 10.0;
        let across = cosine * x[1] - sine * x[0];
        least = [least[0].min(along), least[1].min(across)];
        if t > 15.0 {
            stretch.push(along);
        }
    }
    [least[0], least[1], stretch.iter().sum::<f64>() / stretch.len() as f64, residual]
}

/// C1 with shear: spin-up (Simo and Vu-Quoc 1986).
pub fn spin_up() -> Report {
    let mut c = Checks::new();
    let [coarse, middle, fine] = [16, 32, 64].map(spun);
    let reached = |k: usize| limit(4, coarse[k], middle[k]);
    // References of slender beams by an independent method: shear adds 3 EI / (GA L^2) = 4e-5 of the transverse displacement.
    c.relative("least axial displacement [m]", reached(0), -0.018_830, 1e-3);
    c.relative("least transverse displacement [m]", reached(1), -0.573_951, 1e-3);
    let k = (1.2_f64 * 36.0 / 2.8e7).sqrt();
    // The remaining vibration shortens the mean slightly.
    c.relative("steady stretch [m]", reached(2), (10.0 * k).tan() / k - 10.0, 1e-3);
    let order = ((coarse[1] - middle[1]) / (middle[1] - fine[1])).log2();
    c.absolute("order of the transverse displacement", order, 4.0, 0.3);
    let residual = coarse[3] + middle[3] + fine[3];
    c.at_most("energy residuals", residual, 1e-10);
    c.into_report()
}

/// The motion of the thrown beam.
struct Thrown {
    /// Coordinates of the loaded end and of the other one at 2.5 and 5 s, shape (2, 4) \[m\].
    ends: [[f64; 4]; 2],
    /// Angular momentum about the origin at 2.5 s \[kg m^2/s\].
    angular: f64,
    /// Linear momentum at 5 s, shape (2) \[kg m/s\].
    linear: [f64; 2],
    /// Largest energy residual.
    residual: f64,
}

/// That motion on a mesh.
fn thrown(elements: usize) -> Thrown {
    let beam = Straight {
        points: [[0.0, 8.0], [6.0, 0.0]],
        stiffness: [1e4, 1e4, 100.0],
        inertia: [1.0, 10.0],
    };
    let (mut b, id) = beam.begun(elements);
    let end = at("end", id, 1.0);
    let kind = LoadKind::Point { at: end, force: [8.0, 0.0], moment: -80.0, follower: false };
    b.load(Load { from: 0.0, until: 2.5, ..Load::new("throw", kind) });
    let model = b.build().expect("a verification case builds");
    let mut run = Simulation::new(&model, &Settings::new(5.0, 2.5e-3)).expect("valid settings");
    let none = f64::NAN;
    let mut found =
        Thrown { ends: [[none; 4]; 2], angular: none, linear: [none; 2], residual: 0.0 };
    while run.state().step < run.step_count() && advanced(&mut run, &mut found.residual) {
        let u = &run.state().displacement;
        let (loaded, other) = (u[elements], u[0]);
        let ends = [6.0 + loaded[0], loaded[1], other[0], 8.0 + other[1]];
        match run.state().step {
            1000 => {
                found.ends[0] = ends;
                found.angular = run.measures().angular;
            }
            2000 => {
                found.ends[1] = ends;
                found.linear = run.measures().linear;
            }
            _ => (),
        }
    }
    found
}

/// C2 with shear: a beam thrown by a force and a torque at its end (Simo and Vu-Quoc 1986).
///
/// Reference: positions at nodes and angles between them, explicit Runge-Kutta of order 8, limit of 200 and 400 cells.
pub fn flying_beam() -> Report {
    let mut c = Checks::new();
    let meshes = [32, 64, 128];
    let runs = meshes.map(thrown);
    let [_, coarse, fine] = &runs;
    let exact = [
        [4.963_084, 4.476_005, 3.583_182, 6.111_873],
        [9.783_735, 8.203_819, 8.074_413, 1.758_907],
    ];
    let names = ["loaded end, component 1", "component 2", "other end, component 1", "component 2"];
    for (k, (seconds, tolerance)) in [(2.5, 2e-3), (5.0, 3e-3)].into_iter().enumerate() {
        for (i, name) in names.into_iter().enumerate() {
            let found = limit(4, coarse.ends[k][i], fine.ends[k][i]);
            c.absolute(format!("{name} at {seconds} s [m]"), found, exact[k][i], tolerance);
        }
    }
    let angular = limit(4, coarse.angular, fine.angular);
    c.relative("angular momentum [kg m^2/s]", angular, -229.518_2, 2e-5);
    for (i, exact) in [20.0, 0.0].into_iter().enumerate() {
        let what = format!("linear momentum {} at 5 s [kg m/s]", i + 1);
        c.absolute(what, fine.linear[i], exact, 1e-9);
    }
    // The inertia of the sections is that of a depth larger than the length: with elements shorter than that errors decrease unevenly.
    for (run, (n, most)) in runs.iter().zip([(32, 1.5e-2), (64, 7e-3), (128, 1.5e-3)]) {
        let apart = |i: usize| (run.ends[0][i] - exact[0][i]).powi(2);
        let error = (0..4).map(apart).sum::<f64>().sqrt();
        c.at_most(format!("error of the ends at 2.5 s, {n} elements [m]"), error, most);
    }
    let residual = runs.iter().map(|run| run.residual).sum();
    c.at_most("energy residuals", residual, 1e-11);
    c.into_report()
}

/// Lee's frame with shear (E 7.2e6, nu 0.3, shear factor 5/6) under a load down.
fn sheared_lee(elements: usize) -> Model {
    let material = Material { poisson: Some(0.3), ..Material::new("m", 7.2e6, 1.0) };
    let section = Section { shear_factor: Some(5.0 / 6.0), ..Section::new("s", 6.0, 2.0) };
    lee(elements, material, section, Theory::Shear)
}

/// Load and displacement to the side of Lee's frame where the load has moved down by 20 and 40, and at the limit point, where the last number is the
/// displacement down.
fn bent(elements: usize) -> [[f64; 3]; 3] {
    let model = sheared_lee(elements);
    let down_to = |v: f64| {
        let point = "load".into();
        let end = PathEnd::Displacement { point, component: 2, value: -v };
        equilibrium_path(&model, &PathSettings { first: 1000.0, points: 500, end }).ok()
    };
    let last = |v: f64| {
        let path = down_to(v);
        let end = path.as_ref().and_then(|path| path.points.last());
        end.map_or([f64::NAN; 3], |end| [end.factor, end.displacements[0][0], v])
    };
    let path = down_to(52.0);
    let top = path.as_ref().and_then(|path| path.limit_points.first());
    let place = |k: usize| or_nan(top.map(|top| top.displacements[0][k]));
    [last(20.0), last(40.0), [or_nan(top.map(|top| top.factor)), place(0), -place(1)]]
}

/// A5 with shear: Lee's frame by shooting on the differential equations of Reissner's beam.
pub fn lees_frame() -> Report {
    let mut c = Checks::new();
    let meshes = [40, 80, 160];
    let found = meshes.map(bent);
    let exact = [
        ("v = 20", [13_446.784_6, 5.249_324, 20.0]),
        ("v = 40", [17_793.596_8, 17.540_542, 40.0]),
        ("limit point", [18_544.527_1, 26.878_328, 48.754_24]),
    ];
    for (k, (name, [load, aside, down])) in exact.into_iter().enumerate() {
        let reached = |i: usize| limit(4, found[1][k][i], found[2][k][i]);
        c.relative(format!("{name}: load"), reached(0), load, 1e-5);
        c.absolute(format!("{name}: u"), reached(1), aside, 1e-3);
        c.absolute(format!("{name}: v"), reached(2), down, 1e-3);
    }
    let errors = |k: usize| -> Vec<[f64; 2]> {
        let of = |(n, one): (&usize, &[[f64; 3]; 3])| {
            [240.0 / *n as f64, (one[k][0] / exact[k].1[0] - 1.0).abs()]
        };
        meshes.iter().zip(&found).map(of).collect()
    };
    let axes = ["element size", "relative error of the load"];
    let order = c.convergence("Load of Lee's frame at v = 40", axes, errors(1));
    // That of bending is four, that of strains of shear two; with the axial strain of the field inside elements 2.89.
    c.absolute("order of the load at v = 40", order, 2.9, 0.1);
    c.into_report()
}
