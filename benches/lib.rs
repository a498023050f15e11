//! Scenes the benchmarks share.

use percuss::*;

/// The paper's elastic example, clamped, with any number of elements.
///
/// # Panics
/// Never: the definitions are valid.
pub fn elastic_example(elements: usize) -> Model {
    varied(elements, Addition::None)
}

/// The elastic example with a rigid projectile.
///
/// # Panics
/// If `restitution` is not a coefficient of restitution.
pub fn rigid_example(elements: usize, restitution: f64) -> Model {
    struck(elements, Addition::None, ProjectileKind::Rigid { restitution })
}

/// Variants of the paper's rigid example, which differ in speed, mass and restitution.
///
/// # Panics
/// Never: the definitions are valid.
pub fn rigid_study(count: usize) -> Vec<Model> {
    let share = |k: usize, step: f64| (k as f64 * step).fract();
    let model = |k: usize| {
        let mut b = ModelBuilder::new();
        let material = b.material(Material::new("stiff", 0.2e12, 3e3));
        let section = b.section(Section::new("plank", 0.1, 8.33e-5));
        let girder = b.beam(Beam::new("girder", &[[0.0, 0.0], [3.0, 0.0]], 6, material, section));
        let at = |label: &str, f| PointRef {
            label: label.into(),
            beam: girder,
            along: Along::Fraction(f),
        };
        for (name, f) in [("left", 0.0), ("right", 1.0)] {
            b.support(Support::new(name, at(name, f), SupportKind::Clamp));
        }
        let kind = ProjectileKind::Rigid { restitution: share(k, 0.754_877_666) };
        let mass = 50.0 + 150.0 * share(k, 0.618_033_989);
        let speed = 20.0 + 40.0 * share(k, 0.569_840_291);
        let hammer = Projectile::new("hammer", kind, mass, [0.0, -speed], at("mid", 0.5));
        b.projectile(Projectile { standoff: 0.02, ..hammer });
        b.build().expect("a valid scene")
    };
    (0..count).map(model).collect()
}

/// Property in which a run differs from the elastic example.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Addition {
    /// Nothing.
    None,
    /// Gravity.
    Gravity,
    /// Damping of the material.
    Damped,
    /// A tenth of the depth: elements long against their radius of gyration.
    Slender,
    /// No supports.
    Unsupported,
    /// A section with a depth, for which stresses are computed.
    Deep,
    /// A section with a depth, of a material with a low yield stress.
    Yielding,
    /// Sections that turn by themselves.
    Shear,
}

/// The elastic example with another property.
///
/// # Panics
/// Never: the definitions are valid.
pub fn varied(elements: usize, addition: Addition) -> Model {
    struck(elements, addition, ProjectileKind::spring(7.5e5))
}

/// The clamped plank, struck at midspan.
fn struck(elements: usize, addition: Addition, kind: ProjectileKind) -> Model {
    let mut b = ModelBuilder::new();
    let (retardation, mass_damping) =
        if addition == Addition::Damped { (1e-5, 1.0) } else { (0.0, 0.0) };
    let composite = Material::new("composite", 0.2e10, 3e3);
    let curve = vec![Hardening { from: 0.0, stress: 30e6, modulus: 2e7 }];
    let law = Plasticity { curve, kinematic: 0.0, overstress: None, failure_strain: None };
    let inelasticity = (addition == Addition::Yielding).then_some(Inelasticity::Plastic(law));
    let poisson = (addition == Addition::Shear).then_some(0.3);
    let material =
        b.material(Material { retardation, mass_damping, inelasticity, poisson, ..composite });
    let section = b.section(match addition {
        Addition::Deep | Addition::Yielding => Section::rectangle("plank", 1.0, 0.1),
        Addition::Slender => Section::new("plank", 0.1, 8.33e-7),
        Addition::Shear => {
            Section { shear_factor: Some(0.85), ..Section::new("plank", 0.1, 8.33e-5) }
        }
        _ => Section::new("plank", 0.1, 8.33e-5),
    });
    let points = vec![[0.0, 0.0], [3.0, 0.0]];
    let theory = if addition == Addition::Shear { Theory::Shear } else { Theory::Slender };
    let girder =
        b.beam(Beam { theory, ..Beam::new("girder", &points, elements, material, section) });
    let at =
        |label: &str, f| PointRef { label: label.into(), beam: girder, along: Along::Fraction(f) };
    let ends =
        if addition == Addition::Unsupported { &[][..] } else { &[("left", 0.0), ("right", 1.0)] };
    for &(name, f) in ends {
        b.support(Support::new(name, at(name, f), SupportKind::Clamp));
    }
    b.projectile(Projectile {
        name: "mass".into(),
        kind,
        mass: 500.0,
        velocity: [0.0, 20.0],
        direction: None,
        strikes: at("girder.mid", 0.5),
        standoff: 0.2,
        rear: None,
        local_mass: 0.0,
    });
    if addition == Addition::Gravity {
        let acceleration = [0.0, -9.81];
        b.load(Load::new("gravity", LoadKind::Gravity { acceleration }));
    }
    b.build().expect("a valid scene")
}

