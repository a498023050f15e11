//! `percuss new`.

use percuss_scenario::{Template, study_templates, templates};

use crate::arguments::New;
use crate::outcome::{Failure, Status};
use crate::{new_file, terminal};

/// Prints or writes a template, or lists them.
pub fn run(arguments: &New) -> Result<Status, Failure> {
    let template = all().find(|t| Some(t.name) == arguments.template.as_deref());
    match (template, &arguments.out) {
        (Some(template), Some(out)) => {
            new_file::write(out, template.text, "give another --out")?;
            let out = out.display();
            let is_study = study_templates().contains(template);
            let command = if is_study { "sweep" } else { "run" };
            terminal::tell(&format!("{out} written; edit it and run: percuss {command} {out}"));
        }
        (Some(template), None) => terminal::print(template.text)?,
        (None, _) => list()?,
    }
    Ok(Status::Done)
}

/// Scenarios, then studies.
fn all() -> impl Iterator<Item = &'static Template> {
    templates().iter().chain(study_templates())
}

fn list() -> Result<(), Failure> {
    let width = all().map(|t| t.name.len()).max().unwrap_or(0);
    for template in all() {
        terminal::print(&format!("{:width$}  {}\n", template.name, template.summary))?;
    }
    terminal::tell("\nTo start from one of them: percuss new NAME --out my.toml");
    Ok(())
}
