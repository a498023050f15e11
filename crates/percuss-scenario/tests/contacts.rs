//! Laws, free projectiles, obstacles and contacts: what they accept and what they say of the rest.

use percuss_scenario::content::{Law, PartyKind, Potential, ProjectileKind, Touch};
use percuss_scenario::{Content, Diagnostics, apply_overrides, read};

/// Twelve lines: a beam of 3 m.
const BEAM: &str = "[material.m]\nyoung = 1e9\ndensity = 1e3\n[section.s]\narea = 1\ninertia = 1\n\
                    [beam.b]\npoints = [[0, 0], [3, 0]]\nelements = 6\nmaterial = \"m\"\n\
                    section = \"s\"\n\n";
const TIME: &str = "[time]\nend = 1\nstep = 0.1\n";
/// Four lines, on which `wall` stands.
const WALL: &str = "[obstacle.wall]\nkind = \"wall\"\nends = [[0, 1], [3, 1]]\n\n";

#[track_caller]
fn good(text: &str) -> Content {
    let scenario = read(&[BEAM, text, TIME].concat(), "f.toml").unwrap_or_else(|e| panic!("{e}"));
    let again = read(&scenario.to_toml(), "again").unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(again.content(), scenario.content());
    scenario.compile().unwrap_or_else(|e| panic!("{e}"));
    scenario.content().clone()
}

fn faults(text: &str) -> Diagnostics {
    let all = read(&[BEAM, text, TIME].concat(), "f.toml").and_then(|s| s.compile());
    all.map(|_| panic!("no fault in\n{text}")).unwrap_err()
}

/// All faults of what follows the twelve lines.
#[track_caller]
fn bad(text: &str, expected: &[&str]) {
    let all = faults(text).to_string();
    let lines: Vec<&str> = all.lines().map(|l| l.trim_start_matches("f.toml:")).collect();
    assert_eq!(lines, expected);
}

/// Five lines, 13 to 17, and what is given.
fn projectile(text: &str) -> String {
    format!("[projectile.p]\nmass = 1\nvelocity = [0, -1]\n\n\n{text}\n")
}

fn guided(text: &str) -> String {
    projectile(&format!("strikes = \"b.mid\"\n{text}"))
}

fn elastic(text: &str) -> String {
    guided(&format!("kind = \"elastic\"\n{text}"))
}

fn free(text: &str) -> String {
    projectile(&format!("contact = \"surface\"\nkind = \"rigid\"\nrestitution = 0.5\n{text}"))
}

/// Eight lines with the wall, 17 to 18 for the header, and what is given from line 19 on.
fn contact(text: &str) -> String {
    format!("{WALL}[contact.c]\nbetween = [\"b\", \"wall\"]\n{text}\n")
}

#[test]
fn elastic_projectiles_follow_a_law() {
    let law = |text: &str| {
        let content = good(&elastic(text));
        match &content.projectile[0].table.kind {
            ProjectileKind::Elastic { law } => law.clone(),
            ProjectileKind::Rigid { .. } => panic!("rigid"),
        }
    };
    let linear = law("stiffness = \"2 kN/m\"");
    assert_eq!(linear.potential, Potential::Linear { stiffness: 2000.0 });
    assert_eq!((linear.dissipation, linear.rebound), (Some(0.0), None));
    let hertz = law("law = \"hertz\"\nhertz_stiffness = \"1 N/mm^1.5\"\ndissipation = 0.5");
    let Potential::Hertz { hertz_stiffness: Some(stiffness), hertz: None } = hertz.potential else {
        panic!("{hertz:?}")
    };
    assert!((stiffness / 10f64.powf(4.5) - 1.0).abs() < 1e-14);
    assert_eq!(hertz.dissipation, Some(0.5));
    let rebound = law("stiffness = 1\nrebound = { restitution = 0.5, velocity = \"1 m/s\" }");
    assert_eq!(rebound.dissipation, None);
    let table = law("law = \"table\"\npenetrations = [0, \"1 mm\"]\nforces = [0, \"1 kN\"]");
    let lists = [vec![0.0, 0.001], vec![0.0, 1000.0]].map(Some);
    let [penetrations, forces] = lists;
    assert_eq!(table.potential, Potential::Table { penetrations, forces, file: None });
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/files/f.toml");
    let text = [BEAM, &elastic("law = \"table\"\nfile = \"crush.csv\""), TIME].concat();
    let written = read(&text, folder).unwrap_or_else(|e| panic!("{e}")).to_toml();
    assert!(written.contains("penetrations = [0, 0.001, 0.005]"), "{written}");
}

