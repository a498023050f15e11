use percuss::*;
fn bar(
    law: TouchLaw,
    n: usize,
    h: f64,
    end: f64,
    v: f64,
    strain: StrainMeasure,
) -> (MemoryRecorder, RunSummary) {
    let mut b = ModelBuilder::new();
    let m = b.material(Material { strain, ..Material::new("m", 900.0, 1.0) });
    let mut s = Section::new("s", 1.0, 1e3);
    s.rotary_inertia = RotaryInertia::Neglected;
    let s = b.section(s);
    let bar = b.beam(Beam::new("bar", &[[0.0, 5e-4], [0.0, 10.0005]], n, m, s));
    let floor = b.obstacle(Obstacle {
        name: "floor".into(),
        shape: ObstacleShape::HalfPlane { point: [0.0, 0.0], normal: [0.0, 1.0] },
        motion: None,
    });
    b.contact(Contact::new("floor", [Party::Beam(bar), Party::Obstacle(floor)], law));
    b.load(Load::new("g", LoadKind::Gravity { acceleration: [0.0, -1e-3] }));
    b.initial_motion(InitialMotion { velocity: [0.0, v], spin: 0.0, about: [0.0; 2] });
    b.record_point(PointRef { label: "bottom".into(), beam: bar, along: Along::Fraction(0.0) });
    let model = b.build().unwrap();
    let mut r = MemoryRecorder::default();
    let s =
        simulate(&model, &Settings { record_every: 1, ..Settings::new(end, h) }, &mut r).unwrap();
    (r, s)
}
fn main() {
    for (name, law) in [
        ("e1", TouchLaw::Rigid(RigidLaw::frictionless(1.0))),
        ("e0.5", TouchLaw::Rigid(RigidLaw::frictionless(0.5))),
        ("e0", TouchLaw::Rigid(RigidLaw::frictionless(0.0))),
        ("k1e4", TouchLaw::Smooth(SmoothLaw::elastic(Potential::Linear { stiffness: 1e4 }))),
        ("k1e5", TouchLaw::Smooth(SmoothLaw::elastic(Potential::Linear { stiffness: 1e5 }))),
    ] {
        for n in [50, 100] {
            let tau = 1.0 / 3.0;
            let h = tau / 30.0 / (n as f64 / 50.0) / 2.0;
            let t0 = std::time::Instant::now();
            let (r, s) = bar(law.clone(), n, h, 17.0 * tau, 0.0, StrainMeasure::Green);
            let time = r.column("time").unwrap();
            let u = r.column("point.bottom.displacement_2").unwrap();
            let at = |t: f64| {
                let k = time.partition_point(|x| *x < t - 1e-9).min(time.len() - 1);
                5.0 + 1e4 * u[k]
            };
            let vals: Vec<String> =
                (0..=16).map(|m| format!("{:.4}", at(m as f64 * tau))).collect();
            let imp = r.column("contact.floor.impulse").unwrap();
            // mean force over windows of tau/10
            let w = tau / 5.0;
            let mut bins = vec![0.0; 85];
            for k in 1..time.len() {
                let b = ((time[k] - 1e-9) / w) as usize;
                if b < bins.len() {
                    bins[b] += 1e4 * imp[k] / w;
                }
            }
            println!(
                "{name} n {n} {:?} en {:.3} res {:.1e} loss {:.2e} steps {} cont {:.1e} {:?}\n  {}\n  {}",
                s.termination,
                1e8 * s.energy.final_,
                s.energy.residual_max,
                1e8 * s.energy.loss_impacts,
                s.solver_steps,
                s.contact_residual_max,
                t0.elapsed(),
                vals.join(" "),
                bins[13..28].iter().map(|f| format!("{f:.0}")).collect::<Vec<_>>().join(" ")
            );
        }
    }
}
