//! Soft thin beams struck so hard that they fold: feet of contacts leap between arms of one beam, and what has gone through is
//! pushed back. The balances close all the same.

use percuss::{NoRecorder, RunSummary, Termination, simulate};

fn run(text: &str) -> RunSummary {
    let compiled = percuss_scenario::read(text, "violent.toml").unwrap().compile().unwrap();
    simulate(&compiled.model, &compiled.settings, &mut NoRecorder).unwrap()
}

fn balances_close(summary: &RunSummary) {
    let (energy, momentum) = (&summary.energy, &summary.momentum);
    let residuals =
        [energy.residual_max, momentum.linear_residual_max, momentum.angular_residual_max];
    assert!(residuals.iter().all(|r| *r < 1e-10), "{residuals:?}");
}

fn completes(summary: &RunSummary) {
    assert!(matches!(summary.termination, Termination::Completed), "{:?}", summary.termination);
}

#[test]
fn a_foot_that_leaps_to_another_arm_of_a_beam_gives_no_energy() {
    let summary = run(include_str!("../violent/folded.toml"));
    completes(&summary);
    balances_close(&summary);
}

#[test]
fn an_iteration_that_comes_nearer_slowly_gets_there() {
    let summary = run(include_str!("../violent/crumpled.toml"));
    completes(&summary);
    balances_close(&summary);
}

#[test]
fn overlaps_of_things_gone_through_or_at_tight_bends_are_found() {
    balances_close(&run(include_str!("../violent/knotted.toml")));
}

#[test]
fn a_foot_does_not_leap_over_a_crest_on_an_element_bent_round_a_disc() {
    // It gives up when the disc has gone far in, with closed balances.
    balances_close(&run(include_str!("../violent/wrapped.toml")));
}
