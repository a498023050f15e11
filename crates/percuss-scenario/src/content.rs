//! What a scenario file contains, table by table, in SI units and with every default filled in.
//!
//! The doc comment of a key is also its description in the JSON Schema.

use percuss::{Component, ContactForce, JointKind, RotaryInertia, StrainMeasure};

use crate::format::{Count, List, MaterialName, Maybe, NameOf, Pair, SectionName, Text};
use crate::measure;
use crate::node::{Body, Reader};
use crate::point::{Point, PointText};
use crate::quantity::{Quantity, Vector};
use crate::table::{Collection, Named, Single};
use crate::words::{Contact, Force, Held, Joined, Rotary, Strain, Touch, Until, Word};
use crate::write::Writer;

table! {
    /// A beam or a frame, what holds it, what loads it and what strikes it.
    pub struct Content {
        /// One line about the scenario.
        title: String as Text = String::new(),
        /// Materials, by name.
        material: Vec<Named<Material>> as Collection<Material> = Vec::new(),
        /// Cross sections, by name.
        section: Vec<Named<Section>> as Collection<Section> = Vec::new(),
        /// Beams, by name.
        beam: Vec<Named<Beam>> as Collection<Beam>,
        /// Supports to ground, by name.
        support: Vec<Named<Support>> as Collection<Support> = Vec::new(),
        /// Joints between beams, by name.
        joint: Vec<Named<Joint>> as Collection<Joint> = Vec::new(),
        /// Projectiles, by name.
        projectile: Vec<Named<Projectile>> as Collection<Projectile> = Vec::new(),
        /// Loads, by name.
        load: Vec<Named<Load>> as Collection<Load> = Vec::new(),
        /// How long the analysis runs and in which steps.
        time: Time as Single<Time>,
        /// Time integration.
        integrator: Integrator as Single<Integrator> = Integrator::default(),
        /// What is recorded.
        record: Record as Single<Record> = Record::default(),
        /// What the report shows.
        report: Report as Single<Report> = Report::plain(),
    }
}

table! {
    /// Material of a beam.
    pub struct Material {
        /// Young's modulus (Pa).
        young: f64 as Quantity<measure::Pressure>,
        /// Density (kg/m^3).
        density: f64 as Quantity<measure::Density>,
        /// Strain measure of the strain energy.
        strain: StrainMeasure as Word<Strain> = StrainMeasure::Green,
    }
}

table! {
    /// Cross section of a beam.
    pub struct Section {
        /// Area (m^2).
        area: f64 as Quantity<measure::Area>,
        /// Second moment of area (m^4).
        inertia: f64 as Quantity<measure::Inertia>,
        /// true: density times second moment of area; false: none; or a value per length (kg m).
        rotary_inertia: RotaryInertia as Rotary = RotaryInertia::Density,
    }
}

table! {
    /// A straight beam.
    pub struct Beam {
        /// Points the centre line runs through (m): its start and its end.
        points: Vec<[f64; 2]> as List<Vector<measure::Length>>,
        /// Number of finite elements.
        elements: usize as Count,
        /// Name of its material.
        material: String as NameOf<MaterialName>,
        /// Name of its section.
        section: String as NameOf<SectionName>,
    }
}

kinds! {
    /// What a support holds.
    pub enum SupportKind by "kind" {
        /// Holds both displacements and the direction of the tangent; the stretch stays free.
        Clamp = "clamp",
        /// Holds both displacements.
        Pin = "pin",
        /// Holds the displacement across `direction`.
        Roller = "roller" {
            /// Direction along which it rolls freely.
            direction: [f64; 2] as Vector<measure::Ratio> = [1.0, 0.0],
        },
        /// Holds the listed components.
        Fix = "fix" {
            /// Components held: 1, 2 (displacements), "rotation", "stretch".
            components: Vec<Component> as List<Held>,
        },
    }
}

