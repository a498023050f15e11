//! A study as a function, for Python.

use percuss_codes::RequestCode;
use percuss_study::{Distribution, Jacobian, Means, Variation};
use pyo3::prelude::*;

use crate::error::{Refusal, study_error};
use crate::structure::array;
use crate::watch::{Stop, Watch};

/// What goes in, or comes out: (name, unit, path).
type Named = (String, String, String);

/// Rows of numbers, for those that have none why, and of those that are not final what is said of them.
type Rows<'py> = (Bound<'py, PyAny>, Vec<(usize, String)>, Vec<(usize, String)>);

/// A number's smallest and largest value, or None where it has no bounds.
type Bounds = Option<(f64, f64)>;

/// Parameters, their bounds, their medians, and results.
type Layout = (Vec<Named>, Vec<Bounds>, Vec<f64>, Vec<Named>);

/// What goes into a study as a function, and what comes out.
///
/// Parameters
/// ----------
/// study : Study
///     The study.
///
/// Returns
/// -------
/// tuple
///     Parameters (name, unit, path), their bounds or None, their medians, and results (name, unit, path).
///
/// Raises
/// ------
/// InputError
///     If something else than a number varies.
///
/// Examples
/// --------
/// >>> study = percuss.function("speed.toml").study
/// >>> percuss._percuss.function_layout(study)[0]
/// [('speed', 'm/s', 'projectile.bag.velocity[1]')]
#[pyfunction]
pub fn function_layout(study: &Bound<'_, crate::study::Study>) -> PyResult<Layout> {
    let study = study.get().inner();
    let function = study.function().map_err(|error| study_error(&error))?;
    let parameters = function.parameters();
    let inputs = parameters
        .iter()
        .map(|p| (p.name.clone(), p.unit.clone(), p.field.path().to_string()))
        .collect();
    let bounds = parameters.iter().map(|p| p.variation.bounds()).collect();
    let results = function.results().iter();
    let outputs = results
        .map(|r| (r.name.clone(), r.path.unit().to_string(), r.path.path().to_string()))
        .collect();
    Ok((inputs, bounds, function.middle(), outputs))
}

/// Rows of a correlation matrix, or None of independent parameters.
type Correlation = Option<Vec<Vec<f64>>>;

