//! The design of a study: how many runs, of which values, correlated or not.

use nalgebra::{Cholesky, DMatrix};
use percuss::Fault;
use percuss_scenario::one_of;
use percuss_scenario::study::{self, Sampling, StudyContent};

use crate::design::{Design, Kind, LATIN_POINTS, SOBOL_DIMENSIONS};
use crate::parameter::{Parameter, Variation};

/// The design of a study; `complete` if every parameter could be read.
pub(super) fn design(
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
                let expected = "more runs: too few for the requested coefficients";
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
    let mut known = std::collections::BTreeSet::new();
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
        if i != j && !known.insert((i.min(j), i.max(j))) {
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
        let found = "coefficients that are not a correlation matrix of random variables";
        faults.push(Fault::new("correlation", found, "a positive definite correlation matrix"));
    }
    lower
}
