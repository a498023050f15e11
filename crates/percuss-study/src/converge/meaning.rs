//! What the values of a result on finer levels mean.

use percuss::{Model, RigidLaw, RunSummary, TouchLaw, WithoutLimit};

use super::converged::{Refined, Sequence};
use super::sequence::{Extrapolation, extrapolate};

/// Growth from one level to the next that no sequence with a limit keeps up.
const GROWS: f64 = 1.3;

/// What is known of a result beside its values.
pub(super) struct Meaning<'a> {
    pub path: &'a str,
    /// Under the given settings.
    pub model: &'a Model,
    pub summary: &'a RunSummary,
}

impl Meaning<'_> {
    /// A result on finer levels: its values, and the same as they are compared.
    pub fn sequence(&self, refined: Refined, compared: Vec<f64>, values: Vec<f64>) -> Sequence {
        let found = match compared[..] {
            // Nothing of the kind to refine: it takes no part in what is uncertain.
            [limit] => Extrapolation { order: None, limit, uncertainty: 0.0, constant: true },
            _ => extrapolate(&compared),
        };
        let reason = match refined {
            Refined::Step => self.without_limit().or_else(|| self.impulsive(&values)),
            Refined::Mesh => self.without_limit().or_else(|| self.on_a_bare_node()),
            Refined::Together => self.without_limit(),
            Refined::Fibres => None,
        };
        let no_limit = reason.is_some() && !found.constant;
        let mut words = match reason {
            Some(reason) if no_limit => reason,
            _ => words(refined, &compared, &found),
        };
        if values.windows(2).any(|pair| pair[0] * pair[1] < 0.0) && compared != values {
            words += "; the sign of the largest magnitude changes between levels";
        }
        Sequence { values, compared, found, words, no_limit }
    }

    /// Reactions and shear forces that the run itself warns of (W013): as refined as they are, they grow on. On shear-flexible beams they do not.
    fn without_limit(&self) -> Option<String> {
        let parts: Vec<&str> = self.path.split('.').collect();
        let last = |of: &str| parts.iter().skip(1).any(|part| part.starts_with(of));
        let grows = match parts.first() {
            Some(&"support") => last("force"),
            Some(&"section_forces" | &"section") => last("shear"),
            _ => false,
        };
        let mut beams = (0..self.model.beam_count()).map(|beam| self.model.beam(beam));
        let slender =
            beams.any(|beam| beam.spans().any(|span| span.shear_stiffness_at(0.0).is_none()));
        if !(grows && slender) {
            return None;
        }
        let cause = match self.summary.forces_without_limit(self.model).first()? {
            WithoutLimit::Impact(contact) => {
                format!("the rigid impact of contact '{}'", self.summary.contacts[*contact].name)
            }
            WithoutLimit::Jump(support) => {
                format!("the velocity jump of support '{}'", self.summary.supports[*support].name)
            }
        };
        Some(format!(
            "no limit: {cause} sends out waves as short as an element, and this force grows with refinement (W013)"
        ))
    }

    /// Forces of rigid impacts are impulses spread over a step: they grow as it shrinks.
    fn impulsive(&self, values: &[f64]) -> Option<String> {
        let is_force =
            ["section_forces.", "support."].iter().any(|part| self.path.starts_with(part));
        let struck = self.summary.contacts.iter().any(|contact| {
            matches!(&contact.record, percuss::ContactRecord::Nonsmooth { impact_count, .. } if *impact_count > 0)
        });
        // Jumps of prescribed velocities are impulses, too.
        let impulsive = |s: &percuss::SupportSummary| s.impulse.iter().any(|i| i.abs() > 0.0);
        let struck = struck || self.summary.supports.iter().any(impulsive);
        let grows = values.windows(2).all(|pair| pair[1].abs() > GROWS * pair[0].abs());
        (is_force && struck && grows).then(|| {
            "grows with smaller steps: a rigid impact, or a velocity jump of a support, is an impulse, so that this force has no limit".into()
        })
    }

    /// What a rigid projectile does to a point whose effective mass is that of the mesh.
    fn on_a_bare_node(&self) -> Option<String> {
        let masses = self.model.effective_masses();
        let contacts = self.summary.contacts.iter().zip(self.model.contacts()).zip(masses);
        let bare = contacts.into_iter().find(|((contact, view), mass)| {
            // A mass that stays on a point without mass of its own meets the resistance of waves, which has a limit.
            let stays = |law: &RigidLaw| law.restitution == 0.0 && mass.limit == 0.0;
            let has_limit = matches!(view.law(), TouchLaw::Rigid(law) if stays(law));
            let rigid = matches!(contact.record, percuss::ContactRecord::Nonsmooth { .. });
            let own =
                [format!("contact.{}.", contact.name), format!("projectile.{}.", contact.name)];
            rigid
                && !has_limit
                && mass.depends_on_mesh()
                && own.iter().any(|part| self.path.starts_with(part.as_str()))
        });
        bare.map(|(_, mass)| {
            format!(
                "depends on the mesh: effective mass {:.3e} kg on this mesh, tends to {:.3e} kg with refinement; add a \
                 local_mass or use a compliant contact",
                mass.on_mesh, mass.limit
            )
        })
    }
}

/// The meaning of a sequence.
fn words(refined: Refined, values: &[f64], found: &Extrapolation) -> String {
    let (name, these) = match refined {
        Refined::Step => ("step", "this step"),
        Refined::Mesh => ("mesh", "this mesh"),
        Refined::Fibres => ("fibres", "these fibres"),
        Refined::Together => ("settings", "these settings"),
    };
    if values.len() < 3 {
        return match refined {
            Refined::Fibres => "no yielding section whose fibres can be doubled twice".into(),
            _ => format!("no {name} to refine"),
        };
    }
    if values.iter().any(|value| !value.is_finite()) {
        return match refined {
            Refined::Step | Refined::Mesh => format!("not every {name} has this result"),
            Refined::Fibres | Refined::Together => format!("not all {name} have this result"),
        };
    }
    if found.constant {
        return format!("does not depend on the {name}");
    }
    let percent = |x: f64| {
        let share = 100.0 * (x / found.limit).abs();
        match share {
            _ if !share.is_finite() => format!("{x:.2e}"),
            _ if share >= 0.01 => format!("{share:.2} %"),
            _ => format!("{share:.0e} %"),
        }
    };
    match found.order {
        Some(order) => format!(
            "converges with order {order:.2}: error of {these} {}",
            percent(values[0] - found.limit)
        ),
        None => format!(
            "no order observed: possible error of the finest run {}",
            percent(found.uncertainty)
        ),
    }
}