#[test]
fn two_sources_of_a_value_exclude_each_other() {
    bad(
        &elastic("stiffness = 1\ndissipation = 1\nrebound = { restitution = 0.5, velocity = 1 }"),
        &[
            "22:11: projectile.p.rebound: found `rebound` besides `dissipation`, expected one of the \
           two",
        ],
    );
    bad(
        &elastic(
            "law = \"hertz\"\nhertz_stiffness = 1\n\
             hertz = { young = [1, 1], poisson = [0, 0], radius = [1, \"flat\"] }",
        ),
        &[
            "22:9: projectile.p.hertz: found `hertz` besides `hertz_stiffness`, expected one of the \
           two",
        ],
    );
    bad(
        &elastic("law = \"hertz\""),
        &["13:1: projectile.p.hertz_stiffness: found no stiffness, expected `hertz_stiffness`, \
           such as \"5e8 N/m^1.5\", or `hertz`, the two bodies"],
    );
    bad(
        &elastic("law = \"table\"\nforces = [0, 1]"),
        &["13:1: projectile.p.penetrations: found no `penetrations`, expected `penetrations` and \
           `forces`, or `file`"],
    );
    let text = faults(&elastic("law = \"table\"\nforces = [0, 1]\nfile = \"none.csv\""));
    let text = text.to_string();
    assert!(text.contains("found `forces` besides `file`"), "{text}");
    assert!(text.contains("two columns, penetration (m) and force (N)"), "{text}");
}

#[test]
fn what_leads_to_a_law_is_checked() {
    bad(
        &elastic("stiffness = 1\nrebound = { restitution = 0, velocity = \"-1 m/s\" }"),
        &[
            "21:27: projectile.p.rebound.restitution: found 0, expected a coefficient above 0, up \
             to 1",
            "21:41: projectile.p.rebound.velocity: found -1 m/s, expected a velocity above zero",
        ],
    );
    bad(
        &elastic(
            "law = \"hertz\"\nhertz = { young = [1, 0], poisson = [0.6, 0], radius = [1, -1] }",
        ),
        &[
            "21:19: projectile.p.hertz.young: found 0 Pa, expected Young's moduli above zero",
            "21:37: projectile.p.hertz.poisson: found 0.6, expected Poisson's ratios above -1, up \
             to 0.5",
            "21:56: projectile.p.hertz.radius: found -1 m, expected radii above zero, or \"flat\"",
        ],
    );
    let flat = "hertz = { young = [1, 1], poisson = [0, 0], radius = [\"flat\", \"flat\"] }";
    bad(
        &elastic(&format!("law = \"hertz\"\n{flat}")),
        &["21:54: projectile.p.hertz.radius: found two flat faces, expected at least one that is \
           curved"],
    );
    bad(
        &elastic("law = \"hertz\"\nhertz_stiffness = \"1 N/m\"\nforce = \"plain\""),
        &[
            "21:19: projectile.p.hertz_stiffness: found \"1 N/m\", which is a stiffness (N/m), \
             expected a Hertz stiffness (N/m^1.5), such as \"5e8 N/m^1.5\"",
            "22:9: projectile.p.force: found the text \"plain\", expected one of `conserving`, \
             `plain-gradient`, `midpoint`",
        ],
    );
}

#[test]
fn an_elastic_projectile_has_no_restitution_of_its_own() {
    let place = "20:1: projectile.p.restitution: found `restitution`, which belongs to kind = \
                 \"rigid\", expected `rebound = { restitution = ..., velocity = ... }`: an elastic \
                 projectile or contact has no coefficient of restitution, a dissipative law leads \
                 to one";
    bad(&elastic("restitution = 0.5\nstiffness = 1"), &[place]);
    let text = faults(&contact("stiffness = 1\nrestitution = 0.5")).to_string();
    assert!(text.contains("which belongs to law = \"rigid\", expected `rebound = {"), "{text}");
}

