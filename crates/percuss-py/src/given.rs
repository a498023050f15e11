//! Functions of the user's in a run: Python called from the solver.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

use percuss::{Potential, TimeFunction};
use pyo3::prelude::*;

use crate::watch::Stop;

/// What Python raised during the work, the first time; it ends the work.
#[derive(Clone, Debug, Default)]
pub struct Raised {
    first: Arc<Mutex<Option<PyErr>>>,
    /// Asks the work to end.
    pub stop: Stop,
}

impl Raised {
    /// Keeps an exception, unless there is one.
    pub fn put(&self, error: PyErr) {
        self.first.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error);
        self.stop.want();
    }

    /// The exception; asked once.
    pub fn take(&self) -> Option<PyErr> {
        self.first.lock().unwrap_or_else(PoisonError::into_inner).take()
    }
}

/// Functions behind paths: callables of time, and (energy, force) of a penetration.
#[derive(Debug)]
pub struct Given {
    functions: HashMap<String, Arc<Py<PyAny>>>,
    /// Potential and its derivative, by the path of the law, shape (2).
    potentials: HashMap<String, [Arc<Py<PyAny>>; 2]>,
    /// Calls a function in the context of the caller, whose settings (`numpy.errstate`) do not reach other threads by themselves.
    within: Arc<Py<PyAny>>,
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
        let context = given.py().import("contextvars")?.call_method0("copy_context")?;
        let within = Arc::new(context.getattr("run")?.unbind());
        Ok(Self { functions, potentials, within, raised: Raised::default() })
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

    /// What the functions raise.
    pub fn raised(&self) -> &Raised {
        &self.raised
    }

    /// A function of Python as one of Rust; NaN, without a call, once one has raised or the work is to end.
    fn closure(&self, code: &Arc<Py<PyAny>>) -> impl Fn(f64) -> f64 + Send + Sync + 'static {
        let (code, within, raised) = (code.clone(), self.within.clone(), self.raised.clone());
        move |x| {
            if raised.stop.is_wanted() {
                return f64::NAN;
            }
            let called = Python::attach(|py| within.call1(py, (&*code, x))?.extract::<f64>(py));
            called.unwrap_or_else(|error| {
                raised.put(error);
                f64::NAN
            })
        }
    }
}
