//! Twin experiments: intervals contain the truth as often as they say.

use crate::common::{FIT, OFFSET, SCENARIO, desk, fitted, parameter, record};

#[test]
fn intervals_contain_the_truth_in_seventeen_of_twenty_records_and_more() {
    let truth = [("stiffness", 2e6), ("dissipation", 0.2), ("drop.offset", OFFSET)];
    let mut inside = [0; 3];
    let mut chi = 0.0;
    for seed in 0..20 {
        let desk = desk(&record(SCENARIO, 1000 + seed, 1.0));
        let fit = fitted(desk.path(), FIT).expect("a fit");
        assert!(fit.success, "{seed}: {}", fit.message);
        for (count, (name, value)) in inside.iter_mut().zip(truth) {
            let [low, high] = parameter(&fit, name).interval;
            *count += usize::from((low..=high).contains(&value));
        }
        chi += fit.reduced_chi_square / 20.0;
    }
    // Of 20 intervals of 95 % fewer than 17 contain the truth with a probability of 2 %.
    assert!(inside.iter().all(|count| *count >= 17), "{inside:?}");
    // 20 times 217 degrees of freedom: a standard deviation of 2 %.
    assert!((chi - 1.0).abs() < 0.08, "{chi}");
}
