//! Which files of a crate import from which: names followed to the file that declares them.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use syn::visit::{self, Visit};

use super::layers::is_test;

/// The path of a module from the root of its crate.
type At = Vec<String>;

/// Declarations of a module, including one inside a file.
#[derive(Default)]
struct Module {
    /// Index of its file.
    file: usize,
    /// Names of items.
    items: BTreeSet<String>,
    /// Paths of imported names, by the name.
    names: BTreeMap<String, Vec<Vec<String>>>,
    /// Modules imported with all their names.
    globs: Vec<Vec<String>>,
}

/// One crate's modules.
#[derive(Default)]
struct Crate {
    files: Vec<PathBuf>,
    modules: BTreeMap<At, Module>,
}

impl Crate {
    /// Index of the file that declares a path in a module; `None` for modules, local names and other crates.
    fn home(&self, from: &[String], path: &[String], depth: usize) -> Option<usize> {
        let (first, rest) = path.split_first()?;
        match first.as_str() {
            "crate" => self.home_in(&[], rest, depth),
            "self" => self.home_in(from, rest, depth),
            "super" => self.home_in(from.split_last()?.1, rest, depth),
            _ => self.home_in(from, path, depth),
        }
    }

    fn home_in(&self, at: &[String], path: &[String], depth: usize) -> Option<usize> {
        let (first, rest) = path.split_first()?;
        if matches!(first.as_str(), "self" | "super") {
            return self.home(at, path, depth);
        }
        let module = self.modules.get(at)?;
        let child = [at, std::slice::from_ref(first)].concat();
        if !rest.is_empty() && self.modules.contains_key(&child) {
            return self.home_in(&child, rest, depth);
        }
        if module.items.contains(first) {
            return Some(module.file);
        }
        // A module hides a function of its name that is taken from elsewhere: imports mean the module.
        if self.modules.contains_key(&child) {
            return None;
        }
        let deeper = depth.checked_sub(1)?;
        let named = module.names.get(first).into_iter().flatten();
        let all = named.map(|path| [path, rest].concat());
        let globs = module.globs.iter().map(|glob| [glob, path].concat());
        // A name imported from a module of the same name would be resolved in itself.
        all.chain(globs).find_map(|path| self.home(at, &path, deeper))
    }
}

/// Paths of a tree of names, each with its name here; `*` for all.
fn paths(tree: &syn::UseTree, before: &[String], all: &mut Vec<(String, Vec<String>)>) {
    let with = |ident: &syn::Ident| [before, &[ident.to_string()]].concat();
    match tree {
        syn::UseTree::Path(path) => paths(&path.tree, &with(&path.ident), all),
        syn::UseTree::Name(name) if name.ident == "self" => {
            all.push((before.last().unwrap().clone(), before.to_vec()));
        }
        syn::UseTree::Name(name) => all.push((name.ident.to_string(), with(&name.ident))),
        syn::UseTree::Rename(name) => all.push((name.rename.to_string(), with(&name.ident))),
        syn::UseTree::Glob(_) => all.push(("*".to_owned(), before.to_vec())),
        syn::UseTree::Group(group) => group.items.iter().for_each(|one| paths(one, before, all)),
    }
}

/// Paths among the words of a macro's arguments, which are no syntax before it is expanded; names behind a dot are left out.
fn paths_in_words(text: &str) -> Vec<Vec<String>> {
    let mut found: Vec<Vec<String>> = Vec::new();
    let (mut joined, mut dotted) = (false, false);
    let outside: String = text.replace("\\\"", "").split('"').step_by(2).collect();
    for word in outside.split_whitespace().flat_map(|word| {
        word.split_inclusive(|c: char| !(c.is_alphanumeric() || c == '_' || c == ':' || c == '.'))
    }) {
        let bare = word.trim_matches(|c: char| !(c.is_alphanumeric() || c == '_' || c == ':'));
        match bare {
            "::" => joined = true,
            "" => (joined, dotted) = (false, word == "."),
            _ if joined && !found.is_empty() => {
                found.last_mut().unwrap().push(bare.to_owned());
                joined = false;
            }
            _ => {
                if !dotted {
                    found.push(vec![bare.to_owned()]);
                }
                (joined, dotted) = (false, false);
            }
        }
    }
    found
}

fn attributes(item: &syn::Item) -> &[syn::Attribute] {
    match item {
        syn::Item::Mod(item) => &item.attrs,
        syn::Item::Use(item) => &item.attrs,
        syn::Item::Fn(item) => &item.attrs,
        syn::Item::Impl(item) => &item.attrs,
        syn::Item::Struct(item) => &item.attrs,
        _ => &[],
    }
}

/// Collects the declarations of the modules of one file.
struct Declared<'a> {
    here: At,
    file: usize,
    modules: &'a mut BTreeMap<At, Module>,
    /// Modules for tests in files of their own.
    tests: &'a mut Vec<At>,
}

impl Declared<'_> {
    fn module(&mut self) -> &mut Module {
        let file = self.file;
        let new = || Module { file, ..Module::default() };
        self.modules.entry(self.here.clone()).or_insert_with(new)
    }
}

