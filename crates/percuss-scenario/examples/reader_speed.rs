//! How many scenarios a second the reader answers, valid ones and ones with faults:
//! `cargo run --release -p percuss-scenario --example reader_speed [ROUNDS [FILE ...]]` in the root of the repository.
//!
//! Valid are the files of `scenarios/` and one of the tests with nearly every key, or the files given: read, then compiled to
//! models. Ones with faults are made of them by one to three changes that people make by mistake, the same ones in each run of
//! the program: read, compiled where nothing is wrong yet, and what is wrong reported line by line, or drawn with the lines it stands
//! on. Besides, scenarios of many beams show how the time grows.

use std::path::{Path, PathBuf};
use std::time::Instant;

use percuss_scenario::{is_study, read};

/// Texts with faults made of each file.
const VARIANTS: usize = 60;

fn main() {
    let rounds = std::env::args().nth(1).and_then(|text| text.parse().ok()).unwrap_or(5);
    let files: Vec<PathBuf> = std::env::args().skip(2).map(PathBuf::from).collect();
    let valid = texts(if files.is_empty() { shipped() } else { files });
    let (changed, lost) = variants(&valid);
    println!("{} files as shipped, {} changed ones", valid.len(), changed.len() + lost);
    report("read", &valid, rounds, |(name, text)| read(text, name).is_err());
    report("read and compiled", &valid, rounds, answer);
    report("with faults, told", &changed, rounds, answer);
    report("with faults, drawn", &changed, rounds, draw);
    for beams in [10, 100, 1000] {
        let text = many_beams(beams);
        let one = |what: &str, text: String| {
            let what = format!("{beams} beams{what}");
            report(&what, &[("all of it".to_owned(), text)], rounds, answer);
        };
        one("", text.clone());
        one(", a key misspelt", text.replace("elements", "elemenst"));
        one(", beams unknown", text.replace("at = \"b", "at = \"c"));
    }
}

/// Reads and compiles; whether there were faults, which are written out.
fn answer((name, text): &(String, String)) -> bool {
    let compiled = read(text, name).and_then(|scenario| scenario.compile());
    compiled.is_err_and(|faults| !std::hint::black_box(faults.to_string()).is_empty())
}

/// The same with the lines shown and underlined.
fn draw((name, text): &(String, String)) -> bool {
    let compiled = read(text, name).and_then(|scenario| scenario.compile());
    compiled.is_err_and(|faults| !std::hint::black_box(faults.fancy(false, 100)).is_empty())
}

/// Cantilevers beside each other, as they would be written one by one.
fn many_beams(count: usize) -> String {
    let mut text = String::from(
        "[material.steel]\nyoung = \"210 GPa\"\ndensity = 7850\n\
         [section.s]\nshape = \"rectangle\"\nwidth = 0.1\ndepth = 0.1\n\
         [time]\nend = 0.01\nstep = 0.001\n",
    );
    for k in 0..count {
        text.push_str(&format!(
            "[beam.b{k}]\npoints = [[{k}, 0], [{k}.9, 0]]\nelements = 2\nmaterial = \"steel\"\n\
             section = \"s\"\n[support.s{k}]\nat = \"b{k}.start\"\nkind = \"clamp\"\n",
        ));
    }
    text
}

/// Prints how many a second are answered in the fastest round, and the slowest of them all.
fn report(
    what: &str,
    texts: &[(String, String)],
    rounds: usize,
    one: impl Fn(&(String, String)) -> bool,
) {
    let (mut least, mut at_fault) = (f64::INFINITY, 0);
    let mut each = vec![f64::INFINITY; texts.len()];
    for _ in 0..rounds {
        let begin = Instant::now();
        at_fault = 0;
        for (text, least) in texts.iter().zip(&mut each) {
            let begin = Instant::now();
            at_fault += usize::from(one(text));
            *least = least.min(begin.elapsed().as_secs_f64());
        }
        least = least.min(begin.elapsed().as_secs_f64());
    }
    let slowest = (0..texts.len()).max_by(|&a, &b| each[a].total_cmp(&each[b]));
    let slowest =
        slowest.map_or(String::new(), |i| format!("{} {:.2} ms", texts[i].0, each[i] * 1e3));
    let rate = texts.len() as f64 / least;
    println!(
        "{what:<28} {rate:8.0} a second, {at_fault:5} of {} with faults; slowest {slowest}",
        texts.len()
    );
}

