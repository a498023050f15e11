//! An equilibrium and a path, as text.

use percuss::{
    BucklingOutcome, Equilibrium, FollowerStability, LargestDisplacement, LinearBuckling, Model,
    Path, PlasticSummary, SectionForceSummary, SectionPeak, SectionRange, StaticContact,
    StaticFailure, StaticFoundation, StaticYielding, yielded_at_rest,
};

use crate::foundation_text::foundation_place;
use crate::number::{count, number, quantity};
use crate::plastic_text::{permanent_deflection, plastic_hinges};
use percuss_output::round_off::{
    NO_DISTANCE, NO_GAP, SectionScales, StaticScales, is_round_off, without_round_off,
};
use percuss_output::shown::LINES;

/// An equilibrium for people.
pub fn table(model: &Model, found: &Equilibrium, linear: &LinearBuckling) -> String {
    let steps = count(found.load_steps, "load step");
    let mut text =
        format!("equilibrium in {steps}, {} Newton iterations\n", found.newton_iterations);
    for beam in &found.sliding {
        text.push_str(&format!("  '{beam}' can slide (no friction in statics)\n"));
    }
    if !found.stable {
        text.push_str("  unstable equilibrium; see `percuss modes --about static`\n");
    }
    text.push_str(&failures(&found.failures));
    text.push_str(&displacements(found));
    if !found.reactions.is_empty() {
        text.push_str("reactions, on the structure\n");
    }
    let scales = StaticScales::of(found);
    for (name, reaction) in &found.reactions {
        let [x, y] = [0, 1].map(|k| beside(scales.force, reaction[k], "N"));
        let moment = beside(scales.moment, reaction[2], "N*m");
        text.push_str(&format!("  '{name}': force (x, y) = ({x}, {y}), moment {moment}\n"));
    }
    if found.balance.springs != [0.0; 2] {
        let [x, y] = found.balance.springs.map(|f| beside(scales.force, f, "N"));
        text.push_str(&format!("  springs to ground, total: force (x, y) = ({x}, {y})\n"));
    }
    text.push_str(&foundations(&found.foundations));
    text.push_str(&contacts(&found.contacts));
    text.push_str(&yielding(&found.yielding));
    text.push_str(&yielded(model, found));
    text.push_str("section forces, smallest to largest\n");
    for beam in &found.section_forces {
        text.push_str(&format!("  '{}'\n", beam.name));
        let scales = SectionScales::of(beam);
        for (what, range, unit) in [
            ("moment", &beam.moment, "N*m"),
            ("axial force", &beam.axial, "N"),
            ("shear force", &beam.shear, "N"),
            ("fibre stress", &beam.stress, "Pa"),
            ("shear stress", &beam.shear_stress, "Pa"),
        ] {
            if !range.max.value.is_nan() {
                text.push_str(&format!("    {what:12} {}\n", in_words(&scales, range, unit)));
            }
        }
        text.push_str(&equivalent(&scales, beam));
    }
    if let Some(mode) = linear.modes.first() {
        text.push_str(&format!(
            "linear buckling factor {} (about the reference configuration{})\n",
            number(mode.factor),
            contacts_of_buckling(&found.contacts)
        ));
        linear.assumptions().iter().for_each(|line| text.push_str(&format!("{line}\n")));
    }
    if let Some(reason) = linear.outcome.reason()
        && linear.outcome != BucklingOutcome::Unloaded
    {
        let code =
            linear.outcome.code().map_or(String::new(), |code| format!(" [{}]", code.code()));
        text.push_str(&format!("{reason}{code}\n"));
    }
    if let Some(stability) = linear.stability {
        text.push_str(&format!("{}\n", under_followers(stability)));
    }
    text
}