#[test]
fn keys_of_another_kind_law_or_contact_say_so() {
    for (text, key, of) in [
        (elastic("stiffness = 1\nradius = 1"), "radius", "contact = \"surface\""),
        (elastic("stiffness = 1\nposition = [1, 1]"), "position", "contact = \"surface\""),
        (
            guided("kind = \"rigid\"\nrestitution = 1\nfriction = 1"),
            "friction",
            "contact = \"surface\"",
        ),
        (
            guided("kind = \"rigid\"\nrestitution = 1\nlaw = \"linear\""),
            "law",
            "kind = \"elastic\"",
        ),
        (guided("kind = \"rigid\"\nrestitution = 1\nrebound = 1"), "rebound", "kind = \"elastic\""),
        (
            elastic("law = \"hertz\"\nhertz_stiffness = 1\nstiffness = 1"),
            "stiffness",
            "law = \"linear\"",
        ),
        (elastic("stiffness = 1\nforces = [0, 1]"), "forces", "law = \"table\""),
        (free("position = [0, 1]\nlocal_mass = 1"), "local_mass", "contact = \"point\""),
        (free("position = [0, 1]\nrear = { mass = 1 }"), "rear", "contact = \"point\""),
        (contact("stiffness = 1\nfriction = 1"), "friction", "law = \"rigid\""),
        (
            contact("law = \"rigid\"\nrestitution = 1\nstiffness = 1"),
            "stiffness",
            "law = \"linear\"",
        ),
    ] {
        let all = faults(&text);
        assert_eq!(all.all().len(), 1, "{all}");
        let found = &all.all()[0].message;
        assert_eq!(*found, format!("`{key}`, which belongs to {of}"));
    }
    bad(
        &projectile(
            "contact = \"surface\"\nkind = \"elastic\"\nstiffness = 1\nposition = [0, 1]\n\
             friction = 0.1",
        ),
        &["22:12: projectile.p.friction: found `friction`, which belongs to kind = \"rigid\", \
           expected no `friction` for kind = \"elastic\""],
    );
}

#[test]
fn a_guided_projectile_may_have_a_second_mass() {
    let content = good(&elastic("stiffness = 1\nrear = { mass = 2, stiffness = 3 }"));
    let Touch::Point { rear: Some(rear), local_mass, .. } = &content.projectile[0].table.contact
    else {
        panic!("no rear mass")
    };
    assert_eq!((rear.mass, rear.stiffness, rear.damping, *local_mass), (2.0, 3.0, 0.0, 0.0));
    bad(
        &elastic("stiffness = 1\nlocal_mass = \"1 N\"\nrear = { mass = 2, spring = 3 }"),
        &[
            "21:14: projectile.p.local_mass: found \"1 N\", which is a force (N), expected a mass \
             (kg), such as \"500 kg\"",
            "22:8: projectile.p.rear.stiffness: found no `stiffness`, expected a stiffness (N/m), \
             such as \"7.5e5 N/m\"",
            "22:20: projectile.p.rear.spring: found the unknown key `spring`, expected one of \
             `mass`, `stiffness`, `damping`",
        ],
    );
}

#[test]
fn a_free_projectile_begins_at_a_place_or_flies_at_a_point() {
    let at = |text: &str| good(&free(text)).projectile[0].table.contact.clone();
    let Touch::Surface { strikes: None, standoff: None, sliding: Some(sliding), spin, .. } =
        at("position = [1, \"50 cm\"]")
    else {
        panic!("not at a place")
    };
    assert_eq!((sliding.friction, sliding.tangential_restitution, spin), (0.0, 0.0, 0.0));
    let Touch::Surface { strikes: Some(strikes), standoff, position: None, .. } =
        at("strikes = \" b @ 1 m \"")
    else {
        panic!("not at a point")
    };
    assert_eq!(strikes.point.map(|p| p.label).as_deref(), Some("b@1m"));
    assert_eq!((strikes.parties, standoff), (vec![], Some(0.0)));
    bad(
        &free("strikes = \"b\""),
        &["13:1: projectile.p.position: found no `position`, expected `position`, its centre at \
           the start, or a point in `strikes` that it flies at"],
    );
    bad(
        &free("strikes = \"b.mid\"\nposition = [1, 1]"),
        &["22:12: projectile.p.position: found `position` besides the point b.mid in `strikes`, \
           expected one of the two"],
    );
    bad(
        &free("position = [1, 1]\nstandoff = 1\ndirection = [0, 1]"),
        &[
            "22:12: projectile.p.standoff: found a projectile that flies at no point, expected a \
             point in `strikes` instead of `position`, or none of this",
            "23:13: projectile.p.direction: found a projectile that flies at no point, expected a \
             point in `strikes` instead of `position`, or none of this",
        ],
    );
    // A misspelt key is one fault.
    let text = faults(&free("positon = [1, 1]")).to_string();
    assert!(text.lines().count() == 1 && text.contains("did you mean `position`?"), "{text}");
}

