//! Nothing that stands in a file, a name or an argument is obeyed by the terminal.
#![cfg(target_os = "linux")]

use std::process::{Command, Stdio};

use crate::common::{ELASTIC, Outcome, Sandbox};

/// Clears the screen, sets the title of the window, hides what follows, and writes from right to left.
const HOSTILE: &str = "\u{1b}[2J\u{1b}]0;owned\u{7}\u{1b}[8m\u{9b}31m\u{202e}";

/// Runs a command on a terminal, as `script` makes one; what it showed. None where there is no `script`.
fn on_a_terminal(sandbox: &Sandbox, arguments: &[&str]) -> Option<String> {
    let quoted = |word: &&str| format!("'{}'", word.replace('\'', "'\\''"));
    let words: Vec<String> =
        std::iter::once(&env!("CARGO_BIN_EXE_percuss")).chain(arguments).map(quoted).collect();
    let mut command = Command::new("script");
    command.args(["-qec", &words.join(" "), "/dev/null"]).current_dir(sandbox.path(""));
    command.env("TERM", "xterm").env_remove("NO_COLOR").stdin(Stdio::null());
    let output = command.output().ok()?;
    Some(String::from_utf8_lossy(&output.stdout).into_owned())
}

/// Whether nothing hostile is in a text: its own styles are colours and bold, and bars move the cursor.
fn is_harmless(text: &str) -> bool {
    let hostile = ["\u{1b}[2J\u{1b}]", "\u{1b}]0;", "\u{7}", "\u{1b}[8m", "\u{9b}", "\u{202e}"];
    hostile.iter().all(|one| !text.contains(one))
}

#[test]
fn nothing_of_a_file_or_an_argument_reaches_the_terminal_unescaped() {
    let sandbox = Sandbox::new();
    let toml: String = HOSTILE.chars().map(|c| format!("\\u{:04x}", u32::from(c))).collect();
    let title = format!("title = \"a {toml} title\"\n");
    let rest = ELASTIC.split_once('\n').expect("lines").1;
    sandbox.put("titled.toml", format!("{title}{rest}"));
    let named = format!("{HOSTILE}.toml");
    sandbox.put(&named, ELASTIC);
    sandbox
        .put("unit.toml", format!("{ELASTIC}\n[material.x]\nyoung = \"1 {toml}\"\ndensity = 1\n"));
    sandbox.put("key.toml", format!("{ELASTIC}\n[beam.\"{toml}\"]\nsection = \"{toml}\"\n"));
    sandbox.put("value.toml", format!("{ELASTIC}\n[load.weight]\nkind = \"{toml}\"\n"));
    sandbox.put("raw.toml", format!("{ELASTIC}\n# {HOSTILE}\n[load.{HOSTILE}]\n"));
    let (set, out) = (format!("{HOSTILE}=1"), format!("out{HOSTILE}"));
    let value = format!("time.end={HOSTILE}");
    let commands: [&[&str]; 12] = [
        &["run", "titled.toml", "--out", "titled", "--no-report"],
        &["check", &named],
        &["run", &named, "--out", "named", "--no-report"],
        &["check", "unit.toml"],
        &["check", "key.toml"],
        &["check", "value.toml"],
        &["check", "raw.toml"],
        &["check", "elastic.toml", "--set", &set],
        &["check", "elastic.toml", "--set", &value],
        &["run", "elastic.toml", "--no-report", "--out", &out],
        &["report", HOSTILE],
        &[HOSTILE],
    ];
    for arguments in commands {
        let output = sandbox.command(arguments).output().expect("the command starts");
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(is_harmless(&said) && !said.contains('\u{1b}'), "{arguments:?}: {said:?}");
        let ended: Outcome = output.into();
        assert!(!ended.stderr.contains("panicked"), "{arguments:?}: {}", ended.stderr);
        let Some(shown) = on_a_terminal(&sandbox, arguments) else { continue };
        assert!(!shown.is_empty() && is_harmless(&shown), "{arguments:?}: {shown:?}");
    }
}
