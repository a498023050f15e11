//! Filtered accelerations and shock response spectra.

use percuss_codes::RequestCode;
use percuss_output::shock::{self, Band, Cfc, ShockError, Signal};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::error::Refusal;
use crate::structure::array;
use crate::watch::Watch;

fn refused(error: &ShockError) -> Refusal {
    Refusal::Request(RequestCode::Acceleration, error.to_string())
}

/// The acceleration that follows from a velocity, in a class if one is given.
fn signal(time: &[f64], velocity: &[f64], cfc: Option<u32>) -> Result<Signal, Refusal> {
    in_class(Signal::from_velocity(time, velocity).map_err(|error| refused(&error))?, cfc)
}

/// A signal in a class, if one is given.
fn in_class(signal: Signal, cfc: Option<u32>) -> Result<Signal, Refusal> {
    let Some(number) = cfc else { return Ok(signal) };
    let class = Cfc::of(number).ok_or_else(|| {
        let text = format!("cfc={number}: expected a class of SAE J211: 60, 180, 600 or 1000");
        Refusal::Request(RequestCode::Acceleration, text)
    })?;
    shock::filtered(&signal, class).map_err(|error| refused(&error))
}

/// The acceleration that follows from a velocity.
///
/// Parameters
/// ----------
/// time : list of float
///     Times of the rows [s].
/// velocity : list of float
///     Velocity there [m/s].
/// cfc : {60, 180, 600, 1000} or None
///     Channel frequency class to filter it in.
///
/// Returns
/// -------
/// dict
///     `time` [s], `values` [m/s^2], `resampled`: whether the rows were not evenly spaced.
///
/// Raises
/// ------
/// InputError
///     If the class is unknown, or there are too few rows for it.
///
/// Examples
/// --------
/// >>> percuss._percuss.acceleration([0.0, 0.1, 0.2], [0.0, 1.0, 2.0], None)["values"].round(6)
/// array([10., 10.])
#[pyfunction]
pub fn acceleration<'py>(
    py: Python<'py>,
    time: Vec<f64>,
    velocity: Vec<f64>,
    cfc: Option<u32>,
) -> PyResult<Bound<'py, PyDict>> {
    sampled(py, move || signal(&time, &velocity, cfc))
}

/// Times and values of a signal.
fn sampled(
    py: Python<'_>,
    work: impl FnOnce() -> Result<Signal, Refusal> + Send + 'static,
) -> PyResult<Bound<'_, PyDict>> {
    let signal = Watch::default().run(py, move |_| work())?;
    let signal = signal.map_err(|refusal| refusal.exception(py))?;
    let result = PyDict::new(py);
    result.set_item("time", array(py, signal.times().collect::<Vec<f64>>()))?;
    result.set_item("resampled", signal.resampled)?;
    result.set_item("values", array(py, signal.values))?;
    Ok(result)
}

/// A column of the history at even times.
///
/// Parameters
/// ----------
/// time : list of float
///     Times of the rows [s].
/// values : list of float
///     Values there [unit of the column].
/// cfc : {60, 180, 600, 1000} or None
///     Channel frequency class to filter it in.
///
/// Returns
/// -------
/// dict
///     `time` [s], `values` [unit of the column], `resampled`: whether the rows were not evenly spaced.
///
/// Raises
/// ------
/// InputError
///     If the class is unknown, or there are too few rows for it.
///
/// Examples
/// --------
/// >>> percuss._percuss.samples([0.0, 0.1, 0.2], [0.0, 1.0, 2.0], None)["values"]
/// array([0., 1., 2.])
#[pyfunction]
pub fn samples(
    py: Python<'_>,
    time: Vec<f64>,
    values: Vec<f64>,
    cfc: Option<u32>,
) -> PyResult<Bound<'_, PyDict>> {
    let signal = move || {
        let signal = Signal::from_samples(&time, &values).map_err(|error| refused(&error))?;
        in_class(signal, cfc)
    };
    sampled(py, signal)
}

/// Shock response spectrum of the acceleration that follows from a velocity.
///
/// Parameters
/// ----------
/// history : (list of float, list of float)
///     Times [s] and velocities [m/s].
/// damping : float
///     Share of critical damping [1].
/// band : (float, float or None, float)
///     First and last frequency [Hz], and frequencies an octave [1].
/// cfc : {60, 180, 600, 1000} or None
///     Channel frequency class to filter in first.
///
/// Returns
/// -------
/// dict
///     `frequency` [Hz], and the primary, residual and largest answers of each kind.
///
/// Raises
/// ------
/// InputError
///     If the band, the damping or the class is out of range.
///
/// Examples
/// --------
/// >>> result = percuss.run("plank.toml")
/// >>> history = result.time.tolist(), result["point.plank.mid.velocity_2"].tolist()
/// >>> found = percuss._percuss.shock_spectrum(history, 0.05, (1.0, 100.0, 12.0), None)
/// >>> len(found["frequency"]) == len(found["acceleration_maximax"])
/// True
#[pyfunction]
pub fn shock_spectrum<'py>(
    py: Python<'py>,
    history: (Vec<f64>, Vec<f64>),
    damping: f64,
    band: (f64, Option<f64>, f64),
    cfc: Option<u32>,
) -> PyResult<Bound<'py, PyDict>> {
    let work = move || {
        let signal = signal(&history.0, &history.1, cfc)?;
        let (from, to, per_octave) = band;
        let band = Band { from, to, per_octave };
        let found = shock::shock_spectrum(&signal, damping, &band);
        Ok((found.map_err(|error| refused(&error))?, signal.resampled))
    };
    let found = Watch::default().run(py, move |_| work())?;
    let (found, resampled) = found.map_err(|refusal: Refusal| refusal.exception(py))?;
    let result = PyDict::new(py);
    let velocity = found.pseudo_velocity();
    let answers = [
        ("acceleration", found.acceleration),
        ("pseudo_velocity", velocity),
        ("displacement", found.displacement),
    ];
    for (name, values) in answers {
        let column = |of: fn(&shock::Extremes) -> f64| values.iter().map(of).collect::<Vec<f64>>();
        result.set_item(format!("{name}_primary"), array(py, column(|x| x.primary)))?;
        result.set_item(format!("{name}_residual"), array(py, column(|x| x.residual)))?;
        result.set_item(format!("{name}_maximax"), array(py, column(|x| x.maximax())))?;
    }
    result.set_item("frequency", array(py, found.frequency))?;
    result.set_item("resampled", resampled)?;
    Ok(result)
}