#[test]
fn a_line_of_flight_meets_the_beam() {
    let flight = |velocity: &str, more: &str| {
        free(&format!("strikes = \"b.mid\"\n{more}")).replace("[0, -1]", velocity)
    };
    good(&flight("[0, 0]", "direction = [0, 1]"));
    good(&flight("[0, -1]", "direction = [0, -3]"));
    for (velocity, more, expected) in [
        (
            "[0, 0]",
            "",
            "15:12: projectile.p.velocity: found no line of flight: zero velocity, expected a \
             velocity, or for a projectile at rest `direction`, its line of flight",
        ),
        (
            "[0, 1]",
            "direction = [1, 1]",
            "22:13: projectile.p.direction: found [1, 1], not along the velocity, expected no \
             direction, or that of the velocity",
        ),
        (
            "[2, 0]",
            "",
            "21:11: projectile.p.strikes: found a line of flight along the beam, expected a line \
             of flight that meets its face, or `position`",
        ),
        (
            "[0, 1]",
            "standoff = \"-1 mm\"",
            "22:12: projectile.p.standoff: found a projectile that starts 0.001 m inside the \
             beam, expected a standoff of zero or above",
        ),
    ] {
        bad(&flight(velocity, more), &[expected]);
    }
    bad(
        &free("strikes = \"b@4m\""),
        &[
            "21:11: projectile.p.strikes: found b@4m (4 m along the beam), expected a point of `b`, \
           from 0 to 3 m",
        ],
    );
}

#[test]
fn what_is_struck_has_a_name() {
    let second = projectile("contact = \"surface\"\nkind = \"elastic\"\nstiffness = 1")
        .replace("projectile.p", "projectile.q");
    let with = |strikes: &str| {
        [&free(&format!("position = [0, 1]\nstrikes = {strikes}")), WALL, &second].concat()
            + "position = [0, 2]\n"
    };
    let content = good(&with("[\"b\", \"wall\", \"q\"]"));
    let Touch::Surface { strikes: Some(strikes), .. } = &content.projectile[0].table.contact else {
        panic!("nothing struck")
    };
    let kinds: Vec<PartyKind> = strikes.parties.iter().map(|party| party.kind).collect();
    assert_eq!(kinds, [PartyKind::Beam, PartyKind::Obstacle, PartyKind::Projectile]);
    let wall = |strikes: &str| with(strikes).replace(WALL, "");
    for (strikes, expected) in [
        (
            "[\"b\", \"bb\"]",
            "22:17: projectile.p.strikes: found the unknown beam, obstacle or projectile \"bb\", \
             expected one of `b`, `p`, `q` (did you mean `b`?)",
        ),
        (
            "[\"b\", \"b.mid\"]",
            "22:17: projectile.p.strikes: found the text \"b.mid\", expected the point first, \
             names after it",
        ),
        (
            "[]",
            "22:11: projectile.p.strikes: found an empty list, expected a point on a beam, a name, \
             or a list of names of beams, obstacles and projectiles that may begin with a point",
        ),
        (
            "{}",
            "22:11: projectile.p.strikes: found a table, expected a point on a beam, a name, or a \
             list of names of beams, obstacles and projectiles that may begin with a point",
        ),
        (
            "\"p\"",
            "22:11: projectile.p.strikes: found the projectile \"p\" and itself, expected two \
             different things",
        ),
        (
            "[\"b\", \"b\"]",
            "22:11: projectile.p.strikes: found p and b, which touch by [projectile.p] already, \
             expected each pair once",
        ),
    ] {
        bad(&wall(strikes), &[expected]);
    }
}

#[test]
fn a_guided_projectile_touches_nothing_but_its_point() {
    let guided = elastic("stiffness = 1").replace("projectile.p", "projectile.q");
    let free = free("position = [0, 1]\nstrikes = [\"b\", \"q\"]");
    bad(
        &[free, guided].concat(),
        &["22:11: projectile.p.strikes: found the projectile \"q\", which is guided to a point, \
           expected a projectile with contact = \"surface\""],
    );
}

