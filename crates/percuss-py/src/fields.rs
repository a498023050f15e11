//! The scene of a run and how it moved, as arrays that NumPy owns, and back.

use numpy::{Element, PyReadonlyArrayDyn};
use percuss_output::fields::{Fields, StoredFrame};
use percuss_output::paraview::{self, Format};
use percuss_output::report;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;

use crate::error::output_error;
use crate::structure::shaped;
use crate::watch::Watch;

/// `scene` (JSON), `time`, and lists of the frames: `displacement`, `velocity`, `angular_velocity`, `section_forces`, `load_factors`, and
/// `contact_forces` and `section_points` of all frames one behind the other with their `contact_counts` and `point_counts`.
pub fn to_python<'py>(py: Python<'py>, fields: &Fields) -> PyResult<Bound<'py, PyDict>> {
    let frames = &fields.frames;
    let n = frames.len();
    let out = PyDict::new(py);
    out.set_item("scene", fields.scene.to_string())?;
    let times: Vec<f64> = frames.iter().map(|f| f.time).collect();
    out.set_item("time", shaped(py, times, &[n])?)?;
    let all = |list: fn(&StoredFrame) -> &Vec<f32>| -> Vec<f32> {
        frames.iter().flat_map(|f| list(f).iter().copied()).collect()
    };
    let each = |values: &Vec<f32>, width: usize| values.len() / width / n.max(1);
    let displacement = all(|f| &f.displacement);
    let nodes = each(&displacement, 4);
    out.set_item("displacement", shaped(py, displacement, &[n, nodes, 4])?)?;
    let velocity = all(|f| &f.velocity);
    let nodes = each(&velocity, 4);
    out.set_item("velocity", shaped(py, velocity, &[n, nodes, 4])?)?;
    let spins = all(|f| &f.angular_velocity);
    let intervals = each(&spins, 3);
    out.set_item("angular_velocity", shaped(py, spins, &[n, intervals, 3])?)?;
    let forces = all(|f| &f.section_forces);
    let intervals = each(&forces, 6);
    out.set_item("section_forces", shaped(py, forces, &[n, intervals, 2, 3])?)?;
    let factors = all(|f| &f.load_factors);
    let loads = each(&factors, 1);
    out.set_item("load_factors", shaped(py, factors, &[n, loads])?)?;
    let contacts = all(|f| &f.contact_forces);
    let rows = contacts.len() / 6;
    out.set_item("contact_forces", shaped(py, contacts, &[rows, 6])?)?;
    let counts: Vec<i64> = frames.iter().map(|f| (f.contact_forces.len() / 6) as i64).collect();
    out.set_item("contact_counts", shaped(py, counts, &[n])?)?;
    let points = all(|f| &f.section_points);
    let rows = points.len() / 5;
    out.set_item("section_points", shaped(py, points, &[rows, 5])?)?;
    let counts: Vec<i64> = frames.iter().map(|f| (f.section_points.len() / 5) as i64).collect();
    out.set_item("point_counts", shaped(py, counts, &[n])?)?;
    Ok(out)
}

/// The way back.
fn from_python(fields: &Bound<'_, PyDict>) -> PyResult<Fields> {
    let item = |key: &str| -> PyResult<Bound<'_, PyAny>> {
        fields.get_item(key)?.ok_or_else(|| PyValueError::new_err(format!("fields without {key}")))
    };
    let text: String = item("scene")?.extract()?;
    let scene = serde_json::from_str(&text).map_err(|e| PyValueError::new_err(e.to_string()))?;
    let times = numbers::<f64>(&item("time")?)?;
    let counts = numbers::<i64>(&item("contact_counts")?)?;
    let n = times.len();
    let lists = ["displacement", "velocity", "angular_velocity", "section_forces", "load_factors"];
    let lists = lists.map(|key| item(key).and_then(|list| numbers::<f32>(&list)));
    let [displacement, velocity, angular_velocity, section_forces, load_factors] = lists;
    let contacts = numbers::<f32>(&item("contact_forces")?)?;
    let all = [displacement?, velocity?, angular_velocity?, section_forces?, load_factors?];
    let points = numbers::<f32>(&item("section_points")?)?;
    let point_counts = numbers::<i64>(&item("point_counts")?)?;
    let (mut frames, mut at, mut from) = (Vec::with_capacity(n), 0, 0);
    for (k, time) in times.into_iter().enumerate() {
        let part = |list: &Vec<f32>| {
            let width = list.len() / n;
            list[k * width..(k + 1) * width].to_vec()
        };
        let count = 6 * usize::try_from(counts[k]).unwrap_or(0);
        let contact_forces = contacts.get(at..at + count).unwrap_or_default().to_vec();
        at += count;
        let count = 5 * usize::try_from(point_counts[k]).unwrap_or(0);
        let section_points = points.get(from..from + count).unwrap_or_default().to_vec();
        from += count;
        let [displacement, velocity, angular_velocity, section_forces, load_factors] =
            all.each_ref().map(part);
        frames.push(StoredFrame {
            time,
            displacement,
            velocity,
            angular_velocity,
            section_forces,
            section_points,
            contact_forces,
            load_factors,
        });
    }
    Ok(Fields { scene, frames })
}

