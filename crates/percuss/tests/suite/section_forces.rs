//! Section forces against the balance of free bodies and closed forms.

use crate::common;

use common::rows::Rows;
use common::*;
use percuss::*;

/// A steel-like cross section so stiff that its deflections do not count.
fn stiff(b: &mut ModelBuilder) -> (MaterialId, SectionId) {
    (b.material(Material::new("m", 1e15, 1e3)), b.section(Section::rectangle("s", 0.1, 0.1)))
}

fn line_load(beam: BeamId, force: [f64; 2]) -> LoadKind {
    let stretch = [Along::Fraction(0.0), Along::Fraction(1.0)];
    LoadKind::Distributed { beam, stretch, force: [force; 2], follower: false }
}

fn point_load(at: PointRef, force: [f64; 2], moment: f64) -> LoadKind {
    LoadKind::Point { at, force, moment, follower: false }
}

fn hold(b: &mut ModelBuilder, at: PointRef, kind: SupportKind) {
    let name = at.label.clone();
    b.support(Support::new(name, at, kind));
}

fn reaction<'a>(found: &'a Equilibrium, name: &str) -> &'a [f64; 3] {
    &found.reactions.iter().find(|(n, _)| n == name).unwrap().1
}

/// Columns of a clamp at the start of a beam along the first axis, and the sign of the section forces there against its reaction:
/// tension pulls at the support, a positive shear force is the support's push upwards, a positive moment turns it the other way.
const AT_THE_START: [(&str, &str, f64); 3] =
    [("axial", "force_1", -1.0), ("shear", "force_2", 1.0), ("moment", "moment", -1.0)];

/// Round-off of forces from an equilibrium of this size.
fn close(a: f64, b: f64, size: f64) -> bool {
    (a - b).abs() <= 1e-9 * size
}

#[test]
fn forces_at_a_support_are_its_reactions_under_a_distributed_load() {
    // Cantilever, L = 1, q = 1000: shear 1000, moment 500 at the root, with one element as with eight.
    for elements in [1, 2, 3, 8] {
        let mut b = ModelBuilder::new();
        let (m, s) = stiff(&mut b);
        let arm = b.beam(beam("arm", [0.0, 0.0], [1.0, 0.0], elements, m, s));
        hold(&mut b, at("root", arm, 0.0), SupportKind::Clamp);
        b.load(Load::new("q", line_load(arm, [0.0, -1e3])));
        let found = equilibrium(&b.build().unwrap()).unwrap();
        let (forces, root) = (&found.section_forces[0], reaction(&found, "root"));
        let (shear, moment) = (forces.shear.largest(), forces.moment.largest());
        assert!(close(shear.value.abs(), root[1].abs(), 1e3) && shear.s == 0.0, "{shear:?}");
        assert!(close(moment.value.abs(), root[2].abs(), 1e3) && moment.s == 0.0, "{moment:?}");
        // The deflection of such a stiff beam has no effect in nine digits.
        assert!(close(shear.value.abs(), 1e3, 1e3) && close(moment.value.abs(), 500.0, 1e3));
        // Zero at the free end.
        let e = &forces.envelope;
        let last = e.s.len() - 1;
        assert!(close(e.shear[1][last], 0.0, 1e3) && close(e.moment[1][last], 0.0, 1e3));
    }
}

#[test]
fn the_largest_moment_between_nodes_is_found_where_the_shear_force_vanishes() {
    for elements in [1, 3, 4, 5] {
        let mut b = ModelBuilder::new();
        let (m, s) = stiff(&mut b);
        let girder = b.beam(beam("girder", [0.0, 0.0], [1.0, 0.0], elements, m, s));
        hold(&mut b, at("a", girder, 0.0), SupportKind::Pin);
        hold(&mut b, at("b", girder, 1.0), SupportKind::Roller { direction: [1.0, 0.0] });
        b.load(Load::new("q", line_load(girder, [0.0, -1e3])));
        let found = equilibrium(&b.build().unwrap()).unwrap();
        let most = found.section_forces[0].moment.largest();
        assert!(close(most.value.abs(), 125.0, 1e3), "{elements}: {most:?}"); // q L^2 / 8
        assert!((most.s - 0.5).abs() < 1e-6);
        assert!(close(found.section_forces[0].shear.largest().value.abs(), 500.0, 1e3));
    }
    // Loaded on 0.2 < s < 0.7 only: R_a = q 0.5 (1 - 0.45) = 275, V = 0 at 0.475, M = 275 0.475 - q 0.275^2 / 2.
    let mut b = ModelBuilder::new();
    let (m, s) = stiff(&mut b);
    let girder = b.beam(beam("girder", [0.0, 0.0], [1.0, 0.0], 2, m, s));
    hold(&mut b, at("a", girder, 0.0), SupportKind::Pin);
    hold(&mut b, at("b", girder, 1.0), SupportKind::Roller { direction: [1.0, 0.0] });
    let stretch = [Along::Fraction(0.2), Along::Fraction(0.7)];
    let force = [[0.0, -1e3]; 2];
    b.load(Load::new("q", LoadKind::Distributed { beam: girder, stretch, force, follower: false }));
    let found = equilibrium(&b.build().unwrap()).unwrap();
    let most = found.section_forces[0].moment.largest();
    let exact = 275.0 * 0.475 - 500.0 * 0.275_f64.powi(2);
    assert!(close(most.value.abs(), exact, 1e3), "{most:?} {exact}");
}

