//! Free projectiles, obstacles, and what can touch what.

use std::collections::{BTreeMap, HashMap};

use percuss::{DiscId, Fault, ModelBuilder, ObstacleId, ObstacleShape, TouchLaw};

use super::aim;
use super::beams::Beams;
use super::function::function;
use super::law;
use crate::content::{
    Content, ObstacleKind, Partner, PartnerKind, Projectile, ProjectileKind, Strikes, Touch,
};
use crate::given::Given;
use crate::table::Named;

/// Found and expected.
type Clash = (String, String);

/// Adds free projectiles, obstacles and contacts.
pub(super) fn add(
    content: &Content,
    given: Option<&Given>,
    beams: &Beams<'_>,
    builder: &mut ModelBuilder,
    faults: &mut Vec<Fault>,
) {
    let discs = discs(content, beams, builder, faults);
    let obstacles = obstacles(content, given, beams, builder, faults);
    let partners = Partners { content, beams, discs, obstacles };
    let mut contacts =
        Contacts { given, builder, faults, pairs: HashMap::new(), names: HashMap::new() };
    for Named { name, table } in &content.projectile {
        contacts.of_projectile(name, table, &partners);
    }
    for Named { name, table } in &content.contact {
        let path = format!("contact.{name}");
        let law = law::touch(&path, &table.law, given, contacts.faults);
        let (between, points_per_element) = (table.between.clone(), table.points_per_element);
        let key = "between";
        let wanted =
            Wanted { path: &path, key, name: name.clone(), between, law, points_per_element };
        contacts.add(wanted, &partners);
    }
    untouched(content, faults);
}

/// Adds the free projectiles.
fn discs<'c>(
    content: &'c Content,
    beams: &Beams<'_>,
    builder: &mut ModelBuilder,
    faults: &mut Vec<Fault>,
) -> BTreeMap<&'c str, DiscId> {
    let mut ids = BTreeMap::new();
    for Named { name, table } in &content.projectile {
        let Touch::Surface { strikes, standoff, position, radius, inertia, spin, .. } =
            &table.contact
        else {
            continue;
        };
        let point = strikes.as_ref().and_then(|strikes| strikes.point.as_ref());
        if let Some(point) = point {
            builder.record_point(beams.point(point));
            if matches!(table.kind, ProjectileKind::Elastic { .. }) {
                builder.aim_at(beams.point(point));
            }
        }
        let aimed = point.and_then(|point| beams.surface(point)).and_then(|surface| {
            aim::centre(name, table, [*radius, standoff.unwrap_or(0.0)], surface, faults)
        });
        let disc = percuss::Disc {
            name: name.clone(),
            mass: table.mass,
            inertia: *inertia,
            radius: *radius,
            // One that could not be read is reported already.
            position: position.or(aimed).unwrap_or_default(),
            velocity: table.velocity,
            spin: *spin,
        };
        ids.insert(name.as_str(), builder.disc(disc));
    }
    ids
}

/// Adds the obstacles.
fn obstacles<'c>(
    content: &'c Content,
    given: Option<&Given>,
    beams: &Beams<'_>,
    builder: &mut ModelBuilder,
    faults: &mut Vec<Fault>,
) -> BTreeMap<&'c str, ObstacleId> {
    let mut ids = BTreeMap::new();
    for Named { name, table } in &content.obstacle {
        let shape = match &table.kind {
            ObstacleKind::HalfPlane { point, normal } => {
                ObstacleShape::HalfPlane { point: *point, normal: *normal }
            }
            ObstacleKind::Wall { ends, thickness } => {
                ObstacleShape::Segment { ends: *ends, thickness: *thickness }
            }
            ObstacleKind::Disc { centre, radius } => {
                ObstacleShape::Disc { centre: *centre, radius: *radius }
            }
            ObstacleKind::Clearance { at, width, gap, sides } => {
                let (at, width, gap, sides) = (beams.point(at), *width, *gap, *sides);
                ObstacleShape::Clearance { at, width, gap, sides }
            }
        };
        let motion = table.motion.as_ref().map(|motion| percuss::Motion {
            displacement: motion.displacement,
            rotation: 0.0,
            function: function(
                &format!("obstacle.{name}.motion.function"),
                &motion.function,
                given,
                faults,
            ),
        });
        let obstacle = percuss::Obstacle { name: name.clone(), shape, motion };
        ids.insert(name.as_str(), builder.obstacle(obstacle));
    }
    ids
}

/// An obstacle that nothing can touch.
fn untouched(content: &Content, faults: &mut Vec<Fault>) {
    let between = content.contact.iter().flat_map(|contact| &contact.table.between);
    let struck =
        content.projectile.iter().filter_map(|projectile| match &projectile.table.contact {
            Touch::Surface { strikes, .. } => strikes.as_ref(),
            Touch::Point { .. } => None,
        });
    let touched: Vec<&Partner> =
        between.chain(struck.flat_map(|strikes| &strikes.partners)).collect();
    for Named { name, .. } in &content.obstacle {
        let this =
            |partner: &&Partner| partner.kind == PartnerKind::Obstacle && partner.name == *name;
        if !touched.iter().any(this) {
            let expected = "a table [contact.NAME] with it, or a projectile that strikes it";
            let fault = Fault::new(format!("obstacle.{name}"), "no contact", expected);
            faults.push(fault);
        }
    }
}

/// Everything that can touch, by name.
struct Partners<'c> {
    content: &'c Content,
    beams: &'c Beams<'c>,
    discs: BTreeMap<&'c str, DiscId>,
    obstacles: BTreeMap<&'c str, ObstacleId>,
}

