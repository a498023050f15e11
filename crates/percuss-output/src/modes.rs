//! Natural modes on disk: numbers, nodal shapes, a sheet of pictures, a page.

use std::fmt::Write as _;
use std::path::Path;

use percuss::scene::Scene;
use percuss::{Frame, Mode, ModeKind, Model};
use serde_json::{Value, json};

use crate::csv_text;
use crate::error::Error;
use crate::files;
use crate::report::quantity::number;
pub use crate::report::still::ModesInfo;
use crate::report::{pictures, still};
use crate::shapes::{self, Panel};

/// Modes drawn.
const DRAWN: usize = 60;

/// The word for what a mode is.
fn word(kind: ModeKind) -> &'static str {
    match kind {
        ModeKind::Vibration => "vibration",
        ModeKind::RigidBody => "rigid-body",
        ModeKind::Unstable => "unstable",
        ModeKind::Flutter => "flutter",
    }
}

fn grows(mode: &Mode) -> bool {
    matches!(mode.kind(), ModeKind::Unstable | ModeKind::Flutter)
}

/// The content of `modes.json`. What a mode has not, such as the frequency of an unstable one, is `null`.
pub fn modes_value(info: &ModesInfo<'_>) -> Value {
    let mode = |(k, m): (usize, &Mode)| {
        let frequency = m.frequency();
        json!({
            "number": k + 1,
            "kind": word(m.kind()),
            "frequency": frequency,
            "period": 1.0 / frequency,
            "eigenvalue": m.eigenvalue,
            "growth_rate": m.growth(),
            "second_spectrum": m.is_second_spectrum(info.model),
        })
    };
    json!({
        "percuss_version": env!("CARGO_PKG_VERSION"),
        "title": info.title,
        "about": info.about,
        "stable": !info.modes.iter().any(grows),
        "modes": info.modes.iter().enumerate().map(mode).collect::<Vec<_>>(),
    })
}

/// Writes `modes.json`, `shapes.csv`, `modes.svg`, `modes.png` and `modes.html` into `dir`. The page draws them in the scene, about
/// the configuration of a frame.
///
/// # Errors
/// If a file cannot be written or the picture not drawn.
pub fn write_modes(
    dir: impl AsRef<Path>,
    info: &ModesInfo<'_>,
    (scene, about): (&Scene, &Frame<'_>),
) -> Result<(), Error> {
    let dir = dir.as_ref();
    files::write(&dir.join("shapes.csv"), shapes_csv(info).as_bytes())?;
    let modes = info.modes.iter().take(DRAWN).enumerate();
    let panels: Vec<Panel<'_>> = modes.map(|(k, mode)| panel(k, mode, info.model)).collect();
    if !panels.is_empty() {
        let sheet = shapes::sheet(info.model, info.displacement, &panels);
        let titles: Vec<String> = panels.iter().map(|panel| panel.title.clone()).collect();
        let svg = pictures::inline_svg(&sheet);
        let page = still::modes_page(info, (scene, about), &titles, &svg);
        files::write(&dir.join("modes.html"), page.as_bytes())?;
        pictures::draw(dir, "modes", sheet)?;
    }
    files::write(&dir.join("modes.json"), format!("{:#}\n", modes_value(info)).as_bytes())
}

fn panel<'m>(k: usize, mode: &'m Mode, model: &Model) -> Panel<'m> {
    let (words, style) = match mode.kind() {
        ModeKind::Vibration if mode.is_second_spectrum(model) => {
            (format!("{} Hz, second spectrum", number(mode.frequency())), 1)
        }
        ModeKind::Vibration => (format!("{} Hz", number(mode.frequency())), 1),
        ModeKind::RigidBody => ("rigid-body motion, 0 Hz".to_owned(), 3),
        ModeKind::Unstable => ("unstable mode".to_owned(), 2),
        ModeKind::Flutter => (format!("flutter at {} Hz (growing)", number(mode.frequency())), 2),
    };
    Panel { title: format!("{}: {words}", k + 1), style, shape: &mode.shape }
}

/// One row a mode and node: where the node is, how it moves, and the slopes; unit modal mass.
fn shapes_csv(info: &ModesInfo<'_>) -> String {
    let mut text = "mode,beam,node,x1,x2,u1,u2,slope1,slope2\n".to_owned();
    let mut buffer = zmij::Buffer::new();
    for (k, mode) in info.modes.iter().enumerate() {
        let mut first = 0;
        for name in info.model.beam_names() {
            let nodes = info.model.beam_nodes(name).unwrap_or_default();
            let quoted = csv_text::quote(name);
            for (n, position) in nodes.iter().enumerate() {
                let _ = write!(text, "{},{quoted},{}", k + 1, n + 1); // a String never fails
                for value in position.iter().chain(&mode.shape[first + n]) {
                    let _ = write!(text, ",{}", buffer.format(*value));
                }
                text.push('\n');
            }
            first += nodes.len();
        }
    }
    text
}
