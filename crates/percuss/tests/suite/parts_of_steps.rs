//! Single parts of steps, which runs use only if no simpler part is possible.

use percuss::internals::step::newton::Failure;
use percuss::internals::step::tangent::Singular;
use percuss::*;

#[test]
fn a_singular_tangent_has_its_code() {
    // No accepted model is known to have one: only its message is tested.
    let mut b = ModelBuilder::new();
    b.disc(Disc {
        name: "ball".into(),
        mass: 1.0,
        inertia: None,
        radius: 0.1,
        position: [0.0; 2],
        velocity: [1.0, 0.0],
        spin: 0.0,
    });
    let model = b.build().unwrap();
    let simulation = Simulation::new(&model, &Settings::new(1.0, 0.5)).unwrap();
    let error = simulation.give_up(Failure::Singular(Singular::Constraints), 0.5);
    assert_eq!(error.code().code(), "E107");
    let text = "singular tangent at t = 0.000000000e0 s, at the joints and supports";
    assert_eq!(error.to_string(), text);
}

#[test]
fn a_ball_comes_to_rest_on_what_it_would_have_sunk_into() {
    for (friction, sliding) in [(0.0, 1.0), (0.1, 0.8), (2.0, 2.0 / 3.0)] {
        let mut b = ModelBuilder::new();
        let material = b.material(Material::new("stuff", 1e9, 1e3));
        let section = b.section(Section::new("bar", 0.01, 1e-5));
        b.beam(Beam::new("far", &[[0.0, 9.0], [1.0, 9.0]], 1, material, section));
        let ball = b.disc(Disc {
            name: "ball".into(),
            mass: 3.0,
            inertia: None,
            radius: 0.1,
            position: [0.0, 0.1004],
            velocity: [1.0, -2.0],
            spin: 0.0,
        });
        let shape = ObstacleShape::HalfPlane { point: [0.0, 0.0], normal: [0.0, 1.0] };
        let floor = b.obstacle(Obstacle { name: "floor".into(), shape, motion: None });
        let law = TouchLaw::Rigid(RigidLaw { friction, ..RigidLaw::frictionless(0.5) });
        let between = [ContactPartner::Disc(ball), ContactPartner::Obstacle(floor)];
        b.contact(Contact::new("c", between, law));
        let model = b.build().unwrap();
        let h = 1e-3;
        let mut simulation = Simulation::new(&model, &Settings::new(1.0, h)).unwrap();
        let energy = |s: &Simulation<'_>| s.measures().total();
        let before = energy(&simulation);
        simulation.advance_held(h).unwrap();
        // The impact interval that brings it to rest follows.
        let beyond = simulation.state().time / h - 1.0;
        assert!(beyond > 0.0 && beyond < 1e-5, "{beyond}");
        let pair = &simulation.state().pairs[0];
        // The impact interval takes a millionth of the step, in which it separates by up to a nanometre.
        assert!(pair.gap.abs() < 1e-9 && pair.rate.abs() < 1e-14 && pair.closed, "{pair:?}");
        let velocity = simulation.state().velocity[model.body_node(0)];
        // Coulomb on the whole impulse of 6 N s; a full disc that comes to roll keeps two thirds. The lever
        // of friction in the step is longer than the radius by half the gap, 0.2 %.
        assert!((velocity[0] - sliding).abs() < 1e-3, "{friction}: {velocity:?}");
        assert!(energy(&simulation) < before);
    }
}
