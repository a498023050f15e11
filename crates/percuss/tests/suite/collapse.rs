//! Plastic collapse: what a mesh bears, and what it reports where that is more than its sections can bear.

use percuss::*;

/// Young's modulus so large that deflections before the collapse are small \[Pa\].
const YOUNG: f64 = 2.1e13;
const LIMIT: f64 = 235e6;
const WIDTH: f64 = 0.1;
const DEPTH: f64 = 0.1;

/// Plastic moment of the section \[N m\].
const MOST: f64 = LIMIT * WIDTH * DEPTH * DEPTH / 4.0;

fn plastic(young: f64, modulus: f64) -> Material {
    let curve = vec![Hardening { from: 0.0, stress: LIMIT, modulus }];
    let law = Plasticity { curve, kinematic: 0.0, overstress: None, failure_strain: None };
    let inelasticity = Some(Inelasticity::Plastic(law));
    Material {
        inelasticity,
        strain: StrainMeasure::Engineering,
        ..Material::new("steel", young, 7850.0)
    }
}

fn at(beam: BeamId, s: f64) -> PointRef {
    PointRef { label: format!("{s}"), beam, along: Along::Fraction(s) }
}

/// A beam of 2 m with its supports.
struct Frame {
    b: ModelBuilder,
    of: MaterialId,
    section: SectionId,
    hinges: bool,
}

impl Frame {
    fn new(material: Material, hinges: bool) -> Self {
        let mut b = ModelBuilder::new();
        let of = b.material(material);
        let section = b.section(Section { fibres: 16, ..Section::rectangle("bar", WIDTH, DEPTH) });
        Self { b, of, section, hinges }
    }

    fn beam(&mut self, name: &str, points: &[[f64; 2]], elements: usize) -> BeamId {
        let mesh = Mesh { hinges: self.hinges, ..Mesh::even(elements) };
        self.b.beam(Beam { mesh, ..Beam::new(name, points, elements, self.of, self.section) })
    }

    fn hold(&mut self, beam: BeamId, s: f64, kind: SupportKind) {
        self.b.support(Support::new(format!("{beam:?} {s}"), at(beam, s), kind));
    }

    fn press(&mut self, beam: BeamId, s: f64, force: [f64; 2]) {
        let kind = LoadKind::Point { at: at(beam, s), force, moment: 0.0, follower: false };
        self.b.load(Load::new(format!("load {s}"), kind));
    }

    fn found(&self) -> Option<Equilibrium> {
        equilibrium(&self.b.build().unwrap()).ok()
    }
}

fn roller() -> SupportKind {
    SupportKind::Roller { direction: [1.0, 0.0] }
}

/// A clamp that can slide along the beam.
fn sliding() -> SupportKind {
    SupportKind::Fix { components: vec![Component::Displacement2, Component::Rotation] }
}

/// A beam of 2 m under a force at a place.
fn span(
    ends: [SupportKind; 2],
    place: f64,
    force: f64,
    (elements, hinges): (usize, bool),
) -> Frame {
    let mut frame = Frame::new(plastic(YOUNG, 0.0), hinges);
    let beam = frame.beam("b", &[[0.0, 0.0], [2.0, 0.0]], elements);
    for (s, kind) in [0.0, 1.0].into_iter().zip(ends) {
        frame.hold(beam, s, kind);
    }
    frame.press(beam, place, [0.0, -force]);
    frame
}

/// Whether an equilibrium exists at a share of a load, close to where the structure was.
fn bears(frame: &Frame) -> bool {
    let size = |found: &Equilibrium| found.largest_displacement.as_ref().map_or(0.0, |d| d.size());
    frame.found().is_some_and(|found| size(&found) < 0.05)
}

/// Collapse loads of the theory of plastic hinges (for example M. R. Horne, Plastic Theory of Structures), with eight elements a member.
#[test]
fn beams_of_eight_elements_bear_their_collapse_load_within_three_per_cent() {
    let mesh = (8, true);
    let pin = SupportKind::Pin;
    for (ends, place, exact) in [
        ([SupportKind::Clamp, sliding()], 0.5, 8.0),
        ([SupportKind::Clamp, roller()], 0.5, 6.0),
        ([pin, roller()], 0.5, 4.0),
        // Forces nearer to an end: 2 Mp (1/a + 1/b), of which the lengths are 0.5 and 1.5 m.
        ([SupportKind::Clamp, sliding()], 0.25, 2.0 * 2.0 * (2.0 + 1.0 / 1.5)),
    ] {
        let load = |share: f64| span(ends.clone(), place, share * exact * MOST / 2.0, mesh);
        assert!(bears(&load(0.98)), "{ends:?} {place}");
        assert!(!bears(&load(1.03)), "{ends:?} {place}");
    }
}

