//! The directory of a run appears whole or not at all.

use std::error::Error;
use std::fs;
use std::path::Path;

use percuss_output::{Extent, Results, RunDirectory, RunUpdate, Unfinished};

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
    names.retain(|name| name != ".percuss.json");
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
fn a_new_run_replaces_the_old_one_and_nothing_else() -> Outcome {
    let parent = tempfile::tempdir()?;
    let target = parent.path().join("run");
    run(&target, "old")?;
    // Also names that a run could have, and folders that one makes.
    for (file, text) in
        [("notes.md", "mine"), ("history.csv", "of mine"), ("figures/own.svg", "drawn")]
    {
        fs::write(target.join(file), text)?;
    }
    fs::create_dir_all(target.join("deep/er"))?;
    fs::write(target.join("deep/er/file"), "kept")?;
    run(&target, "new")?;
    assert_eq!(names(&target)?, ["deep", "figures", "history.csv", "notes.md", "summary.json"]);
    assert_eq!(names(&target.join("figures"))?, ["new", "own.svg"]);
    assert_eq!(fs::read_to_string(target.join("history.csv"))?, "of mine");
    assert_eq!(fs::read_to_string(target.join("deep/er/file"))?, "kept");
    assert_eq!(names(parent.path())?, ["run"]);
    Ok(())
}

#[test]
fn a_file_of_a_run_that_was_changed_is_no_longer_replaced() -> Outcome {
    let parent = tempfile::tempdir()?;
    let target = parent.path().join("run");
    run(&target, "old")?;
    fs::write(target.join("summary.json"), "old, with a comment")?;
    let error = RunDirectory::create(&target).err().ok_or("was not refused")?;
    assert!(
        error.is_refused() && error.to_string().contains("summary.json was modified"),
        "{error}"
    );
    assert_eq!(names(parent.path())?, ["run"]);
    Ok(())
}

#[test]
fn results_that_would_replace_a_foreign_file_stand_beside() -> Outcome {
    let parent = tempfile::tempdir()?;
    let target = parent.path().join("run");
    run(&target, "old")?;
    fs::write(target.join("history.csv"), "mine")?;
    let dir = RunDirectory::create(&target)?;
    fs::write(dir.path().join("history.csv"), "of the run")?;
    let error = dir.commit().err().ok_or("was not refused")?;
    assert!(error.to_string().contains("run.rescued-1"), "{error}");
    assert_eq!(fs::read_to_string(target.join("history.csv"))?, "mine");
    assert_eq!(fs::read_to_string(target.join("summary.json"))?, "old");
    drop(RunDirectory::create(&target)?);
    assert_eq!(fs::read_to_string(parent.path().join("run.rescued-1/history.csv"))?, "of the run");
    Ok(())
}

#[test]
fn partial_results_never_replace_complete_ones() -> Outcome {
    let parent = tempfile::tempdir()?;
    let target = parent.path().join("run");
    let partial = |content: &str| -> Result<std::path::PathBuf, Box<dyn Error>> {
        let dir = RunDirectory::create(&target)?;
        fs::write(dir.path().join("summary.json"), content)?;
        Ok(dir.commit_as(Extent::Partial)?.place)
    };
    let place = target.canonicalize().unwrap_or(parent.path().canonicalize()?.join("run"));
    assert_eq!(partial("first half")?, place); // nothing was there
    assert_eq!(partial("second half")?, place);
    run(&target, "whole")?;
    let beside = place.with_file_name("run.incomplete");
    assert_eq!(partial("third half")?, beside);
    assert_eq!(partial("fourth half")?, beside);
    assert_eq!(fs::read_to_string(target.join("summary.json"))?, "whole");
    assert_eq!(fs::read_to_string(beside.join("summary.json"))?, "fourth half");
    assert_eq!(names(parent.path())?, ["run", "run.incomplete"]);
    Ok(())
}

#[test]
fn one_process_at_a_time_fills_a_directory() -> Outcome {
    let parent = tempfile::tempdir()?;
    let target = parent.path().join("run");
    let first = RunDirectory::create(&target)?;
    let error = RunDirectory::create(&target).err().ok_or("was not refused")?;
    let who = format!("process {}", std::process::id());
    assert!(error.is_refused() && error.to_string().contains(&who), "{error}");
    drop(first);
    run(&target, "alone")?;
    assert_eq!(names(parent.path())?, ["run"]);
    Ok(())
}

