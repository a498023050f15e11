//! `percuss eval`: a study at one point, from a file to a file, for programs that run programs.

mod asked;
mod dakota;
mod json;

use std::collections::HashSet;
use std::io::Read;
use std::path::Path;

use percuss_codes::{RequestCode, Topic};
use percuss_study::{Function, Study};

use crate::coupling_arguments::Eval;
use crate::outcome::{Failure, Status};
use crate::{new_file, scenario, terminal};
use asked::{Answered, Asked, Wanted};

/// More than any file of parameters needs [bytes].
const LARGEST_FILE: u64 = 16 << 20;

/// Evaluates a study at a point.
pub fn run(arguments: &Eval) -> Result<Status, Failure> {
    let study = Study::load_with(&arguments.study, scenario::access())?;
    let mut function = study.function()?;
    let text = read(&arguments.parameters)?;
    let is_json = is_json(&text);
    let at = |what: String| {
        let text = format!("{}: {what}", scenario::name(&arguments.parameters));
        Failure::input(RequestCode::NoValue, text)
    };
    let asked = if is_json { json::read(&text) } else { dakota::read(&text) }.map_err(at)?;
    let point = point(&function, &asked.variables).map_err(at)?;
    let wanted = wanted(&function, &asked, arguments.gradients).map_err(at)?;
    let by = by(&function, asked.by.as_deref()).map_err(at)?;
    if let Some(out) = arguments.results.as_deref().filter(|out| out.exists()) {
        let text = format!("{}: exists already; remove it or give another name", out.display());
        return Err(Failure::input(percuss_codes::FileCode::Foreign, text));
    }
    let (formatted, status) = match evaluate(&mut function, &point, &wanted, &by) {
        Ok(all) => {
            (if is_json { json::formatted(&all) } else { dakota::formatted(&all) }, Status::Done)
        }
        Err(why) => {
            terminal::say_error(&why);
            (if is_json { json::failed(&why) } else { dakota::failed(&why) }, Status::GaveUp)
        }
    };
    match &arguments.results {
        Some(out) => new_file::write(out, &formatted, "remove it or give another name")?,
        None => terminal::print(&formatted)?,
    }
    Ok(status)
}

/// Whether a file begins as a JSON table does; aprepro's form has names without quotes in its braces.
fn is_json(text: &str) -> bool {
    let inner = text.trim_start().strip_prefix('{').map(str::trim_start);
    inner.is_some_and(|inner| inner.starts_with(['"', '}']))
}

/// The whole of a file; one that is too large is not read in part.
fn read(path: &Path) -> Result<String, Failure> {
    let mut text = String::new();
    let read =
        |from: &mut dyn Read, text: &mut String| from.take(LARGEST_FILE + 1).read_to_string(text);
    let done = if path == Path::new("-") {
        read(&mut std::io::stdin().lock(), &mut text)
    } else {
        std::fs::File::open(path).and_then(|mut file| read(&mut file, &mut text))
    };
    let bytes = done.map_err(|error| Failure::system(path, "read", &error))?;
    if bytes as u64 > LARGEST_FILE {
        let text = format!(
            "{}: a file of more than {} MiB is no file of parameters",
            scenario::name(path),
            LARGEST_FILE >> 20
        );
        return Err(Failure::input(RequestCode::NoValue, text));
    }
    Ok(text)
}

/// The point that variables name.
fn point(function: &Function<'_>, variables: &[(String, f64)]) -> Result<Vec<f64>, String> {
    let names: Vec<&str> = variables.iter().map(|(name, _)| name.as_str()).collect();
    Ok(function.places(&names)?.into_iter().map(|place| variables[place].1).collect())
}

