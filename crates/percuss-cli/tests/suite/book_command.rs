//! `percuss book`: finds the book beside the program, and says where else it is.

use std::path::Path;
use std::process::{Command, Stdio};

use crate::common::{Outcome, Sandbox};

/// The command of a program elsewhere, without what the environment says about the book.
fn book(program: &Path, arguments: &[&str]) -> Outcome {
    let mut command = Command::new(program);
    command.arg("book").args(arguments).env_remove("PERCUSS_BOOK").stdin(Stdio::null());
    command.output().expect("the command starts").into()
}

#[test]
fn the_book_is_found_beside_the_program_and_missed_with_a_hint() {
    let sandbox = Sandbox::empty();
    let built = Path::new(env!("CARGO_BIN_EXE_percuss"));
    let name = built.file_name().expect("a name");
    let folder = |path: &str| std::fs::create_dir_all(sandbox.path(path)).expect("a folder");
    folder("release/bin");
    let program = sandbox.path("release/bin").join(name);
    std::fs::copy(built, &program).expect("a copy of the program");

    let reported = book(&program, &["--path"]);
    reported.ends_with(2).tells("the book is not installed").tells("docs/book/src").tells("[E214]");
    reported.tells("scripts/book");
    assert_eq!(reported.stdout, "");

    // The farther ones first: each nearer one is found before it.
    for place in ["release/book/html", "release/share/percuss/book", "release/bin/book"] {
        folder(place);
        let page = format!("{place}/index.html");
        sandbox.put(&page, "<title>Percuss</title>");
        let page = sandbox.path(&page).canonicalize().expect("a page");
        let reported = book(&program, &["--path"]);
        assert_eq!(reported.ends_with(0).stdout, format!("{}\n", page.display()));
        assert_eq!(reported.stderr, "");
    }
}

#[test]
fn a_named_folder_takes_precedence() {
    let sandbox = Sandbox::empty();
    std::fs::create_dir(sandbox.path("mine")).expect("a folder");
    let named = |folder: &str| -> Outcome {
        let mut command = sandbox.command(&["book", "--path"]);
        command.env("PERCUSS_BOOK", folder).output().expect("the command starts").into()
    };
    named("mine").ends_with(2).tells("(no index.html in `mine`)").tells("[E214]");
    sandbox.put("mine/index.html", "");
    let page = sandbox.path("mine/index.html").canonicalize().expect("a page");
    assert_eq!(named("mine").ends_with(0).stdout, format!("{}\n", page.display()));
}

/// The path is printed even if nothing can open it.
#[cfg(target_os = "linux")]
#[test]
fn without_a_browser_the_path_is_printed_with_a_warning() {
    let sandbox = Sandbox::empty();
    sandbox.put("index.html", "");
    let mut command = sandbox.command(&["book"]);
    command.env("PERCUSS_BOOK", ".").env("PATH", sandbox.path("nowhere")).env_remove("BROWSER");
    let reported: Outcome = command.output().expect("the command starts").into();
    reported.ends_with(0).tells("[W116]");
    assert!(reported.stdout.ends_with("index.html\n"), "{}", reported.stdout);
}
