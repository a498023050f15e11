//! The whole book: pages written here and by hand, into one folder for mdBook.

use std::path::{Path, PathBuf};
use std::{fs, io};

use percuss_codes::Code;
use percuss_scenario::{reference, study_reference};

use crate::code_pages::{self, Provocations};
use crate::excerpts::{files, samples};
use crate::gallery;
use crate::links::{self, broken};
use crate::maths;
use crate::running::{self, Effort};
use crate::sandbox::Sandbox;
use crate::scenario_pages::{Page, reference_pages};

/// What the book is made of, and where it goes.
#[derive(Clone, Debug)]
pub struct Sources {
    /// The repository.
    pub repository: PathBuf,
    /// The command that pages call `percuss`.
    pub percuss: PathBuf,
    /// Where the sources for mdBook go.
    pub out: PathBuf,
    /// How much of the pages is run.
    pub effort: Effort,
}

/// Pages written by hand, with their paths within the book: those of `docs/book/src`, and guides of `docs`.
///
/// # Errors
/// A folder that cannot be read.
pub fn authored(repository: &Path) -> io::Result<Vec<(String, String)>> {
    let mut pages = Vec::new();
    let docs = repository.join("docs");
    for (from, to) in [
        ("book/src", ""),
        ("book/src/tasks", "tasks/"),
        ("book/src/theory", "theory/"),
        ("book/src/verification", "verification/"),
        ("", "guides/"),
    ] {
        for path in files(&docs.join(from), "md")? {
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            pages.push((format!("{to}{name}"), fs::read_to_string(&path)?));
        }
    }
    Ok(pages)
}

/// Writes the book's sources; what went wrong.
///
/// # Errors
/// A file that cannot be read or written.
pub fn build(of: &Sources) -> io::Result<Vec<String>> {
    let mut faults = Vec::new();
    let source = of.out.join("src");
    if source.exists() {
        fs::remove_dir_all(&source)?;
    }
    let docs = of.repository.join("docs");
    let samples = samples(&of.repository)?;
    let mut pages = reference_pages("scenario", &reference(), &samples);
    pages.extend(reference_pages("study", &study_reference(), &samples));
    pages.push(code_pages::index());
    let provocations = Provocations::load(&docs.join("book/codes.toml"))?;
    for code in Code::all() {
        let sandbox = Sandbox::new(of.out.join("work").join(code.code), &of.percuss)?;
        let provoked = provocations.provoke(code, &sandbox)?;
        faults.extend(provoked.faults);
        pages.push(provoked.page);
    }
    pages.extend(verification(of, &source, &mut faults)?);
    pages.extend(pictures(of, &samples, &source, &mut faults)?);
    let mut summary = String::new();
    for (path, text) in authored(&of.repository)? {
        if path == "SUMMARY.md" {
            summary = text;
            continue;
        }
        let folder = of.out.join("work").join(path.replace(['/', '.'], "-"));
        let sandbox = Sandbox::new(folder, &of.percuss)?;
        let (text, wrong) = running::run(&text, &sandbox, of.effort)?;
        faults.extend(wrong.into_iter().map(|fault| format!("{path}: {fault}")));
        let (text, wrong) = maths::set(&text, &chapter(&path));
        faults.extend(wrong.into_iter().map(|fault| format!("{path}: {fault}")));
        let text = at_home(&text, &path, &sandbox, of)?;
        write(&source.join(&path), &text)?;
    }
    for page in &pages {
        write(&source.join(&page.path), &page.text)?;
    }
    write(&source.join("SUMMARY.md"), &contents(&summary, &pages, &source))?;
    for name in ["book.toml", "book.css"] {
        fs::copy(docs.join("book").join(name), of.out.join(name))?;
    }
    faults.extend(
        broken(&source).into_iter().map(|link| format!("a link that leads nowhere: {link}")),
    );
    Ok(faults)
}

/// The number that a page of the theory begins with, for its equations.
fn chapter(path: &str) -> String {
    let name = path.rsplit('/').next().unwrap_or(path);
    let digits: String = name.chars().take_while(char::is_ascii_digit).collect();
    if digits.is_empty() { digits } else { format!("{}.", digits.trim_start_matches('0')) }
}

fn write(path: &Path, text: &str) -> io::Result<()> {
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder)?;
    }
    fs::write(path, text)
}