#[test]
fn a_name_that_two_things_share_stands_for_neither() {
    let text = contact("stiffness = 1").replace("wall]", "b]").replace("wall\"]", "b\"]");
    bad(
        &text,
        &[
            "18:12: contact.c.between: found \"b\", the name of [beam.b] and [obstacle.b], \
             expected a name that no two of them share",
            "18:17: contact.c.between: found \"b\", the name of [beam.b] and [obstacle.b], \
             expected a name that no two of them share",
        ],
    );
    // Every beam is meant where nothing is said, whatever else has its name.
    let text = WALL.replace("wall]", "b]") + &free("position = [0, 2]");
    bad(
        &text,
        &["13:1: obstacle.b: found nothing that touches it, expected a table \
                  [contact.NAME] with it, or a projectile that strikes it"],
    );
}

#[test]
fn obstacles_come_in_kinds_and_move() {
    let floor = "kind = \"half-plane\"\npoint = [0, -1]\nnormal = [0, 1]";
    for kind in [
        floor,
        "kind = \"wall\"\nends = [[0, \"1 m\"], [1, 1]]\nthickness = \"1 cm\"",
        "kind = \"disc\"\ncentre = [0, -2]\nradius = 1",
        "kind = \"clearance\"\nat = \"b.mid\"\nwidth = \"2 cm\"\ngap = \"1 mm\"\nsides = \"right\"",
        &format!("{floor}\nmotion = {{ displacement = [0, 1] }}"),
    ] {
        good(&format!(
            "[obstacle.o]\n{kind}\n[contact.c]\nbetween = [\"o\", \"b\"]\nstiffness = 1\n"
        ));
    }
    let o = |text: &str| {
        format!("[obstacle.o]\n{text}\n[contact.c]\nbetween = [\"b\", \"o\"]\nstiffness = 1\n")
    };
    bad(
        &o(&format!("{floor}\nmotion = {{ rotation = \"1 deg\", displacement = [0, 1] }}")),
        &["17:12: obstacle.o.motion.rotation: found the unknown key `rotation`, expected a \
           `displacement`: an obstacle does not turn"],
    );
    bad(
        &o("kind = \"clearance\"\nat = \"c.mid\"\nwidth = \"2 kg\"\ngap = 1\nsides = \"top\""),
        &[
            "15:6: obstacle.o.at: found the unknown beam \"c\", expected `b`",
            "16:9: obstacle.o.width: found \"2 kg\", which is a mass (kg), expected a length (m), \
             such as \"3 m\"",
            "18:9: obstacle.o.sides: found the text \"top\", expected one of `both`, `left`, \
             `right`",
        ],
    );
    bad(
        &o("kind = \"wall\"\nends = [[0, 1], [1]]"),
        &["15:17: obstacle.o.ends: found a list of 1 entry, expected two components, each a \
           length (m), such as [0, \"3 m\"]"],
    );
    let text = faults(&o("kind = \"halfplane\"")).to_string();
    assert!(text.contains("(did you mean `half-plane`?)") && text.lines().count() == 1, "{text}");
}

#[test]
fn an_obstacle_that_nothing_touches_is_a_fault() {
    let nothing = "found nothing that touches it, expected a table [contact.NAME] with it, or a \
                   projectile that strikes it";
    bad(WALL, &[&format!("13:1: obstacle.wall: {nothing}")]);
    // Unless what touches it could not be read.
    for contact in [
        "[contact.c]\nbetween = [\"wall\", \"bb\"]\nstiffness = 1\n",
        "[contact.c]\nbetween = [\"wall\", \"b\"]\nlaw = \"hard\"\n",
        &projectile("kind = \"ball\"\nstrikes = \"b.mid\""),
    ] {
        let all = faults(&[WALL, contact].concat());
        assert_eq!(all.all().len(), 1, "{all}");
    }
}

#[test]
fn contacts_follow_the_same_laws() {
    let law = |text: &str| good(&contact(text)).contact[0].table.law.clone();
    let Law::Smooth(smooth) = law("stiffness = \"1 kN/m\"") else { panic!("rigid") };
    assert_eq!(smooth.potential, Potential::Linear { stiffness: 1000.0 });
    let Law::Rigid { restitution, sliding } =
        law("law = \"rigid\"\nrestitution = 0.5\nfriction = 1")
    else {
        panic!("smooth")
    };
    assert_eq!((restitution, sliding.friction, sliding.tangential_restitution), (0.5, 1.0, 0.0));
    law("law = \"table\"\npenetrations = [0, 1]\nforces = [0, 1]\ndissipation = 1");
    law("law = \"hertz\"\nhertz_stiffness = 1\nrebound = { restitution = 1, velocity = 1 }");
    bad(
        &contact("law = \"rigid\""),
        &["17:1: contact.c.restitution: found no `restitution`, expected a number, such as 0.8"],
    );
    let text = faults(&contact("law = \"soft\"")).to_string();
    assert!(text.contains("expected one of `rigid`, `linear`, `hertz`, `table`"), "{text}");
}

