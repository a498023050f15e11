//! All data that change during a run: the data for a restart, and no others.

use serde::{Deserialize, Serialize};

use crate::element::fibre::FibreState;
use crate::geometry::configuration::Configuration;
use crate::geometry::dents::Dents;
use crate::geometry::pair::{Memory, Pair};
use crate::geometry::touch::SearchRegion;
use crate::ledger::Ledger;
use crate::math::hermite::GAUSS;
use crate::model::Model;
use crate::model::frozen::Coordinate;
use crate::settings::Scheme;

/// Kind of a projectile, guided or free.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProjectileState {
    /// Position of its centre, shape (2) \[m\].
    pub position: [f64; 2],
    /// Velocity, shape (2) \[m/s\].
    pub velocity: [f64; 2],
    /// Angle turned \[rad\].
    pub angle: f64,
    /// Angular velocity \[rad/s\].
    pub spin: f64,
}

/// A pair that can touch, as the last step left it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PairState {
    /// Gap \[m\]; negative inside. For a pair too far apart to be evaluated, a lower bound.
    pub gap: f64,
    /// Rate of the gap \[m/s\]; negative when approaching.
    pub rate: f64,
    /// Side of the target's face, and where on its axis it is nearest.
    pub(crate) memory: Memory,
    /// Whether a rigid contact is closed (persistent contact).
    pub closed: bool,
    /// Largest approach velocity of its impacts so far \[m/s\]; the scale of the stick velocity.
    pub approach_max: f64,
    /// Deepest penetration of a law that crushes so far, where it is now \[m\]; zero of all others.
    pub deepest: f64,
    /// Position of the closest point along the face of the target \[m\]; NaN if it is independent of the motion.
    pub(crate) place: f64,
}

/// Supports with an impulse in the last accepted part of a step: of many stops most are not in contact.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Reacting {
    /// Number of the current part of a step.
    part: u64,
    /// Number of the part of a step in which each support last got an impulse, shape (supports) \[number of a part\].
    last: Vec<u64>,
    /// These supports, and their previous values, shape (such supports, 3) \[index of a support, N s, N m s\].
    list: Vec<(usize, [f64; 3])>,
}

impl Reacting {
    fn none(supports: usize) -> Self {
        Self { part: 1, last: vec![0; supports], list: Vec::new() }
    }

    /// Begins a part of a step.
    pub fn begin(&mut self) {
        self.part += 1;
        self.list.clear();
    }

    /// The supports, and their impulses so far as they were before the part.
    pub fn list(&self) -> &[(usize, [f64; 3])] {
        &self.list
    }

    /// Whether the part had an impulse of a support.
    pub fn contains(&self, support: usize) -> bool {
        self.last[support] == self.part
    }
}

/// Value and rate of the time function of a prescribed motion.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Followed {
    /// Its value.
    pub value: f64,
    /// The value from which displacements count: zero, but for the reference configuration of a structure whose supports have not moved.
    pub origin: f64,
    /// Its rate, as of the fixed components: at a kink the previous one until the jump has been made \[1/s\].
    pub rate: f64,
    /// Whether it supports parts of the structure, whose mass resists a jump of the rate.
    pub held: bool,
}

/// Reactions at an instant at which forces balance.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Instant {
    /// Time from it to the end of its step \[s\].
    pub since: f64,
    /// Of each support, shape (supports, 3) \[N, N m\].
    pub reactions: Vec<[f64; 3]>,
    /// Of all supports and guides: force, and moment about the origin, shape (3) \[N, N m\].
    pub total: [f64; 3],
}

