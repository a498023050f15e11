//! Writes the sources of the book for mdBook: `percuss-book PERCUSS OUT [--quick]`, from the root of the repository.

use std::path::PathBuf;
use std::process::ExitCode;

use percuss_book::{Effort, Sources, build};

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [percuss, out, rest @ ..] = arguments.as_slice() else {
        eprintln!("usage: percuss-book PERCUSS OUT [--quick]");
        return ExitCode::from(2);
    };
    let quick = rest.iter().any(|one| one == "--quick");
    let sources = Sources {
        repository: PathBuf::from("."),
        percuss: PathBuf::from(percuss),
        out: PathBuf::from(out),
        effort: if quick { Effort::Quick } else { Effort::All },
    };
    match build(&sources) {
        Ok(faults) if faults.is_empty() => ExitCode::SUCCESS,
        Ok(faults) => {
            eprintln!("{}", faults.join("\n"));
            ExitCode::FAILURE
        }
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}
