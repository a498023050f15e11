//! An equilibrium and a path, as text.

use percuss::{
    BucklingOutcome, Equilibrium, FollowerStability, LargestDisplacement, LinearBuckling, Model,
    Path, PlasticHinge, PlasticSummary, SectionPeak, SectionRange, StaticContact, StaticFailure,
    StaticYielding, yielded_at_rest,
};

use crate::number::{count, number};

/// Limit points and failures printed, of each.
const LISTED: usize = 20;

/// An equilibrium for people.
pub fn table(model: &Model, found: &Equilibrium, linear: &LinearBuckling) -> String {
    let steps = count(found.load_steps, "load step");
    let mut text =
        format!("equilibrium in {steps}, {} Newton iterations\n", found.newton_iterations);
    for beam in &found.sliding {
        text.push_str(&format!(
            "  `{beam}` can slide along what it lies on: statics knows no friction, and nothing else holds it there\n"
        ));
    }
    if !found.stable {
        text.push_str(
            "  unstable: the structure leaves it at the slightest push; `percuss modes --about static` shows how\n",
        );
    }
    text.push_str(&failures(&found.failures));
    text.push_str(&displacements(found));
    if !found.reactions.is_empty() {
        text.push_str("reactions, on the structure\n");
    }
    let size = largest(found.reactions.iter().flat_map(|(_, r)| r));
    for (name, reaction) in &found.reactions {
        let [f1, f2, moment] = reaction.map(|r| beside(size, r));
        text.push_str(&format!("  {name}: force {f1} N, {f2} N, moment {moment} N m\n"));
    }
    if found.balance.springs != [0.0; 2] {
        let [f1, f2] = found.balance.springs.map(|f| beside(size, f));
        text.push_str(&format!("  springs to the ground, in all: force {f1} N, {f2} N\n"));
    }
    text.push_str(&contacts(&found.contacts));
    text.push_str(&yielding(&found.yielding));
    text.push_str(&yielded(model, found));
    text.push_str("section forces, smallest to largest\n");
    for beam in &found.section_forces {
        text.push_str(&format!("  {}\n", beam.name));
        for (what, range, unit) in [
            ("moment", &beam.moment, "N m"),
            ("axial force", &beam.axial, "N"),
            ("shear force", &beam.shear, "N"),
            ("fibre stress", &beam.stress, "Pa"),
        ] {
            if !range.max.value.is_nan() {
                text.push_str(&format!("    {what:12} {}\n", in_words(range, unit)));
            }
        }
    }
    if let Some(mode) = linear.modes.first() {
        text.push_str(&format!(
            "linear buckling at {} times the loads (about the reference configuration{})\n",
            number(mode.factor),
            contacts_of_buckling(&found.contacts)
        ));
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
    let mut text = found.largest_displacement.as_ref().map_or(String::new(), farthest);
    let moved = largest(found.points.iter().flat_map(|(_, u)| u));
    let turned = largest(found.rotations.iter());
    for ((name, u), rotation) in found.points.iter().zip(&found.rotations) {
        let ([u1, u2], rotation) = (u.map(|u| beside(moved, u)), beside(turned, *rotation));
        text.push_str(&format!("  {name}: displacement {u1} m, {u2} m, rotation {rotation} rad\n"));
    }
    if found.points.is_empty() {
        text.push_str("  no points recorded: `[record] points = [\"beam.mid\"]` names some\n");
    }
    text
}

/// The largest displacement.
fn farthest(most: &LargestDisplacement) -> String {
    let (size, s) = (number(most.size()), number(most.s));
    let [u1, u2] = most.displacement.map(|u| beside(most.size(), u));
    format!("  largest displacement: {size} m ({u1} m, {u2} m), `{}` at s = {s} m\n", most.beam)
}

/// What has failed on the way.
fn failures(found: &[StaticFailure]) -> String {
    let mut text = String::new();
    for one in found.iter().take(LISTED) {
        text.push_str(&format!("  {one} at the load factor {}\n", number(one.factor)));
    }
    if found.len() > LISTED {
        text.push_str(&format!("  and {} more failures\n", found.len() - LISTED));
    }
    text
}

/// Where loads that follow the beams end the stability of the equilibrium.
fn under_followers(stability: FollowerStability) -> String {
    let contacts = "contacts left out";
    match stability {
        FollowerStability::Flutter { factor, frequency } => format!(
            "flutter from {} times the loads on, at {} Hz ({contacts})",
            number(factor),
            number(frequency)
        ),
        FollowerStability::Divergence { factor } => {
            format!("divergence from {} times the loads on ({contacts})", number(factor))
        }
        FollowerStability::Kept { up_to } => format!(
            "no flutter and no divergence at the load factors looked at, in steps up to {} ({contacts})",
            number(up_to)
        ),
        _ => String::new(),
    }
}

/// Springs and hinges that can yield.
fn yielding(found: &[StaticYielding]) -> String {
    if found.is_empty() {
        return String::new();
    }
    let mut text = "springs and hinges that can yield\n".to_owned();
    for one in found {
        let [what, unit, force] =
            if one.turns { ["rotation", "rad", "N m"] } else { ["extension", "m", "N"] };
        let state = match (one.failed, one.yielded) {
            (true, _) => "failed".to_owned(),
            (false, true) => format!("plastic {what} {} {unit}", number(one.plastic)),
            (false, false) => "elastic".to_owned(),
        };
        text.push_str(&format!(
            "  {}: {} {force}, {what} {} {unit}, {state}\n",
            one.name,
            number(one.force),
            number(one.extension)
        ));
    }
    text
}

/// A structure that becomes so many times softer than at first has passed a plastic mechanism.
const MECHANISM: f64 = 20.0;

/// Beams that have yielded, and whether the structure has passed a plastic mechanism.
fn yielded(model: &Model, found: &Equilibrium) -> String {
    let all = yielded_at_rest(model, found);
    if all.is_empty() {
        return String::new();
    }
    let mut text = "beams that can yield\n".to_owned();
    for beam in &all {
        text.push_str(&format!("  {}: {}\n", beam.name, in_short(model, found, beam)));
    }
    let any = all.iter().any(|beam| beam.first_yield.is_some())
        || found.yielding.iter().any(|one| one.yielded);
    if any && found.softening > MECHANISM {
        text.push_str(&format!(
            "  a plastic mechanism was passed: displacements grew up to {} times faster with the loads than at first\n",
            number(found.softening)
        ));
    }
    text
}

/// What a beam that can yield has come to.
fn in_short(model: &Model, found: &Equilibrium, beam: &PlasticSummary) -> String {
    let Some(first) = beam.first_yield else { return "elastic".to_owned() };
    let index = (0..model.beam_count()).find(|k| model.beam(*k).name() == beam.name);
    let share = index.and_then(|k| found.first_yields.get(k).copied().flatten());
    let by =
        share.map_or(String::new(), |one| format!(", by the load factor {}", number(one.share)));
    let mut parts = vec![
        format!("first yield at s = {} m{by}", number(first.s)),
        format!("plastic strain up to {}", number(beam.strain_max.value)),
    ];
    let larger =
        |a: &&PlasticHinge, b: &&PlasticHinge| a.rotation.abs().total_cmp(&b.rotation.abs());
    if let Some(hinge) = beam.hinges.iter().max_by(larger) {
        let (turn, s, length) = (number(hinge.rotation), number(hinge.s), number(hinge.length));
        parts.push(format!("bent by {turn} rad about s = {s} m over {length} m"));
    }
    parts.push(match beam.permanent_set {
        Ok(set) => {
            let [x, y] = set.displacement.map(|u| beside(set.size(), u));
            format!("permanent set ({x}, {y}) m at s = {} m", number(set.s))
        }
        Err(reason) => format!("no permanent set told: {reason}"),
    });
    if beam.failed > 0 {
        parts.push(format!("{} failed", count(beam.failed, "fibre")));
    }
    parts.push(format!("{} J dissipated", number(beam.dissipated)));
    parts.join(", ")
}

/// What linear buckling makes of contacts.
fn contacts_of_buckling(found: &[StaticContact]) -> &'static str {
    let press = found.iter().any(|c| c.force > 0.0);
    let open = found.iter().any(|c| c.force == 0.0);
    match (press, open) {
        (false, false) => "",
        (false, true) => ", open contacts left out",
        (true, false) => ", contacts that press held closed, those of discs left out",
        (true, true) => ", contacts that press held closed, open ones and those of discs left out",
    }
}

