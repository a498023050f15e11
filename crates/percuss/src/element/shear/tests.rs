use super::examples::*;
use super::*;
use crate::math::vec2::rot90;

/// Stiffnesses against stretching, shear and bending, shape (3) \[N, N, N m^2\].
const STIFFNESS: [f64; 3] = [400.0, 150.0, 4.0];
/// Mass and rotary inertia, shape (2) \[kg/m, kg m\].
const INERTIA: [f64; 2] = [2.0, 0.01];

/// A bent element that is not aligned with the axes.
fn element() -> ShearTable {
    bent(&section(STIFFNESS, INERTIA))
}

/// That, and one with a section that varies.
fn elements() -> [ShearTable; 2] {
    [element(), tapered(STIFFNESS, INERTIA)]
}

/// A bar along the first axis, or an arc that turns by an angle in the reference.
fn bar(angle: f64) -> ShearTable {
    examples::bar(angle, &section(STIFFNESS, INERTIA))
}

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
    let end: [f64; 6] = std::array::from_fn(|i| START[i] + STEP[i]);
    let work =
        |sums: &ElementSums<f64>| -> f64 { sums.force.iter().zip(STEP).map(|(f, d)| f * d).sum() };
    for table in elements() {
        let plain = work(&table.mean::<f64, false>(&values(START), &values(STEP), 0.0));
        let gained = energy(&table, end) - energy(&table, START);
        assert!((plain - gained).abs() < 1e-13 * gained.abs(), "{plain:e} {gained:e}");
        // A step with a retardation time loses that times the squares of the changes.
        let lag = 0.3;
        let lost = work(&table.mean::<f64, false>(&values(START), &values(STEP), lag)) - plain;
        let expected = lag * table.viscous_loss(&values(START), &values(end));
        assert!(expected > 0.0 && (lost - expected).abs() < 1e-12 * expected, "{lost:e}");
        // Strains without forces.
        let given = [0.02, 0.3];
        let relieved = table.relieved::<false>(&values(START), &values(STEP), 0.5, given);
        let [before, after] =
            [START, end].map(|at| table.energy_relieved(&values(at), given).iter().sum::<f64>());
        let work = work(&relieved);
        assert!((work - (after - before)).abs() < 1e-13 * gained.abs(), "{work:e}");
    }
}

#[test]
fn an_arc_has_no_stretch_and_the_energy_of_its_turning_to_fourth_order() {
    let straight = bar(0.0);
    for angle in [0.2, 0.4, 0.8] {
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
    for table in elements() {
        let sums = table.mean::<f64, false>(&values(START), &values(STEP), 0.0);
        assert_no_resultant_moment(&table, sums.force);
    }
}

#[test]
fn tangents_are_the_derivatives_of_the_forces() {
    let start = values(START);
    for table in elements() {
        assert_tangent_of_forces(|d| table.mean::<f64, true>(&start, &values(d), 0.3));
        assert_tangent_of_forces(|d| table.at_end::<f64, true>(&start, &values(d), None));
        let given = [0.02, 0.3];
        assert_tangent_of_forces(|d| table.relieved::<true>(&start, &values(d), 0.5, given));
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
        let table = ShearTable::new(1.0, ends, &[section([axial, shear, bending], INERTIA); GAUSS]);
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
    let of = section(STIFFNESS, INERTIA);
    let ends =
        [[0.0, 0.0], [LENGTH, 0.0]].map(|position| NodeFrame { position, tangent: [1.0, 0.0] });
    let slender = ElementTable::new(LENGTH, ends, false, |_| of);
    let table = ShearTable::new(LENGTH, ends, &[of; GAUSS]).carried_by(slender, &[of; GAUSS]);
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

/// `N (w'^2 - g^2) / 2` along the field inside, `w' = D + n (xi - 1/2) - c z (1 - 6 xi + 6 xi^2)` and `g = (1 - c) z`: the axial strain of small
/// inclinations to second order.
#[test]
fn the_axial_strain_is_that_of_the_field_inside() {
    for stiffness in [[400.0, 1e6, 4.0], [400.0, 150.0, 4.0], [400.0, 1e-3, 4.0]] {
        let table = examples::bar(0.0, &section(stiffness, INERTIA));
        let inside = table.inside();
        let small = 1e-4;
        let [w, ta, tb] = [0.7, -0.4, 1.1].map(|x| x * small);
        let nodes = [0.0, ta, w, tb];
        let (mut sum, points) = (0.0, 2000);
        for k in 0..points {
            let xi = (k as f64 + 0.5) / points as f64;
            let at = |n: [f64; 4]| (0..4).map(|i| n[i] * nodes[i]).sum::<f64>();
            let (slope, turn) = (at(inside.along(xi)), at(inside.section(xi)));
            sum += 0.5 * (slope * slope - (slope - turn).powi(2)) / points as f64;
        }
        // Vectors of unit length turn by ta and tb.
        let director = |t: f64| [t.cos() - 1.0, t.sin()];
        let ([a1, a2], [b1, b2]) = (director(ta), director(tb));
        let [axial, ..] = table.strains(&values([0.0, w, a1, a2, b1, b2])).linear;
        assert!((axial / sum - 1.0).abs() < 1e-5, "{stiffness:?}: {axial:e} {sum:e}");
    }
}

#[test]
fn an_arc_that_expands_evenly_has_its_strain() {
    let strain = 0.01;
    for angle in [0.0, 0.4, 0.9] {
        let table = bar(angle);
        let [c1, c2] = table.chord.map(|c| c * strain);
        let found = table.strains(&values([c1, c2, 0.0, 0.0, 0.0, 0.0])).linear;
        assert!((found[0] / strain - 1.0).abs() < 1e-13, "{angle}: {found:?}");
        assert!(found[1].abs() < 1e-16 && found[2].abs() < 1e-15, "{angle}: {found:?}");
    }
}

/// A bar free of forces turns by its given curvature: the moment that is left on an arc of it is of seventh order in the angle.
#[test]
fn a_given_curvature_needs_no_moment_on_its_arc() {
    let straight = bar(0.0);
    for angle in [0.8, 0.4, 0.2] {
        let arc = bar(angle);
        let to = |k: usize| sub(arc.directors[k], straight.directors[k]);
        let ([a1, a2], [b1, b2], [c1, c2]) = (to(0), to(1), sub(arc.chord, straight.chord));
        let (still, u) = (values([0.0; 6]), values([c1, c2, a1, a2, b1, b2]));
        let own = straight.at_end::<f64, false>(&still, &u, None).force;
        let given = [0.0, angle / LENGTH];
        let by_given = straight.relieved::<false>(&still, &u, 1.0, given).force;
        // Moments on the second vector.
        let moment = |f: [f64; 6]| cross(arc.directors[1], [f[4], f[5]]);
        let left = (moment(own) + moment(by_given)) * LENGTH / STIFFNESS[2];
        // The factor is 0.064 at the smallest of these angles and 0.028 at the largest.
        assert!(left.abs() < 0.1 * f64::powi(angle, 7), "{angle}: {left:e}");
    }
}
