//! From a scenario to the model: definitions in, faults mapped back to the lines of the file.

use std::collections::{BTreeMap, BTreeSet};

use percuss::{Fault, ImpactResolution, Model, ModelBuilder, Settings};

use crate::content::{self, Content, Impacts, LoadKind, ProjectileKind, SupportKind};
use crate::diagnostic::{Diagnostic, Diagnostics};
use crate::point::Point;
use crate::scenario::Scenario;
use crate::source::{Places, Source};
use crate::table::Named;

/// A scenario ready to run.
#[derive(Clone, Debug)]
pub struct Compiled {
    /// One line about the scenario; empty if it has none.
    pub title: String,
    /// The model.
    pub model: Model,
    /// Settings of the analysis.
    pub settings: Settings,
    /// Coefficients of restitution to compare, if the report asks for it.
    pub comparison: Option<Vec<f64>>,
}

impl Scenario {
    /// Builds the model.
    ///
    /// # Errors
    /// Every fault of the model and the settings, each at its place in the file.
    pub fn compile(&self) -> Result<Compiled, Diagnostics> {
        let content = &self.content;
        let settings = settings(content);
        let mut faults = comparison_faults(content);
        match build(content) {
            Ok(model) => {
                faults.extend(settings.validate(&model));
                if faults.is_empty() {
                    let comparison = content.report.restitution.clone();
                    let title = content.title.clone();
                    return Ok(Compiled { title, model, settings, comparison });
                }
            }
            Err(found) => {
                faults.extend(found);
                faults.extend(settings_alone(content, &settings));
            }
        }
        Err(self.diagnostics(faults))
    }

    /// Faults found later, by an analysis, at their places in the file.
    pub fn diagnostics(&self, faults: Vec<Fault>) -> Diagnostics {
        let all = faults.into_iter().map(|f| locate(f, &self.source, &self.places));
        Diagnostics::new((*self.source).clone(), all.collect())
    }
}

/// Faults of the model of a file with reading faults, as far as they do not follow from these.
pub(crate) fn sound_part(
    content: &Content,
    tainted: &BTreeSet<String>,
    source: &Source,
    places: &Places,
) -> Vec<Diagnostic> {
    let mut content = content.clone();
    for beam in &mut content.beam {
        beam.table.elements = beam.table.elements.min(1); // no fault depends on the mesh
    }
    let mut faults = comparison_faults(&content);
    if !content.beam.is_empty() {
        faults.extend(build(&content).err().unwrap_or_default());
    }
    faults.extend(settings_alone(&content, &settings(&content)));
    faults.retain(|fault| {
        !tainted.iter().any(|path| follows(&fault.path, path))
            && !mentions(&content, &fault.path)
                .iter()
                .any(|p| p.beam.is_empty() || tainted.contains(&format!("beam.{}.points", p.beam)))
    });
    faults.into_iter().map(|f| locate(f, source, places)).collect()
}

/// Whether a fault at `fault` may come from a placeholder at `tainted`.
fn follows(fault: &str, tainted: &str) -> bool {
    let ((table, key), (bad_table, bad)) = (split(fault), split(tainted));
    if fault == tainted || table == tainted || fault.starts_with(&format!("{tainted}.")) {
        return true;
    }
    if key == "scheme" && bad_table.starts_with("projectile") {
        return true;
    }
    let related: &[&str] = match key {
        "end" | "step" => &["end", "step"],
        "from" | "until" => &["from", "until"],
        "velocity" | "direction" => &["velocity", "direction"],
        _ => &[],
    };
    table == bad_table && related.contains(&bad)
}

/// Table and key of a path.
fn split(path: &str) -> (&str, &str) {
    path.rsplit_once('.').unwrap_or(("", path))
}

/// The points given at a path: whether they exist depends on the geometry of their beams.
fn mentions<'c>(content: &'c Content, path: &str) -> Vec<&'c Point> {
    fn table<'c, T>(tables: &'c [Named<T>], kind: &str, path: &str) -> Option<&'c T> {
        let name = split(path).0.strip_prefix(kind)?.strip_prefix('.')?;
        tables.iter().find(|t| t.name == name).map(|t| &t.table)
    }
    match split(path).1 {
        "at" => {
            let support = table(&content.support, "support", path).map(|s| &s.at);
            let load = table(&content.load, "load", path).and_then(|l| match &l.kind {
                LoadKind::Point { at, .. } => Some(at),
                LoadKind::Gravity { .. } => None,
            });
            support.into_iter().chain(load).collect()
        }
        "strikes" => {
            table(&content.projectile, "projectile", path).map(|p| &p.strikes).into_iter().collect()
        }
        "between" => table(&content.joint, "joint", path).iter().flat_map(|j| &j.between).collect(),
        "points" if path == "record.points" => content.record.points.iter().collect(),
        _ => Vec::new(),
    }
}

