//! Runs that end while something is still in contact.

use percuss_study::analysis::Population;
use percuss_study::{Done, Folder, Study, Table, report, sweep};

const STUDY: &str = r#"
scenario = """
[material.m]
young = "210 GPa"
density = "7850 kg/m^3"
[section.s]
shape = "rectangle"
width = "50 mm"
depth = "40 mm"
[beam.b]
points = [[0, 0], ["1.5 m", 0]]
elements = 8
material = "m"
section = "s"
[support.a]
at = "b.start"
kind = "clamp"
[support.z]
at = "b.end"
kind = "pin"
[projectile.p]
kind = "elastic"
mass = "8 kg"
stiffness = "2e6 N/m"
velocity = [0, "-4 m/s"]
strikes = "b.mid"
standoff = "2 mm"
[time]
end = "12 ms"
step = "50 us"
"""
seed = 11
[parameter.speed]
path = "projectile.p.velocity[1]"
distribution = { kind = "uniform", from = "-8 m/s", to = "-1 m/s" }
[parameter.mass]
path = "projectile.p.mass"
distribution = { kind = "lognormal", mean = "8 kg", deviation = "3 kg" }
[parameter.k]
path = "projectile.p.stiffness"
distribution = { kind = "normal", mean = "2e6 N/m", deviation = "4e5 N/m", truncated = ["1e6 N/m", "3e6 N/m"] }
[design]
kind = "monte-carlo"
runs = 240
[results]
F = "contact.p.peak_force.value"
v = "projectile.p.velocity_final[1]"
dur = "contact.p.duration"
"#;

fn done(text: &str) -> (Study, Table) {
    let study = Study::from_toml(text, "study.toml").unwrap_or_else(|faults| panic!("{faults}"));
    let folder = tempfile::tempdir().unwrap();
    let folder = Folder::open(folder.path().join("out"), &study).unwrap();
    let all: Vec<u64> = (0..study.shard_count()).collect();
    assert_eq!(sweep(&study, &folder, &all, 1, &|_| true).unwrap(), Done::All);
    folder.finish(&study).unwrap();
    let table = folder.results(&study).unwrap();
    (study, table)
}

/// What a run of 12 ms tells of the duration holds in one of 60 ms, of the same draws, in which every contact opens.
#[test]
fn contacts_closed_at_the_end_are_counted_and_bounded() {
    let (study, table) = done(STUDY);
    let (longer, settled) = done(&STUDY.replace("12 ms", "60 ms"));
    let of =
        |study: &Study, table: &Table, name| Population::of(study, table, name).expect("numbers");
    let (short, long) = (of(&study, &table, "dur"), of(&longer, &settled, "dur"));
    assert!(long.open.is_empty() && short.open.len() > 10, "{} open", short.open.len());
    let mut reported = 0;
    for x in (1..60).map(|k| f64::from(k) * 2.5e-4) {
        let ([least, most], [truth, same]) = (short.above(x), long.above(x));
        assert_eq!(truth, same);
        assert!((least..=most).contains(&truth), "{x}: {truth} not in {least} to {most}");
        reported += usize::from(truth > 0 && least == most);
    }
    assert!(reported > 10, "what all runs have reached is known: {reported}");
    // Values of runs that are settled stand where they stood.
    let [a, b] = [&table, &settled].map(|table| table.numbers("dur").expect("numbers"));
    let open = table.numbers("open.dur").expect("a column");
    for ((a, b), open) in a.iter().zip(&b).zip(&open) {
        assert!(a.is_nan() != open.is_nan() || b.is_nan(), "{a} {b} {open}");
        assert!(open.is_nan() || *open <= *b, "{open} is the least value of {b}");
    }
    let page = report(&study, &table, &[]);
    for words in
        ["dur: in ", "a contact was still closed at the end", "v: in ", "Set a later time.end"]
    {
        assert!(page.contains(words), "{words}");
    }
    let page = report(&longer, &settled, &[]);
    assert!(!page.contains("dur: in "));
}

/// A force that has passed a first maximum may grow beyond it while the contact is closed: with a later end it is three times as large.
#[test]
fn peak_forces_of_closed_contacts_are_open_past_a_first_maximum_too() {
    let text = r#"
scenario = """
[material.mat]
young = "200 GPa"
density = 7850
[section.sec]
shape = "rectangle"
width = "50 mm"
depth = "50 mm"
[beam.a]
points = [[0, 0], [2, 0]]
elements = 6
material = "mat"
section = "sec"
[support.s]
at = "a.start"
kind = "clamp"
[support.e]
at = "a.end"
kind = "clamp"
[projectile.p]
kind = "elastic"
mass = 200
stiffness = "10 MN/m"
velocity = [0, -10]
strikes = "a.mid"
standoff = "1 mm"
[time]
end = "4 ms"
step = "50 us"
"""
seed = 1
[parameter.v]
path = "projectile.p.velocity[1]"
distribution = { kind = "uniform", from = -12, to = -8 }
[design]
kind = "monte-carlo"
runs = 10
[results]
peak = "contact.p.peak_force.value"
first = "contact.p.intervals[0].peak_force.value"
"#;
    let ((study, short), (_, long)) = (done(text), done(&text.replace("4 ms", "30 ms")));
    for name in ["peak", "first"] {
        let population = Population::of(&study, &short, name).expect("numbers");
        assert_eq!(population.open.len(), 10, "{name}");
        let [open, settled] = [(&short, format!("open.{name}")), (&long, name.to_owned())]
            .map(|(table, name)| table.numbers(&name).expect("numbers"));
        for (open, settled) in open.iter().zip(&settled) {
            assert!(*settled > 2.0 * open, "{name}: {open} {settled}");
        }
    }
}
