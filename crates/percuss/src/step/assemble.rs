//! Sums residual and tangent of the beams over their elements.

mod end_forces;

pub use end_forces::EndForces;

use super::fibres::element_step;
use super::integration::{Integration, MidpointForces, Rule};
use super::sweep::SpanStep;
use crate::element::beam::{ElementSums, ElementValues, GaussRow, step_point};
use crate::element::energy_momentum::End;
use crate::element::membrane::{MembranePoint, MembraneStep};
use crate::element::point::{PointResponse, StepPoint, Strains};
use crate::element::rotary::{self, Turn};
use crate::element::yielding::{ElementFibres, ElementStep, ElementTurn};
use crate::element::{collocation, energy_momentum, strain_rate};
use crate::linalg::block::ZERO;
use crate::linalg::chain::{Chain, add_element};
use crate::math::hermite::GAUSS;
use crate::math::vec2::add;
use crate::model::frozen::Span;
use crate::model::{Model, StrainMeasure};
use crate::state::State;

/// Where a Gauss point stands: its element and its number there.
#[derive(Clone, Copy)]
struct GaussPlace<'a> {
    row: &'a GaussRow,
    /// Node `a` of the element.
    node: usize,
    element: usize,
    gauss: usize,
    /// Retardation time over the step size.
    lag: f64,
    /// Mass-proportional damping \[1/s\].
    damping: f64,
}

impl EndForces {
    /// Forces of the strains of a state at rest, with gravity.
    pub fn at_rest(model: &Model, state: &State, gravity: [f64; 2]) -> Self {
        let mut forces = Self::default();
        let zero = vec![[0.0; 4]; model.node_count()];
        let mut residual = vec![[0.0; 4]; model.node_count()];
        let integration = &Integration { h: 1.0, rule: Rule::Static };
        let ends = StepState { model, state, integration, gravity, increment: &zero };
        ends.sum::<false>(
            &mut residual,
            &mut Chain::default(),
            &mut forces,
            |point, place| collocation::response::<f64, false>(&place.row.weighed, point, 1.0),
            |step, measure, _| step.collocated(measure, 1.0, 0.0),
        );
        forces
    }
}

/// Residual `M (a - gravity) + f_int` of the beams at `increment`, and their tangent if `TANGENT`.
///
/// Must not allocate, but for the first time that elements are evaluated one by one.
pub fn beams<const TANGENT: bool>(
    model: &Model,
    state: &State,
    integration: &Integration,
    gravity: [f64; 2],
    increment: &[[f64; 4]],
    residual: &mut [[f64; 4]],
    sums: (&mut Chain, &mut EndForces),
) {
    let (chain, forces) = sums;
    let h = integration.h;
    let ends = StepState { model, state, integration, gravity, increment };
    let stored = |place: GaussPlace| {
        let [membrane, bending] = state.strain[place.element][place.gauss];
        Strains { membrane, bending }
    };
    match integration.rule {
        Rule::Midpoint(MidpointForces::Invariant) => {
            for (i, span) in model.spans.iter().enumerate() {
                if forces.sweep.has(i) {
                    let (rule, chain, forces) = (integration, &mut *chain, &mut *forces);
                    let residual = &mut *residual;
                    SpanStep::<TANGENT> {
                        model,
                        span: i,
                        rule,
                        gravity,
                        increment,
                        residual,
                        chain,
                        forces,
                    }
                    .evaluate();
                } else {
                    ends.invariant_span::<TANGENT>(span, residual, chain, forces);
                }
            }
        }
        Rule::Midpoint(MidpointForces::StrainRate) => ends.sum::<TANGENT>(
            residual,
            chain,
            forces,
            |point, place| {
                let (law, old) = (&place.row.weighed, stored(place));
                let mut r = strain_rate::response::<f64, TANGENT>(law, point, old, place.lag);
                add_rotary::<TANGENT>(&mut r, point, place, state, h);
                r
            },
            |step, measure, place| step.strain_rate(measure, stored(place).membrane, place.lag),
        ),
        Rule::Midpoint(MidpointForces::Collocated) => ends.sum::<TANGENT>(
            residual,
            chain,
            forces,
            |point, place| {
                let mut r =
                    collocation::damped::<f64, TANGENT>(&place.row.weighed, point, place.lag);
                add_rotary::<TANGENT>(&mut r, point, place, state, h);
                r
            },
            |step, measure, place| step.collocated(measure, 0.5, place.lag),
        ),
        Rule::Static => ends.sum::<TANGENT>(
            residual,
            chain,
            forces,
            |point, place| {
                let law = &place.row.weighed;
                collocation::foreseeing::<f64, TANGENT>(law, point, stored(place))
            },
            |step, measure, place| MembranePoint {
                geometric: stored(place).membrane,
                ..step.collocated(measure, 1.0, 0.0)
            },
        ),
        Rule::Alpha(_) => {
            let theta = integration.theta();
            ends.sum::<TANGENT>(
                residual,
                chain,
                forces,
                |point, place| {
                    let law = &place.row.weighed;
                    let mut r = collocation::response::<f64, TANGENT>(law, point, theta);
                    ends.add_alpha_rotary::<TANGENT>(&mut r, point, place);
                    r
                },
                |step, measure, _| step.collocated(measure, theta, 0.0),
            );
        }
    }
}

