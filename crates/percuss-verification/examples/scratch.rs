use percuss_verification::CASES;
fn main() {
    for id in std::env::args().skip(1) {
        let case = CASES.iter().find(|c| c.id == id).unwrap();
        let t = std::time::Instant::now();
        let checks = (case.run)();
        println!("== {id} {} checks {:?}", checks.len(), t.elapsed());
        for c in checks { println!("{} {:70} {:.10e} {:.10e} dev {:.3e} {:?}", if c.holds() {"  "} else {"X "}, c.quantity, c.measured, c.expected, c.measured/c.expected-1.0, c.tolerance); }
    }
}
