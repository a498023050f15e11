//! Loads of the frozen model.

use super::point::MaterialPoint;
use super::time_function::PreparedFunction;

/// A load and its time function.
#[derive(Clone, Debug)]
pub struct LoadData {
    pub name: String,
    pub kind: LoadAction,
    pub function: PreparedFunction,
    /// Whether it is the acceleration of the base, against which the motion is described.
    pub base: bool,
    pub from: f64,
    pub until: f64,
}

/// Nodal forces of a load for a factor of one.
#[derive(Clone, Debug)]
pub enum LoadAction {
    /// Acceleration of everything that has mass: by gravity, or against a base that is accelerated the other way.
    Gravity {
        /// The acceleration, shape (2) \[m/s^2\].
        acceleration: [f64; 2],
    },
    /// A force, dead or along (tangent, normal), and a moment.
    Point {
        point: MaterialPoint,
        /// The force, shape (2) \[N\].
        force: [f64; 2],
        moment: f64,
        follower: bool,
    },
    /// Nodal forces of a dead distributed load, and each element's share of them, by its node a.
    Dead {
        /// Forces on values and slopes of nodes, shape (nodes of the load, 4) \[index of a node, N, N m\].
        nodal: Vec<(usize, [f64; 4])>,
        /// Share of each element, by its node a, shape (elements of the load, 2, 4) \[index of a node, N, N m\].
        shares: Vec<(usize, [[f64; 4]; 2])>,
    },
    /// Strains that elements would have without forces.
    Strain {
        /// The elements, shape (elements of the load).
        elements: Vec<StrainedElement>,
        /// The change of temperature that gives them, if that does \[K\].
        change: Option<f64>,
    },
    /// Forces per length along (tangent, normal) at quadrature points.
    Follower {
        /// The points, shape (points).
        points: Vec<FollowerPoint>,
    },
}

/// An element with given strains.
#[derive(Clone, Copy, Debug)]
pub struct StrainedElement {
    /// Its node a.
    pub node: usize,
    /// Its number among all elements.
    pub element: usize,
    /// Membrane strain without forces \[-\].
    pub strain: f64,
    /// Bending strain without forces, positive where it stretches the left side of the beam \[1/m\].
    pub bending: f64,
}

/// A quadrature point of a follower load.
#[derive(Clone, Debug)]
pub struct FollowerPoint {
    pub point: MaterialPoint,
    /// Force per length times the weight of the point, along (tangent, normal), shape (2) \[N\].
    pub force: [f64; 2],
}

impl LoadData {
    /// Whether it acts throughout, as it is.
    pub fn is_steady(&self) -> bool {
        self.function.is_constant() && self.from <= 0.0 && self.until == f64::INFINITY
    }

    /// Mean factor over the step `[start, start + h]`: its impulse is exact.
    pub fn factor(&self, start: f64, h: f64) -> f64 {
        let share = share(self.from, self.until, start, h);
        if share == 0.0 {
            return 0.0;
        }
        let (lo, hi) = (self.from.max(start), self.until.min(start + h));
        let (lo, length) = if share == 1.0 { (start, h) } else { (lo, hi - lo) };
        share * self.function.mean(lo - self.from, length)
    }

    /// Factor at an instant after the start.
    pub fn factor_at(&self, time: f64) -> f64 {
        let acts = time >= self.from && time <= self.until;
        if acts { self.function.value(time - self.from) } else { 0.0 }
    }

    /// Factor at the start of a run, from the right.
    pub fn factor_at_start(&self) -> f64 {
        if self.from > 0.0 || self.until <= 0.0 { 0.0 } else { self.function.value(-self.from) }
    }
}

/// Share of the step `[start, start + h]` in which a load that acts in `[from, until]` acts.
pub fn share(from: f64, until: f64, start: f64, h: f64) -> f64 {
    // Ends of steps are sums of steps: a difference of some ulps is the same instant.
    let slack = 1e-9 * h;
    let lo = from.max(start);
    let hi = until.min(start + h);
    let share = (hi - lo) / h;
    if from <= start + slack && until >= start + h - slack { 1.0 } else { share.clamp(0.0, 1.0) }
}