/// State of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct State {
    /// Steps of the given size completed.
    pub step: usize,
    /// Time passed since the last completed step \[s\]; zero except after an impact at the very end of a step.
    pub offset: f64,
    /// Time \[s\].
    pub time: f64,
    /// Displacements and their gradients (u1, u2, u1', u2') of the beams' nodes, then displacements and angle of the bodies,
    /// shape (nodes, 4) \[m, -, rad\].
    pub displacement: Vec<[f64; 4]>,
    /// Velocities of the same, shape (nodes, 4) \[m/s, 1/s, rad/s\].
    pub velocity: Vec<[f64; 4]>,
    /// Accelerations of the same, shape (nodes, 4) \[m/s^2, 1/s^2, rad/s^2\]; empty for schemes that do not advance them.
    pub acceleration: Vec<[f64; 4]>,
    /// Angular rate of the tangent at the Gauss points, shape (elements, Gauss points) \[rad/s\].
    pub spin: Vec<[f64; GAUSS]>,
    /// Stored strains (membrane, bending) at the Gauss points, shape (elements, Gauss points, 2) \[-, 1/m\]; strain-rate scheme only, empty
    /// otherwise.
    pub strain: Vec<[[f64; 2]; GAUSS]>,
    /// State variables of fibres, shape (fibres).
    pub fibres: Vec<FibreState>,
    /// Whether no element connects a node to the next one, after fracture or between beams, shape (beam nodes); empty without fractured beams.
    pub(crate) parted: Vec<bool>,
    /// State variables of springs and hinges that yield, extensions \[m\] or rotations \[rad\] in place of strains, shape (connectors that yield).
    pub memories: Vec<FibreState>,
    /// Factors of loads that give strains, zero of all others, shape (loads) \[-\]; empty without such loads.
    pub(crate) strained: Vec<f64>,
    /// Values of prescribed motions, shape (motions).
    pub(crate) followed: Vec<Followed>,
    /// Coordinates of springs and dampers, angles unwound, shape (connectors) \[m, rad\].
    pub coordinates: Vec<f64>,
    /// Angular rates of the point masses, shape (point masses) \[rad/s\].
    pub mass_spin: Vec<f64>,
    /// Impulse and angular impulse about its own point of each support so far, shape (supports, 3) \[N s, N m s\].
    pub reactions: Vec<[f64; 3]>,
    /// Reactions at the last instant of balance of a scheme that advances accelerations.
    pub(crate) instant: Option<Instant>,
    /// Indices of those that the last accepted part of a step has changed.
    pub(crate) reacting: Reacting,
    /// Multipliers of the constraints, shape (constraints) \[N, N m\].
    pub multiplier: Vec<f64>,
    /// Whether each joint of a given strength has parted, shape (such joints).
    pub(crate) joints_parted: Vec<bool>,
    /// Pairs that can touch, in the model's order, shape (pairs).
    pub pairs: Vec<PairState>,
    /// Indentations of faces, shape (pairs); empty without crushing.
    pub(crate) dents: Vec<Dents>,
    /// The contact located at this instant, if any.
    pub(crate) located: Option<usize>,
    /// The running ledger.
    pub ledger: Ledger,
}

impl State {
    /// Whether it has the shape of another state of the same model, with valid indices.
    pub(crate) fn fits(&self, other: &Self, model: &Model) -> bool {
        let instant = |s: &Self| s.instant.as_ref().map(|i| i.reactions.len());
        let shape = |s: &Self| {
            let nodes = [s.displacement.len(), s.velocity.len(), s.acceleration.len()];
            let elements = [s.spin.len(), s.strain.len(), s.fibres.len(), s.memories.len()];
            let others =
                [s.followed.len(), s.coordinates.len(), s.mass_spin.len(), s.strained.len()];
            let forces = [s.reactions.len(), s.reacting.last.len(), s.multiplier.len()];
            (nodes, elements, others, forces, [s.pairs.len(), s.dents.len(), s.joints_parted.len()])
        };
        let supports = self.reactions.len();
        let parted = [0, model.beam_node_count()].contains(&self.parted.len());
        let on_axis = |(pair, state): (&Pair, &PairState)| match pair.target.beam() {
            Some(beam) => state.memory.near.element < model.beams[beam].axis.len(),
            None => true,
        };
        shape(self) == shape(other)
            && parted
            && self.located.is_none_or(|pair| pair < self.pairs.len())
            && instant(self).is_none_or(|n| n == supports)
            && self.reacting.list.iter().all(|(support, _)| *support < supports)
            && model.pairs.iter().zip(&self.pairs).all(on_axis)
    }

