//! How materials, springs and hinges yield.

use percuss::{Fault, Hardening, Inelasticity, Overstress, Plasticity};

use crate::content::{HingeHardening, JointKind, Material, Spring, SpringHardening};

/// What a file gives of a hardening curve.
struct Given<'a> {
    /// Path of the table of the file, such as `material.steel`.
    path: String,
    /// Yield stress, force or moment, and its unit.
    first: f64,
    unit: &'static str,
    /// What it grows with, in words.
    over: &'static str,
    isotropic: Option<f64>,
    kinematic: f64,
    table: Option<&'a [[f64; 2]]>,
}

impl Given<'_> {
    /// How it yields, rates and failure left out.
    fn plasticity(self, faults: &mut Vec<Fault>) -> Plasticity {
        let Self { path, first, unit, over, isotropic, kinematic, table } = self;
        let virgin = [[0.0, first]];
        let points = table.unwrap_or(&virgin);
        if let Some([flow, limit]) = points.first()
            && (*flow != 0.0 || (limit / first - 1.0).abs() > 1e-9)
        {
            let path = format!("{path}.hardening.table");
            let found = format!("a table that begins with [{flow}, {limit} {unit}]");
            let expected = format!("[0, {first}] first: no {over}");
            faults.push(Fault::new(path, found, expected));
        }
        let rise = |w: &[[f64; 2]]| (w[1][1] - w[0][1]) / (w[1][0] - w[0][0]);
        let last = if table.is_some() { 0.0 } else { isotropic.unwrap_or(0.0) };
        let moduli = points.windows(2).map(rise).chain([last]);
        let part = |(point, modulus): (&[f64; 2], f64)| {
            let [from, stress] = *point;
            Hardening { from, stress, modulus }
        };
        let curve = points.iter().zip(moduli).map(part).collect();
        Plasticity { curve, kinematic, overstress: None, failure_strain: None }
    }
}

/// What a material does beyond Hooke's law.
pub(super) fn inelasticity(
    name: &str,
    table: &Material,
    faults: &mut Vec<Fault>,
) -> Option<Inelasticity> {
    let hardening = table.hardening.as_ref();
    let given = Given {
        path: format!("material.{name}"),
        first: match (table.r#yield, table.bears) {
            (Some(first), _) => first,
            (None, slack) => return slack.map(Inelasticity::OneSided),
        },
        unit: "Pa",
        over: "plastic strain at the yield stress",
        isotropic: hardening.and_then(|h| h.isotropic),
        kinematic: hardening.map_or(0.0, |h| h.kinematic),
        table: hardening.and_then(|h| h.table.as_deref()),
    };
    let plasticity = Plasticity {
        overstress: table.rate.as_ref().map(|r| Overstress { rate: r.C, exponent: r.q }),
        failure_strain: table.failure_strain,
        ..given.plasticity(faults)
    };
    Some(match table.bears {
        None => Inelasticity::Plastic(plasticity),
        Some(slack) => Inelasticity::OneSidedPlastic(slack, plasticity),
    })
}

/// How a spring yields, if it does.
pub(super) fn of_spring(name: &str, table: &Spring, faults: &mut Vec<Fault>) -> Option<Plasticity> {
    let none = SpringHardening { isotropic: None, kinematic: 0.0, table: None };
    let hardening = table.hardening.as_ref().unwrap_or(&none);
    let given = Given {
        path: format!("spring.{name}"),
        first: table.yield_force?,
        unit: "N",
        over: "plastic extension at the yield force",
        isotropic: hardening.isotropic,
        kinematic: hardening.kinematic,
        table: hardening.table.as_deref(),
    };
    Some(Plasticity { failure_strain: table.failure_extension, ..given.plasticity(faults) })
}

/// How a hinge yields, if it does.
pub(super) fn of_joint(
    name: &str,
    kind: &JointKind,
    faults: &mut Vec<Fault>,
) -> Option<Plasticity> {
    let JointKind::Hinge { yield_moment, hardening, failure_rotation, .. } = kind else {
        return None;
    };
    let none = HingeHardening { isotropic: None, kinematic: 0.0, table: None };
    let hardening = hardening.as_ref().unwrap_or(&none);
    let given = Given {
        path: format!("joint.{name}"),
        first: (*yield_moment)?,
        unit: "N*m",
        over: "plastic rotation at the yield moment",
        isotropic: hardening.isotropic,
        kinematic: hardening.kinematic,
        table: hardening.table.as_deref(),
    };
    Some(Plasticity { failure_strain: *failure_rotation, ..given.plasticity(faults) })
}
