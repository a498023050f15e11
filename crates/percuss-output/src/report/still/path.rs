//! The page of an equilibrium path: the load over the displacements, beside the structure as it moves along.

use percuss::scene::Scene;
use percuss::{LinearBuckling, Path, PathPoint, PathYield};
use serde_json::{Value, json};

use super::equilibrium::{buckling_title, tables};
use super::{Page, swinging};
use crate::fields::{Fields, Places, StoredFrame, scene_value};
use crate::report::figure::largest;
use crate::report::html::{escape, sentences, table};
use crate::report::quantity::{Scale, number, quantity, without_round_off};
use crate::report::scene;
use crate::round_off::is_round_off;
use crate::shown::FIGURES;

/// A path and what it belongs to.
#[derive(Clone, Copy, Debug)]
pub struct PathInfo<'a> {
    /// The scenario's title.
    pub title: &'a str,
    /// Parts of the model as drawn.
    pub scene: &'a Scene,
    /// The path.
    pub path: &'a Path,
    /// Linear buckling of the equilibrium at its end.
    pub linear: &'a LinearBuckling,
}

/// An equilibrium kept along a path.
#[derive(Clone, Debug)]
pub(crate) struct Along {
    /// Number among the points offered.
    pub number: usize,
    pub factor: f64,
    /// Whether the load turns there.
    pub limit: bool,
    /// Of the recorded points, shape (points, 2) \[m\].
    pub displacements: Vec<[f64; 2]>,
    pub frame: StoredFrame,
}

/// A path and the equilibria kept along it.
pub(crate) struct PathPage<'a> {
    pub info: &'a PathInfo<'a>,
    /// Equilibria kept along it, shape (equilibria).
    pub along: Vec<Along>,
}

/// The page.
pub(crate) fn render(page: &PathPage<'_>) -> String {
    let PathPage { info, along } = page;
    let path = info.path;
    let places = Places::of(info.scene);
    let mut frames: Vec<_> = along.iter().map(|one| one.frame.clone()).collect();
    for (k, frame) in frames.iter_mut().enumerate() {
        frame.time = k as f64;
    }
    let limits = along.iter().enumerate().filter(|(_, one)| one.limit).take(FIGURES);
    let still = |(k, one): (usize, &Along)| json!({ "frame": k, "title": format!("limit point at load factor {}", number(one.factor)) });
    let mut panels: Vec<Value> = limits.map(still).collect();
    if let Some(last) = along.last() {
        let title = format!("end, at load factor {}", number(last.factor));
        panels.push(json!({ "frame": along.len() - 1, "title": title }));
    }
    if let Some(mode) = info.linear.modes.first() {
        panels.push(swinging(&buckling_title(mode.factor), frames.len(), None));
        frames.push(places.shape(&mode.shape));
    }
    let factor = path.points.last().map_or(0.0, |p| p.factor);
    let status = match path.reached {
        true => format!("Equilibrium path up to load factor {}.", number(factor)),
        false => format!(
            "Equilibrium path; it ends at load factor {}, before the requested end{}.",
            number(factor),
            path.torn.as_ref().map_or(String::new(), |what| {
                format!(": beyond it '{}' would fail", escape(what))
            })
        ),
    };
    let page = Page {
        title: if info.title.is_empty() { "Equilibrium path" } else { info.title },
        status,
        alarming: !path.reached,
        scene: format!("<div class=\"beside\">\n{}{CHART}</div>\n", scene::section(&sentences(&story(path)), None)),
        fields: Fields { scene: scene_value(info.scene), frames },
        details: json!({ "kind": "path", "panels": panels, "chart": chart(path, along) }),
        tables: format!(
            "{}{}{}{}",
            turns(path, "Limit points", &path.limit_points),
            turns(path, "Bifurcations", &path.bifurcations),
            first_yields(path),
            tables(&path.end)
        ),
        fallback: "<p class=\"warning\">The drawings need JavaScript; the path is in path.csv and path.svg in the same directory.</p>".to_owned(),
    };
    page.render()
}

/// Place of the curve.
const CHART: &str = "<figure class=\"chart\" id=\"chart\"><figcaption><h2>Load factor over displacements</h2><span>\
<button type=\"button\" class=\"save\" data-chart=\"svg\" aria-label=\"Save the curve as SVG\">SVG</button></span>\
<p>Click a point to show the structure; data in path.csv.</p></figcaption><canvas role=\"img\" aria-label=\"Load factor over displacements\"></canvas></figure>\n";

