//! The first screen of the page: what happened, in words and in motion.

use super::data::ReportData;
use super::html::escape;
use super::story::story;
use super::template::{PENS, STYLE, fill_holes};

const SECTION: &str = include_str!("../../web/scene.html");

/// The scripts that draw the scene, in the order in which they use each other.
pub(super) const SCRIPTS: [&str; 6] = [
    include_str!("../../web/scene.js"),
    include_str!("../../web/clearance.js"),
    include_str!("../../web/view.js"),
    include_str!("../../web/drawing.js"),
    include_str!("../../web/symbols.js"),
    include_str!("../../web/player.js"),
];

/// What the scene is drawn with outside of a page too: the scripts in the order in which they use each other.
pub fn scene_scripts() -> impl Iterator<Item = &'static str> {
    [PENS].into_iter().chain(SCRIPTS)
}

/// The choices of a list beside the scene (`colour`, `diagram`), as the scripts take them.
pub fn scene_choices(list: &str) -> Vec<&'static str> {
    let from = SECTION.split_once(&format!("data-scene=\"{list}\">")).map_or("", |(_, rest)| rest);
    let list = from.split_once("</select>").map_or("", |(list, _)| list);
    list.split("<option value=\"")
        .skip(1)
        .filter_map(|rest| Some(rest.split_once('"')?.0))
        .collect()
}

/// Name and value of the colours of a page, light or dark: `--page`, `#ffffff`.
pub fn scene_colours(dark: bool) -> Vec<(&'static str, &'static str)> {
    // What is not said of the dark page is as on the light one.
    let blocks = [":root {", ":root[data-theme=\"dark\"] {"];
    let declarations = |block: &&str| -> Vec<(&'static str, &'static str)> {
        let inside = STYLE.split_once(*block).and_then(|(_, rest)| Some(rest.split_once('}')?.0));
        let pairs = inside.unwrap_or("").split(';').filter_map(|line| line.split_once(':'));
        let pairs = pairs.map(|(name, value)| (name.trim(), value.trim()));
        pairs.filter(|(name, _)| name.starts_with("--")).collect()
    };
    blocks[..=usize::from(dark)].iter().flat_map(declarations).collect()
}

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_and_choices_are_those_of_the_page() {
        for (dark, page) in [(false, "#ffffff"), (true, "#14171b")] {
            let colours = scene_colours(dark);
            let last = colours.iter().rfind(|(name, _)| *name == "--page");
            assert_eq!(last.map(|c| c.1), Some(page));
            assert!(colours.iter().any(|(name, _)| *name == "--scene-beam"));
        }
        assert!(scene_choices("colour").starts_with(&["none", "stress"]));
        assert!(scene_choices("diagram").contains(&"moment"));
        assert!(scene_choices("nothing").is_empty());
    }
}
