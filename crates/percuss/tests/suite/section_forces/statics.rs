//! Section forces of equilibria, and stresses of sections that vary.

use super::*;

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
        properties: Default::default(),
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