#[test]
fn what_touches_is_two_things_that_can() {
    let between = |between: &str| {
        let text = contact("stiffness = 1").replace("[\"b\", \"wall\"]", between);
        text + "[contact.d]\nbetween = [\"b\", \"wall\"]\nstiffness = 1\n"
    };
    good(&between("[\"b\", \"b\"]"));
    let at = "18:11: contact.c.between: found ";
    bad(
        &between("[\"wall\", \"wall\"]"),
        &[&format!("{at}two obstacles, expected a beam or a projectile among the two")],
    );
    bad(
        &between("[\"b\"]"),
        &[&format!(
            "{at}a list of 1 entry, expected a list of two, each the name of a beam, an obstacle \
             or a projectile"
        )],
    );
    bad(
        &(between("[\"b\", \"p\"]") + &elastic("stiffness = 1")),
        &[&format!(
            "{at}the projectile \"p\", which is guided to a point, expected a projectile with \
             contact = \"surface\""
        )],
    );
    bad(
        &(between("[\"p\", \"p\"]") + &free("position = [0, 2]")),
        &[&format!("{at}the projectile \"p\" and itself, expected two different things")],
    );
    bad(
        &between("[\"wall\", \"b\"]"),
        &["21:11: contact.d.between: found b and wall, which touch by [contact.c] already, \
           expected each pair once"],
    );
}

#[test]
fn contacts_of_projectiles_have_names_of_their_own() {
    let ball = free("position = [0, 2]").replace("projectile.p", "projectile.c");
    bad(
        &(ball + &contact("stiffness = 1")),
        &["26:1: contact.c: found `c`, the name of a contact that [projectile.c] makes, expected \
           another name"],
    );
    let ball = free("position = [0, 2]");
    bad(
        &(ball + &contact("stiffness = 1").replace("wall\"]", "p\"]").replace(WALL, "")),
        &["23:11: contact.c.between: found b and p, which touch by [projectile.p] already, \
           expected each pair once"],
    );
}

#[test]
fn rigid_contacts_want_a_scheme_that_has_impacts() {
    let text = contact("law = \"rigid\"\nrestitution = 0.5")
        + "[integrator]\nscheme = \"newmark\"\n[section.t]\narea = 0\ninertia = 1\n";
    let all = faults(&text).to_string();
    assert!(all.contains("integrator.scheme: found a scheme"), "{all}");
}

#[test]
fn new_keys_can_be_set() {
    let text = [
        BEAM,
        WALL,
        &free("strikes = [\"b.mid\", \"wall\"]"),
        "[contact.c]\nbetween = [\"b\", \"wall\"]\nstiffness = 1\n",
        TIME,
    ]
    .concat();
    let all = [
        "projectile.p.strikes=b@0.25",
        "projectile.p.radius=5 cm",
        "projectile.p.friction=0.3",
        "obstacle.wall.thickness=1 cm",
        "obstacle.wall.motion.displacement=[0, 0.1]",
        "contact.c.law=hertz",
        "contact.c.hertz.young=[1, 1]",
        "contact.c.hertz.poisson=[0, 0]",
        "contact.c.hertz.radius=[1, \"flat\"]",
        "contact.c.rebound.velocity=2 m/s",
        "contact.c.rebound.restitution=0.5",
        "contact.c.points_per_element=4",
    ];
    let all: Vec<String> = all.iter().map(|one| one.to_string()).collect();
    let text = apply_overrides(&text, "f.toml", &all).unwrap_or_else(|e| panic!("{e}"));
    let text = text.replace("stiffness = 1\n", "");
    let scenario = read(&text, "f.toml").unwrap_or_else(|e| panic!("{text}\n{e}"));
    scenario.compile().unwrap_or_else(|e| panic!("{e}"));
    let contact = &scenario.content().contact[0].table;
    assert_eq!(contact.points_per_element, 4);
    for (path, near) in [
        ("projectile.p.frction=1", "`friction`"),
        ("contact.c.hertz.yong=1", "`young`"),
        ("obstacle.wall.motion.displacment=1", "`displacement`"),
    ] {
        let fault = apply_overrides(&text, "f.toml", &[path.into()]).unwrap_err().to_string();
        assert!(fault.contains(&format!("did you mean {near}?")), "{fault}");
    }
}
