//! The gallery: every scenario of the repository in motion, with its one-line lesson.

use std::io;

use percuss_scenario::{is_study, read};

use crate::desk::Desk;
use crate::excerpts::Sample;
use crate::scenario_pages::Page;

/// Whether a sample has a place in the gallery: a scenario that runs by itself.
fn is_shown(sample: &Sample) -> bool {
    let given = sample.text.contains("\"given\"");
    !is_study(&sample.text) && !given && !sample.name.ends_with("-paper.toml")
}

/// The comment that a scenario begins with.
fn lesson(text: &str) -> String {
    let comment = text.lines().take_while(|line| line.starts_with('#'));
    let words: Vec<&str> = comment.map(|line| line.trim_start_matches('#').trim()).collect();
    let whole = words.join(" ");
    // The first sentence.
    whole.split_once(". ").map_or(whole.clone(), |(first, _)| format!("{first}."))
}

/// Runs every scenario, with a film of each beside the page.
///
/// # Errors
/// A file that cannot be written.
pub fn gallery(samples: &[Sample], desk: &Desk) -> io::Result<(Page, Vec<String>)> {
    let mut faults = Vec::new();
    let mut text = String::from(
        "# Gallery\n\nEvery scenario of the repository and every template, in motion: `percuss run FILE` and `percuss animate runs/NAME -o NAME.gif`. \
         Displacements are to scale; names below each film are those of the file.\n\n",
    );
    for sample in samples.iter().filter(|one| is_shown(one)) {
        let name = sample.name.replace(['/', '.'], "-");
        let title = read(&sample.text, &sample.name).map(|s| s.content().title.clone());
        let title = title.ok().filter(|t| !t.is_empty()).unwrap_or_else(|| sample.name.clone());
        let commands = format!(
            "percuss run '{}' --out runs/{name} --quiet --no-report && percuss animate runs/{name} -o {name}.gif --duration \"4 s\" --fps 12 --width 480 --quiet",
            sample.name
        );
        let outcome = desk.run(&commands)?;
        if !outcome.success {
            faults.push(format!("{}: {}", sample.name, outcome.text));
            continue;
        }
        let lesson = lesson(&sample.text);
        text.push_str(&format!(
            "## {title}\n\n{lesson}\n\n![{title}]({name}.gif)\n\n`{}`\n\n",
            sample.name
        ));
    }
    Ok((Page { path: "gallery.md".into(), title: "Gallery".into(), text }, faults))
}
