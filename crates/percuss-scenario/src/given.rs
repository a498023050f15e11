//! Functions that a program gives beside the text of a scenario.

use std::collections::BTreeMap;

use percuss::{Fault, Potential, TimeFunction};

/// Functions for the places where the text says `"given"`, by path.
///
/// ```
/// let text = percuss_scenario::templates()[0].text;
/// let text = text.replace("stiffness = \"7.5e5 N/m\"", "law = \"given\"");
/// let law = percuss::Potential::function(|p| 1e7 * p.powi(3), |p| 3e7 * p * p);
/// let given = percuss_scenario::Given::default().with_potential("projectile.mass", law);
/// assert!(percuss_scenario::read(&text, "hard.toml")?.with_given(given).compile().is_ok());
/// # Ok::<(), percuss_scenario::Diagnostics>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Given {
    functions: BTreeMap<String, TimeFunction>,
    potentials: BTreeMap<String, Potential>,
}

impl Given {
    /// With the function of time at `path`: `load.wind.function`, `support.shaker.motion.function`.
    pub fn with_function(mut self, path: impl Into<String>, function: TimeFunction) -> Self {
        self.functions.insert(path.into(), function);
        self
    }

    /// With the potential of the table at `path`, `projectile.mass` or `contact.stop`, whose `law` is `"given"`.
    pub fn with_potential(mut self, path: impl Into<String>, potential: Potential) -> Self {
        self.potentials.insert(path.into(), potential);
        self
    }

    /// The function at `path`.
    pub(crate) fn function(&self, path: &str) -> Result<TimeFunction, Fault> {
        let expected =
            "a function from a program (in Python `scenario[path] = function`), or another kind";
        self.functions.get(path).cloned().ok_or_else(|| missing(path, expected))
    }

    /// The potential of the table at `path`.
    pub(crate) fn potential(&self, path: &str) -> Result<Potential, Fault> {
        let expected = "a potential from a program (in Python `scenario[path] = percuss.Potential(...)`), or \
                        another law";
        let missing = || missing(&format!("{path}.law"), expected);
        self.potentials.get(path).cloned().ok_or_else(missing)
    }
}

fn missing(path: &str, expected: &str) -> Fault {
    Fault::new(path, "\"given\", and no function given", expected)
}
