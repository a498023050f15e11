//! Files of a crate import one way: none imports, by however many others, from one that imports from it.
//!
//! A file imports from the file that declares a name, whatever path it uses: a module that re-exports the name is passed through, and a re-export
//! in a parent is no import of its own. A parent that declares its children and re-exports their names is therefore in no circle; one that uses
//! declarations of a child while the child uses its own is.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::PathBuf;

use super::imports::imports;
use super::layers::{root, sources};

/// Circles among nodes: those that lead to each other, more than one.
fn circles(leads: &[BTreeMap<usize, BTreeSet<String>>]) -> Vec<Vec<usize>> {
    let reach = |from: usize| {
        let mut seen = BTreeSet::new();
        let mut next = vec![from];
        while let Some(at) = next.pop() {
            next.extend(leads[at].keys().filter(|to| seen.insert(**to)));
        }
        seen
    };
    let reached: Vec<BTreeSet<usize>> = (0..leads.len()).map(reach).collect();
    let with = |i: usize| {
        let same = |j: &usize| reached[i].contains(j) && reached[*j].contains(&i);
        (0..leads.len()).filter(same).collect::<Vec<_>>()
    };
    let mut all: Vec<Vec<usize>> = (0..leads.len()).map(with).filter(|c| c.len() > 1).collect();
    all.sort();
    all.dedup();
    all
}

/// Circles of a crate's files: each file with its imports from others of its circle.
fn faults_of(texts: &[(PathBuf, String)]) -> Vec<BTreeMap<PathBuf, Vec<String>>> {
    let (files, used) = imports(texts);
    let reported = |circle: Vec<usize>| {
        let of = |file: &usize| {
            let inside = used[*file].iter().filter(|(home, _)| circle.contains(home));
            let line = |(home, names): (&usize, &BTreeSet<String>)| {
                // Of `super::Kind::One` and `Kind` once the same name.
                let own = |name: &String| {
                    let upper = |part: &&str| part.starts_with(|c: char| c.is_uppercase());
                    let parts: Vec<&str> = name.split("::").collect();
                    parts.iter().find(|p| upper(p)).or(parts.last()).unwrap().to_string()
                };
                let names: BTreeSet<String> = names.iter().map(own).collect();
                let names: Vec<String> = names.into_iter().collect();
                format!("{} ({})", files[*home].display(), names.join(", "))
            };
            (files[*file].clone(), inside.map(line).collect())
        };
        circle.iter().map(of).collect()
    };
    circles(&used).into_iter().map(reported).collect()
}

#[test]
fn files_of_a_crate_stand_in_no_circle() {
    let mut faults = String::new();
    for one in fs::read_dir(root().join("crates")).unwrap() {
        let folder = one.unwrap().path();
        let src = folder.join("src");
        let name = folder.file_name().unwrap().to_str().unwrap().to_owned();
        let mut files = Vec::new();
        if src.is_dir() {
            sources(&src, &mut files);
        }
        files.retain(|file| file.extension().is_some_and(|e| e == "rs"));
        files.sort();
        let read = |file: &PathBuf| {
            let text = fs::read_to_string(file).unwrap();
            (file.strip_prefix(&src).unwrap().to_owned(), text)
        };
        let texts: Vec<(PathBuf, String)> = files.iter().map(read).collect();
        for circle in faults_of(&texts) {
            faults += &format!("{} files of {name} import in a circle:\n", circle.len());
            for (file, from) in &circle {
                faults += &format!("  {}\n    {}\n", file.display(), from.join("\n    "));
            }
        }
    }
    assert!(faults.is_empty(), "{faults}");
}

/// Every form of import from another file is detected; re-exports of children by a parent are not.
#[test]
fn circles_of_files_are_found() {
    let circles = |texts: &[(&str, &str)]| {
        let own = |(file, text): &(&str, &str)| (PathBuf::from(file), (*text).to_owned());
        faults_of(&texts.iter().map(own).collect::<Vec<_>>())
    };
    let root = ("lib.rs", "mod a; mod b; pub use b::B;");
    for uses in [
        "use crate::b::B; pub struct A(B);",
        "use super::b::{B as C, D}; pub struct A;",
        "use crate::B; pub struct A;",
        "use super::b::*; pub struct A(B);",
        "use super::b; pub fn f() { b::g(); } pub struct A;",
        "pub struct A(crate::b::B);",
        "pub struct A; mod inner { fn f() { super::super::b::g(); } }",
        "pub struct A; fn f() { println!(\"{}\", crate::b::g()); }",
    ] {
        let b = "use super::a::A; pub struct B; pub struct D; pub fn g() {} fn f(a: &A) {}";
        let found = circles(&[root, ("a.rs", uses), ("b.rs", b)]);
        assert_eq!(found.len(), 1, "{uses}");
        assert_eq!(found[0].len(), 2, "{uses}");
        let one_way = "pub struct B; pub struct D; pub fn g() {}";
        assert!(circles(&[root, ("a.rs", uses), ("b.rs", one_way)]).is_empty(), "{uses}");
    }
    let parent = "mod child; pub use child::Child; pub struct Own;";
    let child = ("a/child.rs", "use super::Own; pub struct Child(Own);");
    let b = ("b.rs", "pub struct B;");
    assert!(circles(&[root, ("a.rs", parent), child, b]).is_empty());
    let used = format!("{parent} fn f(x: Child) {{}}");
    assert_eq!(circles(&[root, ("a.rs", &used), child, b]).len(), 1);
    // Imports of tests are ignored, as are words in texts and fields after dots.
    for free in [
        "pub struct A; #[cfg(test)] mod tests { use crate::b::B; }",
        "pub struct A; fn f() { println!(\"crate::b::B\"); }",
        "pub struct A; fn f(x: &X) { println!(\"{}\", x.b); }",
    ] {
        let b = ("b.rs", "use super::a::A; pub struct B;");
        assert!(circles(&[root, ("a.rs", free), b]).is_empty(), "{free}");
    }
}