/// The element length beside a plastic hinge is that at its centre, which a longer element at the edge of the hinge does not change.
#[test]
fn a_hinge_has_the_length_of_the_element_at_its_centre() {
    let ends = [SupportKind::Clamp, sliding()];
    let model = span(ends, 0.5, 0.98 * 8.0 * MOST / 2.0, (8, true)).b.build().unwrap();
    let all = yielded_at_rest(&model, &equilibrium(&model).unwrap());
    let stations: Vec<f64> =
        model.beam(0).spans().flat_map(|span| span.stations().to_vec()).collect();
    assert!(all[0].hinges.len() > 1, "{:?}", all[0].hinges);
    for hinge in &all[0].hinges {
        let around = stations.windows(2).find(|w| w[0] < hinge.s && hinge.s <= w[1]).unwrap();
        assert!((hinge.element_length - (around[1] - around[0])).abs() < 1e-12, "{hinge:?}");
    }
}

/// Clamped feet, a force H at the eaves and V in the middle of the girder: `H h + V l/2 = 6 Mp` (combined mechanism).
#[test]
fn a_portal_of_eight_elements_a_member_bears_its_collapse_load_within_three_per_cent() {
    let (height, length) = (3.0, 4.0);
    let load = |share: f64| {
        let mut frame = Frame::new(plastic(YOUNG, 0.0), true);
        let left = frame.beam("left", &[[0.0, 0.0], [0.0, height]], 8);
        let girder = frame.beam("girder", &[[0.0, height], [length, height]], 8);
        let right = frame.beam("right", &[[length, height], [length, 0.0]], 8);
        for (name, between) in
            [("a", [at(left, 1.0), at(girder, 0.0)]), ("b", [at(girder, 1.0), at(right, 0.0)])]
        {
            frame.b.joint(Joint::new(name, JointKind::Rigid, between));
        }
        frame.hold(left, 0.0, SupportKind::Clamp);
        frame.hold(right, 1.0, SupportKind::Clamp);
        let force = share * 6.0 * MOST / (height + 0.5 * length);
        frame.press(girder, 0.0, [force, 0.0]);
        frame.press(girder, 0.5, [0.0, -force]);
        frame
    };
    assert!(bears(&load(0.98)));
    assert!(!bears(&load(1.03)));
}

/// Eight equal elements bear 1.08 of the collapse load of a propped beam, the moment above the plastic one by as much.
#[test]
fn section_forces_beyond_what_a_section_bears_are_an_error_of_the_mesh() {
    let excess = |mesh: (usize, bool), share: f64| {
        let load = share * 6.0 * MOST / 2.0;
        let found = span([SupportKind::Clamp, roller()], 0.5, load, mesh).found()?;
        Some(found.section_forces[0].excess)
    };
    let found = excess((8, false), 1.07).expect("an equilibrium").expect("an excess");
    assert!(found.ratio > 1.05 && found.ratio < 1.2, "{found:?}");
    assert!((found.moment.abs() / MOST / found.ratio - 1.0).abs() < 1e-3, "{found:?}");
    assert!((found.element - 0.25).abs() < 1e-12);
    // Below first yield there is none.
    assert_eq!(excess((8, false), 0.5), Some(None));
}

/// A section that hardens bears more than its first plastic moment, and one that is strained fast, too: neither is an error.
/// The moment of a load that grows along the beam is largest beside the middle of an element: `M = w L^2 / (9 sqrt 3)` at `L / sqrt 3`.
#[test]
fn an_excess_is_found_where_the_moment_is_largest_inside_an_element() {
    let mut frame = Frame::new(plastic(2.1e11, 0.0), false);
    let beam = frame.beam("beam", &[[0.0, 0.0], [2.0, 0.0]], 4);
    frame.hold(beam, 0.0, SupportKind::Pin);
    frame.hold(beam, 1.0, roller());
    let most = 1.04 * 9.0 * 3.0_f64.sqrt() * MOST / 4.0;
    let kind = LoadKind::Distributed {
        beam,
        stretch: [Along::Fraction(0.0), Along::Fraction(1.0)],
        force: [[0.0; 2], [0.0, -most]],
        follower: false,
    };
    frame.b.load(Load::new("earth", kind));
    let found = frame.found().unwrap();
    let forces = &found.section_forces[0];
    let largest = forces.moment.largest();
    assert!((largest.s - 2.0 / 3.0_f64.sqrt()).abs() < 1e-3, "{largest:?}");
    let excess = forces.excess.unwrap();
    assert!((excess.ratio / (largest.value.abs() / MOST) - 1.0).abs() < 0.01, "{excess:?}");
    assert!((excess.s - largest.s).abs() < 1e-3 && excess.ratio > 1.02, "{excess:?}");
}

