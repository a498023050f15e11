//! Reactions of supports and section forces at recorded points over time: one figure a quantity, a curve a name, two for fibre stresses.

use serde_json::Value;

use super::canvas::{Canvas, names};
use super::draft::{Curve, Entry, Omit};
use super::extremes;
use super::figure::Section;
use crate::history::HistorySource;
use crate::shown::FIGURES;

/// Curves in a figure; more get more figures.
const TOGETHER: usize = 4;
/// A quantity and how its figure is called.
struct Quantity {
    /// Curves of a name: the end of the channel name, and the label if there are several, shape (curves).
    parts: Parts,
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
        (FORCE_X, "reaction-1", "Reactions along x", "reaction force along x", "N", force),
        (FORCE_Y, "reaction-2", "Reactions along y", "reaction force along y", "N", force),
        (MOMENT, "reaction-moment", "Reaction moments", "reaction moment", "N*m", moment),
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
        (AXIAL, "section-axial", "Axial force", "axial force", "N", force),
        (SHEAR, "section-shear", "Shear force", "shear force", "N", force),
        (MOMENT, "section-moment", "Bending moment", "bending moment", "N*m", moment),
        (STRESSES, "section-stress", "Fibre stress", "fibre stress", "Pa", 0.0),
    ];
    let note = "At the recorded points, averaged over the last step without impact.";
    entries(canvas, "section.", Section::Forces, note, &quantities.map(quantity))
}

/// Values on the page per bin, as many as [`reactions`] and [`section_forces`] may need.
pub(super) fn values_per_bin(history: &HistorySource) -> usize {
    let figures = |prefix: &str, parts: Parts| {
        let found = names(history, prefix, parts[0].0).len().min(FIGURES);
        found.div_ceil(TOGETHER / parts.len())
    };
    // 2 + 2 TOGETHER rows of TOGETHER values of 4 bytes and a time of 8.
    let one = (2 + 2 * TOGETHER) * (TOGETHER + 2);
    let forces = 3 * figures("support.", MOMENT) + 3 * figures("section.", MOMENT);
    one * (forces + figures("section.", STRESSES))
}

type Parts = &'static [(&'static str, &'static str)];
type Texts = (Parts, &'static str, &'static str, &'static str, &'static str, f64);

const FORCE_X: Parts = &[(".force_1", "")];
const FORCE_Y: Parts = &[(".force_2", "")];
const AXIAL: Parts = &[(".axial", "")];
const SHEAR: Parts = &[(".shear", "")];
const MOMENT: Parts = &[(".moment", "")];
const STRESSES: Parts = &[(".stress_top", "top fibre"), (".stress_bottom", "bottom fibre")];

fn quantity((parts, id, title, label, unit, floor): Texts) -> Quantity {
    Quantity { parts, id, title, label, unit, floor }
}

/// Curves of a name, several where a quantity has parts; `titled` if the title of the figure has the name.
fn curves(canvas: &Canvas<'_>, prefix: &str, parts: Parts, name: &str, titled: bool) -> Vec<Curve> {
    let curve = |(suffix, part): &(&str, &str)| {
        let label = match (parts.len(), titled) {
            (1, _) => name.to_owned(),
            (_, true) => (*part).to_owned(),
            (_, false) => format!("{name}, {part}"),
        };
        let channel = canvas.history.position(&format!("{prefix}{name}{suffix}"))?;
        Some(Curve::new(label, 0, channel))
    };
    parts.iter().filter_map(curve).collect()
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
        let found = names(canvas.history, prefix, quantity.parts[0].0);
        let shown = &found[..found.len().min(FIGURES)];
        let together = TOGETHER / quantity.parts.len();
        for (k, some) in shown.chunks(together).enumerate() {
            let (id, title) = match (some, shown.len() > together) {
                ([only], false) => (quantity.id.to_owned(), format!("{}, {only}", quantity.title)),
                (_, false) => (quantity.id.to_owned(), quantity.title.to_owned()),
                (_, true) => (
                    format!("{}-{}", quantity.id, k + 1),
                    format!("{} ({} of {})", quantity.title, k + 1, shown.len().div_ceil(together)),
                ),
            };
            let of = |name: &String| curves(canvas, prefix, quantity.parts, name, shown.len() == 1);
            let styled = |(k, curve)| Curve { style: 1 + k, ..curve };
            let curves = some.iter().flat_map(of).enumerate().map(styled).collect();
            let texts = (id.as_str(), title.as_str(), quantity.label);
            let mut draft = canvas.over_time(texts, section, quantity.unit, curves);
            draft.figure.picture = true;
            draft.figure.note = note.to_owned();
            if found.len() > FIGURES {
                draft.figure.note += &format!(" First {FIGURES} of {} shown.", found.len());
            }
            draft.omit = Omit::RoundOff;
            draft.floor = quantity.floor;
            all.push(Entry::Draft(draft));
        }
    }
    all
}