fn locate(fault: Fault, source: &Source, places: &Places) -> Diagnostic {
    let span = places.find(&fault.path).unwrap_or(0..0);
    Diagnostic::at(source, span, fault.path, fault.found, fault.expected)
}

fn settings(content: &Content) -> Settings {
    use content::Scheme;
    let mut settings = Settings::new(content.time.end, content.time.step);
    settings.scheme = match content.integrator.scheme {
        Scheme::EnergyMomentum => percuss::Scheme::EnergyMomentum,
        Scheme::StrainRate => percuss::Scheme::StrainRate,
        Scheme::Midpoint => percuss::Scheme::Midpoint,
        Scheme::Newmark => percuss::Scheme::Newmark,
        Scheme::GeneralizedAlpha { spectral_radius } => {
            percuss::Scheme::GeneralizedAlpha { spectral_radius }
        }
    };
    settings.impacts = match content.time.impacts {
        Impacts::Event => ImpactResolution::Event,
        Impacts::TimeStepping { closed_tolerance } => {
            ImpactResolution::TimeStepping { closed_tolerance }
        }
    };
    settings.record_every = content.record.every;
    settings
}

/// Faults of the settings where the model itself has faults: a sound model stands in for it.
fn settings_alone(content: &Content, settings: &Settings) -> Vec<Fault> {
    let mut builder = ModelBuilder::new();
    let name = String::new;
    let strain = percuss::StrainMeasure::Green;
    let material =
        builder.material(percuss::Material { strain, ..percuss::Material::new("m", 1.0, 1.0) });
    let section = builder.section(percuss::Section {
        name: "s".into(),
        area: 1.0,
        inertia: 1.0,
        rotary_inertia: percuss::RotaryInertia::Density,
    });
    let points = vec![[0.0, 0.0], [1.0, 0.0]];
    let beam = percuss::Beam { name: "b".into(), points, elements: 1, material, section };
    let beam = builder.beam(beam);
    if content.projectile.iter().any(|p| matches!(p.table.kind, ProjectileKind::Rigid { .. })) {
        builder.projectile(percuss::Projectile {
            name: "p".into(),
            kind: percuss::ProjectileKind::Rigid { restitution: 1.0 },
            mass: 1.0,
            velocity: [0.0, 1.0],
            direction: None,
            strikes: percuss::PointRef {
                label: name(),
                beam,
                along: percuss::Along::Fraction(0.5),
            },
            standoff: 0.0,
        });
    }
    builder.build().map(|model| settings.validate(&model)).unwrap_or_default()
}

/// The comparison of coefficients belongs to the report, so the core knows nothing of it.
fn comparison_faults(content: &Content) -> Vec<Fault> {
    let Some(list) = &content.report.restitution else { return Vec::new() };
    let fault =
        |found: String, expected: &str| vec![Fault::new("report.restitution", found, expected)];
    let rigid =
        |p: &Named<content::Projectile>| matches!(p.table.kind, ProjectileKind::Rigid { .. });
    if list.is_empty() {
        return fault("an empty list".into(), "coefficients from 0 to 1");
    }
    if let Some(bad) = list.iter().find(|e| !(0.0..=1.0).contains(*e)) {
        return fault(bad.to_string(), "coefficients from 0 to 1");
    }
    if !content.projectile.iter().any(rigid) {
        return fault(
            "coefficients without a rigid projectile".into(),
            "a projectile of kind \"rigid\"",
        );
    }
    Vec::new()
}

