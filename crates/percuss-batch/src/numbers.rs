//! The numbers of a run without its shape, which differ between the lanes of an ensemble.

use super::ground_springs::GroundSpringNumbers;
use percuss::StrainMeasure;
use percuss::internals::element::beam::ElementTable;
use percuss::internals::ledger::RoundOff;
use percuss::internals::model::frozen::{Constraint, MaterialPoint, PrescribedDofs, SpanFibres};

/// All numbers of a run of a given [`BatchShape`](super::shape::BatchShape).
#[derive(Clone, Debug)]
pub struct Numbers<S> {
    /// Step size \[s\].
    pub step: S,
    /// Spans of all beams, shape (spans).
    pub spans: Vec<SpanNumbers<S>>,
    /// Reference position and tangent of the beams' nodes, shape (beam nodes, 4) \[m, -\].
    pub nodes: Vec<[S; 4]>,
    /// Fixed components of nodes, shape (nodes held).
    pub prescribed: Vec<PrescribedDofs<S>>,
    /// Joints, and supports between nodes, shape (constraints).
    pub constraints: Vec<Constraint<S>>,
    /// Elastic supports and stops, one a direction, shape (springs to the ground).
    pub springs: Vec<GroundSpringNumbers<S>>,
    /// Guided projectiles, shape (guided projectiles).
    pub guides: Vec<GuideNumbers<S>>,
    /// Dead loads, shape (loads).
    pub loads: Vec<LoadNumbers<S>>,
    /// Recorded points, shape (recorded points).
    pub points: Vec<MaterialPoint<S>>,
    /// Round-off at the scale of the structure.
    pub round_off: RoundOff<S>,
    /// Total mass \[kg\].
    pub total_mass: S,
    /// Size of the structure \[m\].
    pub size: S,
}

/// A part of a beam.
#[derive(Clone, Debug)]
pub struct SpanNumbers<S> {
    /// First node.
    pub first: usize,
    /// Number of elements.
    pub count: usize,
    /// Its beam \[index of a beam\].
    pub beam: usize,
    /// Strain measure.
    pub measure: StrainMeasure,
    /// Retardation time of Kelvin and Voigt's damping \[s\], coefficient of mass-proportional damping \[1/s\].
    pub retardation: S,
    pub mass_damping: S,
    /// Whether there is damping.
    pub damped: bool,
    /// One table for all elements, or one for each, shape (1 or elements).
    pub tables: Vec<ElementTable<S>>,
    /// Fibres of its section, if any.
    pub fibres: Option<SpanFibres<S>>,
}

/// Contact law of a guided projectile.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GuideLaw {
    /// `k p`.
    Linear,
    /// `k p^(3/2)`.
    Hertz,
    /// Impulses by Newton's law.
    Rigid,
}

/// A guided projectile and the struck point.
#[derive(Clone, Debug)]
pub struct GuideNumbers<S> {
    /// Node `a` of the struck element.
    pub node: usize,
    /// Law of its contact.
    pub law: GuideLaw,
    /// Shape functions of the struck point, on (u_a, u_a', u_b, u_b'), shape (4) \[-, m, -, m\].
    pub shape: [S; 4],
    /// Reference position of the struck point, shape (2) \[m\].
    pub struck: [S; 2],
    /// Reference position of the projectile, shape (2) \[m\].
    pub position: [S; 2],
    /// Line of motion, unit vector towards the beam, shape (2) \[-\].
    pub direction: [S; 2],
    /// Gap in the reference configuration \[m\].
    pub standoff: S,
    /// Mass \[kg\].
    pub mass: S,
    /// Speed along the line of motion at the start \[m/s\].
    pub speed: S,
    /// Stiffness of the law \[N/m, N/m^(3/2)\]; zero of a rigid one.
    pub stiffness: S,
    /// Coefficient of restitution of a rigid contact \[-\]; zero of others.
    pub restitution: S,
    /// Factor of Hunt and Crossley's dissipation \[s/m\].
    pub dissipation: S,
    /// Whether there is dissipation.
    pub damped: bool,
}

/// A dead load, for a factor of one.
#[derive(Clone, Debug)]
pub struct LoadNumbers<S> {
    /// Loaded nodes, in increasing order, shape (nodes of the load) \[index of a node\].
    pub nodes: Vec<usize>,
    /// Forces on their values and slopes, shape (nodes of the load, 4) \[N, N m\].
    pub forces: Vec<[S; 4]>,
    /// Forces on the guided projectiles, by gravity, shape (guided projectiles, 2) \[N\].
    pub on_guides: Vec<[S; 2]>,
}

