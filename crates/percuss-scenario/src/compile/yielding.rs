//! How materials, springs and hinges yield.

use percuss::{Fault, Hardening, Inelasticity, Overstress, Plasticity, Slack};

use super::stress_table::StressTable;
use crate::content::{
    HingeHardening, JointKind, Material, SpringHardening, SpringLaw, TableStress,
};

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
    /// Strains and stresses of a table, shape (rows, 2) \[-, Pa\].
    table: Option<&'a [[f64; 2]]>,
    /// The test that the table was measured in; none of springs and hinges.
    test: Option<&'a Material>,
}

impl Given<'_> {
    /// How it yields, rates and failure left out.
    fn plasticity(self, faults: &mut Vec<Fault>) -> Plasticity {
        let Self { path, first, unit, over, isotropic, kinematic, table, test } = self;
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
        let converted = test.filter(|_| table.is_some()).map(|m| converted(m, points));
        let points = match &converted {
            None => points,
            Some(Ok(found)) => found.as_slice(),
            Some(Err(strain)) => {
                let path = format!("{path}.hardening.table");
                let found = format!("a force that falls beyond a nominal strain of {strain:.6}");
                let expected = "true stresses up to where the bar necks".to_owned();
                faults.push(Fault::new(path, found, expected));
                points
            }
        };
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

/// Points of a table in the strain measure of its material, unless they are at fault, which is reported elsewhere.
fn converted(material: &Material, points: &[[f64; 2]]) -> Result<Vec<[f64; 2]>, f64> {
    let hardening = material.hardening.as_ref();
    let young = material.young.unwrap_or(f64::NAN);
    let valid = points.as_flattened().iter().all(|x| x.is_finite())
        && points.windows(2).all(|w| w[1][0] > w[0][0] && w[1][1] >= w[0][1])
        && points.iter().all(|p| p[1] > 0.0 && p[1] < young);
    if !valid {
        return Ok(points.to_vec());
    }
    let table = StressTable {
        points,
        stress: hardening.map_or(TableStress::Nominal, |h| h.stress),
        measure: material.strain,
        young,
        kinematic: hardening.map_or(0.0, |h| h.kinematic),
        presses: material.bears == Some(Slack::Tension),
    };
    table.converted()
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
        test: Some(table),
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
pub(super) fn of_spring(
    name: &str,
    law: &SpringLaw,
    faults: &mut Vec<Fault>,
) -> Option<Plasticity> {
    let SpringLaw::Linear { yield_force, hardening, failure_extension, .. } = law else {
        return None;
    };
    let none = SpringHardening { isotropic: None, kinematic: 0.0, table: None };
    let hardening = hardening.as_ref().unwrap_or(&none);
    let given = Given {
        path: format!("spring.{name}"),
        first: (*yield_force)?,
        unit: "N",
        over: "plastic extension at the yield force",
        isotropic: hardening.isotropic,
        kinematic: hardening.kinematic,
        table: hardening.table.as_deref(),
        test: None,
    };
    Some(Plasticity { failure_strain: *failure_extension, ..given.plasticity(faults) })
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
        test: None,
    };
    Some(Plasticity { failure_strain: *failure_rotation, ..given.plasticity(faults) })
}
