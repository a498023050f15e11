//! Standard runs, recorded in memory: `standard-runs NAME STEPS`. `scripts/instructions` counts the instructions of the runs in [`NAMES`]; other
//! numbers of elements are accepted.
//!
//! `standard-runs NAME STEPS --bits` prints a hash of all bits of the rows.
//!
//! Without arguments it prints the names of the runs and the vector registers that a run uses on this machine: counts differ between registers.

use percuss::*;
use percuss_bench::{Addition, elastic_example, frame, rigid_example, varied};

const STEP: f64 = 1e-4;
const NAMES: [&str; 5] = ["elastic-6", "elastic-60", "elastic-600", "rigid-6", "frame"];

fn model(name: &str) -> Option<Model> {
    if name == "frame" {
        // Three storeys of two bays, 15 members of six elements.
        return Some(frame(3, 2, 6));
    }
    let (kind, elements) = name.split_once('-')?;
    let elements = elements.parse().ok()?;
    Some(match kind {
        "elastic" => elastic_example(elements),
        "rigid" => rigid_example(elements, 0.5),
        "deep" => varied(elements, Addition::Deep),
        "yielding" => varied(elements, Addition::Yielding),
        "shear" => varied(elements, Addition::Shear),
        _ => return None,
    })
}

fn registers() -> &'static str {
    #[cfg(target_arch = "x86_64")]
    {
        if is_x86_feature_detected!("avx512f") {
            return "x86_64-avx512";
        }
        if is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma") {
            return "x86_64-avx2";
        }
    }
    std::env::consts::ARCH
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if arguments.is_empty() {
        return println!("{} {}", registers(), NAMES.join(" "));
    }
    let steps = arguments.get(1).and_then(|n| n.parse::<f64>().ok());
    let (Some(model), Some(steps)) = (model(&arguments[0]), steps) else {
        eprintln!("usage: standard-runs NAME STEPS, NAME one of {}", NAMES.join(", "));
        std::process::exit(2);
    };
    let mut recorder = MemoryRecorder::default();
    let summary = simulate(&model, &Settings::new(steps * STEP, STEP), &mut recorder)
        .expect("valid settings");
    println!("{} steps, {} corrections", summary.steps, summary.newton_iterations);
    if arguments.get(2).is_some_and(|argument| argument == "--bits") {
        let forces = format!("{:?}", summary.section_forces);
        let bits = recorder.values.iter().flat_map(|value| value.to_bits().to_le_bytes());
        // FNV-1a hash.
        let mix = |hash: u64, byte: u8| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        let hash = bits.chain(forces.bytes()).fold(0xcbf2_9ce4_8422_2325, mix);
        println!("{hash:016x}");
    }
}
