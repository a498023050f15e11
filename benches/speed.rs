//! Speed and memory of single runs; `cargo bench -p percuss-bench` prints the table of `docs/performance.md`.

use std::time::Instant;

use percuss::*;
use percuss_batch::{Detail, simulate_batch};
use percuss_bench::{
    Addition, above_floor, elastic_example, frame, rigid_study, sliding_discs, varied,
};
use percuss_output::{HistoryFormat, HistoryWriter};

/// Repetitions of each measurement; the smallest value is printed, as the least disturbed one.
const REPEAT: usize = 9;

fn least(mut measure: impl FnMut() -> f64) -> f64 {
    (0..REPEAT).map(|_| measure()).fold(f64::INFINITY, f64::min)
}

fn main() {
    if let Some(elements) = std::env::args().skip_while(|a| a != "--memory").nth(1) {
        return report_memory(&elements);
    }
    println!("elastic example, 6 elements, 1500 steps");
    let model = elastic_example(6);
    let settings = Settings::new(0.15, 1e-4);
    let per_step = |recorder: &mut dyn FnMut() -> Box<dyn Recorder>| {
        least(|| {
            let mut recorder = recorder();
            let start = Instant::now();
            let summary = simulate(&model, &settings, recorder.as_mut()).expect("valid settings");
            start.elapsed().as_secs_f64() / summary.steps as f64 * 1e6
        })
    };
    println!(
        "  nothing recorded          {:6.2} us per step",
        per_step(&mut || Box::new(NoRecorder))
    );
    println!(
        "  everything, in memory     {:6.2} us per step",
        per_step(&mut || Box::new(MemoryRecorder::default()))
    );
    let dir = std::env::temp_dir().join(format!("percuss-bench-{}", std::process::id()));
    std::fs::create_dir_all(&dir).expect("a temporary directory");
    for (name, format) in [("Parquet", HistoryFormat::Parquet), ("CSV", HistoryFormat::Csv)] {
        let long = Settings::new(6.0, 1e-4);
        let us = least(|| {
            let mut writer = HistoryWriter::new(&dir, format, "");
            let start = Instant::now();
            let summary = simulate(&model, &long, &mut writer).expect("valid settings");
            writer.finish().expect("a written history");
            start.elapsed().as_secs_f64() / summary.steps as f64 * 1e6
        });
        println!("  everything, {name:<13} {us:6.2} us per step (60 000 steps)");
    }
    std::fs::remove_dir_all(&dir).expect("our own directory");
    println!("growing number of elements, step 1e-4 s");
    for elements in [6, 60, 600, 6_000, 60_000] {
        scaling(&elastic_example(elements));
    }
    println!("a straight beam and a frame of 210 members, alike in elements");
    for _ in 0..3 {
        scaling(&elastic_example(19_950));
        scaling(&frame(10, 10, 95));
    }
    surface_contacts();
    ensembles();
    rigid_ensembles();
    println!("peak memory");
    for elements in [6, 60_000] {
        let program = std::env::current_exe().expect("this program");
        let status =
            std::process::Command::new(program).args(["--memory", &elements.to_string()]).status();
        assert!(status.is_ok_and(|s| s.success()), "the memory run failed");
    }
}

fn scaling(model: &Model) {
    let elements = model.element_count();
    let steps = (200_000 / elements).clamp(20, 1500);
    // The runs start shortly before contact, so that most steps include contact.
    let settings = Settings::new((100 + steps) as f64 * 1e-4, 1e-4);
    let mut simulation = Simulation::new(model, &settings).expect("valid settings");
    for _ in 0..100 {
        simulation.advance(&mut NoRecorder).expect("the beam is at rest");
    }
    let before = simulation.effort();
    let start = Instant::now();
    for _ in 0..steps {
        simulation.advance(&mut NoRecorder).expect("the run goes on");
    }
    let seconds = start.elapsed().as_secs_f64();
    let after = simulation.effort();
    let iterations = (after.iterations - before.iterations) as f64;
    let factorizations = (after.factorizations - before.factorizations) as f64;
    let per = |n: f64| seconds / n / elements as f64 * 1e6;
    println!(
        "  {elements:>6} elements: {:7.4} us per element and iteration, {:7.4} per element and step \
         ({:.2} iterations, {:.2} factorizations a step)",
        per(iterations),
        per(steps as f64),
        iterations / steps as f64,
        factorizations / steps as f64,
    );
}