#[test]
fn leftovers_of_dead_processes_are_put_in_order() -> Outcome {
    let parent = tempfile::tempdir()?;
    let target = parent.path().join("run");
    run(&target, "old")?;
    // One died while it wrote, one after the exchange: before it removed what it had replaced, a file of the user's among it.
    let staged = parent.path().join(".run.percuss-staged-aaaaaaaaaa");
    fs::create_dir(&staged)?;
    fs::write(staged.join(".percuss-unfinished"), "")?;
    fs::write(staged.join("history.csv"), "half")?;
    let replaced = parent.path().join(".run.percuss-staged-bbbbbbbbbb");
    run(&replaced, "older")?;
    fs::write(replaced.join("notes.md"), "mine")?;
    // And a folder of the user's that only looks a little like it.
    fs::create_dir(parent.path().join(".run.percussion"))?;
    drop(RunDirectory::create(&target)?);
    assert_eq!(names(parent.path())?, [".run.percussion", "run"]);
    assert_eq!(fs::read_to_string(target.join("notes.md"))?, "mine");
    assert_eq!(fs::read_to_string(target.join("summary.json"))?, "old");
    // Without an exchange in one operation: death between its two renames.
    fs::rename(&target, parent.path().join(".run.percuss-aside-cccccccccc"))?;
    drop(RunDirectory::create(&target)?);
    assert_eq!(fs::read_to_string(target.join("summary.json"))?, "old");
    assert_eq!(names(parent.path())?, [".run.percussion", "run"]);
    Ok(())
}

#[test]
fn a_report_is_added_to_a_run_and_replaces_no_foreign_file() -> Outcome {
    let parent = tempfile::tempdir()?;
    let target = parent.path().join("run");
    run(&target, "old")?;
    let add = |file: &str| -> Outcome {
        let update = RunUpdate::open(&target)?;
        fs::write(update.path().join(file), "anew")?;
        update.commit()?;
        Ok(())
    };
    add("report.html")?;
    add("report.html")?;
    assert_eq!(names(&target)?, ["figures", "report.html", "summary.json"]);
    fs::write(target.join("notes.md"), "mine")?;
    assert!(add("notes.md").is_err());
    assert_eq!(fs::read_to_string(target.join("notes.md"))?, "mine");
    run(&target, "new")?; // the report was the run's
    assert_eq!(names(&target)?, ["figures", "notes.md", "summary.json"]);
    assert!(RunUpdate::open(parent.path()).is_err());
    Ok(())
}

#[test]
fn results_of_another_kind_are_left_alone() -> Outcome {
    let parent = tempfile::tempdir()?;
    let target = parent.path().join("run");
    run(&target, "old")?;
    let error = RunDirectory::create_for(Results::Modes, &target).err().ok_or("was not refused")?;
    assert!(error.is_refused(), "{error}");
    Ok(())
}

