//! `percuss book`: finds the book beside the program, and says where else it is.

use std::path::Path;
use std::process::{Command, Stdio};

use crate::common::{Desk, Outcome};

/// The command of a program elsewhere, without what the environment says about the book.
fn book(program: &Path, arguments: &[&str]) -> Outcome {
    let mut command = Command::new(program);
    command.arg("book").args(arguments).env_remove("PERCUSS_BOOK").stdin(Stdio::null());
    command.output().expect("the command starts").into()
}

#[test]
fn the_book_is_found_beside_the_program_and_missed_with_a_hint() {
    let desk = Desk::empty();
    let built = Path::new(env!("CARGO_BIN_EXE_percuss"));
    let name = built.file_name().expect("a name");
    let folder = |path: &str| std::fs::create_dir_all(desk.path(path)).expect("a folder");
    folder("release/bin");
    let program = desk.path("release/bin").join(name);
    std::fs::copy(built, &program).expect("a copy of the program");

    let told = book(&program, &["--path"]);
    told.ends_with(2).tells("the book is not installed").tells("docs/book/src").tells("[E214]");
    told.tells("scripts/book");
    assert_eq!(told.stdout, "");

    // The farther ones first: each nearer one is found before it.
    for place in ["release/book/html", "release/share/percuss/book", "release/bin/book"] {
        folder(place);
        let page = format!("{place}/index.html");
        desk.put(&page, "<title>Percuss</title>");
        let page = desk.path(&page).canonicalize().expect("a page");
        let told = book(&program, &["--path"]);
        assert_eq!(told.ends_with(0).stdout, format!("{}\n", page.display()));
        assert_eq!(told.stderr, "");
    }
}

#[test]
fn a_named_folder_takes_precedence() {
    let desk = Desk::empty();
    std::fs::create_dir(desk.path("mine")).expect("a folder");
    let named = |folder: &str| -> Outcome {
        let mut command = desk.command(&["book", "--path"]);
        command.env("PERCUSS_BOOK", folder).output().expect("the command starts").into()
    };
    named("mine").ends_with(2).tells("(no index.html in `mine`)").tells("[E214]");
    desk.put("mine/index.html", "");
    let page = desk.path("mine/index.html").canonicalize().expect("a page");
    assert_eq!(named("mine").ends_with(0).stdout, format!("{}\n", page.display()));
}

/// The path is printed even if nothing can open it.
#[cfg(target_os = "linux")]
#[test]
fn without_a_browser_the_path_is_printed_with_a_warning() {
    let desk = Desk::empty();
    desk.put("index.html", "");
    let mut command = desk.command(&["book"]);
    command.env("PERCUSS_BOOK", ".").env("PATH", desk.path("nowhere")).env_remove("BROWSER");
    let told: Outcome = command.output().expect("the command starts").into();
    told.ends_with(0).tells("[W116]");
    assert!(told.stdout.ends_with("index.html\n"), "{}", told.stdout);
}
