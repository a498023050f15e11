//! Links between the pages of the book.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use crate::fences::{Part, parts};

/// Links of pages below `source` that lead nowhere.
pub fn broken(source: &Path) -> Vec<String> {
    let mut pages = Vec::new();
    below(source, &mut pages);
    let mut found = Vec::new();
    for page in pages.iter().filter(|path| path.extension().is_some_and(|e| e == "md")) {
        let text = fs::read_to_string(page).unwrap_or_default();
        for target in targets(&text) {
            if target.contains("://") || target.starts_with("mailto:") {
                continue;
            }
            let (path, anchor) = target.split_once('#').unwrap_or((&target, ""));
            let aim = match path {
                "" => page.clone(),
                _ => page.parent().unwrap_or(source).join(path),
            };
            let there = match anchor {
                "" => aim.is_file(),
                _ => fs::read_to_string(&aim).is_ok_and(|text| anchors(&text).contains(anchor)),
            };
            if !there {
                let name = page.strip_prefix(source).unwrap_or(page).display();
                found.push(format!("{name}: {target}"));
            }
        }
    }
    found
}

fn below(folder: &Path, all: &mut Vec<PathBuf>) {
    let mut paths: Vec<PathBuf> =
        fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path()).collect();
    paths.sort();
    for path in paths {
        if path.is_dir() { below(&path, all) } else { all.push(path) }
    }
}

/// What the links and pictures of a page lead to.
pub fn targets(page: &str) -> Vec<String> {
    let lines = parts(page).into_iter().filter_map(|part| match part {
        Part::Line(line) => Some(line),
        Part::Fence(_) => None,
    });
    let mut found = Vec::new();
    for line in lines {
        let line = without_code(&line);
        for piece in line.split("](").skip(1) {
            found.extend(piece.split_once(')').map(|(target, _)| target.trim().to_string()));
        }
    }
    found
}

/// A line without what stands in backticks.
fn without_code(line: &str) -> String {
    line.split('`').step_by(2).collect::<Vec<_>>().join("`")
}

/// Anchors of a page: its headings as mdBook names them, and ids that it gives.
fn anchors(page: &str) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    for part in parts(page) {
        let Part::Line(line) = part else { continue };
        if let Some(heading) = line.strip_prefix('#') {
            let id = anchor(heading.trim_start_matches('#').trim());
            let same = (0..).map(|k| if k == 0 { id.clone() } else { format!("{id}-{k}") });
            found.extend(same.into_iter().find(|one| !found.contains(one)));
        }
        for piece in line.split("id=\"").skip(1) {
            found.extend(piece.split_once('"').map(|(id, _)| id.to_string()));
        }
    }
    found
}

fn anchor(heading: &str) -> String {
    let kept = heading.chars().filter_map(|c| match c {
        c if c.is_alphanumeric() || c == '_' || c == '-' => Some(c.to_ascii_lowercase()),
        c if c.is_whitespace() => Some('-'),
        _ => None,
    });
    kept.collect()
}
