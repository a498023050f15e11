//! What a scenario file contains, table by table, in SI units and with every default filled in.
//!
//! The doc comment of a key is also its description in the JSON Schema.

mod allow;
mod analysis;
mod contact;
mod foundation;
mod function;
mod initial;
mod law;
mod load;
mod projectile;
mod section;
mod structure;
mod support;
mod yielding;

pub use allow::Allowed;
pub use analysis::*;
pub use contact::*;
pub use foundation::*;
pub use function::*;
pub use initial::*;
pub use law::*;
pub use load::*;
pub use projectile::*;
pub use section::*;
pub use structure::*;
pub use support::*;
pub use yielding::*;

pub use crate::partner::{Partner, PartnerKind, Strikes};
pub use crate::point::Anchor;
pub use crate::preset::Preset;
pub use crate::profile::SteelProfile;

use percuss_codes::Code;

use crate::format::Text;
use crate::node::{Body, Reader};
use crate::table::{Collection, Named, Single};
use crate::write::Writer;
use allow::Allowances;

table! {
    /// A structure of beams with supports, loads and projectiles.
    pub struct Content {
        /// One line about the scenario.
        title: String as Text = String::new(),
        /// Materials, by name.
        material: Vec<Named<Material>> as Collection<Material> = Vec::new(),
        /// Cross sections, by name.
        section: Vec<Named<Section>> as Collection<Section> = Vec::new(),
        /// Beams, by name.
        beam: Vec<Named<Beam>> as Collection<Beam> = Vec::new(),
        /// Supports, by name.
        support: Vec<Named<Support>> as Collection<Support> = Vec::new(),
        /// Joints between beams, by name.
        joint: Vec<Named<Joint>> as Collection<Joint> = Vec::new(),
        /// Springs and dampers between two points, by name.
        spring: Vec<Named<Spring>> as Collection<Spring> = Vec::new(),
        /// Foundations along beams, by name.
        foundation: Vec<Named<Foundation>> as Collection<Foundation> = Vec::new(),
        /// Masses at points of beams, by name.
        mass: Vec<Named<PointMass>> as Collection<PointMass> = Vec::new(),
        /// Projectiles, by name.
        projectile: Vec<Named<Projectile>> as Collection<Projectile> = Vec::new(),
        /// Obstacles, by name.
        obstacle: Vec<Named<Obstacle>> as Collection<Obstacle> = Vec::new(),
        /// Contacts between beams, obstacles and free projectiles, by name.
        contact: Vec<Named<Contact>> as Collection<Contact> = Vec::new(),
        /// Loads, by name.
        load: Vec<Named<Load>> as Collection<Load> = Vec::new(),
        /// Initial rigid motion of all beams and point masses, and of single ones, by name.
        initial: Initial as Starts = Initial::default(),
        /// Damping of the structure as a whole.
        damping: Damping as Single<Damping> = Damping::default(),
        /// Duration and time step of the analysis.
        time: Time as Single<Time>,
        /// Time integration.
        integrator: Integrator as Single<Integrator> = Integrator::default(),
        /// What is recorded.
        record: Record as Single<Record> = Record::default(),
        /// End of the static equilibrium path.
        path: Path as Single<Path> = Path::default(),
        /// What the report shows.
        report: Report as Single<Report> = Report::plain(),
        /// Warnings that are accepted in this scenario: codes, each with the reason.
        allow: Vec<Allowed> as Allowances = Vec::new(),
    }
    then anything_moves
}

/// A scene needs a beam or a free projectile.
fn anything_moves(content: &mut Content, body: &Body<'_>, reader: &mut Reader<'_>) {
    let given = |key: &str| {
        let table = body.get(key);
        table.is_some_and(|node| Body::of(&node).is_none_or(|table| !table.keys().is_empty()))
    };
    let read = !content.beam.is_empty() || !content.projectile.is_empty();
    if !read && !given("beam") && !given("projectile") {
        let expected = "at least one table [beam.NAME], or free projectiles [projectile.NAME] and their contacts";
        reader.missing(body, "beam", "no beam", expected);
    }
}

impl Content {
    /// Why what has a code is allowed, if it is.
    pub fn reason_to_allow(&self, code: Code) -> Option<&str> {
        self.allow.iter().find(|one| one.code == code).map(|one| one.reason.as_str())
    }

    /// What is allowed, each with its reason.
    pub fn allowances(&self) -> Vec<(Code, &str)> {
        self.allow.iter().map(|one| (one.code, one.reason.as_str())).collect()
    }
}
