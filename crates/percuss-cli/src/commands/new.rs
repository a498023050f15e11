//! `percuss new`.

use std::path::Path;

use percuss_codes::FileCode;
use percuss_scenario::{Template, fit_templates, study_templates};

use crate::all_templates::all_templates;
use crate::arguments::New;
use crate::outcome::{Failure, Status};
use crate::{new_file, terminal};

/// Prints or writes a template, or lists them.
pub fn run(arguments: &New) -> Result<Status, Failure> {
    let template = all_templates().find(|t| Some(t.name) == arguments.template.as_deref());
    match (template, &arguments.out) {
        (Some(template), Some(out)) => write(template, out)?,
        (Some(template), None) => terminal::print(template.text)?,
        (None, _) => list()?,
    }
    Ok(Status::Done)
}

/// Writes a template, and files that it names beside it; those that are there already are kept.
///
/// # Errors
/// If the file exists, or has the name of one of those.
fn write(template: &Template, out: &Path) -> Result<(), Failure> {
    let own = |(name, _): &&(&str, &str)| out.file_name().is_some_and(|out| out == *name);
    if let Some((name, _)) = template.files.iter().find(own) {
        let text = format!("{name}: the template names another file so; give another --out");
        return Err(Failure::input(FileCode::Foreign, text));
    }
    new_file::write(out, template.text, "give another --out")?;
    for (name, text) in template.files {
        let path = out.with_file_name(name);
        if !path.exists() {
            new_file::write(&path, text, "remove it")?;
            terminal::tell(&format!("{} written", path.display()));
        }
    }
    let command = match template {
        one if study_templates().contains(one) => "sweep",
        one if fit_templates().contains(one) => "fit",
        _ => "run",
    };
    let out = out.display();
    terminal::tell(&format!("{out} written; edit it and run: percuss {command} {out}"));
    Ok(())
}

fn list() -> Result<(), Failure> {
    let width = all_templates().map(|t| t.name.len()).max().unwrap_or(0);
    for template in all_templates() {
        terminal::print(&format!("{:width$}  {}\n", template.name, template.summary))?;
    }
    terminal::tell("\nTo start from one of them: percuss new NAME --out FILE");
    Ok(())
}
