//! Modal damping of a run: which modes it damps, and how they follow supports that move.

use super::modes::{Linearized, Mode};
use super::spectrum::Layout;
use crate::linalg::block::inner;
use crate::linalg::dense::DenseLu;
use crate::math::vec2::dot;
use crate::model::frozen::{Connector, ConnectorLaw, Coordinate};
use crate::model::{Fault, Model};
use crate::settings::Scheme;
use crate::state::State;
use crate::step::constraint::ConstraintStep;
use crate::step::forcing::Forcing;
use crate::step::integration::Integration;
use crate::step::modal_damping::{ModalDamping, MovingModes, StepView, positions, tie_count};
use crate::step::tangent::project;

/// A mode of which more than this share is motion of bodies as a whole, such as a pendulum's, is not one of deformation.
const MOSTLY_RIGID: f64 = 0.5;

/// Degrees of freedom without motion at the start of a run.
struct Still {
    forcing: Forcing,
    rule: Integration,
    /// No increment, shape (nodes, 4) \[m, -, rad\].
    increment: Vec<[f64; 4]>,
}

impl Still {
    fn new(model: &Model) -> Self {
        let rule = Integration::new(Scheme::EnergyMomentum, 1.0);
        Self { forcing: Forcing::new(model), rule, increment: vec![[0.0; 4]; model.node_count()] }
    }

    fn view<'a>(&'a self, model: &'a Model, state: &'a State) -> StepView<'a> {
        let Self { forcing, rule, increment } = self;
        StepView { model, state, rule, forcing, increment }
    }
}

/// Damping of the flexible modes about `state`, from the lowest on; modes that are motions of bodies as a whole are none.
pub(crate) fn modal_damping(full: &Model, state: &State) -> ModalDamping {
    let ratios = &full.modal_damping;
    if ratios.is_empty() {
        return ModalDamping::default();
    }
    let model = &full.structure();
    let structure = Linearized::new(model, &state.of_structure(model), Vec::new());
    let mut damping = ModalDamping {
        start: positions(full, &state.displacement),
        mass: structure.mass.clone(),
        ..ModalDamping::default()
    };
    let still = Still::new(full);
    let view = still.view(full, state);
    let (_, can_move) = MovingModes::freedoms(&damping, &view);
    damping.moves = can_move || changes(full);
    // Modes that are orthogonal: of the part of stiffness that has a potential.
    let found = structure.symmetric(ratios.len(), true);
    let image = |mode: &Mode| structure.mass.multiply(&mode.shape);
    let flexible = found.into_iter().filter(|mode| {
        mode.eigenvalue > 0.0
            && MovingModes::rigid_share(&damping, &view, &image(mode)) < MOSTLY_RIGID
    });
    let flexible: Vec<Mode> = flexible.collect();
    let damped = flexible.iter().zip(ratios).filter(|(_, ratio)| **ratio > 0.0);
    let (modes, ratios): (Vec<&Mode>, Vec<f64>) = damped.unzip();
    let images: Vec<_> = modes.iter().map(|mode| image(mode)).collect();
    damping.followed = SlowSupports::new(full, &structure, state).of(&modes, &images);
    for ((mode, ratio), mut vector) in modes.iter().zip(ratios).zip(images) {
        project(model, &mut vector);
        vector.resize(full.node_count(), [0.0; 4]);
        damping.vectors.push(vector);
        damping.rates.push(2.0 * ratio * mode.eigenvalue.sqrt());
    }
    damping
}

/// Whether supports move, or connections of bodies can change.
fn changes(model: &Model) -> bool {
    let weak =
        |c: &Connector| c.yielding.is_some() || matches!(c.law, ConnectorLaw::OneSided { .. });
    !model.motions.is_empty()
        || model.has_fibres()
        || model.constraints.iter().any(|c| c.joint.is_some())
        || model.connectors.iter().any(weak)
}

/// Reason why modal damping cannot act: parts that move relative to each other without strain have no common rigid-body motion that could be
/// separated from deformation.
pub(crate) fn undampable(full: &Model, state: &State) -> Option<Fault> {
    if full.modal_damping.is_empty() {
        return None;
    }
    let model = &full.structure();
    let structure = Linearized::new(model, &state.of_structure(model), Vec::new());
    let damping = ModalDamping {
        start: positions(full, &state.displacement),
        mass: structure.mass.clone(),
        ..ModalDamping::default()
    };
    let still = Still::new(full);
    let (as_a_whole, _) = MovingModes::freedoms(&damping, &still.view(full, state));
    let free = structure.free_motions();
    (free > as_a_whole).then(|| {
        let found = format!(
            "a mechanism: {free} independent motions without strain, of which {as_a_whole} move its bodies as a whole"
        );
        let expected = "a structure whose parts do not move against each other without strain, or damping by the \
                        `retardation` of its materials";
        Fault::new("damping.modal", found, expected)
    })
}

