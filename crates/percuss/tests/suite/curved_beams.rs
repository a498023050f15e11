//! Curved beams at rest and slowly loaded: every step is solved at once, and the size of a scene and its place do not matter.

use crate::common;

use common::numbers::Numbers;
use common::*;
use percuss::*;

/// What is drawn at random of a scene; all lengths are multiplied by a factor, times too, so that stresses and strains stay.
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

    /// The scene so many times as large, moved; lengths and times scale alike, gravity inversely, so that strains stay.
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
        let told = format!("scene {number}: {} steps, {:?}", found.steps, found.termination);
        assert_eq!((found.steps, found.step_cuts), (100, 0), "{told}");
        assert!(found.newton_iterations <= 600, "{told}: {}", found.newton_iterations);
        assert!(found.energy.residual_max < 1e-10, "{told}: {:?}", found.energy);
        assert!(found.momentum.linear_residual_max < 1e-10, "{told}: {:?}", found.momentum);
    }
}

#[test]
fn a_scene_of_any_size_at_any_place_takes_the_same_iterations() {
    let r = &mut Numbers(27);
    for number in 0..12 {
        let scene = Scene::random(r);
        let plain = scene.run(1.0, 0.0);
        // Powers of two, by which nothing rounds but the lengths of curves, which are found by iteration.
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
