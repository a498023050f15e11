//! Structures of the cases, built with the library.

use percuss::*;

/// A single beam under construction, with one material and one section.
#[derive(Clone, Debug)]
pub struct Single {
    /// Start and end, shape (2, 2) \[m\].
    pub points: [[f64; 2]; 2],
    /// Number of elements.
    pub elements: usize,
    /// Young's modulus \[Pa\].
    pub young: f64,
    /// Density \[kg/m^3\].
    pub density: f64,
    /// Area \[m^2\].
    pub area: f64,
    /// Second moment of area \[m^4\].
    pub inertia: f64,
    /// Rotary inertia.
    pub rotary: RotaryInertia,
    /// Strain measure.
    pub strain: StrainMeasure,
    /// Supports as (fraction of the length, kind), shape (supports) \[-\].
    pub supports: Vec<(f64, SupportKind)>,
    /// Projectiles as (fraction of the length, definition), shape (projectiles).
    pub projectiles: Vec<Shot>,
    /// Loads; [`LoadKind::Point`] acts at the fraction given, shape (loads) \[-\].
    pub loads: Vec<(f64, Load)>,
}

/// A projectile and its struck point.
#[derive(Clone, Debug)]
pub struct Shot {
    /// Fraction of the beam's length.
    pub at: f64,
    /// Elastic or rigid.
    pub kind: ProjectileKind,
    /// Mass \[kg\].
    pub mass: f64,
    /// Velocity, shape (2) \[m/s\].
    pub velocity: [f64; 2],
    /// Line of motion, where the velocity is zero, shape (2) \[-\].
    pub direction: Option<[f64; 2]>,
    /// Initial gap \[m\].
    pub standoff: f64,
}

/// The paper's beam, 3 m long, with the material of the first example by default.
pub fn paper_beam(elements: usize) -> Single {
    Single {
        points: [[0.0, 0.0], [3.0, 0.0]],
        elements,
        young: 0.2e10,
        density: 3000.0,
        area: 0.1,
        inertia: 8.33e-5,
        rotary: RotaryInertia::Density,
        strain: StrainMeasure::Green,
        supports: Vec::new(),
        projectiles: Vec::new(),
        loads: Vec::new(),
    }
}

/// The paper's elastic projectile.
pub fn paper_elastic() -> Shot {
    Shot {
        at: 0.5,
        kind: ProjectileKind::spring(7.5e5),
        mass: 500.0,
        velocity: [0.0, 20.0],
        direction: None,
        standoff: 0.2,
    }
}

/// The paper's rigid projectile with a coefficient of restitution.
pub fn paper_rigid(restitution: f64) -> Shot {
    Shot {
        at: 0.5,
        kind: ProjectileKind::Rigid { restitution },
        mass: 100.0,
        velocity: [0.0, -40.0],
        direction: None,
        standoff: 0.02,
    }
}

impl Single {
    /// Clamps both ends.
    pub fn clamped(mut self) -> Self {
        self.supports = vec![(0.0, SupportKind::Clamp), (1.0, SupportKind::Clamp)];
        self
    }

    /// Fixes every degree of freedom: a rigid body that cannot move (one element).
    pub fn held(mut self) -> Self {
        use Component::*;
        let all = || SupportKind::Fix {
            components: vec![Displacement1, Displacement2, Rotation, Stretch],
        };
        self.elements = 1;
        self.supports = vec![(0.0, all()), (1.0, all())];
        self
    }

    /// With another Young's modulus.
    pub fn young(mut self, young: f64) -> Self {
        self.young = young;
        self
    }

    /// Adds a projectile.
    pub fn struck(mut self, shot: Shot) -> Self {
        self.projectiles.push(shot);
        self
    }