/// How the coordinates of modes follow supports that move slowly.
///
/// A support moves by one, and the structure follows at rest: K r = -C^T l, C r = 1. With `K phi + C^T m = omega^2 M phi` then
/// `r . M phi = m / omega^2`: the mode's reaction at the support.
struct SlowSupports<'a> {
    full: &'a Model,
    structure: &'a Linearized<'a>,
    /// Gradients of fixed degrees of freedom of nodes and of constraints, with the number of each among the ties, shape (those, nodes, 4) \[index
    /// of a tie, -, m\].
    gradients: Vec<(usize, Vec<[f64; 4]>)>,
    /// The matrix of their products, factored.
    gram: DenseLu,
    /// Number of components held at nodes.
    held: usize,
}

impl<'a> SlowSupports<'a> {
    fn new(full: &'a Model, structure: &'a Linearized<'a>, state: &State) -> Self {
        let held = tie_count(full) - full.constraints.len() - full.connectors.len();
        let mut own =
            Self { full, structure, gradients: Vec::new(), gram: DenseLu::default(), held };
        if full.motions.is_empty() {
            return own;
        }
        let nodes = full.beam_node_count();
        let normals = full.prescribed.iter().flat_map(|d| d.normals.iter().map(|n| (d.node, *n)));
        for (number, (node, normal)) in normals.enumerate().filter(|(_, (n, _))| *n < nodes) {
            let mut nodal = vec![[0.0; 4]; nodes];
            nodal[node] = normal;
            own.gradients.push((number, nodal));
        }
        let forcing = Forcing::new(full);
        let step = ConstraintStep::at_rest(&state.displacement, &forcing);
        for (i, c) in full.constraints.iter().enumerate() {
            let mut nodal = vec![[0.0; 4]; nodes];
            step.add_gradient(c, 1.0, &mut nodal);
            own.gradients.push((held + i, nodal));
        }
        let products = |a: &(usize, Vec<[f64; 4]>)| {
            own.gradients.iter().map(|b| inner(&a.1, &b.1)).collect::<Vec<f64>>()
        };
        let gram: Vec<f64> = own.gradients.iter().flat_map(products).collect();
        if !own.gram.factor(own.gradients.len(), &gram) {
            own.gradients.clear();
        }
        own
    }

    /// Change of the coordinate of each mode with each tie, shape (modes, ties); `images` are the modes' `M phi`. Empty if no support moves.
    fn of(&self, modes: &[&Mode], images: &[Vec<[f64; 4]>]) -> Vec<Vec<f64>> {
        if self.full.motions.is_empty() {
            return vec![Vec::new(); modes.len()];
        }
        let mut loose = self.full.structure();
        loose.prescribed.clear();
        let layout = Layout::new(&loose);
        let tangent = layout.symmetric(&layout.tangent(&self.structure.search));
        let each = modes.iter().zip(images).map(|(mode, image)| {
            let mut out = vec![0.0; tie_count(self.full)];
            let mut left = layout.multiply(&tangent, &mode.shape);
            for (l, m) in left.iter_mut().zip(image) {
                (0..4).for_each(|i| l[i] = mode.eigenvalue * m[i] - l[i]);
            }
            self.supports(mode, image, &left, &mut out);
            self.springs(mode, &mut out);
            out
        });
        each.collect()
    }

    /// Those of supports, from the forces that a mode leaves to them.
    fn supports(&self, mode: &Mode, image: &[[f64; 4]], left: &[[f64; 4]], out: &mut [f64]) {
        let mut reactions: Vec<f64> = self.gradients.iter().map(|g| inner(&g.1, left)).collect();
        self.gram.solve(&mut reactions);
        for (reaction, (number, gradient)) in reactions.iter().zip(&self.gradients) {
            out[*number] = reaction / mode.eigenvalue;
            if *number < self.held {
                // Of `M phi` only the part that is not held damps.
                out[*number] -= inner(gradient, image);
            }
        }
    }

    /// Those of springs to a ground that moves.
    fn springs(&self, mode: &Mode, out: &mut [f64]) {
        let first = out.len() - self.full.connectors.len();
        for (out, c) in out[first..].iter_mut().zip(&self.full.connectors) {
            if let (
                Coordinate::Displacement { point, direction, .. },
                ConnectorLaw::Linear { stiffness, .. },
            ) = (&c.coordinate, c.law)
            {
                *out = stiffness * dot(*direction, point.value(&mode.shape)) / mode.eigenvalue;
            }
        }
    }
}