impl<S: Copy> Numbers<S> {
    /// The same with every number replaced, in a fixed order.
    pub fn map<T: Copy>(&self, f: &mut impl FnMut(S) -> T) -> Numbers<T> {
        Numbers {
            step: f(self.step),
            spans: self.spans.iter().map(|s| s.map(f)).collect(),
            nodes: self.nodes.iter().map(|x| x.map(&mut *f)).collect(),
            prescribed: self.prescribed.iter().map(|h| h.map(f)).collect(),
            constraints: self.constraints.iter().map(|c| c.map(f)).collect(),
            springs: self.springs.iter().map(|s| s.map(f)).collect(),
            guides: self.guides.iter().map(|g| g.map(f)).collect(),
            loads: self.loads.iter().map(|l| l.map(f)).collect(),
            points: self.points.iter().map(|p| p.map(f)).collect(),
            round_off: self.round_off.map(f),
            total_mass: f(self.total_mass),
            size: f(self.size),
        }
    }

    /// All numbers in that order.
    pub fn flat(&self) -> Vec<S> {
        let mut flat = Vec::new();
        self.map(&mut |x| flat.push(x));
        flat
    }

    /// The same shape with other numbers, in that order.
    pub fn with<T: Copy>(&self, flat: &[T]) -> Numbers<T> {
        let mut next = flat.iter();
        self.map(&mut |_| *next.next().expect("as many numbers as the shape has"))
    }
}

impl<S: Copy> SpanNumbers<S> {
    fn map<T: Copy>(&self, f: &mut impl FnMut(S) -> T) -> SpanNumbers<T> {
        let tables = self.tables.iter().map(|t| t.map(f)).collect();
        let (retardation, mass_damping) = (f(self.retardation), f(self.mass_damping));
        let Self { first, count, beam, measure, damped, .. } = *self;
        let fibres = self.fibres.as_ref().map(|fibres| fibres.map(f));
        SpanNumbers {
            first,
            count,
            beam,
            measure,
            retardation,
            mass_damping,
            damped,
            tables,
            fibres,
        }
    }

    /// Table of the element of number `k` in the span.
    #[inline(always)]
    pub fn table(&self, k: usize) -> &ElementTable<S> {
        &self.tables[if self.tables.len() == 1 { 0 } else { k }]
    }
}

impl<S: Copy> LoadNumbers<S> {
    fn map<T>(&self, f: &mut impl FnMut(S) -> T) -> LoadNumbers<T> {
        LoadNumbers {
            nodes: self.nodes.clone(),
            forces: self.forces.iter().map(|x| x.map(&mut *f)).collect(),
            on_guides: self.on_guides.iter().map(|x| x.map(&mut *f)).collect(),
        }
    }
}

impl<S: Copy> GuideNumbers<S> {
    fn map<T>(&self, f: &mut impl FnMut(S) -> T) -> GuideNumbers<T> {
        GuideNumbers {
            node: self.node,
            law: self.law,
            shape: self.shape.map(&mut *f),
            struck: self.struck.map(&mut *f),
            position: self.position.map(&mut *f),
            direction: self.direction.map(&mut *f),
            standoff: f(self.standoff),
            mass: f(self.mass),
            speed: f(self.speed),
            stiffness: f(self.stiffness),
            restitution: f(self.restitution),
            dissipation: f(self.dissipation),
            damped: self.damped,
        }
    }
}

/// What is done with each number of a part.
type Visit<'a> = dyn FnMut(f64) -> f64 + 'a;

impl Numbers<f64> {
    /// For every number, in the order of [`Self::flat`], the largest magnitude in its part: a span, the nodes, the springs, and so on.
    pub fn largest_of_their_kind(&self) -> Vec<f64> {
        let mut out = Vec::new();
        let mut part = |numbers: Vec<f64>| {
            let finite = numbers.iter().filter(|x| x.is_finite());
            let most = finite.fold(0.0, |most: f64, x| most.max(x.abs()));
            out.extend(numbers.iter().map(|_| most));
        };
        let list = |all: &dyn Fn(&mut Visit<'_>)| {
            let mut numbers = Vec::new();
            all(&mut |x| {
                numbers.push(x);
                x
            });
            numbers
        };
        part(vec![self.step]);
        for span in &self.spans {
            part(list(&|mut f| _ = span.map(&mut f)));
        }
        part(self.nodes.as_flattened().to_vec());
        part(list(&|mut f| self.prescribed.iter().for_each(|one| _ = one.map(&mut f))));
        part(list(&|mut f| self.constraints.iter().for_each(|one| _ = one.map(&mut f))));
        part(list(&|mut f| self.springs.iter().for_each(|one| _ = one.map(&mut f))));
        part(list(&|mut f| self.guides.iter().for_each(|one| _ = one.map(&mut f))));
        part(list(&|mut f| self.loads.iter().for_each(|one| _ = one.map(&mut f))));
        part(list(&|mut f| self.points.iter().for_each(|one| _ = one.map(&mut f))));
        part(list(&|mut f| _ = self.round_off.map(&mut f)));
        part(vec![self.total_mass]);
        part(vec![self.size]);
        out
    }
}
