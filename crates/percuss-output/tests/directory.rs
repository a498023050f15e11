//! The directory of a run appears whole or not at all.

use std::error::Error;
use std::fs;
use std::path::Path;

use percuss_output::RunDirectory;

type Outcome = Result<(), Box<dyn Error>>;

fn run(target: &Path, content: &str) -> Outcome {
    let dir = RunDirectory::create(target)?;
    fs::write(dir.path().join("summary.json"), content)?;
    fs::create_dir(dir.path().join("figures"))?;
    fs::write(dir.path().join("figures").join(content), content)?;
    dir.commit()?;
    Ok(())
}

fn names(dir: &Path) -> Result<Vec<String>, Box<dyn Error>> {
    let mut names = Vec::new();
    for entry in fs::read_dir(dir)? {
        names.push(entry?.file_name().to_string_lossy().into_owned());
    }
    names.sort();
    Ok(names)
}

#[test]
fn nothing_is_seen_before_the_commit_and_nothing_stays_without_one() -> Outcome {
    let parent = tempfile::tempdir()?;
    let target = parent.path().join("deep/run");
    let dir = RunDirectory::create(&target)?;
    fs::write(dir.path().join("summary.json"), "{}")?;
    assert!(!target.exists());
    drop(dir);
    assert!(!target.exists());
    assert!(names(&parent.path().join("deep"))?.is_empty());
    Ok(())
}

#[test]
fn a_new_run_replaces_the_old_one_and_keeps_foreign_files() -> Outcome {
    let parent = tempfile::tempdir()?;
    let target = parent.path().join("run");
    run(&target, "old")?;
    fs::write(target.join("notes.md"), "mine")?;
    fs::write(target.join("history.csv"), "of the old run")?;
    run(&target, "new")?;
    assert_eq!(names(&target)?, ["figures", "notes.md", "summary.json"]);
    assert_eq!(names(&target.join("figures"))?, ["new"]);
    assert_eq!(fs::read_to_string(target.join("notes.md"))?, "mine");
    assert_eq!(names(parent.path())?, ["run"]);
    Ok(())
}

#[test]
fn the_old_run_survives_a_run_that_is_given_up() -> Outcome {
    let parent = tempfile::tempdir()?;
    let target = parent.path().join("run");
    run(&target, "old")?;
    drop(RunDirectory::create(&target)?);
    assert_eq!(fs::read_to_string(target.join("summary.json"))?, "old");
    assert_eq!(names(parent.path())?, ["run"]);
    Ok(())
}

#[test]
fn an_empty_directory_is_filled_in_place() -> Outcome {
    let target = tempfile::tempdir()?;
    run(target.path(), "new")?;
    assert_eq!(names(target.path())?, ["figures", "summary.json"]);
    Ok(())
}

#[test]
fn a_directory_that_holds_something_else_is_refused() -> Outcome {
    let parent = tempfile::tempdir()?;
    let precious = parent.path().join("precious");
    fs::create_dir(&precious)?;
    fs::write(precious.join("thesis.tex"), "years")?;
    let error = RunDirectory::create(&precious).err().ok_or("was not refused")?;
    assert!(error.is_refused());
    assert!(error.to_string().contains("summary.json"), "{error}");
    let file = precious.join("thesis.tex");
    assert!(RunDirectory::create(&file).err().ok_or("was not refused")?.is_refused());
    assert_eq!(names(&precious)?, ["thesis.tex"]);
    assert_eq!(names(parent.path())?, ["precious"]);
    Ok(())
}

#[cfg(unix)]
#[test]
fn a_link_keeps_pointing_to_the_run() -> Outcome {
    let parent = tempfile::tempdir()?;
    let (target, link) = (parent.path().join("run"), parent.path().join("latest"));
    run(&target, "old")?;
    std::os::unix::fs::symlink(&target, &link)?;
    run(&link, "new")?;
    assert!(fs::symlink_metadata(&link)?.is_symlink());
    assert_eq!(fs::read_to_string(target.join("summary.json"))?, "new");
    Ok(())
}
