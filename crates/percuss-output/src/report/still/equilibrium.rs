//! The page of a static equilibrium.

use percuss::scene::Scene;
use percuss::{
    BucklingOutcome, Equilibrium, FollowerStability, LinearBuckling, Model, SectionRange,
    StaticContact, StaticYielding,
};
use serde_json::json;

use super::{Page, swinging};
use crate::fields::{Fields, Places, scene_value};
use crate::report::foundations::{AT_REST, rows_at_rest};
use crate::report::html::{sentences, table};
use crate::report::quantity::{number, quantity, without_round_off};
use crate::report::scene;
use crate::round_off::{NO_DISTANCE, NO_GAP, SectionScales, StaticScales, is_round_off};

/// An equilibrium and what it belongs to.
#[derive(Clone, Copy, Debug)]
pub struct EquilibriumInfo<'a> {
    /// The scenario's title.
    pub title: &'a str,
    /// Parts of the model as drawn.
    pub scene: &'a Scene,
    /// The equilibrium.
    pub found: &'a Equilibrium,
    /// Its linear buckling.
    pub linear: &'a LinearBuckling,
    /// The model it is of.
    pub model: &'a Model,
}

/// The page of an equilibrium.
pub(crate) fn render(info: &EquilibriumInfo<'_>) -> String {
    let places = Places::of(info.scene);
    let mut frames = vec![places.still(&info.found.frame())];
    let mut panels = Vec::new();
    if let Some(mode) = info.linear.modes.first() {
        panels.push(swinging(&buckling_title(mode.factor), frames.len(), None));
        frames.push(places.shape(&mode.shape));
    }
    let found = info.found;
    let page = Page {
        title: if info.title.is_empty() { "Static equilibrium" } else { info.title },
        status: "Static equilibrium under the loads at time zero; moving projectiles are ignored.".to_owned(),
        alarming: false,
        scene: scene::section(&sentences(&story(info)), None),
        fields: Fields { scene: scene_value(info.scene), frames },
        details: json!({ "kind": "static", "panels": panels }),
        tables: tables(found),
        fallback: "<p class=\"warning\">The drawing needs JavaScript; the numbers are in static.json in the same directory.</p>".to_owned(),
    };
    page.render()
}

pub(super) fn buckling_title(factor: f64) -> String {
    format!("linear buckling mode, load factor {}", number(factor))
}

/// What the equilibrium is, in a few sentences.
fn story(info: &EquilibriumInfo<'_>) -> String {
    let EquilibriumInfo { found, linear, .. } = info;
    let mut out = vec![match found.stable {
        true => "Stable equilibrium.".to_owned(),
        false => "Unstable equilibrium.".to_owned(),
    }];
    let scale = StaticScales::of(found).moved;
    let most = found.largest_displacement.as_ref();
    if let Some(most) = most.filter(|most| !is_round_off(most.size(), scale)) {
        let (moved, s) = (quantity(Some(most.size()), "m"), quantity(Some(most.s), "m"));
        let beam = &most.beam;
        out.push(format!("Largest displacement: {moved}, in '{beam}' at s\u{a0}=\u{a0}{s}."));
    }
    out.extend(largest_section(found, |b| &b.moment, "bending moment", "N*m"));
    out.extend(largest_section(found, |b| &b.stress, "fibre stress", "Pa"));
    let press: Vec<&StaticContact> = found.contacts.iter().filter(|c| c.force > 0.0).collect();
    match press.as_slice() {
        [] => {}
        [one] => {
            out.push(format!("Contact '{}': force {}.", one.name, quantity(Some(one.force), "N")))
        }
        many => {
            let force = many.iter().map(|c| c.force).fold(0.0, f64::max);
            out.push(format!(
                "{} closed contacts, largest force {}.",
                many.len(),
                quantity(Some(force), "N")
            ));
        }
    }
    if let Some(mode) = linear.modes.first() {
        out.push(format!("Linear buckling factor: {}.", number(mode.factor)));
        out.extend(linear.assumptions().iter().map(|line| sentence(line)));
    } else if let Some(reason) =
        linear.outcome.reason().filter(|_| linear.outcome != BucklingOutcome::Unloaded)
    {
        out.push(format!("There is {reason}."));
    }
    match linear.stability {
        Some(FollowerStability::Flutter { factor, frequency }) => out.push(format!(
            "Flutter above load factor {}, {}.",
            number(factor),
            quantity(Some(frequency), "Hz")
        )),
        Some(FollowerStability::Divergence { factor }) => {
            out.push(format!("Divergence above load factor {}.", number(factor)));
        }
        _ => {}
    }
    out.join(" ")
}

/// A line of the terminal as a sentence.
fn sentence(line: &str) -> String {
    let mut letters = line.chars();
    let first = letters.next().map(|c| c.to_ascii_uppercase());
    format!("{}{}.", first.map_or(String::new(), String::from), letters.as_str())
}

fn largest_section(
    found: &Equilibrium,
    of: impl Fn(&percuss::SectionForceSummary) -> &SectionRange,
    what: &str,
    unit: &str,
) -> Option<String> {
    let all = found.section_forces.iter().map(|b| (&b.name, of(b).largest()));
    let known = all.filter(|(_, peak)| peak.value.is_finite() && peak.value != 0.0);
    let (name, peak) = known.max_by(|a, b| a.1.value.abs().total_cmp(&b.1.value.abs()))?;
    let (value, s) = (quantity(Some(peak.value), unit), quantity(Some(peak.s), "m"));
    Some(format!("Largest {what}: {value}, in '{name}' at s\u{a0}=\u{a0}{s}."))
}

