//! Strain-free motions: of rigid bodies, of mechanisms.

use super::krylov::{Krylov, Nodal};
use super::matrix::Layout;
use super::stiffness::StressTerms;
use super::{metric, size};
use crate::analysis::static_search::{StaticSearch, largest};
use crate::linalg::block::inner;
use crate::math::vec2::{dot, rot90, scale, sub};
use crate::model::Model;
use crate::model::frozen::BeamData;

/// Eigenvalues of unit bending stiffness, against beams as long as all together, that count as none. The least of a structure
/// that is held is of order one; the greatest of round-off, for 100 000 elements, below 1e-11.
const NONE: f64 = 1e-9;

/// Energy of stress below this share of that of bending is round-off.
const ROUND_OFF: f64 = 1e-9;

/// Strain-free motions of a structure.
pub struct FreeMotions {
    /// Nodal values of a basis, shape (motions, nodes, 4) \[-, 1/m, to a common factor\].
    pub motions: Vec<Nodal>,
    /// As many components of nodes that, held, would stop them all: (node, component), shape (motions)
    /// \[index of a node, index of a component\].
    pub stops: Vec<(usize, usize)>,
}

/// Motions from the base of a search that no stiffness opposes, to first order.
///
/// Their number is the rank that a stiffness matrix lacks, whatever the stiffness: it is found with unit bending stiffness for
/// each beam, and springs to match.
pub fn free_motions(layout: &Layout, search: &StaticSearch) -> FreeMotions {
    match is_held_beam_by_beam(layout.model, search) {
        true => FreeMotions { motions: Vec::new(), stops: Vec::new() },
        false => found_by_stiffness(layout, search),
    }
}

fn found_by_stiffness(layout: &Layout, search: &StaticSearch) -> FreeMotions {
    let model = layout.model;
    let length = size(model);
    let metric = metric(model, true);
    // Formed again when needed: few structures have free motions, and it uses most memory.
    let shifted = |shift: f64| {
        let mut stiffness = layout.kinematic(search, length);
        layout.add_band(&mut stiffness, &metric, shift);
        stiffness
    };
    let count = layout.factor(shifted(-NONE), true).map_or(0, |f| f.negative);
    let mut motions = Vec::new();
    if count > 0
        && let Some(factored) = layout.factor(shifted(1.0), false)
    {
        let image_of = |x: &Nodal| metric.multiply(x);
        let solve = |image: &Nodal| factored.solve(image);
        let mut krylov = Krylov::new(model.node_count(), &[], image_of, solve);
        for _ in 0..count {
            krylov.join();
        }
        let most = 12 * count + 20;
        let mut found = Vec::new();
        while krylov.size() < most && krylov.advance() {
            if krylov.size().is_multiple_of(count) && krylov.size() >= 2 * count {
                found = krylov.symmetric();
                if krylov.settled(&found, count) {
                    break;
                }
            }
        }
        if found.len() < count {
            found = krylov.symmetric();
        }
        motions = found.iter().take(count).map(|r| krylov.shape(r).x).collect();
    }
    let stops = stops(&motions, length);
    FreeMotions { motions, stops }
}

/// Whether supports restrain each beam by itself, for any joints: an elastic beam strains in all motions except those of a rigid body. Fractured
/// beams and beams of several parts are not considered.
fn is_held_beam_by_beam(model: &Model, search: &StaticSearch) -> bool {
    let elastic = model.spans.iter().all(|span| span.fibres.is_none());
    elastic && model.constraints.is_empty() && model.beams.iter().all(|b| is_held(model, search, b))
}

/// Whether supports hold a beam against motions of a rigid body about the base of a search.
fn is_held(model: &Model, search: &StaticSearch, beam: &BeamData) -> bool {
    /// Directions nearer to each other than this are left to the eigenvalues: it is more than the root of [`NONE`].
    const APART: f64 = 1e-3;
    let displacement = &search.base.displacement;
    let first = beam.nodes.start;
    let place = |n: usize| -> [f64; 2] {
        std::array::from_fn(|i| model.nodes[n].position[i] + displacement[n][i])
    };
    let mut known: Vec<[f64; 3]> = Vec::new();
    for dofs in model.prescribed.iter().filter(|dofs| beam.nodes.contains(&dofs.node)) {
        let n = dofs.node;
        let arm = scale(1.0 / beam.length, sub(place(n), place(first)));
        let slope: [f64; 2] =
            std::array::from_fn(|i| model.nodes[n].tangent[i] + displacement[n][2 + i]);
        for normal in &dofs.normals {
            // Its effect on translations along the axes, and on a rotation about the first node divided by the length.
            let along = [normal[0], normal[1]];
            let slopes = [normal[2], normal[3]];
            let turn = dot(along, rot90(arm)) + dot(slopes, rot90(slope)) / beam.length;
            let mut row = unit([normal[0], normal[1], turn]);
            for other in &known {
                let share: f64 = (0..3).map(|k| row[k] * other[k]).sum();
                (0..3).for_each(|k| row[k] -= share * other[k]);
            }
            if row.iter().map(|x| x * x).sum::<f64>().sqrt() > APART {
                known.push(unit(row));
            }
        }
    }
    known.len() >= 3
}

