//! Imports run one way: between modules in the order, and between crates along the dependencies, that ARCHITECTURE.md publishes.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use syn::visit::{self, Visit};

/// The repository's root.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The block of code that follows a sentence of ARCHITECTURE.md, lines that continue another one left out.
fn block_after(sentence: &str) -> Vec<String> {
    let text = fs::read_to_string(root().join("ARCHITECTURE.md")).unwrap();
    let (_, rest) = text.split_once(sentence).unwrap_or_else(|| panic!("no `{sentence}`"));
    let block = rest.split("```").nth(1).unwrap();
    let begins = |line: &&str| line.starts_with(|c: char| c.is_ascii_lowercase());
    block.lines().filter(begins).map(str::to_owned).collect()
}

/// Modules of the mechanics, lowest first.
fn published_modules() -> Vec<String> {
    let lines = block_after("a line may use the lines above it:");
    let name = |line: String| {
        let word = line.split_whitespace().next().unwrap();
        word.trim_end_matches('/').to_owned()
    };
    lines.into_iter().map(name).collect()
}

/// Paths of a source file that lead from one module of the crate to another one.
struct Imports<'a> {
    modules: &'a [String],
    /// Path of the module that is read, from the root of the crate.
    here: Vec<String>,
    /// Imported modules, or names of the root, which hide their module.
    found: Vec<String>,
}

impl Imports<'_> {
    /// Adds a path; one that does not lead through the root of the crate imports nothing.
    fn take(&mut self, path: &[String]) {
        let ups = path.iter().take_while(|part| *part == "super").count();
        let from_root = match path.first().map(String::as_str) {
            Some("crate") => &path[1..],
            Some("super") if ups == self.here.len() => &path[ups..],
            _ => return,
        };
        if let Some(name) = from_root.first()
            && self.here.first() != Some(name)
        {
            self.found.push(name.clone());
        }
    }

    fn take_tree(&mut self, tree: &syn::UseTree, before: &[String]) {
        let with = |ident: &syn::Ident| [before, &[ident.to_string()]].concat();
        match tree {
            syn::UseTree::Path(path) => self.take_tree(&path.tree, &with(&path.ident)),
            syn::UseTree::Name(name) => self.take(&with(&name.ident)),
            syn::UseTree::Rename(name) => self.take(&with(&name.ident)),
            syn::UseTree::Glob(_) => self.take(&[before, &["*".to_owned()]].concat()),
            syn::UseTree::Group(group) => {
                group.items.iter().for_each(|tree| self.take_tree(tree, before));
            }
        }
    }
}

pub fn is_test(attributes: &[syn::Attribute]) -> bool {
    let test = |list: &syn::MetaList| list.tokens.to_string() == "test";
    let is = |a: &syn::Attribute| a.path().is_ident("cfg") && a.meta.require_list().is_ok_and(test);
    attributes.iter().any(is)
}

impl<'ast> Visit<'ast> for Imports<'_> {
    fn visit_item(&mut self, item: &'ast syn::Item) {
        let attributes: &[syn::Attribute] = match item {
            syn::Item::Mod(item) => &item.attrs,
            syn::Item::Use(item) => &item.attrs,
            syn::Item::Fn(item) => &item.attrs,
            syn::Item::Impl(item) => &item.attrs,
            _ => &[],
        };
        if !is_test(attributes) {
            visit::visit_item(self, item);
        }
    }

    fn visit_item_mod(&mut self, item: &'ast syn::ItemMod) {
        self.here.push(item.ident.to_string());
        visit::visit_item_mod(self, item);
        self.here.pop();
    }

    fn visit_item_use(&mut self, item: &'ast syn::ItemUse) {
        self.take_tree(&item.tree, &[]);
    }

    fn visit_path(&mut self, path: &'ast syn::Path) {
        let parts: Vec<String> = path.segments.iter().map(|s| s.ident.to_string()).collect();
        self.take(&parts);
        visit::visit_path(self, path);
    }

    /// Arguments of a macro are no syntax before it is expanded: words after `crate ::` count.
    fn visit_macro(&mut self, of: &'ast syn::Macro) {
        let tokens = of.tokens.to_string();
        for after in tokens.split("crate ::").skip(1) {
            let word = after.split_whitespace().next().unwrap_or("");
            if self.modules.iter().any(|module| module == word) {
                self.take(&["crate".to_owned(), word.to_owned()]);
            }
        }
        visit::visit_macro(self, of);
    }

    fn visit_visibility(&mut self, _: &'ast syn::Visibility) {}
}

/// Errors in the imports of one file, whose path is given from `src`.
fn faults_of(file: &Path, text: &str, modules: &[String]) -> Vec<String> {
    let parts = file.with_extension("");
    let mut here: Vec<String> =
        parts.iter().map(|part| part.to_str().unwrap().to_owned()).collect();
    if here.last().is_some_and(|last| last == "mod") {
        here.pop();
    }
    let level = |name: &str| modules.iter().position(|module| module == name);
    let Some(own) = level(&here[0]) else {
        return vec![format!("{}: its module has no place in ARCHITECTURE.md", file.display())];
    };
    let mut imports = Imports { modules, here, found: Vec::new() };
    imports.visit_file(&syn::parse_file(text).unwrap());
    let wrong = imports.found.iter().filter(|name| level(name).is_none_or(|theirs| theirs > own));
    let unique: BTreeSet<&String> = wrong.collect();
    unique.iter().map(|name| format!("{} uses `{name}`", file.display())).collect()
}

/// Adds the files below a folder.
pub fn sources(folder: &Path, all: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        match path.is_dir() {
            true => sources(&path, all),
            false => all.push(path),
        }
    }
}