/// The largest displacement, and those of the recorded points with their rotations.
fn displacements(found: &Equilibrium) -> String {
    let StaticScales { moved, turned, .. } = StaticScales::of(found);
    let most = found.largest_displacement.as_ref();
    let mut text = most.map_or(String::new(), |most| farthest(most, moved));
    for ((name, u), rotation) in found.points.iter().zip(&found.rotations) {
        let [x, y] = u.map(|u| beside(moved, u, "m"));
        let rotation = beside(turned, *rotation, "rad");
        text.push_str(&format!(
            "  '{name}': displacement (x, y) = ({x}, {y}), rotation {rotation}\n"
        ));
    }
    if found.points.is_empty() {
        text.push_str("  no recorded points; add `[record] points = [\"beam.mid\"]`\n");
    }
    text
}

/// The largest displacement; what is round-off beside `scale` has no place.
fn farthest(most: &LargestDisplacement, scale: f64) -> String {
    if is_round_off(most.size(), scale) {
        return "  largest displacement: 0 m\n".to_owned();
    }
    let (size, s) = (quantity(most.size(), "m"), quantity(most.s, "m"));
    let [x, y] = most.displacement.map(|u| beside(most.size(), u, "m"));
    format!("  largest displacement: {size}, (x, y) = ({x}, {y}), in '{}' at s = {s}\n", most.beam)
}

/// Failures on the way to the equilibrium.
fn failures(found: &[StaticFailure]) -> String {
    let mut text = String::new();
    for one in found.iter().take(LINES) {
        text.push_str(&format!("  {one} at load factor {}\n", number(one.factor)));
    }
    if found.len() > LINES {
        text.push_str(&format!("  and {} more failures\n", found.len() - LINES));
    }
    text
}

/// The load factor at which follower loads end the stability of the equilibrium.
fn under_followers(stability: FollowerStability) -> String {
    let contacts = "contacts omitted";
    match stability {
        FollowerStability::Flutter { factor, frequency } => format!(
            "flutter above load factor {}, {} ({contacts})",
            number(factor),
            quantity(frequency, "Hz")
        ),
        FollowerStability::Divergence { factor } => {
            format!("divergence above load factor {} ({contacts})", number(factor))
        }
        FollowerStability::Kept { up_to } => format!(
            "no flutter or divergence found up to load factor {} ({contacts})",
            number(up_to)
        ),
        _ => String::new(),
    }
}

/// Foundations: their forces on the beams, and where they press most.
fn foundations(found: &[StaticFoundation]) -> String {
    let mut text = String::new();
    if !found.is_empty() {
        text.push_str("foundations, on the structure\n");
    }
    for one in found {
        let size = one.force[0].hypot(one.force[1]);
        let [x, y] = one.force.map(|f| beside(size, f, "N"));
        let mut parts = foundation_place(&one.properties);
        parts.push(format!("force (x, y) = ({x}, {y})"));
        if let Some((pressure, s)) = one.largest().filter(|(pressure, _)| *pressure != 0.0) {
            let (pressure, s) = (quantity(pressure, "N/m"), quantity(s, "m"));
            parts.push(format!("largest reaction {pressure} at s = {s}"));
        }
        if one.lifted > 0.0 {
            parts.push(format!("lifted off over {}", quantity(one.lifted, "m")));
        }
        if one.plastic != 0.0 {
            parts.push(format!("plastic deflection {}", quantity(one.plastic, "m")));
        }
        text.push_str(&format!("  '{}': {}\n", one.name, parts.join(", ")));
    }
    text
}

/// Springs and hinges that can yield or fail.
fn yielding(found: &[StaticYielding]) -> String {
    if found.is_empty() {
        return String::new();
    }
    let mut text = "springs and hinges with a limit\n".to_owned();
    for one in found {
        let [what, unit, force] =
            if one.turns { ["rotation", "rad", "N*m"] } else { ["extension", "m", "N"] };
        let state = match (one.failed, one.yielded) {
            (true, _) => "failed".to_owned(),
            (false, true) => format!("plastic {what} {}", quantity(one.plastic, unit)),
            // A slack rope, an open gap.
            (false, false) if one.force == 0.0 && one.extension != 0.0 => {
                "without force".to_owned()
            }
            (false, false) => "elastic".to_owned(),
        };
        text.push_str(&format!(
            "  '{}': {}, {what} {}, {state}\n",
            one.name,
            quantity(one.force, force),
            quantity(one.extension, unit)
        ));
    }
    text
}

