//! The gallery: scenarios in motion, each with its statement in a line, as `docs/book/gallery.toml` lists them.

use std::io;
use std::path::Path;

use percuss_scenario::{is_study, read};
use serde_json::Value;
use toml_edit::{DocumentMut, Item, TableLike};

use crate::excerpts::Sample;
use crate::measured;
use crate::sandbox::Sandbox;
use crate::scenario_pages::Page;

/// A scenario of the gallery.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Scene {
    /// Its file, from the root of the repository.
    pub file: String,
    /// What it teaches, in a line; formulas in braces over its summary.
    pub statement: String,
    /// What must hold of its summary for that, shape (conditions).
    pub holds: Vec<String>,
    /// Options of `percuss animate` for its film.
    pub film: String,
}

/// A heading of the gallery and what stands below it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GallerySection {
    /// The heading.
    pub title: String,
    /// The scenarios, in their order, shape (scenes).
    pub scenes: Vec<Scene>,
}

fn document(path: &Path) -> io::Result<DocumentMut> {
    std::fs::read_to_string(path)?.parse().map_err(io::Error::other)
}

/// A list of texts.
fn list(of: &dyn TableLike, key: &str) -> Vec<String> {
    let array = of.get(key).and_then(Item::as_array);
    array.into_iter().flatten().filter_map(|v| v.as_str().map(str::to_string)).collect()
}

/// Files that the list of the gallery leaves out.
///
/// # Errors
/// The list cannot be read, or is no TOML.
pub fn left_out(path: &Path) -> io::Result<Vec<String>> {
    Ok(list(document(path)?.as_table(), "left_out"))
}

/// The list of the gallery.
///
/// # Errors
/// The file cannot be read, or is no TOML.
pub fn sections(path: &Path) -> io::Result<Vec<GallerySection>> {
    let document = document(path)?;
    let word = |of: &dyn TableLike, key: &str| {
        of.get(key).and_then(Item::as_str).unwrap_or_default().trim().to_string()
    };
    let tables = |of: &dyn TableLike, key: &str| -> Vec<toml_edit::Table> {
        let all = of.get(key).and_then(Item::as_array_of_tables);
        all.into_iter().flatten().cloned().collect()
    };
    let scene = |of: &toml_edit::Table| Scene {
        file: word(of, "file"),
        statement: word(of, "statement"),
        holds: list(of, "holds"),
        film: word(of, "film"),
    };
    let section = |of: &toml_edit::Table| GallerySection {
        title: word(of, "title"),
        scenes: tables(of, "scene").iter().map(scene).collect(),
    };
    Ok(tables(document.as_table(), "section").iter().map(section).collect())
}

/// Whether a sample has a place in the gallery: a scenario that runs by itself, templates and twins in the paper's form apart.
pub fn is_shown(sample: &Sample) -> bool {
    let given = sample.text.contains("\"given\"");
    let template = sample.name.contains("/templates/");
    !is_study(&sample.text) && !given && !template && !sample.name.ends_with("-paper.toml")
}

impl Scene {
    /// The statement with its figures; what does not hold.
    pub fn filled(&self, summary: &Value) -> (String, Vec<String>) {
        let mut faults: Vec<String> =
            self.holds.iter().filter_map(|claim| measured::holds(claim, summary).err()).collect();
        let text = measured::filled(&self.statement, summary).unwrap_or_else(|fault| {
            faults.push(fault);
            self.statement.clone()
        });
        (text, faults.into_iter().map(|fault| format!("{}: {fault}", self.file)).collect())
    }

    /// Runs it, with a film beside the page; what the page says of it.
    fn shown(
        &self,
        sample: &Sample,
        sandbox: &Sandbox,
        faults: &mut Vec<String>,
    ) -> io::Result<String> {
        let name = self.file.replace(['/', '.'], "-");
        let title = read(&sample.text, &sample.name).map(|s| s.content().title.clone());
        let title = title.ok().filter(|t| !t.is_empty()).unwrap_or_else(|| self.file.clone());
        let commands = format!(
            "percuss run '{}' --out runs/{name} --quiet --no-report && \
             percuss animate runs/{name} -o {name}.gif --duration \"4 s\" --fps 12 --width 480 {} --quiet",
            self.file, self.film
        );
        let outcome = sandbox.run(&commands)?;
        if !outcome.success {
            faults.push(format!("{}: {}", self.file, outcome.text));
            return Ok(String::new());
        }
        let summary = std::fs::read(sandbox.path(&format!("runs/{name}/summary.json")))?;
        let summary: Value = serde_json::from_slice(&summary).map_err(io::Error::other)?;
        let (statement, wrong) = self.filled(&summary);
        faults.extend(wrong);
        Ok(format!(
            "### {title}\n\n{statement}\n\n![{title}]({name}.gif)\n\n<details><summary><code>{}</code></summary>\n\n```toml\n{}\n```\n\n</details>\n\n",
            self.file,
            sample.text.trim_end()
        ))
    }
}

/// Runs every scenario of the list, with a film of each beside the page.
///
/// # Errors
/// A file that cannot be written.
pub fn gallery(
    sections: &[GallerySection],
    samples: &[Sample],
    sandbox: &Sandbox,
) -> io::Result<(Page, Vec<String>)> {
    let mut faults = Vec::new();
    let mut text = String::from(
        "# Gallery\n\nEach film is made by `percuss run FILE --out runs/NAME` and `percuss animate runs/NAME -o NAME.gif`; displacements are to scale. \
         Figures in the sentences are those of the run. Behind the name below a film is the file.\n\n",
    );
    for section in sections {
        text.push_str(&format!("## {}\n\n", section.title));
        for scene in &section.scenes {
            match samples.iter().find(|sample| sample.name == scene.file) {
                Some(sample) => text.push_str(&scene.shown(sample, sandbox, &mut faults)?),
                None => faults.push(format!("gallery: there is no {}", scene.file)),
            }
        }
    }
    Ok((Page { path: "gallery.md".into(), title: "Gallery".into(), text }, faults))
}