#[test]
fn a_hanging_bar_carries_all_its_weight_at_the_top() {
    let mut b = ModelBuilder::new();
    let (m, s) = stiff(&mut b);
    let bar = b.beam(beam("bar", [0.0, 0.0], [0.0, -8.0], 4, m, s));
    hold(&mut b, at("top", bar, 0.0), SupportKind::Clamp);
    b.load(Load::new("g", LoadKind::Gravity { acceleration: [0.0, -9.81] }));
    let found = equilibrium(&b.build().unwrap()).unwrap();
    let axial = found.section_forces[0].axial.largest();
    assert!(close(axial.value, 1e3 * 0.01 * 8.0 * 9.81, 1e3) && axial.s == 0.0, "{axial:?}"); // 784.8
    assert!(close(axial.value, reaction(&found, "top")[1], 1e3));
}

#[test]
fn forces_of_a_large_deflection_are_those_of_its_ends_along_the_deformed_tangent() {
    // A soft arm under gravity and a tip force, more than 30 degrees down: reactions turned into the tangent at the root, and at the
    // tip the force alone.
    for (measure, elements) in [(StrainMeasure::Green, 6), (StrainMeasure::Engineering, 40)] {
        let mut b = ModelBuilder::new();
        let m = b.material(Material { strain: measure, ..Material::new("m", 1e8, 1e3) });
        let s = b.section(Section::rectangle("s", 0.1, 0.02));
        let arm = b.beam(beam("arm", [0.0, 0.0], [1.0, 0.0], elements, m, s));
        hold(&mut b, at("root", arm, 0.0), SupportKind::Clamp);
        b.load(Load::new("g", LoadKind::Gravity { acceleration: [0.0, -9.81] }));
        b.load(Load::new("tip", point_load(at("tip", arm, 1.0), [3.0, -8.0], 2.0)));
        let model = b.build().unwrap();
        let found = equilibrium(&model).unwrap();
        let (forces, root) = (&found.section_forces[0], reaction(&found, "root"));
        let e = &forces.envelope;
        let size = 20.0;
        // The root keeps its direction: the part ahead pulls with the opposite of the reaction.
        assert!(close(e.axial[0][0], -root[0], size), "{} {}", e.axial[0][0], root[0]);
        assert!(close(e.shear[0][0], root[1], size) && close(e.moment[0][0], -root[2], size));
        let last = e.s.len() - 1;
        let node = found.state.displacement.len() - 1;
        let u = found.state.displacement[node];
        let g = [1.0 + u[2], u[3]];
        let r = g[0].hypot(g[1]);
        assert!(g[1] < -0.5 * r, "{g:?}");
        let (along, across) = ((3.0 * g[0] - 8.0 * g[1]) / r, (3.0 * g[1] + 8.0 * g[0]) / r);
        assert!(close(e.axial[0][last], along, size) && close(e.shear[0][last], across, size));
        assert!(close(e.moment[0][last], 2.0, size), "{}", e.moment[0][last]);
    }
}

