//! What pages have in common: their head, their style, and the holes of their templates.

pub(crate) const HEAD: &str = include_str!("../../web/head.html");

pub(crate) const STYLE: &str = include_str!("../../web/report.css");

/// The scripts that draw figures and tie the page together, in the order in which they use each other.
pub(super) const SCRIPTS: [&str; 7] = [
    include_str!("../../web/columns.js"),
    include_str!("../../web/figures.js"),
    include_str!("../../web/zoom.js"),
    include_str!("../../web/exports.js"),
    include_str!("../../web/log.js"),
    include_str!("../../web/tables.js"),
    include_str!("../../web/report.js"),
];

pub(super) const UPLOT: &str = include_str!("../../web/vendor/uplot/uPlot.iife.min.js");

pub(super) const UPLOT_STYLE: &str = include_str!("../../web/vendor/uplot/uPlot.min.css");

pub(super) const UPLOT_LICENCE: &str = include_str!("../../web/vendor/uplot/LICENSE");

/// What every page with figures needs: its head, looks, the library that draws, the script.
pub(crate) fn page_parts(hole: &str) -> String {
    match hole {
        "head" => HEAD.to_owned(),
        "style" => format!("{UPLOT_STYLE}\n{STYLE}"),
        "licence" => format!("/*!\nuPlot\n\n{UPLOT_LICENCE}*/"),
        "uplot" => UPLOT.to_owned(),
        "script" => format!("{}\n{}", PENS, SCRIPTS.join("\n")),
        _ => String::new(),
    }
}

/// Replaces every `{{hole}}` of the template, looking at nothing that was put in.
pub(crate) fn fill_holes(template: &str, fill: impl Fn(&str) -> String) -> String {
    let mut out = String::new();
    let mut rest = template;
    while let Some((before, after)) = rest.split_once("{{") {
        out.push_str(before);
        let Some((hole, after)) = after.split_once("}}") else {
            out.push_str("{{");
            rest = after;
            continue;
        };
        out.push_str(&fill(hole));
        rest = after;
    }
    out.push_str(rest);
    out
}

/// What scenes and figures are drawn with.
pub(super) const PENS: &str = include_str!("../../web/pens.js");
