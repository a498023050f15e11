//! Numbers that are far off by a unit: an answer comes at once, and says what looks like a slip.

use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::mpsc;
use std::time::Duration;

use percuss::Simulation;
use percuss_advice::{Topic, advise};

/// Parts of the scenarios, a test each.
const PARTS: usize = 4;
/// Far beyond what one scenario takes; a loop whose length follows from a value would not end in it. The longest, a static start of
/// a frame 1e9 times too stiff, takes a minute where other work has the processors.
const HANGS: Duration = Duration::from_secs(300);

fn shipped() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios");
    let mut files = Vec::new();
    for folder in [folder.clone(), folder.join("paper")] {
        let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
        files.extend(entries.filter(|path| path.extension().is_some_and(|e| e == "toml")));
    }
    files.sort();
    files
}

/// Places of numbers in a file, those of meshes and of comments left out.
fn numbers(text: &str) -> Vec<Range<usize>> {
    let mut all = Vec::new();
    let mut line_start = 0;
    for line in text.split_inclusive('\n') {
        let code = line.split('#').next().unwrap_or("");
        let key = code.split('=').next().unwrap_or("").trim();
        let begin = code.find('=').unwrap_or(code.len());
        let bytes = code.as_bytes();
        let mut at = begin;
        while at < bytes.len() && !key.starts_with("element") && !code.contains("elements") {
            let begins = bytes[at].is_ascii_digit()
                && !bytes[at - 1].is_ascii_alphanumeric()
                && bytes[at - 1] != b'^';
            let more = |b: &&u8| b.is_ascii_digit() || matches!(**b, b'.' | b'_');
            let length = bytes[at..].iter().take_while(more).count();
            if begins {
                all.push(line_start + at..line_start + at + length);
            }
            at += length.max(1);
        }
        line_start += line.len();
    }
    all
}

/// What `check` does, and `run` before its first step.
fn look_at(text: &str, name: &str) -> Option<Vec<percuss_advice::Advice>> {
    let compiled = percuss_scenario::read(text, name).ok()?.compile().ok()?;
    let simulation = Simulation::new(&compiled.model, &compiled.settings).ok()?;
    assert!(simulation.step_count() > 0);
    Some(advise(&compiled.model, &compiled.settings))
}

/// Changes numbers of every file whose number leaves `part` when divided by [`PARTS`], one of eight unless the whole is wanted, and looks at
/// what comes of it.
fn answer_slips(part: usize) {
    let every = if crate::common::whole() { 1 } else { 8 };
    let (reported, hears) = mpsc::channel::<String>();
    let work = std::thread::spawn(move || {
        let mut tried = [0, 0];
        for (n, file) in shipped().iter().enumerate().filter(|(n, _)| n % PARTS == part) {
            let text = std::fs::read_to_string(file).unwrap();
            let name = file.display().to_string();
            for (k, place) in numbers(&text).into_iter().enumerate() {
                // Others in each file, so that keys of all kinds come round.
                if !(n / PARTS + k).is_multiple_of(every) {
                    continue;
                }
                let number: f64 = text[place.clone()].replace('_', "").parse().unwrap();
                // Two of the powers for each number, so that all of them come round.
                let powers =
                    [0, 4].map(|shift| [-12, -9, -6, -3, 3, 6, 9, 12][(n + k + shift) % 8]);
                let odd =
                    ["0", "-1", "9223372036854775807", "0xffffffffffff", "nan", "inf", "1e300"]
                        [(n + k) % 7];
                let mut values: Vec<String> =
                    powers.iter().map(|p| format!("{:e}", number * 10_f64.powi(*p))).collect();
                values.push(odd.into());
                for value in values {
                    let changed = [&text[..place.start], &value, &text[place.end..]].concat();
                    if reported
                        .send(format!("{name}: {} for {value}", &text[place.clone()]))
                        .is_err()
                    {
                        return tried;
                    }
                    tried[usize::from(look_at(&changed, &name).is_some())] += 1;
                }
            }
        }
        tried
    });
    let mut last = String::new();
    loop {
        match hears.recv_timeout(HANGS) {
            Ok(what) => last = what,
            Err(mpsc::RecvTimeoutError::Disconnected) => break,
            Err(mpsc::RecvTimeoutError::Timeout) => panic!("no answer: {last}"),
        }
    }
    let [refused, valid] = work.join().unwrap();
    let most = 300 / every / PARTS;
    assert!(valid > most && refused > most / 3, "{valid} sound, {refused} refused");
}

// One after the other they would keep a processor long after the other one has ended its tests.
#[test]
fn a_scenario_off_by_any_power_of_ten_is_answered() {
    answer_slips(0);
}

#[test]
fn so_is_a_second_part_of_the_scenarios() {
    answer_slips(1);
}

#[test]
fn so_is_a_third_part() {
    answer_slips(2);
}

#[test]
fn so_is_the_rest() {
    answer_slips(3);
}

#[test]
fn nothing_shipped_looks_like_a_wrong_unit() {
    for file in shipped() {
        let text = std::fs::read_to_string(&file).unwrap();
        let advice =
            look_at(&text, &file.display().to_string()).unwrap_or_else(|| panic!("{file:?}"));
        let magnitudes: Vec<_> =
            advice.iter().filter(|one| one.topic == Topic::Magnitude).collect();
        assert!(magnitudes.is_empty(), "{file:?}: {magnitudes:#?}");
    }
}

#[test]
fn wrong_units_are_reported_with_what_they_contradict() {
    let file =
        shipped().into_iter().find(|file| file.ends_with("paper/elastic-pinned.toml")).unwrap();
    let text = std::fs::read_to_string(file).unwrap();
    let cases = [
        ("[[0, 0], [\"3 m\", 0]]", "[[0, 0], [\"3 mm\", 0]]", "length 3 mm, and"),
        ("\"8330 cm^4\"", "8330e4", "km deep"),
        ("\"500 kg\"", "0xffffffffffff", "a mass of 2.81e14 kg on beam 'girder' of 900 kg"),
        ("\"7.5e5 N/m\"", "\"1e-6 N/m\"", "times softer than beam 'girder'"),
        ("\"7.5e5 N/m\"", "\"1e16 N/m\"", "times stiffer than beam 'girder'"),
        ("\"3000 kg/m^3\"", "3e-9", "in t/mm^3 it would be 3000 kg/m^3"),
        ("\"3000 kg/m^3\"", "3e6", "density 3.00e6 kg/m^3, solids have"),
        ("\"0.2e10 Pa\"", "2", "in GPa it would be 2.00e9 Pa"),
        ("\"20 m/s\"", "\"20 km/s\"", "exceeds the wave speed of beam 'girder'"),
        ("\"0.15 s\"", "\"1e7 s\"", "take days"),
    ];
    for (right, wrong, words) in cases {
        assert!(text.contains(right), "{right}");
        let advice = look_at(&text.replace(right, wrong), "slip.toml").unwrap_or_default();
        let magnitudes: Vec<&str> = advice
            .iter()
            .filter(|one| one.topic == Topic::Magnitude)
            .map(|one| one.text.as_str())
            .collect();
        assert!(magnitudes.iter().any(|text| text.contains(words)), "{wrong}: {magnitudes:#?}");
    }
}
