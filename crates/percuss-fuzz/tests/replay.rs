//! What fuzzers found worth keeping, tried again; and that each target has such a corpus.

use std::fs;
use std::path::Path;

use percuss_fuzz::TARGETS;

#[test]
fn the_corpus_is_borne() {
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
