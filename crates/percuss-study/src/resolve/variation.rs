//! How a parameter varies: its values in SI units, read in the words of the scenario.

use percuss::Fault;
use percuss_scenario::study::{self, Given, Spacing};
use percuss_scenario::{Field, Scenario};

use crate::distribution::{Distribution, Gauss, Truncation};
use crate::parameter::{Parameter, Variation};

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

/// A parameter; `listed` if its values are those of the runs one after the other.
pub(super) fn parameter(
    scenario: &mut Scenario,
    name: &str,
    given: &study::Parameter,
    listed: bool,
) -> Result<Parameter, Fault> {
    let field = scenario.field(&given.path);
    let field = field.map_err(|fault| Fault { path: "path".into(), ..fault })?;
    let mut values = Values { scenario, field: field.clone(), unit: None };
    let variation = if let Some(list) = &given.values {
        match listed.then(|| listed_numbers(&mut values, list)).flatten() {
            Some(numbers) => numbers?,
            None => list_of(&mut values, list)?,
        }
    } else if field.needs_reread() {
        let found = format!("`{}`, which is no number in the base scenario", given.path);
        let expected = "a number there to start from, or a list of `values`";
        return Err(Fault::new("path", found, expected));
    } else if let Some(range) = &given.range {
        range_of(&mut values, range)?
    } else if let Some(distribution) = &given.distribution {
        Variation::Random(distribution_of(&mut values, distribution)?)
    } else {
        let expected = match listed {
            true => "`values`, one for each run, or a column of the `file` of the design",
            false => "`values`, such as [\"10 m/s\", \"20 m/s\"], `range` or `distribution`",
        };
        return Err(Fault::new("values", "no variation", expected));
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

/// Numbers of runs one after the other, none if some are no numbers. Bare ones are in the SI unit of the value in the base scenario and are not
/// looked at here: one that cannot be is a run that is invalid, and leaves the others alone.
fn listed_numbers(values: &mut Values<'_>, list: &[Given]) -> Option<Result<Variation, Fault>> {
    if values.field.needs_reread() || list.is_empty() {
        return None;
    }
    let bare: Vec<Option<f64>> = list.iter().map(|given| given.toml.parse().ok()).collect();
    let mut unit = values.scenario.number(&values.field).map(|(_, unit)| unit);
    if unit.is_none() {
        // Where no number stands, the first one that can be there says what they mean.
        let first = list.iter().zip(&bare).find(|(given, bare)| {
            bare.is_some() && values.scenario.set_toml(&values.field, &given.toml).is_ok()
        });
        first?;
        unit = values.scenario.number(&values.field).map(|(_, unit)| unit);
    }
    // Numbers with units say themselves whether they are fractions or lengths.
    let unit = unit?;
    values.unit = bare.iter().any(Option::is_some).then_some(unit);
    if bare.iter().zip(list).any(|(bare, given)| bare.is_none() && given.is_word()) {
        return None;
    }
    let number = |(bare, given): (&Option<f64>, &Given)| match bare {
        Some(number) => Ok(*number),
        None => values.number("values", given),
    };
    Some(bare.iter().zip(list).map(number).collect::<Result<_, _>>().map(Variation::Numbers))
}

/// A list: of numbers if all of them are, else of words.
fn list_of(values: &mut Values<'_>, list: &[Given]) -> Result<Variation, Fault> {
    if list.is_empty() {
        return Err(Fault::new("values", "an empty list", "at least one value"));
    }
    let words = || Variation::Words(list.iter().map(|given| given.toml.clone()).collect());
    if values.field.needs_reread() {
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
    if values.field.steps().last().is_some_and(|step| percuss::is_index(step)) {
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
            Ok(Distribution::Normal { law, within: truncation(limits, |limit| law.share(limit))? })
        }
        study::Distribution::Lognormal { mean, deviation, truncated } => {
            let Gauss { mean, deviation } = gauss(values, mean, deviation)?;
            if mean <= 0.0 {
                return Err(fault("mean", mean.to_string(), "a mean above zero"));
            }
            let law = Gauss::of_logarithm(mean, deviation);
            let limits = limits(values, truncated.as_ref())?;
            let share = |limit: f64| if limit > 0.0 { law.share(limit.ln()) } else { 0.0 };
            Ok(Distribution::Lognormal { law, within: truncation(limits, share)? })
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

/// What is left of a distribution between limits, all of it without any.
fn truncation(limits: Option<[f64; 2]>, share: impl Fn(f64) -> f64) -> Result<Truncation, Fault> {
    let Some(values) = limits else { return Ok(Truncation::NONE) };
    let [low, high] = values.map(share);
    if high - low < 1e-9 {
        let found = format!("limits that contain a share of {:e} of all values", high - low);
        let expected = "a smaller limit, then a larger one, near the mean";
        return Err(Fault::new("distribution.truncated", found, expected));
    }
    Ok(Truncation { shares: [low, high], values })
}