/// A kind of variation, and its numbers in SI units.
type Varies = (&'static str, Vec<f64>);

/// How the parameters of a study vary.
///
/// Parameters
/// ----------
/// study : Study
///     The study.
///
/// Returns
/// -------
/// tuple
///     Of each parameter its kind with its numbers: `uniform` and `log-uniform` (smallest, largest), `normal` (mean, deviation), `lognormal`
///     (those of the logarithm), each of these `truncated-` with smallest and largest value before them, `values` (all of them); and the
///     correlation matrix of the Gaussian variables behind them, or None.
///
/// Examples
/// --------
/// >>> study = percuss.function("speed.toml").study
/// >>> percuss._percuss.function_variations(study)
/// ([('uniform', [-1.0, -9.0])], None)
#[pyfunction]
pub fn function_variations(
    study: &Bound<'_, crate::study::Study>,
) -> PyResult<(Vec<Varies>, Correlation)> {
    let study = study.get().inner();
    let function = study.function().map_err(|error| study_error(&error))?;
    let all = function.parameters().iter().map(|p| varies(&p.variation)).collect();
    Ok((all, function.correlation()))
}

fn varies(variation: &Variation) -> Varies {
    match variation {
        Variation::Numbers(values) => ("values", values.clone()),
        Variation::Words(_) => ("values", Vec::new()),
        Variation::Range { from, to, logarithmic: true, .. } => ("log-uniform", vec![*from, *to]),
        Variation::Range { from, to, .. } => ("uniform", vec![*from, *to]),
        Variation::Random(Distribution::Uniform { from, to }) => ("uniform", vec![*from, *to]),
        Variation::Random(Distribution::Normal { law, within }) => {
            let kind = ["normal", "truncated-normal"];
            truncated(kind, [law.mean, law.deviation], within.values)
        }
        Variation::Random(Distribution::Lognormal { law, within }) => {
            let kind = ["lognormal", "truncated-lognormal"];
            truncated(kind, [law.mean, law.deviation], within.values)
        }
    }
}

fn truncated([whole, cut]: [&'static str; 2], law: [f64; 2], within: [f64; 2]) -> Varies {
    match within.iter().all(|limit| limit.is_infinite()) {
        true => (whole, law.to_vec()),
        false => (cut, [within, law].concat()),
    }
}

/// The place of each parameter among names.
///
/// Parameters
/// ----------
/// study : Study
///     The study.
/// names : list of str
///     Names, in any order.
///
/// Returns
/// -------
/// list of int
///     Of each parameter its place among the names.
///
/// Raises
/// ------
/// InputError
///     If a name is none of a parameter, or one is missing.
///
/// Examples
/// --------
/// >>> study = percuss.function("speed-and-mass.toml").study
/// >>> percuss._percuss.function_places(study, ["mass", "speed", "young"])
/// [1, 0, 2]
#[pyfunction]
pub fn function_places(
    py: Python<'_>,
    study: &Bound<'_, crate::study::Study>,
    names: Vec<String>,
) -> PyResult<Vec<usize>> {
    let study = study.get().inner();
    let function = study.function().map_err(|error| study_error(&error))?;
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let unfit = |why| Refusal::Request(RequestCode::NoValue, why).exception(py);
    function.places(&names).map_err(unfit)
}

/// Points at shares of the distributions.
///
/// Parameters
/// ----------
/// study : Study
///     The study.
/// shares : list of list of float
///     Shares from 0 to 1.
///
/// Returns
/// -------
/// tuple
///     n_point * n_parameter numbers in SI units, point after point, and None; or why there are none.
///
/// Examples
/// --------
/// >>> study = percuss.function("speed.toml").study
/// >>> percuss._percuss.function_points(study, [[0.0], [0.5]])
/// (array([-1., -5.]), None)
#[pyfunction]
pub fn function_points<'py>(
    py: Python<'py>,
    study: &Bound<'py, crate::study::Study>,
    shares: Vec<Vec<f64>>,
) -> PyResult<(Bound<'py, PyAny>, Option<String>)> {
    let study = study.get().shared();
    let work = move |_: &Stop| -> Result<_, percuss_study::Error> {
        let function = study.function()?;
        Ok(shares.iter().map(|row| function.at(row)).collect::<Result<Vec<Vec<f64>>, String>>())
    };
    let points = Watch::default().run(py, work)?;
    let (points, why) = match points.map_err(|error| study_error(&error))? {
        Ok(points) => (points, None),
        Err(why) => (Vec::new(), Some(why)),
    };
    Ok((array(py, points.into_iter().flatten().collect()).into_any(), why))
}

/// Results at points.
///
/// Parameters
/// ----------
/// study : Study
///     The study.
/// points : list of list of float
///     Points, in SI units.
///
/// Returns
/// -------
/// tuple
///     n_point * n_result numbers, point after point, (point, why) of those that have none, and (point, text) of those with results that are
///     not final.
///
/// Examples
/// --------
/// >>> study = percuss.function("speed.toml").study
/// >>> values, failures, open = percuss._percuss.function_values(study, [[-5.0], [-1.0]])
/// >>> values.round()[::3], failures, open
/// (array([2561.,  512.]), [], [])
#[pyfunction]
pub fn function_values<'py>(
    py: Python<'py>,
    study: &Bound<'py, crate::study::Study>,
    points: Vec<Vec<f64>>,
) -> PyResult<Rows<'py>> {
    let study = study.get().shared();
    let work = move |stop: &Stop| -> Result<_, percuss_study::Error> {
        let mut function = study.function()?;
        let (mut numbers, mut failures, mut open) = (Vec::new(), Vec::new(), Vec::new());
        for (first, group) in points.chunks(GROUP).enumerate() {
            if stop.is_wanted() {
                break;
            }
            for (k, row) in function.evaluated(group).into_iter().enumerate() {
                let point = first * GROUP + k;
                match row {
                    Ok(row) => {
                        open.extend(study.not_final(&row.open).map(|text| (point, text)));
                        numbers.extend(row.values);
                    }
                    Err(why) => {
                        failures.push((point, why));
                        numbers.extend(study.results().iter().map(|_| f64::NAN));
                    }
                }
            }
        }
        Ok((numbers, failures, open))
    };
    let done = Watch::default().run(py, work)?;
    let (numbers, failures, open) = done.map_err(|error| study_error(&error))?;
    Ok((array(py, numbers).into_any(), failures, open))
}

/// The wish to end is looked for after so many points.
const GROUP: usize = 64;

/// Results, derivatives, how these were found, and why there are none.
type Found<'py> = (Bound<'py, PyAny>, Bound<'py, PyAny>, String, Option<String>);

/// Results at a point and their derivatives, or why there are none.
///
/// Parameters
/// ----------
/// study : Study
///     The study.
/// point : list of float
///     The point, in SI units.
///
/// Returns
/// -------
/// tuple
///     Results, n_result * n_parameter derivatives row by row, "exact" or "differences: " and why, and None; or what is missing and why.
///
/// Examples
/// --------
/// >>> study = percuss.function("speed-and-mass.toml").study
/// >>> values, slopes, means, why = percuss._percuss.function_jacobian(study, [20.0, 500.0, 2e9])
/// >>> len(values), len(slopes), means, why
/// (3, 9, 'exact', None)
#[pyfunction]
pub fn function_jacobian<'py>(
    py: Python<'py>,
    study: &Bound<'py, crate::study::Study>,
    point: Vec<f64>,
) -> PyResult<Found<'py>> {
    let study = study.get().shared();
    let work = move |_: &Stop| Ok(study.function()?.jacobian(&point));
    let found = Watch::default().run(py, work)?;
    let found = found.map_err(|error: percuss_study::Error| study_error(&error))?;
    let (found, why) = match found {
        Ok(found) => (found, None),
        Err(why) => (
            Jacobian { values: Vec::new(), derivatives: Vec::new(), means: Means::Exact },
            Some(why),
        ),
    };
    let derivatives = found.derivatives.into_iter().flatten().collect::<Vec<f64>>();
    let means = found.means.to_string();
    Ok((array(py, found.values).into_any(), array(py, derivatives).into_any(), means, why))
}