#[test]
fn modules_use_those_above_them_in_the_architecture_only() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let modules = published_modules();
    let mut files = Vec::new();
    sources(&src, &mut files);
    files.sort();
    let mut faults = Vec::new();
    for module in &modules {
        if !src.join(module).is_dir() && !src.join(module).with_extension("rs").is_file() {
            faults.push(format!("`{module}` of ARCHITECTURE.md is no module"));
        }
    }
    for file in files {
        let name = file.strip_prefix(&src).unwrap();
        if name != Path::new("lib.rs") {
            faults.extend(faults_of(name, &fs::read_to_string(&file).unwrap(), &modules));
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// Every form of import against the order is detected; tests and comments are ignored.
#[test]
fn imports_against_the_order_are_found() {
    let modules = ["math", "model", "step"].map(str::to_owned);
    let faults = |file: &str, text: &str| faults_of(Path::new(file), text, &modules).len();
    for wrong in [
        "use crate::step::newton;",
        "pub(crate) use crate::step::*;",
        "use crate::{math::add, step::newton::{Effort, Newton as N}};",
        "fn f() { let x = crate::step::newton(); }",
        "fn f(x: &crate::step::Newton) {}",
        "impl crate::step::Step for Model {}",
        "fn f() { use crate::step::newton; }",
        "fn f() { println!(\"{}\", crate::step::newton()); }",
        "mod inner { use crate::step::newton; }",
        "use super::super::step::newton;",
        "mod inner { fn f() { super::super::super::step::newton(); } }",
        // A name of the crate's root hides where it comes from.
        "use crate::Model;",
    ] {
        assert_eq!(faults("model/builder.rs", wrong), 1, "{wrong}");
    }
    assert_eq!(faults("model/mod.rs", "use super::step::newton;"), 1);
    assert_eq!(faults("model.rs", "use super::step::newton;"), 1);
    assert_eq!(faults("unknown.rs", ""), 1);
    for right in [
        "use crate::math::add;",
        "use super::step::newton;",
        "use super::super::math::add;",
        "use crate::model::check;",
        "pub(crate) fn f() {}",
        "/// [`Step`](crate::step::Step)\nfn f() {}",
        "#[cfg(test)]\nmod tests { use crate::step::newton; }",
        "#[cfg(test)]\nuse crate::step::newton;",
    ] {
        assert_eq!(faults("model/builder.rs", right), 0, "{right}");
    }
}

/// Names of the workspace's crates among the dependencies of a Cargo.toml, those for its tests included.
fn dependencies(manifest: &Path) -> (String, BTreeSet<String>) {
    let text = fs::read_to_string(manifest).unwrap();
    let value: toml_edit::DocumentMut = text.parse().unwrap();
    let name = value["package"]["name"].as_str().unwrap().to_owned();
    // Of every system, and of one alone.
    let targets = value.get("target").and_then(toml_edit::Item::as_table).into_iter().flatten();
    let tables = targets.filter_map(|(_, target)| target.as_table()).chain([value.as_table()]);
    let all = tables.flat_map(|table| {
        let kinds = ["dependencies", "dev-dependencies", "build-dependencies"];
        kinds.into_iter().filter_map(|kind| table.get(kind)?.as_table()).flatten()
    });
    let own = all.map(|(name, _)| name).filter(|name| name.starts_with("percuss"));
    (name, own.map(str::to_owned).collect())
}

#[test]
fn crates_depend_on_each_other_as_the_architecture_says() {
    let mut published = BTreeMap::new();
    for line in block_after("Crates depend on those named beside them, all further up:") {
        let mut words = line.split_whitespace().map(str::to_owned);
        let name = words.next().unwrap();
        let uses: BTreeSet<String> = words.collect();
        for one in &uses {
            assert!(published.contains_key(one), "`{name}` stands above `{one}`, which it uses");
        }
        published.insert(name, uses);
    }
    let crates = fs::read_dir(root().join("crates")).unwrap();
    let manifests = crates.map(|one| one.unwrap().path().join("Cargo.toml"));
    let found: BTreeMap<_, _> =
        manifests.filter(|path| path.is_file()).map(|path| dependencies(&path)).collect();
    assert_eq!(found, published);
}

/// Adds the types that items declare, those of tests left out.
fn add_types(items: &[syn::Item], names: &mut Vec<String>) {
    for item in items {
        match item {
            syn::Item::Struct(i) => names.push(i.ident.to_string()),
            syn::Item::Enum(i) => names.push(i.ident.to_string()),
            syn::Item::Trait(i) => names.push(i.ident.to_string()),
            syn::Item::Type(i) => names.push(i.ident.to_string()),
            syn::Item::Mod(i) if !is_test(&i.attrs) => {
                let inner = i.content.as_ref().map_or(&[][..], |(_, items)| items);
                add_types(inner, names);
            }
            _ => {}
        }
    }
}

#[test]
fn a_name_means_one_type() {
    let mut files = Vec::new();
    sources(&root().join("crates/percuss/src"), &mut files);
    sources(&root().join("crates/percuss-batch/src"), &mut files);
    let mut homes: BTreeMap<String, Vec<PathBuf>> = BTreeMap::new();
    for path in files {
        let file = syn::parse_file(&fs::read_to_string(&path).unwrap()).unwrap();
        let mut names = Vec::new();
        add_types(&file.items, &mut names);
        names.into_iter().for_each(|name| homes.entry(name).or_default().push(path.clone()));
    }
    assert!(homes.len() > 200, "only {} types found", homes.len());
    homes.retain(|_, files| files.len() > 1);
    assert!(homes.is_empty(), "names of more than one type: {homes:#?}");
}
