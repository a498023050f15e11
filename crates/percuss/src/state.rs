//! What changes while a run steps: everything a restart needs, and nothing else.

use crate::ledger::Books;
use crate::math::hermite::GAUSS;
use crate::math::vec2::dot;
use crate::model::Model;
use crate::model::frozen::Coordinate;
use crate::settings::Scheme;

/// State of a projectile on its line of flight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProjectileState {
    /// Distance travelled along the line of flight \[m\].
    pub travel: f64,
    /// Speed along the line of flight \[m/s\].
    pub speed: f64,
    /// Acceleration along the line of flight \[m/s^2\]; kept by schemes that advance accelerations.
    pub acceleration: f64,
    /// Whether a rigid projectile rests on the beam (persistent contact).
    pub closed: bool,
    /// Largest approach velocity it ever struck with \[m/s\]; the scale of the stick velocity.
    pub approach_max: f64,
}

/// State of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// Steps of the given size completed.
    pub step: usize,
    /// Time passed since the last completed step \[s\]; zero except after an impact at the very end of a step.
    pub offset: f64,
    /// Time \[s\].
    pub time: f64,
    /// Displacements and their gradients (u1, u2, u1', u2') of the nodes, shape (n_node) \[m, 1\].
    pub displacement: Vec<[f64; 4]>,
    /// Velocities of the same, shape (n_node) \[m/s, 1/s\].
    pub velocity: Vec<[f64; 4]>,
    /// Accelerations of the same; empty for schemes that do not advance them.
    pub acceleration: Vec<[f64; 4]>,
    /// Angular rate of the tangent at the Gauss points, shape (n_elem, n_gauss) \[rad/s\].
    pub spin: Vec<[f64; GAUSS]>,
    /// Stored strains (membrane, bending) at the Gauss points, shape (n_elem, n_gauss) \[1, 1/m\]; strain-rate scheme
    /// only, empty otherwise.
    pub strain: Vec<[[f64; 2]; GAUSS]>,
    /// Coordinates of springs and dampers, angles unwound, shape (n_connector) \[m, rad\].
    pub coordinates: Vec<f64>,
    /// Angular rates of the point masses, shape (n_mass) \[rad/s\].
    pub mass_spin: Vec<f64>,
    /// Impulse and angular impulse about its own point of each support so far, shape (n_support) \[N s, N m s\].
    pub reactions: Vec<[f64; 3]>,
    /// Multipliers of the constraints, shape (n_constraint) \[N, N m\].
    pub multiplier: Vec<f64>,
    /// Projectiles, in the model's order.
    pub projectiles: Vec<ProjectileState>,
    /// The running books.
    pub books: Books,
}

impl State {
    /// The model at rest, its projectiles on their way.
    pub(crate) fn at_rest(model: &Model, scheme: Scheme) -> Self {
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
            coordinates: Vec::new(),
            mass_spin: vec![0.0; model.masses.len()],
            reactions: vec![[0.0; 3]; model.supports.len()],
            multiplier: vec![0.0; model.constraints.len()],
            projectiles: model
                .projectiles
                .iter()
                .map(|p| ProjectileState {
                    travel: 0.0,
                    speed: p.speed,
                    acceleration: 0.0,
                    closed: false,
                    approach_max: 0.0,
                })
                .collect(),
            books: Books::default(),
        }
        .with_coordinates(model)
    }

    /// Coordinates of the connectors in the configuration as it stands.
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

    /// Gap between projectile `i` and the point it strikes \[m\].
    pub(crate) fn gap(&self, model: &Model, i: usize) -> f64 {
        let p = &model.projectiles[i];
        p.standoff + dot(p.direction, p.point.value(&self.displacement))
            - self.projectiles[i].travel
    }

    /// Rate of the gap \[m/s\]; negative when approaching.
    pub(crate) fn gap_rate(&self, model: &Model, i: usize) -> f64 {
        let p = &model.projectiles[i];
        dot(p.direction, p.point.value(&self.velocity)) - self.projectiles[i].speed
    }
}
