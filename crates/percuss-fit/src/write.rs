//! Files of a fit.

use std::io::{Error, ErrorKind};
use std::path::{Path, PathBuf};

use percuss_output::write_new;

use crate::fit::Fit;
use crate::json::fit_value;
use crate::page::fit_page;
use crate::text::fit_text;

/// Writes `fit.json`, `fit.txt`, `fit.html`, `curves.csv` and the scenarios with the values found into an empty directory.
///
/// # Errors
/// The file that cannot be written, and what the system says.
pub fn write_fit(dir: &Path, fit: &Fit) -> Result<(), (PathBuf, Error)> {
    let write = |name: &str, text: &str| {
        let path = dir.join(name);
        match Path::new(name).components().count() {
            1 => write_new(&path, text.as_bytes()).map_err(|error| (path, error)),
            _ => Err((path, ErrorKind::InvalidInput.into())),
        }
    };
    write("fit.json", &format!("{:#}\n", fit_value(fit)))?;
    write("fit.txt", &fit_text(fit))?;
    write("fit.html", &fit_page(fit))?;
    write("curves.csv", &curves(fit))?;
    fit.scenarios.iter().try_for_each(|(name, text)| write(name, text))
}

/// Measured and computed values of all channels, one row each, in SI units.
fn curves(fit: &Fit) -> String {
    let mut text = "test,channel,unit,time,measured,computed\n".to_owned();
    for one in &fit.overlays {
        for ((t, measured), computed) in one.time.iter().zip(&one.measured).zip(&one.computed) {
            text += &format!(
                "{},{},{},{t:?},{measured:?},{computed:?}\n",
                one.test, one.channel, one.unit
            );
        }
    }
    text
}