#[test]
fn stress_vanishes_where_the_moment_changes_its_sign_inside_an_element() {
    // 100 N m at both ends with the same sign: M = 100 at one end, -100 at the other, zero in the middle.
    let mut b = ModelBuilder::new();
    let (m, s) = stiff(&mut b);
    let girder = b.beam(beam("b", [0.0, 0.0], [1.0, 0.0], 3, m, s));
    hold(&mut b, at("left", girder, 0.0), SupportKind::Pin);
    hold(&mut b, at("right", girder, 1.0), SupportKind::Roller { direction: [1.0, 0.0] });
    for end in [0.0, 1.0] {
        b.load(Load::new(format!("m{end}"), point_load(at("e", girder, end), [0.0; 2], 100.0)));
    }
    b.record_point(at("mid", girder, 0.5));
    let model = b.build().unwrap();
    let run = static_row(&model);
    let of = |q: &str| run.iter().find(|(n, _)| n == &format!("section.mid.{q}")).unwrap().1;
    let at_ends = 100.0 / (0.1_f64.powi(3) / 6.0);
    assert!(of("moment").abs() < 1e-6 && of("stress").abs() < 1e-6 * at_ends, "{run:?}");
    assert!(close(of("shear").abs(), 200.0, 200.0));
}

/// The first row of a run that starts in equilibrium, by channel.
fn static_row(model: &Model) -> Vec<(String, f64)> {
    struct First(Vec<(String, f64)>);
    impl Recorder for First {
        fn begin(&mut self, channels: &[Channel]) -> Result<(), RecorderError> {
            self.0 = channels.iter().map(|c| (c.name.clone(), f64::NAN)).collect();
            Ok(())
        }
        fn row(&mut self, values: &[f64]) -> Result<(), RecorderError> {
            if self.0[0].1.is_nan() {
                self.0.iter_mut().zip(values).for_each(|(to, v)| to.1 = *v);
            }
            Ok(())
        }
    }
    let mut first = First(Vec::new());
    let settings = Settings { start: Start::Static, ..Settings::new(1e-6, 1e-6) };
    simulate(model, &settings, &mut first).unwrap();
    first.0
}

/// A rectangle 20 mm wide whose depth falls from one value to the other along the beam.
fn taper(from: f64, to: f64) -> Section {
    let station = |at: f64, depth: f64| Station {
        at,
        area: 0.02 * depth,
        inertia: 0.02 * depth.powi(3) / 12.0,
        depth: Some(depth),
        profile: Profile::Unknown,
    };
    let first = Section::rectangle("taper", 0.02, from);
    Section { stations: vec![station(0.0, from), station(1.0, to)], ..first }
}

#[test]
fn stress_at_the_end_of_a_tapered_element_is_that_of_the_section_there() {
    for elements in [1, 4] {
        for (to, axial) in [(0.02, 0.0), (0.01, 2e4)] {
            let mut b = ModelBuilder::new();
            let m = b.material(Material::new("m", 1e20, 1e3)); // no arm from deflections
            let s = b.section(taper(0.04, to));
            let arm = b.beam(beam("arm", [0.0, 0.0], [1.0, 0.0], elements, m, s));
            hold(&mut b, at("root", arm, 0.0), SupportKind::Clamp);
            b.load(Load::new("tip", point_load(at("tip", arm, 1.0), [axial, 0.0], 40.0)));
            let found = equilibrium(&b.build().unwrap()).unwrap();
            let stress = found.section_forces[0].stress.max;
            let exact = axial / (0.02 * to) + 40.0 * 6.0 / (0.02 * to * to);
            assert!((stress.value / exact - 1.0).abs() < 1e-9 && stress.s == 1.0, "{stress:?}");
            // At the root too.
            let root = found.section_forces[0].envelope.stress[1][0];
            let exact = axial / (0.02 * 0.04) + 40.0 * 6.0 / (0.02 * 0.04_f64.powi(2));
            assert!((root / exact - 1.0).abs() < 1e-9, "{root} {exact}");
        }
    }
}

