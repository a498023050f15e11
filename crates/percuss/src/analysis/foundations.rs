//! Foundations along beams in equilibrium.

use crate::model::frozen::FoundationData;
use crate::model::{FoundationLaw, Model};
use crate::state::State;
use crate::summary::{FoundationKind, FoundationProperties};

/// A foundation in equilibrium.
#[derive(Clone, Debug, PartialEq)]
pub struct StaticFoundation {
    /// The user's name for it.
    pub name: String,
    /// Its place and law.
    pub properties: FoundationProperties,
    /// Its resultant force on the beam, shape (2) \[N\].
    pub force: [f64; 2],
    /// Arc length of its Gauss points from the start of the beam, shape (points) \[m\].
    pub s: Vec<f64>,
    /// Reaction per length there, positive where it pushes the beam, shape (points) \[N/m\].
    pub pressure: Vec<f64>,
    /// Length over which the beam has lifted off, of a foundation of compression alone \[m\].
    pub lifted: f64,
    /// Energy stored in it, without that stored by hardening \[J\].
    pub energy: f64,
    /// Plastic deflection of largest magnitude, signed \[m\].
    pub plastic: f64,
}

impl StaticFoundation {
    /// Reaction per length of largest magnitude, signed \[N/m\], and its arc length from the start of the beam \[m\].
    pub fn largest(&self) -> Option<(f64, f64)> {
        let all = self.pressure.iter().copied().zip(self.s.iter().copied());
        all.reduce(|most, one| if one.0.abs() > most.0.abs() { one } else { most })
    }
}

/// Place and law of a foundation.
pub(crate) fn properties(model: &Model, foundation: &FoundationData) -> FoundationProperties {
    let (kind, stiffness) = match foundation.law {
        FoundationLaw::Linear { stiffness } => (FoundationKind::Linear, Some(stiffness)),
        FoundationLaw::Compression { stiffness, .. } => {
            (FoundationKind::Compression, Some(stiffness))
        }
        FoundationLaw::Table { .. } => (FoundationKind::Table, None),
    };
    let beam = model.beams[foundation.beam].name.clone();
    FoundationProperties { beam, stretch: foundation.stretch, kind, stiffness }
}

/// The foundations in a state at rest.
pub(super) fn at_rest(model: &Model, state: &State) -> Vec<StaticFoundation> {
    let of = |foundation: &FoundationData| {
        let mut found = StaticFoundation {
            name: foundation.name.clone(),
            properties: properties(model, foundation),
            force: [0.0; 2],
            s: Vec::new(),
            pressure: Vec::new(),
            lifted: 0.0,
            energy: 0.0,
            plastic: 0.0,
        };
        for place in foundation.places_at_rest(model, &state.coordinates, &state.memories) {
            (0..2).for_each(|i| found.force[i] += place.force[i]);
            found.s.push(place.s);
            found.pressure.push(place.pressure);
            found.energy += place.stored;
            if place.lifted {
                found.lifted += place.length;
            }
            if place.plastic.abs() > found.plastic.abs() {
                found.plastic = place.plastic;
            }
        }
        found
    };
    model.foundations.iter().map(of).collect()
}
