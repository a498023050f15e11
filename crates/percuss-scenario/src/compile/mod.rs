//! From a scenario to the model: definitions in, faults mapped back to the lines of the file.

mod aim;
mod beams;
mod build;
mod contact;
mod follow;
mod foundation;
mod function;
mod known;
mod law;
mod locate;
mod section;
mod stress_table;
#[cfg(test)]
mod tests;
mod yielding;

use std::collections::BTreeSet;

use percuss::{Fault, ImpactResolution, Model, ModelBuilder, PathEnd, PathSettings, Settings};

use locate::in_file_words;

use crate::code::of_path;
use crate::content::{self, Content, Impacts, Law, PathTarget, ProjectileKind};
use crate::diagnostic::{Diagnostic, Diagnostics};
use crate::given::Given;
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
    /// How far a static equilibrium path is followed.
    pub path: PathSettings,
    /// Coefficients of restitution to compare, if the report asks for it, shape (coefficients) \[-\].
    pub comparison: Option<Vec<f64>>,
}

impl Scenario {
    /// Builds the model.
    ///
    /// # Errors
    /// Every fault of the model and the settings, each at its place in the file.
    pub fn compile(&self) -> Result<Compiled, Diagnostics> {
        let content = &self.content;
        let mut settings = settings(content);
        let mut faults = comparison_faults(content);
        faults.extend(shapes_fault(content));
        faults.extend(scaled_accelerations(content, &self.accelerations));
        let path = path(content).map_err(|fault| faults.push(fault)).unwrap_or_default();
        match build(content, Some(&self.given)) {
            Ok(model) => {
                if settings.accuracy.is_some() {
                    settings.step = percuss::first_step(&model, settings.end);
                }
                faults.extend(settings.validate(&model));
                if faults.is_empty() {
                    let comparison = content.report.restitution.clone();
                    let title = content.title.clone();
                    return Ok(Compiled { title, model, settings, path, comparison });
                }
            }
            Err(found) => {
                faults.extend(found);
                faults.extend(settings_alone(content, &settings));
            }
        }
        Err(self.diagnostics(faults))
    }

    /// How large the model becomes, before it is built.
    pub fn extent(&self) -> percuss::ModelExtent {
        build::definitions(&self.content, Some(&self.given)).0.extent()
    }

    /// What stands in the compiled model, for drawings.
    pub fn scene(&self, model: &Model) -> percuss::scene::Scene {
        build::definitions(&self.content, Some(&self.given)).0.scene(model)
    }

    /// Faults found later, by an analysis, at their places in the file.
    pub fn diagnostics(&self, faults: Vec<Fault>) -> Diagnostics {
        let faults = faults.into_iter().map(|fault| in_file_words(&self.content, fault));
        let all = faults.map(|f| locate(f, &self.source, &self.places));
        Diagnostics::new((*self.source).clone(), all.collect())
    }
}

/// Base accelerations that would scale a file of accelerations, where their numbers have been set after reading.
fn scaled_accelerations(content: &Content, files: &BTreeSet<String>) -> Vec<Fault> {
    let of = |load: &Named<content::Load>| {
        let path = format!("load.{}", load.name);
        let is_file = files.contains(&format!("{path}.function.file"));
        let (found, expected) = load.table.scales_accelerations().filter(|_| is_file)?;
        Some(Fault::new(format!("{path}.acceleration"), found, expected))
    };
    content.load.iter().filter_map(of).collect()
}

/// Faults of the model of a file with reading faults, as far as they do not follow from these.
pub(crate) fn valid_part(
    content: &Content,
    tainted: &BTreeSet<String>,
    source: &Source,
    places: &Places,
) -> Vec<Diagnostic> {
    let mut content = content.clone();
    content.beam.iter_mut().for_each(|beam| follow::coarsen(&mut beam.table));
    let mut faults = comparison_faults(&content);
    faults.extend(path(&content).err());
    // What refers to beams that are not there has been reported by the reader.
    if !content.beam.is_empty() {
        faults.extend(build(&content, None).err().unwrap_or_default());
    }
    faults.extend(settings_alone(&content, &settings(&content)));
    follow::keep_valid(&content, tainted, &mut faults);
    faults.into_iter().map(|f| locate(f, source, places)).collect()
}

fn locate(fault: Fault, source: &Source, places: &Places) -> Diagnostic {
    let span = places.find(&fault.path).unwrap_or(0..0);
    Diagnostic::at(of_path(&fault.path), source, span, fault.path, fault.found, fault.expected)
}

