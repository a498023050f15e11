//! From a study file to a study: paths found, values in SI units, every fault reported at once.

mod design;
mod variation;

use std::path::Path;

use percuss::{Channel, Fault, NoRecorder, RunSummary};
use percuss_batch::{ColumnSample, ColumnValue};
use percuss_output::SummaryPath;
use percuss_scenario::study::{self, ColumnResult, StudyContent, WantedResult};
use percuss_scenario::{Diagnostics, FileAccess, Scenario, StudyFile, one_of};

use self::design::design;
use self::variation::parameter;
use crate::history_columns::{columns_of, unknown_column};
use crate::parameter::Parameter;
use crate::result_path::{ColumnPath, ResultPath};
use crate::study::{ResultColumn, Study};

/// Names that columns of every study have.
const TAKEN: [&str; 3] = ["run", "status", "reason"];

impl Study {
    /// Reads a study from a file.
    ///
    /// # Errors
    /// Every fault of the study, or those of its base scenario.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, Diagnostics> {
        Self::load_with(path, FileAccess::OwnFolder)
    }

    /// The same, with a say in which files its scenario may name.
    ///
    /// # Errors
    /// As [`Study::load`].
    pub fn load_with(path: impl AsRef<Path>, access: FileAccess) -> Result<Self, Diagnostics> {
        resolve(StudyFile::load_with(path, access)?)
    }

    /// Reads a study; `name` stands for the file in messages, and the scenario it names lies where it lies.
    ///
    /// # Errors
    /// Every fault of the study, or those of its base scenario.
    pub fn from_toml(text: &str, name: &str) -> Result<Self, Diagnostics> {
        Self::from_toml_with(text, name, FileAccess::OwnFolder)
    }

    /// The same, with a say in which files its scenario may name.
    ///
    /// # Errors
    /// As [`Study::from_toml`].
    pub fn from_toml_with(text: &str, name: &str, access: FileAccess) -> Result<Self, Diagnostics> {
        resolve(StudyFile::read_with(text, name, access)?)
    }
}

/// Checks a study and makes it self-contained.
///
/// # Errors
/// Every fault of the study, or those of its base scenario.
fn resolve(file: StudyFile) -> Result<Study, Diagnostics> {
    let mut faults = names(&file.content);
    let base = match base(&file) {
        Ok(scenario) => Some(scenario),
        Err(Base::Missing(fault)) => {
            faults.push(fault);
            None
        }
        Err(Base::Faulty(diagnostics)) => {
            file.settle(faults)?;
            return Err(diagnostics);
        }
    };
    let Some(mut scenario) = base else {
        file.settle(faults)?;
        return Err(Diagnostics::of_file(file.name(), "no base scenario", "`base`"));
    };
    let compiled = scenario.compile()?;
    let end = compiled.settings.end;
    let channels = columns_of(&compiled).map_err(|faults| scenario.diagnostics(faults))?;
    let mut settings = compiled.settings;
    settings.end = settings.step;
    let sample = percuss::simulate(&compiled.model, &settings, &mut NoRecorder)
        .map_err(|faults| scenario.diagnostics(faults))?;

    let listed = matches!(file.content.design, study::Design::Points { .. });
    let mut parameters = Vec::new();
    for named in &file.content.parameter {
        let header = format!("parameter.{}", named.name);
        match parameter(&mut scenario, &named.name, &named.table, listed) {
            Ok(parameter) => parameters.push(parameter),
            Err(fault) => faults.push(Fault { path: format!("{header}.{}", fault.path), ..fault }),
        }
    }
    let varies_end = parameters.iter().any(|one| one.field.steps() == ["time", "end"]);
    let last = if varies_end { f64::INFINITY } else { end };
    let mut results = Vec::new();
    for named in &file.content.results {
        let header = format!("results.{}", named.name);
        match &named.table {
            WantedResult::Path(path) => match result(path, &sample) {
                Ok(path) => {
                    let path = ResultPath::Summary(path);
                    results.push(ResultColumn { name: named.name.clone(), path });
                }
                Err((found, expected)) => faults.push(Fault::new(header, found, expected)),
            },
            WantedResult::Column(column) => match of_column(&named.name, column, &channels) {
                Ok(all) => {
                    results.extend(all);
                    let late = beyond_end(column, last);
                    faults.extend(
                        late.map(|late| Fault { path: format!("{header}.{}", late.path), ..late }),
                    );
                }
                Err(fault) => faults.push(Fault { path: format!("{header}.column"), ..fault }),
            },
        }
    }
    faults.extend(twice_set(&parameters));
    let complete = parameters.len() == file.content.parameter.len();
    let design = design(&file.content, &parameters, complete, &mut faults);
    file.settle(faults)?;
    let mut content = file.content;
    content.base = None;
    content.scenario = Some(scenario_text(&scenario));
    Ok(Study::new(content, scenario, parameters, results, design))
}

/// Results taken from a column: one for each time or window.
fn of_column(
    name: &str,
    wanted: &ColumnResult,
    channels: &[Channel],
) -> Result<Vec<ResultColumn>, Fault> {
    let Some(channel) = channels.iter().find(|channel| channel.name == wanted.column) else {
        return Err(unknown_column(&wanted.column, channels));
    };
    let times = wanted.at.iter().flatten().map(|time| ColumnValue::At(*time));
    let windows = [
        wanted.max.map(|[from, to]| ColumnValue::Largest { from, to }),
        wanted.min.map(|[from, to]| ColumnValue::Smallest { from, to }),
    ];
    let taken: Vec<ColumnValue> = times.chain(windows.into_iter().flatten()).collect();
    let several = taken.len() > 1;
    let one = |(k, taken): (usize, ColumnValue)| {
        let sample = ColumnSample { column: wanted.column.clone(), taken };
        let name = if several { format!("{name}[{k}]") } else { name.to_string() };
        let path = ResultPath::Column(ColumnPath::new(sample, channel.unit));
        ResultColumn { name, path }
    };
    Ok(taken.into_iter().enumerate().map(one).collect())
}

