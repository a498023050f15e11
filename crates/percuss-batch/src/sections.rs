//! Section forces of the runs of an ensemble, from the balance of their elements in the current step.

use super::detail::Detail;
use super::engine::Engine;
use super::numbers::SpanNumbers;
use percuss::Model;
use percuss::internals::model::frozen::{LoadAction, MaterialPoint};
use percuss::internals::scalar::{Mask, Number, Task, array};
use percuss::internals::section_forces::{ElementActing, ElementPlace, ForceInside, RunForces};
use percuss::internals::step::contacts::IMPULSIVE;
use percuss::math::vec2::scale;

/// Section forces of all lanes.
#[derive(Clone, Debug)]
pub struct Sections<'m, S: Number> {
    found: RunForces<'m, S>,
    /// The model of the run in each lane, shape (lanes).
    models: Vec<Option<&'m Model>>,
    /// Acceleration by each load for a factor of one, shape (loads, 2) \[m/s^2\].
    gravity: Vec<[S; 2]>,
    /// Share of every element in each distributed load, on values and slopes, shape (loads, elements, 2, 4) \[N, N m\]; empty of other loads.
    shares: Vec<Vec<[[S; 4]; 2]>>,
    /// Forces inside elements, with their element, shape (such forces) \[index of an element\].
    inside: Vec<(usize, ForceSource)>,
}

/// Source of a force inside an element, with its number.
#[derive(Clone, Copy, Debug)]
enum ForceSource {
    Guide(usize),
    Load(usize),
}

impl<'m, S: Number> Sections<'m, S> {
    /// Section forces for runs with the shape of a model, if `detail` requests them; no lane has a run yet.
    pub fn of(engine: &Engine<S>, model: &'m Model, detail: Detail) -> Option<Self> {
        let stresses = match detail {
            Detail::Full | Detail::Motion => return None,
            Detail::Resultants => false,
            Detail::Stresses => true,
        };
        let zero = engine.h.constant(0.0);
        let first = |node: usize| {
            let mut elements = model.each_element();
            elements.find(|(_, _, a, _)| *a == node).map(|(.., element)| element)
        };
        let guides = engine.numbers.guides.iter().enumerate();
        let guides = guides.filter_map(|(k, g)| Some((first(g.node)?, ForceSource::Guide(k))));
        let loads = model.loads.iter().enumerate().filter_map(|(k, load)| match &load.kind {
            LoadAction::Point { point, .. } => Some((first(point.node)?, ForceSource::Load(k))),
            _ => None,
        });
        let shares = |load: &LoadAction| match load {
            LoadAction::Dead { .. } => vec![[[zero; 4]; 2]; engine.start.len()],
            _ => Vec::new(),
        };
        Some(Self {
            found: RunForces::new(model, stresses, zero),
            models: vec![None; S::LANES],
            gravity: vec![[zero; 2]; model.loads.len()],
            shares: model.loads.iter().map(|load| shares(&load.kind)).collect(),
            inside: guides.chain(loads).collect(),
        })
    }

    /// Begins a run in a lane.
    pub fn begin(&mut self, lane: usize, model: &'m Model) {
        self.found.begin(lane, model);
        self.models[lane] = Some(model);
        for (k, load) in model.loads.iter().enumerate() {
            match &load.kind {
                LoadAction::Gravity { acceleration } => {
                    for (mine, g) in self.gravity[k].iter_mut().zip(acceleration) {
                        mine.set_lane(lane, mine.constant(*g), lane);
                    }
                }
                LoadAction::Dead { shares, .. } => {
                    let set = |mine: &mut [[S; 4]; 2], share: &[[f64; 4]; 2]| {
                        let both = mine.as_flattened_mut().iter_mut().zip(share.as_flattened());
                        both.for_each(|(x, own)| x.set_lane(lane, x.constant(*own), lane));
                    };
                    self.shares[k].iter_mut().for_each(|mine| set(mine, &[[0.0; 4]; 2]));
                    for (_, _, node, element) in model.each_element() {
                        for (_, share) in shares.iter().filter(|(a, _)| *a == node) {
                            set(&mut self.shares[k][element], share);
                        }
                    }
                }
                _ => {}
            }
        }
    }

    /// The section forces of a lane's run.
    pub fn end(&self, lane: usize) -> Vec<percuss::SectionForceSummary> {
        self.found.end(lane)
    }

    /// Records the current step, which begins at `start`, in the lanes of the mask `go`; steps as short as an impact interval have impulses and no
    /// forces.
    #[inline(always)]
    pub fn take(&mut self, engine: &Engine<S>, start: S, go: Option<S::Mask>) {
        let impulsive = engine.h.less(engine.numbers.step * IMPULSIVE);
        let go = go.map_or(!impulsive, |go| go & !impulsive);
        engine.h.apart(TakeStep { sections: self, engine, time: start + engine.h, go });
    }

