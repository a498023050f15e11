//! Damping, time, integration, recording, paths and reports.

use percuss::{MultipleImpacts, Start};
use serde_json::{Value as Json, json};
use toml::de::DeValue;

use crate::format::{Count, Format, Inline, List, Maybe};
use crate::measure::{self, Ratio};
use crate::node::{Body, Node, Reader};
use crate::point::{Point, PointText};
use crate::quantity::Quantity;
use crate::reach::Reached;
use crate::table::{Braces, exclude};
use crate::words::{Multiple, Started, Word};
use crate::write::Writer;

table! {
    /// Damping of the structure as a whole.
    pub struct Damping {
        /// Modal damping: ratios of critical damping of the flexible modes, from the lowest on; or one ratio for `modes` of them. It acts on
        /// motion relative to the rigid motion of each body and to moving supports; a mechanism cannot have it.
        modal: ModalRatios as Modal = ModalRatios::Each(Vec::new()),
        /// Number of modes damped where one ratio is given for all of them; 10 if none is given.
        modes: Option<usize> as Maybe<Count> = None,
    }
    then settle_damping
}

impl Default for Damping {
    fn default() -> Self {
        Self { modal: ModalRatios::Each(Vec::new()), modes: None }
    }
}

/// Modes that one ratio damps if nothing else is said.
const MODES: usize = 10;

fn settle_damping(damping: &mut Damping, body: &Body<'_>, reader: &mut Reader<'_>) {
    let unread = body.get("modal").is_some_and(|m| reader.tainted.contains(&m.path));
    match (&damping.modal, body.get("modes")) {
        _ if unread => {}
        (ModalRatios::All(_), _) => {
            damping.modes.get_or_insert(MODES);
        }
        (ModalRatios::Each(_), Some(modes)) => {
            let found = "`modes` without a single ratio for all of them";
            let expected = "`modal` to be one ratio, such as 0.01, or no `modes`";
            reader.misplaced(&modes.path, modes.span, found, expected);
        }
        (ModalRatios::Each(_), None) => {}
    }
}

/// Ratios of critical damping.
#[derive(Clone, Debug, PartialEq)]
pub enum ModalRatios {
    /// One for every damped mode.
    All(f64),
    /// One by one, from the lowest mode on, shape (modes) \[-\].
    Each(Vec<f64>),
}

/// A ratio, or a list of them.
pub(crate) struct Modal;

impl Format for Modal {
    type Value = ModalRatios;

    fn read(node: &Node<'_>, reader: &mut Reader<'_>) -> Option<ModalRatios> {
        match node.value {
            DeValue::Array(_) => List::<Quantity<Ratio>>::read(node, reader).map(ModalRatios::Each),
            DeValue::Integer(_) | DeValue::Float(_) | DeValue::String(_) => {
                Quantity::<Ratio>::read(node, reader).map(ModalRatios::All)
            }
            _ => {
                reader.wrong(node, node.found(), Self::expected());
                None
            }
        }
    }

    fn placeholder() -> ModalRatios {
        ModalRatios::Each(Vec::new())
    }

    fn expected() -> String {
        "a ratio of critical damping, such as 0.01, or a list of them".into()
    }

    fn schema() -> Json {
        let (one, list) = (Quantity::<Ratio>::schema(), List::<Quantity<Ratio>>::schema());
        json!({ "anyOf": [one, list] })
    }

    fn reach<'c>(value: &'c mut ModalRatios, path: &[String]) -> Reached<'c> {
        match value {
            ModalRatios::All(ratio) => Quantity::<Ratio>::reach(ratio, path),
            ModalRatios::Each(ratios) => List::<Quantity<Ratio>>::reach(ratios, path),
        }
    }
}

impl Inline for Modal {
    fn text(value: &ModalRatios) -> Option<String> {
        match value {
            ModalRatios::All(ratio) => Quantity::<Ratio>::text(ratio),
            ModalRatios::Each(ratios) => List::<Quantity<Ratio>>::text(ratios),
        }
    }
}

kinds! {
    /// Resolution of impacts of rigid contacts in time.
    pub enum Impacts by "impacts" default "event" {
        /// Event-driven: the instant of contact is located and the impulse acts there.
        Event = "event",
        /// Time-stepping: the gap is evaluated once per step.
        TimeStepping = "time-stepping" {
            /// A gap at or below this counts as closed (m).
            closed_tolerance: f64 as Quantity<measure::Length>
                = percuss::ImpactResolution::CLOSED_TOLERANCE,
        },
    }
}

