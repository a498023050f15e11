//! Loads.

use percuss::Along;

use super::function::{Function, FunctionText};
use crate::format::{Flag, Maybe, Pair};
use crate::measure;
use crate::name::{BeamName, NameOf};
use crate::node::{Body, Reader};
use crate::point::{Place, Point, PointText};
use crate::quantity::{Quantity, Vector};
use crate::source::join;
use crate::words::{OrEndless, Until};
use crate::write::Writer;

kinds! {
    /// Kind of a load.
    pub enum LoadKind by "kind" {
        /// Gravity on every beam, point mass and projectile.
        Gravity = "gravity" {
            /// Acceleration (m/s^2), times `function`.
            acceleration: [f64; 2] as Vector<measure::Acceleration>,
        },
        /// An acceleration of the base: of the ground, and of all supports and obstacles with it, as of an accelerogram (`acceleration =
        /// [1, 0]` with a table of the record in m/s^2). Displacements, velocities, accelerations, their spectra, and energies are relative to
        /// the base, not absolute: the absolute acceleration is the relative one plus that of the base. Reactions, section forces and stresses
        /// are those of the true motion. Outside the times of its table it is zero. In statics it counts with its
        /// value at time zero, as other loads do. A CSV file may hold accelerations, by its header (`time (s),acceleration (m/s^2)`, or `(g)`);
        /// `acceleration` is then their direction, of magnitude 1 m/s^2.
        Base = "base" {
            /// Acceleration of the base (m/s^2), times `function`.
            acceleration: [f64; 2] as Vector<measure::Acceleration>,
        },
        /// A force and a moment at a point.
        Point = "point" {
            /// The point loaded.
            at: Point as PointText,
            /// Force (N): along e1 and e2, or along tangent and normal if it follows.
            force: [f64; 2] as Vector<measure::Force> = [0.0, 0.0],
            /// Moment, positive counter-clockwise (N m).
            moment: f64 as Quantity<measure::Moment> = 0.0,
            /// Whether the force turns with the tangent.
            follower: bool as Flag = false,
        },
        /// A force per length along a stretch of a beam, varying linearly between its ends.
        Distributed = "distributed" {
            /// Name of the beam.
            on: String as NameOf<BeamName>,
            /// Ends of the stretch: each "start", "mid", "end", a fraction or a length.
            stretch: [Along; 2] as Pair<Place> = [Along::Fraction(0.0), Along::Fraction(1.0)],
            /// Force per length at the start of the stretch (N/m): along e1 and e2, or along tangent and normal
            /// if it follows; a pressure follows along the normal.
            force: [f64; 2] as Vector<measure::LineForce>,
            /// Force per length at the end of the stretch (N/m); the same if none is given.
            force_end: Option<[f64; 2]> as Maybe<Vector<measure::LineForce>> = None,
            /// Whether the force turns with the tangent.
            follower: bool as Flag = false,
        },
        /// A change of temperature of a stretch of a beam from that of the reference configuration, uniform and linear through the depth, times
        /// `function`: strains `expansion * (change + gradient * height)` of its materials, which need an `expansion`. Beams that yield or
        /// have sections of fibres cannot be heated.
        Temperature = "temperature" {
            /// Name of the beam.
            on: String as NameOf<BeamName>,
            /// Ends of the stretch: each "start", "mid", "end", a fraction or a length.
            stretch: [Along; 2] as Pair<Place> = [Along::Fraction(0.0), Along::Fraction(1.0)],
            /// Change of temperature on the axis (K).
            change: f64 as Quantity<measure::Temperature> = 0.0,
            /// Rise of the temperature per depth towards the top fibre (K/m): the difference between top and bottom over the depth.
            gradient: f64 as Quantity<measure::TemperatureGradient> = 0.0,
        },
        /// A strain and a curvature that a stretch of a beam would take without forces (shrinkage, prestress, misfit), times `function`. Not of
        /// beams that yield or have sections of fibres.
        Strain = "strain" {
            /// Name of the beam.
            on: String as NameOf<BeamName>,
            /// Ends of the stretch: each "start", "mid", "end", a fraction or a length.
            stretch: [Along; 2] as Pair<Place> = [Along::Fraction(0.0), Along::Fraction(1.0)],
            /// Elongation per length, in the strain measure of the material; shortening is negative.
            strain: f64 as Quantity<measure::Ratio> = 0.0,
            /// Rotation per length, counter-clockwise along the beam (1/m): the bottom fibre is longer where it is positive.
            curvature: f64 as Quantity<measure::TurnPerLength> = 0.0,
        },
    }
}

table! {
    /// A load, times a function of time while it acts.
    pub struct Load {
        /// Start of the load (s).
        from: f64 as Quantity<measure::Time> = 0.0,
        /// End of the load (s), or "forever".
        until: f64 as OrEndless<Until> = f64::INFINITY,
        /// Its time function, with the time since `from`: "constant" or a table { kind = ... }.
        function: Function as FunctionText = Function::Constant,
    }
    with {
        /// Its kind.
        kind: LoadKind
    }
    then settle_load
}

/// A file of accelerations is multiplied by a direction.
fn settle_load(load: &mut Load, body: &Body<'_>, reader: &mut Reader<'_>) {
    if !matches!(load.kind, LoadKind::Base { .. }) {
        return;
    }
    let function = join(&body.path, "function");
    let Some(node) = body.get("acceleration") else { return };
    let is_file = reader.accelerations.contains(&join(&function, "file"));
    if !is_file || reader.tainted.contains(&node.path) {
        return;
    }
    if let Some((found, expected)) = load.scales_accelerations() {
        reader.misplaced(&node.path, node.span, found, expected);
    }
}

impl Load {
    /// What was found and what would be right, of a base acceleration that is more than the direction of a file of accelerations.
    pub(crate) fn scales_accelerations(&self) -> Option<(String, &'static str)> {
        let LoadKind::Base { acceleration: [x, y] } = self.kind else { return None };
        let magnitude = x.hypot(y);
        if (magnitude - 1.0).abs() < 1e-9 {
            return None;
        }
        let found =
            format!("{magnitude} m/s^2 times a file that holds accelerations by its header");
        let expected =
            "a direction of magnitude 1 m/s^2, or a header that calls the column a factor";
        Some((found, expected))
    }
}
