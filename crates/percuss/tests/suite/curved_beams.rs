//! Curved beams at rest and slowly loaded: every step is solved at once, and the size of a scene and its place do not matter.

use crate::common;

use common::numbers::Numbers;
use common::*;
use percuss::*;

/// Random values of a scene; all lengths are multiplied by a factor, times too, so that stresses and strains do not change.
struct Scene {
    curve: Curve,
    points: Vec<[f64; 2]>,
    damping: [f64; 2],
    loaded: bool,
    start: Start,
    engineering: bool,
}

impl Scene {
    fn random(r: &mut Numbers) -> Self {
        let (turn, rise) = (r.between(0.0, std::f64::consts::TAU), r.between(0.1, 0.9));
        let place = |x: f64, y: f64| {
            let (sine, cosine) = turn.sin_cos();
            [cosine * x - sine * y, sine * x + cosine * y]
        };
        let curve = [Curve::Arc, Curve::Spline, Curve::Polyline][r.below(3)];
        let points = match curve {
            Curve::Arc => {
                vec![place(-0.8, 0.0), place(r.between(-0.2, 0.2), rise), place(0.8, 0.1)]
            }
            Curve::Spline => {
                [-0.9, -0.3, 0.2, 0.9].map(|x| place(x, r.between(-0.3, 0.3))).to_vec()
            }
            Curve::Polyline => vec![place(-0.8, 0.0), place(0.8, rise)],
        };
        let loaded = r.chance(0.75);
        Self {
            curve,
            points,
            damping: [
                if r.chance(0.7) { r.decades(1e-5, 1e-2) } else { 0.0 },
                if r.chance(0.3) { r.decades(1.0, 100.0) } else { 0.0 },
            ],
            loaded,
            start: if loaded && r.chance(0.5) { Start::Static } else { Start::Reference },
            engineering: r.chance(0.5),
        }
    }

    /// The scaled and moved scene; lengths and times scale alike, gravity inversely, so that strains do not change.
    fn model(&self, scale: f64, shift: f64) -> Model {
        let mut b = ModelBuilder::new();
        let strain =
            if self.engineering { StrainMeasure::Engineering } else { StrainMeasure::Green };
        let [retardation, mass_damping] = self.damping;
        let material = b.material(Material {
            strain,
            retardation: retardation * scale,
            mass_damping: mass_damping / scale,
            ..Material::new("steel", 2.1e11, 7850.0)
        });
        let area = 2e-3 * scale.powi(2);
        let section = b.section(Section::new("bar", area, 2.667e-7 * scale.powi(4)));
        let points: Vec<[f64; 2]> =
            self.points.iter().map(|x| x.map(|x| x * scale + shift)).collect();
        let arch = Beam { curve: self.curve, ..Beam::new("arch", &points, 20, material, section) };
        let arch = b.beam(arch);
        for (name, end) in [("left", 0.0), ("right", 1.0)] {
            b.support(Support::new(name, at(name, arch, end), SupportKind::Clamp));
        }
        if self.loaded {
            b.load(Load::new("g", LoadKind::Gravity { acceleration: [0.0, -9.81 / scale] }));
        }
        b.build().unwrap()
    }

    fn run(&self, scale: f64, shift: f64) -> RunSummary {
        let settings = Settings { start: self.start, ..Settings::new(1e-2 * scale, 1e-4 * scale) };
        Simulation::new(&self.model(scale, shift), &settings).unwrap().run(&mut NoRecorder)
    }
}

#[test]
fn curved_beams_under_their_weight_never_cut_a_step() {
    let r = &mut Numbers(26);
    for number in 0..500 {
        let found = Scene::random(r).run(1.0, 0.0);
        let reported = format!("scene {number}: {} steps, {:?}", found.steps, found.termination);
        assert_eq!((found.steps, found.step_cuts), (100, 0), "{reported}");
        assert!(found.newton_iterations <= 600, "{reported}: {}", found.newton_iterations);
        assert!(found.energy.residual_max < 1e-10, "{reported}: {:?}", found.energy);
        assert!(found.momentum.linear_residual_max < 1e-10, "{reported}: {:?}", found.momentum);
    }
}

#[test]
fn a_scene_of_any_size_at_any_place_takes_the_same_iterations() {
    let r = &mut Numbers(27);
    for number in 0..12 {
        let scene = Scene::random(r);
        let plain = scene.run(1.0, 0.0);
        // Powers of two, which cause no rounding except in the lengths of curves, which are found by iteration.
        for scale in [1024.0, 1.0 / 1024.0] {
            let scaled = scene.run(scale, 0.0);
            let more = scaled.newton_iterations.abs_diff(plain.newton_iterations);
            assert!(more <= 5 && scaled.step_cuts == 0, "scene {number}, {scale}: {more}");
        }
        // A thousand metres away coordinates keep 13 digits, and the mesh is a little another one.
        let moved = scene.run(1.0, 1000.0);
        let more = moved.newton_iterations.abs_diff(plain.newton_iterations);
        assert!(more <= 20 && moved.step_cuts == 0, "scene {number}: {more}");
    }
}

