//! A page for each code of an error or a warning, with an example that provokes it.

use std::io;
use std::path::Path;

use percuss_codes::{Code, Group};
use toml_edit::{DocumentMut, Item, TableLike};

use crate::sandbox::Sandbox;
use crate::scenario_pages::Page;

/// How codes are provoked: `docs/book/codes.toml`.
#[derive(Clone, Debug)]
pub struct Provocations(DocumentMut);

/// Runs, and what one shows.
#[derive(Clone, Debug)]
pub struct Provoked {
    /// The page.
    pub page: Page,
    /// What went otherwise than it should: the code was not in the output, or the correction did not help, shape (faults).
    pub faults: Vec<String>,
}

impl Provocations {
    /// Reads the file.
    ///
    /// # Errors
    /// It cannot be read, or is no TOML.
    pub fn load(path: &Path) -> io::Result<Self> {
        let text = std::fs::read_to_string(path)?;
        text.parse().map(Self).map_err(io::Error::other)
    }

    /// The test that provokes a code which no example on a page can, as `FILE::NAME`.
    pub fn test(&self, code: Code) -> Option<&str> {
        self.0.get(code.code)?.as_table_like()?.get("test")?.as_str()
    }

    /// The scenario that provokes a code, where it stands there whole.
    pub fn scenario(&self, code: &str) -> Option<&str> {
        self.0.get(code)?.as_table_like()?.get("whole")?.as_str()
    }

    /// Provokes a code: writes the scenario, changes it, runs the command.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn provoke(&self, code: Code, sandbox: &Sandbox) -> io::Result<Provoked> {
        let Code { code: id, name, explanation } = code;
        let title = format!("{id} {name}");
        let mut faults = Vec::new();
        let head = format!("# {id}: {name}\n\n{}\n\n", paragraph(explanation));
        let Some(how) = self.0.get(id).and_then(Item::as_table_like) else {
            faults.push(format!("{id}: no example in docs/book/codes.toml"));
            let page = Page { path: format!("codes/{id}.md"), title, text: head };
            return Ok(Provoked { page, faults });
        };
        let word = |key: &str| how.get(key).and_then(Item::as_str);
        let cure = word("cure")
            .map_or(String::new(), |cure| format!("\n## The cure\n\n{}\n", cure.trim()));
        if word("test").is_some() {
            let text = format!("{}\n{cure}", head.trim_end());
            return Ok(Provoked {
                page: Page { path: format!("codes/{id}.md"), title, text },
                faults,
            });
        }
        let template = word("template").unwrap_or("elastic");
        sandbox.run(&format!("percuss new {template} --out my.toml"))?;
        let mut example = change(how, sandbox, &mut faults)?;
        if let Some(study) = word("study") {
            let text = self.0.get("studies").and_then(|all| all.get(study)).and_then(Item::as_str);
            let text = text.unwrap_or_default().trim_start();
            sandbox.put("study.toml", text)?;
            example.push_str(&format!(
                "and this study of it, `study.toml`,\n\n```toml\n{text}```\n\n"
            ));
        }
        let command = word("run").unwrap_or("percuss check my.toml");
        let outcome = sandbox.run(command)?;
        if !outcome.text.contains(&format!("[{id}]")) {
            faults.push(format!("{id}: `{command}` does not tell of it:\n{}", outcome.text));
        }
        let shown: Vec<&str> =
            outcome.text.lines().filter(|line| line.contains(&format!("[{id}]"))).collect();
        let mut text = format!(
            "{head}## An example\n\nIn the scenario of `percuss new {template} --out my.toml`{example}"
        );
        text.push_str(&format!("```console\n$ {command}\n{}\n```\n", shown.join("\n")));
        text.push_str(&cure);
        Ok(Provoked { page: Page { path: format!("codes/{id}.md"), title, text }, faults })
    }
}

/// Changes the scenario as an entry says; how that is reported.
fn change(how: &dyn TableLike, sandbox: &Sandbox, faults: &mut Vec<String>) -> io::Result<String> {
    let word = |key: &str| how.get(key).and_then(Item::as_str);
    let mut shown = String::new();
    let mut text = std::fs::read_to_string(sandbox.path("my.toml"))?;
    for key in ["", "2", "3"] {
        let (from, to) = (word(&format!("replace{key}")), word(&format!("with{key}")));
        let Some((from, to)) = from.zip(to) else { continue };
        if !text.contains(from) {
            faults.push(format!("`{from}` is not in the scenario"));
        }
        text = text.replacen(from, to, 1);
        let (from, to) = (from.trim(), to.trim());
        shown.push_str(&match to {
            "" => format!(", without\n\n```toml\n{from}\n```\n\n"),
            _ => format!(", with\n\n```toml\n{to}\n```\n\ninstead of\n\n```toml\n{from}\n```\n\n"),
        });
    }
    if let Some(more) = word("append") {
        text.push_str(&format!("\n{more}"));
        shown.push_str(&format!(
            ", with these lines at the end\n\n```toml\n{}\n```\n\n",
            more.trim()
        ));
    }
    if let Some(whole) = word("whole") {
        text = whole.into();
        shown = format!(", with this in its place\n\n```toml\n{}\n```\n\n", whole.trim());
    }
    sandbox.put("my.toml", &text)?;
    Ok(if shown.is_empty() { ":\n\n".into() } else { shown })
}

fn paragraph(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The list of all codes, in their groups.
pub fn index() -> Page {
    let line = |one: &Code| format!("| [{0}]({0}.md) | {1} |\n", one.code, one.name);
    let section = |group: &Group| {
        let codes: String = group.codes.iter().map(line).collect();
        format!("## {}\n\n{}\n\n| code | about |\n|---|---|\n{codes}\n", group.name, group.about)
    };
    let sections: String = Code::groups().iter().map(section).collect();
    let text = format!(
        "# Errors and warnings\n\n\
         Every error and every warning ends with a code in brackets. The code stays the same from version to version; `percuss explain W002` \
         prints its explanation. The code is also in `summary.json` and in the tables of studies, and exceptions of the Python package have it as \
         `.code`.\n\n\
         `--deny W002`, of `run` and `check`, makes a warning an error. A warning that you accept is listed in the scenario under `[allow]`, with the \
         reason: it is then neither printed as a warning nor denied, and stays visible on the page and in `summary.json`. Warnings of the model \
         and result checks and of the audit of a run (W101 to W105) can be accepted; errors cannot, nor warnings that report on a command.\n\n\
         ```toml\n[allow]\nW007 = \"the beam is short by design\"\nW105 = \"a study of the midpoint rule\"\n```\n\n{sections}"
    );
    Page { path: "codes/index.md".into(), title: "Errors and warnings".into(), text }
}
