//! A uniform span struck at its middle (a cantilever: at its tip), as one spring and one mass.

/// How a span is held.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpanKind {
    /// Both ends free to turn; struck in the middle.
    Pinned,
    /// Both ends held against turning; struck in the middle.
    Clamped,
    /// One end held against turning, the other free; struck at the free end.
    Cantilever,
}

/// A uniform Bernoulli span.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// How it is held.
    pub kind: SpanKind,
    /// Length L \[m\].
    pub length: f64,
    /// Bending stiffness EI \[N m^2\].
    pub bending: f64,
    /// Mass per length rhoA \[kg/m\].
    pub mass: f64,
}

/// A mass that strikes a span and stays on it, by Cox.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cox {
    /// Velocity of both right after the impact \[m/s\].
    pub velocity: f64,
    /// Largest deflection of the struck point \[m\].
    pub deflection: f64,
    /// Largest bending moment, of the static force that bends the span as far \[N m\].
    pub moment: f64,
}

impl SpanKind {
    /// `k L^3 / (EI)`.
    fn stiffness(self) -> f64 {
        match self {
            Self::Pinned => 48.0,
            Self::Clamped => 192.0,
            Self::Cantilever => 3.0,
        }
    }

    /// Share of the span's mass that moves with the struck point.
    fn mass(self) -> f64 {
        match self {
            Self::Pinned => 17.0 / 35.0,
            Self::Clamped => 13.0 / 35.0,
            Self::Cantilever => 33.0 / 140.0,
        }
    }
}

impl Span {
    /// Static stiffness of the struck point \[N/m\]: 48, 192 or 3 `EI/L^3`.
    pub fn stiffness(&self) -> f64 {
        self.kind.stiffness() * self.bending / self.length.powi(3)
    }

    /// Reduced mass of the span \[kg\]: that which has the span's kinetic energy when all of it moves in the shape of its static
    /// deflection under a force at the struck point. 17/35, 13/35 or 33/140 of the span's mass (H. Cox, On impact on elastic
    /// beams, Transactions of the Cambridge Philosophical Society 9, 1849).
    pub fn reduced_mass(&self) -> f64 {
        self.kind.mass() * self.mass * self.length
    }

    /// Static deflection of the struck point under a force per length \[N/m\] all along: 5/384, 1/384 or 1/8 `q L^4/EI`.
    pub fn sag(&self, load: f64) -> f64 {
        let factor = match self.kind {
            SpanKind::Pinned => 5.0 / 384.0,
            SpanKind::Clamped => 1.0 / 384.0,
            SpanKind::Cantilever => 1.0 / 8.0,
        };
        factor * load * self.length.powi(4) / self.bending
    }

    /// Compliance of the struck point by shear over that by bending, for a shear stiffness `kappa G A` \[N\]: 12, 48 or 3
    /// `EI/(kappa G A L^2)`, of the deflections `F L/(4 S)`, `F L/(4 S)` and `F L/S` by shear.
    pub fn shear_share(&self, shear: f64) -> f64 {
        let factor = match self.kind {
            SpanKind::Pinned => 12.0,
            SpanKind::Clamped => 48.0,
            SpanKind::Cantilever => 3.0,
        };
        factor * self.bending / (shear * self.length.powi(2))
    }

    /// Largest bending moment under a force at the struck point \[N m\]: 1/4, 1/8 or 1 `F L`.
    pub fn moment(&self, force: f64) -> f64 {
        let factor = match self.kind {
            SpanKind::Pinned => 0.25,
            SpanKind::Clamped => 0.125,
            SpanKind::Cantilever => 1.0,
        };
        factor * force * self.length
    }

    /// Period of the lowest mode \[s\]: `2 pi / w` with `w = (3.14159, 4.73004, 1.87510)^2 sqrt(EI/rhoA)/L^2`.
    pub fn period(&self) -> f64 {
        let root = match self.kind {
            SpanKind::Pinned => std::f64::consts::PI,
            SpanKind::Clamped => 4.730_040_744_862_704,
            SpanKind::Cantilever => 1.875_104_068_711_961_2,
        };
        let frequency = root * root * (self.bending / self.mass).sqrt() / self.length.powi(2);
        2.0 * std::f64::consts::PI / frequency
    }

    /// A mass \[kg\] that strikes at `speed` \[m/s\] and stays on: momentum is kept by it and the reduced mass of the span, then
    /// their kinetic energy bends the span. Gravity takes no part.
    pub fn cox(&self, mass: f64, speed: f64) -> Cox {
        let moving = mass + self.reduced_mass();
        let velocity = speed * mass / moving;
        let deflection = velocity * (moving / self.stiffness()).sqrt();
        Cox { velocity, deflection, moment: self.moment(self.stiffness() * deflection) }
    }
}

/// Impact factor of a weight that falls from `height` \[m\] on a spring without mass, which it would compress by
/// `static_deflection` \[m\] if laid on gently: the largest deflection is `1 + sqrt(1 + 2 height / static_deflection)` times
/// that (energies before and after; Young's Lectures, 1807). Two for a weight let go at the spring.
pub fn impact_factor(height: f64, static_deflection: f64) -> f64 {
    1.0 + (1.0 + 2.0 * height / static_deflection).sqrt()
}

