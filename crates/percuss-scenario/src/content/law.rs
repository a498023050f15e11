//! What acts where two things touch.

use percuss::{ContactForce, ImpactLaw};

use crate::format::{List, Maybe, Pair};
use crate::measure;
use crate::node::{Body, Reader};
use crate::quantity::Quantity;
use crate::table::{Braces, exclude};
use crate::tabulated::{self, Characteristic, File, Given, Sum, TableFile};
use crate::words::{Curvature, Force, Impact, OrEndless, Word};
use crate::write::Writer;

kinds! {
    /// How an elastic contact force grows with the penetration.
    pub enum Potential by "law" default "linear" {
        /// In proportion to it.
        Linear = "linear" {
            /// Stiffness (N/m).
            stiffness: f64 as Quantity<measure::Stiffness>,
            /// Stiffness (N/m) along which a contact opens that crushes: what is pushed in comes back along this line alone, the rest
            /// is lost. Nowhere may the law be steeper.
            unloading_stiffness: Option<f64> as Maybe<Quantity<measure::Stiffness>> = None,
        },
        /// With its power 3/2, as between curved bodies (Hertz).
        Hertz = "hertz" {
            /// Stiffness (N/m^1.5); this or `hertz`.
            hertz_stiffness: Option<f64> as Maybe<Quantity<measure::HertzStiffness>> = None,
            /// The two bodies from which the stiffness follows; this or `hertz_stiffness`.
            hertz: Option<HertzBodies> as Maybe<Braces<HertzBodies>> = None,
        },
        /// Along straight lines between given values, and on beyond the last one.
        Table = "table" {
            /// Penetrations, from zero on, increasing (m).
            penetrations: Option<Vec<f64>> as Maybe<List<Quantity<measure::Length>>> = None,
            /// Forces there, from zero on, never falling (N).
            forces: Option<Vec<f64>> as Maybe<List<Quantity<measure::Force>>> = None,
            /// Instead of both: path of a CSV file with two columns, penetration (m) and force (N).
            file: Option<TableFile> as Maybe<File<Characteristic>> = None,
            /// The SHA-256 that the file must have, 64 hexadecimal digits.
            sha256: Option<String> as Maybe<Sum> = None,
            /// Stiffness (N/m) along which a contact opens that crushes: what is pushed in comes back along this line alone, the rest
            /// is lost. Nowhere may the law be steeper.
            unloading_stiffness: Option<f64> as Maybe<Quantity<measure::Stiffness>> = None,
        },
        /// By a function that the program which reads the scenario gives.
        Given = "given",
    }
}

table! {
    /// Two elastic bodies in Hertz contact, one after the other in each list.
    pub struct HertzBodies {
        /// Young's moduli (Pa).
        young: [f64; 2] as Pair<Quantity<measure::Pressure>>,
        /// Poisson's ratios.
        poisson: [f64; 2] as Pair<Quantity<measure::Ratio>>,
        /// Radii of curvature where they touch (m), "flat" for a flat face.
        radius: [f64; 2] as Pair<OrEndless<Curvature>>,
    }
}

table! {
    /// A coefficient of restitution at a velocity, from which the dissipation follows.
    pub struct Rebound {
        /// Coefficient of restitution, above 0 and up to 1.
        restitution: f64 as Quantity<measure::Ratio>,
        /// Velocity of approach at which two free bodies part with it (m/s).
        velocity: f64 as Quantity<measure::Velocity>,
    }
}

table! {
    /// Law of an elastic contact.
    pub struct Smooth {
        /// Hunt and Crossley's factor chi (s/m): the elastic force times 1 + chi times the rate of penetration, never a
        /// pull; this or `rebound`.
        dissipation: Option<f64> as Maybe<Quantity<measure::Dissipation>> = None,
        /// Instead of `dissipation`, what it shall lead to: { restitution = ..., velocity = ... }.
        rebound: Option<Rebound> as Maybe<Braces<Rebound>> = None,
        /// How the contact force is evaluated over a step.
        force: ContactForce as Word<Force> = ContactForce::Conserving,
    }
    with {
        /// How the force grows with the penetration.
        potential: Potential
    }
    not {
        restitution: "`rebound = { restitution = ..., velocity = ... }`: an elastic projectile or contact has no coefficient \
                      of restitution, a dissipative law leads to one",
    }
    then settle_smooth
}

/// Each value from one source.
fn settle_smooth(law: &mut Smooth, body: &Body<'_>, reader: &mut Reader<'_>) {
    exclude(body, ["dissipation", "rebound"], reader);
    if law.rebound.is_none() {
        law.dissipation.get_or_insert(0.0);
    }
    match &mut law.potential {
        Potential::Linear { .. } | Potential::Given => {}
        Potential::Hertz { .. } => {
            let keys = ["hertz_stiffness", "hertz"];
            exclude(body, keys, reader);
            if !keys.iter().any(|key| body.get(key).is_some() || reader.excuses(body, key)) {
                let expected = "`hertz_stiffness`, such as \"5e8 N/m^1.5\", or `hertz`, the two \
                                bodies";
                reader.missing(body, "hertz_stiffness", "no stiffness", expected);
            }
        }
        Potential::Table { penetrations, forces, file, sha256, .. } => {
            let lists = [("penetrations", penetrations), ("forces", forces)];
            let given = Given { file, sum: sha256, lists };
            tabulated::settle::<Characteristic>(given, body, reader);
        }
    }
}

table! {
    /// What a rigid contact does besides its restitution along the normal.
    pub struct Sliding {
        /// Coefficient of Coulomb friction.
        friction: f64 as Quantity<measure::Ratio> = 0.0,
        /// Coefficient of restitution along the tangent, from 0 to 1.
        tangential_restitution: f64 as Quantity<measure::Ratio> = 0.0,
        /// What becomes of the velocities in an impact.
        impact_law: ImpactLaw as Word<Impact> = ImpactLaw::Newton,
    }
}

impl Default for Sliding {
    fn default() -> Self {
        Self { friction: 0.0, tangential_restitution: 0.0, impact_law: ImpactLaw::Newton }
    }
}

kinds! {
    /// What acts where two things touch.
    pub enum Law by "law" default "linear" {
        /// No penetration: impulses and persistent contact.
        Rigid = "rigid" {
            /// Coefficient of restitution, from 0 to 1.
            restitution: f64 as Quantity<measure::Ratio>,
        } with {
            /// What it does besides.
            sliding: Sliding
        },
    }
    or {
        /// A force that grows with the penetration.
        Smooth: Smooth
    }
}

impl Potential {
    /// Stiffness along which it opens, if it crushes \[N/m\].
    pub fn unloading(&self) -> Option<f64> {
        match self {
            Self::Linear { unloading_stiffness, .. } | Self::Table { unloading_stiffness, .. } => {
                *unloading_stiffness
            }
            _ => None,
        }
    }

    /// Penetrations and forces of a table, wherever they come from.
    pub fn columns(&self) -> Option<[&[f64]; 2]> {
        match self {
            Self::Table { file: Some(file), .. } => Some([&file.columns[0], &file.columns[1]]),
            Self::Table { penetrations: Some(a), forces: Some(b), .. } => Some([a, b]),
            _ => None,
        }
    }
}