    #[inline(always)]
    fn take_all(&mut self, engine: &Engine<S>, time: S, go: S::Mask) {
        let zero = engine.h.constant(0.0);
        let mut gravity = [zero; 2];
        for (own, factor) in self.gravity.iter().zip(&engine.load_factors) {
            gravity = array(|i| gravity[i] + own[i] * *factor);
        }
        let mut element = 0;
        for (number, span) in engine.numbers.spans.iter().enumerate() {
            for k in 0..span.count {
                let mut acting = engine.acting(span, k, element, gravity);
                for (shares, factor) in self.shares.iter().zip(&engine.load_factors) {
                    if let Some(share) = shares.get(element) {
                        take_load(&mut acting, share, *factor);
                    }
                }
                let at = ElementPlace { beam: span.beam, span: number, k, element };
                let mut smooth = go;
                if self.inside.iter().any(|(inside, _)| *inside == element) {
                    smooth = self.take_forced(engine, at, &acting, (time, go));
                }
                self.found.take(at, &acting, time, smooth);
                element += 1;
            }
        }
    }

    /// Records an element in those lanes of the mask `go` in which a force acts inside it; returns the other lanes.
    fn take_forced(
        &mut self,
        engine: &Engine<S>,
        at: ElementPlace,
        acting: &ElementActing<S>,
        (time, go): (S, S::Mask),
    ) -> S::Mask {
        let mut smooth = [false; 64];
        for lane in (0..S::LANES).filter(|lane| go.lane(*lane)) {
            let Some(model) = self.models[lane] else { continue };
            let own = self.inside.iter().filter(|(element, _)| *element == at.element);
            let forces = own.filter_map(|(_, source)| {
                let (point, force) = acts(engine, model, *source, lane)?;
                ForceInside::at(model, point, force)
            });
            let forces: Vec<ForceInside> = forces.collect();
            smooth[lane] = forces.is_empty();
            if !forces.is_empty() {
                self.found.take_forced(lane, at, acting, time.lane(lane), forces.into_iter());
            }
        }
        time.mask(|lane| smooth[lane])
    }
}

/// Place and value of a force inside an element in a lane's run in the current step \[N\], if it acts.
fn acts<'m, S: Number>(
    engine: &Engine<S>,
    model: &'m Model,
    source: ForceSource,
    lane: usize,
) -> Option<(&'m MaterialPoint, [f64; 2])> {
    let (point, force) = match source {
        ForceSource::Guide(k) => {
            let (state, projectile) = (&engine.guides[k], &model.projectiles[k]);
            let push = state.force + state.impulse / engine.h;
            (&projectile.point, scale(push.lane(lane), projectile.direction))
        }
        ForceSource::Load(k) => match &model.loads[k].kind {
            LoadAction::Point { point, force, .. } => {
                (point, scale(engine.load_factors[k].lane(lane), *force))
            }
            _ => return None,
        },
    };
    (force != [0.0; 2]).then_some((point, force))
}

/// Subtracts the distributed loads of an element from the forces of its neighbours and its inertia.
#[inline(always)]
fn take_load<S: Number>(acting: &mut ElementActing<S>, share: &[[S; 4]; 2], factor: S) {
    for (node, share) in share.iter().enumerate() {
        for (i, share) in share.iter().enumerate() {
            let force = *share * factor;
            acting.ends[node][i] = acting.ends[node][i] - force;
            acting.along[node][i] = acting.along[node][i] - force;
        }
    }
}

/// See [`Sections::take`].
struct TakeStep<'a, 'm, S: Number> {
    sections: &'a mut Sections<'m, S>,
    engine: &'a Engine<S>,
    time: S,
    go: S::Mask,
}

impl<S: Number> Task for TakeStep<'_, '_, S> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        self.sections.take_all(self.engine, self.time, self.go);
    }
}

impl<S: Number> Engine<S> {
    /// Forces on an element in the current step, for the given acceleration of gravity \[m/s^2\].
    #[inline(always)]
    fn acting(
        &self,
        span: &SpanNumbers<S>,
        k: usize,
        element: usize,
        gravity: [S; 2],
    ) -> ElementActing<S> {
        let (a, table) = (span.first + k, span.table(k));
        let mut ends = self.internal_force(span, k, element);
        let rates =
            [self.beyond_gravity(span, a, gravity), self.beyond_gravity(span, a + 1, gravity)];
        let zero = self.h.constant(0.0);
        let mut along = [[zero; 4]; 2];
        let [on_a, on_b] = &mut along;
        table.add_inertia(&rates[0], &rates[1], on_a, on_b);
        for (end, along) in ends.iter_mut().zip(&along) {
            for i in 0..4 {
                end[i] += along[i];
            }
        }
        let (fa, fb) = (&self.numbers.nodes[a], &self.numbers.nodes[a + 1]);
        let (ma, mb) = (self.half_way(a), self.half_way(a + 1));
        ElementActing {
            tangents: [[fa[2] + ma[2], fa[3] + ma[3]], [fb[2] + mb[2], fb[3] + mb[3]]],
            chord: array(|i| (fb[i] - fa[i]) + (mb[i] - ma[i])),
            length: table.length,
            ends,
            along,
        }
    }

    /// Acceleration of a node of a span in the equation of motion, less that of gravity.
    #[inline(always)]
    fn beyond_gravity(&self, span: &SpanNumbers<S>, n: usize, gravity: [S; 2]) -> [S; 4] {
        let mut acceleration = self.inertia_in(span, n);
        for i in 0..2 {
            acceleration[i] = acceleration[i] - gravity[i];
        }
        acceleration
    }

    /// Displacements of a node in the middle of the step.
    #[inline(always)]
    fn half_way(&self, n: usize) -> [S; 4] {
        let mut moved = self.displacement[n];
        for i in 0..4 {
            moved[i] += self.increment[n][i] * 0.5;
        }
        moved
    }
}