fn numbers<T: Element + Copy>(array: &Bound<'_, PyAny>) -> PyResult<Vec<T>> {
    let array: PyReadonlyArrayDyn<'_, T> = array.extract()?;
    Ok(array.as_array().iter().copied().collect())
}

/// The scene in motion as a page of its own with what the summary tells.
///
/// Parameters
/// ----------
/// fields : dict
///     Those of a run.
/// summary : str
///     That of the run, JSON.
///
/// Returns
/// -------
/// str or None
///     HTML; None without frames.
///
/// Examples
/// --------
/// >>> native = percuss._percuss.open(percuss.run("plank.toml", out="plank") and "plank")
/// >>> percuss._percuss.scene_page(native["fields"], native["summary"])[:15]
/// '<!doctype html>'
#[pyfunction]
pub fn scene_page(
    py: Python<'_>,
    fields: &Bound<'_, PyDict>,
    summary: &str,
) -> PyResult<Option<String>> {
    let fields = from_python(fields)?;
    let summary =
        serde_json::from_str(summary).map_err(|e| PyValueError::new_err(e.to_string()))?;
    Watch::default().run(py, move |_| report::scene_page(&fields, &summary))
}

/// What happened, in a few sentences.
///
/// Parameters
/// ----------
/// summary : str
///     That of a run, JSON.
///
/// Returns
/// -------
/// str
///     The sentences of the terminal and the report.
///
/// Examples
/// --------
/// >>> native = percuss._percuss.open(percuss.run("plank.toml", out="plank") and "plank")
/// >>> percuss._percuss.story(native["summary"]).split(" at ")[0]
/// "'plank.mid' was struck by projectile 'bag'"
#[pyfunction]
pub fn story(summary: &str) -> PyResult<String> {
    let summary =
        serde_json::from_str(summary).map_err(|e| PyValueError::new_err(e.to_string()))?;
    Ok(report::story(&summary))
}

/// The instant of greatest interest, at which a page opens.
///
/// Parameters
/// ----------
/// summary : str
///     That of a run, JSON.
///
/// Returns
/// -------
/// float or None
///     The end where something stays bent or has failed, else that of the largest contact force, else of the largest impulse [s]; None where
///     nothing touches.
///
/// Examples
/// --------
/// >>> native = percuss._percuss.open(percuss.run("plank.toml", out="plank") and "plank")
/// >>> round(percuss._percuss.instant(native["summary"]), 4)
/// 0.0305
#[pyfunction]
pub fn instant(summary: &str) -> PyResult<Option<f64>> {
    let summary =
        serde_json::from_str(summary).map_err(|e| PyValueError::new_err(e.to_string()))?;
    Ok(report::instant(&summary))
}

/// How a run ended and the number of its warnings, in a line.
///
/// Parameters
/// ----------
/// summary : str
///     That of a run, JSON.
///
/// Returns
/// -------
/// str
///     The words of the terminal and the report.
///
/// Examples
/// --------
/// >>> native = percuss._percuss.open(percuss.run("plank.toml", out="plank") and "plank")
/// >>> percuss._percuss.state(native["summary"]).split(",")[0]
/// 'Completed'
#[pyfunction]
pub fn state(summary: &str) -> PyResult<String> {
    let summary =
        serde_json::from_str(summary).map_err(|e| PyValueError::new_err(e.to_string()))?;
    let state = report::RunState::of(&summary);
    Ok(format!("{}, {}", state.words, state.warnings_in_words()))
}

/// Writes the frames for ParaView.
///
/// Parameters
/// ----------
/// fields : dict
///     Those of a run.
/// directory : str or path
///     Where to; it is made.
/// format : {"vtkhdf", "pvd"}
///     The kind of files.
///
/// Returns
/// -------
/// list of str
///     Names of the files to open.
///
/// Raises
/// ------
/// InputError
///     If there is no such format.
/// FileError
///     If the files cannot be written.
///
/// Examples
/// --------
/// >>> native = percuss._percuss.open(percuss.run("plank.toml", out="plank", shapes=5) and "plank")
/// >>> percuss._percuss.export(native["fields"], "paraview", "vtkhdf")
/// ['beams.vtkhdf', ...]
#[pyfunction]
pub fn export(
    py: Python<'_>,
    fields: &Bound<'_, PyDict>,
    directory: PathBuf,
    format: &str,
) -> PyResult<Vec<String>> {
    let Some(format) = Format::ALL.into_iter().find(|f| f.name() == format) else {
        let names = Format::ALL.map(Format::name).join(" or ");
        return Err(PyValueError::new_err(format!("format={format:?}: expected {names}")));
    };
    let fields = from_python(fields)?;
    Watch::default()
        .run(py, move |_| paraview::export(&directory, &fields, format))?
        .map_err(|error| output_error(&error))
}