#[inline(always)]
fn add_rotary<const TANGENT: bool>(
    response: &mut PointResponse<f64>,
    point: &StepPoint<f64>,
    place: GaussPlace,
    state: &State,
    h: f64,
) {
    let g0 = add(point.reference.tangent, point.slope_0);
    let spin = state.spin[place.element][place.gauss];
    let (rotary, damping) = (place.row.weighed.rotary, place.damping);
    Turn::new(g0, point.d_slope).add_inertia::<TANGENT>(response, rotary, spin, h.recip(), damping);
}

/// The start of the step and the increment that leads to its end.
struct StepState<'a> {
    model: &'a Model,
    state: &'a State,
    integration: &'a Integration,
    /// Acceleration of gravity, shape (2) \[m/s^2\].
    gravity: [f64; 2],
    /// Increment of the nodal displacements over the step, shape (nodes, 4) \[m, -, rad\].
    increment: &'a [[f64; 4]],
}

impl StepState<'_> {
    /// Sums over all elements `response` at their Gauss points, `membrane` at the sampling points of slender ones, and inertia.
    #[inline(always)]
    fn sum<const TANGENT: bool>(
        &self,
        residual: &mut [[f64; 4]],
        chain: &mut Chain,
        forces: &mut EndForces,
        response: impl Fn(&StepPoint<f64>, GaussPlace) -> PointResponse<f64>,
        membrane: impl Fn(&MembraneStep<f64>, StrainMeasure, GaussPlace) -> MembranePoint<f64>,
    ) {
        for span in &self.model.spans {
            self.sum_span::<TANGENT>(span, residual, (chain, forces), &response, &membrane);
        }
    }

    /// The same over a span.
    #[inline(always)]
    fn sum_span<const TANGENT: bool>(
        &self,
        span: &Span,
        residual: &mut [[f64; 4]],
        (chain, forces): (&mut Chain, &mut EndForces),
        response: &impl Fn(&StepPoint<f64>, GaussPlace) -> PointResponse<f64>,
        membrane: &impl Fn(&MembraneStep<f64>, StrainMeasure, GaussPlace) -> MembranePoint<f64>,
    ) {
        let theta = self.integration.theta();
        forces.make_room(self.model);
        {
            let slope = self.integration.inertia_slope()
                + span.mass_damping * self.integration.rate_slope();
            let first = span.nodes.start;
            residual[first] = [0.0; 4];
            if TANGENT {
                chain.diag[first] = ZERO;
            }
            let lag = self.integration.lag(span.retardation);
            let damping = span.mass_damping;
            let mut start = self.inertia(span, first);
            forces.inertia[first] = start;
            for (k, element) in span.elements.clone().enumerate() {
                let a = first + k;
                let table = span.table(k);
                let end = self.inertia(span, a + 1);
                forces.inertia[a + 1] = end;
                let u = &self.state.displacement;
                let old = ElementValues::new(&u[a], &u[a + 1]);
                let step = ElementValues::new(&self.increment[a], &self.increment[a + 1]);
                let mut sums = ElementSums::zero(0.0);
                let place = |row, gauss| GaussPlace { row, node: a, element, gauss, lag, damping };
                if self.state.has_parted(a) {
                    // Inertia alone, which is added below.
                } else if let Some(fibres) = &span.fibres {
                    let ends = element_step((span, table), [&old, &step], self.integration);
                    let fibres = self.state.fibres_of(fibres, k);
                    self.add_fibres::<TANGENT>(&ends, &fibres, (element, damping), &mut sums);
                } else {
                    for gauss in 0..GAUSS {
                        let row = &table.rows[gauss];
                        let point = step_point(row, &old, &step);
                        sums.add::<TANGENT>(row, &response(&point, place(row, gauss)));
                    }
                    if let Some(samples) = &table.membrane {
                        let steps = samples.step(&old, &step);
                        let points = std::array::from_fn(|i| {
                            membrane(&steps[i], span.measure, place(&table.rows[i], i))
                        });
                        samples.add::<TANGENT>(&points, theta, &mut sums);
                    }
                }
                let [mut on_a, mut on_b] = sums.nodal_force();
                table.add_inertia(&start, &end, &mut on_a, &mut on_b);
                forces.on_nodes[element] = [on_a, on_b];
                for i in 0..4 {
                    residual[a][i] += on_a[i];
                }
                residual[a + 1] = on_b;
                if TANGENT {
                    spread(&sums, &table.mass, slope, a, chain);
                }
                start = end;
            }
        }
    }

    /// Sums the invariant scheme over a span that is not swept.
    fn invariant_span<const TANGENT: bool>(
        &self,
        span: &Span,
        residual: &mut [[f64; 4]],
        chain: &mut Chain,
        forces: &mut EndForces,
    ) {
        let (state, h) = (self.state, self.integration.h);
        self.sum_span::<TANGENT>(
            span,
            residual,
            (chain, forces),
            &|point, place| {
                let law = &place.row.weighed;
                let mut r = energy_momentum::response::<f64, TANGENT>(law, point, Some(place.lag));
                add_rotary::<TANGENT>(&mut r, point, place, state, h);
                r
            },
            &|step, measure, place| step.invariant(measure, Some(place.lag)),
        );
    }

    /// Adds the forces of an element of fibres.
    fn add_fibres<const TANGENT: bool>(
        &self,
        step: &ElementStep,
        fibres: &ElementFibres,
        (element, damping): (usize, f64),
        sums: &mut ElementSums<f64>,
    ) {
        if self.integration.rule == Rule::Static {
            let foreseen = self.state.strain.get(element);
            let foreseen = foreseen.copied().unwrap_or_else(|| step.strains()[1]);
            return step.add_static::<TANGENT>(fibres, &foreseen, sums);
        }
        let (spin, rate) = (&self.state.spin[element], self.integration.h.recip());
        let starts = &End::all(step.measure, &step.table.rows, step.start);
        let turn = ElementTurn { starts, spin, rate, damping };
        *sums = step.sums::<TANGENT>(fibres, &turn).0;
    }

    /// Acceleration of a node in the equation of motion, less gravity, with what mass-proportional damping adds.
    #[inline(always)]
    fn inertia(&self, span: &Span, node: usize) -> [f64; 4] {
        let (d, v) = (&self.increment[node], &self.state.velocity[node]);
        let a = self.state.acceleration.get(node).unwrap_or(&[0.0; 4]);
        let rule = self.integration;
        let mut out: [f64; 4] = std::array::from_fn(|i| rule.inertia(d[i], v[i], a[i]));
        if span.mass_damping != 0.0 {
            for i in 0..4 {
                out[i] += span.mass_damping * rule.rate(d[i], v[i], a[i]);
            }
        }
        out[0] -= self.gravity[0];
        out[1] -= self.gravity[1];
        out
    }

    /// Rotary inertia of the schemes that advance accelerations.
    #[inline(always)]
    fn add_alpha_rotary<const TANGENT: bool>(
        &self,
        response: &mut PointResponse<f64>,
        point: &StepPoint<f64>,
        place: GaussPlace,
    ) {
        let Rule::Alpha(w) = self.integration.rule else { return };
        let theta = 1.0 - w.alpha_f;
        let g0 = add(point.reference.tangent, point.slope_0);
        let g = [g0[0] + theta * point.d_slope[0], g0[1] + theta * point.d_slope[1]];
        let at = |nodal: &[[f64; 4]]| {
            ElementValues::new(&nodal[place.node], &nodal[place.node + 1]).at(&place.row.first)
        };
        let (v0, a0) = (at(&self.state.velocity), at(&self.state.acceleration));
        let rule = self.integration;
        let g_dot: [f64; 2] = std::array::from_fn(|i| {
            (1.0 - theta) * v0[i] + theta * rule.velocity(point.d_slope[i], v0[i], a0[i])
        });
        // Mass-proportional damping turns with the same arm: its couple is that of an acceleration.
        let g_ddot = std::array::from_fn(|i| {
            rule.inertia(point.d_slope[i], v0[i], a0[i]) + place.damping * g_dot[i]
        });
        let rate = theta * w.gamma / (w.beta * rule.h);
        let slopes = [theta, rate, rule.inertia_slope() + place.damping * rate];
        rotary::add_collocated::<f64, TANGENT>(
            response,
            place.row.weighed.rotary,
            g,
            g_dot,
            g_ddot,
            slopes,
        );
    }
}

/// Spreads an element's tangent, and its mass times `slope`, over the band.
#[inline(always)]
pub fn spread(
    sums: &ElementSums<f64>,
    mass: &[[f64; 4]; 4],
    slope: f64,
    a: usize,
    chain: &mut Chain,
) {
    let Chain { diag, upper, lower, .. } = chain;
    add_element([diag, upper, lower], a, &sums.nodal_tangent(mass, slope));
}