/// A clamped beam that oscillates 1 m above a floor; several points of each element have a contact pair of their own.
///
/// # Panics
/// Never: the definitions are valid.
pub fn above_floor(elements: usize, points_per_element: usize) -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("composite", 0.2e10, 3e3));
    let section = b.section(Section { depth: Some(0.1), ..Section::new("plank", 0.1, 8.33e-5) });
    let points = vec![[0.0, 0.0], [3.0, 0.0]];
    let girder = b.beam(Beam::new("girder", &points, elements, material, section));
    for (name, f) in [("left", 0.0), ("right", 1.0)] {
        let at = PointRef { label: name.into(), beam: girder, along: Along::Fraction(f) };
        b.support(Support::new(name, at, SupportKind::Clamp));
    }
    if points_per_element > 0 {
        let floor = b.obstacle(Obstacle {
            name: "floor".into(),
            shape: ObstacleShape::HalfPlane { point: [0.0, -1.0], normal: [0.0, 1.0] },
            motion: None,
        });
        let law = TouchLaw::Smooth(SmoothLaw::elastic(Potential::Linear { stiffness: 1e6 }));
        let between = [ContactPartner::Beam(girder), ContactPartner::Obstacle(floor)];
        b.contact(Contact { points_per_element, ..Contact::new("floor", between, law) });
    }
    let kind = LoadKind::Gravity { acceleration: [0.0, -9.81] };
    b.load(Load::new("gravity", kind));
    b.build().expect("a valid scene")
}

/// Discs that slide along a clamped beam of 60 elements, pressed on by their weight, or at the given distance above it \[m\].
///
/// # Panics
/// Never: the definitions are valid.
pub fn sliding_discs(count: usize, above: f64) -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("composite", 0.2e10, 3e3));
    let section = b.section(Section { depth: Some(0.1), ..Section::new("plank", 0.1, 8.33e-5) });
    let girder = b.beam(Beam::new("girder", &[[0.0, 0.0], [10.0, 0.0]], 60, material, section));
    for (name, f) in [("left", 0.0), ("right", 1.0)] {
        let at = PointRef { label: name.into(), beam: girder, along: Along::Fraction(f) };
        b.support(Support::new(name, at, SupportKind::Clamp));
    }
    let (stiffness, mass, radius) = (1e6, 10.0, 0.02);
    for k in 0..count {
        let disc = b.disc(Disc {
            name: format!("disc {k}"),
            mass,
            inertia: None,
            radius,
            position: [0.5 + 8.0 * k as f64 / count as f64, 0.05 + radius + above],
            velocity: [1.0, 0.0],
            spin: 0.0,
        });
        let law = TouchLaw::Smooth(SmoothLaw::elastic(Potential::Linear { stiffness }));
        b.contact(Contact::new(
            format!("contact {k}"),
            [ContactPartner::Disc(disc), ContactPartner::Beam(girder)],
            law,
        ));
    }
    let kind = LoadKind::Gravity { acceleration: [0.0, -9.81] };
    b.load(Load::new("gravity", kind));
    b.build().expect("a valid scene")
}

/// A frame of storeys and bays of 3 m, `elements` in each member, joints rigid and feet clamped, its lowest left column struck.
///
/// # Panics
/// Never: the definitions are valid.
pub fn frame(storeys: usize, bays: usize, elements: usize) -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("composite", 0.2e10, 3e3));
    let section = b.section(Section::new("plank", 0.1, 8.33e-5));
    let at =
        |label: &str, beam, f| PointRef { label: label.into(), beam, along: Along::Fraction(f) };
    let corner = |bay: usize, level: usize| [3.0 * bay as f64, 3.0 * level as f64];
    let mut member =
        |name: String, from, to| b.beam(Beam::new(name, &[from, to], elements, material, section));
    let mut columns = Vec::new();
    for bay in 0..=bays {
        let column = |level| {
            member(format!("column {bay} {level}"), corner(bay, level), corner(bay, level + 1))
        };
        columns.push((0..storeys).map(column).collect::<Vec<_>>());
    }
    let mut girders = Vec::new();
    for bay in 0..bays {
        let girder = |level: usize| {
            let (from, to) = (corner(bay, level + 1), corner(bay + 1, level + 1));
            member(format!("girder {bay} {level}"), from, to)
        };
        girders.push((0..storeys).map(girder).collect::<Vec<_>>());
    }
    for (bay, column) in columns.iter().enumerate() {
        let foot = at("foot", column[0], 0.0);
        b.support(Support::new(format!("foot {bay}"), foot, SupportKind::Clamp));
        for level in 0..storeys {
            let mut others = Vec::new();
            others.extend(column.get(level + 1).map(|c| (*c, 0.0)));
            others.extend(girders.get(bay).map(|g| (g[level], 0.0)));
            others.extend(bay.checked_sub(1).map(|left| (girders[left][level], 1.0)));
            for (k, (other, f)) in others.into_iter().enumerate() {
                let between = [at("top", column[level], 1.0), at("end", other, f)];
                let name = format!("joint {bay} {level} {k}");
                b.joint(Joint::new(name, JointKind::Rigid, between));
            }
        }
    }
    b.projectile(Projectile {
        name: "mass".into(),
        kind: ProjectileKind::spring(7.5e5),
        mass: 500.0,
        velocity: [20.0, 0.0],
        direction: None,
        strikes: at("struck", columns[0][0], 0.5),
        standoff: 0.2,
        rear: None,
        local_mass: 0.0,
    });
    b.build().expect("a valid scene")
}
