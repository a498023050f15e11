//! Which equilibrium statics gives near bifurcations, what just touches in linear buckling, paths over jumps of stiffness, supports that have moved.

use crate::common;

use common::*;
use percuss::*;

const WHOLE: [Along; 2] = [Along::Fraction(0.0), Along::Fraction(1.0)];

/// A square bar of steel of 2 m on the axis; its buckling temperature between pins is pi^2 I/(A L^2 alpha) = 42.8 K.
fn bar(b: &mut ModelBuilder, theory: Theory) -> BeamId {
    let material = Material {
        strain: StrainMeasure::Engineering,
        expansion: 12e-6,
        poisson: Some(0.3),
        ..Material::new("steel", 2.1e11, 7850.0)
    };
    let material = b.material(material);
    let section = b.section(Section::rectangle("square", 0.05, 0.05));
    let plain = beam("bar", [0.0, 0.0], [2.0, 0.0], 16, material, section);
    let bar = b.beam(Beam { theory, ..plain });
    b.record_point(at("mid", bar, 0.5));
    bar
}

fn pinned(b: &mut ModelBuilder, bar: BeamId) {
    for (name, f) in [("left", 0.0), ("right", 1.0)] {
        b.support(Support::new(name, at(name, bar, f), SupportKind::Pin));
    }
}

fn heat(b: &mut ModelBuilder, bar: BeamId, change: f64, function: TimeFunction) {
    let kind = LoadKind::Temperature { beam: bar, stretch: WHOLE, change, gradient: 0.0 };
    b.load(Load { function, ..Load::new("heat", kind) });
}

#[test]
fn a_heated_strut_bows_down_under_its_weight_at_every_temperature() {
    for theory in [Theory::Slender, Theory::Shear] {
        for change in (9..=40).map(|k| 5.0 * f64::from(k)) {
            let mut b = ModelBuilder::new();
            let bar = bar(&mut b, theory);
            pinned(&mut b, bar);
            heat(&mut b, bar, change, TimeFunction::Constant);
            b.load(Load::new("weight", LoadKind::Gravity { acceleration: [0.0, -9.81] }));
            let found = equilibrium(&b.build().unwrap()).unwrap();
            let down = -found.points[0].1[1];
            // w = 2 L/pi sqrt(eps - eps_cr) without weight.
            let strain: f64 = 12e-6 * change - 5.14e-4;
            let bow = 4.0 / std::f64::consts::PI * strain.max(0.0).sqrt();
            assert!(found.stable && down > bow.max(5e-3), "{theory:?} {change} K: {down} {bow}");
            assert!(down < bow + 9e-3, "{theory:?} {change} K: {down} {bow}");
        }
    }
}

#[test]
fn a_shortened_strut_bows_to_the_side_of_its_lateral_load() {
    for shortening in [0.8e-3, 1.2e-3, 1.7e-3, 2.4e-3, 3.1e-3] {
        let mut b = ModelBuilder::new();
        let bar = bar(&mut b, Theory::Slender);
        b.support(Support::new("left", at("left", bar, 0.0), SupportKind::Pin));
        let mut end = Support::new("right", at("right", bar, 1.0), SupportKind::Pin);
        let displacement = [-shortening, 0.0];
        let function = TimeFunction::Constant;
        end.motion = Some(Motion { displacement, rotation: 0.0, function });
        b.support(end);
        let force = [0.0, -100.0];
        let kind = LoadKind::Point { at: at("p", bar, 0.5), force, moment: 0.0, follower: false };
        b.load(Load::new("lateral", kind));
        let found = equilibrium(&b.build().unwrap()).unwrap();
        assert!(found.stable && found.points[0].1[1] < 0.0, "{shortening}: {:?}", found.points);
    }
}

/// Loads across that hardly round off the bifurcation: the strut bows to their side all the same, by 2 L/pi sqrt(eps - eps_cr) between clamps.
#[test]
fn a_strut_bows_to_the_side_of_small_loads() {
    let cases = [
        (Theory::Slender, SupportKind::Clamp, 3.304751462171244e-3, 0.75, -0.020024413826103257),
        (Theory::Slender, SupportKind::Clamp, 3.12e-3, 0.3, -0.1),
        (Theory::Slender, SupportKind::Clamp, 3.12e-3, 0.3, 1e-3),
        (Theory::Shear, SupportKind::Pin, 2.690441289979888e-3, 0.2, -1.2606553978389305e-3),
        (Theory::Shear, SupportKind::Clamp, 4e-3, 0.4, 5e-3),
    ];
    for (theory, kind, strain, place, force) in cases {
        let mut b = ModelBuilder::new();
        let bar = bar(&mut b, theory);
        let buckling: f64 = if kind == SupportKind::Pin { 5.14e-4 } else { 2.056e-3 };
        let bow = 4.0 / std::f64::consts::PI * (strain - buckling).sqrt();
        for (name, f) in [("left", 0.0), ("right", 1.0)] {
            b.support(Support::new(name, at(name, bar, f), kind.clone()));
        }
        let given = LoadKind::Strain { beam: bar, stretch: WHOLE, strain, curvature: 0.0 };
        b.load(Load::new("swelling", given));
        let force = [0.0, force];
        let across =
            LoadKind::Point { at: at("p", bar, place), force, moment: 0.0, follower: false };
        b.load(Load::new("across", across));
        let found = equilibrium(&b.build().unwrap()).unwrap();
        let moved = found.points[0].1[1] * force[1].signum();
        assert!(
            found.stable && (moved / bow - 1.0).abs() < 0.02,
            "{theory:?} {force:?}: {moved} {bow}"
        );
    }
}

