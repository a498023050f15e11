//! Free projectiles, obstacles and contacts: what they accept and what is said of the rest.

use crate::common;

use common::{BEAM, TIME, WALL, bad, contact, elastic, faults, free, good, projectile};
use percuss_scenario::content::{PartnerKind, Touch};
use percuss_scenario::{apply_overrides, read};

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
    assert_eq!((strikes.partners, standoff), (vec![], Some(0.0)));
    bad(
        &free("strikes = \"b\""),
        &["13:1: projectile.p.position: found no `position`, expected `position`, its centre at \
           the start, or a target point in `strikes`"],
    );
    bad(
        &free("strikes = \"b.mid\"\nposition = [1, 1]"),
        &["22:12: projectile.p.position: found `position` besides the point b.mid in `strikes`, \
           expected one of the two"],
    );
    bad(
        &free("position = [1, 1]\nstandoff = 1\ndirection = [0, 1]"),
        &[
            "22:12: projectile.p.standoff: found a projectile without a target point, expected a \
             point in `strikes` instead of `position`, or none of this",
            "23:13: projectile.p.direction: found a projectile without a target point, expected a \
             point in `strikes` instead of `position`, or none of this",
        ],
    );
    // A misspelt key is one fault.
    let text = faults(&free("positon = [1, 1]")).to_string();
    assert!(text.lines().count() == 1 && text.contains("did you mean `position`?"), "{text}");
}

#[test]
fn a_line_of_motion_meets_the_beam() {
    let flight = |velocity: &str, more: &str| {
        free(&format!("strikes = \"b.mid\"\n{more}")).replace("[0, -1]", velocity)
    };
    good(&flight("[0, 0]", "direction = [0, 1]"));
    good(&flight("[0, -1]", "direction = [0, -3]"));
    for (velocity, more, expected) in [
        (
            "[0, 0]",
            "",
            "15:12: projectile.p.velocity: found zero velocity, expected a velocity, or `direction` \
             for a projectile at rest",
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
            "21:11: projectile.p.strikes: found a direction of motion along the beam, expected a \
             direction of motion that meets the beam, or `position`",
        ),
        (
            "[0, 1]",
            "standoff = \"-1 mm\"",
            "22:12: projectile.p.standoff: found an initial penetration of 0.001 m, expected a \
             standoff of zero or above",
        ),
    ] {
        bad(&flight(velocity, more), &[expected]);
    }
    // What could not be read has no second fault.
    for velocity in ["[0, \"1 m\"]", "[\"1 kg\", 0]"] {
        let all = faults(&flight(velocity, ""));
        assert_eq!(all.all().len(), 1, "{all}");
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
fn struck_things_have_names() {
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
    let kinds: Vec<PartnerKind> = strikes.partners.iter().map(|partner| partner.kind).collect();
    assert_eq!(kinds, [PartnerKind::Beam, PartnerKind::Obstacle, PartnerKind::Projectile]);
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
             different bodies",
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
        &["13:1: obstacle.b: found no contact, expected a table \
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
    let nothing = "found no contact, expected a table [contact.NAME] with it, or a \
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
fn contacts_are_between_two_things_that_can_touch() {
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
        &[&format!("{at}the projectile \"p\" and itself, expected two different bodies")],
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
