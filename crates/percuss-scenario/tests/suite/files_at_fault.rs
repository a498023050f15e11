//! Faults of the text itself, and how faults are shown.

use percuss_scenario::{load, read};

const ELASTIC: &str = include_str!("../files/elastic.toml");

fn faults(text: &str) -> String {
    read(text, "f.toml").expect_err(text).to_string()
}

#[test]
fn every_syntax_error_is_reported() {
    let text = ELASTIC
        .replace("\"0.2e10 Pa\"", "0.2e10 Pa")
        .replace("elements = 6", "elements = ")
        .replace("\"1e-4 s\"", "\"1e-4 s");
    let all = faults(&text);
    let lines: Vec<&str> = all.lines().collect();
    assert_eq!(lines.len(), 3, "{all}");
    assert_eq!(
        lines[0],
        "f.toml:4:9: found `0.2e10 Pa` without quotes, expected quotes round a text: \"0.2e10 Pa\""
    );
    assert!(lines[1].starts_with("f.toml:15:12: found no value"), "{all}");
    assert!(lines[2].starts_with("f.toml:38:15: found invalid TOML"), "{all}");
}

#[test]
fn values_at_fault_appear_beside_syntax_errors() {
    let text = ELASTIC.replace("500 kg", "500 m").replace("end = \"0.15 s\"", "end = 0.15 s");
    let all = faults(&text);
    assert_eq!(all.lines().count(), 2, "{all}");
    assert!(all.contains("projectile.mass.mass: found \"500 m\""), "{all}");
    // With a broken header nobody knows what the keys below it belong to.
    let all = faults(&text.replace("[section.plank]", "[section.plank"));
    assert!(!all.contains("projectile.mass.mass"), "{all}");
}

#[test]
fn a_key_given_twice_is_a_fault_at_its_second_place() {
    let all = faults(&ELASTIC.replace("elements = 6", "elements = 6\nelements = 7"));
    assert_eq!(all, "f.toml:16:1: found a key given twice, expected each key once");
}

#[test]
fn an_empty_file_says_what_is_missing() {
    for text in ["", "\n \n", "\u{feff}"] {
        assert!(faults(text).starts_with("f.toml: found an empty file"));
    }
    assert!(faults("# nothing but a comment\n").contains("found no beam"));
}

#[test]
fn columns_count_characters_and_lines_survive_windows() {
    let all =
        faults(&format!("\u{feff}{}", ELASTIC.replace('\n', "\r\n").replace("500 kg", "5 kgg")));
    assert!(all.starts_with("f.toml:29:11: "), "{all}");
    let all = faults(&ELASTIC.replace("title = \"E", "titlé = \"E"));
    assert!(all.starts_with("f.toml:1:"), "{all}");
    let all = faults(&ELASTIC.replace("[0, \"20 m/s\"]", "[\"ä µ\", \"20 kgg\"]"));
    assert!(all.contains("f.toml:31:14: ") && all.contains("f.toml:31:24: "), "{all}");
}

#[test]
fn a_file_that_is_not_utf8_says_where() {
    let path = std::env::temp_dir().join(format!("percuss-latin1-{}.toml", std::process::id()));
    std::fs::write(&path, b"# one\ntitle = \"\xfcber\"\n").unwrap();
    let fault = load(&path).unwrap_err();
    std::fs::remove_file(&path).unwrap();
    assert_eq!((fault.all()[0].line, fault.all()[0].column), (2, 10));
    assert!(fault.to_string().contains("found the byte 0xfc, which is not UTF-8"));
    assert!(fault.fancy(false, 80).contains("title = "));
}

#[test]
fn the_report_underlines_every_fault_in_its_line() {
    let text = ELASTIC.replace("1e3 cm^2", "8330 cm^4").replace("500 kg", "500 Kg");
    let report = read(&text, "f.toml").unwrap_err().fancy(false, 100);
    let expected = [
        "  × section.plank.area: found \"8330 cm^4\", which is a second moment of area (m^4)",
        "   ╭─[f.toml:9:8]",
        " 9 │ area = \"8330 cm^4\"",
        "   ·        ───────────",
        "   ╰────",
        "  help: expected an area (m^2), such as \"1e3 cm^2\" [E006]",
        "  × projectile.mass.mass: found the unknown unit `Kg`",
        "    ╭─[f.toml:29:13]",
        " 29 │ mass = \"500 Kg\"",
        "    ·             ──",
        "    ╰────",
        "  help: expected a known unit (did you mean `kg`?) [E006]",
    ];
    assert_eq!(report.lines().map(str::trim_end).collect::<Vec<_>>(), expected);
    assert!(read(&text, "f.toml").unwrap_err().fancy(true, 100).contains("\u{1b}["));
}
