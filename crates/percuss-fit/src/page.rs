//! The page of a fit: measured and computed curves over each other, residuals, parameters.

use percuss_output::report::sheet::{Block, Chart, Curve, Mark, Quantity, Sheet, in_words, render};

use crate::fit::{Fit, Overlay};
use crate::text::fit_text;

/// Points of a curve at most.
const POINTS: usize = 4000;

/// The page of a fit as HTML, with everything it needs in it.
pub fn fit_page(fit: &Fit) -> String {
    let title = if fit.title.is_empty() { "Percuss fit" } else { &fit.title };
    let warnings = match fit.doubts.len() {
        0 => String::new(),
        1 => ", 1 warning".into(),
        n => format!(", {n} warnings"),
    };
    let status =
        format!("{}; reduced chi-square {:.4}{warnings}", fit.message, fit.reduced_chi_square);
    let mut blocks: Vec<Block> =
        fit.doubts.iter().map(|doubt| Block::Warning(doubt.text.clone())).collect();
    blocks.push(parameters(fit));
    blocks.push(channels(fit));
    for overlay in &fit.overlays {
        blocks.push(Block::Heading(format!("{}: {}", overlay.test, overlay.channel)));
        blocks.push(Block::Charts(vec![curves(overlay), residuals(overlay)]));
    }
    blocks.push(Block::Listing { summary: "Report".into(), text: fit_text(fit) });
    if let Some((_, text)) = fit.scenarios.first() {
        let summary = "Scenario with the values found".into();
        blocks.push(Block::Listing { summary, text: text.clone() });
    }
    let alarming = !fit.success || !fit.doubts.is_empty();
    render(&Sheet { title: title.into(), status, alarming, blocks })
}

fn parameters(fit: &Fit) -> Block {
    let header = ["parameter", "value", "standard error", "95 % interval", "start"];
    let row = |one: &crate::fit::FittedParameter| {
        let words = |x: f64| in_words(x, &one.unit);
        let [low, high] = one.interval.map(words);
        let error = match (one.fixed, one.stderr.is_finite()) {
            (true, _) => "fixed".into(),
            (_, true) => words(one.stderr),
            (_, false) => "not determined".into(),
        };
        let interval = if one.fixed { String::new() } else { format!("{low} to {high}") };
        vec![one.name.clone(), words(one.value), error, interval, words(one.start)]
    };
    Block::Table {
        caption: "Parameters".into(),
        header: header.map(str::to_owned).into(),
        rows: fit.parameters.iter().map(row).collect(),
    }
}

fn channels(fit: &Fit) -> Block {
    let header = [
        "channel",
        "rms of the residuals",
        "standard deviation",
        "reduced chi-square",
        "R\u{b2}",
        "autocorrelation",
        "",
    ];
    let row = |one: &crate::goodness::Goodness| {
        vec![
            format!("{}: {}", one.test, one.channel),
            in_words(one.rms, &one.unit),
            in_words(one.sigma, &one.unit),
            format!("{:.3}", one.reduced_chi_square),
            format!("{:.5}", one.r_squared),
            format!("{:.3}", one.autocorrelation),
            if one.hold_out { "not fitted".into() } else { String::new() },
        ]
    };
    Block::Table {
        caption: "Channels".into(),
        header: header.map(str::to_owned).into(),
        rows: fit.channels.iter().map(row).collect(),
    }
}

/// Every so many points, so that a page stays small.
fn thinned(overlay: &Overlay, values: impl Fn(usize) -> f64) -> (Vec<f64>, Vec<f64>) {
    let stride = overlay.time.len().div_ceil(POINTS).max(1);
    (0..overlay.time.len()).step_by(stride).map(|k| (overlay.time[k], values(k))).unzip()
}

fn quantity(label: &str, unit: &str) -> Quantity {
    Quantity { label: label.into(), unit: unit.into() }
}

fn curves(overlay: &Overlay) -> Chart {
    let (x, measured) = thinned(overlay, |k| overlay.measured[k]);
    let (time, computed) = thinned(overlay, |k| overlay.computed[k]);
    Chart {
        id: format!("{}-{}", overlay.test, overlay.channel),
        title: overlay.column.clone(),
        note: format!("the run starts at {} of the record", in_words(overlay.offset, "s")),
        x: quantity("time of the record", "s"),
        y: quantity(&overlay.channel, &overlay.unit),
        from_zero: false,
        curves: vec![
            Curve { label: "measured".into(), style: 1, mark: Mark::Dots, x, y: measured },
            Curve { label: "computed".into(), style: 2, mark: Mark::Line, x: time, y: computed },
        ],
    }
}

fn residuals(overlay: &Overlay) -> Chart {
    let (x, y) = thinned(overlay, |k| overlay.computed[k] - overlay.measured[k]);
    Chart {
        id: format!("{}-{}-residuals", overlay.test, overlay.channel),
        title: "Residuals: computed less measured".into(),
        note: String::new(),
        x: quantity("time of the record", "s"),
        y: quantity("residual", &overlay.unit),
        from_zero: false,
        curves: vec![Curve { label: "residual".into(), style: 1, mark: Mark::Dots, x, y }],
    }
}
