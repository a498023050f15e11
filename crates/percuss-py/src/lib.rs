//! The native module of the Python package `percuss`: scenarios in, arrays out. What users see is made of it in
//! `python/percuss`, whose `_percuss.pyi` tells the types.

mod analyses;
mod command;
mod converge;
mod directory;
mod edit;
mod error;
mod fields;
mod fit;
mod function;
mod given;
mod open;
mod ready;
mod recorder;
mod run;
mod sensitivity;
mod shock;
mod structure;
mod study;
mod watch;
mod work;

/// `percuss._percuss`.
#[pyo3::pymodule]
mod _percuss {
    #[pymodule_export]
    use super::analyses::{modes, statics};
    #[pymodule_export]
    use super::command::command;
    #[pymodule_export]
    use super::converge::converged;
    #[pymodule_export]
    use super::edit::{remove, set, steps};
    #[pymodule_export]
    use super::fields::{export, instant, scene_page, state, story};
    #[pymodule_export]
    use super::fit::{FitProblem, NativeFit};
    #[pymodule_export]
    use super::function::{
        function_jacobian, function_layout, function_places, function_points, function_values,
        function_variations,
    };
    #[pymodule_export]
    use super::open::open;
    #[pymodule_export]
    use super::ready::{check, written};
    #[pymodule_export]
    use super::run::run;
    #[pymodule_export]
    use super::sensitivity::{column_jacobian, column_values, extrapolated, sensitivity};
    #[pymodule_export]
    use super::shock::{acceleration, samples, shock_spectrum};
    #[pymodule_export]
    use super::study::Study;

    #[pymodule_init]
    fn init(module: &pyo3::Bound<'_, pyo3::types::PyModule>) -> pyo3::PyResult<()> {
        super::structure::load_numpy(module.py())
    }

    #[pymodule_export]
    const VERSION: &str = env!("CARGO_PKG_VERSION");
}