/// The files of `scenarios/` that are no studies, with their names.
///
/// # Panics
/// If the program runs elsewhere than in the repository.
fn shipped() -> Vec<PathBuf> {
    let mut files: Vec<PathBuf> = Vec::new();
    for folder in ["scenarios", "scenarios/paper"] {
        let entries =
            Path::new(folder).read_dir().expect("the folder `scenarios` of the repository");
        files.extend(entries.map(|entry| entry.expect("a readable folder").path()));
    }
    files.push("crates/percuss-scenario/tests/files/everything.toml".into());
    files.retain(|file| file.extension().is_some_and(|end| end == "toml"));
    files.sort();
    files
}

fn texts(files: Vec<PathBuf>) -> Vec<(String, String)> {
    let texts = files.into_iter().map(|file| {
        let text = std::fs::read_to_string(&file).expect("a text");
        (file.display().to_string(), text)
    });
    texts.filter(|(_, text)| !is_study(text)).collect()
}

/// Changed texts that have faults, and the number of changed ones that have none.
fn variants(valid: &[(String, String)]) -> (Vec<(String, String)>, usize) {
    let mut chance = Chance(1);
    let mut all = Vec::new();
    for (name, text) in valid {
        for k in 0..VARIANTS {
            let mut text = text.clone();
            for _ in 0..=chance.below(3) {
                text = change(&text, &mut chance);
            }
            all.push((format!("{name} changed {k}"), text));
        }
    }
    let count = all.len();
    all.retain(answer);
    let lost = count - all.len();
    (all, lost)
}

/// One change, to a line that is not empty and no comment.
fn change(text: &str, chance: &mut Chance) -> String {
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    let matters = |line: &String| !line.trim().is_empty() && !line.starts_with('#');
    let places: Vec<usize> = (0..lines.len()).filter(|&i| matters(&lines[i])).collect();
    let Some(&at) = places.get(chance.below(places.len())) else { return text.to_owned() };
    let line = lines[at].clone();
    let (key, value) = match line.split_once('=') {
        Some((key, value)) => (key.trim().to_owned(), Some(value.trim().to_owned())),
        None => (line.trim_matches(['[', ']', ' ']).to_owned(), None),
    };
    let written = |key: &str| match &value {
        Some(value) => format!("{key} = {value}"),
        None => format!("[{key}]"),
    };
    match chance.below(9) {
        0 => _ = lines.remove(at),
        1 => lines.insert(at, line),
        2 => lines[at] = written(&letter_lost(&key, chance)),
        3 => lines[at] = written(&letters_swapped(&key, chance)),
        4 => lines[at] = letter_lost(&line, chance),
        5 => lines[at] = letters_swapped(&line, chance),
        6 => lines[at] = format!("{key} = \"3 kgm\""),
        7 => lines[at] = format!("{key} = -{}", chance.below(100)),
        _ => lines[at] = format!("{key} = \"some text\""),
    }
    lines.join("\n") + "\n"
}

fn letter_lost(word: &str, chance: &mut Chance) -> String {
    let mut letters: Vec<char> = word.chars().collect();
    if !letters.is_empty() {
        letters.remove(chance.below(letters.len()));
    }
    letters.into_iter().collect()
}

fn letters_swapped(word: &str, chance: &mut Chance) -> String {
    let mut letters: Vec<char> = word.chars().collect();
    if letters.len() > 1 {
        let at = chance.below(letters.len() - 1);
        letters.swap(at, at + 1);
    }
    letters.into_iter().collect()
}

/// Numbers by chance, the same ones in each run of the program (splitmix64).
struct Chance(u64);

impl Chance {
    fn below(&mut self, end: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) % end.max(1) as u64) as usize
    }
}