    /// The model at rest, with moving projectiles.
    #[doc(hidden)]
    pub fn at_rest(model: &Model, scheme: Scheme) -> Self {
        let (nodes, elements) = (model.node_count(), model.element_count());
        let stores_strain = scheme == Scheme::StrainRate;
        let advances_accelerations = scheme.advances_accelerations();
        Self {
            step: 0,
            offset: 0.0,
            time: 0.0,
            displacement: vec![[0.0; 4]; nodes],
            velocity: vec![[0.0; 4]; nodes],
            acceleration: if advances_accelerations { vec![[0.0; 4]; nodes] } else { Vec::new() },
            spin: vec![[0.0; GAUSS]; elements],
            strain: if stores_strain { vec![[[0.0; 2]; GAUSS]; elements] } else { Vec::new() },
            fibres: vec![FibreState::default(); model.fibre_count()],
            parted: Vec::new(),
            memories: vec![FibreState::default(); model.memory_count()],
            strained: if model.gives_strains() { vec![0.0; model.loads.len()] } else { Vec::new() },
            followed: followed(model),
            coordinates: Vec::new(),
            mass_spin: vec![0.0; model.masses.len()],
            reactions: vec![[0.0; 3]; model.supports.len()],
            instant: None,
            reacting: Reacting::none(model.supports.len()),
            multiplier: vec![0.0; model.constraints.len()],
            joints_parted: vec![false; model.joints.len()],
            pairs: vec![PairState::unseen(); model.pairs.len()],
            dents: if model.crushes() {
                vec![Dents::default(); model.pairs.len()]
            } else {
                Vec::new()
            },
            located: None,
            ledger: Ledger::default(),
        }
        .with_coordinates(model)
        .with_bodies(model)
    }

    /// The model at rest at given displacements of its first nodes, with the given states of its fibres, and with connectors as they are there.
    #[doc(hidden)]
    pub fn at_rest_at(
        model: &Model,
        displacement: impl IntoIterator<Item = [f64; 4]>,
        fibres: impl IntoIterator<Item = FibreState>,
    ) -> Self {
        let mut state = Self::at_rest(model, Scheme::EnergyMomentum);
        for (to, from) in state.displacement.iter_mut().zip(displacement) {
            *to = from;
        }
        for (to, from) in state.fibres.iter_mut().zip(fibres) {
            *to = from;
        }
        state.with_coordinates(model)
    }

