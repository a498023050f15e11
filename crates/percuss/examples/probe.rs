use percuss::*;
fn paper(young: f64, n: usize, clamped: bool, kind: ProjectileKind, mass: f64, v: f64, standoff: f64) -> Model {
    let mut b = ModelBuilder::new();
    let m = b.material(Material { name: "m".into(), young, density: 3e3, strain: StrainMeasure::Green });
    let s = b.section(Section { name: "s".into(), area: 0.1, inertia: 8.33e-5, rotary_inertia: RotaryInertia::Density });
    let g = b.beam(Beam { name: "girder".into(), points: vec![[0.0, 0.0], [3.0, 0.0]], elements: n, material: m, section: s });
    let at = |l: &str, f| PointRef { label: format!("girder.{l}"), beam: g, along: Along::Fraction(f) };
    if clamped {
        b.support(Support { name: "l".into(), at: at("start", 0.0), kind: SupportKind::Clamp });
        b.support(Support { name: "r".into(), at: at("end", 1.0), kind: SupportKind::Clamp });
    }
    b.projectile(Projectile { name: "p".into(), kind, mass, velocity: [0.0, v], direction: None, strikes: at("mid", 0.5), standoff });
    b.build().unwrap()
}
fn main() {
    let elastic = ProjectileKind::Elastic { stiffness: 7.5e5, force: ContactForce::Conserving };
    for clamped in [true, false] {
        let model = paper(0.2e10, 6, clamped, elastic, 500.0, 20.0, 0.2);
        let t = std::time::Instant::now();
        let s = simulate(&model, &Settings::new(0.15, 1e-4), &mut NoRecorder).unwrap();
        let us = t.elapsed().as_secs_f64() * 1e6 / s.steps as f64;
        println!("clamped {clamped}: {us:.2} us/step {s:#?}");
    }
    for h in [5e-3, 1e-2] {
        let model = paper(0.2e10, 6, false, elastic, 500.0, 20.0, 0.2);
        let s = simulate(&model, &Settings::new(20.0, h), &mut NoRecorder).unwrap();
        println!("h {h}: {:?} {:?} {:?} cuts {} it {} fac {} steps {}", s.termination, s.energy, s.momentum, s.step_cuts, s.newton_iterations, s.factorizations, s.steps);
    }
    for (e, clamped) in [(1.0, true), (0.5, true), (0.0, true), (1.0, false), (0.0, false)] {
        let model = paper(0.2e12, 6, clamped, ProjectileKind::Rigid { restitution: e }, 100.0, -40.0, 0.02);
        for h in [1e-5, 2e-6, 1e-6, 5e-7, 2e-7] {
            let t = std::time::Instant::now();
            let s = simulate(&model, &Settings::new(0.02, h), &mut NoRecorder).unwrap();
            let us = t.elapsed().as_secs_f64() * 1e6 / s.steps as f64;
            println!("e {e} clamped {clamped} h {h}: {us:.2} us/step; {:?}", s.termination);
            println!("  {:?} {:?} v {:?}", s.energy, s.momentum, s.projectiles[0].velocity_final);
            if let ContactRecord::Nonsmooth { impacts, intervals, impact_count, .. } = &s.contacts[0].record {
                println!("  count {impact_count} intervals {}", intervals.len());
                for i in impacts.iter().take(4) { println!("   {:.9} {:.6} {:.6} {:.6} {:.3}", i.time, i.impulse, i.approach_velocity, i.separation_velocity, i.energy_lost); }
            }
        }
    }
}