#[cfg(test)]
mod tests {
    use super::super::near;
    use super::*;

    fn unit(kind: SpanKind) -> Span {
        Span { kind, length: 1.0, bending: 1.0, mass: 1.0 }
    }

    /// Static deflection over the length under a unit force at the struck point (half the span where it is symmetrical).
    fn shape(kind: SpanKind, s: f64) -> f64 {
        match kind {
            SpanKind::Pinned => s * (0.75 - s * s) / 12.0,
            SpanKind::Clamped => s * s * (0.75 - s) / 12.0,
            SpanKind::Cantilever => s * s * (3.0 - s) / 6.0,
        }
    }

    #[test]
    fn reduced_masses_are_those_of_the_static_deflection() {
        for kind in [SpanKind::Pinned, SpanKind::Clamped, SpanKind::Cantilever] {
            let (end, halves) = if kind == SpanKind::Cantilever { (1.0, 1.0) } else { (0.5, 2.0) };
            let n = 20_000;
            let at = |k: usize| end * (k as f64 + 0.5) / f64::from(n);
            let squares: f64 = (0..n as usize).map(|k| shape(kind, at(k)).powi(2)).sum();
            let most = shape(kind, end);
            let mass = halves * squares * end / f64::from(n) / (most * most);
            near(unit(kind).reduced_mass(), mass, 1e-8);
            near(1.0 / unit(kind).stiffness(), most, 1e-14);
        }
    }

    /// Saint-Venant's series, with all modes of the span and the mass on it (closed form, benchmark E6): largest deflection
    /// in v L^2 sqrt(rhoA/EI). Cox' formula is known to lie within one per cent.
    #[test]
    fn cox_is_within_a_per_cent_of_saint_venant() {
        let cases = [
            (SpanKind::Pinned, 1.0, 0.119_323_77),
            (SpanKind::Pinned, 2.0, 0.182_183_75),
            (SpanKind::Clamped, 1.0, 0.061_866_62),
        ];
        for (kind, ratio, deflection) in cases {
            near(unit(kind).cox(ratio, 1.0).deflection, deflection, 0.01);
        }
    }

    #[test]
    fn cox_keeps_momentum_and_then_energy() {
        let span = Span { kind: SpanKind::Pinned, length: 4.0, bending: 3e5, mass: 80.0 };
        let cox = span.cox(150.0, 6.0);
        let moving = 150.0 + span.reduced_mass();
        near(moving * cox.velocity, 150.0 * 6.0, 1e-15);
        let bent = 0.5 * span.stiffness() * cox.deflection.powi(2);
        near(bent, 0.5 * moving * cox.velocity.powi(2), 1e-14);
        near(cox.moment, span.stiffness() * cox.deflection, 1e-15);
    }

    #[test]
    fn a_weight_let_go_bends_twice_as_far_as_at_rest_and_a_dropped_one_by_its_energy() {
        assert_eq!(impact_factor(0.0, 0.01), 2.0);
        let (weight, stiffness, height) = (50.0, 2e4, 0.3);
        let static_deflection = weight / stiffness;
        let deflection = static_deflection * impact_factor(height, static_deflection);
        near(weight * (height + deflection), 0.5 * stiffness * deflection.powi(2), 1e-14);
    }

    /// A full rectangle of depth L/1.33 gives way 2.8 times as far between pins as Bernoulli's beam.
    #[test]
    fn a_stocky_beam_gives_way_mostly_by_shear() {
        let (length, depth) = (1.0, 1.0 / 1.33);
        let axial = 1e9;
        let bending = axial * depth * depth / 12.0;
        let span = Span { kind: SpanKind::Pinned, length, bending, mass: 1.0 };
        near(1.0 + span.shear_share(super::super::shear_stiffness(axial)), 2.764, 1e-3);
    }

    /// Lowest roots of `cos x cosh x = 1` and `cos x cosh x = -1`.
    #[test]
    fn periods_are_those_of_the_frequency_equations() {
        let root = |kind: SpanKind| (2.0 * std::f64::consts::PI / unit(kind).period()).sqrt();
        let clamped = root(SpanKind::Clamped);
        assert!((clamped.cos() * clamped.cosh() - 1.0).abs() < 1e-12);
        let free = root(SpanKind::Cantilever);
        assert!((free.cos() * free.cosh() + 1.0).abs() < 1e-12);
        near(root(SpanKind::Pinned), std::f64::consts::PI, 1e-15);
    }

    /// A sixteenth of the load on each of sixteen places, by the influence lines of the struck point.
    #[test]
    fn sags_are_sums_of_influences() {
        for kind in [SpanKind::Pinned, SpanKind::Clamped, SpanKind::Cantilever] {
            let (end, halves) = if kind == SpanKind::Cantilever { (1.0, 1.0) } else { (0.5, 2.0) };
            let n = 10_000_u32;
            let sum: f64 =
                (0..n).map(|k| shape(kind, end * (f64::from(k) + 0.5) / f64::from(n))).sum();
            near(unit(kind).sag(1.0), halves * sum * end / f64::from(n), 1e-7);
        }
    }
}