fn build(content: &Content) -> Result<Model, Vec<Fault>> {
    let mut builder = ModelBuilder::new();
    let beams = beams(content, &mut builder);
    let Some(&first) = beams.values().next() else {
        return Err(vec![Fault::new("beam", "no beam", "at least one beam [beam.NAME]")]);
    };
    let point = |p: &Point| percuss::PointRef {
        label: p.label.clone(),
        // The reader has checked the name; after a fault of reading any beam will do.
        beam: beams.get(p.beam.as_str()).copied().unwrap_or(first),
        along: p.along,
    };
    for Named { name, table } in &content.support {
        let kind = support_kind(&table.kind);
        builder.support(percuss::Support { name: name.clone(), at: point(&table.at), kind });
    }
    for Named { name, table } in &content.joint {
        let between = [point(&table.between[0]), point(&table.between[1])];
        builder.joint(percuss::Joint { name: name.clone(), kind: table.kind, between });
    }
    for Named { name, table } in &content.projectile {
        builder.projectile(percuss::Projectile {
            name: name.clone(),
            kind: projectile_kind(&table.kind),
            mass: table.mass,
            velocity: table.velocity,
            direction: table.direction,
            strikes: point(&table.strikes),
            standoff: table.standoff,
        });
    }
    for Named { name, table } in &content.load {
        let kind = match &table.kind {
            LoadKind::Gravity { acceleration } => {
                percuss::LoadKind::Gravity { acceleration: *acceleration }
            }
            LoadKind::Point { at, force, moment } => {
                percuss::LoadKind::Point { at: point(at), force: *force, moment: *moment }
            }
        };
        let (from, until) = (table.from, table.until);
        builder.load(percuss::Load { name: name.clone(), kind, from, until });
    }
    for at in &content.record.points {
        builder.record_point(point(at));
    }
    builder.build()
}

/// Adds materials, sections and beams; returns the beams by name.
fn beams<'c>(
    content: &'c Content,
    builder: &mut ModelBuilder,
) -> BTreeMap<&'c str, percuss::BeamId> {
    let mut materials = BTreeMap::new();
    for Named { name, table } in &content.material {
        let content::Material { young, density, strain } = *table;
        let material = percuss::Material { name: name.clone(), young, density, strain };
        materials.insert(name.as_str(), builder.material(material));
    }
    let mut sections = BTreeMap::new();
    for Named { name, table } in &content.section {
        let content::Section { area, inertia, rotary_inertia } = *table;
        let section = percuss::Section { name: name.clone(), area, inertia, rotary_inertia };
        sections.insert(name.as_str(), builder.section(section));
    }
    let mut beams = BTreeMap::new();
    for Named { name, table } in &content.beam {
        let material = materials.get(table.material.as_str()).copied();
        let section = sections.get(table.section.as_str()).copied();
        let beam = percuss::Beam {
            name: name.clone(),
            points: table.points.clone(),
            elements: table.elements,
            material: material.unwrap_or_else(|| stand_in_material(name, builder)),
            section: section.unwrap_or_else(|| stand_in_section(name, builder)),
        };
        beams.insert(name.as_str(), builder.beam(beam));
    }
    beams
}

/// For a beam whose material could not be read.
fn stand_in_material(beam: &str, builder: &mut ModelBuilder) -> percuss::MaterialId {
    let strain = percuss::StrainMeasure::Green;
    let name = format!(" {beam}"); // no name a file can give
    builder.material(percuss::Material { name, young: 1.0, density: 1.0, strain })
}

/// For a beam whose section could not be read.
fn stand_in_section(beam: &str, builder: &mut ModelBuilder) -> percuss::SectionId {
    let rotary_inertia = percuss::RotaryInertia::Density;
    let name = format!(" {beam}");
    builder.section(percuss::Section { name, area: 1.0, inertia: 1.0, rotary_inertia })
}

fn support_kind(kind: &SupportKind) -> percuss::SupportKind {
    match kind {
        SupportKind::Clamp => percuss::SupportKind::Clamp,
        SupportKind::Pin => percuss::SupportKind::Pin,
        SupportKind::Roller { direction } => percuss::SupportKind::Roller { direction: *direction },
        SupportKind::Fix { components } => {
            percuss::SupportKind::Fix { components: components.clone() }
        }
    }
}

fn projectile_kind(kind: &ProjectileKind) -> percuss::ProjectileKind {
    match *kind {
        ProjectileKind::Elastic { stiffness, force } => {
            percuss::ProjectileKind::Elastic { stiffness, force }
        }
        ProjectileKind::Rigid { restitution } => percuss::ProjectileKind::Rigid { restitution },
    }
}
