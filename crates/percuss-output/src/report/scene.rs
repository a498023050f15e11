//! The first screen of the page: what happened, in words and in motion.

use super::ReportData;
use super::html::escape;
use super::page::fill_holes;
use super::story::story;

const SECTION: &str = include_str!("../../../../web/scene.html");

/// What scenes and figures are drawn with.
pub(super) const PENS: &str = include_str!("../../../../web/pens.js");
/// The scripts that draw the scene, in the order in which they use each other.
pub(super) const SCRIPTS: [&str; 5] = [
    include_str!("../../../../web/scene.js"),
    include_str!("../../../../web/clearance.js"),
    include_str!("../../../../web/drawing.js"),
    include_str!("../../../../web/symbols.js"),
    include_str!("../../../../web/player.js"),
];

/// The section; without the shapes of a run the words alone.
pub(super) fn render(data: &ReportData) -> String {
    let text = escape(&story(&data.summary));
    if data.fields.as_ref().is_none_or(|fields| fields.frames.is_empty()) {
        return format!("<p class=\"story\">{text}</p>\n");
    }
    section(&text)
}

/// The section below a text, which is escaped.
pub(super) fn section(text: &str) -> String {
    fill_holes(SECTION, |_| text.to_owned())
}
