//! Foundations along beams.

use percuss::Along;

use super::yielding::settle_connector_yield;
use crate::format::{Couple, List, Maybe, Pair};
use crate::measure;
use crate::name::{BeamName, NameOf};
use crate::node::{Body, Reader};
use crate::point::Place;
use crate::quantity::{Quantity, Vector};
use crate::table::{Braces, exclude};
use crate::write::Writer;

kinds! {
    /// How the reaction of a foundation, a force per length, follows from the deflection of the beam into it.
    pub enum FoundationLaw by "law" default "linear" {
        /// In proportion to it (Winkler): it pushes the beam that is pressed in and pulls the one that lifts.
        Linear = "linear" {
            /// Stiffness per length of the beam (N/m^2): the modulus of subgrade reaction times the width of the beam.
            stiffness: f64 as Quantity<measure::LineStiffness>,
            /// Reaction per length at which it yields (N/m), pushing and pulling; elastic if omitted.
            yield_force: Option<f64> as Maybe<Quantity<measure::LineForce>> = None,
            /// Hardening with plastic deflection; perfectly plastic if omitted.
            hardening: Option<FoundationHardening> as Maybe<Braces<FoundationHardening>> = None,
        },
        /// Compression only: it pushes beyond a gap and never pulls, so that the beam lifts off.
        Compression = "compression" {
            /// Stiffness per length of the beam (N/m^2).
            stiffness: f64 as Quantity<measure::LineStiffness>,
            /// Deflection up to which there is no contact (m).
            gap: f64 as Quantity<measure::Length> = 0.0,
            /// Reaction per length at which it yields (N/m); beyond it a gap remains after unloading. Elastic if omitted.
            yield_force: Option<f64> as Maybe<Quantity<measure::LineForce>> = None,
            /// Hardening with plastic deflection, isotropic or a table; perfectly plastic if omitted.
            hardening: Option<FoundationHardening> as Maybe<Braces<FoundationHardening>> = None,
        },
        /// Along straight lines between given values (a p-y curve), elastic; beyond the first and the last one the reaction keeps its value
        /// there.
        Table = "table" {
            /// Deflections into the foundation, increasing; those of a beam that lifts are negative (m).
            deflections: Vec<f64> as List<Quantity<measure::Length>>,
            /// Reactions per length there (N/m), positive where they push the beam out, zero without deflection; they may fall.
            reactions: Vec<f64> as List<Quantity<measure::LineForce>>,
        },
    }
}

table! {
    /// A foundation along a stretch of a beam: at every point of the axis the ground reacts on the displacement of that point alone (Winkler), along
    /// a direction that is fixed in space. It reacts from the reference configuration on.
    pub struct Foundation {
        /// Name of the beam.
        on: String as NameOf<BeamName>,
        /// Ends of the stretch: each "start", "mid", "end", a fraction or a length.
        stretch: [Along; 2] as Pair<Place> = [Along::Fraction(0.0), Along::Fraction(1.0)],
        /// Direction in which it pushes the beam, along e1 and e2. If omitted, the normal to the left of the beam's direction in the reference
        /// configuration, place by place: upwards for a beam drawn from left to right.
        direction: Option<[f64; 2]> as Maybe<Vector<measure::Ratio>> = None,
        /// Damping per length of the beam (N s/m^2); of a foundation of compression alone it acts where the foundation does.
        damping: f64 as Quantity<measure::LineDamping> = 0.0,
    }
    with {
        /// Its law: how the reaction follows from the deflection, which is the displacement against `direction`.
        law: FoundationLaw
    }
    then settle_foundation
}

fn settle_foundation(foundation: &mut Foundation, body: &Body<'_>, reader: &mut Reader<'_>) {
    if matches!(foundation.law, FoundationLaw::Table { .. }) {
        return; // these keys belong to another law, which is reported
    }
    settle_connector_yield(["yield_force", "hardening", "hardening"], body, reader);
}

table! {
    /// Hardening of a foundation with plastic deflection.
    pub struct FoundationHardening {
        /// Isotropic plastic stiffness per length, d(reaction)/d(plastic deflection) (N/m^2); this or `table`, zero if omitted.
        isotropic: Option<f64> as Maybe<Quantity<measure::LineStiffness>> = None,
        /// Kinematic plastic stiffness per length: translates the range between both yield forces (N/m^2). Not of a foundation of compression alone.
        kinematic: f64 as Quantity<measure::LineStiffness> = 0.0,
        /// Instead of `isotropic`: [plastic deflection (m), reaction per length (N/m)], from [0, yield force] on; constant beyond the last.
        table: Option<Vec<[f64; 2]>> as Maybe<List<Couple<Quantity<measure::Length>, Quantity<measure::LineForce>>>> = None,
    }
    then settle_foundation_hardening
}

fn settle_foundation_hardening(
    _: &mut FoundationHardening,
    body: &Body<'_>,
    reader: &mut Reader<'_>,
) {
    exclude(body, ["isotropic", "table"], reader);
}
