//! Random scenes, run for a few steps: shipped scenarios with numbers changed by the input.

use percuss::{Flow, Recorder, Simulation};
use percuss_scenario::{Scenario, read, templates};

/// Largest number of steps of a run.
const STEPS: usize = 40;
/// Largest number of corrections of a step: somewhat more than the limit of the solver, to include those of its last part.
const CORRECTIONS: usize = 150_000;
/// Largest number of elements of all beams.
const ELEMENTS: usize = 400;
/// Factors by which a number is changed.
const FACTORS: [f64; 16] =
    [0.0, -1.0, 0.5, 2.0, 0.1, 10.0, 1e-3, 1e3, 0.9, 1.1, -0.5, 1e-6, 1e6, 0.99, 3.0, 1.0];

/// Whether a scenario is small enough for a fuzzer.
pub(crate) fn is_small(scenario: &Scenario) -> bool {
    let content = scenario.content();
    let elements: usize =
        content.beam.iter().map(|b| b.table.elements.unwrap_or(20)).fold(0, usize::saturating_add);
    elements <= ELEMENTS
}

/// Number of steps so far.
struct FewSteps(usize);

impl Recorder for FewSteps {
    fn progress(&mut self, _: f64) -> Flow {
        self.0 += 1;
        if self.0 < STEPS { Flow::Continue } else { Flow::Stop }
    }
}

/// The first byte selects a template; each following pair of bytes selects a number in it and its factor. A completed run has a small energy
/// balance error for any numbers.
pub fn run(data: &[u8]) {
    let Some((&which, changes)) = data.split_first() else { return };
    let all = templates();
    let text = changed(all[usize::from(which) % all.len()].text, changes);
    let Ok(scenario) = read(&text, "fuzz.toml") else { return };
    if !is_small(&scenario) {
        return;
    }
    let Ok(compiled) = scenario.compile() else { return };
    let Ok(simulation) = Simulation::new(&compiled.model, &compiled.settings) else { return };
    let summary = simulation.run(&mut FewSteps(0));
    assert!(summary.steps <= STEPS + 1, "{} steps", summary.steps);
    let most = CORRECTIONS * (STEPS + 1);
    assert!(summary.newton_iterations <= most, "{} corrections", summary.newton_iterations);
}

/// The text with some of its numbers multiplied.
fn changed(text: &str, changes: &[u8]) -> String {
    let mut numbers = places_of_numbers(text);
    let mut out = text.to_owned();
    let mut wanted: Vec<(usize, f64)> = Vec::new();
    for pair in changes.chunks_exact(2).take(12) {
        if !numbers.is_empty() {
            let place = numbers.remove(usize::from(pair[0]) % numbers.len());
            wanted.push((place, FACTORS[usize::from(pair[1]) % FACTORS.len()]));
        }
    }
    wanted.sort_by_key(|(place, _)| std::cmp::Reverse(*place)); // from the end, so that positions remain valid
    for (place, factor) in wanted {
        let length = length_of_number(&out[place..]);
        if let Ok(value) = out[place..place + length].parse::<f64>() {
            let number = value * factor;
            let whole = out[place..place + length].bytes().all(|b| b.is_ascii_digit());
            let text = if whole {
                format!("{}", number.round().clamp(0.0, 1e6))
            } else {
                format!("{number:?}")
            };
            out.replace_range(place..place + length, &text);
        }
    }
    out
}

fn length_of_number(text: &str) -> usize {
    let part = |b: u8| b.is_ascii_digit() || b == b'.';
    text.bytes().take_while(|b| part(*b)).count()
}

/// Positions of numbers after an equals sign, a bracket, a comma, a quote or a space, outside comments.
fn places_of_numbers(text: &str) -> Vec<usize> {
    let mut places = Vec::new();
    let mut start = 0;
    for line in text.split_inclusive('\n') {
        let code = line.split('#').next().unwrap_or_default();
        let behind_equals = code.find('=').map_or(code.len(), |at| at + 1);
        let bytes = code.as_bytes();
        for at in behind_equals..bytes.len() {
            let before = bytes[at - 1];
            if bytes[at].is_ascii_digit() && matches!(before, b'[' | b',' | b'"' | b' ' | b'-') {
                places.push(start + at);
            }
        }
        start += line.len();
    }
    places
}