#[test]
fn a_point_at_a_change_of_section_has_the_stress_of_the_weaker_side() {
    for thin_first in [true, false] {
        let mut b = ModelBuilder::new();
        let m = b.material(Material::new("m", 1e15, 1e3));
        let thick = b.section(Section::rectangle("thick", 0.02, 0.04));
        let thin = b.section(Section::rectangle("thin", 0.02, 0.02));
        let (first, then) = if thin_first { (thin, thick) } else { (thick, thin) };
        let place = Along::Fraction(0.5);
        let changes = vec![Change { at: place, material: None, section: Some(then) }];
        let arm = Beam { changes, ..beam("arm", [0.0, 0.0], [1.0, 0.0], 4, m, first) };
        let arm = b.beam(arm);
        hold(&mut b, at("root", arm, 0.0), SupportKind::Clamp);
        b.load(Load::new("tip", point_load(at("tip", arm, 1.0), [0.0; 2], 50.0)));
        b.record_point(at("mid", arm, 0.5));
        let row = static_row(&b.build().unwrap());
        let of = |q: &str| row.iter().find(|(n, _)| n == &format!("section.mid.{q}")).unwrap().1;
        // 50 / (b d^2 / 6) on the thin side: 37.5 MPa.
        let stress = of("stress");
        assert!((stress.abs() / 37.5e6 - 1.0).abs() < 1e-9, "{thin_first}: {stress}");
        let [top, bottom] = [of("stress_top"), of("stress_bottom")];
        assert!((top / -37.5e6 - 1.0).abs() < 1e-9, "{thin_first}: {top}");
        assert!((bottom / 37.5e6 - 1.0).abs() < 1e-9, "{thin_first}: {bottom}");
    }
}

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

/// Every row by channel.
#[derive(Default)]
struct Columns {
    names: Vec<String>,
    rows: Vec<Vec<f64>>,
}

impl Columns {
    fn of(&self, name: &str) -> Vec<f64> {
        let k = self.names.iter().position(|n| n == name).unwrap();
        self.rows.iter().map(|row| row[k]).collect()
    }
}

