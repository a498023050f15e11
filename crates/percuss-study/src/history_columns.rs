//! Names of the columns of a history.

use percuss::{Channel, Fault, Simulation};
use percuss_scenario::{Compiled, one_of};

/// Columns of the history of a scenario.
pub(crate) fn columns_of(compiled: &Compiled) -> Result<Vec<Channel>, Vec<Fault>> {
    Ok(Simulation::new(&compiled.model, &compiled.settings)?.channels())
}

/// A column that the history does not have, with names like it.
pub(crate) fn unknown_column(name: &str, channels: &[Channel]) -> Fault {
    let names = channels.iter().map(|channel| channel.name.as_str());
    Fault::new(name, format!("`{name}`, which is no column of the history"), one_of(name, names))
}
