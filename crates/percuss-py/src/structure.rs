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

/// Beams by name, each (first nodes of its elements, lengths of these, both ends' positions and tangents).
pub fn beams<'py>(py: Python<'py>, model: &Model) -> PyResult<Bound<'py, PyDict>> {
    let out = PyDict::new(py);
    for name in model.beam_names() {
        let (mut nodes, mut lengths, mut ends) = (Vec::new(), Vec::new(), Vec::new());
        for (node, length, both) in model.beam_elements(name) {
            nodes.push(i64::try_from(node)?);
            lengths.push(length);
            ends.extend_from_slice(both.as_flattened());
        }
        let count = nodes.len();
        let ends = shaped(py, ends, &[count, 2, 4])?;
        out.set_item(name, (array(py, nodes), array(py, lengths), ends))?;
    }
    Ok(out)
}