impl Partners<'_> {
    /// A partner; `None` for one that could not be read.
    fn one(&self, partner: &Partner) -> Result<Option<percuss::ContactPartner>, Clash> {
        let name = partner.name.as_str();
        Ok(match partner.kind {
            PartnerKind::Beam => self.beams.known(name).map(percuss::ContactPartner::Beam),
            PartnerKind::Obstacle => {
                self.obstacles.get(name).copied().map(percuss::ContactPartner::Obstacle)
            }
            PartnerKind::Projectile => match self.discs.get(name) {
                None if self.content.projectile.iter().any(|p| p.name == name) => {
                    let found = format!("the projectile {name:?}, which is guided to a point");
                    return Err((found, "a projectile with contact = \"surface\"".into()));
                }
                disc => disc.copied().map(percuss::ContactPartner::Disc),
            },
        })
    }

    /// Two that can touch; `None` where one could not be read.
    fn pair(&self, between: &[Partner; 2]) -> Result<Option<[percuss::ContactPartner; 2]>, Clash> {
        use percuss::ContactPartner::{Disc, Obstacle};
        let (first, second) = (self.one(&between[0])?, self.one(&between[1])?);
        match (first, second) {
            (Some(Obstacle(_)), Some(Obstacle(_))) => {
                Err(("two obstacles".into(), "a beam or a projectile among the two".into()))
            }
            (Some(Disc(a)), Some(Disc(b))) if a == b => {
                let found = format!("the projectile {:?} and itself", between[0].name);
                Err((found, "two different bodies".into()))
            }
            _ => Ok(first.zip(second).map(|(first, second)| [first, second])),
        }
    }

    /// What a free projectile strikes.
    fn struck(&self, strikes: Option<&Strikes>) -> Vec<Partner> {
        let beam = |name: &str| Partner { kind: PartnerKind::Beam, name: name.into() };
        match strikes {
            None => self.content.beam.iter().map(|named| beam(&named.name)).collect(),
            Some(Strikes { point, partners }) => {
                let aimed = point.iter().map(|point| beam(&point.beam));
                aimed.chain(partners.iter().cloned()).collect()
            }
        }
    }
}

/// A contact that a table asks for.
struct Wanted<'a> {
    /// Path of the table.
    path: &'a str,
    /// Its key that names the partners.
    key: &'a str,
    name: String,
    /// Both partners, shape (2).
    between: [Partner; 2],
    law: TouchLaw,
    points_per_element: usize,
}

/// Contacts made, each pair once and each name once.
struct Contacts<'b> {
    given: Option<&'b Given>,
    builder: &'b mut ModelBuilder,
    /// Faults so far, shape (faults).
    faults: &'b mut Vec<Fault>,
    /// Paths of the tables they come from, shape (2).
    pairs: HashMap<[percuss::ContactPartner; 2], String>,
    names: HashMap<String, String>,
}

impl Contacts<'_> {
    /// Those that a free projectile makes: named like it where there is one, else with what is struck behind a dash.
    fn of_projectile(&mut self, name: &str, table: &Projectile, partners: &Partners<'_>) {
        let Touch::Surface { strikes, sliding, .. } = &table.contact else { return };
        let path = format!("projectile.{name}");
        let law = match &table.kind {
            ProjectileKind::Elastic { law } => {
                TouchLaw::Smooth(law::smooth(&path, law, self.given, self.faults))
            }
            ProjectileKind::Rigid { restitution } => {
                let sliding = sliding.clone().unwrap_or_default();
                TouchLaw::Rigid(law::rigid(*restitution, &sliding))
            }
        };
        let own = Partner { kind: PartnerKind::Projectile, name: name.into() };
        let struck = partners.struck(strikes.as_ref());
        let alone = struck.len() == 1;
        for partner in struck {
            let wanted = Wanted {
                path: &path,
                key: "strikes",
                name: if alone { name.into() } else { format!("{name}-{}", partner.name) },
                between: [own.clone(), partner],
                law: law.clone(),
                points_per_element: percuss::Contact::POINTS_PER_ELEMENT,
            };
            self.add(wanted, partners);
        }
    }

    /// Adds a contact, or a fault; nothing where a partner could not be read.
    fn add(&mut self, wanted: Wanted<'_>, partners: &Partners<'_>) {
        let Wanted { path, key, name, between, law, points_per_element } = wanted;
        let [first, second] = &between;
        let [a, b] = match partners.pair(&between) {
            Ok(Some(pair)) => pair,
            Ok(None) => return,
            Err((found, expected)) => {
                self.faults.push(Fault::new(format!("{path}.{key}"), found, expected));
                return;
            }
        };
        if let Some(table) = self.pairs.get(&[a, b]).or_else(|| self.pairs.get(&[b, a])) {
            let touch = format!("{} and {}, which touch by [{table}]", first.name, second.name);
            let found = format!("{touch} already");
            self.faults.push(Fault::new(format!("{path}.{key}"), found, "each pair once"));
        } else if let Some(table) = self.names.get(&name) {
            let found = format!("`{name}`, the name of a contact that [{table}] makes");
            self.faults.push(Fault::new(path, found, "another name"));
        } else {
            self.pairs.insert([a, b], path.into());
            self.names.insert(name.clone(), path.into());
            self.builder.contact(percuss::Contact {
                name,
                between: [a, b],
                law,
                points_per_element,
            });
        }
    }
}
