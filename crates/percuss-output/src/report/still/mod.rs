//! Pages of structures that rest, or swing about rest: equilibria, equilibrium paths, natural modes, drawn by the scene of the report.

mod equilibrium;
mod modes;
mod path;

pub use equilibrium::EquilibriumInfo;
pub(crate) use equilibrium::render as equilibrium_page;
pub use modes::ModesInfo;
pub(crate) use modes::render as modes_page;
pub use path::PathInfo;
pub(crate) use path::{Along, PathPage, drawn_displacements, render as path_page};

use serde_json::{Value, json};

use super::html::{self, escape};
use super::template::{PENS, STYLE, fill_holes, page_parts};
use super::{payload, scene};
use crate::fields::Fields;

const TEMPLATE: &str = include_str!("../../../web/still.html");
/// What draws the pages besides the scripts of the scene, in the order in which they use each other.
const SCRIPTS: [&str; 8] = [
    include_str!("../../../web/columns.js"),
    include_str!("../../../web/figures.js"),
    include_str!("../../../web/exports.js"),
    include_str!("../../../web/tables.js"),
    include_str!("../../../web/shapes.js"),
    include_str!("../../../web/chart.js"),
    include_str!("../../../web/panels.js"),
    include_str!("../../../web/still.js"),
];

/// A page.
pub(super) struct Page<'a> {
    pub title: &'a str,
    /// A line below the title, plain text.
    pub status: String,
    /// Whether that line is a warning.
    pub alarming: bool,
    /// The scene, or the buttons of shapes; markup.
    pub scene: String,
    /// Configurations, then shapes.
    pub fields: Fields,
    /// What is drawn of them.
    pub details: Value,
    /// Markup.
    pub tables: String,
    /// What stands there without scripts; markup.
    pub fallback: String,
}

impl Page<'_> {
    fn render(&self) -> String {
        let mut payload = payload::pack(&[], &[("", &self.fields)]);
        payload.index["details"] = self.details.clone();
        let class = if self.alarming { "status warning" } else { "status" };
        fill_holes(TEMPLATE, |hole| match hole {
            "title" => escape(self.title),
            "status" => format!("<p class=\"{class}\">{}</p>", escape(&self.status)),
            "style" => STYLE.to_owned(),
            "fallback" => self.fallback.clone(),
            "scene" => self.scene.clone(),
            "tables" => self.tables.clone(),
            "version" => env!("CARGO_PKG_VERSION").to_owned(),
            "index" => html::json(&payload.index),
            "data" => payload.data.clone(),
            "script" => {
                [&[PENS][..], &SCRIPTS[..4], &scene::SCRIPTS, &SCRIPTS[4..]].concat().join("\n")
            }
            other => page_parts(other),
        })
    }
}

/// A shape drawn as it swings: the number of its frame and of that it swings about (the reference configuration without one).
fn swinging(title: &str, shape: usize, about: Option<usize>) -> Value {
    json!({ "title": title, "shape": shape, "about": about })
}