/// Contacts: what they carry, and where.
fn contacts(found: &[StaticContact]) -> String {
    if found.is_empty() {
        return String::new();
    }
    let friction = if found.iter().any(|c| c.frictional) { ", friction left out" } else { "" };
    let mut text =
        format!("contacts, guided projectiles and discs on their way left out{friction}\n");
    for contact in found {
        let [a, b] = &contact.between;
        if contact.force == 0.0 {
            let gap = if contact.gap.is_finite() {
                format!("open by {} m", number(contact.gap.max(0.0)))
            } else {
                "open".to_owned()
            };
            text.push_str(&format!("  {} ({a}, {b}): {gap}\n", contact.name));
            continue;
        }
        let [f1, f2] = contact.resultant.map(|f| beside(contact.force, f));
        let mut line = format!(
            "  {} ({a}, {b}): force {} N, on {a} {f1} N, {f2} N",
            contact.name,
            number(contact.force)
        );
        let [from, to] = contact.s;
        if from == to {
            line.push_str(&format!(", at {} m", number(from)));
        } else if from < to {
            let centre = number(contact.centre);
            line.push_str(&format!(
                ", from {} m to {} m, centre at {centre} m",
                number(from),
                number(to)
            ));
        }
        if contact.gap < -1e-12 {
            line.push_str(&format!(", pressed in by {} m", number(-contact.gap)));
        }
        text.push_str(&line);
        text.push('\n');
    }
    text
}

