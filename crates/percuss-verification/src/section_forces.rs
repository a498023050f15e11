//! Section forces compared with the balance of free bodies (any textbook on statics of beams, e.g. Timoshenko and Young, Elements of
//! strength of materials).

use percuss::*;

use crate::check::{Checks, Report};
use crate::structure::at;

/// Round-off of an equilibrium.
const BALANCE: f64 = 1e-9;

struct Scene {
    builder: ModelBuilder,
    beam: BeamId,
}

/// A straight beam of length 1, so stiff that its deflection has no effect.
fn scene(elements: usize, along: [f64; 2], section: Section) -> Scene {
    let mut builder = ModelBuilder::new();
    let strain = StrainMeasure::Engineering;
    let material = builder.material(Material { strain, ..Material::new("m", 1e18, 1e3) });
    let section = builder.section(section);
    let points = [[0.0, 0.0], along];
    let beam = builder.beam(Beam::new("beam", &points, elements, material, section));
    Scene { builder, beam }
}

impl Scene {
    fn hold(&mut self, place: f64, kind: SupportKind) {
        self.builder.support(Support::new(format!("at {place}"), at("p", self.beam, place), kind));
    }

    fn pull(&mut self, place: f64, force: [f64; 2], moment: f64) {
        let at = at("p", self.beam, place);
        let kind = LoadKind::Point { at, force, moment, follower: false };
        self.builder.load(Load::new(format!("at {place}"), kind));
    }

    fn spread(&mut self, force: [f64; 2]) {
        let stretch = [Along::Fraction(0.0), Along::Fraction(1.0)];
        let (beam, force) = (self.beam, [force; 2]);
        let kind = LoadKind::Distributed { beam, stretch, force, follower: false };
        self.builder.load(Load::new("spread", kind));
    }

    /// Section forces; `None` without equilibrium.
    fn forces(&self) -> SectionForceSummary {
        let model = self.builder.build().expect("a verification case builds");
        let found = equilibrium(&model).expect("a verification case has an equilibrium");
        found.section_forces.into_iter().next().expect("a beam")
    }
}

fn square() -> Section {
    Section::rectangle("s", 0.1, 0.1)
}

/// A beam's forces under distributed loads, its weight, and forces that divide it into spans, on meshes of any size.
pub fn in_statics() -> Report {
    let mut c = Checks::new();
    for n in [1, 2, 8] {
        let mut arm = scene(n, [1.0, 0.0], square());
        arm.hold(0.0, SupportKind::Clamp);
        arm.spread([0.0, -1e3]);
        let f = arm.forces();
        let name = format!("cantilever under 1000 N/m, {n} elements");
        c.relative(format!("{name}: shear force [N]"), f.shear.largest().value, 1e3, BALANCE);
        c.relative(format!("{name}: moment [N m]"), f.moment.largest().value.abs(), 500.0, BALANCE);
    }
    for n in [3, 4] {
        let mut girder = scene(n, [1.0, 0.0], square());
        girder.hold(0.0, SupportKind::Pin);
        girder.hold(1.0, SupportKind::Roller { direction: [1.0, 0.0] });
        girder.spread([0.0, -1e3]);
        let name = format!("simply supported under 1000 N/m, {n} elements: moment [N m]");
        c.relative(name, girder.forces().moment.largest().value, 125.0, BALANCE);
    }
    let mut bar = scene(4, [0.0, -1.0], square());
    bar.hold(0.0, SupportKind::Clamp);
    let acceleration = [0.0, -9.81];
    bar.builder.load(Load::new("weight", LoadKind::Gravity { acceleration }));
    let axial = bar.forces().axial;
    c.relative("hanging bar: axial force at the top [N]", axial.max.value, 98.1, BALANCE);
    c.absolute("hanging bar: axial force at its end [N]", axial.min.value, 0.0, 98.1 * BALANCE);
    for (n, place) in [(2, 0.5), (4, 0.3)] {
        let mut bar = scene(n, [1.0, 0.0], square());
        bar.hold(0.0, SupportKind::Clamp);
        bar.hold(1.0, SupportKind::Clamp);
        bar.pull(place, [1e3, 0.0], 0.0);
        let axial = bar.forces().axial;
        let name = format!("fixed-fixed bar pulled by 1000 N at {place}, {n} elements");
        c.relative(format!("{name}: behind [N]"), axial.max.value, 1e3 * (1.0 - place), BALANCE);
        c.relative(format!("{name}: ahead [N]"), axial.min.value, -1e3 * place, BALANCE);
    }
    c.into_report()
}

/// Stress at the thin end of a taper of rectangles, 20 mm wide, 40 mm deep at its root: `N/A + 6 M / (b d^2)`.
pub fn of_tapers() -> Report {
    let mut c = Checks::new();
    for n in [1, 4] {
        for (depth, pull, moment) in [(0.02, 0.0, 40.0), (0.01, 2e4, 20.0)] {
            let station = |at: f64, depth: f64| {
                let (area, inertia) = (0.02 * depth, 0.02 * f64::powi(depth, 3) / 12.0);
                Station {
                    at,
                    area,
                    inertia,
                    depth: Some(depth),
                    profile: Profile::Unknown,
                    properties: Default::default(),
                }
            };
            let stations = vec![station(0.0, 0.04), station(1.0, depth)];
            let section = Section { stations, ..Section::rectangle("s", 0.02, 0.04) };
            let mut arm = scene(n, [1.0, 0.0], section);
            arm.hold(0.0, SupportKind::Clamp);
            arm.pull(1.0, [pull, 0.0], moment);
            let exact = pull / (0.02 * depth) + moment * 6.0 / (0.02 * depth * depth);
            let name = format!("taper to {depth} m, {n} elements: stress [Pa]");
            c.relative(name, arm.forces().stress.max.value, exact, BALANCE);
        }
    }
    c.into_report()
}