table! {
    /// A support to ground.
    pub struct Support {
        /// The point held.
        at: Point as PointText,
    }
    with {
        /// What it holds.
        kind: SupportKind
    }
}

table! {
    /// A joint between two beams.
    pub struct Joint {
        /// What is shared.
        kind: JointKind as Word<Joined>,
        /// The two points joined; they must lie at the same place.
        between: [Point; 2] as Pair<PointText>,
    }
}

kinds! {
    /// What strikes.
    pub enum ProjectileKind by "kind" {
        /// A mass behind a massless spring.
        Elastic = "elastic" {
            /// Stiffness of the spring (N/m).
            stiffness: f64 as Quantity<measure::Stiffness>,
            /// How the contact force is evaluated over a step.
            force: ContactForce as Word<Force> = ContactForce::Conserving,
        },
        /// A rigid mass under Newton's impact law.
        Rigid = "rigid" {
            /// Coefficient of restitution, from 0 to 1.
            restitution: f64 as Quantity<measure::Ratio>,
        },
    }
}

table! {
    /// A projectile: it moves along a fixed line of flight and strikes a point of a beam.
    pub struct Projectile {
        /// Mass (kg).
        mass: f64 as Quantity<measure::Mass>,
        /// Initial velocity (m/s).
        velocity: [f64; 2] as Vector<measure::Velocity>,
        /// Line of flight towards the beam; needed only where the velocity is zero.
        direction: Option<[f64; 2]> as Maybe<Vector<measure::Ratio>> = None,
        /// The point struck.
        strikes: Point as PointText,
        /// Initial distance from the beam along the line of flight (m).
        standoff: f64 as Quantity<measure::Length> = 0.0,
        /// Where it touches the beam.
        contact: Contact as Word<Touch> = Contact::Point,
    }
    with {
        /// What strikes.
        kind: ProjectileKind
    }
}

kinds! {
    /// What a load applies.
    pub enum LoadKind by "kind" {
        /// Gravity on every beam and projectile.
        Gravity = "gravity" {
            /// Acceleration (m/s^2).
            acceleration: [f64; 2] as Vector<measure::Acceleration>,
        },
        /// A dead force and a moment at a point.
        Point = "point" {
            /// The point loaded.
            at: Point as PointText,
            /// Force (N).
            force: [f64; 2] as Vector<measure::Force> = [0.0, 0.0],
            /// Moment, positive counter-clockwise (N m).
            moment: f64 as Quantity<measure::Moment> = 0.0,
        },
    }
}

table! {
    /// A load, constant while it acts.
    pub struct Load {
        /// Acts from this time on (s).
        from: f64 as Quantity<measure::Time> = 0.0,
        /// Acts until this time (s), or "forever".
        until: f64 as Until = f64::INFINITY,
    }
    with {
        /// What it applies.
        kind: LoadKind
    }
}

kinds! {
    /// How impacts of rigid projectiles are resolved in time.
    pub enum Impacts by "impacts" default "event" {
        /// The instant of contact is located and the impulse acts there.
        Event = "event",
        /// The gap is looked at once per step.
        TimeStepping = "time-stepping" {
            /// A gap at or below this counts as closed (m).
            closed_tolerance: f64 as Quantity<measure::Length>
                = percuss::ImpactResolution::CLOSED_TOLERANCE,
        },
    }
}

table! {
    /// How long the analysis runs and in which steps.
    pub struct Time {
        /// Time at which the analysis ends (s).
        end: f64 as Quantity<measure::Time>,
        /// Time step (s).
        step: f64 as Quantity<measure::Time>,
    }
    with {
        /// How impacts of rigid projectiles are resolved in time.
        impacts: Impacts
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
        /// A row is recorded every so many steps.
        every: usize as Count = 1,
        /// Points whose displacement is recorded, besides those struck.
        points: Vec<Point> as List<PointText> = Vec::new(),
    }
}

impl Default for Record {
    fn default() -> Self {
        Self { every: 1, points: Vec::new() }
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
