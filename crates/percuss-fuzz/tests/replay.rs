//! Replay of the stored inputs of the fuzzers; each target has such a corpus.

use std::fs;
use std::path::Path;

use percuss_fuzz::TARGETS;

#[test]
fn no_input_of_the_corpus_panics() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus");
    for (name, target) in TARGETS {
        let mut tried = 0;
        for entry in fs::read_dir(root.join(name)).expect("a corpus") {
            let path = entry.expect("an entry").path();
            let data = fs::read(&path).expect("an input");
            let outcome = std::panic::catch_unwind(|| target(&data));
            assert!(outcome.is_ok(), "{} panics", path.display());
            tried += 1;
        }
        assert!(tried > 0, "{name} has no input");
    }
}

/// Numbers that follow from a seed (Marsaglia 2003).
fn random(seed: u64) -> impl FnMut() -> u8 {
    let mut state = seed | 1;
    move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 32) as u8
    }
}

#[test]
fn checkpoints_with_bytes_changed_are_refused_or_run() {
    let count = std::env::var("PERCUSS_FUZZ_INPUTS").map_or(600, |n| n.parse().expect("a number"));
    for seed in 0..count {
        let mut next = random(0x9e37_79b9_7f4a_7c15_u64.wrapping_mul(seed + 1));
        let length = 1 + 3 * (1 + usize::from(next()) % 4);
        let data: Vec<u8> = (0..length).map(|_| next()).collect();
        let outcome = std::panic::catch_unwind(|| percuss_fuzz::checkpoint(&data));
        assert!(outcome.is_ok(), "{data:?} panics");
    }
}