/// A time, or the start of a window, that lies beyond the end of the run.
fn beyond_end(wanted: &ColumnResult, end: f64) -> Option<Fault> {
    let last = wanted.at.iter().flatten().copied().reduce(f64::max);
    let starts =
        [("at", last), ("max", wanted.max.map(|w| w[0])), ("min", wanted.min.map(|w| w[0]))];
    let (key, time) = starts.into_iter().find(|(_, time)| time.is_some_and(|time| time > end))?;
    let found = format!("the time {} s, when the run has ended", time.unwrap_or(f64::NAN));
    Some(Fault::new(key, found, format!("times up to `time.end` of the scenario, {end} s")))
}

/// Parameters that set the same value, or one a part of what the other sets: the last would win.
fn twice_set(parameters: &[Parameter]) -> Vec<Fault> {
    let mut faults = Vec::new();
    for (i, later) in parameters.iter().enumerate() {
        let own = later.field.steps();
        for earlier in &parameters[..i] {
            let other = earlier.field.steps();
            let shared = own.len().min(other.len());
            if own[..shared] == other[..shared] {
                let (path, name) = (later.field.path(), &earlier.name);
                let found =
                    format!("`{path}`, which `{name}` sets too (`{}`)", earlier.field.path());
                let path = format!("parameter.{}.path", later.name);
                faults.push(Fault::new(path, found, "a value that no other parameter sets"));
            }
        }
    }
    faults
}

/// The text of the scenario, ending in a line end, so that it reads well within the study.
fn scenario_text(scenario: &Scenario) -> String {
    scenario.self_contained()
}

/// Why there is no base scenario.
enum Base {
    Missing(Fault),
    Faulty(Diagnostics),
}

fn base(file: &StudyFile) -> Result<Scenario, Base> {
    let content = &file.content;
    if let Some(text) = &content.scenario {
        let name = format!("scenario in {}", file.name());
        return percuss_scenario::read_whole(text, &name, file.access()).map_err(Base::Faulty);
    }
    let path = content.base.as_deref().filter(|path| !path.is_empty());
    let example = "the path of a scenario, such as \"elastic.toml\"";
    let Some(path) = path else {
        return Err(Base::Missing(Fault::new("base", "no `base`", example)));
    };
    if file.is_tainted("base") {
        // It has been reported, and is not to be looked at.
        return Err(Base::Missing(Fault::new("base", "a file that is not read", example)));
    }
    let access = file.access();
    let file: &Path = &file.folder().join(path);
    if !file.is_file() {
        let found = format!("{path:?}, where there is no file");
        return Err(Base::Missing(Fault::new("base", found, example)));
    }
    percuss_scenario::load_whole(file, access).map_err(Base::Faulty)
}

/// Names that two columns share, or that every study has; and what is not there at all.
fn names(content: &StudyContent) -> Vec<Fault> {
    let mut faults = Vec::new();
    let parameters = content.parameter.iter().map(|p| ("parameter", &p.name));
    let results = content.results.iter().map(|r| ("results", &r.name));
    let mut seen: Vec<&str> = TAKEN.to_vec();
    for (table, name) in parameters.chain(results) {
        if seen.contains(&name.as_str()) {
            let found = format!("the name `{name}`, which another column of the table has");
            faults.push(Fault::new(format!("{table}.{name}"), found, "another name"));
        }
        seen.push(name);
    }
    if content.parameter.is_empty() {
        faults.push(Fault::new("parameter", "no parameter", "at least one [parameter.NAME]"));
    }
    if content.results.is_empty() {
        let expected = "at least one, such as peak_force = \"contact.mass.peak_force.value\"";
        faults.push(Fault::new("results", "no results", expected));
    }
    faults
}

/// A path into the summary; else what was found and what would be right at the first step that leads nowhere.
pub(crate) fn result(path: &str, sample: &RunSummary) -> Result<SummaryPath, (String, String)> {
    let all = match SummaryPath::find(path, sample) {
        Ok(path) => return Ok(path),
        Err(all) => all,
    };
    if let Some(fault) = SummaryPath::misspelt(path, sample) {
        return Err((format!("{} in `{path}`", fault.found), fault.expected));
    }
    let known: Vec<Vec<String>> =
        all.iter().map(|one| SummaryPath::steps(&one.path, sample)).collect();
    let wanted = SummaryPath::steps(path, sample);
    let right = (0..=wanted.len()).rev();
    let right = right.clone().find(|&n| known.iter().any(|k| k.starts_with(&wanted[..n])));
    let right = right.unwrap_or(0);
    let mut next: Vec<&str> = Vec::new();
    for known in known.iter().filter(|k| k.starts_with(&wanted[..right])) {
        if let Some(step) = known.get(right)
            && !next.contains(&step.as_str())
        {
            next.push(step);
        }
    }
    let word = wanted.get(right).map_or("", String::as_str);
    let found = match (word, next.is_empty()) {
        ("", _) => format!("`{path}`, which is a table of the summary"),
        (word, true) => format!("`{word}` behind a number in `{path}`"),
        (word, false) => format!("the unknown key `{word}` in `{path}`"),
    };
    let expected = match next.is_empty() {
        true => format!("`{}`", wanted[..right].join(".")),
        false => one_of(word, next.into_iter()),
    };
    Err((found, expected))
}