fn largest<'a>(values: impl Iterator<Item = &'a f64>) -> f64 {
    values.fold(0.0, |most: f64, v| most.max(v.abs()))
}

/// A number, zero if it is round-off beside `size`.
fn beside(size: f64, value: f64) -> String {
    number(if value.abs() < 1e-12 * size { 0.0 } else { value })
}

fn in_words(range: &SectionRange, unit: &str) -> String {
    let size = range.min.value.abs().max(range.max.value.abs());
    let at = |p: &SectionPeak| format!("{} {unit} at {} m", beside(size, p.value), number(p.s));
    format!("{} to {}", at(&range.min), at(&range.max))
}

/// Where a path led.
pub fn path(path: &Path) -> String {
    let points = count(path.points.len().saturating_sub(1), "point");
    let factor = path.points.last().map_or(0.0, |p| p.factor);
    let mut text = format!("equilibrium path: {points}, to the load factor {}\n", number(factor));
    for first in path.yields.iter().take(LISTED) {
        let factor = number(first.factor);
        text.push_str(&format!("  {} yields at the load factor {factor}\n", first.name));
    }
    for (what, points) in [("limit point", &path.limit_points), ("bifurcation", &path.bifurcations)]
    {
        for point in points.iter().take(LISTED) {
            let places = path.names.iter().zip(&point.displacements);
            let places: Vec<String> = places
                .map(|(name, [u1, u2])| format!("{name} at {} m, {} m", number(*u1), number(*u2)))
                .collect();
            let places =
                if places.is_empty() { String::new() } else { format!(": {}", places.join("; ")) };
            let factor = number(point.factor);
            text.push_str(&format!("  {what} at the load factor {factor}{places}\n"));
        }
    }
    text.push_str(&unstable(path));
    match path.limit_points.len() {
        0 => text.push_str("  no limit point\n"),
        n if n > LISTED => text.push_str(&format!("  and {} more limit points\n", n - LISTED)),
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
        text.push_str(&format!("  unstable from the load factor {first} to {last}\n"));
        points = &rest[length..];
    }
    text
}
