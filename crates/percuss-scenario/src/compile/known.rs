//! What a file uses without a table of its own: materials known by name and steel profiles.

use std::collections::BTreeMap;

use percuss::Section;

use crate::content::{self, Content, Preset, Shape, SteelProfile};
use crate::preset::Presets;
use crate::scenario::Scenario;
use crate::table::Named;

/// Materials that beams and fibres name and that have no table.
pub(super) fn materials(content: &Content) -> BTreeMap<&str, Preset> {
    let beams = content.beam.iter().flat_map(|beam| {
        let changed = beam.table.changes.iter().filter_map(|change| change.material.as_deref());
        changed.chain([beam.table.material.as_str()])
    });
    let fibres = content.section.iter().flat_map(|section| match &section.table.shape {
        Shape::Fibres { materials: Some(names), .. } => names.as_slice(),
        _ => &[],
    });
    let named = |name: &str| content.material.iter().any(|one| one.name == name);
    let used = beams.chain(fibres.map(String::as_str)).filter(|name| !named(name));
    used.filter_map(|name| Some((name, Presets::named(name)?))).collect()
}

/// Steel profiles that beams and tapers name as sections and that have no table.
pub(super) fn profiles(content: &Content) -> BTreeMap<&str, SteelProfile> {
    let beams = content.beam.iter().flat_map(|beam| {
        let changed = beam.table.changes.iter().filter_map(|change| change.section.as_deref());
        changed.chain([beam.table.section.as_str()])
    });
    let stations = content.section.iter().flat_map(|section| match &section.table.shape {
        Shape::Tapered { sections, .. } => sections.as_slice(),
        _ => &[],
    });
    let named = |name: &str| content.section.iter().any(|one| one.name == name);
    let used = beams.chain(stations.map(String::as_str)).filter(|name| !named(name));
    used.filter_map(|name| Some((name, SteelProfile::find(name)?))).collect()
}

impl Scenario {
    /// The same scenario with a table `[section.NAME]` for each steel profile that has none, so that its keys can be set.
    pub fn with_tables_of_profiles(mut self) -> Self {
        let known = profiles(&self.content);
        let known: Vec<(String, SteelProfile)> =
            known.into_iter().map(|(name, profile)| (name.to_owned(), profile)).collect();
        for (old, profile) in known {
            let mut name = old.replace(|c: char| !c.is_alphanumeric(), "_");
            while self.content.section.iter().any(|section| section.name == name) {
                name.push('_');
            }
            self.rename_section(&old, &name);
            let table = content::Section {
                rotary_inertia: percuss::RotaryInertia::Density,
                fibres: Section::FIBRES,
                shear_factor: None,
                shape: Shape::Profile { profile },
            };
            self.content.section.push(Named { name, table });
        }
        self
    }

    /// Writes another name wherever a section is named.
    fn rename_section(&mut self, old: &str, new: &str) {
        let beams = self.content.beam.iter_mut().flat_map(|beam| {
            let changed = beam.table.changes.iter_mut().filter_map(|c| c.section.as_mut());
            changed.chain([&mut beam.table.section])
        });
        let stations =
            self.content.section.iter_mut().flat_map(|section| match &mut section.table.shape {
                Shape::Tapered { sections, .. } => sections.as_mut_slice(),
                _ => &mut [],
            });
        for name in beams.chain(stations).filter(|name| *name == old) {
            new.clone_into(name);
        }
    }
}