#[cfg(unix)]
#[test]
fn a_link_that_leads_nowhere_is_refused() -> Outcome {
    let parent = tempfile::tempdir()?;
    let link = parent.path().join("run");
    std::os::unix::fs::symlink(parent.path().join("gone"), &link)?;
    let error = RunDirectory::create(&link).err().ok_or("was not refused")?;
    assert!(error.to_string().contains("broken link"), "{error}");
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
    assert!(error.to_string().contains(".percuss.json"), "{error}");
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

#[test]
fn files_described_early_stand_in_the_manifest_like_others() -> Outcome {
    let parent = tempfile::tempdir()?;
    let written = |name: &str, early: bool| -> Result<String, Box<dyn Error>> {
        let target = parent.path().join(name);
        let mut dir = RunDirectory::create(&target)?;
        fs::write(dir.path().join("history.csv"), vec![b'7'; 200_000])?;
        if early {
            dir.finished("history.csv");
            dir.finished("history.parquet");
        }
        fs::write(dir.path().join("summary.json"), "{}")?;
        dir.commit()?;
        Ok(fs::read_to_string(target.join(".percuss.json"))?)
    };
    let manifest = written("early", true)?;
    assert_eq!(manifest, written("late", false)?);
    assert!(manifest.contains("\"bytes\": 200000") && !manifest.contains("parquet"));
    // Results described early may be replaced like any others.
    run(&parent.path().join("early"), "b")
}

/// Links planted at names that others can foresee: nothing behind them is touched.
#[cfg(unix)]
#[test]
fn links_at_names_that_can_be_foreseen_are_not_followed() -> Outcome {
    use std::os::unix::fs::symlink;
    let parent = tempfile::tempdir()?;
    let here = |name: &str| parent.path().join(name);
    fs::write(here("thesis.tex"), "years")?;
    let unharmed = || -> Outcome {
        assert_eq!(fs::read_to_string(here("thesis.tex"))?, "years");
        Ok(())
    };
    // The lock: a link, a second name of the file, a folder.
    symlink("thesis.tex", here(".run.percuss.lock"))?;
    let error = RunDirectory::create(here("run")).err().ok_or("was not refused")?;
    assert!(error.to_string().contains("a link or special file exists there"), "{error}");
    fs::remove_file(here(".run.percuss.lock"))?;
    fs::hard_link(here("thesis.tex"), here(".run.percuss.lock"))?;
    let error = RunDirectory::create(here("run")).err().ok_or("was not refused")?;
    assert!(error.to_string().contains("a link or special file exists there"), "{error}");
    fs::remove_file(here(".run.percuss.lock"))?;
    unharmed()?;
    // What looks like something left behind, and leads to other results.
    run(&here("others"), "others'")?;
    for word in ["staged", "aside"] {
        symlink("others", here(&format!(".run.percuss-{word}-aaaaaaaaaa")))?;
    }
    run(&here("run"), "mine")?;
    // Partial results beside complete ones.
    let partial = RunDirectory::create(here("others"))?;
    fs::write(partial.path().join("summary.json"), "half")?;
    let elsewhere = here("elsewhere");
    drop(partial);
    let dir = RunDirectory::create(&elsewhere)?;
    fs::write(dir.path().join("summary.json"), "half")?;
    dir.commit_as(Extent::Partial)?;
    symlink("elsewhere", here("run.incomplete"))?;
    let dir = RunDirectory::create(here("run"))?;
    fs::write(dir.path().join("summary.json"), "half of it")?;
    let place = dir.commit_as(Extent::Partial)?.place;
    assert!(place.ends_with("run.incomplete-2"), "{}", place.display());
    assert_eq!(fs::read_to_string(elsewhere.join("summary.json"))?, "half");
    assert_eq!(fs::read_to_string(here("others/summary.json"))?, "others'");
    // A file that grows beside its place.
    symlink("thesis.tex", here(".film.gif.percuss.partial"))?;
    assert!(Unfinished::of(&here("film.gif")).is_err());
    symlink("thesis.tex", here("film.gif"))?;
    fs::remove_file(here(".film.gif.percuss.partial"))?;
    let film = Unfinished::of(&here("film.gif"))?;
    film.write(b"film")?;
    assert_eq!(film.put(&|_| true)?, None);
    assert!(!fs::symlink_metadata(here("film.gif"))?.is_symlink());
    unharmed()
}

/// Files edited while a run computes, between its start and its end.
#[test]
fn files_changed_meanwhile_are_kept_beside_and_reported() -> Outcome {
    let parent = tempfile::tempdir()?;
    let target = parent.path().canonicalize()?.join("run");
    let edited = |within: bool| -> Outcome {
        run(&target, "old")?;
        if within {
            fs::create_dir(target.join("a-folder-of-mine"))?;
        }
        let dir = RunDirectory::create(&target)?;
        fs::write(target.join("summary.json"), "old, with a comment")?;
        fs::write(target.join("figures/old"), "redrawn")?;
        fs::write(dir.path().join("summary.json"), "new")?;
        let placed = dir.commit()?;
        let changed = |name: &str| (target.join(name), target.join(format!("{name}.changed-1")));
        assert_eq!(placed.kept, [changed("figures/old"), changed("summary.json")]);
        assert_eq!(fs::read_to_string(target.join("summary.json"))?, "new");
        let kept = fs::read_to_string(target.join("summary.json.changed-1"))?;
        assert_eq!(kept, "old, with a comment");
        assert_eq!(fs::read_to_string(target.join("figures/old.changed-1"))?, "redrawn");
        // It is the user's from here on.
        run(&target, "newer")?;
        assert!(target.join("summary.json.changed-1").exists());
        assert_eq!(names(parent.path())?, ["run"]);
        Ok(())
    };
    edited(false)?;
    fs::remove_dir_all(&target)?;
    // A directory that is filled in place.
    fs::create_dir(&target)?;
    edited(true)
}

#[test]
fn files_changed_before_an_addition_are_kept_too() -> Outcome {
    let parent = tempfile::tempdir()?;
    let target = parent.path().canonicalize()?.join("run");
    run(&target, "old")?;
    for (k, edited) in ["with a remark", "with another"].iter().enumerate() {
        let update = RunUpdate::open(&target)?;
        fs::write(target.join("summary.json"), edited)?;
        fs::write(update.path().join("summary.json"), format!("rebuilt {k}"))?;
        let kept = target.join(format!("summary.json.changed-{}", k + 1));
        assert_eq!(update.commit()?, [(target.join("summary.json"), kept.clone())]);
        assert_eq!(fs::read_to_string(target.join("summary.json"))?, format!("rebuilt {k}"));
        assert_eq!(fs::read_to_string(kept)?, *edited);
    }
    Ok(())
}

#[test]
fn a_single_file_that_came_to_stand_there_meanwhile_is_kept() -> Outcome {
    let parent = tempfile::tempdir()?;
    let out = parent.path().join("film.gif");
    let is_film = |there: &Path| fs::read(there).is_ok_and(|bytes| bytes == b"film");
    for expected in [None, None] {
        let film = Unfinished::of(&out)?;
        film.write(b"film")?;
        assert_eq!(film.put(&is_film)?, expected);
    }
    let film = Unfinished::of(&out)?;
    fs::write(&out, "mine")?;
    film.write(b"film")?;
    assert_eq!(film.put(&is_film)?, Some(parent.path().join("film.gif.changed-1")));
    assert_eq!(fs::read_to_string(parent.path().join("film.gif.changed-1"))?, "mine");
    assert_eq!(fs::read_to_string(&out)?, "film");
    assert_eq!(names(parent.path())?, ["film.gif", "film.gif.changed-1"]);
    Ok(())
}

/// Permissions and the group's bit, folders without files, names that only look like this program's.
#[cfg(unix)]
#[test]
fn files_of_the_user_stay() -> Outcome {
    use std::os::unix::fs::{MetadataExt, PermissionsExt, symlink};
    let parent = tempfile::tempdir()?;
    let target = parent.path().join("run");
    run(&target, "old")?;
    for folder in ["empty/of/mine", "figures/ideas", ".percuss-staged-notes"] {
        fs::create_dir_all(target.join(folder))?;
    }
    for file in [".percuss-notes", ".percuss-staged-notes/file", ".percuss-aside-0123456789"] {
        fs::write(target.join(file), "mine")?;
    }
    // A folder that bears such a name by chance, beside.
    let beside = parent.path().join(".run.percuss-staged-0123456789");
    fs::create_dir(&beside)?;
    fs::write(beside.join("file"), "mine")?;
    fs::set_permissions(&target, fs::Permissions::from_mode(0o2770))?;
    fs::set_permissions(target.join("empty"), fs::Permissions::from_mode(0o700))?;
    let found = |path: &Path| fs::metadata(path).map(|m| (m.mode() & 0o7777, m.gid(), m.uid()));
    let before = found(&target)?;
    // Not even while it is computed do others see it.
    let dir = RunDirectory::create(&target)?;
    assert_eq!(found(dir.path())?.0 & 0o007, 0);
    drop(dir);
    run(&target, "new")?;
    run(&target, "newer")?;
    assert_eq!(found(&target)?, before);
    assert_eq!(found(&target.join("empty"))?.0, 0o700);
    for folder in ["empty/of/mine", "figures/ideas"] {
        assert!(target.join(folder).is_dir(), "{folder}");
    }
    for file in [".percuss-notes", ".percuss-staged-notes/file", ".percuss-aside-0123456789"] {
        assert_eq!(fs::read_to_string(target.join(file))?, "mine", "{file}");
    }
    assert_eq!(fs::read_to_string(beside.join("file"))?, "mine");
    // Shapes that the user keeps on another disk.
    let disk = tempfile::tempdir()?;
    fs::rename(target.join("figures"), disk.path().join("figures"))?;
    symlink(disk.path().join("figures"), target.join("figures"))?;
    let error = RunDirectory::create(&target).err().ok_or("was not refused")?;
    assert!(error.is_refused() && error.to_string().contains("figures in it is a link"), "{error}");
    assert!(RunUpdate::open(&target).is_err_and(|error| error.is_refused()));
    assert_eq!(fs::read_link(target.join("figures"))?, disk.path().join("figures"));
    assert_eq!(fs::read_to_string(disk.path().join("figures/newer"))?, "newer");
    Ok(())
}
