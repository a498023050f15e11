//! Parameters: where they stand in the scenarios of the tests, and their values in SI units.

use percuss::Fault;
use percuss_scenario::fit::{FitContent, FitParameter};
use percuss_scenario::study::{Given, Spacing};
use percuss_scenario::{Field, Named, Scenario};

use crate::parameter::Adjustable;

/// Numbers that a test adjusts, and where they stand in its scenario.
type Fields = Vec<(usize, Field)>;

/// The parameters of a file, and the fields of each test, shape (tests).
pub(super) fn numbers(
    content: &FitContent,
    scenarios: &[Scenario],
    faults: &mut Vec<Fault>,
) -> (Vec<Adjustable>, Vec<Fields>) {
    let mut fields: Vec<Fields> = vec![Vec::new(); scenarios.len()];
    let mut all = Vec::new();
    // What a parameter without a path, or a fit without a test, lacks has been reported.
    let given = content.parameter.iter().filter(|one| paths(&one.table).next().is_some());
    for named in given.filter(|_| !scenarios.is_empty()) {
        let header = format!("parameter.{}", named.name);
        let found = places(content, named, scenarios)
            .and_then(|places| Ok((adjustable(named, scenarios, &places, content)?, places)));
        match found {
            Ok((one, places)) => {
                for (test, field) in places {
                    fields[test].push((all.len(), field));
                }
                all.push(one);
            }
            Err(fault) => faults.push(Fault { path: format!("{header}.{}", fault.path), ..fault }),
        }
    }
    faults.extend(twice_set(content, &all, &fields));
    (all, fields)
}

/// Where a parameter stands: numbers of tests, and fields of their scenarios.
fn places(
    content: &FitContent,
    named: &Named<FitParameter>,
    scenarios: &[Scenario],
) -> Result<Vec<(usize, Field)>, Fault> {
    let given = &named.table;
    let key = if given.path.is_some() { "path" } else { "paths" };
    let mut tests: Vec<usize> = (0..scenarios.len()).collect();
    if let Some(names) = &given.tests {
        let known: Vec<&str> = content.test.iter().map(|test| test.name.as_str()).collect();
        if let Some(unknown) = names.iter().find(|name| !known.contains(&name.as_str())) {
            let expected = percuss_scenario::one_of(unknown, known.into_iter());
            return Err(Fault::new("tests", format!("the unknown test `{unknown}`"), expected));
        }
        if names.is_empty() {
            let expected = "names of tests, or no `tests` for a parameter of all tests";
            return Err(Fault::new("tests", "an empty list", expected));
        }
        tests.retain(|k| names.contains(&content.test[*k].name));
    }
    let mut places = Vec::new();
    for path in paths(given) {
        let mut missing = None;
        let before = places.len();
        for test in &tests {
            match scenarios[*test].field(path) {
                Ok(field) if field.is_setting() => {
                    let found = format!("`{path}`, a setting of the computation");
                    let expected = "a number of the model, such as a stiffness; a setting is given in the scenario, or by `set` of a test";
                    return Err(Fault::new(key, found, expected));
                }
                Ok(field) if field.needs_reread() => {
                    let found = format!("`{path}`, which is no number in the scenario");
                    return Err(Fault::new(key, found, "a number there to start from"));
                }
                Ok(field) => places.push((*test, field)),
                Err(fault) => missing = Some(fault),
            }
        }
        if places.len() == before
            && let Some(fault) = missing
        {
            return Err(Fault { path: key.into(), ..fault });
        }
    }
    Ok(places)
}

/// Paths of a parameter.
fn paths(given: &FitParameter) -> impl Iterator<Item = &String> {
    given.path.iter().chain(given.paths.iter().flatten())
}

/// Values in the words of a scenario.
struct Reader<'s> {
    scenario: Scenario,
    field: &'s Field,
}

impl Reader<'_> {
    fn number(&mut self, key: &str, given: &Given) -> Result<f64, Fault> {
        let set = self.scenario.set_toml(self.field, &given.toml);
        set.map_err(|fault| Fault { path: key.into(), ..fault })?;
        let found = self.scenario.number(self.field).map(|number| number.0);
        found.filter(|x| x.is_finite()).ok_or_else(|| {
            Fault::new(key, format!("{}, which is no number", given.toml), "a number")
        })
    }
}

