//! Sums residual and tangent of the beams over their elements.

use super::end_forces::EndForces;
use super::fibres::element_step;
use super::integration::{AlphaWeights, Integration, MidpointForces, Rule};
use super::sweep::{SpanStep, Sweep};
use crate::element::beam::{ElementSums, ElementTable, ElementValues, step_point};
use crate::element::energy_momentum::End;
use crate::element::invariant::InvariantStep;
use crate::element::membrane::{MembranePoint, MembraneStep};
use crate::element::point::{PointResponse, SectionLaw, StepPoint, Strains};
use crate::element::rotary::{self, Turn};
use crate::element::shear::from_stored;
use crate::element::{collocation, strain_rate};
use crate::linalg::block::ZERO;
use crate::linalg::chain::{Chain, add_element};
use crate::math::vec2::add;
use crate::model::Model;
use crate::model::frozen::Span;
use crate::state::State;

/// An element in a step.
struct ElementAt<'a> {
    span: &'a Span,
    table: &'a ElementTable,
    /// Its number in the span.
    k: usize,
    /// Its node `a`.
    node: usize,
    element: usize,
    /// Nodal values at the start, and their increments.
    old: ElementValues<f64>,
    step: ElementValues<f64>,
    /// Retardation time over the step size.
    lag: f64,
}

/// A Gauss point, or a sampling point of the membrane: its element and its number there.
type PointAt<'a> = (&'a ElementAt<'a>, usize);

/// Forces of the strains of a state at rest, with gravity.
pub fn forces_at_rest(model: &Model, state: &State, gravity: [f64; 2]) -> EndForces {
    let mut forces = EndForces::default();
    let zero = vec![[0.0; 4]; model.node_count()];
    let mut residual = zero.clone();
    let integration = &Integration { h: 1.0, rule: Rule::Static };
    let ends = StepState { model, state, integration, gravity, increment: &zero };
    ends.sum_points::<false>(
        (&mut residual, &mut Chain::default(), &mut forces),
        |law, point, _| collocation::response::<f64, false>(law, point, 1.0),
        |step, (at, _)| step.collocated(at.span.measure, 1.0, 0.0),
    );
    forces
}

/// Residual `M (a - gravity) + f_int` of the beams at `increment`, and their tangent if `TANGENT`.
///
/// Must not allocate, except for the first evaluation of elements one by one.
pub fn beams<const TANGENT: bool>(
    model: &Model,
    state: &State,
    integration: &Integration,
    gravity: [f64; 2],
    increment: &[[f64; 4]],
    residual: &mut [[f64; 4]],
    sums: (&mut Chain, &mut EndForces),
) {
    let sums = (residual, sums.0, sums.1);
    let ends = StepState { model, state, integration, gravity, increment };
    let stored = |(at, j): PointAt| {
        let [membrane, bending] = state.strain[at.element][j];
        Strains { membrane, bending }
    };
    match integration.rule {
        Rule::Midpoint(MidpointForces::Invariant) => ends.sum_invariant::<TANGENT>(sums),
        Rule::Midpoint(MidpointForces::StrainRate) => ends.sum_points::<TANGENT>(
            sums,
            |law, point, here| {
                let (old, lag) = (stored(here), here.0.lag);
                let mut r = strain_rate::response::<f64, TANGENT>(law, point, old, lag);
                ends.add_rotary::<TANGENT>(&mut r, law, point, here);
                r
            },
            |step, (at, j)| step.strain_rate(at.span.measure, stored((at, j)).membrane, at.lag),
        ),
        Rule::Midpoint(MidpointForces::Collocated) => ends.sum_points::<TANGENT>(
            sums,
            |law, point, here| {
                let mut r = collocation::damped::<f64, TANGENT>(law, point, here.0.lag);
                ends.add_rotary::<TANGENT>(&mut r, law, point, here);
                r
            },
            |step, (at, _)| step.collocated(at.span.measure, 0.5, at.lag),
        ),
        Rule::Static => ends.sum_points::<TANGENT>(
            sums,
            |law, point, here| collocation::foreseeing::<f64, TANGENT>(law, point, stored(here)),
            |step, here| MembranePoint {
                geometric: stored(here).membrane,
                ..step.collocated(here.0.span.measure, 1.0, 0.0)
            },
        ),
        Rule::Alpha(w) => {
            let theta = integration.theta();
            ends.sum_points::<TANGENT>(
                sums,
                |law, point, here| {
                    let mut r = collocation::response::<f64, TANGENT>(law, point, theta);
                    ends.add_alpha_rotary::<TANGENT>(&mut r, &w, point, here);
                    r
                },
                |step, (at, _)| step.collocated(at.span.measure, theta, 0.0),
            );
        }
    }
}

