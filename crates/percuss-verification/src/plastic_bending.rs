//! Beams that yield in pure bending, and a ring closed by an explosion.

use percuss::*;

use crate::check::{Checks, Report};
use crate::structure::{at, or_nan};
use crate::yielding::{balances, perfect, yields};

/// The cantilever of ANSYS LS-DYNA's verification case 003.
const YOUNG: f64 = 200e9;
const LIMIT: f64 = 1300e6;
const LENGTH: f64 = 0.05;
const WIDTH: f64 = 3e-3;
const DEPTH: f64 = 5e-3;

/// The cantilever under an end moment.
fn bent(section: Section, moment: f64) -> Option<Equilibrium> {
    let mut b = ModelBuilder::new();
    let metal = b.material(perfect(YOUNG, 7800.0, LIMIT));
    let section = b.section(section);
    let arm = b.beam(Beam::new("arm", &[[0.0, 0.0], [LENGTH, 0.0]], 8, metal, section));
    b.support(Support::new("root", at("root", arm, 0.0), SupportKind::Clamp));
    let tip = at("tip", arm, 1.0);
    b.record_point(tip.clone());
    let kind = LoadKind::Point { at: tip, force: [0.0; 2], moment, follower: false };
    b.load(Load::new("end", kind));
    equilibrium(&b.build().expect("a verification case builds")).ok()
}

fn rectangle(fibres: usize) -> Section {
    Section { fibres, ..Section::rectangle("rectangle", WIDTH, DEPTH) }
}

/// Moment and curvature of a rectangle, `M/M0 = 1 - (ky/k)^2 / 3` beyond yield, `ky = 2 sy / (E h)`; the bent line is an arc.
pub fn moment_and_curvature() -> Report {
    let mut c = Checks::new();
    let most = LIMIT * WIDTH * DEPTH * DEPTH / 4.0;
    let first = 2.0 * LIMIT / (YOUNG * DEPTH);
    let curvature = |share: f64| {
        if share <= 2.0 / 3.0 { 1.5 * share * first } else { first / (3.0 * (1.0 - share)).sqrt() }
    };
    let measured = |fibres: usize, share: f64| {
        let found = bent(rectangle(fibres), share * most);
        let [u, w] = found.map_or([f64::NAN; 2], |found| found.points[0].1);
        // The angle of an arc is twice that of its chord.
        2.0 * w.atan2(LENGTH + u) / LENGTH
    };
    for fibres in [16_u32, 32, 64, 128] {
        for share in [0.6, 0.7, 0.75, 0.8, 0.85, 0.9, 0.95] {
            let what = format!("{fibres} fibres, M = {share} M0: curvature [1/m]");
            let exact = curvature(share);
            // Fibres give Gauss sums in the elastic range; beyond it, the error decreases with the square of the number of fibres in the elastic
            // core, ky/k of the depth, and is at most 1.92 divided by this square.
            let elastic = first / exact * f64::from(fibres);
            let close = if share < 2.0 / 3.0 { 1e-9 } else { 2.0 / elastic.powi(2) };
            c.relative(what, measured(fibres as usize, share), exact, close);
        }
    }
    // ANSYS LS-DYNA verification case 003: a moment of 22 N m.
    let found = bent(rectangle(128), 22.0);
    let [u, w] = found.map_or([f64::NAN; 2], |found| found.points[0].1);
    let angle = curvature(22.0 / most) * LENGTH;
    let radius = LENGTH / angle;
    for (name, measured, exact, published) in [
        ("projected length [mm]", LENGTH + u, radius * angle.sin(), 49.52),
        ("deflection [mm]", w, radius * (1.0 - angle.cos()), 5.982),
    ] {
        c.relative(format!("22 N m: {name}"), 1e3 * measured, 1e3 * exact, 2e-4);
        c.relative(format!("22 N m: {name}, published"), 1e3 * measured, published, 3e-4);
    }
    c.into_report()
}

/// Plastic moments, found by bisection: the largest moment with an equilibrium.
///
/// Sections of 16 fibres, whose plastic moment is exact; 0.1 % to 0.25 % below it only the innermost fibres are elastic, and the bending of a bar
/// exceeds what eight elements can represent.
pub fn plastic_moments() -> Report {
    let mut c = Checks::new();
    let (d, i) = (5e-3_f64, 4e-3_f64);
    let shapes = [
        (Section::rectangle("rectangle", 3e-3, d), 3e-3 * d * d / 4.0),
        (Section::circle("circle", d), d.powi(3) / 6.0),
        (Section::tube("tube", d, 0.5 * (d - i)), (d.powi(3) - i.powi(3)) / 6.0),
        (Section::hollow_box("box", 3e-3, d, 0.5e-3), (3e-3 * d * d - 2e-3 * i * i) / 4.0),
        (Section::i_shape("i", 3e-3, d, 0.5e-3, 0.4e-3), (3e-3 * d * d - 2.6e-3 * i * i) / 4.0),
    ];
    for (shape, modulus) in shapes {
        let name = shape.name.clone();
        let borne = |share: f64| bent(shape.clone(), share * LIMIT * modulus).is_some();
        let (mut low, mut high) = (0.5, 2.0);
        for _ in 0..12 {
            let middle = 0.5 * (low + high);
            *(if borne(middle) { &mut low } else { &mut high }) = middle;
        }
        c.absolute(format!("{name}: largest moment over sy Z"), low, 1.0, 3e-3);
    }
    c.into_report()
}