impl Recorder for Columns {
    fn begin(&mut self, channels: &[Channel]) -> Result<(), RecorderError> {
        self.names = channels.iter().map(|c| c.name.clone()).collect();
        Ok(())
    }
    fn row(&mut self, values: &[f64]) -> Result<(), RecorderError> {
        self.rows.push(values.to_vec());
        Ok(())
    }
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

#[test]
fn an_axial_force_that_jumps_at_a_node_is_shared_by_the_stiffness_of_both_sides() {
    // Fixed-fixed bar loaded at 0.5, at 0.3 within an element, and by a spring there: EA / a + EA / b against the load.
    for (elements, place) in [(2, 0.5), (4, 0.3), (1, 0.25)] {
        let mut b = ModelBuilder::new();
        let m = b.material(Material {
            strain: StrainMeasure::Engineering,
            ..Material::new("m", 1e9, 1e3)
        });
        let s = b.section(Section::rectangle("s", 0.1, 0.1));
        let bar = b.beam(beam("bar", [0.0, 0.0], [1.0, 0.0], elements, m, s));
        hold(&mut b, at("left", bar, 0.0), SupportKind::Clamp);
        hold(&mut b, at("right", bar, 1.0), SupportKind::Clamp);
        b.load(Load::new("push", point_load(at("p", bar, place), [1e3, 0.0], 0.0)));
        b.record_point(at("p", bar, place));
        let found = equilibrium(&b.build().unwrap()).unwrap();
        let exact = 1e3 / (1e7 / place + 1e7 / (1.0 - place));
        let moved = found.points[0].1[0];
        assert!((moved / exact - 1.0).abs() < 1e-9, "{elements} {place}: {moved} {exact}");
        let axial = &found.section_forces[0].axial;
        assert!(close(axial.max.value, 1e3 * (1.0 - place), 1e3), "{axial:?}");
        assert!(close(axial.min.value, -1e3 * place, 1e3), "{axial:?}");
    }
}

#[test]
fn a_clamp_or_a_joint_within_an_element_parts_the_beam_there() {
    // A clamp at 0.3 of a bar pulled at its end: the elongation is that of the part beyond. The same with a hanger hinged on.
    let mut b = ModelBuilder::new();
    let m =
        b.material(Material { strain: StrainMeasure::Engineering, ..Material::new("m", 1e9, 1e3) });
    let s = b.section(Section::rectangle("s", 0.1, 0.1));
    let bar = b.beam(beam("bar", [0.0, 0.0], [1.0, 0.0], 4, m, s));
    hold(&mut b, at("clamp", bar, 0.3), SupportKind::Clamp);
    b.load(Load::new("pull", point_load(at("end", bar, 1.0), [1e3, -1.0], 0.0)));
    b.record_point(at("end", bar, 1.0));
    let found = equilibrium(&b.build().unwrap()).unwrap();
    let (exact, moved) = (1e3 * 0.7 / 1e7, found.points[0].1[0]);
    assert!((moved / exact - 1.0).abs() < 1e-4, "{moved} {exact}"); // the deflection shortens it a little
    let force = &found.section_forces[0];
    let reaction = reaction(&found, "clamp");
    assert!(close(force.shear.largest().value.abs(), reaction[1].abs(), 1e3));
    assert!(close(force.moment.largest().value.abs(), reaction[2].abs(), 1e3));
}

/// The forces at both ends of a beam compared with the reactions of its supports, in random scenes with masses inside elements, loads and contacts:
/// every row of every scheme whose reactions are those of the instant of its section forces.
#[test]
fn forces_at_supports_are_reactions_in_random_scenes() {
    for seed in 0..12 {
        let mut draw = common::numbers::Numbers(seed);
        let mut between = |a: f64, b: f64| draw.between(a, b);
        let mut b = ModelBuilder::new();
        let m = b.material(Material::new("m", between(1e9, 2e11), between(1e3, 8e3)));
        let s = b.section(Section::rectangle("s", 0.05, between(0.02, 0.06)));
        let elements = 2 + (seed % 5) as usize;
        let end = [between(0.8, 1.2), between(-0.6, 0.6)];
        let arm = b.beam(beam("arm", [0.0, 0.0], end, elements, m, s));
        hold(&mut b, at("a", arm, 0.0), SupportKind::Clamp);
        hold(
            &mut b,
            at("z", arm, 1.0),
            [SupportKind::Clamp, SupportKind::Pin][(seed % 2) as usize].clone(),
        );
        b.load(Load::new("g", LoadKind::Gravity { acceleration: [between(-5.0, 5.0), -9.81] }));
        b.load(Load::new("q", line_load(arm, [between(-50.0, 50.0), between(-400.0, 0.0)])));
        b.point_mass(PointMass {
            name: "m".into(),
            at: at("m", arm, between(0.1, 0.9)),
            mass: between(0.1, 2.0),
            rotary_inertia: between(0.0, 1e-3),
        });
        let kind = ProjectileKind::spring(between(1e4, 1e6));
        let struck = at("struck", arm, between(0.1, 0.9));
        b.projectile(Projectile {
            local_mass: between(0.5, 5.0),
            ..Projectile::new("p", kind, between(0.5, 5.0), [0.0, -between(0.5, 3.0)], struck)
        });
        b.record_point(at("a", arm, 0.0));
        b.record_point(at("z", arm, 1.0));
        let model = b.build().unwrap();
        let scheme =
            [Scheme::EnergyMomentum, Scheme::StrainRate, Scheme::Midpoint][(seed % 3) as usize];
        let mut log = Columns::default();
        let settings = Settings { scheme, ..Settings::new(0.01, 5e-5) };
        simulate(&model, &settings, &mut log).unwrap();
        for (end, sign) in [("a", 1.0), ("z", -1.0)] {
            let own = |what: &str| log.of(&format!("section.{end}.{what}"));
            let support = |what: &str| log.of(&format!("support.{end}.{what}"));
            let (axial, shear) = (own("axial"), own("shear"));
            let (one, two) = (support("force_1"), support("force_2"));
            let size = |k: usize| one[k].hypot(two[k]);
            let peak = (1..one.len()).map(size).fold(0.0, f64::max);
            for k in 1..one.len() {
                // Whatever way the end points: the resultants have the size of the reaction, and the moments agree.
                let off = axial[k].hypot(shear[k]) - size(k);
                assert!(off.abs() < 1e-6 * peak, "{seed} {scheme:?} {end} {k}: {off} of {peak}");
            }
            let (moment, reaction) = (own("moment"), support("moment"));
            let peak = reaction.iter().fold(0.0, |m: f64, r| m.max(r.abs()));
            for k in 1..moment.len() {
                let off = moment[k] + sign * reaction[k];
                let held = peak > 0.0 && !reaction[k].is_nan();
                assert!(!held || off.abs() < 1e-6 * peak, "{seed} {end} {k}: {off} of {peak}");
            }
        }
    }
}

/// A half-sine of a distributed load on a beam of few elements has its largest shear and axial forces between nodes and middles: the reported peaks
/// are those of a fine evaluation along the beam.
#[test]
fn peaks_of_axial_and_shear_force_are_found_between_nodes() {
    let mut b = ModelBuilder::new();
    let m = b.material(Material::new("m", 2e11, 7850.0));
    // Sections without a depth are evaluated in lanes, those with a depth one by one.
    for (name, section) in [
        ("plain", Section::new("plain", 1e-3, 1e-7)),
        ("deep", Section::rectangle("deep", 0.02, 0.05)),
    ] {
        let s = b.section(section);
        let y = if name == "plain" { 0.0 } else { 5.0 };
        let arm = b.beam(beam(name, [0.0, y], [1.0, y + 0.3], 2, m, s));
        let label = |place: &str| format!("{name} {place}");
        hold(&mut b, at(&label("a"), arm, 0.0), SupportKind::Clamp);
        hold(&mut b, at(&label("z"), arm, 1.0), SupportKind::Pin);
        let kind = ProjectileKind::spring(1e6);
        let mut p = Projectile::new(name, kind, 1.0, [0.0, -3.0], at(&label("struck"), arm, 0.31));
        p.local_mass = 0.4;
        b.projectile(p);
        for k in 0..=400 {
            b.record_point(at(&label(&k.to_string()), arm, f64::from(k) / 400.0));
        }
    }
    let model = b.build().unwrap();
    let mut log = Columns::default();
    let run = simulate(&model, &Settings::new(0.01, 1e-5), &mut log).unwrap();
    for forces in &run.section_forces {
        for (what, range) in [("axial", &forces.axial), ("shear", &forces.shear)] {
            let [mut least, mut most] = [f64::INFINITY, f64::NEG_INFINITY];
            for k in 0..=400 {
                for value in log.of(&format!("section.{} {k}.{what}", forces.name)) {
                    (least, most) = (least.min(value), most.max(value));
                }
            }
            let size = most.max(-least);
            // Points are a 200th of an element apart and only show that they do not exceed the peaks.
            assert!(
                range.max.value >= most - 1e-9 * size,
                "{} {what}: {most} {range:?}",
                forces.name
            );
            assert!(
                range.min.value <= least + 1e-9 * size,
                "{} {what}: {least} {range:?}",
                forces.name
            );
            assert!(range.max.value - most < 2e-2 * size && least - range.min.value < 2e-2 * size);
        }
    }
}

/// An arc or a straight free beam, struck by a rigid projectile, with points recorded all along it.
fn struck_beam(arc: bool) -> ModelBuilder {
    let mut b = ModelBuilder::new();
    let young = if arc { 2.1e11 } else { 7e10 };
    let retardation = if arc { 0.0 } else { 1e-4 };
    let material = b.material(Material { retardation, ..Material::new("m", young, 3e3) });
    let section = b.section(Section::rectangle("s", 0.05, 0.02));
    let middle = if arc { [0.4, 0.09] } else { [0.4, 0.0] };
    let mut beam = Beam::new("b", &[[0.0, 0.0], middle, [0.8, 0.0]], 8, material, section);
    beam.curve = if arc { Curve::Arc } else { Curve::Polyline };
    let beam = b.beam(beam);
    if arc {
        hold(&mut b, at("a", beam, 0.0), SupportKind::Clamp);
        hold(&mut b, at("z", beam, 1.0), SupportKind::Clamp);
    }
    for k in 0..=40 {
        b.record_point(at(&format!("p{k}"), beam, f64::from(k) / 40.0));
    }
    let struck = at("struck", beam, 0.5493);
    b.projectile(Projectile { mass: 1.0, standoff: 0.0, ..rigid("p", struck, [2.0, -4.0], 0.7) });
    b
}

#[test]
fn no_recorded_point_shows_more_than_the_extremes_of_its_beam() {
    for arc in [false, true] {
        let model = struck_beam(arc).build().unwrap();
        let (rows, run) = Rows::of(&model, &Settings::new(2e-3, 2e-5));
        let reported = &run.section_forces[0];
        let ranges = [
            ("axial", &reported.axial),
            ("shear", &reported.shear),
            ("moment", &reported.moment),
            ("stress", &reported.stress),
        ];
        for (what, range) in ranges {
            let size = range.max.value.abs().max(range.min.value.abs());
            let columns = rows.names.iter().enumerate().filter(|(_, name)| {
                name.starts_with("section.") && name.ends_with(&format!(".{what}"))
            });
            let mut count = 0;
            for (k, name) in columns {
                count += 1;
                for row in &rows.rows {
                    let beyond = (row[k] - range.max.value).max(range.min.value - row[k]);
                    assert!(beyond <= 1e-4 * size, "{name}: {} beyond {range:?}", row[k]);
                }
            }
            assert_eq!(count, 42, "{what}");
        }
    }
}