    /// The configuration of beams and bodies, without fractured elements.
    pub(crate) fn configuration(&self) -> Configuration<'_> {
        Configuration { parted: &self.parted, ..Configuration::of(&self.displacement) }
    }

    /// The configuration after a step by an increment, in which no element of a beam is longer than its arc.
    pub(crate) fn configuration_after<'a>(
        &'a self,
        increment: &'a [[f64; 4]],
        arcs: &'a [f64],
    ) -> Configuration<'a> {
        Configuration { increment, share: 1.0, arcs, ..self.configuration() }
    }

    /// Whether the element that starts at a node has parted.
    #[inline]
    pub(crate) fn has_parted(&self, node: usize) -> bool {
        self.parted.get(node).is_some_and(|parted| *parted)
    }

    /// Whether any load gives strains in it.
    pub(crate) fn is_strained(&self) -> bool {
        self.strained.iter().any(|factor| *factor != 0.0)
    }

    /// Parts the element that starts at a node.
    pub(crate) fn part(&mut self, model: &Model, node: usize) {
        if self.parted.is_empty() {
            self.parted = vec![false; model.beam_node_count()];
            // No element starts where a span ends.
            model.spans.iter().for_each(|span| self.parted[span.nodes.end - 1] = true);
        }
        self.parted[node] = true;
    }

    /// The reaction of a support, to be changed.
    pub(crate) fn reaction_mut(&mut self, support: usize) -> &mut [f64; 3] {
        let own = &mut self.reactions[support];
        if !self.reacting.contains(support) {
            self.reacting.last[support] = self.reacting.part;
            self.reacting.list.push((support, *own));
        }
        own
    }

    /// Velocities of the bodies, and obstacles where their motion begins.
    fn with_bodies(mut self, model: &Model) -> Self {
        for (i, body) in model.bodies.iter().enumerate() {
            let [v1, v2] = body.velocity;
            self.velocity[model.body_node(i)] = [v1, v2, body.spin, 0.0];
        }
        for dofs in model.prescribed.iter().filter(|h| h.node >= model.beam_node_count()) {
            for (normal, drive) in dofs.normals.iter().zip(&dofs.drives) {
                let start: f64 = drive.iter().map(|(m, a)| a * model.motions[*m].value(0.0)).sum();
                (0..4).for_each(|k| self.displacement[dofs.node][k] += start * normal[k]);
            }
        }
        self
    }

    /// The state of the beams alone, for the model of their [`Model::structure`].
    pub(crate) fn of_structure(&self, structure: &Model) -> Self {
        let mut state = self.clone();
        for nodal in [&mut state.displacement, &mut state.velocity, &mut state.acceleration] {
            nodal.truncate(structure.node_count());
        }
        state.pairs.clear();
        state.dents.clear();
        state
    }

    /// Coordinates of the connectors in the current configuration.
    pub(crate) fn with_coordinates(mut self, model: &Model) -> Self {
        let value = |c: &crate::model::frozen::Connector| {
            let moved = match &c.coordinate {
                Coordinate::Displacement { drive, .. } => {
                    drive.iter().map(|(motion, a)| a * model.motions[*motion].value(0.0)).sum()
                }
                _ => 0.0,
            };
            c.value(&self.displacement, 0.0) - moved
        };
        self.coordinates = model.connectors.iter().map(value).collect();
        self
    }

    /// Projectile `i` of the model, guided ones first, then discs.
    pub fn projectile(&self, model: &Model, i: usize) -> Option<ProjectileState> {
        let node = model.body_node(model.striking_bodies().nth(i)?);
        let (x, u, v) = (model.nodes[node].position, self.displacement[node], self.velocity[node]);
        Some(ProjectileState {
            position: [x[0] + u[0], x[1] + u[1]],
            velocity: [v[0], v[1]],
            angle: u[2],
            spin: v[2],
        })
    }

    /// Evaluates pair `i` at its position; returns its distance, negative also after passing through \[m\].
    pub(crate) fn see(&mut self, model: &Model, i: usize, reach: SearchRegion) -> f64 {
        let start = Configuration::of(&self.displacement);
        let at = Configuration { parted: &self.parted, ..start };
        self.pairs[i].look(model, &model.pairs[i], (&at, &self.velocity), reach)
    }

    /// Pair `i` at its position after sleeping: it has not touched meanwhile, so its side is the current one.
    pub(crate) fn woken(&self, model: &Model, i: usize) -> PairState {
        let mut seen = self.pairs[i];
        seen.memory.side = 0.0;
        seen.look(
            model,
            &model.pairs[i],
            (&self.configuration(), &self.velocity),
            SearchRegion::All,
        );
        seen
    }
}

/// Start of prescribed motions: fixed components are at rest before.
fn followed(model: &Model) -> Vec<Followed> {
    let mut out: Vec<Followed> = model
        .motions
        .iter()
        .map(|function| function.value(0.0))
        .map(|value| Followed { value, origin: value, rate: 0.0, held: false })
        .collect();
    for drive in model.structural_drives() {
        for (motion, _) in drive {
            out[*motion].held = true;
        }
    }
    out
}

impl PairState {
    /// Evaluates its pair in a configuration with its velocities, near its last closest point; returns its distance, as [`State::see`] does \[m\].
    fn look(
        &mut self,
        model: &Model,
        pair: &Pair,
        (at, velocity): (&Configuration<'_>, &[[f64; 4]]),
        reach: SearchRegion,
    ) -> f64 {
        match pair.touch(model, at, &self.memory, reach) {
            Some(touch) => {
                let row = pair.normal_row(&touch, at);
                (self.gap, self.rate) = (touch.gap, row.on(velocity));
                self.memory = touch.memory;
                self.place = pair.place_on_face(&touch, at);
                touch.apart.min(touch.gap)
            }
            None => {
                (self.gap, self.rate) = (f64::INFINITY, 0.0);
                f64::INFINITY
            }
        }
    }

    fn unseen() -> Self {
        Self {
            gap: f64::NAN,
            rate: f64::NAN,
            memory: Memory::default(),
            closed: false,
            approach_max: 0.0,
            deepest: 0.0,
            place: f64::NAN,
        }
    }
}