/// Half a ring of aluminium closed by sheet explosive: its least diameter \[m\] and the time of it \[s\], and its diameter at 1.35 ms \[m\].
fn ring(metal: Material, elements: usize) -> ([f64; 3], RunSummary) {
    let radius = 0.5 * (0.1524 - 0.00315);
    let mut b = ModelBuilder::new();
    let metal = b.material(metal);
    let section = b.section(Section::rectangle("wall", 0.03036, 0.00315));
    let points = [[0.0, radius], [radius, 0.0], [0.0, -radius]];
    let curve = Curve::Arc;
    let ring = b.beam(Beam { curve, ..Beam::new("ring", &points, elements, metal, section) });
    for (name, f) in [("top", 0.0), ("bottom", 1.0)] {
        let components = vec![Component::Displacement1, Component::Rotation];
        b.support(Support::new(name, at(name, ring, f), SupportKind::Fix { components }));
        b.record_point(at(name, ring, f));
    }
    let model = b.build().expect("a verification case builds");
    let mut run = Simulation::new(&model, &Settings::new(1.6e-3, 4e-6)).expect("valid settings");
    run.set_velocities(|_, [x, y]| {
        // Inwards; straight lines between nodes 10 degrees apart, as in the benchmark.
        let angle = x.atan2(y).to_degrees();
        let between = |from: f64, [a, b]: [f64; 2]| a + (b - a) * (angle - from) / 10.0;
        let speed = match angle {
            ..=50.0 => 174.1,
            50.0..=60.0 => between(50.0, [174.1, 130.55]),
            60.0..=70.0 => between(60.0, [130.55, 0.0]),
            _ => 0.0,
        };
        [-speed * x / radius, -speed * y / radius]
    });
    let mut rows = MemoryRecorder::default();
    let summary = run.run(&mut rows);
    let column = |name: &str| rows.column(name).unwrap_or_default();
    let (top, bottom) = (column("point.top.displacement_2"), column("point.bottom.displacement_2"));
    let diameter = |(a, b): (&f64, &f64)| 2.0 * radius + a - b;
    let diameters: Vec<f64> = top.iter().zip(&bottom).map(diameter).collect();
    let time = column("time");
    let each = diameters.iter().zip(&time);
    let (least, when) =
        each.fold(
            (f64::INFINITY, f64::NAN),
            |(least, when), (d, t)| {
                if *d < least { (*d, *t) } else { (least, when) }
            },
        );
    let then = diameters.get(time.partition_point(|t| *t < 1.35e-3));
    ([least, when, or_nan(then.copied())], summary)
}

/// A free ring under sheet explosive over 120 degrees (Clark et al. 1962), as in Abaqus' benchmark: aluminium 6061-T6 with hardening or with rate
/// dependence.
///
/// Its results are published as curves, from which a diameter can be read to about 5 mm: 60 and 80 mm, from 1.3 to 1.4 ms on. The curve with
/// hardening is flat there.
pub fn explosive_ring() -> Report {
    let mut c = Checks::new();
    let (young, density, limit, tangent) = (72.4e9, 2672.0, 295.1e6, 542.6e6);
    let hardens = |modulus: f64| vec![Hardening { from: 0.0, stress: limit, modulus }];
    let slow = yields(young, density, hardens(tangent * young / (young - tangent)), |_| {});
    let law = Overstress { rate: 6500.0, exponent: 4.0 };
    let rate = yields(young, density, hardens(0.0), |p| p.overstress = Some(law));
    for (name, metal, diameter) in [("hardening", slow, 60.0), ("rate", rate.clone(), 80.0)] {
        for elements in [18, 36] {
            let ([least, when, then], summary) = ring(metal.clone(), elements);
            let what = format!("{name}, {elements} elements");
            c.absolute(format!("{what}: least diameter [mm]"), 1e3 * least, diameter, 5.0);
            c.absolute(format!("{what}: diameter at 1.35 ms [mm]"), 1e3 * then, diameter, 5.0);
            if name == "rate" {
                c.absolute(format!("{what}: its time [ms]"), 1e3 * when, 1.35, 0.05);
            }
            balances(&mut c, &what, &summary);
        }
    }
    // Elements of 10, 5 and 2.5 degrees: changes decrease to a third.
    let [a, b, d] = [18, 36, 72].map(|elements| 1e3 * ring(rate.clone(), elements).0[0]);
    c.at_most("rate: 36 to 72 elements over 18 to 36, change", (d - b).abs() / (b - a).abs(), 0.5);
    c.into_report()
}
