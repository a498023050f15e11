//! Functions of the user's in a run: Python called from the solver.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

use percuss::{Potential, TimeFunction};
use pyo3::prelude::*;

/// What a function raised, the first one that did.
type Raised = Arc<Mutex<Option<PyErr>>>;

/// Functions behind paths: callables of time, and (energy, force) of a penetration.
#[derive(Debug)]
pub struct Given {
    functions: HashMap<String, Arc<Py<PyAny>>>,
    /// Potential and its derivative, by the path of the law, shape (2).
    potentials: HashMap<String, [Arc<Py<PyAny>>; 2]>,
    raised: Raised,
}

impl<'a, 'py> FromPyObject<'a, 'py> for Given {
    type Error = PyErr;

    fn extract(given: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        let all: HashMap<String, Vec<Py<PyAny>>> = given.extract()?;
        let (mut functions, mut potentials) = (HashMap::new(), HashMap::new());
        for (path, mut code) in all {
            match (code.pop(), code.pop()) {
                (Some(force), Some(energy)) => {
                    // The law stands in a table, whose path the core goes by.
                    let table = path.strip_suffix(".law").unwrap_or(&path).to_owned();
                    potentials.insert(table, [Arc::new(energy), Arc::new(force)]);
                }
                (Some(function), None) => _ = functions.insert(path, Arc::new(function)),
                _ => {}
            }
        }
        Ok(Self { functions, potentials, raised: Raised::default() })
    }
}

impl Given {
    /// The same for the core.
    pub fn to_core(&self) -> percuss_scenario::Given {
        let mut out = percuss_scenario::Given::default();
        for (path, function) in &self.functions {
            out = out.with_function(path.clone(), TimeFunction::function(self.closure(function)));
        }
        for (path, [energy, force]) in &self.potentials {
            let potential = Potential::function(self.closure(energy), self.closure(force));
            out = out.with_potential(path.clone(), potential);
        }
        out
    }

    /// Whether there are any.
    pub fn is_empty(&self) -> bool {
        self.functions.is_empty() && self.potentials.is_empty()
    }

    /// What a function raised; asked once.
    pub fn raised(&self) -> Option<PyErr> {
        self.raised.lock().unwrap_or_else(PoisonError::into_inner).take()
    }

    /// Whether a function raised something that nobody has asked for yet.
    pub fn has_raised(&self) -> bool {
        self.raised.lock().unwrap_or_else(PoisonError::into_inner).is_some()
    }

    /// A function of Python as one of Rust; NaN once one has raised.
    fn closure(&self, code: &Arc<Py<PyAny>>) -> impl Fn(f64) -> f64 + Send + Sync + 'static {
        let (code, raised) = (code.clone(), self.raised.clone());
        move |x| {
            let value = Python::attach(|py| code.call1(py, (x,))?.extract::<f64>(py));
            value.unwrap_or_else(|error| {
                raised.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error);
                f64::NAN
            })
        }
    }
}
