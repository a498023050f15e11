//! Contact laws: what leads to them, and what is said of the rest.

use crate::common;

use common::{BEAM, TIME, bad, contact, elastic, faults, free, good, guided, projectile};
use percuss_scenario::content::{Law, Potential, ProjectileKind, Touch};
use percuss_scenario::{Given, read};

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
    assert_eq!(
        linear.potential,
        Potential::Linear { stiffness: 2000.0, unloading_stiffness: None }
    );
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
    assert_eq!(
        table.potential,
        Potential::Table {
            penetrations,
            forces,
            file: None,
            sha256: None,
            unloading_stiffness: None
        }
    );
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/files/f.toml");
    let text = [BEAM, &elastic("law = \"table\"\nfile = \"crush.csv\""), TIME].concat();
    let written = read(&text, folder).unwrap_or_else(|e| panic!("{e}")).to_toml();
    assert!(written.contains("penetrations = [0, 0.001, 0.005]"), "{written}");
}

#[test]
fn a_program_gives_what_a_file_cannot_hold() {
    let load =
        "[load.push]\nkind = \"point\"\nat = \"b.mid\"\nforce = [0, 1]\nfunction = \"given\"\n";
    let text = [BEAM, &elastic("law = \"given\""), load, TIME].concat();
    let scenario = read(&text, "f.toml").unwrap_or_else(|e| panic!("{e}"));
    assert!(
        scenario.to_toml().contains("law = \"given\"")
            && scenario.to_toml().contains("function = \"given\"")
    );
    let alone = scenario.compile().map(drop).unwrap_err().to_string();
    assert!(alone.contains("projectile.p.law: found \"given\", and no function given"), "{alone}");
    assert!(
        alone.contains("load.push.function: found \"given\", and no function given"),
        "{alone}"
    );
    let given = Given::default()
        .with_potential("projectile.p", percuss::Potential::function(|p| p * p, |p| 2.0 * p))
        .with_function("load.push.function", percuss::TimeFunction::function(f64::sin));
    assert!(scenario.with_given(given).compile().is_ok());
    // What is given later is no fault of a text that has others.
    let bad = text.replace("mass = 1", "mass = \"heavy\"");
    let faults = read(&bad, "f.toml").map(drop).unwrap_err().to_string();
    assert!(faults.contains("heavy") && !faults.contains("given"), "{faults}");
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
fn paths_to_laws_are_checked() {
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
                 \"rigid\", expected `rebound = { restitution = ..., velocity = ... }`: a compliant \
                 contact has no coefficient of restitution, a dissipative law leads to one";
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
        &["22:1: projectile.p.friction: found `friction`, which belongs to kind = \"rigid\", \
           expected one of `mass`, `velocity`, `direction`, `dissipation`, `rebound`, `force`, \
           `stiffness`, `unloading_stiffness`, `strikes`, `standoff`, `position`, `radius`, \
           `inertia`, `spin`, `kind`, `contact`, `law` for kind = \"elastic\""],
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
fn contacts_follow_the_same_laws() {
    let law = |text: &str| good(&contact(text)).contact[0].table.law.clone();
    let Law::Smooth(smooth) = law("stiffness = \"1 kN/m\"") else { panic!("rigid") };
    assert_eq!(
        smooth.potential,
        Potential::Linear { stiffness: 1000.0, unloading_stiffness: None }
    );
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
fn rigid_contacts_want_a_scheme_that_has_impacts() {
    let text = contact("law = \"rigid\"\nrestitution = 0.5")
        + "[integrator]\nscheme = \"newmark\"\n[section.t]\narea = 0\ninertia = 1\n";
    let all = faults(&text).to_string();
    assert!(all.contains("integrator.scheme: found a scheme"), "{all}");
}