/// Residual, tangent and forces that are summed up.
type Sums<'a> = (&'a mut [[f64; 4]], &'a mut Chain, &'a mut EndForces);

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
    /// Sums the invariant scheme, spans that are swept side by side.
    fn sum_invariant<const TANGENT: bool>(&self, (residual, chain, forces): Sums) {
        let Self { model, integration: rule, gravity, increment, .. } = *self;
        for (span, own) in model.spans.iter().enumerate() {
            let (residual, chain, forces) = (&mut *residual, &mut *chain, &mut *forces);
            if forces.sweep.has(span) {
                SpanStep::<TANGENT> {
                    model,
                    span,
                    rule,
                    gravity,
                    increment,
                    residual,
                    chain,
                    forces,
                }
                .evaluate();
            } else {
                let forces_of = |at: &ElementAt, s: &mut Sweep| self.invariant::<TANGENT>(at, s);
                self.sum_span::<TANGENT>(own, (residual, chain, forces), &forces_of);
            }
        }
    }

    /// Sums over all elements `response` at their Gauss points, and `membrane` at the sampling points of slender ones; fibre elements, which
    /// support only the invariant scheme and rest, are at rest here.
    #[inline(always)]
    fn sum_points<const TANGENT: bool>(
        &self,
        (residual, chain, forces): Sums,
        response: impl Fn(&SectionLaw<f64>, &StepPoint<f64>, PointAt) -> PointResponse<f64>,
        membrane: impl Fn(&MembraneStep<f64>, PointAt) -> MembranePoint<f64>,
    ) {
        let forces_of = |at: &ElementAt, _: &mut Sweep| {
            if let Some(shear) = at.span.shear_at(at.k) {
                // As fibres, they support only the invariant scheme and rest.
                let foreseen = self.state.strain.get(at.element).map(from_stored);
                if let Some(own) = &at.span.fibres {
                    let fibres = self.state.fibres_of(own, at.k);
                    return shear.end_with_fibres::<TANGENT>(&fibres, &at.old, &at.step, foreseen);
                }
                return shear.at_end::<f64, TANGENT>(&at.old, &at.step, foreseen);
            }
            let mut sums = ElementSums::zero(0.0);
            if let Some(fibres) = &at.span.fibres {
                let fibres = self.state.fibres_of(fibres, at.k);
                let step = element_step((at.span, at.table), [&at.old, &at.step], self.integration);
                let foreseen = self.state.strain.get(at.element);
                let foreseen = foreseen.copied().unwrap_or_else(|| step.strains()[1]);
                step.add_static::<TANGENT>(&fibres, &foreseen, &mut sums);
                return sums;
            }
            for (j, row) in at.table.rows.iter().enumerate() {
                let point = step_point(row, &at.old, &at.step);
                sums.add::<TANGENT>(row, &response(&row.weighed, &point, (at, j)));
            }
            if let Some(samples) = &at.table.membrane {
                let steps = samples.step(&at.old, &at.step);
                let points = std::array::from_fn(|j| membrane(&steps[j], (at, j)));
                samples.add::<TANGENT>(&points, self.integration.theta(), &mut sums);
            }
            sums
        };
        for span in &self.model.spans {
            self.sum_span::<TANGENT>(span, (residual, chain, forces), &forces_of);
        }
    }

    /// Sums the results of `forces_of` over a span's elements, and inertia.
    #[inline(always)]
    fn sum_span<const TANGENT: bool>(
        &self,
        span: &Span,
        (residual, chain, forces): Sums,
        forces_of: &impl Fn(&ElementAt, &mut Sweep) -> ElementSums<f64>,
    ) {
        let slope =
            self.integration.inertia_slope() + span.mass_damping * self.integration.rate_slope();
        let first = span.nodes.start;
        forces.make_room(self.model);
        residual[first] = [0.0; 4];
        if TANGENT {
            chain.diag[first] = ZERO;
        }
        let lag = self.integration.lag(span.retardation);
        let mut start = self.inertia(span, first);
        forces.inertia[first] = start;
        for (k, element) in span.elements.clone().enumerate() {
            let (a, table) = (first + k, span.table(k));
            let end = self.inertia(span, a + 1);
            forces.inertia[a + 1] = end;
            let u = &self.state.displacement;
            let old = ElementValues::new(&u[a], &u[a + 1]);
            let step = ElementValues::new(&self.increment[a], &self.increment[a + 1]);
            let sums = if self.state.has_parted(a) {
                ElementSums::zero(0.0) // inertia only
            } else {
                let at = ElementAt { span, table, k, node: a, element, old, step, lag };
                forces_of(&at, &mut forces.sweep)
            };
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

    /// The invariant scheme, whose angular rates at the end the sweep computes.
    fn invariant<const TANGENT: bool>(
        &self,
        at: &ElementAt,
        sweep: &mut Sweep,
    ) -> ElementSums<f64> {
        let fibres = at.span.fibres.as_ref().map(|own| self.state.fibres_of(own, at.k));
        let h = self.integration.h;
        if let Some(shear) = at.span.shear_at(at.k) {
            return match &fibres {
                Some(own) => shear.mean_with_fibres::<TANGENT>(own, &at.old, &at.step, (h, at.lag)),
                None => shear.mean::<f64, TANGENT>(&at.old, &at.step, at.lag),
            };
        }
        let step = InvariantStep {
            table: at.table,
            measure: at.span.measure,
            starts: &End::all(at.span.measure, &at.table.rows, &at.old),
            spin: &self.state.spin[at.element],
            start: at.old,
            increment: at.step,
            h,
            rate: h.recip(),
            lag: (at.span.retardation > 0.0).then_some(at.lag),
            damping: at.span.mass_damping,
        };
        let (sums, spin) = step.sums::<TANGENT>(fibres.as_ref());
        sweep.set_end_spin(at.element, spin);
        sums
    }

    /// Acceleration of a node in the equation of motion, less gravity, with the term of mass-proportional damping.
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

    /// Rotary inertia of the midpoint family.
    #[inline(always)]
    fn add_rotary<const TANGENT: bool>(
        &self,
        response: &mut PointResponse<f64>,
        law: &SectionLaw<f64>,
        point: &StepPoint<f64>,
        (at, j): PointAt,
    ) {
        let g0 = add(point.reference.tangent, point.slope_0);
        let (spin, rate) = (self.state.spin[at.element][j], self.integration.h.recip());
        let (turn, damping) = (Turn::new(g0, point.d_slope), at.span.mass_damping);
        turn.add_inertia::<TANGENT>(response, law.rotary, spin, rate, damping);
    }

    /// Rotary inertia of the schemes that advance accelerations.
    #[inline(always)]
    fn add_alpha_rotary<const TANGENT: bool>(
        &self,
        response: &mut PointResponse<f64>,
        w: &AlphaWeights,
        point: &StepPoint<f64>,
        (at, j): PointAt,
    ) {
        let theta = 1.0 - w.alpha_f;
        let (row, damping) = (&at.table.rows[j], at.span.mass_damping);
        let g0 = add(point.reference.tangent, point.slope_0);
        let g = [g0[0] + theta * point.d_slope[0], g0[1] + theta * point.d_slope[1]];
        let value = |nodal: &[[f64; 4]]| {
            ElementValues::new(&nodal[at.node], &nodal[at.node + 1]).at(&row.first)
        };
        let (v0, a0) = (value(&self.state.velocity), value(&self.state.acceleration));
        let rule = self.integration;
        let g_dot: [f64; 2] = std::array::from_fn(|i| {
            (1.0 - theta) * v0[i] + theta * rule.velocity(point.d_slope[i], v0[i], a0[i])
        });
        // Mass-proportional damping turns with the same arm: its couple is that of an acceleration.
        let g_ddot = std::array::from_fn(|i| {
            rule.inertia(point.d_slope[i], v0[i], a0[i]) + damping * g_dot[i]
        });
        let rate = theta * w.gamma / (w.beta * rule.h);
        let slopes = [theta, rate, rule.inertia_slope() + damping * rate];
        rotary::add_collocated::<f64, TANGENT>(
            response,
            row.weighed.rotary,
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
