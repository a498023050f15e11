use super::*;
use crate::element::beam::ShearedPlace;
use crate::element::point::SectionLaw;
use crate::element::strain::StrainMeasure;

const LENGTH: f64 = 0.3;

fn section(axial: f64, shear: f64, bending: f64) -> SectionValues {
    let law = SectionLaw { axial, bending, rotary: 0.01, measure: StrainMeasure::Engineering };
    let none = f64::NAN;
    SectionValues {
        law,
        shear,
        mass: 2.0,
        area: none,
        inertia: none,
        young: none,
        density: none,
        half_depth: none,
        sheared: [ShearedPlace::UNKNOWN; 2],
    }
}

/// A bent element that is not aligned with the axes.
fn element() -> ShearTable {
    let frame = |position, angle: f64| NodeFrame { position, tangent: [angle.cos(), angle.sin()] };
    let ends = [frame([0.1, -0.2], 0.4), frame([0.37, -0.08], 0.7)];
    ShearTable::new(LENGTH, ends, &section(400.0, 150.0, 4.0))
}

fn values(x: [f64; 6]) -> ElementValues<f64> {
    let [c1, c2, a1, a2, b1, b2] = x;
    ElementValues { chord: [c1, c2], slope_a: [a1, a2], slope_b: [b1, b2] }
}

const START: [f64; 6] = [0.02, -0.05, 0.1, -0.3, -0.2, 0.15];
const STEP: [f64; 6] = [-0.07, 0.04, 0.3, 0.2, -0.1, 0.25];

fn energy(table: &ShearTable, x: [f64; 6]) -> f64 {
    0.5 * table.energies(&values(x)).iter().sum::<f64>()
}

/// The displacement of an element that turns and moves as a rigid body.
fn turned(table: &ShearTable, angle: f64) -> [f64; 6] {
    let (cosine, sine) = (angle.cos(), angle.sin());
    let by = |[x, y]: [f64; 2]| [(cosine - 1.0) * x - sine * y, sine * x + (cosine - 1.0) * y];
    let [c, a, b] = [table.chord, table.directors[0], table.directors[1]].map(by);
    [c[0], c[1], a[0], a[1], b[0], b[1]]
}

#[test]
fn rigid_motions_do_not_strain_it() {
    let table = element();
    for angle in [1e-3, 0.5, 3.0] {
        let strains = table.strains(&values(turned(&table, angle)));
        for strain in strains.linear.into_iter().chain([strains.square]) {
            assert!(strain.abs() < 1e-14, "{angle}: {strain:e}");
        }
    }
}

#[test]
fn forces_of_a_step_do_the_work_of_its_energy() {
    let table = element();
    let end: [f64; 6] = std::array::from_fn(|i| START[i] + STEP[i]);
    let sums = table.mean::<f64, false>(&values(START), &values(STEP), 0.0);
    let work: f64 = sums.force.iter().zip(STEP).map(|(f, d)| f * d).sum();
    let gained = energy(&table, end) - energy(&table, START);
    assert!((work - gained).abs() < 1e-13 * gained.abs(), "{work:e} {gained:e}");
    // A step with a retardation time loses that times the squares of the changes.
    let lag = 0.3;
    let damped = table.mean::<f64, false>(&values(START), &values(STEP), lag);
    let lost: f64 = damped.force.iter().zip(STEP).map(|(f, d)| f * d).sum::<f64>() - work;
    let expected = lag * table.viscous_loss(&values(START), &values(end));
    assert!(expected > 0.0 && (lost - expected).abs() < 1e-12 * expected, "{lost:e} {expected:e}");
}

/// A bar along the first axis, or an arc that turns by an angle in the reference.
fn bar(angle: f64) -> ShearTable {
    let half = 0.5 * angle;
    let chord = if angle == 0.0 { LENGTH } else { LENGTH * half.sin() / half };
    let frame =
        |x: f64, angle: f64| NodeFrame { position: [x, 0.0], tangent: [angle.cos(), angle.sin()] };
    let ends = [frame(0.0, -half), frame(chord, half)];
    ShearTable::new(LENGTH, ends, &section(400.0, 150.0, 4.0))
}