/// Cost of a disc in contact with a beam, and cost of contact pairs that are open.
fn surface_contacts() {
    println!("discs on a beam of 60 elements, step 1e-4 s");
    // Microseconds and iterations per step.
    let measure = |model: Model| {
        let settings = Settings::new(0.1, 1e-4);
        let mut iterations = 0.0;
        let us = least(|| {
            let start = Instant::now();
            let summary = simulate(&model, &settings, &mut NoRecorder).expect("valid settings");
            iterations = summary.newton_iterations as f64 / summary.steps as f64;
            start.elapsed().as_secs_f64() / summary.steps as f64 * 1e6
        });
        (us, iterations)
    };
    let (alone, few) = measure(sliding_discs(0, 0.0));
    println!("  no disc                   {alone:6.2} us per step ({few:.2} iterations)");
    for count in [1, 8] {
        let (us, iterations) = measure(sliding_discs(count, 0.0));
        let each = (us / iterations - alone / few) / count as f64;
        println!(
            "  {count} sliding                 {us:6.2} us per step ({iterations:.2} iterations), \
             {each:.2} us per contact and iteration"
        );
    }
    let (us, _) = measure(sliding_discs(200, 1.0));
    println!(
        "  200 free discs 1 m away   {us:6.2} us per step, {:.3} us per disc, its motion included",
        (us - alone) / 200.0
    );
    for elements in [6, 20, 60] {
        let alone = measure(above_floor(elements, 0)).0;
        let per_element = 200 / elements;
        let (us, _) = measure(above_floor(elements, per_element));
        println!(
            "  {} points that touch no floor, {elements:>2} elements {us:6.2} us per step, {:+.1} %",
            per_element * elements,
            (us / alone - 1.0) * 100.0
        );
    }
}

/// Runs with a rigid projectile in lanes, and some of them as single runs.
fn rigid_ensembles() {
    println!("a study of the rigid example, 6 elements, 2000 steps, one core");
    let (models, settings) = (rigid_study(128), Settings::new(0.02, 1e-5));
    let runs: Vec<_> = models.iter().map(|model| (model, &settings)).collect();
    for (name, runs, detail) in
        [("side by side", &runs[..], Detail::Motion), ("one by one", &runs[..8], Detail::Full)]
    {
        let seconds = least(|| {
            let start = Instant::now();
            assert!(simulate_batch(runs, detail).iter().all(Result::is_ok));
            start.elapsed().as_secs_f64()
        });
        let count = runs.len() as f64;
        println!(
            "  {name:<16}  {:4.0} runs a second, {:.2} us per step and run",
            count / seconds,
            seconds / (count * 2000.0) * 1e6
        );
    }
}

/// Runs of one shape in lanes, as in studies.
fn ensembles() {
    println!("a study of the elastic example, 6 elements, 1500 steps, one core");
    let settings = Settings::new(0.15, 1e-4);
    for (name, addition) in [
        ("as it is", Addition::None),
        ("under gravity", Addition::Gravity),
        ("damped", Addition::Damped),
        ("slender elements", Addition::Slender),
    ] {
        let model = varied(6, addition);
        let runs = vec![(&model, &settings); 64];
        let seconds = least(|| {
            let start = Instant::now();
            assert!(simulate_batch(&runs, Detail::Motion).iter().all(Result::is_ok));
            start.elapsed().as_secs_f64()
        });
        println!(
            "  {name:<16}  {:4.0} runs a second, {:.2} us per step and run",
            64.0 / seconds,
            seconds / (64.0 * 1500.0) * 1e6
        );
    }
}

/// Executes a run in a separate process and prints its peak resident memory.
fn report_memory(elements: &str) {
    let elements: usize = elements.parse().expect("a number of elements");
    for steps in [20, 200] {
        let model = elastic_example(elements);
        let settings = Settings::new(0.01 + f64::from(steps) * 1e-4, 1e-4);
        simulate(&model, &settings, &mut NoRecorder).expect("valid settings");
        let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
        let peak = status.lines().find_map(|l| l.strip_prefix("VmHWM:")).unwrap_or("unknown");
        println!("  {elements:>6} elements, {} steps: {}", 100 + steps, peak.trim());
    }
}
