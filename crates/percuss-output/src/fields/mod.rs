//! The configurations of a run over time: `fields/scene.json` says what stands there, `fields/frames.parquet` how it moved.
//!
//! Frames are kept in memory within a budget, so that a run of any length leaves a file of about the same size: those in which
//! something touches apart from those in which nothing does, each kind thinned by half whenever it has grown too many.

mod file;
mod places;
mod polyline;
mod scene;
mod store;
mod thin;

pub use file::{read, write};
pub(crate) use places::Places;
pub(crate) use polyline::ROW;
pub use scene::scene_value;
pub use store::{FrameStore, KeptFrames};

use percuss::{RunSummary, SectionRange};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

/// Directory within that of the run.
pub(crate) const DIRECTORY: &str = "fields";

/// The frames of a run.
#[derive(Clone, Debug, Default)]
pub struct Fields {
    /// What stands there, as in `scene.json`.
    pub scene: Value,
    /// Frames in the order of time, shape (frames).
    pub frames: Vec<StoredFrame>,
}

impl Fields {
    /// Notes in the scene what a run came to: what parted or failed, so that gaps are drawn from then on, and springs and hinges no longer; and
    /// the largest section forces of every beam, which may be between two frames.
    pub fn note(&mut self, run: &RunSummary) {
        for beam in self.scene["beams"].as_array_mut().into_iter().flatten() {
            let own = run.section_forces.iter().find(|own| beam["name"] == own.name.as_str());
            if let Some(own) = own {
                let of = |range: &SectionRange| range.largest().value.abs();
                beam["largest"] = json!({
                    "axial": of(&own.axial), "shear": of(&own.shear), "moment": of(&own.moment), "stress": of(&own.stress),
                });
            }
        }
        let number = |name: &str| {
            let beams = self.scene["beams"].as_array()?;
            beams.iter().position(|beam| beam["name"] == name)
        };
        let gaps: Vec<Value> = run
            .plastic
            .iter()
            .filter_map(|beam| Some((number(&beam.name)?, &beam.parted)))
            .flat_map(|(beam, parted)| {
                parted.iter().map(
                    move |one| json!({ "beam": beam, "stretch": one.stretch, "time": one.time }),
                )
            })
            .collect();
        for joint in self.scene["joints"].as_array_mut().into_iter().flatten() {
            let own = run.joints.iter().find(|own| joint["name"] == own.name.as_str());
            joint["until"] = own.and_then(|own| own.parted).map(|parted| parted.time).into();
        }
        for spring in self.scene["springs"].as_array_mut().into_iter().flatten() {
            let is_own = |name: &str| name.strip_prefix("spring.") == spring["name"].as_str();
            let own = run.yielding.iter().find(|own| is_own(&own.name));
            spring["until"] = own.and_then(|own| own.failed).into();
        }
        if let Value::Object(entries) = &mut self.scene {
            entries.insert("parted".to_owned(), Value::Array(gaps));
        }
    }
}

/// A frame as it is kept: floats of single precision, of displacements and not of positions.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct StoredFrame {
    /// Time \[s\].
    pub time: f64,
    /// Displacements of the scene's nodes, shape (n_node, 4) \[m, -; m, rad for bodies\].
    pub displacement: Vec<f32>,
    /// Velocities of the same, shape (n_node, 4) \[m/s, 1/s; m/s, rad/s for bodies\]; empty in runs that kept none.
    pub velocity: Vec<f32>,
    /// Angular velocity of the sections at the start, in the middle and at the end of every interval between two stations, shape
    /// (n_interval, 3) \[rad/s\]; empty in runs that kept none.
    pub angular_velocity: Vec<f32>,
    /// Axial force, shear force, moment at the start and at the end of every interval between two stations of a beam,
    /// shape (n_interval, 2, 3) \[N, N, N m\].
    pub section_forces: Vec<f32>,
    /// The same inside intervals, where straight lines between their ends would miss them: number of the interval, share of the way along it,
    /// axial force, shear force, moment; in the order of places, and two rows at a place where they jump; shape (n_point, 5)
    /// \[-, -, N, N, N m\]. Empty in runs of versions up to 0.1 that kept none.
    #[serde(default)]
    pub section_points: Vec<f32>,
    /// Number of the contact, position, force on its second partner, and 1 where that is an impulse; shape (n, 6) \[-, m, N or N s, -\].
    pub contact_forces: Vec<f32>,
    /// Factors of the loads, shape (n_load) \[-\].
    pub load_factors: Vec<f32>,
}