/// The response before the bifurcation has no displacement; linear buckling gives 2.1385 for 20 K.
#[test]
fn a_path_of_a_heated_straight_strut_has_its_bifurcation() {
    for theory in [Theory::Slender, Theory::Shear] {
        let mut b = ModelBuilder::new();
        let bar = bar(&mut b, theory);
        pinned(&mut b, bar);
        heat(&mut b, bar, 20.0, TimeFunction::Constant);
        let model = b.build().unwrap();
        let factor = buckling(&model, 1).modes[0].factor;
        let settings = PathSettings { end: PathEnd::Factor(4.0), ..PathSettings::default() };
        let path = equilibrium_path(&model, &settings).unwrap();
        assert!(path.reached, "{theory:?}");
        let found = path.bifurcations[0].factor;
        assert!((found / factor - 1.0).abs() < 1e-4, "{theory:?}: {found} {factor}");
        assert!(path.points.iter().all(|p| p.stable == (p.factor < found)), "{theory:?}");
    }
}

/// A column that buckles away from a tie without slack, which does not move under the load.
#[test]
fn a_tie_that_just_touches_does_not_hold_a_column() {
    let factor = |load: f64, law: SpringLaw| {
        let mut b = ModelBuilder::new();
        let material =
            Material { strain: StrainMeasure::Engineering, ..Material::new("m", 2e11, 7850.0) };
        let material = b.material(material);
        let section = b.section(Section::rectangle("s", 0.05, 0.05));
        let column = b.beam(beam("column", [0.0, 0.0], [0.0, 2.0], 16, material, section));
        b.support(Support::new("foot", at("foot", column, 0.0), SupportKind::Pin));
        let roller = SupportKind::Roller { direction: [0.0, 1.0] };
        b.support(Support::new("head", at("head", column, 1.0), roller));
        let force = [0.0, -load];
        let kind =
            LoadKind::Point { at: at("t", column, 1.0), force, moment: 0.0, follower: false };
        b.load(Load::new("load", kind));
        let mid = Anchor::Point(at("mid", column, 0.5));
        b.spring(Spring {
            name: "tie".into(),
            between: [mid, Anchor::Ground([-1.0, 1.0])],
            law,
            damping: 0.0,
            length: None,
            strength: None,
            yielding: None,
        });
        let model = b.build().unwrap();
        let found = equilibrium(&model).unwrap();
        let all = buckling_in_contact(&model, &found, 1);
        (all.modes[0].factor * load, all)
    };
    // Euler's load is pi^2 EI/L^2 = 257.0 kN, four times that with the tie as a support.
    for law in [
        SpringLaw::Tension { stiffness: 1e9, slack: 0.0 },
        SpringLaw::Compression { stiffness: 1e9, gap: 0.0 },
    ] {
        // 600 kN is more than Euler's load: the factor is of the reference configuration, and in proportion to the load.
        for load in [10.0, 1e3, 1e5, 6e5] {
            let (found, all) = factor(load, law.clone());
            assert!((found / 257.02e3 - 1.0).abs() < 1e-3, "{law:?} {load}: {found}");
            let touching = all.touching.unwrap();
            assert!(touching.count == 1 && touching.slack, "{touching:?}");
            assert!((touching.other * load / 1028.1e3 - 1.0).abs() < 1e-3, "{touching:?}");
            assert!(all.assumptions()[0].contains("just touches"), "{:?}", all.assumptions());
        }
    }
}

