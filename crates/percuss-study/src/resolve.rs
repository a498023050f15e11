//! From a study file to a study: paths found, values in SI units, every fault told at once.

use std::path::Path;

use nalgebra::{Cholesky, DMatrix};
use percuss::{Fault, NoRecorder, RunSummary};
use percuss_output::SummaryPath;
use percuss_scenario::study::{self, Given, Sampling, Spacing, StudyContent};
use percuss_scenario::{Diagnostics, Field, Scenario, StudyFile, one_of};

use crate::design::{Design, Kind, LATIN_POINTS, SOBOL_DIMENSIONS};
use crate::distribution::{Distribution, Gauss};
use crate::parameter::{Parameter, Variation};
use crate::study::{ResultColumn, Study};

/// Names that columns of every study have.
const TAKEN: [&str; 3] = ["run", "status", "reason"];

/// Checks a study and makes it self-contained.
///
/// # Errors
/// Every fault of the study, or those of its base scenario.
pub(crate) fn resolve(file: StudyFile) -> Result<Study, Diagnostics> {
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
    let mut settings = compiled.settings;
    settings.end = settings.step;
    let sample = percuss::simulate(&compiled.model, &settings, &mut NoRecorder)
        .map_err(|faults| scenario.diagnostics(faults))?;

    let mut parameters = Vec::new();
    for named in &file.content.parameter {
        let header = format!("parameter.{}", named.name);
        match parameter(&mut scenario, &named.name, &named.table) {
            Ok(parameter) => parameters.push(parameter),
            Err(fault) => faults.push(Fault { path: format!("{header}.{}", fault.path), ..fault }),
        }
    }
    let mut results = Vec::new();
    for named in &file.content.results {
        match result(&named.table, &sample) {
            Ok(path) => results.push(ResultColumn { name: named.name.clone(), path }),
            Err((found, expected)) => {
                faults.push(Fault::new(format!("results.{}", named.name), found, expected));
            }
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

/// Parameters that set the same value, or one a part of what the other sets: the last would win.
fn twice_set(parameters: &[Parameter]) -> Vec<Fault> {
    let steps = |p: &Parameter| -> Vec<String> {
        let path = p.field.path().replace('[', ".").replace(']', "");
        path.split('.').map(str::to_string).collect()
    };
    let mut faults = Vec::new();
    for (i, later) in parameters.iter().enumerate() {
        let own = steps(later);
        for earlier in &parameters[..i] {
            let other = steps(earlier);
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
        // It has been told of, and is not to be looked at.
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

/// Reads values of one parameter in the words of the scenario.
struct Values<'s> {
    scenario: &'s mut Scenario,
    field: Field,
    /// Unit of the first number read; all have the same one.
    unit: Option<&'static str>,
}

impl Values<'_> {
    fn number(&mut self, key: &str, given: &Given) -> Result<f64, Fault> {
        let fault = |found: String, expected: String| Fault::new(key, found, expected);
        let set = self.scenario.set_toml(&self.field, &given.toml);
        set.map_err(|f| fault(f.found, f.expected))?;
        let Some((number, unit)) = self.scenario.number(&self.field) else {
            let found = format!("{}, which is no number", given.toml);
            return Err(fault(found, "a number, or a list of `values`".into()));
        };
        if *self.unit.get_or_insert(unit) != unit {
            let found = format!("{}, of another kind than the values before", given.toml);
            return Err(fault(found, "all of them fractions or all of them lengths".into()));
        }
        Ok(number)
    }
}

fn parameter(
    scenario: &mut Scenario,
    name: &str,
    given: &study::Parameter,
) -> Result<Parameter, Fault> {
    let field = scenario.field(&given.path);
    let field = field.map_err(|fault| Fault { path: "path".into(), ..fault })?;
    let mut values = Values { scenario, field: field.clone(), unit: None };
    let variation = if let Some(list) = &given.values {
        list_of(&mut values, list)?
    } else if field.is_read_anew() {
        let found = format!("`{}`, which is no number in the base scenario", given.path);
        let expected = "a number there to start from, or a list of `values`";
        return Err(Fault::new("path", found, expected));
    } else if let Some(range) = &given.range {
        range_of(&mut values, range)?
    } else if let Some(distribution) = &given.distribution {
        Variation::Random(distribution_of(&mut values, distribution)?)
    } else {
        return Err(Fault::new("values", "nothing that varies", "`values`"));
    };
    let unit = match values.unit {
        Some("") | None => "1".to_string(),
        Some(unit) => unit.to_string(),
    };
    let example = match (&given.values, &given.range, &given.distribution) {
        (Some(list), ..) => list[0].toml.clone(),
        (_, Some(range), _) => range.from.toml.clone(),
        (.., Some(distribution)) => distribution.example().toml.clone(),
        _ => String::new(),
    };
    Ok(Parameter { name: name.into(), field, unit, example, variation })
}

/// A list: of numbers if all of them are, else of words.
fn list_of(values: &mut Values<'_>, list: &[Given]) -> Result<Variation, Fault> {
    if list.is_empty() {
        return Err(Fault::new("values", "an empty list", "at least one value"));
    }
    let words = || Variation::Words(list.iter().map(|given| given.toml.clone()).collect());
    if values.field.is_read_anew() {
        return Ok(words());
    }
    let mut numbers = Vec::new();
    for given in list {
        let set = values.scenario.set_toml(&values.field, &given.toml);
        set.map_err(|f| Fault::new("values", f.found, f.expected))?;
        numbers.push(values.scenario.number(&values.field));
    }
    let first = numbers[0].map(|(_, unit)| unit);
    if first.is_some() && numbers.iter().all(|n| n.map(|(_, unit)| unit) == first) {
        values.unit = first;
        return Ok(Variation::Numbers(numbers.into_iter().flatten().map(|n| n.0).collect()));
    }
    if values.field.path().contains('[') {
        let found = format!("words for `{}`, an entry of a list", values.field.path());
        return Err(Fault::new("values", found, "the path of the list, and lists as values"));
    }
    Ok(words())
}

fn range_of(values: &mut Values<'_>, range: &study::Range) -> Result<Variation, Fault> {
    let from = values.number("range.from", &range.from)?;
    let to = values.number("range.to", &range.to)?;
    let logarithmic = range.spacing == Spacing::Logarithmic;
    if logarithmic && !(from > 0.0 && to > 0.0) {
        let found = "\"log\" for a range that does not lie above zero";
        return Err(Fault::new("range.spacing", found, "both ends above zero, or \"linear\""));
    }
    if range.count == Some(1) && from != to {
        return Err(Fault::new("range.count", "1", "2 values or more, both ends included"));
    }
    Ok(Variation::Range { from, to, count: range.count, logarithmic })
}

fn distribution_of(
    values: &mut Values<'_>,
    distribution: &study::Distribution,
) -> Result<Distribution, Fault> {
    let fault = |key: &str, found: String, what: &str| {
        Fault::new(format!("distribution.{key}"), found, what)
    };
    match distribution {
        study::Distribution::Uniform { from, to } => {
            let from = values.number("distribution.from", from)?;
            let to = values.number("distribution.to", to)?;
            if from >= to {
                return Err(fault("to", to.to_string(), "a value above `from`"));
            }
            Ok(Distribution::Uniform { from, to })
        }
        study::Distribution::Normal { mean, deviation, truncated } => {
            let law = gauss(values, mean, deviation)?;
            let limits = limits(values, truncated.as_ref())?;
            let within = limits.map(|limits| limits.map(|limit| law.share(limit)));
            Ok(Distribution::Normal { law, within: checked(within)? })
        }
        study::Distribution::Lognormal { mean, deviation, truncated } => {
            let Gauss { mean, deviation } = gauss(values, mean, deviation)?;
            if mean <= 0.0 {
                return Err(fault("mean", mean.to_string(), "a mean above zero"));
            }
            let law = Gauss::of_logarithm(mean, deviation);
            let limits = limits(values, truncated.as_ref())?;
            let share = |limit: f64| if limit > 0.0 { law.share(limit.ln()) } else { 0.0 };
            let within = limits.map(|limits| limits.map(share));
            Ok(Distribution::Lognormal { law, within: checked(within)? })
        }
    }
}

fn gauss(values: &mut Values<'_>, mean: &Given, deviation: &Given) -> Result<Gauss, Fault> {
    let mean = values.number("distribution.mean", mean)?;
    let deviation = values.number("distribution.deviation", deviation)?;
    if deviation <= 0.0 {
        let found = deviation.to_string();
        return Err(Fault::new("distribution.deviation", found, "a deviation above zero"));
    }
    Ok(Gauss { mean, deviation })
}

fn limits(values: &mut Values<'_>, given: Option<&[Given; 2]>) -> Result<Option<[f64; 2]>, Fault> {
    let Some([low, high]) = given else { return Ok(None) };
    let key = "distribution.truncated";
    Ok(Some([values.number(key, low)?, values.number(key, high)?]))
}

/// Shares between which a distribution is left, all of it if it is not truncated.
fn checked(within: Option<[f64; 2]>) -> Result<[f64; 2], Fault> {
    let Some([low, high]) = within else { return Ok([0.0, 1.0]) };
    if high - low < 1e-9 {
        let found = format!("limits that hold a share of {:e} of all values", high - low);
        let expected = "a smaller limit, then a larger one, near the mean";
        return Err(Fault::new("distribution.truncated", found, expected));
    }
    Ok([low, high])
}

/// A path into the summary; else what was found and what would be right at the first step that leads nowhere.
pub(crate) fn result(path: &str, sample: &RunSummary) -> Result<SummaryPath, (String, String)> {
    let all = match SummaryPath::find(path, sample) {
        Ok(path) => return Ok(path),
        Err(all) => all,
    };
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

fn design(
    content: &StudyContent,
    parameters: &[Parameter],
    complete: bool,
    faults: &mut Vec<Fault>,
) -> Design {
    let dimension = parameters.len();
    let sampled = |kind, sampling: &Sampling| {
        let mut design = Design::new(kind, sampling.runs as u64, dimension, content.seed);
        design.sobol_indices = sampling.sobol_indices;
        design
    };
    let mut design = match &content.design {
        study::Design::Grid => grid(content, parameters, complete, faults),
        study::Design::LatinHypercube { sampling } => sampled(Kind::LatinHypercube, sampling),
        study::Design::Sobol { sampling } => sampled(Kind::Sobol, sampling),
        study::Design::MonteCarlo { sampling } => sampled(Kind::MonteCarlo, sampling),
    };
    let mut add = |path: &str, found: String, expected: &str| {
        faults.push(Fault::new(path, found, expected));
    };
    if design.kind == Kind::Sobol && 2 * dimension > SOBOL_DIMENSIONS {
        add("design.kind", format!("\"sobol\" with {dimension} parameters"), "at most 500");
    }
    if design.kind == Kind::LatinHypercube && design.points > LATIN_POINTS as u64 {
        add("design.runs", design.points.to_string(), "at most 1e8 for a Latin hypercube");
    }
    if design.kind != Kind::Grid && design.points == 0 {
        add("design.runs", "0".into(), "at least 1");
    }
    if !content.correlation.is_empty() {
        if design.sobol_indices {
            let found = "correlated parameters with `sobol_indices`";
            let expected = "independent parameters: the indices share out a variance among them";
            add("correlation", found.into(), expected);
        } else if design.kind == Kind::Grid {
            let expected = "a design of random values, such as \"sobol\"";
            add("correlation", "correlated parameters in a grid".into(), expected);
        } else if complete {
            design.correlation = correlation(content, parameters, faults);
            if !design.can_be_paired() {
                let found = format!("{} runs of {dimension} correlated parameters", design.points);
                let expected = "more runs: so few cannot be paired to the coefficients asked for";
                faults.push(Fault::new("design.runs", found, expected));
            }
        }
    }
    design
}

fn grid(
    content: &StudyContent,
    parameters: &[Parameter],
    complete: bool,
    faults: &mut Vec<Fault>,
) -> Design {
    let mut levels = Vec::new();
    for parameter in parameters {
        let path = format!("parameter.{}", parameter.name);
        match (&parameter.variation, parameter.variation.levels()) {
            (_, Some(count)) => levels.push(count as u64),
            (Variation::Range { .. }, None) => {
                let path = format!("{path}.range");
                faults.push(Fault::new(path, "no `count`", "a number of values for the grid"));
            }
            (_, None) => {
                let expected = "`values` or a `range` with a `count`, or another design";
                faults.push(Fault::new(path, "a distribution in a grid", expected));
            }
        }
    }
    let runs = levels.iter().try_fold(1_u64, |runs, n| runs.checked_mul(*n));
    let runs = runs.filter(|runs| *runs <= i64::MAX as u64).unwrap_or_else(|| {
        let found = format!("a grid of {levels:?} values");
        faults.push(Fault::new("design.kind", found, "fewer runs than 2^63"));
        1
    });
    let runs = if complete { runs } else { 1 };
    let mut design = Design::new(Kind::Grid, runs, parameters.len(), content.seed);
    design.levels = levels;
    design
}

/// Lower triangle of the correlation matrix.
fn correlation(
    content: &StudyContent,
    parameters: &[Parameter],
    faults: &mut Vec<Fault>,
) -> Option<DMatrix<f64>> {
    let names: Vec<&str> = parameters.iter().map(|p| p.name.as_str()).collect();
    let mut matrix = DMatrix::identity(names.len(), names.len());
    let before = faults.len();
    let mut told = std::collections::BTreeSet::new();
    let mut add = |found: String, expected: String| {
        faults.push(Fault::new("correlation", found, expected));
    };
    for one in &content.correlation {
        let at = one.between.each_ref().map(|name| names.iter().position(|n| n == name));
        for (name, _) in one.between.iter().zip(at).filter(|(_, at)| at.is_none()) {
            let expected = one_of(name, names.iter().copied());
            add(format!("the unknown parameter {name:?}"), expected);
        }
        let [Some(i), Some(j)] = at else { continue };
        if i != j && !told.insert((i.min(j), i.max(j))) {
            let found = format!("a second coefficient for {:?} and {:?}", names[i], names[j]);
            add(found, "one for each two parameters".into());
        }
        if i == j {
            add(format!("a correlation of {:?} with itself", names[i]), "two parameters".into());
        }
        if !(-1.0..=1.0).contains(&one.coefficient) {
            add(one.coefficient.to_string(), "a coefficient from -1 to 1".into());
        }
        matrix[(i, j)] = one.coefficient;
        matrix[(j, i)] = one.coefficient;
    }
    if faults.len() > before {
        return None;
    }
    let lower = Cholesky::new(matrix).map(|c| c.l());
    if lower.is_none() {
        let found = "coefficients that no random variables have together";
        faults.push(Fault::new("correlation", found, "a positive definite correlation matrix"));
    }
    lower
}
