//! Fibres of spans whose material does more than Hooke's law says.

use super::definition::{Material, Section, Station};
use super::frozen::SpanFibres;
use crate::element::fibre::{Fibre, StressLaw};
use crate::math::hermite::{self, GAUSS};

/// Where the elements of a span lie.
pub(super) struct Stretch<'a> {
    /// Arc length from the start of the beam at its nodes, shape (nodes of the span) \[m\].
    pub stations: &'a [f64],
    /// Arc length of the beam \[m\].
    pub total: f64,
    /// Whether all its elements are alike.
    pub uniform: bool,
    /// Number of its elements.
    pub count: usize,
}

/// The fibres of a span, the first one of number `first`; none for an elastic one.
pub(super) fn of_span(
    material: &Material,
    section: &Section,
    stretch: &Stretch,
    first: usize,
) -> Option<SpanFibres> {
    let inelasticity = material.inelasticity.as_ref()?;
    let laws = vec![StressLaw::new(material.young, Some(inelasticity))];
    let points = hermite::gauss_points();
    let element = |k: usize| -> [Vec<Fibre>; GAUSS] {
        let (a, b) = (stretch.stations[k], stretch.stations[k + 1]);
        points.map(|xi| layout(section, (a + xi * (b - a)) / stretch.total))
    };
    let at: Vec<_> = (0..if stretch.uniform { 1 } else { stretch.count }).map(element).collect();
    let count = at[0].iter().map(Vec::len).sum();
    Some(SpanFibres { laws, at, count, first })
}

/// Fibres at a fraction of the beam's length: the profile scaled to the area and the radius of gyration there; then those of no area
/// at both surfaces.
fn layout(section: &Section, fraction: f64) -> Vec<Fibre> {
    let (here, base) = (section.at(fraction), section.at(0.0));
    let gyration = |s: &Station| (s.inertia / s.area).sqrt();
    let (taller, larger) = (gyration(&here) / gyration(&base), here.area / base.area);
    let fibre = |[y, area]: [f64; 2]| Fibre { height: y * taller, area: area * larger, law: 0 };
    let mut out: Vec<Fibre> =
        section.profile.fibres(section.fibres).into_iter().map(fibre).collect();
    let most = out.iter().map(|f| f.height).fold(0.0, f64::max);
    let half = here.depth.map_or(most, |d| 0.5 * d);
    out.extend([-half, half].map(|height| Fibre { height, area: 0.0, law: 0 }));
    out
}
