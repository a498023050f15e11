//! The page of natural modes.

use percuss::scene::Scene;
use percuss::{Frame, Mode, ModeKind, Model};
use serde_json::json;

use super::{Page, swinging};
use crate::fields::{Fields, Places, scene_value};
use crate::report::html::{escape, table};
use crate::report::quantity::quantity;

/// Modes and what they belong to.
#[derive(Clone, Copy, Debug)]
pub struct ModesInfo<'a> {
    /// The scenario's title.
    pub title: &'a str,
    /// What they are taken about: `reference` or `static`.
    pub about: &'a str,
    /// The model.
    pub model: &'a Model,
    /// Nodal displacements of the configuration they are taken about, shape (nodes, 4) \[m, -\].
    pub displacement: &'a [[f64; 4]],
    /// The modes, in ascending order, shape (modes).
    pub modes: &'a [Mode],
}

/// The page of modes, the first so many of them drawn with their titles about a configuration; `svg` is shown without scripts.
pub(crate) fn render(
    info: &ModesInfo<'_>,
    (scene, about): (&Scene, &Frame<'_>),
    titles: &[String],
    svg: &str,
) -> String {
    let places = Places::of(scene);
    let shapes = info.modes.iter().take(titles.len()).map(|mode| places.shape(&mode.shape));
    let frames = std::iter::once(places.still(about)).chain(shapes).collect();
    let panels = titles.iter().enumerate().map(|(k, title)| swinging(title, k + 1, Some(0)));
    let taken = match info.about {
        "static" => "about the static equilibrium under the loads at time zero",
        _ => "about the stress-free reference configuration",
    };
    let note = "Mode shapes, scaled for display; all are shown with the same period. Mass-normalised nodal values in shapes.csv.";
    let page = Page {
        title: if info.title.is_empty() { "Natural modes" } else { info.title },
        status: format!("Natural modes {taken}; projectiles, discs and open stops are ignored."),
        alarming: false,
        scene: format!("<p class=\"note\">{}</p>\n", escape(note)),
        fields: Fields { scene: scene_value(scene), frames },
        details: json!({ "kind": "modes", "panels": panels.collect::<Vec<_>>() }),
        tables: table("Natural modes", &["mode", "frequency", "period", "comment"], &rows(info)),
        fallback: format!("<div class=\"sheet\">{svg}</div>"),
    };
    page.render()
}

fn rows(info: &ModesInfo<'_>) -> Vec<Vec<String>> {
    let row = |(k, mode): (usize, &percuss::Mode)| {
        let kind = mode.kind();
        let frequency = mode.frequency();
        let period = quantity(
            matches!(kind, ModeKind::Vibration | ModeKind::Flutter).then_some(1.0 / frequency),
            "s",
        );
        let growth = || quantity(Some(1.0 / mode.growth()), "s");
        let note = match kind {
            ModeKind::Vibration if mode.is_second_spectrum(info.model) => {
                "second spectrum: shear-flexible sections rotate".to_owned()
            }
            ModeKind::Vibration => String::new(),
            ModeKind::RigidBody => "rigid-body mode or mechanism".to_owned(),
            ModeKind::Unstable => {
                format!("unstable equilibrium: exponential growth, time constant {}", growth())
            }
            ModeKind::Flutter => format!(
                "flutter: unstable equilibrium, growing oscillation, time constant {}",
                growth()
            ),
        };
        vec![(k + 1).to_string(), quantity(Some(frequency), "Hz"), period, note]
    };
    info.modes.iter().enumerate().map(row).collect()
}
