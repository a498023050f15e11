//! The scene alone as a small page of its own, for a cell of a notebook: what happened, in words and in motion.

use serde_json::Value;

use super::html::{self, escape};
use super::story::story;
use super::template::{HEAD, PENS, STYLE, fill_holes};
use super::{payload, scene};
use crate::fields::Fields;

const TEMPLATE: &str = include_str!("../../web/notebook.html");
/// What the scene needs besides its own scripts, and what opens it.
const SCRIPTS: [&str; 3] = [
    include_str!("../../web/columns.js"),
    include_str!("../../web/figures.js"),
    include_str!("../../web/exports.js"),
];
const OPEN: &str = include_str!("../../web/notebook.js");

/// Frames of either kind at most: fifty a second of a film of five.
const FRAMES: usize = 250;
/// Numbers of a frame at most, about: beams of more are drawn through fewer of their stations.
const NUMBERS: usize = 2000;
/// Bytes of the page at most: a notebook keeps one for each cell that shows a run.
const MOST: usize = 800_000;

/// The page, with as many frames as fit into it; `None` without frames.
pub fn scene_page(fields: &Fields, summary: &Value) -> Option<String> {
    let first = fields.frames.first()?;
    let most = fields.frames.iter().map(|f| f.section_points.len()).max().unwrap_or(0);
    let numbers = first.displacement.len() + first.section_forces.len() + most;
    let coarse = fields.coarsened(numbers.div_ceil(NUMBERS));
    let mut frames = FRAMES;
    loop {
        let page = render(&coarse.thinned(frames), summary);
        if page.len() <= MOST || frames == 1 {
            return Some(page);
        }
        // Two thirds each time: a page little smaller than the limit is worth the second attempt.
        frames = (2 * frames / 3).max(1);
    }
}

fn render(fields: &Fields, summary: &Value) -> String {
    let payload = payload::pack_from(0, &[], &[("", fields)]);
    let text = escape(&story(summary));
    fill_holes(TEMPLATE, |hole| match hole {
        "head" => HEAD.to_owned(),
        "style" => STYLE.to_owned(),
        "title" => escape(summary["title"].as_str().unwrap_or("")),
        "scene" => scene::section(&text, scene::instant(summary)),
        "script" => [&[PENS][..], &SCRIPTS, &scene::SCRIPTS, &[OPEN]].concat().join("\n"),
        "index" => html::json(&payload.index),
        "data" => payload.data.clone(),
        _ => String::new(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fields::StoredFrame;
    use serde_json::json;

    fn fields(stations: usize, frames: usize) -> Fields {
        let column: Vec<f64> = (0..stations).map(|k| k as f64).collect();
        let mut beam = json!({ "name": "</script><b>" });
        for name in ["s", "x", "y", "tx", "ty", "half_depth", "area", "inertia"] {
            beam[name] = json!(column);
        }
        let scene = json!({ "beams": [beam], "bodies": [], "obstacles": [], "supports": [], "joints": [],
            "springs": [], "masses": [], "loads": [], "contacts": [] });
        // Numbers that nothing can pack well.
        let noise = |k: usize, n: usize| -> Vec<f32> {
            (0..n).map(|i| ((k * 7919 + i * 104_729) as f32).sin()).collect()
        };
        let frame = |k: usize| StoredFrame {
            time: k as f64,
            displacement: noise(k, 4 * stations),
            section_forces: noise(k + 1, 6 * (stations - 1)),
            ..StoredFrame::default()
        };
        Fields { scene, frames: (0..frames).map(frame).collect() }
    }

    #[test]
    fn a_page_stays_small_however_large_the_run() {
        for (stations, frames) in [(3, 2), (21, 2000), (1500, 40)] {
            let page = scene_page(&fields(stations, frames), &json!({ "title": "x" })).unwrap();
            assert!(
                page.len() <= MOST,
                "{stations} stations, {frames} frames: {} bytes",
                page.len()
            );
        }
        assert!(scene_page(&Fields::default(), &json!({})).is_none());
    }

    #[test]
    fn names_of_users_end_no_script() {
        let page =
            scene_page(&fields(3, 2), &json!({ "title": "<script>alert(1)</script>" })).unwrap();
        assert_eq!(page.matches("<script>alert").count(), 0);
        assert_eq!(page.matches("</script>").count(), 3);
        // The name of the SVG language is no address that anything is read from.
        let rest = page.replace("http://www.w3.org/2000/svg", "");
        assert!(!rest.contains("http:") && !rest.contains("https:"));
    }
}