fn adjustable(
    named: &Named<FitParameter>,
    scenarios: &[Scenario],
    places: &[(usize, Field)],
    content: &FitContent,
) -> Result<Adjustable, Fault> {
    let given = &named.table;
    let Some((test, field)) = places.first() else {
        return Err(Fault::new("path", "no test", "at least one [test.NAME]"));
    };
    let key = if given.path.is_some() { "path" } else { "paths" };
    let (own, unit) = continuous(key, scenarios, places, (*test, field))?;
    let mut reader = Reader { scenario: scenarios[*test].clone(), field };
    let start = given.start.as_ref().map_or(Ok(own), |start| reader.number("start", start))?;
    let bounds = match &given.bounds {
        None => [f64::NEG_INFINITY, f64::INFINITY],
        Some([low, high]) => [reader.number("bounds", low)?, reader.number("bounds", high)?],
    };
    if bounds[0] >= bounds[1] || bounds[0].is_nan() {
        let found = format!("from {:e} to {:e} {unit}", bounds[0], bounds[1]);
        return Err(Fault::new("bounds", found.trim_end(), "a smaller value, then a larger one"));
    }
    if !given.fixed && !(bounds[0]..=bounds[1]).contains(&start) {
        let found = format!("{start:e} {unit}");
        let found = format!("{}, outside the bounds", found.trim_end());
        return Err(Fault::new(
            if given.start.is_some() { "start" } else { "bounds" },
            found,
            "a starting value within the bounds",
        ));
    }
    let logarithmic = given.spacing == Spacing::Logarithmic;
    let positive = start > 0.0 && (given.bounds.is_none() || bounds[0] > 0.0);
    if logarithmic && !positive {
        let found = "\"log\" for values that are not all above zero";
        return Err(Fault::new("spacing", found, "a start and bounds above zero, or \"linear\""));
    }
    if content.fit.starts > 1 && given.bounds.is_none() && !given.fixed {
        let found = format!("no bounds with {} starting points", content.fit.starts);
        return Err(Fault::new("bounds", found, "`bounds`, in which starting points are spread"));
    }
    let prior = match &given.prior {
        None => None,
        Some(prior) => {
            let mean = reader.number("prior.mean", &prior.mean)?;
            let deviation = reader.number("prior.deviation", &prior.deviation)?;
            if deviation <= 0.0 {
                let found = deviation.to_string();
                return Err(Fault::new("prior.deviation", found, "a deviation above zero"));
            }
            Some([mean, deviation])
        }
    };
    Ok(Adjustable {
        name: named.name.clone(),
        unit: if unit.is_empty() { "1".into() } else { unit.into() },
        paths: paths(given).cloned().collect(),
        start,
        bounds,
        logarithmic,
        fixed: given.fixed,
        prior,
    })
}

/// The number that a parameter has in its first place, and its unit, which all of its places share.
///
/// # Errors
/// If there is no number in one of them, a whole one, or a quantity of another unit.
fn continuous(
    key: &str,
    scenarios: &[Scenario],
    places: &[(usize, Field)],
    first: (usize, &Field),
) -> Result<(f64, &'static str), Fault> {
    let at = |test: usize, field: &Field| {
        let mut scenario = scenarios[test].clone();
        let Some((own, unit)) = scenario.number(field) else {
            let found = format!("`{}`, which is no number", field.path());
            return Err(Fault::new(key, found, "the path of a number"));
        };
        // A count takes itself and nothing beside it.
        let whole = scenario.set_number(field, own).is_ok()
            && scenario.set_number(field, own + 0.5).is_err()
            && own.fract() == 0.0;
        match whole && scenario.set_number(field, own + 1.0).is_ok() {
            true => {
                let found = format!("`{}`, a whole number", field.path());
                Err(Fault::new(key, found, "a number that may vary a little, such as a stiffness"))
            }
            false => Ok((own, unit)),
        }
    };
    let (own, unit) = at(first.0, first.1)?;
    for (test, field) in places {
        let (_, other) = at(*test, field)?;
        if other != unit {
            let in_unit = |unit: &str| if unit.is_empty() { "no unit" } else { unit }.to_owned();
            let found = format!("`{}` ({})", field.path(), in_unit(other));
            let expected = format!("a number in {}, as `{}`", in_unit(unit), first.1.path());
            return Err(Fault::new(key, found, expected));
        }
    }
    Ok((own, unit))
}

/// Numbers that are set twice in one test, by two parameters or by one: the last would win, and derivatives would be wrong.
fn twice_set(content: &FitContent, all: &[Adjustable], fields: &[Fields]) -> Vec<Fault> {
    let mut faults: Vec<Fault> = Vec::new();
    for fields in fields {
        for (i, (k, field)) in fields.iter().enumerate() {
            let same = |(_, one): &&(usize, Field)| one.steps() == field.steps();
            let Some((other, _)) = fields[..i].iter().find(same) else { continue };
            let (name, path) = (&all[*k].name, field.path());
            let given = content.parameter.iter().find(|one| one.name == *name);
            let single = given.is_some_and(|one| one.table.path.is_some());
            let key = format!("parameter.{name}.{}", if single { "path" } else { "paths" });
            let found = match other == k {
                true => format!("`{path}` twice"),
                false => format!("`{path}`, which another parameter sets too"),
            };
            if faults.iter().any(|fault| fault.path == key && fault.found == found) {
                continue;
            }
            let expected = "a number that no other parameter sets in the same test (see `tests`)";
            faults.push(Fault::new(key, found, expected));
        }
    }
    faults
}
