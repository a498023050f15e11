//! Extremes along beams and over time, and random scenes.

use super::*;

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