#[test]
fn an_arc_has_no_stretch_and_the_energy_of_its_turning_to_fourth_order() {
    let straight = bar(0.0);
    for angle in [0.8, 0.4, 0.2] {
        let arc = bar(angle);
        let to = |k: usize| sub(arc.directors[k], straight.directors[k]);
        let ([a1, a2], [b1, b2]) = (to(0), to(1));
        let [c1, c2] = sub(arc.chord, straight.chord);
        let u = values([c1, c2, a1, a2, b1, b2]);
        // Series of sin(t)/t - 1 + (1 - cos t)/3 and of 8/3 (1 - cos t) - 1/3 sin^2 t.
        let [stretch, shear, _] = straight.strains(&u).linear;
        assert!(shear.abs() < 1e-14);
        assert!((stretch / (-f64::powi(angle, 4) / 180.0) - 1.0).abs() < 0.1, "{stretch:e}");
        let [_, _, bending] = straight.energies(&u);
        let missed = bending * LENGTH / 4.0 - angle * angle;
        assert!((missed / (-f64::powi(angle, 6) / 90.0) - 1.0).abs() < 0.1, "{missed:e}");
        // Bent back to a bar it has the same energy.
        let back = values([-c1, -c2, -a1, -a2, -b1, -b2]);
        let [_, _, other] = arc.energies(&back);
        assert!((other / bending - 1.0).abs() < 1e-12, "{other} {bending}");
    }
}

#[test]
fn forces_of_a_step_have_no_resultant_moment() {
    let table = element();
    let [c, a, b] = [table.chord, table.directors[0], table.directors[1]];
    let f = table.mean::<f64, false>(&values(START), &values(STEP), 0.0).force;
    let at = |x: [f64; 2], k: usize| {
        let middle = [0, 1].map(|i| x[i] + START[k + i] + 0.5 * STEP[k + i]);
        cross(middle, [f[k], f[k + 1]])
    };
    let parts = [at(c, 0), at(a, 2), at(b, 4)];
    let gross: f64 = parts.iter().map(|m| m.abs()).sum();
    assert!(parts.iter().sum::<f64>().abs() < 1e-14 * gross, "{parts:?}");
}

/// Forces for an increment.
type Forces<'a> = &'a dyn Fn([f64; 6]) -> ElementSums<f64>;

#[test]
fn tangents_are_the_derivatives_of_the_forces() {
    let table = element();
    let start = values(START);
    let mean: Forces = &|d| table.mean::<f64, true>(&start, &values(d), 0.3);
    let end: Forces = &|d| table.at_end::<f64, true>(&start, &values(d), None);
    for forces in [mean, end] {
        let tangent = forces(STEP).tangent;
        let most = tangent.as_flattened().iter().fold(0.0_f64, |m, k| m.max(k.abs()));
        for j in 0..6 {
            let e = 1e-6;
            let beside = |by: f64| {
                let mut step = STEP;
                step[j] += by;
                forces(step).force
            };
            let (up, down) = (beside(e), beside(-e));
            for i in 0..6 {
                let found = (up[i] - down[i]) / (2.0 * e);
                assert!((tangent[i][j] - found).abs() < 1e-8 * most, "{i} {j}: {found}");
            }
        }
    }
}

#[test]
fn foreseen_strains_are_those_of_a_small_correction_and_turn_with_the_element() {
    let table = element();
    let (start, end) = (values(START), values(std::array::from_fn(|i| START[i] + STEP[i])));
    let small: [f64; 6] = std::array::from_fn(|i| 1e-5 * STEP[5 - i]);
    let after = table.strains(&moved(&end, &values(small), 1.0)).linear;
    let foreseen = table.foresee(&end, &values(small));
    for (found, expected) in foreseen.into_iter().zip(after) {
        assert!((found - expected).abs() < 1e-9, "{found} {expected}");
    }
    assert_eq!(from_stored(&stored(foreseen)), foreseen);
    // Strains of the configuration itself change nothing; others change the tangent alone.
    let own = table.strains(&end).linear;
    let plain = table.at_end::<f64, true>(&start, &values(STEP), None);
    let same = table.at_end::<f64, true>(&start, &values(STEP), Some(own));
    let other = table.at_end::<f64, true>(&start, &values(STEP), Some(own.map(|e| e + 0.1)));
    assert_eq!(plain.force, other.force);
    let apart = |a: &ElementSums<f64>| -> f64 {
        let both = a.tangent.as_flattened().iter().zip(plain.tangent.as_flattened());
        both.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    };
    assert!(apart(&same) < 1e-10 && apart(&other) > 1.0, "{:e}", apart(&same));
    // That of an element about a configuration is the same.
    assert!(apart(&table.tangent(&end, Some(own))) < 1e-10);
}