/// A clamped beam whose tip meets a stiff stop, 1 mm away: (16 mm - 1 mm)/(1/39062.5 + 1e-7) = 583.66 N in the stop at the end.
#[test]
fn a_path_goes_on_where_a_stiff_stop_closes() {
    let build = || {
        let mut b = ModelBuilder::new();
        let material = b.material(Material::new("m", 2e11, 7850.0));
        let section = b.section(Section::rectangle("s", 0.05, 0.05));
        let arm = b.beam(beam("arm", [0.0, 0.0], [2.0, 0.0], 6, material, section));
        b.support(Support::new("root", at("root", arm, 0.0), SupportKind::Clamp));
        let kind = SupportKind::Stop {
            direction: [0.0, 1.0],
            gap: 1e-3,
            stiffness: 1e7,
            two_sided: false,
        };
        b.support(Support::new("stop", at("stop", arm, 1.0), kind));
        let (point, force) = (at("mid", arm, 0.5), [0.0, 2000.0]);
        let kind = LoadKind::Point { at: point, force, moment: 0.0, follower: false };
        b.load(Load::new("load", kind));
        b.record_point(at("tip", arm, 1.0));
        b.build().unwrap()
    };
    for first in [0.3, 0.05, 0.01, 1e-3] {
        let settings = PathSettings { first, ..PathSettings::default() };
        let path = equilibrium_path(&build(), &settings).unwrap();
        assert!(path.reached, "{first}: {:?}", path.points.last());
        let [_, force, _] = path.end.reactions[1].1;
        assert!((force / -583.66 - 1.0).abs() < 1e-4, "{first}: {force}");
        assert!(path.limit_points.is_empty() && path.points.len() < 60, "{}", path.points.len());
    }
}

/// A spring of one side that does not touch the part that a joint leaves to hang from its pin.
#[test]
fn a_torn_joint_leaves_what_hangs_whatever_springs_there_are_elsewhere() {
    for law in [None, Some(SpringLaw::Compression { stiffness: 1e5, gap: 0.0 })] {
        let mut b = ModelBuilder::new();
        let material = b.material(Material::new("m", 2e11, 7850.0));
        let section = b.section(Section::rectangle("s", 0.05, 0.05));
        let one = b.beam(beam("one", [0.0, 0.0], [1.0, 0.0], 4, material, section));
        let two = b.beam(beam("two", [1.0, 0.0], [2.0, 0.0], 4, material, section));
        b.joint(Joint {
            name: "joint".into(),
            kind: JointKind::Hinge,
            between: [at("a", one, 1.0), at("b", two, 0.0)],
            yielding: None,
            strength: Some(JointStrength { force: Some(300.0), moment: None }),
        });
        b.support(Support::new("root", at("root", one, 0.0), SupportKind::Clamp));
        b.support(Support::new("tie", at("tie", two, 1.0), SupportKind::Pin));
        let (point, force) = (at("mid", two, 0.5), [0.0, -1e3]);
        let kind = LoadKind::Point { at: point.clone(), force, moment: 0.0, follower: false };
        b.load(Load::new("load", kind));
        b.record_point(point);
        if let Some(law) = law {
            b.spring(Spring {
                name: "prop".into(),
                between: [Anchor::Point(at("m", one, 0.5)), Anchor::Ground([0.5, -1.0])],
                law,
                damping: 0.0,
                length: None,
                strength: None,
                yielding: None,
            });
        }
        let found = equilibrium(&b.build().unwrap()).unwrap();
        assert_eq!(found.failures[0].name, "joint.joint");
        assert!((found.failures[0].factor - 0.5).abs() < 0.1, "{:?}", found.failures);
        assert!((found.points[0].1[1] + 0.5).abs() < 1e-3, "it hangs: {:?}", found.points);
    }
}

/// Heat of a bar between walls counts in modes about the reference, whatever the size of the bar; a gradient that bends it leaves all of it out.
#[test]
fn modes_with_heat_do_not_depend_on_the_scale() {
    let lowest = |scale: f64, gradient: f64| {
        let mut b = ModelBuilder::new();
        let material = Material {
            strain: StrainMeasure::Engineering,
            expansion: 12e-6,
            ..Material::new("steel", 2.1e11, 7850.0)
        };
        let material = b.material(material);
        let section = b.section(Section::rectangle("square", 0.05 * scale, 0.05 * scale));
        let bar = b.beam(beam("bar", [0.0, 0.0], [2.0 * scale, 0.0], 16, material, section));
        pinned(&mut b, bar);
        let gradient = gradient / scale;
        let kind = LoadKind::Temperature { beam: bar, stretch: WHOLE, change: 20.0, gradient };
        b.load(Load::new("heat", kind));
        let model = b.build().unwrap();
        let state = reference_state(&model).unwrap();
        modes_about(&model, &state, 1)[0].frequency() * scale
    };
    for gradient in [0.0, 1e-6, 1e-4, 1e-3, 1e-2, 1.0, 100.0] {
        let plain = lowest(1.0, gradient);
        for scale in [1e-3, 1e3] {
            let other = lowest(scale, gradient);
            assert!((other / plain - 1.0).abs() < 1e-6, "{gradient} {scale}: {other} {plain}");
        }
    }
}