fn story(path: &Path) -> String {
    let names = |point: &PathPoint| {
        let moved = |(name, u): (&String, &[f64; 2])| {
            format!("displacement of '{name}' {}", quantity(Some(u[0].hypot(u[1])), "m"))
        };
        path.names
            .iter()
            .zip(&point.displacements)
            .max_by(|a, b| size(a.1).total_cmp(&size(b.1)))
            .map(moved)
    };
    let at = |point: &PathPoint| match names(point) {
        Some(moved) => format!("{} ({moved})", number(point.factor)),
        None => number(point.factor),
    };
    let limits = match path.limit_points.as_slice() {
        [] => "No limit point.".to_owned(),
        [one] => format!("One limit point, at load factor {}.", at(one)),
        [first, rest @ ..] => format!(
            "{} limit points, first at load factor {}, last at {}.",
            rest.len() + 1,
            at(first),
            at(&rest[rest.len() - 1])
        ),
    };
    let bifurcations = match path.bifurcations.as_slice() {
        [] => String::new(),
        [one] => format!(" One bifurcation, at load factor {}.", at(one)),
        [first, rest @ ..] => {
            format!(" {} bifurcations, first at load factor {}.", rest.len() + 1, at(first))
        }
    };
    limits + &bifurcations
}

fn size(u: &[f64; 2]) -> f64 {
    u[0].hypot(u[1])
}

/// Curves of the largest displacements, with their values at the configurations kept.
fn chart(path: &Path, along: &[Along]) -> Value {
    let drawn = drawn_displacements(path);
    let column = |(point, component): (usize, usize)| -> Vec<f64> {
        path.points.iter().map(|p| p.displacements[point][component]).collect()
    };
    let scale = Scale::new(drawn.iter().map(|c| largest(&column(*c))).fold(0.0, f64::max), "m");
    let curve = |(k, c): (usize, &(usize, usize))| {
        let kept = along.iter().map(|one| one.displacements[c.0][c.1] * scale.factor);
        json!({
            "label": format!("{}, along {}", path.names[c.0], ["x", "y"][c.1]),
            "style": 1 + k,
            "x": column(*c).into_iter().map(|u| u * scale.factor).collect::<Vec<_>>(),
            "kept": kept.collect::<Vec<_>>(),
        })
    };
    json!({
        "unit": scale.unit,
        "factors": path.points.iter().map(|p| p.factor).collect::<Vec<_>>(),
        "kept": along.iter().map(|one| one.factor).collect::<Vec<_>>(),
        "limits": along.iter().enumerate().filter(|(_, one)| one.limit).map(|(k, _)| k).collect::<Vec<_>>(),
        "curves": drawn.iter().enumerate().map(curve).collect::<Vec<_>>(),
    })
}

/// A row each spring or hinge that has yielded.
fn first_yields(path: &Path) -> String {
    if path.yields.is_empty() {
        return String::new();
    }
    let row = |y: &PathYield| vec![y.name.clone(), number(y.factor)];
    let rows: Vec<Vec<String>> = path.yields.iter().map(row).collect();
    table("First yields", &["spring or hinge", "load factor"], &rows)
}

/// A row each limit point or bifurcation.
fn turns(path: &Path, what: &str, points: &[PathPoint]) -> String {
    if points.is_empty() {
        return String::new();
    }
    let mut header = vec!["load factor".to_owned()];
    for name in &path.names {
        header.extend((1..=2).map(|i| format!("{name}, {}", ["x", "y"][i - 1])));
    }
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    let moved = largest(points.iter().flat_map(|p| p.displacements.as_flattened()));
    let row = |point: &PathPoint| {
        let text_of = |u: &f64| quantity(Some(without_round_off(*u, moved)), "m");
        let mut row = vec![number(point.factor)];
        row.extend(point.displacements.as_flattened().iter().map(text_of));
        row
    };
    let rows: Vec<Vec<String>> = points.iter().take(FIGURES).map(row).collect();
    let shown = match points.len() {
        n if n > FIGURES => format!("{what}, the first {FIGURES} of {n}"),
        _ => what.to_owned(),
    };
    table(&shown, &header, &rows)
}

/// Curves in the picture.
const CURVES: usize = 4;

/// Recorded points and components that move the most, in their order.
pub(crate) fn drawn_displacements(path: &Path) -> Vec<(usize, usize)> {
    let column = |(point, component): (usize, usize)| -> Vec<f64> {
        path.points.iter().map(|p| p.displacements[point][component]).collect()
    };
    let mut all: Vec<(usize, usize)> =
        (0..path.names.len()).flat_map(|point| [(point, 0), (point, 1)]).collect();
    all.sort_by(|a, b| largest(&column(*b)).total_cmp(&largest(&column(*a))));
    let size = all.first().map_or(0.0, |first| largest(&column(*first)));
    all.retain(|c| !is_round_off(largest(&column(*c)), size));
    all.truncate(CURVES);
    all.sort_unstable();
    all
}
