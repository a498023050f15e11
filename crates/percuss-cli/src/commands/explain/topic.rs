//! Topics of `percuss explain`.

use percuss_codes::{Code, Group};
use percuss_scenario::content::SteelProfile;
use percuss_scenario::{TableForm, TableReference, reference, study_reference};

use super::print::{self, paragraph, title};

/// A topic.
#[derive(Clone, Debug)]
pub struct Topic {
    /// Its explanation.
    pub text: String,
}

/// Explains a code, or a table, a key or a word of the file formats: `W002`, `beam`, `projectile.stiffness`, `hertz`; of a steel profile or its
/// series the key that takes it.
///
/// # Errors
/// There is no such topic.
pub fn topic(name: &str) -> Result<Topic, String> {
    if let Some(code) = Code::find(name) {
        let text = format!("{}\n\n{}\n", heading(code), paragraph(code.explanation));
        return Ok(Topic { text });
    }
    if SteelProfile::is_series(name) || SteelProfile::find(name).is_some() {
        let text = print::text(&reference(), "section.profile", "").unwrap_or_default();
        return Ok(Topic { text });
    }
    let formats = [(reference(), ""), (study_reference(), " of a study")];
    let texts = formats.iter().filter_map(|(format, of)| print::text(format, name, of));
    match texts.collect::<Vec<_>>().join("\n") {
        text if text.is_empty() => {
            Err("no such code, table, key or word; `percuss explain` lists codes and tables".into())
        }
        text => Ok(Topic { text }),
    }
}

fn heading(one: Code) -> String {
    format!("{}  {}", one.code, one.name)
}

/// All codes, and the tables of the file formats.
pub fn list() -> String {
    let mut all: Vec<String> = Code::groups().iter().map(of_group).collect();
    all.push(of_format("Tables of scenario files", &reference()));
    all.push(of_format("Tables of study files", &study_reference()));
    all.join("\n")
}

fn of_group(group: &Group) -> String {
    let codes: String = group.codes.iter().map(|one| format!("  {}\n", heading(*one))).collect();
    format!("{}\n{codes}", group.name)
}

fn of_format(name: &str, format: &[TableReference]) -> String {
    let has_header =
        |table: &&TableReference| matches!(table.form, TableForm::Once | TableForm::Named);
    let line = |table: &TableReference| format!("  {}  {}\n", title(table), table.body.about);
    let lines: String = format.iter().filter(has_header).map(line).collect();
    format!("{name}\n{lines}")
}
