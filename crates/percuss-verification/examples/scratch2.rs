#![allow(dead_code, missing_docs)]
#[path = "../src/check.rs"] mod check;
#[path = "../src/structure.rs"] mod structure;
#[path = "../src/yielding.rs"] mod yielding;
#[path = "rpdir/rp.rs"] mod rigid_plastic;
use rigid_plastic::*;
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let n = |k: usize| a[k].parse::<f64>().unwrap();
    let t = std::time::Instant::now();
    let (w, s) = match a[1].as_str() {
        "heavy" => { let (w, s) = struck_in_the_middle(&if n(2) == 1.0 { percuss::SupportKind::Clamp } else { percuss::SupportKind::Pin }, n(3), n(4) as usize, n(5), n(6), n(7) as usize); (w / driven_to(n(2) == 1.0, n(3)) - 1.0, s) }
        "parkes" => { let p = Parkes { ratio: n(2), elements: n(3) as usize, young: n(4), steps: n(5) as usize }; let s = p.run(n(6)); (s.points[0].displacement_max[1].value / p.deflection(n(6)) - 1.0, s) }
        _ => { let (w, e, s) = thrown_beam(n(2) == 1.0, n(3) as usize, n(4), n(5) as usize, n(6)); (w / e - 1.0, s) }
    };
    println!("{:?} err {w:.4e} time {:?} newton {} steps {} solver {} cuts {} res {:e} E0 {} plastic {} set {:?}", &a[1..], t.elapsed(), s.newton_iterations, s.steps, s.solver_steps, s.step_cuts, s.energy.residual_max, s.energy.initial, s.energy.plastic, s.plastic[0].permanent_set);
    for h in s.plastic[0].hinges.iter().filter(|h| h.rotation.abs() > 1e-3) { println!("     s {:.3} len {:.3} el {:.3} rot {:.4} diss {:.3}", h.s, h.length, h.element_length, h.rotation, h.dissipated); }
    if !matches!(s.termination, percuss::Termination::Completed) { println!("{:?}", s.termination); }
}
