//! The first screen of the page: summary text and scene.

use serde_json::Value;

use super::data::ReportData;
use super::html::sentences;
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
    let text = sentences(&story(&data.summary));
    if data.fields.as_ref().is_none_or(|fields| fields.frames.is_empty()) {
        return format!("<p class=\"story\">{text}</p>\n");
    }
    section(&text, instant(&data.summary))
}

/// The section below a text, which is escaped, showing an instant, or that of the largest contact force in the recorded frames.
pub(super) fn section(text: &str, instant: Option<f64>) -> String {
    fill_holes(SECTION, |hole| match hole {
        "instant" => instant.map_or(String::new(), |t| t.to_string()),
        _ => text.to_owned(),
    })
}

/// Permanent deflections below this share of the largest displacement are not seen in the scene.
const SEEN: f64 = 0.01;

/// The instant of greatest interest \[s\]: the end where something stays bent or has failed, else that of the largest force of a single
/// contact, else that of the largest impulse; `None` where nothing touches.
pub fn instant(summary: &Value) -> Option<f64> {
    if stays_bent(summary) {
        return summary["time"].as_f64();
    }
    let contacts = || summary["contact"].as_object().into_iter().flat_map(|all| all.values());
    let largest = |list: Vec<(Option<f64>, &Value)>| -> Option<f64> {
        let known = list.into_iter().filter_map(|(size, time)| Some((size?.abs(), time.as_f64()?)));
        known.max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, time)| time)
    };
    let forces = contacts().map(|c| &c["peak_force"]);
    let impacts = contacts().flat_map(|c| c["impacts"].as_array().into_iter().flatten());
    largest(forces.map(|peak| (peak["value"].as_f64(), &peak["time"])).collect())
        .or_else(|| largest(impacts.map(|i| (i["impulse"].as_f64(), &i["time"])).collect()))
}

/// Whether a beam, spring or joint has a permanent deflection that is seen, or has failed.
fn stays_bent(summary: &Value) -> bool {
    let all = |part: &str| summary[part].as_object().into_iter().flat_map(|all| all.values());
    let peaks = all("point").flat_map(|point| {
        ["component_1", "component_2"].map(|c| point["displacement_max"][c]["value"].as_f64())
    });
    let moved = peaks.flatten().map(f64::abs).fold(0.0, f64::max);
    let bent = |entry: &Value| {
        let first_yield = entry["first_yield"]["time"].is_number();
        let set = entry["permanent_set"].as_f64();
        // Without a permanent deflection that is known, what yielded and is loose counts.
        first_yield && set.is_none_or(|set| set > SEEN * moved && set > 0.0)
    };
    let failed = |entry: &Value| {
        let parted = &entry["parted"];
        entry["failure"]["time"].is_number()
            || parted["time"].is_number()
            || parted.as_array().is_some_and(|list| !list.is_empty())
    };
    all("plastic").chain(all("yielding")).any(|entry| bent(entry) || failed(entry))
        || all("joint").any(failed)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A car and a stone strike a post: the scene stops at the larger of the two forces, or at the end where the post stays bent.
    #[test]
    fn the_scene_shows_the_instant_of_greatest_interest() {
        let mut summary = serde_json::json!({
            "time": 0.3,
            "contact": {
                "stone": { "peak_force": { "value": 3e3, "time": 0.05 } },
                "car": { "peak_force": { "value": 60e3, "time": 0.087 } },
                "rail": { "peak_force": { "value": null, "time": null } },
            },
            "point": { "top": { "displacement_max": {
                "component_1": { "value": 0.03 }, "component_2": { "value": -0.001 } } } },
            "plastic": { "post": { "first_yield": { "time": 0.002 }, "permanent_set": 0.022, "parted": [] } },
        });
        assert_eq!(instant(&summary), Some(0.3));
        summary["plastic"]["post"]["permanent_set"] = 1e-5.into();
        assert_eq!(instant(&summary), Some(0.087), "a set of 10 um beside 30 mm is not seen");
        summary["joint"] = serde_json::json!({ "weld": { "parted": { "time": 0.1 } } });
        assert_eq!(instant(&summary), Some(0.3));
        let impacts =
            serde_json::json!([{ "impulse": 2.0, "time": 0.1 }, { "impulse": -5.0, "time": 0.2 }]);
        let rigid = serde_json::json!({ "time": 1.0, "contact": { "a": { "impacts": impacts } } });
        assert_eq!(instant(&rigid), Some(0.2));
        assert_eq!(instant(&serde_json::json!({ "contact": 3 })), None);
        assert!(section("text", Some(0.087)).contains("data-instant=\"0.087\""));
    }

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