fn unit(row: [f64; 3]) -> [f64; 3] {
    let size = row.iter().map(|x| x * x).sum::<f64>().sqrt();
    if size > 0.0 { row.map(|x| x / size) } else { row }
}

/// Stiffness of a motion against that of bending, both of unit bending stiffness: how much it strains.
pub fn strain_share(layout: &Layout, search: &StaticSearch, x: &Nodal) -> f64 {
    let length = size(layout.model);
    let mut energy = 0.0;
    layout.each_energy(search, x, StressTerms::Left(length), |e| energy += e);
    energy / inner(x, &metric(layout.model, true).multiply(x))
}

/// Ratio of the stiffness `total` of a motion to the magnitudes of its parts, element by element.
pub fn stress_share(layout: &Layout, search: &StaticSearch, x: &Nodal, total: f64) -> f64 {
    let mut parts = 0.0;
    layout.each_energy(search, x, StressTerms::Taken, |e| parts += e.abs());
    let scale = inner(x, &metric(layout.model, false).multiply(x));
    if parts <= ROUND_OFF * scale { 0.0 } else { total.abs() / parts }
}

/// Components that distinguish the motions, by elimination with complete pivoting; slopes are multiplied by a length.
fn stops(motions: &[Nodal], length: f64) -> Vec<(usize, usize)> {
    let mut rest = motions.to_vec();
    for x in &mut rest {
        x.iter_mut().for_each(|x| (x[2], x[3]) = (length * x[2], length * x[3]));
        let size = largest(x);
        x.as_flattened_mut().iter_mut().for_each(|c| *c /= size);
    }
    let mut places = Vec::new();
    while !rest.is_empty() {
        let (mut best, mut at) = (0.0, (0, 0));
        for (m, x) in rest.iter().enumerate() {
            for (i, c) in x.as_flattened().iter().enumerate() {
                if c.abs() > best {
                    (best, at) = (c.abs(), (m, i));
                }
            }
        }
        if best == 0.0 {
            break;
        }
        let pivot = rest.swap_remove(at.0);
        for x in &mut rest {
            let factor = x.as_flattened()[at.1] / pivot.as_flattened()[at.1];
            for (c, p) in x.as_flattened_mut().iter_mut().zip(pivot.as_flattened()) {
                *c -= factor * p;
            }
        }
        places.push((at.1 / 4, at.1 % 4));
    }
    places
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::*;

    /// A straight beam of length 2 from the origin, at 30 degrees to the axes, held at shares of its length.
    fn held(kinds: &[(f64, SupportKind)]) -> Model {
        let mut b = ModelBuilder::new();
        let material = b.material(Material::new("steel", 2e11, 7800.0));
        let section = b.section(Section::new("bar", 1e-3, 1e-7));
        let end = [3_f64.sqrt(), 1.0];
        let beam = b.beam(Beam::new("bar", &[[0.0; 2], end], 4, material, section));
        for (k, (fraction, kind)) in kinds.iter().enumerate() {
            let along = Along::Fraction(*fraction);
            let at = PointRef { label: format!("p{k}"), beam, along };
            b.support(Support::new(format!("s{k}"), at, kind.clone()));
        }
        b.build().unwrap()
    }

    #[test]
    fn supports_hold_a_beam_where_its_stiffness_leaves_no_motion_free() {
        // Directions in the axes of the beam. An axial support is at an end: inside, it would divide the beam.
        let (cos, sin) = (0.75_f64.sqrt(), 0.5);
        let roller = |x: f64, y: f64| SupportKind::Roller {
            direction: [cos * x - sin * y, sin * x + cos * y],
        };
        let across = || roller(1.0, 0.0);
        let cases: [(&[(f64, SupportKind)], usize); 8] = [
            (&[], 3),
            (&[(0.5, SupportKind::Pin)], 1),
            (&[(0.0, SupportKind::Clamp)], 0),
            (&[(0.0, SupportKind::Pin), (1.0, across())], 0),
            // It turns about the pin: the other support holds it along its axis.
            (&[(0.0, SupportKind::Pin), (1.0, roller(0.0, 1.0))], 1),
            (&[(0.0, across()), (1.0, across())], 1),
            // The lines of three rollers meet in one point, about which the beam rotates.
            (&[(0.0, roller(-1.0, 1.0)), (0.5, across()), (1.0, roller(1.0, 1.0))], 1),
            (&[(0.0, roller(-1.0, 1.0)), (0.25, across()), (1.0, roller(1.0, 1.0))], 0),
        ];
        for (kinds, free) in cases {
            let model = held(kinds);
            let search = StaticSearch::new(&model);
            let found = found_by_stiffness(&Layout::new(&model), &search).motions.len();
            assert_eq!(
                (found, is_held_beam_by_beam(&model, &search)),
                (free, free == 0),
                "{kinds:?}"
            );
        }
    }
}
