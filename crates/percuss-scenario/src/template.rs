//! Commented files to start from.

/// A commented file to start from: a scenario, a study or a fit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Template {
    /// Its name.
    pub name: &'static str,
    /// What it shows, in one line.
    pub summary: &'static str,
    /// The file.
    pub text: &'static str,
    /// Files that it names, which lie beside it: name and text of each, shape (files).
    pub files: &'static [(&'static str, &'static str)],
}

/// The scenario that studies and fits begin with.
const ELASTIC: &str = include_str!("../templates/elastic.toml");

/// Every template, the simplest first.
pub fn templates() -> &'static [Template] {
    &[
        Template {
            name: "elastic",
            summary: "a mass behind a spring strikes a clamped beam",
            text: ELASTIC,
            files: &[],
        },
        Template {
            name: "rigid",
            summary: "a rigid mass strikes a clamped beam repeatedly",
            text: include_str!("../templates/rigid.toml"),
            files: &[],
        },
        Template {
            name: "frame",
            summary: "a mass behind a spring strikes the column of a frame",
            text: include_str!("../templates/frame.toml"),
            files: &[],
        },
        Template {
            name: "portal",
            summary: "a car strikes a column of a portal frame that carries loads",
            text: include_str!("../templates/portal.toml"),
            files: &[],
        },
        Template {
            name: "arch",
            summary: "snap-through of a shallow arch under impact",
            text: include_str!("../templates/arch.toml"),
            files: &[],
        },
        Template {
            name: "gapped-pipe",
            summary: "a struck pipe in brackets with clearance",
            text: include_str!("../templates/gapped-pipe.toml"),
            files: &[],
        },
        Template {
            name: "flying-beam",
            summary: "a free beam after a force and a moment of limited duration",
            text: include_str!("../templates/flying-beam.toml"),
            files: &[],
        },
        Template {
            name: "bouncing-ball",
            summary: "a ball bounces on a fixed beam until it is at rest",
            text: include_str!("../templates/bouncing-ball.toml"),
            files: &[],
        },
        Template {
            name: "surface",
            summary: "a puck is thrown obliquely at a free beam and slides along it",
            text: include_str!("../templates/surface.toml"),
            files: &[],
        },
        Template {
            name: "deep-girder",
            summary: "a mass meets a deep timber girder, which is flexible in shear",
            text: include_str!("../templates/deep-girder.toml"),
            files: &[],
        },
    ]
}

/// Commented studies to start from; their base is a scenario `my.toml` beside them, made from the template `elastic`.
pub fn study_templates() -> &'static [Template] {
    &[Template {
        name: "study",
        summary: "many runs of a scenario: parameters, sampling design and results",
        text: include_str!("../templates/study.toml"),
        files: &[("my.toml", ELASTIC)],
    }]
}

/// Commented fits to start from; their base is a scenario `my.toml` beside them, made from the template `elastic`, and their record is
/// `my.csv`.
pub fn fit_templates() -> &'static [Template] {
    &[Template {
        name: "fit",
        summary: "numbers of a scenario from measured curves: parameters, a record and its channels",
        text: include_str!("../templates/fit.toml"),
        files: &[("my.toml", ELASTIC), ("my.csv", include_str!("../templates/fit.csv"))],
    }]
}