#[test]
fn one_element_bends_as_a_cantilever_of_any_slenderness() {
    // E = 1, width 1, nu = 0.5: a rectangle of depth h, the length one.
    for depth in [0.5, 0.1, 1e-3] {
        let (axial, bending, shear) = (depth, f64::powi(depth, 3) / 12.0, depth / 3.6);
        let ends =
            [[0.0, 0.0], [1.0, 0.0]].map(|position| NodeFrame { position, tangent: [1.0, 0.0] });
        let table = ShearTable::new(1.0, ends, &section(axial, shear, bending));
        let still = values([0.0; 6]);
        let k = table.at_end::<f64, true>(&still, &still, None).tangent;
        // Deflection of the tip, and its turn: the other values stay zero, to first order.
        let [[a, b], [c, d]] = [[k[1][1], k[1][5]], [k[5][1], k[5][5]]];
        let tip = d / (a * d - b * c);
        let turn = -c / (a * d - b * c);
        let expected = [1.0 / (3.0 * bending) + 1.0 / shear, 1.0 / (2.0 * bending)];
        for (found, expected) in [tip, turn].into_iter().zip(expected) {
            assert!((found / expected - 1.0).abs() < 1e-9, "{depth}: {found} {expected}");
        }
    }
}

#[test]
fn its_mass_has_the_inertia_of_a_rigid_bar_and_the_moments_of_a_uniform_load() {
    let of = section(400.0, 150.0, 4.0);
    let ends =
        [[0.0, 0.0], [LENGTH, 0.0]].map(|position| NodeFrame { position, tangent: [1.0, 0.0] });
    let slender = ElementTable::new(LENGTH, ends, false, |_| of);
    let table = ShearTable::new(LENGTH, ends, &of).carried_by(slender, &of);
    let m = &table.mass;
    let close = |a: f64, b: f64| (a - b).abs() < 1e-15;
    assert!(close(m[0][0] + 2.0 * m[0][2] + m[2][2], 2.0 * LENGTH));
    let turning = [-0.5 * LENGTH, 1.0, 0.5 * LENGTH, 1.0];
    let energy = |x: &[f64; 4]| -> f64 {
        (0..4).map(|i| (0..4).map(|k| x[i] * m[i][k] * x[k]).sum::<f64>()).sum()
    };
    assert!(close(energy(&turning), 2.0 * LENGTH.powi(3) / 12.0 + 0.01 * LENGTH));
    let moments = [m[1][0] + m[1][2], m[3][0] + m[3][2]];
    assert!(close(moments[0], 2.0 * LENGTH * LENGTH / 12.0) && close(moments[1], -moments[0]));
    // No motion is without mass.
    assert!(energy(&[0.0, 1.0, 0.0, -1.0]) > 0.0 && m[1][1] > 0.0);
    let weights = table.rows.map(|row| row.weighed);
    assert!(weights.iter().all(|w| [w.axial, w.bending, w.rotary] == [0.0; 3]));
    assert!(table.membrane.is_none());
}

#[test]
fn rigid_motions_of_a_bent_element_have_no_stiffness_without_its_stresses() {
    let table = element();
    let u = values(START);
    let free = table.tangent(&u, None).tangent;
    let [c, a, b] = [table.chord, table.directors[0], table.directors[1]];
    let turn = |x: [f64; 2], k: usize| rot90([x[0] + START[k], x[1] + START[k + 1]]);
    let ([x1, x2], [x3, x4], [x5, x6]) = (turn(c, 0), turn(a, 2), turn(b, 4));
    let rigid = [x1, x2, x3, x4, x5, x6];
    let most = free.as_flattened().iter().fold(0.0_f64, |m, k| m.max(k.abs()));
    for row in free {
        let force: f64 = row.iter().zip(rigid).map(|(k, x)| k * x).sum();
        assert!(force.abs() < 1e-13 * most, "{force:e}");
    }
    // Across the vectors of a straight element, whose lengths are held, it is the tangent with its stresses, which are zero.
    let (bar, still) = (bar(0.0), values([0.0; 6]));
    let (free, own) =
        (bar.tangent(&still, None).tangent, bar.tangent(&still, Some([0.0; 3])).tangent);
    for i in [0, 1, 3, 5] {
        for j in [0, 1, 3, 5] {
            assert!((free[i][j] - own[i][j]).abs() < 1e-12 * most, "{i} {j}");
        }
    }
}