/// A bar drawn out at a constant rate: the stress of its fibres contains the viscous part, `E tau` times that rate, as its axial force does.
#[test]
fn stresses_of_a_beam_that_can_yield_contain_those_of_its_viscosity() {
    let (retardation, rate) = (1e-2, 1e-3);
    let mut b = ModelBuilder::new();
    let of = b.material(Material { retardation, ..plastic(2.1e11, 0.0) });
    let section = b.section(Section { fibres: 8, ..Section::rectangle("bar", WIDTH, DEPTH) });
    let beam = b.beam(Beam::new("bar", &[[0.0, 0.0], [1.0, 0.0]], 4, of, section));
    b.support(Support::new("wall", at(beam, 0.0), SupportKind::Clamp));
    let mut pull = Support::new("pull", at(beam, 1.0), SupportKind::Clamp);
    let function = TimeFunction::Ramp { duration: 1.0 };
    pull.motion = Some(Motion { displacement: [rate, 0.0], rotation: 0.0, function });
    b.support(pull);
    b.record_point(at(beam, 0.5));
    let mut recorder = MemoryRecorder::default();
    let model = b.build().unwrap();
    let settings = Settings::new(5e-3, 1e-5);
    simulate(&model, &settings, &mut recorder).unwrap();
    let last = |name: &str| *recorder.column(name).unwrap().last().unwrap();
    let [force, stress] = ["section.0.5.axial", "section.0.5.stress"].map(last);
    // 1e-3 / s: the viscous part is 2.1 MPa of 3.15; the wave of the start is 0.04 MPa.
    assert!((stress * WIDTH * DEPTH / force - 1.0).abs() < 0.02, "{stress} {force}");
    let expected = 2.1e11 * rate * (5e-3 + retardation);
    assert!((stress / expected - 1.0).abs() < 0.02, "{stress} {expected}");
}

#[test]
fn hardening_and_rates_are_no_excess() {
    let law = |modulus: f64| plastic(210e9, modulus);
    let mut frame = Frame::new(law(5e9), true);
    let arm = frame.beam("arm", &[[0.0, 0.0], [2.0, 0.0]], 16);
    frame.hold(arm, 0.0, SupportKind::Clamp);
    frame.press(arm, 1.0, [0.0, -0.6 * 1.2 * MOST]);
    let found = frame.found().unwrap();
    let moment = found.section_forces[0].moment.largest().value.abs();
    assert!(moment > 1.15 * MOST, "{moment}");
    let excess = found.section_forces[0].excess.map_or(1.0, |excess| excess.ratio);
    assert!(excess < 1.03, "{excess}");

    let mut fast = law(0.0);
    if let Some(Inelasticity::Plastic(law)) = &mut fast.inelasticity {
        law.overstress = Some(Overstress { rate: 40.4, exponent: 5.0 });
    }
    let mut frame = Frame::new(fast, true);
    let beam = frame.beam("b", &[[0.0, 0.0], [2.0, 0.0]], 16);
    frame.hold(beam, 0.0, SupportKind::Clamp);
    frame.hold(beam, 1.0, roller());
    let kind = ProjectileKind::spring(1e7);
    frame.b.projectile(Projectile::new("p", kind, 200.0, [0.0, -10.0], at(beam, 0.5)));
    let run =
        simulate(&frame.b.build().unwrap(), &Settings::new(0.05, 2e-5), &mut NoRecorder).unwrap();
    let forces = &run.section_forces[0];
    assert!(forces.moment.largest().value.abs() > 1.3 * MOST, "{:?}", forces.moment);
    let excess = forces.excess.map_or(1.0, |excess| excess.ratio);
    assert!(excess < 1.03, "{:?}", forces.excess);
}
