//! Prints every check of the cases named, or of all.
fn main() {
    let wanted: Vec<String> = std::env::args().skip(1).collect();
    for case in percuss_verification::CASES {
        if !wanted.is_empty() && !wanted.iter().any(|w| w == case.id) {
            continue;
        }
        let t = std::time::Instant::now();
        let checks = (case.run)();
        println!("{} ({:.2} s)", case.id, t.elapsed().as_secs_f64());
        for c in checks {
            println!(
                "  {} {:60} {:<24} {:<24} {:?} {:?}",
                if c.holds() { "ok " } else { "BAD" },
                c.quantity,
                c.measured,
                c.expected,
                c.deviation(),
                c.tolerance
            );
        }
    }
}
