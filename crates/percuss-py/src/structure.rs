//! Arrays for Python: what a structure looks like, and columns that NumPy owns.

use numpy::{Element, IntoPyArray, PyArray1, PyArrayMethods};
use percuss::Model;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// A vector as an array that cannot be written to; NumPy takes the memory over.
pub fn array<T: Element>(py: Python<'_>, values: Vec<T>) -> Bound<'_, PyArray1<T>> {
    let array = values.into_pyarray(py);
    array.readwrite().make_nonwriteable();
    array
}

/// The same with a shape.
pub fn shaped<'py, T: Element>(
    py: Python<'py>,
    values: Vec<T>,
    shape: &[usize],
) -> PyResult<Bound<'py, PyAny>> {
    array(py, values).call_method1("reshape", (shape.to_vec(),))
}

/// Elements of the beams of a model.
#[derive(Debug)]
pub struct Beams(
    /// One each, shape (beams).
    Vec<Beam>,
);

#[derive(Debug)]
struct Beam {
    name: String,
    /// First node of each element, shape (elements) \[index of a node\].
    nodes: Vec<i64>,
    /// Their lengths, shape (elements) \[m\].
    lengths: Vec<f64>,
    /// Position and tangent of both ends, shape (elements, 2, 4) \[m, -\].
    ends: Vec<f64>,
}

impl Beams {
    /// Those of a model.
    pub fn of(model: &Model) -> Self {
        let beam = |name: &str| {
            let (mut nodes, mut lengths, mut ends) = (Vec::new(), Vec::new(), Vec::new());
            for (node, length, both) in model.beam_elements(name) {
                nodes.push(node as i64);
                lengths.push(length);
                ends.extend_from_slice(both.as_flattened());
            }
            Beam { name: name.to_owned(), nodes, lengths, ends }
        };
        Self(model.beam_names().map(beam).collect())
    }

    /// By name, each (first nodes of its elements, lengths of these, both ends' positions and tangents).
    ///
    /// # Errors
    /// What NumPy raises.
    pub fn into_python(self, py: Python<'_>) -> PyResult<Bound<'_, PyDict>> {
        let out = PyDict::new(py);
        for Beam { name, nodes, lengths, ends } in self.0 {
            let ends = shaped(py, ends, &[nodes.len(), 2, 4])?;
            out.set_item(name, (array(py, nodes), array(py, lengths), ends))?;
        }
        Ok(out)
    }
}

/// Loads what NumPy offers to Rust, which runs Python: nothing later does, where a signal would be raised in its midst.
///
/// # Errors
/// If NumPy cannot be imported.
pub fn load_numpy(py: Python<'_>) -> PyResult<()> {
    py.import("numpy")?;
    drop(array(py, vec![0.0]));
    Ok(())
}