table! {
    /// Duration and time step of the analysis.
    pub struct Time {
        /// Time at which the analysis ends (s).
        end: f64 as Quantity<measure::Time>,
        /// Time step (s); this or `accuracy`.
        step: Option<f64> as Maybe<Quantity<measure::Time>> = None,
        /// Accuracy of peak forces and deflections, for adaptive time steps; this or `step`.
        accuracy: Option<f64> as Maybe<Quantity<measure::Ratio>> = None,
        /// Configuration at time zero.
        start: Start as Word<Started> = Start::Reference,
        /// Treatment of multiple impacts: several bodies in contact that are struck at once.
        multiple_impacts: MultipleImpacts as Word<Multiple> = MultipleImpacts::Simultaneous,
    }
    with {
        /// Resolution of impacts of rigid contacts in time.
        impacts: Impacts
    }
    either step | accuracy
    then settle_time
}

fn settle_time(_: &mut Time, body: &Body<'_>, reader: &mut Reader<'_>) {
    let keys = ["step", "accuracy"];
    exclude(body, keys, reader);
    if !keys.iter().any(|key| body.get(key).is_some() || reader.excuses(body, key)) {
        let found = "neither `step` nor `accuracy`";
        let expected = "`step` (a time, such as \"1e-5 s\") or `accuracy` (such as \"1 %\")";
        reader.missing(body, "step", found, expected);
    }
}

kinds! {
    /// Time integration scheme.
    pub enum Scheme by "scheme" default "energy-momentum" {
        /// Energy-momentum through invariants: conserves energy and both momenta.
        EnergyMomentum = "energy-momentum",
        /// Energy-momentum with strains advanced by their midpoint rates.
        StrainRate = "strain-rate",
        /// Implicit midpoint rule.
        Midpoint = "midpoint",
        /// Newmark's average acceleration.
        Newmark = "newmark",
        /// Generalized-alpha (Chung and Hulbert 1993).
        GeneralizedAlpha = "generalized-alpha" {
            /// Spectral radius at infinite frequency, from 0 to 1.
            spectral_radius: f64 as Quantity<measure::Ratio> = 0.9,
        },
    }
}

table! {
    /// Time integration.
    pub struct Integrator {}
    with {
        /// Scheme.
        scheme: Scheme
    }
}

impl Default for Integrator {
    fn default() -> Self {
        Self { scheme: Scheme::EnergyMomentum }
    }
}

table! {
    /// What is recorded.
    pub struct Record {
        /// Output interval of the history in steps.
        every: usize as Count = 1,
        /// Points whose displacement is recorded, in addition to struck points.
        points: Vec<Point> as List<PointText> = Vec::new(),
        /// Memory for shapes of the structure over time, for the animation of the report, in megabytes; no shapes are recorded at 0.
        shapes: f64 as Quantity<measure::Ratio> = SHAPES,
    }
}

/// Memory for shapes unless given [MB].
const SHAPES: f64 = 4.0;

impl Default for Record {
    fn default() -> Self {
        Self { every: 1, points: Vec::new(), shapes: SHAPES }
    }
}

table! {
    /// End of the static equilibrium path: a load factor, or a displacement.
    pub struct Path {
        /// Load factor of the first point; the arc length to it is the largest.
        first: f64 as Quantity<measure::Ratio> = 0.05,
        /// Largest number of points of the path.
        points: usize as Count = 500,
        /// Ends at this load factor; 1 if neither this nor `until` is given.
        factor: Option<f64> as Maybe<Quantity<measure::Ratio>> = None,
        /// Ends at this displacement of a point.
        until: Option<PathTarget> as Maybe<Braces<PathTarget>> = None,
    }
    then settle_path
}

impl Default for Path {
    fn default() -> Self {
        Self { first: 0.05, points: 500, factor: Some(1.0), until: None }
    }
}

fn settle_path(path: &mut Path, body: &Body<'_>, reader: &mut Reader<'_>) {
    if !exclude(body, ["factor", "until"], reader) && body.get("until").is_none() {
        path.factor.get_or_insert(1.0);
    }
}

table! {
    /// A displacement reached.
    pub struct PathTarget {
        /// The point.
        point: Point as PointText,
        /// Component of its displacement: 1 or 2.
        component: usize as Count,
        /// Displacement (m).
        value: f64 as Quantity<measure::Length>,
    }
}

table! {
    /// What the report shows.
    pub struct Report {
        /// Coefficients of restitution for the figure that compares them.
        restitution: Option<Vec<f64>> as Maybe<List<Quantity<measure::Ratio>>> = None,
    }
}

impl Report {
    /// Nothing beyond what every report shows.
    pub fn plain() -> Self {
        Self { restitution: None }
    }
}