/// Displacements, reactions, contacts, section forces.
pub(super) fn tables(found: &Equilibrium) -> String {
    let StaticScales { moved, turned, force, moment } = StaticScales::of(found);
    let text_of =
        |v: f64, scale: f64, unit: &str| quantity(Some(without_round_off(v, scale)), unit);
    let points: Vec<Vec<String>> = (found.points.iter().zip(&found.rotations))
        .map(|((name, u), rotation)| {
            let [u1, u2] = u.map(|u| text_of(u, moved, "m"));
            vec![name.clone(), u1, u2, text_of(*rotation, turned, "rad")]
        })
        .collect();
    let reactions: Vec<Vec<String>> = (found.reactions.iter())
        .map(|(name, r)| {
            vec![
                name.clone(),
                text_of(r[0], force, "N"),
                text_of(r[1], force, "N"),
                text_of(r[2], moment, "N*m"),
            ]
        })
        .collect();
    let sections: Vec<Vec<String>> = found.section_forces.iter().flat_map(section_rows).collect();
    let all = [
        ("Displacements of recorded points", &["point", "x", "y", "rotation"][..], points),
        (
            "Reactions (of the supports on the structure)",
            &["support", "Fx", "Fy", "M"][..],
            reactions,
        ),
        (
            "Contacts",
            &["contact", "between", "force", "gap", "arc length on the beam"][..],
            contacts(found),
        ),
        ("Foundations (forces on the structure)", &AT_REST[..], rows_at_rest(&found.foundations)),
        (
            "Springs and hinges with a limit",
            &[
                "spring or hinge",
                "extension or rotation",
                "plastic part",
                "force or moment",
                "state",
            ][..],
            found.yielding.iter().map(yielding_row).collect(),
        ),
        (
            "Failures during loading",
            &["load factor", "failure"][..],
            found.failures.iter().map(|f| vec![number(f.factor), f.to_string()]).collect(),
        ),
        ("Section forces", &["quantity", "smallest", "at s", "largest", "at s"][..], sections),
    ];
    let filled = all.into_iter().filter(|(.., rows)| !rows.is_empty());
    filled.map(|(caption, header, rows)| table(caption, header, &rows)).collect()
}

fn contacts(found: &Equilibrium) -> Vec<Vec<String>> {
    let row = |c: &StaticContact| {
        let place = match c.s {
            [from, to] if from < to => {
                format!("{} to {}", quantity(Some(from), "m"), quantity(Some(to), "m"))
            }
            [from, _] => quantity(Some(from), "m"),
        };
        let force = quantity(Some(c.force), "N");
        let gap = if c.gap.abs() < NO_GAP { 0.0 } else { c.gap };
        vec![c.name.clone(), c.between.join(", "), force, quantity(Some(gap), "m"), place]
    };
    found.contacts.iter().map(row).collect()
}

fn yielding_row(found: &StaticYielding) -> Vec<String> {
    let [unit, force] = if found.turns { ["rad", "N*m"] } else { ["m", "N"] };
    let state = match (found.failed, found.yielded) {
        (true, _) => "failed",
        (false, true) => "yielded",
        // A slack rope, an open gap.
        (false, false) if found.force == 0.0 && found.extension != 0.0 => "without force",
        (false, false) => "elastic",
    };
    vec![
        found.name.clone(),
        quantity(Some(found.extension), unit),
        quantity(Some(found.plastic), unit),
        quantity(Some(found.force), force),
        state.to_owned(),
    ]
}

fn section_rows(beam: &percuss::SectionForceSummary) -> Vec<Vec<String>> {
    let all = [
        ("moment", &beam.moment, "N*m"),
        ("axial force", &beam.axial, "N"),
        ("shear force", &beam.shear, "N"),
        ("fibre stress", &beam.stress, "Pa"),
        ("shear stress", &beam.shear_stress, "Pa"),
    ];
    let scales = SectionScales::of(beam);
    let known = all.into_iter().filter(|(_, range, _)| !range.max.value.is_nan());
    let row = |(what, range, unit): (&str, &SectionRange, &str)| {
        let value = |v: f64| quantity(Some(scales.plain(v, unit)), unit);
        let far = range.min.s.abs().max(range.max.s.abs());
        let at = |s: f64| quantity(Some(if s.abs() < NO_DISTANCE * far { 0.0 } else { s }), "m");
        let name = format!("{}, {what}", beam.name);
        vec![name, value(range.min.value), at(range.min.s), value(range.max.value), at(range.max.s)]
    };
    let mut rows: Vec<Vec<String>> = known.map(row).collect();
    let equivalent = beam.von_mises();
    if !equivalent.value.is_nan() {
        let none = || "\u{2013}".to_owned();
        let value = quantity(Some(scales.plain(equivalent.value, "Pa")), "Pa");
        let s = quantity(Some(equivalent.s), "m");
        let name = format!("{}, von Mises stress", beam.name);
        rows.push(vec![name, none(), none(), value, s]);
    }
    rows
}