fn settings(content: &Content) -> Settings {
    use content::Scheme;
    let time = &content.time;
    // Where steps are chosen, until there is a model to ask; where neither is given, that has been reported.
    let mut settings = Settings::new(time.end, time.step.unwrap_or(time.end));
    settings.accuracy = time.accuracy.filter(|_| time.step.is_none());
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
    settings.start = content.time.start;
    settings.multiple_impacts = content.time.multiple_impacts;
    settings
}

/// Faults of the settings where the model itself has faults: a valid model stands in for it.
fn settings_alone(content: &Content, settings: &Settings) -> Vec<Fault> {
    let mut builder = ModelBuilder::new();
    let material = builder.material(percuss::Material::new("m", 1.0, 1.0));
    let section = builder.section(percuss::Section::new("s", 1.0, 1.0));
    let points = [[0.0, 0.0], [1.0, 0.0]];
    let beam = builder.beam(percuss::Beam::new("b", &points, 1, material, section));
    let struck = content.projectile.iter().any(is_rigid);
    if struck || content.contact.iter().any(|c| matches!(c.table.law, Law::Rigid { .. })) {
        let kind = percuss::ProjectileKind::Rigid { restitution: 1.0 };
        let along = percuss::Along::Fraction(0.5);
        let strikes = percuss::PointRef { label: String::new(), beam, along };
        builder.projectile(percuss::Projectile::new("p", kind, 1.0, [0.0, 1.0], strikes));
    }
    builder.build().map(|model| settings.validate(&model)).unwrap_or_default()
}

/// Memory for shapes is no negative number, and not more than a machine has.
fn shapes_fault(content: &Content) -> Option<Fault> {
    let megabytes = content.record.shapes;
    let expected = "megabytes from 0 (no shapes are kept) to 1000";
    let path = "record.shapes";
    (!(0.0..=1000.0).contains(&megabytes))
        .then(|| Fault::new(path, megabytes.to_string(), expected))
}

/// The comparison of coefficients belongs to the report, so the core knows nothing of it.
fn comparison_faults(content: &Content) -> Vec<Fault> {
    let Some(list) = &content.report.restitution else { return Vec::new() };
    let fault =
        |found: String, expected: &str| vec![Fault::new("report.restitution", found, expected)];
    if list.is_empty() {
        return fault("an empty list".into(), "coefficients from 0 to 1");
    }
    if let Some(bad) = list.iter().find(|e| !(0.0..=1.0).contains(*e)) {
        return fault(bad.to_string(), "coefficients from 0 to 1");
    }
    if !content.projectile.iter().any(is_rigid) {
        return fault(
            "coefficients without a rigid projectile".into(),
            "a projectile of kind \"rigid\"",
        );
    }
    Vec::new()
}

fn is_rigid(projectile: &Named<content::Projectile>) -> bool {
    matches!(projectile.table.kind, ProjectileKind::Rigid { .. })
}

/// How far an equilibrium path is followed.
fn path(content: &Content) -> Result<PathSettings, Fault> {
    let content::Path { first, points, factor, until } = &content.path;
    let fault = |key: &str, found: String, expected: &str| {
        Err(Fault::new(format!("path.{key}"), found, expected))
    };
    if *first <= 0.0 {
        return fault("first", first.to_string(), "a load factor above zero");
    }
    if *points == 0 {
        return fault("points", "0".into(), "at least 1 point");
    }
    let end = match until {
        Some(PathTarget { component, .. }) if !(1..=2).contains(component) => {
            return fault("until.component", component.to_string(), "1 or 2");
        }
        Some(PathTarget { value: 0.0, .. }) => {
            return fault("until.value", "0 m".into(), "a displacement to reach, not zero");
        }
        Some(PathTarget { point, component, value }) => {
            let (point, component, value) = (point.label.clone(), *component, *value);
            PathEnd::Displacement { point, component, value }
        }
        None => PathEnd::Factor(factor.unwrap_or(1.0)),
    };
    match end {
        PathEnd::Factor(0.0) => fault("factor", "0".into(), "a load factor to reach, not zero"),
        end => Ok(PathSettings { first: *first, points: *points, end }),
    }
}

/// The model; functions given where none are looked at are left to a valid text.
fn build(content: &Content, given: Option<&Given>) -> Result<Model, Vec<Fault>> {
    let (builder, mut faults) = build::definitions(content, given);
    match builder.build() {
        Ok(model) if faults.is_empty() => Ok(model),
        Ok(_) => Err(faults),
        Err(mut found) => {
            // The file has been asked already, where what names an obstacle may be at fault itself.
            found.retain(|fault| fault.found != Fault::UNTOUCHED);
            faults.extend(found.into_iter().map(|fault| in_file_words(content, fault)));
            Err(faults)
        }
    }
}
