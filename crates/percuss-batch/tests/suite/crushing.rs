//! Contacts with crushing, in lanes.

use crate::common;

use common::*;
use percuss::*;
use percuss_batch::*;

/// Stiffness of loading and of unloading \[N/m\].
fn crushing(stiffness: f64, unloading: f64) -> SmoothLaw {
    let potential = Potential::Linear { stiffness };
    SmoothLaw { unloading: Some(unloading), ..SmoothLaw::elastic(potential) }
}

#[test]
fn side_by_side_such_runs_are_those_alone() {
    let mut b = ModelBuilder::new();
    let (material, section) = plank(&mut b);
    let girder = b.beam(beam("girder", [0.0, 0.0], [3.0, 0.0], 6, material, section));
    for (name, f) in [("left", 0.0), ("right", 1.0)] {
        b.support(Support::new(name, at(name, girder, f), SupportKind::Clamp));
    }
    let mut mass = elastic("mass", at("mid", girder, 0.5), [0.0, 20.0]);
    mass.kind = ProjectileKind::Elastic { law: crushing(7.5e5, 3e6) };
    b.projectile(mass);
    let (model, settings) = (b.build().unwrap(), Settings::new(0.02, 1e-4));
    let alone = simulate(&model, &settings, &mut NoRecorder).unwrap();
    for found in simulate_batch(&[(&model, &settings); 9], Detail::Motion) {
        let (found, alone) = (&found.unwrap().contacts[0], &alone.contacts[0]);
        assert_eq!(found.permanent_penetration, alone.permanent_penetration);
        // As text: an interval that is still open has ends that are NaN.
        assert_eq!(format!("{:?}", found.record), format!("{:?}", alone.record));
    }
}
