//! Contact laws.

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
    /// Force of a compliant contact as a function of the penetration.
    pub enum Potential by "law" default "linear" {
        /// Proportional to the penetration.
        Linear = "linear" {
            /// Stiffness (N/m).
            stiffness: f64 as Quantity<measure::Stiffness>,
            /// Unloading stiffness of a contact that crushes (N/m): the indentation is permanent except for the elastic part along this
            /// line. At least the largest slope of the law.
            unloading_stiffness: Option<f64> as Maybe<Quantity<measure::Stiffness>> = None,
        },
        /// Hertz contact of curved bodies: power 3/2 of the penetration.
        Hertz = "hertz" {
            /// Stiffness (N/m^1.5); this or `hertz`.
            hertz_stiffness: Option<f64> as Maybe<Quantity<measure::HertzStiffness>> = None,
            /// The two bodies from which the stiffness follows; this or `hertz_stiffness`.
            hertz: Option<HertzBodies> as Maybe<Braces<HertzBodies>> = None,
        },
        /// Linear between given values, and extrapolated beyond the last one.
        Table = "table" {
            /// Penetrations, from zero on, increasing (m).
            penetrations: Option<Vec<f64>> as Maybe<List<Quantity<measure::Length>>> = None,
            /// Forces there, from zero on, not decreasing (N).
            forces: Option<Vec<f64>> as Maybe<List<Quantity<measure::Force>>> = None,
            /// Instead of both: path of a CSV file with two columns, penetration (m) and force (N).
            file: Option<TableFile> as Maybe<File<Characteristic>> = None,
            /// The SHA-256 that the file must have, 64 hexadecimal digits.
            sha256: Option<String> as Maybe<Sum> = None,
            /// Unloading stiffness of a contact that crushes (N/m): the indentation is permanent except for the elastic part along this
            /// line. At least the largest slope of the law.
            unloading_stiffness: Option<f64> as Maybe<Quantity<measure::Stiffness>> = None,
        },
        /// A function given by the program that reads the scenario.
        Given = "given",
    }
}

table! {
    /// Two elastic bodies in Hertz contact, one after the other in each list.
    pub struct HertzBodies {
        /// Young's moduli (Pa).
        young: [f64; 2] as Pair<Quantity<measure::Pressure>>,
        /// Poisson's ratios.
        poisson: [f64; 2] as Pair<Quantity<measure::Poisson>>,
        /// Radii of curvature at the contact (m), "flat" for a flat face.
        radius: [f64; 2] as Pair<OrEndless<Curvature>>,
    }
}

table! {
    /// A coefficient of restitution at a velocity, from which the dissipation follows.
    pub struct Rebound {
        /// Coefficient of restitution, above 0 and up to 1.
        restitution: f64 as Quantity<measure::Ratio>,
        /// Approach velocity of two free bodies at which it holds (m/s).
        velocity: f64 as Quantity<measure::Velocity>,
    }
}

table! {
    /// Law of a compliant contact.
    pub struct Smooth {
        /// Hunt-Crossley damping factor chi (s/m): the elastic force times 1 + chi times the penetration rate, never
        /// tensile; this or `rebound`.
        dissipation: Option<f64> as Maybe<Quantity<measure::Dissipation>> = None,
        /// Instead of `dissipation`, the coefficient of restitution at a velocity: { restitution = ..., velocity = ... }.
        rebound: Option<Rebound> as Maybe<Braces<Rebound>> = None,
        /// How the contact force is evaluated over a step.
        force: ContactForce as Word<Force> = ContactForce::Conserving,
    }
    with {
        /// Force as a function of the penetration.
        potential: Potential
    }
    not {
        restitution: "`rebound = { restitution = ..., velocity = ... }`: a compliant contact has no coefficient of restitution, \
                      a dissipative law leads to one",
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
    /// Friction and tangential restitution of a rigid (nonsmooth) contact.
    pub struct Sliding {
        /// Coefficient of Coulomb friction.
        friction: f64 as Quantity<measure::Ratio> = 0.0,
        /// Coefficient of restitution along the tangent, from 0 to 1.
        tangential_restitution: f64 as Quantity<measure::Ratio> = 0.0,
        /// Impact law.
        impact_law: ImpactLaw as Word<Impact> = ImpactLaw::Newton,
    }
}

impl Default for Sliding {
    fn default() -> Self {
        Self { friction: 0.0, tangential_restitution: 0.0, impact_law: ImpactLaw::Newton }
    }
}

kinds! {
    /// Contact law.
    pub enum Law by "law" default "linear" {
        /// Rigid (nonsmooth) contact without penetration: impulses and persistent contact.
        Rigid = "rigid" {
            /// Coefficient of restitution, from 0 to 1.
            restitution: f64 as Quantity<measure::Ratio>,
        } with {
            /// Friction and tangential restitution.
            sliding: Sliding
        },
    }
    or {
        /// Compliant contact: a force that grows with the penetration.
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