    /// The frozen model; its beam is `beam`, its projectiles `shot0`, `shot1`, its ends are recorded.
    ///
    /// # Panics
    /// If the case itself is invalid.
    pub fn build(&self) -> Model {
        let mut b = ModelBuilder::new();
        let (young, density, strain) = (self.young, self.density, self.strain);
        let material = b.material(Material { strain, ..Material::new("material", young, density) });
        let section = b.section(Section {
            rotary_inertia: self.rotary,
            ..Section::new("section", self.area, self.inertia)
        });
        let beam = b.beam(Beam::new("beam", &self.points, self.elements, material, section));
        let at = |f: f64| PointRef { label: format!("beam@{f}"), beam, along: Along::Fraction(f) };
        for (i, (f, kind)) in self.supports.iter().enumerate() {
            b.support(Support::new(format!("support{i}"), at(*f), kind.clone()));
        }
        for (i, shot) in self.projectiles.iter().enumerate() {
            b.projectile(Projectile {
                name: format!("shot{i}"),
                kind: shot.kind.clone(),
                mass: shot.mass,
                velocity: shot.velocity,
                direction: shot.direction,
                strikes: at(shot.at),
                standoff: shot.standoff,
                rear: None,
                local_mass: 0.0,
            });
        }
        for (f, load) in &self.loads {
            let mut load = load.clone();
            if let LoadKind::Point { at: point, .. } = &mut load.kind {
                *point = at(*f);
            }
            b.load(load);
        }
        b.record_point(at(0.0));
        b.record_point(at(1.0));
        b.build().expect("a verification case builds")
    }
}

/// A point at a fraction of a beam.
pub fn at(label: &str, beam: BeamId, fraction: f64) -> PointRef {
    PointRef { label: label.into(), beam, along: Along::Fraction(fraction) }
}

/// Runs a model; a case that cannot run fails all its checks by NaN.
///
/// # Panics
/// If the case's settings are invalid.
pub fn run(model: &Model, settings: &Settings) -> RunSummary {
    simulate(model, settings, &mut NoRecorder).expect("a verification case has valid settings")
}

/// Impacts of a summary's first contact.
pub fn impacts(summary: &RunSummary) -> &[Impact] {
    match &summary.contacts[0].record {
        ContactRecord::Nonsmooth { impacts, .. } => impacts,
        ContactRecord::Smooth { .. } => &[],
    }
}

/// Peak force and closed intervals of a summary's first contact.
pub fn smooth(summary: &RunSummary) -> (Peak, &[ContactInterval]) {
    match &summary.contacts[0].record {
        ContactRecord::Smooth { peak_force, intervals } => (*peak_force, intervals),
        ContactRecord::Nonsmooth { .. } => (Peak::default(), &[]),
    }
}

/// Whether a run reached its end.
pub fn completed(summary: &RunSummary) -> bool {
    matches!(summary.termination, Termination::Completed)
}

/// Lee's frame: two legs with a rigid corner between pinned ends, and a unit load down.
pub fn lee(elements: usize, material: Material, section: Section, theory: Theory) -> Model {
    let mut b = ModelBuilder::new();
    let (material, section) = (b.material(material), b.section(section));
    let points = [[0.0, 0.0], [0.0, 120.0], [120.0, 120.0]];
    let slender = Beam::new("frame", &points, elements, material, section);
    let frame = b.beam(Beam { theory, ..slender });
    for (name, f) in [("foot", 0.0), ("wall", 1.0)] {
        b.support(Support::new(name, at(name, frame, f), SupportKind::Pin));
    }
    let along = Along::Distance(144.0);
    let point = PointRef { label: "load".into(), beam: frame, along };
    let (force, moment) = ([0.0, -1.0], 0.0);
    let kind = LoadKind::Point { at: point.clone(), force, moment, follower: false };
    b.load(Load::new("load", kind));
    b.record_point(point);
    b.build().expect("a verification case builds")
}

/// Value of an entry, NaN if it is missing: a check on it then fails.
pub fn or_nan(value: Option<f64>) -> f64 {
    value.unwrap_or(f64::NAN)
}