/// A structure that becomes so many times softer than at first has passed a plastic mechanism.
const MECHANISM: f64 = 20.0;

/// Beams that can yield, and whether the structure became a plastic mechanism.
fn yielded(model: &Model, found: &Equilibrium) -> String {
    let all = yielded_at_rest(model, found);
    if all.is_empty() {
        return String::new();
    }
    let mut text = "beams that can yield\n".to_owned();
    for beam in &all {
        text.push_str(&format!("  '{}': {}\n", beam.name, in_short(model, found, beam)));
    }
    let any = all.iter().any(|beam| beam.first_yield.is_some())
        || found.yielding.iter().any(|one| one.yielded);
    if any && found.softening > MECHANISM {
        text.push_str(&format!(
            "  plastic mechanism: displacements grew up to {} times as fast with the load as initially\n",
            number(found.softening)
        ));
    }
    text
}

/// First yield, plastic hinge and permanent deflection of a beam.
fn in_short(model: &Model, found: &Equilibrium, beam: &PlasticSummary) -> String {
    let Some(first) = beam.first_yield else { return "elastic".to_owned() };
    let index = (0..model.beam_count()).find(|k| model.beam(*k).name() == beam.name);
    let share = index.and_then(|k| found.first_yields.get(k).copied().flatten());
    let by =
        share.map_or(String::new(), |one| format!(", up to load factor {}", number(one.share)));
    let mut parts = vec![
        format!("first yield at s = {}{by}", quantity(first.s, "m")),
        format!("largest plastic strain {}", number(beam.strain_max.value)),
    ];
    parts.extend(plastic_hinges(&beam.hinges));
    parts.push(match beam.permanent_set {
        Ok(set) => permanent_deflection(&set),
        Err(reason) => format!("permanent deflection not available: {reason}"),
    });
    if beam.failed > 0 {
        parts.push(format!("{} failed", count(beam.failed, "fibre")));
    }
    parts.push(format!("{} dissipated", quantity(beam.dissipated, "J")));
    parts.join(", ")
}

/// Contacts in linear buckling.
fn contacts_of_buckling(found: &[StaticContact]) -> &'static str {
    let press = found.iter().any(|c| c.force > 0.0);
    let open = found.iter().any(|c| c.force == 0.0);
    match (press, open) {
        (false, false) => "",
        (false, true) => ", open contacts omitted",
        (true, false) => ", active contacts closed, contacts of discs omitted",
        (true, true) => ", active contacts closed, open contacts and those of discs omitted",
    }
}

/// Contacts: their forces, and where they act.
fn contacts(found: &[StaticContact]) -> String {
    if found.is_empty() {
        return String::new();
    }
    let friction = if found.iter().any(|c| c.frictional) { ", friction" } else { "" };
    let mut text = format!("contacts (not included: guided projectiles, moving discs{friction})\n");
    for contact in found {
        let [a, b] = &contact.between;
        if contact.force == 0.0 {
            let gap = if contact.gap.is_finite() {
                format!("open, gap {}", quantity(contact.gap.max(0.0), "m"))
            } else {
                "open".to_owned()
            };
            text.push_str(&format!("  '{}' ('{a}', '{b}'): {gap}\n", contact.name));
            continue;
        }
        let [x, y] = contact.resultant.map(|f| beside(contact.force, f, "N"));
        let mut line = format!(
            "  '{}' ('{a}', '{b}'): force {}, on '{a}' (x, y) = ({x}, {y})",
            contact.name,
            quantity(contact.force, "N")
        );
        let [from, to] = contact.s;
        if from == to {
            line.push_str(&format!(", at s = {}", quantity(from, "m")));
        } else if from < to {
            let [from, to, centre] = [from, to, contact.centre].map(|s| quantity(s, "m"));
            line.push_str(&format!(", from s = {from} to {to}, centre at {centre}"));
        }
        if contact.gap < -NO_GAP {
            line.push_str(&format!(", penetration {}", quantity(-contact.gap, "m")));
        }
        text.push_str(&line);
        text.push('\n');
    }
    text
}

