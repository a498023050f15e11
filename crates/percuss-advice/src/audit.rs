//! Warnings of the audit of a finished run.

use percuss::{AuditSummary, ContactRecord, ContactSummary, Peak, RunSummary};
use percuss_codes::{Caution, Topic};

use super::words::quantity;
use super::{Advice, Verdict};

/// A violation of the contact conditions beyond this, relative to the largest velocity, is worth a warning.
const CONDITIONS: f64 = 1e-8;
/// Penetrations of rigid contacts beyond this are worth a warning \[m\].
const INSIDE: f64 = 1e-7;

/// All warnings.
pub fn warnings(run: &RunSummary, advice: &[Advice]) -> Vec<(Caution, String)> {
    let mut all = Vec::new();
    if run.contact_residual_max > CONDITIONS {
        let text = format!(
            "contact conditions violated by {:.1e} of the largest velocity",
            run.contact_residual_max
        );
        all.push((Caution::ContactConditions, text));
    }
    all.extend(inside(run).map(|text| (Caution::Inside, text)));
    all.extend(multiple_impacts(run).map(|text| (Caution::MultipleImpact, text)));
    all.extend(meshes(run, advice).map(|text| (Caution::MeshImpulse, text)));
    let residuals = [
        ("energy", run.energy.residual_max),
        ("linear momentum", run.momentum.linear_residual_max),
        ("angular momentum", run.momentum.angular_residual_max),
    ];
    for (what, residual) in residuals {
        if residual > AuditSummary::JUDGED || residual.is_nan() {
            let text = format!("{what} balance error {residual:.1e} of its scale");
            all.push((Caution::Balance, text));
        }
    }
    all
}

/// Penetration of rigid contacts: the deepest, and the number of others.
fn inside(run: &RunSummary) -> Option<String> {
    let depth = |contact: &ContactSummary| match &contact.record {
        ContactRecord::Nonsmooth { penetration, .. } => *penetration,
        ContactRecord::Smooth { .. } => Peak::default(),
    };
    let deep = || run.contacts.iter().filter(|contact| depth(contact).value > INSIDE);
    let worst = deep().max_by(|a, b| depth(a).value.total_cmp(&depth(b).value))?;
    let (name, [a, b], peak) = (&worst.name, &worst.between, depth(worst));
    let others = match deep().count() - 1 {
        0 => String::new(),
        others => format!(" (and {others} other contacts, less deep)"),
    };
    let (depth, time) = (quantity(peak.value, "m"), quantity(peak.time, "s"));
    Some(format!(
        "penetration of rigid contact '{name}' ('{a}', '{b}'): {depth} at t = {time}{others}; use a smaller time.step, unless supports \
         or joints force the overlap"
    ))
}

/// Impacts on several touching bodies at once.
fn multiple_impacts(run: &RunSummary) -> Option<String> {
    let shared = &run.multiple_impacts;
    let others = match shared.count {
        0 => return None,
        1 => String::new(),
        count => format!(" (and {} more)", count - 1),
    };
    let [a, b] = shared.contacts.map(|k| run.contacts.get(k).map_or("?", |c| c.name.as_str()));
    let time = quantity(shared.first, "s");
    Some(format!(
        "multiple impact at t = {time} in contacts '{a}' and '{b}'{others}: the result depends on the impact law; see \
         time.multiple_impacts"
    ))
}

/// Contacts whose rigid impacts depend on the mesh, unless there is a finding about it.
fn meshes(run: &RunSummary, advice: &[Advice]) -> Option<String> {
    let reported = |c: &ContactSummary| {
        advice.iter().any(|one| {
            let weighs = one.verdict != Verdict::Fine;
            weighs && one.topic == Topic::EffectiveMass && one.contact == c.name
        })
    };
    let depends = |c: &&ContactSummary| {
        // A persistent contact without impacts has forces, which do not depend on the mesh so.
        let impacts = matches!(c.record, ContactRecord::Nonsmooth { impact_count: 1.., .. });
        impacts && !reported(c) && c.effective_mass.is_some_and(|mass| mass.depends_on_mesh())
    };
    let mut found = run.contacts.iter().filter(depends);
    let (first, others) = (found.next()?, found.count());
    let mass = first.effective_mass?;
    let others = match others {
        0 => String::new(),
        1 => " (and 1 other contact)".to_owned(),
        others => format!(" (and {others} other contacts)"),
    };
    Some(format!(
        "contact '{}'{others}: effective mass {} on this mesh, {} in the limit of refinement: impulses and number of impacts depend on \
         the mesh; use a compliant contact",
        first.name,
        quantity(mass.on_mesh, "kg"),
        quantity(mass.limit, "kg")
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use percuss::{Disc, ModelBuilder, NoRecorder, Settings, simulate};

    #[test]
    fn conditions_that_contacts_violate_have_their_code() {
        let mut b = ModelBuilder::new();
        b.disc(Disc {
            name: "ball".into(),
            mass: 1.0,
            inertia: None,
            radius: 0.1,
            position: [0.0; 2],
            velocity: [1.0, 0.0],
            spin: 0.0,
        });
        let settings = Settings::new(1.0, 0.5);
        let mut run = simulate(&b.build().unwrap(), &settings, &mut NoRecorder).unwrap();
        assert_eq!(warnings(&run, &[]), []);
        run.contact_residual_max = 1e-7;
        let text = "contact conditions violated by 1.0e-7 of the largest velocity".to_owned();
        assert_eq!(warnings(&run, &[]), [(Caution::ContactConditions, text)]);
        assert_eq!(Caution::ContactConditions.code(), "W101");
    }
}
