//! Reactions of supports and section forces at recorded points over time: one figure a quantity, a curve a name.

use serde_json::Value;

use super::canvas::{Canvas, names};
use super::draft::{Curve, Entry, Omit};
use super::extremes;
use super::figure::Section;
use crate::history::HistorySource;

/// Curves in a figure; more names get more figures.
const TOGETHER: usize = 4;
/// Supports, and points, that get curves.
const SHOWN: usize = 24;

/// A quantity and how its figure is called.
struct Quantity {
    /// What comes after the name in a channel.
    suffix: &'static str,
    id: &'static str,
    title: &'static str,
    label: &'static str,
    unit: &'static str,
    /// Size beside which curves are round-off.
    floor: f64,
}

/// Reactions of the supports.
pub(super) fn reactions(canvas: &Canvas<'_>, summary: &Value) -> Vec<Entry> {
    let (force, moment) = (extremes::reaction(summary), extremes::reaction_moment(summary));
    let quantities = [
        (".force_1", "reaction-1", "Reactions along x", "reaction force along x", "N", force),
        (".force_2", "reaction-2", "Reactions along y", "reaction force along y", "N", force),
        (".moment", "reaction-moment", "Reaction moments", "reaction moment", "N*m", moment),
    ];
    let note =
        "Force of the support on the structure, global axes, averaged over the output interval.";
    entries(canvas, "support.", Section::Supports, note, &quantities.map(quantity))
}

/// Section forces at the recorded points.
pub(super) fn section_forces(canvas: &Canvas<'_>, summary: &Value) -> Vec<Entry> {
    let force = extremes::section(summary, &["axial", "shear"]);
    let moment = extremes::section(summary, &["moment"]);
    let quantities = [
        (".axial", "section-axial", "Axial force", "axial force", "N", force),
        (".shear", "section-shear", "Shear force", "shear force", "N", force),
        (".moment", "section-moment", "Bending moment", "bending moment", "N*m", moment),
        (
            ".stress",
            "section-stress",
            "Fibre stress",
            "fibre stress of larger magnitude",
            "Pa",
            0.0,
        ),
    ];
    let note = "At the recorded points, averaged over the last step without impact.";
    entries(canvas, "section.", Section::Forces, note, &quantities.map(quantity))
}

/// Values on the page per bin, as many as [`reactions`] and [`section_forces`] may need.
pub(super) fn values_per_bin(history: &HistorySource) -> usize {
    let figures = |prefix: &str, suffix: &str| {
        names(history, prefix, suffix).len().min(SHOWN).div_ceil(TOGETHER)
    };
    // 2 + 2 TOGETHER rows of TOGETHER values of 4 bytes and a time of 8.
    let one = (2 + 2 * TOGETHER) * (TOGETHER + 2);
    one * (3 * figures("support.", ".moment") + 4 * figures("section.", ".moment"))
}

type Texts = (&'static str, &'static str, &'static str, &'static str, &'static str, f64);

fn quantity((suffix, id, title, label, unit, floor): Texts) -> Quantity {
    Quantity { suffix, id, title, label, unit, floor }
}

fn entries(
    canvas: &Canvas<'_>,
    prefix: &str,
    section: Section,
    note: &str,
    quantities: &[Quantity],
) -> Vec<Entry> {
    let mut all = Vec::new();
    for quantity in quantities {
        let found = names(canvas.history, prefix, quantity.suffix);
        let shown = &found[..found.len().min(SHOWN)];
        for (k, some) in shown.chunks(TOGETHER).enumerate() {
            let (id, title) = match (some, shown.len() > TOGETHER) {
                ([only], false) => (quantity.id.to_owned(), format!("{}, {only}", quantity.title)),
                (_, false) => (quantity.id.to_owned(), quantity.title.to_owned()),
                (_, true) => (
                    format!("{}-{}", quantity.id, k + 1),
                    format!("{} ({} of {})", quantity.title, k + 1, shown.len().div_ceil(TOGETHER)),
                ),
            };
            let curve = |(style, name): (usize, &String)| {
                let channel = format!("{prefix}{name}{}", quantity.suffix);
                Some(Curve::new(name.clone(), 1 + style, canvas.history.position(&channel)?))
            };
            let curves = some.iter().enumerate().filter_map(curve).collect();
            let texts = (id.as_str(), title.as_str(), quantity.label);
            let mut draft = canvas.over_time(texts, section, quantity.unit, curves);
            draft.figure.picture = true;
            draft.figure.note = note.to_owned();
            if found.len() > SHOWN {
                draft.figure.note += &format!(" First {SHOWN} of {} shown.", found.len());
            }
            draft.omit = Omit::RoundOff;
            draft.floor = quantity.floor;
            all.push(Entry::Draft(draft));
        }
    }
    all
}
