//! Files use each other one way, within a folder too.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use syn::visit::{self, Visit};

use super::layers::{is_test, sources};

/// Folders of the mechanics some of whose files still use each other in a circle.
const CIRCLES: [&str; 7] =
    ["analysis", "contact", "element", "geometry", "linalg", "model", "step"];

/// Path of a module from the root of the crate, shape (parts).
type ModulePath = Vec<String>;

/// Paths that a file names, from the root of the crate, and whether it hands the name at their end on.
struct NamedPaths {
    here: ModulePath,
    found: Vec<(ModulePath, bool)>,
}

impl NamedPaths {
    fn take(&mut self, path: &[String], handed_on: bool) {
        let ups = path.iter().take_while(|part| *part == "super").count();
        let from_root = match path.first().map(String::as_str) {
            Some("crate") => path[1..].to_vec(),
            Some("super") if ups <= self.here.len() => {
                [&self.here[..self.here.len() - ups], &path[ups..]].concat()
            }
            Some("self") => [&self.here[..], &path[1..]].concat(),
            // A module below this one, or another crate's: there is no such file then. One word alone is a name.
            _ if path.len() > 1 => [&self.here[..], path].concat(),
            _ => return,
        };
        self.found.push((from_root, handed_on));
    }

    fn take_tree(&mut self, tree: &syn::UseTree, before: &[String], handed_on: bool) {
        let with = |ident: &syn::Ident| [before, &[ident.to_string()]].concat();
        match tree {
            syn::UseTree::Path(path) => {
                self.take_tree(&path.tree, &with(&path.ident), handed_on);
            }
            syn::UseTree::Name(name) if name.ident == "self" => self.take(before, handed_on),
            syn::UseTree::Name(name) => self.take(&with(&name.ident), handed_on),
            syn::UseTree::Rename(name) => self.take(&with(&name.ident), handed_on),
            // What a module hands on with a star counts as its own.
            syn::UseTree::Glob(_) => self.take(before, handed_on),
            syn::UseTree::Group(group) => {
                group.items.iter().for_each(|tree| self.take_tree(tree, before, handed_on));
            }
        }
    }
}

impl<'ast> Visit<'ast> for NamedPaths {
    fn visit_item_mod(&mut self, item: &'ast syn::ItemMod) {
        if !is_test(&item.attrs) {
            self.here.push(item.ident.to_string());
            visit::visit_item_mod(self, item);
            self.here.pop();
        }
    }

    fn visit_item_use(&mut self, item: &'ast syn::ItemUse) {
        let handed_on = !matches!(item.vis, syn::Visibility::Inherited);
        self.take_tree(&item.tree, &[], handed_on);
    }

    fn visit_path(&mut self, path: &'ast syn::Path) {
        let parts: ModulePath = path.segments.iter().map(|s| s.ident.to_string()).collect();
        self.take(&parts, false);
        visit::visit_path(self, path);
    }

    fn visit_visibility(&mut self, _: &'ast syn::Visibility) {}
}

/// The longest beginning of a path that is a module; what a module hands on is of the module it has it from.
fn module_of(
    path: &[String],
    named: &BTreeMap<ModulePath, Vec<(ModulePath, bool)>>,
) -> Option<ModulePath> {
    let n = (1..=path.len()).rev().find(|n| named.contains_key(&path[..*n]))?;
    let (module, name) = (&path[..n], path.get(n));
    let from = named[module].iter().find_map(|(from, handed_on)| {
        let below = from.len() > n + 1 && from.starts_with(module) && from.last() == name;
        (*handed_on && below).then_some(from)
    });
    from.map_or_else(|| Some(module.to_vec()), |from| module_of(from, named))
}

/// Files that use each other in a circle, by the module below the root that they are in.
fn circles(named: &BTreeMap<ModulePath, Vec<(ModulePath, bool)>>) -> BTreeMap<String, Vec<String>> {
    let uses = |module: &ModulePath| -> BTreeSet<ModulePath> {
        let hands_on =
            |(path, handed_on): &&(ModulePath, bool)| !(*handed_on && path.starts_with(module));
        let paths = named[module].iter().filter(hands_on);
        paths.filter_map(|(path, _)| module_of(path, named)).filter(|of| of != module).collect()
    };
    let direct: BTreeMap<_, _> = named.keys().map(|module| (module, uses(module))).collect();
    let mut found: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for module in named.keys() {
        let (mut seen, mut next) = (BTreeSet::new(), vec![module]);
        while let Some(one) = next.pop() {
            next.extend(direct[one].iter().filter(|used| seen.insert((*used).clone())));
        }
        if seen.contains(module) {
            found.entry(module[0].clone()).or_default().push(module.join("/"));
        }
    }
    found
}

/// Names in the files of a crate, by the files' modules.
fn named_in(files: &[(PathBuf, String)]) -> BTreeMap<ModulePath, Vec<(ModulePath, bool)>> {
    let one = |(file, text): &(PathBuf, String)| {
        let parts = file.with_extension("");
        let mut here: ModulePath =
            parts.iter().map(|part| part.to_str().unwrap().to_owned()).collect();
        if here.last().is_some_and(|last| last == "mod") {
            here.pop();
        }
        let mut paths = NamedPaths { here: here.clone(), found: Vec::new() };
        paths.visit_file(&syn::parse_file(text).unwrap());
        (here, paths.found)
    };
    files.iter().map(one).collect()
}

#[test]
fn files_use_each_other_one_way() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    sources(&src, &mut files);
    let read = |path: &PathBuf| {
        (path.strip_prefix(&src).unwrap().to_owned(), fs::read_to_string(path).unwrap())
    };
    let all = files.iter().map(read).filter(|(name, _)| name != Path::new("lib.rs"));
    let found = circles(&named_in(&all.collect::<Vec<_>>()));
    let expected: Vec<&str> = found.keys().map(String::as_str).collect();
    assert_eq!(expected, CIRCLES, "{found:#?}");
}

#[test]
fn circles_of_files_are_found() {
    let circle = |files: &[(&str, &str)]| {
        let files = files.iter().map(|(name, text)| (PathBuf::from(name), (*text).to_owned()));
        !circles(&named_in(&files.collect::<Vec<_>>())).is_empty()
    };
    let uses_b = ("run/a.rs", "use super::b::B; pub struct A;");
    assert!(circle(&[uses_b, ("run/b.rs", "use crate::run::a::A; pub struct B;")]));
    assert!(circle(&[uses_b, ("run/b.rs", "fn f() -> super::a::A { todo!() }")]));
    assert!(!circle(&[uses_b, ("run/b.rs", "pub struct B;")]));
    // By what the folder hands on, and by a file in a folder of its own name.
    let hands_on = ("run/mod.rs", "mod a; mod b; pub use a::A;");
    assert!(circle(&[hands_on, uses_b, ("run/b.rs", "use super::A; pub struct B;")]));
    assert!(!circle(&[hands_on, uses_b, ("run/b.rs", "pub struct B;")]));
    let own = ("run/a.rs", "mod c; use c::C; pub struct A;");
    assert!(circle(&[own, ("run/a/c.rs", "use super::A; pub struct C;")]));
    let tested = "pub struct B; #[cfg(test)] mod tests { use super::super::a::A; }";
    assert!(!circle(&[uses_b, ("run/b.rs", tested)]));
}