/// A girder over two spans whose middle support has settled by 10 mm, rigid or elastic: 3 EI d/l^2 = 26.25 kN m, in statics as in a run from either start.
#[test]
fn a_support_that_has_moved_means_the_same_in_statics_and_runs() {
    let build = |kind: SupportKind| {
        let mut b = ModelBuilder::new();
        let material = b.material(Material::new("m", 2.1e11, 1.0));
        let section = b.section(Section::rectangle("s", 0.1, 0.2));
        let girder = b.beam(beam("girder", [0.0, 0.0], [8.0, 0.0], 8, material, section));
        b.support(Support::new("left", at("left", girder, 0.0), SupportKind::Pin));
        let mut middle = Support::new("middle", at("middle", girder, 0.5), kind);
        let function = TimeFunction::Constant;
        middle.motion = Some(Motion { displacement: [0.0, -0.01], rotation: 0.0, function });
        b.support(middle);
        let roller = SupportKind::Roller { direction: [1.0, 0.0] };
        b.support(Support::new("right", at("right", girder, 1.0), roller));
        b.build().unwrap()
    };
    let elastic = SupportKind::Elastic {
        direction: [1.0, 0.0],
        stiffness: [0.0, 1e12],
        damping: [0.0; 2],
        rotational_stiffness: 0.0,
        rotational_damping: 0.0,
    };
    for kind in [SupportKind::Roller { direction: [1.0, 0.0] }, elastic] {
        let model = build(kind.clone());
        let near =
            |moment: f64| assert!((moment / 26.25e3 - 1.0).abs() < 1e-3, "{kind:?} {moment}");
        near(equilibrium(&model).unwrap().section_forces[0].moment.largest().value);
        for start in [Start::Reference, Start::Static] {
            let settings = Settings { start, ..Settings::new(0.05, 1e-3) };
            let run = simulate(&model, &settings, &mut NoRecorder).unwrap();
            near(run.section_forces[0].moment.largest().value);
        }
    }
    // A beam that a pin alone holds has no such equilibrium.
    let mut b = ModelBuilder::new();
    let (material, section) = plank(&mut b);
    let free = b.beam(beam("free", [0.0, 0.0], [1.0, 0.0], 2, material, section));
    let mut pin = Support::new("pin", at("pin", free, 0.0), SupportKind::Pin);
    let function = TimeFunction::Harmonic { frequency: 1.0, phase: 1.0 };
    pin.motion = Some(Motion { displacement: [0.0, 0.1], rotation: 0.0, function });
    b.support(pin);
    let model = b.build().unwrap();
    let faults = simulate(&model, &Settings::new(0.1, 1e-3), &mut NoRecorder).unwrap_err();
    assert_eq!(faults[0].path, "support.pin.motion");
}

/// A gapless stop of both sides is an elastic support, in modes and in linear buckling, too.
#[test]
fn a_stop_of_both_sides_without_a_gap_is_a_spring() {
    let build = |kind: SupportKind| {
        let mut b = ModelBuilder::new();
        let (material, section) = plank(&mut b);
        let column = b.beam(beam("column", [0.0, 0.0], [0.0, 2.0], 8, material, section));
        b.support(Support::new("foot", at("foot", column, 0.0), SupportKind::Pin));
        let roller = SupportKind::Roller { direction: [0.0, 1.0] };
        b.support(Support::new("head", at("head", column, 1.0), roller));
        b.support(Support::new("mid", at("mid", column, 0.5), kind));
        let (point, force) = (at("top", column, 1.0), [0.0, -1.0]);
        let load = LoadKind::Point { at: point, force, moment: 0.0, follower: false };
        b.load(Load::new("load", load));
        b.build().unwrap()
    };
    let stiffness = 1e6;
    let stop = SupportKind::Stop { direction: [1.0, 0.0], gap: 0.0, stiffness, two_sided: true };
    let elastic = SupportKind::Elastic {
        direction: [1.0, 0.0],
        stiffness: [stiffness, 0.0],
        damping: [0.0; 2],
        rotational_stiffness: 0.0,
        rotational_damping: 0.0,
    };
    let [stop, elastic] = [stop, elastic].map(build);
    let lowest = |model: &Model| {
        let about = reference_state(model).unwrap();
        let found = equilibrium(model).unwrap();
        assert!(found.stable);
        let buckling = buckling_in_contact(model, &found, 1);
        assert!(buckling.assumptions().is_empty());
        [modes_about(model, &about, 1)[0].frequency(), buckling.modes[0].factor]
    };
    assert_eq!(lowest(&stop), lowest(&elastic));
}