/// A quantity, zero if it is round-off beside `size`.
fn beside(size: f64, value: f64, unit: &str) -> String {
    quantity(without_round_off(value, size), unit)
}

/// The largest von Mises stress of a beam, or that shear stresses are not known.
fn equivalent(scales: &SectionScales, beam: &SectionForceSummary) -> String {
    let most = beam.von_mises();
    let text = match (most.value.is_nan(), beam.stress.max.value.is_nan()) {
        (true, true) => return String::new(),
        (true, false) => {
            "not available, as is the shear stress: no elastic section with a shape".to_owned()
        }
        (false, _) => {
            let value = quantity(scales.plain(most.value, "Pa"), "Pa");
            format!("{value} at s = {} at most", quantity(most.s, "m"))
        }
    };
    format!("    {:12} {text}\n", "von Mises")
}

fn in_words(scales: &SectionScales, range: &SectionRange, unit: &str) -> String {
    let far = range.min.s.abs().max(range.max.s.abs());
    let place = |s: f64| quantity(if s.abs() < NO_DISTANCE * far { 0.0 } else { s }, "m");
    let value = |p: &SectionPeak| quantity(scales.plain(p.value, unit), unit);
    let at = |p: &SectionPeak| format!("{} at s = {}", value(p), place(p.s));
    format!("{} to {}", at(&range.min), at(&range.max))
}

/// Points of a path: yield, limit points, bifurcations.
pub fn path(path: &Path) -> String {
    let points = count(path.points.len().saturating_sub(1), "point");
    let factor = path.points.last().map_or(0.0, |p| p.factor);
    let mut text = format!("equilibrium path: {points}, up to load factor {}\n", number(factor));
    for first in path.yields.iter().take(LINES) {
        let factor = number(first.factor);
        text.push_str(&format!("  '{}' yields at load factor {factor}\n", first.name));
    }
    for (what, points) in [("limit point", &path.limit_points), ("bifurcation", &path.bifurcations)]
    {
        for point in points.iter().take(LINES) {
            let places = path.names.iter().zip(&point.displacements);
            let places: Vec<String> = places
                .map(|(name, u)| {
                    let [x, y] = u.map(|u| quantity(u, "m"));
                    format!("'{name}' displaced by (x, y) = ({x}, {y})")
                })
                .collect();
            let places =
                if places.is_empty() { String::new() } else { format!(": {}", places.join("; ")) };
            let factor = number(point.factor);
            text.push_str(&format!("  {what} at load factor {factor}{places}\n"));
        }
    }
    text.push_str(&unstable(path));
    match path.limit_points.len() {
        0 => text.push_str("  no limit point\n"),
        n if n > LINES => text.push_str(&format!("  and {} more limit points\n", n - LINES)),
        _ => {}
    }
    text
}

/// Stretches of a path that are unstable.
fn unstable(path: &Path) -> String {
    let mut text = String::new();
    let mut points = path.points.as_slice();
    while let Some(from) = points.iter().position(|p| !p.stable) {
        let rest = &points[from..];
        let length = rest.iter().position(|p| p.stable).unwrap_or(rest.len());
        let [first, last] = [rest[0].factor, rest[length - 1].factor].map(number);
        text.push_str(&format!("  unstable from load factor {first} to {last}\n"));
        points = &rest[length..];
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_displacement_of_round_off_is_zero_and_has_no_place() {
        let most = |y: f64| LargestDisplacement {
            beam: "strut".to_owned(),
            s: 1.25,
            displacement: [0.0, y],
        };
        let scale = 1e-4; // of a beam of 1 m
        assert_eq!(farthest(&most(3.4e-21), scale), "  largest displacement: 0 m\n");
        let real =
            "  largest displacement: 1 mm, (x, y) = (0 m, -1 mm), in 'strut' at s = 1.25 m\n";
        assert_eq!(farthest(&most(-1e-3), scale), real);
    }
}