impl<'ast> Visit<'ast> for Declared<'_> {
    fn visit_item(&mut self, item: &'ast syn::Item) {
        if is_test(attributes(item)) {
            if let syn::Item::Mod(item) = item {
                self.tests.push([&self.here[..], &[item.ident.to_string()]].concat());
            }
            return;
        }
        let name = match item {
            syn::Item::Const(item) => Some(&item.ident),
            syn::Item::Enum(item) => Some(&item.ident),
            syn::Item::Fn(item) => Some(&item.sig.ident),
            syn::Item::Static(item) => Some(&item.ident),
            syn::Item::Struct(item) => Some(&item.ident),
            syn::Item::Trait(item) => Some(&item.ident),
            syn::Item::Type(item) => Some(&item.ident),
            syn::Item::Macro(item) => item.ident.as_ref(),
            _ => None,
        };
        let name = name.map(syn::Ident::to_string);
        self.module().items.extend(name);
        visit::visit_item(self, item);
    }

    fn visit_item_mod(&mut self, item: &'ast syn::ItemMod) {
        if item.content.is_some() {
            self.here.push(item.ident.to_string());
            self.module();
            visit::visit_item_mod(self, item);
            self.here.pop();
        }
    }

    /// Types that a macro declares.
    fn visit_item_macro(&mut self, item: &'ast syn::ItemMacro) {
        if item.ident.is_none() {
            let text = item.mac.tokens.to_string();
            for pair in text.split_whitespace().collect::<Vec<_>>().windows(2) {
                if matches!(pair[0], "struct" | "enum" | "fn" | "const") {
                    self.module().items.insert(pair[1].to_owned());
                }
            }
        }
    }

    fn visit_item_use(&mut self, item: &'ast syn::ItemUse) {
        let mut all = Vec::new();
        paths(&item.tree, &[], &mut all);
        for (name, path) in all {
            match name.as_str() {
                "*" => self.module().globs.push(path),
                _ => self.module().names.entry(name).or_default().push(path),
            }
        }
    }
}

/// Collects the files that one file imports from.
struct Used<'a> {
    all: &'a Crate,
    here: At,
    file: usize,
    /// Names, by the file that declares them.
    found: BTreeMap<usize, BTreeSet<String>>,
}

impl Used<'_> {
    fn take(&mut self, path: &[String]) {
        let home = self.all.home(&self.here, path, 8).filter(|home| *home != self.file);
        if let Some(home) = home {
            self.found.entry(home).or_default().insert(path.join("::"));
        }
    }
}

impl<'ast> Visit<'ast> for Used<'_> {
    fn visit_item(&mut self, item: &'ast syn::Item) {
        if !is_test(attributes(item)) {
            visit::visit_item(self, item);
        }
    }

    fn visit_item_mod(&mut self, item: &'ast syn::ItemMod) {
        self.here.push(item.ident.to_string());
        visit::visit_item_mod(self, item);
        self.here.pop();
    }

    fn visit_item_use(&mut self, item: &'ast syn::ItemUse) {
        let given_out = !matches!(item.vis, syn::Visibility::Inherited);
        let mut all = Vec::new();
        paths(&item.tree, &[], &mut all);
        for (_, path) in all {
            let below = self.all.home(&self.here, &path, 8).is_some_and(|home| {
                let parent = self.all.files[self.file].with_extension("");
                let folder = match parent.file_name().is_some_and(|n| n == "mod" || n == "lib") {
                    true => parent.parent().unwrap().to_owned(),
                    false => parent,
                };
                self.all.files[home].starts_with(folder)
            });
            if !(given_out && below) {
                self.take(&path);
            }
        }
    }

    fn visit_path(&mut self, path: &'ast syn::Path) {
        let parts: Vec<String> = path.segments.iter().map(|s| s.ident.to_string()).collect();
        self.take(&parts);
        visit::visit_path(self, path);
    }

    fn visit_macro(&mut self, of: &'ast syn::Macro) {
        for path in paths_in_words(&of.tokens.to_string()) {
            self.take(&path);
        }
        visit::visit_macro(self, of);
    }

    fn visit_visibility(&mut self, _: &'ast syn::Visibility) {}
}

/// The path of the module that a file is, from the folder of its crate's sources.
fn module_of(file: &Path) -> At {
    let parts = file.with_extension("");
    let mut here: At = parts.iter().map(|part| part.to_str().unwrap().to_owned()).collect();
    if here.last().is_some_and(|last| last == "mod" || last == "lib") {
        here.pop();
    }
    here
}

/// Names that each file of a crate imports from each other one, by their indices, and the files.
pub fn imports(
    texts: &[(PathBuf, String)],
) -> (Vec<PathBuf>, Vec<BTreeMap<usize, BTreeSet<String>>>) {
    let mut all = Crate::default();
    let mut tests = Vec::new();
    let mut trees = Vec::new();
    for (number, (file, text)) in texts.iter().enumerate() {
        let tree = syn::parse_file(text).unwrap();
        let modules = &mut all.modules;
        let here = module_of(file);
        let mut declared = Declared { here, file: number, modules, tests: &mut tests };
        declared.module();
        declared.visit_file(&tree);
        all.files.push(file.clone());
        trees.push(tree);
    }
    all.modules.retain(|at, _| !tests.iter().any(|test| at.starts_with(test)));
    let used = trees.iter().enumerate().map(|(file, tree)| {
        let here = module_of(&all.files[file]);
        let mut used = Used { all: &all, here, file, found: BTreeMap::new() };
        if all.modules.contains_key(&used.here) {
            used.visit_file(tree);
        }
        used.found
    });
    let used = used.collect();
    (all.files, used)
}
