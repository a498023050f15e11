//! Sobol indices of a study as a table.

use crate::analysis::{Estimate, NoIndices, SobolIndices, sobol_indices_of};
use crate::column::{Column, Role, Table, Values};
use crate::error::Error;
use crate::parquet::Writer;
use crate::study::Study;

/// The table of Sobol indices, in the directory of a study that has them.
pub const INDICES: &str = "indices.parquet";

/// Indices of a result, or why it has none.
pub type Found = Result<SobolIndices, NoIndices>;

/// Sobol indices of every result of a study that was arranged for them, by its name.
pub fn indices(study: &Study, table: &Table) -> Vec<(String, Found)> {
    if !study.has_sobol_indices() {
        return Vec::new();
    }
    let each = study.results().iter();
    each.map(|result| (result.name.clone(), sobol_indices_of(study, table, &result.name))).collect()
}

/// The indices as Parquet: a row for every result and parameter, with 95 % intervals.
///
/// # Errors
/// If the table cannot be encoded.
pub fn indices_parquet(study: &Study, indices: &[(String, Found)]) -> Result<Vec<u8>, Error> {
    let mut texts = [Vec::new(), Vec::new()];
    let mut numbers: [Vec<f64>; 7] = Default::default();
    let mut points = Vec::new();
    for (result, found) in indices {
        let Ok(found) = found else { continue };
        for (k, parameter) in study.parameters().iter().enumerate() {
            texts[0].push(result.clone());
            texts[1].push(parameter.name.clone());
            let of = |e: &Estimate| [e.value, e.low, e.high];
            let [first, total] = [of(&found.first[k]), of(&found.total[k])];
            let row = first.into_iter().chain(total).chain([found.variance]);
            numbers.iter_mut().zip(row).for_each(|(column, value)| column.push(value));
            points.push(found.points as i64);
        }
    }
    let column = |(name, about): (&str, &str)| Column {
        name: name.into(),
        unit: "1".into(),
        role: if matches!(name, "result" | "parameter") { Role::Input } else { Role::Result },
        about: about.into(),
    };
    let names = [
        ("result", "name of the result"),
        ("parameter", "name of the parameter"),
        ("first", "share of the variance that vanishes if the parameter alone is known"),
        ("first_low", "lower end of its 95 % interval"),
        ("first_high", "upper end of its 95 % interval"),
        ("total", "share of the variance that remains if all but the parameter are known"),
        ("total_low", "lower end of its 95 % interval"),
        ("total_high", "upper end of its 95 % interval"),
        ("variance", "variance of the result, in its unit squared"),
        ("points", "points of the design that count"),
    ];
    let texts = texts.into_iter().map(Values::Text);
    let values: Vec<Values> = texts
        .chain(numbers.into_iter().map(Values::Number))
        .chain([Values::Whole(points)])
        .collect();
    let layout = names.into_iter().map(column).zip(values.iter().map(Values::like)).collect();
    let fault = |e: parquet::errors::ParquetError| {
        Error::system(format!("the indices cannot be written: {e}"))
    };
    let mut bytes = Vec::new();
    let mut writer = Writer::with_layout(&mut bytes, study, layout, Vec::new()).map_err(fault)?;
    writer.write(&values).map_err(fault)?;
    writer.close().map_err(fault)?;
    Ok(bytes)
}