/// An arc of the given radius over 1.2 rad, and a disc that lies on it at an angle from its start, outside or inside, `deep` within its face.
fn laid_on_arc(
    radius: f64,
    elements: usize,
    (angle, outside): (f64, bool),
    deep: f64,
) -> ModelBuilder {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("steel", 2.1e11, 7850.0));
    let section = b.section(Section::rectangle("strip", 0.01 * radius, 0.02 * radius));
    let on_circle = |angle: f64| [radius * (0.3 + angle).cos(), radius * (0.3 + angle).sin()];
    let points = [0.0, 0.6, 1.2].map(on_circle);
    let arc = Beam { curve: Curve::Arc, ..Beam::new("arc", &points, elements, material, section) };
    let arc = b.beam(arc);
    let (size, half_depth) = (0.3 * radius, 0.01 * radius);
    let sign = if outside { 1.0 } else { -1.0 };
    let away = 1.0 + sign * (half_depth + size - deep) / radius;
    let ball = b.disc(disc("ball", 1.0, size, on_circle(angle).map(|x| away * x), [0.0; 2]));
    let between = [ContactPartner::Disc(ball), ContactPartner::Beam(arc)];
    b.contact(Contact::new("ball-arc", between, TouchLaw::Rigid(RigidLaw::frictionless(0.5))));
    b
}

#[test]
fn a_disc_on_the_circle_of_an_arc_touches_without_overlap() {
    // A cubic over an angle t lies beside its circle by t^4/384 of the radius.
    let beside = |elements: usize| (1.2 / elements as f64).powi(4) / 384.0;
    let mut nearest = f64::INFINITY;
    for radius in [0.1, 1.0, 10.0, 100.0] {
        for elements in [3, 4, 7, 16, 60] {
            for k in 1..40 {
                let place = (0.03 * f64::from(k), k % 2 == 0);
                let laid = |deep: f64| laid_on_arc(radius, elements, place, deep * radius);
                assert!(
                    laid(0.0).build().is_ok(),
                    "{radius} m, {elements}: {:?}",
                    faults(&laid(0.0))
                );
                let real = 1e-4;
                let found = faults(&laid(real));
                assert_eq!(found.len(), 1, "{radius} m, {elements} elements at {place:?}");
                nearest = nearest.min(real / beside(elements));
            }
        }
    }
    // Some overlaps are smaller than the distance of the cubics from their arc: 1.6 times here.
    assert!(nearest < 1.6, "{nearest}");
}

/// A disc that all but fills its arc touches it along its whole length, and wherever cubics bulge inwards.
#[test]
fn a_disc_that_fits_an_arc_has_no_overlap_with_bulging_elements() {
    for elements in [3, 5, 12] {
        let mut b = ModelBuilder::new();
        let material = b.material(Material::new("steel", 2.1e11, 7850.0));
        let section = b.section(Section::rectangle("strip", 0.01, 0.02));
        let points = [0.0_f64, 0.6, 1.2].map(|angle| [angle.cos(), angle.sin()]);
        let beam =
            Beam { curve: Curve::Arc, ..Beam::new("arc", &points, elements, material, section) };
        let arc = b.beam(beam);
        let ball = b.disc(disc("ball", 1.0, 0.99, [0.0; 2], [0.0; 2]));
        let between = [ContactPartner::Disc(ball), ContactPartner::Beam(arc)];
        b.contact(Contact::new("ball-arc", between, TouchLaw::Rigid(RigidLaw::frictionless(0.5))));
        assert_eq!(faults(&b), [""; 0], "{elements} elements");
    }
}

/// Points of an arc on a plane that touches its circle.
#[test]
fn an_arc_may_lie_on_a_plane_that_touches_its_circle() {
    for (elements, deep, inside) in [(3, 0.0, 0), (8, 0.0, 0), (8, 1e-4, 1)] {
        let mut b = ModelBuilder::new();
        let material = b.material(Material::new("steel", 2.1e11, 7850.0));
        let section = b.section(Section::rectangle("strip", 0.01, 0.02));
        let points = [-1.0_f64, -0.2, 0.9].map(|angle| [angle.sin(), 1.0 - angle.cos()]);
        let beam =
            Beam { curve: Curve::Arc, ..Beam::new("arc", &points, elements, material, section) };
        let arc = b.beam(beam);
        let shape = ObstacleShape::HalfPlane { point: [0.0, deep - 0.01], normal: [0.0, 1.0] };
        let floor = b.obstacle(Obstacle { name: "floor".into(), shape, motion: None });
        let between = [ContactPartner::Beam(arc), ContactPartner::Obstacle(floor)];
        let law = TouchLaw::Rigid(RigidLaw::frictionless(0.5));
        let contact = Contact::new("arc-floor", between, law);
        b.contact(Contact { points_per_element: 20, ..contact });
        assert_eq!(faults(&b).len(), inside, "{elements} elements, {deep} m: {:?}", faults(&b));
    }
}

fn faults(b: &ModelBuilder) -> Vec<String> {
    let found = b.build().err().unwrap_or_default();
    found.iter().map(ToString::to_string).collect()
}