/// Pages that `percuss verify --book` writes.
fn verification(of: &Sources, source: &Path, faults: &mut Vec<String>) -> io::Result<Vec<Page>> {
    let folder = source.join("verification");
    fs::create_dir_all(&folder)?;
    if of.effort == Effort::Quick {
        return Ok(Vec::new());
    }
    let sandbox = Sandbox::new(of.out.join("work/verification"), &of.percuss)?;
    let outcome =
        sandbox.run(&format!("percuss verify --book '{}'", folder.canonicalize()?.display()))?;
    if !outcome.success {
        faults.push(outcome.text);
    }
    let mut pages = Vec::new();
    for path in files(&folder, "md")? {
        let text = fs::read_to_string(&path)?;
        let title = text.lines().next().unwrap_or_default().trim_start_matches("# ").to_string();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        pages.push(Page { path: format!("verification/{name}"), title, text });
    }
    Ok(pages)
}

/// The gallery, its films beside it.
fn pictures(
    of: &Sources,
    samples: &[crate::excerpts::Sample],
    source: &Path,
    faults: &mut Vec<String>,
) -> io::Result<Option<Page>> {
    if of.effort == Effort::Quick {
        return Ok(None);
    }
    let sandbox = Sandbox::new(of.out.join("work/gallery"), &of.percuss)?;
    for sample in samples {
        sandbox.put(&sample.name, &sample.text)?;
    }
    for table in files(&of.repository.join("docs/book/examples"), "csv")? {
        let name = table.strip_prefix(&of.repository).unwrap_or(&table).display().to_string();
        sandbox.put(&name, &fs::read_to_string(&table)?)?;
    }
    let sections = gallery::sections(&of.repository.join("docs/book/gallery.toml"))?;
    let (page, wrong) = gallery::gallery(&sections, samples, &sandbox)?;
    faults.extend(wrong);
    for target in links::targets(&page.text) {
        fs::copy(sandbox.path(&target), source.join(&target))?;
    }
    Ok(Some(page))
}

/// A page whose pictures lie beside it, and whose links to files of the repository are their names.
fn at_home(text: &str, path: &str, sandbox: &Sandbox, of: &Sources) -> io::Result<String> {
    let mut out = text.to_string();
    let folder = of.out.join("src").join(path).parent().map(Path::to_path_buf).unwrap_or_default();
    fs::create_dir_all(&folder)?;
    // Where the page lies in the repository: a guide in docs.
    let home = if path.starts_with("guides/") {
        of.repository.join("docs")
    } else {
        of.repository.join("docs/book/src")
    };
    for target in links::targets(text) {
        let (file, _) = target.split_once('#').unwrap_or((&target, ""));
        if file.is_empty() || file.contains("://") {
            continue;
        }
        let made = sandbox.path(file);
        let stem = path.replace('/', "-").replace(".md", "");
        if made.is_file() {
            let name = format!("{stem}-{}", file.replace('/', "-"));
            fs::copy(made, folder.join(&name))?;
            out = out.replace(&format!("]({target})"), &format!("]({name})"));
        } else if home.join(file).is_file() && !file.ends_with(".md") {
            let name = format!("{stem}-{}", file.rsplit('/').next().unwrap_or(file));
            fs::copy(home.join(file), folder.join(&name))?;
            out = out.replace(&format!("]({target})"), &format!("]({name})"));
        } else if file.starts_with("../") && path.starts_with("guides/") {
            out = unlinked(&out, &target);
        }
    }
    Ok(out)
}

/// `[text](target)` as `text`.
fn unlinked(text: &str, target: &str) -> String {
    let link = format!("]({target})");
    let mut out = text.to_string();
    while let Some(end) = out.find(&link) {
        let Some(begin) = out[..end].rfind('[') else { break };
        out.replace_range(end..end + link.len(), "");
        out.replace_range(begin..=begin, "");
    }
    out
}

/// The table of contents: `<!-- pages of FOLDER -->` stands for those written here.
///
/// What a quick build leaves out has no entry.
fn contents(summary: &str, pages: &[Page], source: &Path) -> String {
    let mut out = String::new();
    for line in summary.lines() {
        let folder =
            line.trim().strip_prefix("<!-- pages of ").and_then(|l| l.strip_suffix(" -->"));
        let Some(folder) = folder else {
            if links::targets(line).iter().any(|target| !source.join(target).is_file()) {
                continue;
            }
            out.push_str(&format!("{line}\n"));
            continue;
        };
        let indent = &line[..line.len() - line.trim_start().len()];
        for page in pages.iter().filter(|page| page.path.starts_with(&format!("{folder}/"))) {
            if !page.path.ends_with("/index.md") {
                let title = page.title.replace('[', "\\[").replace(']', "\\]");
                out.push_str(&format!("{indent}- [{title}]({})\n", page.path));
            }
        }
    }
    out
}