/// The functions that are wanted, each with the number of its result in the study.
fn wanted(
    function: &Function<'_>,
    asked: &Asked,
    gradients: bool,
) -> Result<Vec<(usize, Wanted)>, String> {
    let results: Vec<&str> = function.results().iter().map(|r| r.name.as_str()).collect();
    let Some(functions) = &asked.functions else {
        let all = results.iter().enumerate();
        let one = |(k, name): (usize, &&str)| {
            (k, Wanted { name: (*name).into(), value: true, gradient: gradients })
        };
        return Ok(all.map(one).collect());
    };
    if let Some(name) = twice(functions.iter().map(|f| f.name.as_str())) {
        return Err(format!("duplicate function `{name}`"));
    }
    let place = |name: &str| results.iter().position(|own| *own == name);
    let by_name: Option<Vec<usize>> = functions.iter().map(|f| place(&f.name)).collect();
    let unnamed = functions.iter().all(|f| place(&f.name).is_none());
    let places = match by_name {
        Some(places) => places,
        // Names of their own, such as `obj_fn`: the results in their order. Where some are names of results, order may not be meant.
        None if unnamed && functions.len() == results.len() => (0..results.len()).collect(),
        None => {
            let names: Vec<&str> = functions.iter().map(|f| f.name.as_str()).collect();
            return Err(format!(
                "functions {} do not match the study's results ({}): use exactly these names, or as many other names",
                names.join(", "),
                results.join(", ")
            ));
        }
    };
    let one = |(k, f): (usize, &Wanted)| {
        (k, Wanted { name: f.name.clone(), value: f.value, gradient: f.gradient || gradients })
    };
    Ok(places.into_iter().zip(functions).map(one).collect())
}

/// The parameters by which derivatives are wanted, each with its number in the study: those asked for, else all.
fn by(function: &Function<'_>, asked: Option<&[String]>) -> Result<Vec<(usize, String)>, String> {
    let parameters: Vec<&str> = function.parameters().iter().map(|p| p.name.as_str()).collect();
    let Some(asked) = asked else {
        return Ok(parameters.iter().map(|name| (*name).to_owned()).enumerate().collect());
    };
    if let Some(name) = twice(asked.iter().map(String::as_str)) {
        return Err(format!("duplicate derivative variable `{name}`"));
    }
    let place = |name: &String| {
        let found = parameters.iter().position(|own| own == name);
        found
            .map(|k| (k, name.clone()))
            .ok_or_else(|| format!("derivatives by a parameter: {}", function.no_parameter(name)))
    };
    asked.iter().map(place).collect()
}

/// A duplicate name.
fn twice<'n>(names: impl Iterator<Item = &'n str>) -> Option<&'n str> {
    let mut seen = HashSet::new();
    names.into_iter().find(|name| !seen.insert(*name))
}

fn evaluate(
    function: &mut Function<'_>,
    point: &[f64],
    wanted: &[(usize, Wanted)],
    by: &[(usize, String)],
) -> Result<Vec<Answered>, String> {
    let (mut derivatives, mut means) = (Vec::new(), None);
    if wanted.iter().any(|(_, f)| f.gradient) {
        let found = function.jacobian(point)?;
        (derivatives, means) = (found.derivatives, Some(found.means.to_string()));
    }
    // Values are those of a run of their own: one that carries derivatives adds in another order, and whoever asks with and without
    // gradients would get other last digits.
    let (mut values, mut open) = (Vec::new(), Vec::new());
    if wanted.iter().any(|(_, f)| f.value) {
        let found = function.evaluated(&[point.to_vec()]).pop();
        let found = found.unwrap_or_else(|| Err("no result".into()))?;
        let asked = |k: &usize| wanted.iter().any(|(own, f)| own == k && f.value);
        (values, open) = (found.values, found.open.into_iter().filter(asked).collect());
    }
    let one = |(k, f): &(usize, Wanted)| {
        let gradient =
            |row: &Vec<f64>| by.iter().map(|(k, name)| (name.clone(), row[*k])).collect();
        Answered {
            name: f.name.clone(),
            value: f.value.then(|| values[*k]),
            gradient: f.gradient.then(|| gradient(&derivatives[*k])),
            means: means.clone().filter(|_| f.gradient),
            open: f.value && open.contains(k),
        }
    };
    if let Some(text) = function.study().not_final(&open) {
        terminal::warning(Topic::Ending, &text);
    }
    Ok(wanted.iter().map(one).collect())
}
