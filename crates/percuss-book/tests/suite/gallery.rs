//! The gallery: complete, and its statements true of runs made here.

use std::collections::BTreeSet;
use std::path::Path;

use percuss::{NoRecorder, Scheme, simulate};
use percuss_book::{Sample, Scene, is_shown, left_out, samples, sections};
use percuss_output::{RunInfo, summary_value};

use crate::repository;

fn list() -> std::path::PathBuf {
    repository().join("docs/book/gallery.toml")
}

fn scenes() -> Vec<Scene> {
    sections(&list()).unwrap().into_iter().flat_map(|section| section.scenes).collect()
}

#[test]
fn every_scenario_hangs_in_the_gallery_once() {
    let scenes = scenes();
    let shown: BTreeSet<String> = scenes.iter().map(|scene| scene.file.clone()).collect();
    assert_eq!(shown.len(), scenes.len(), "a scenario stands twice");
    assert!(shown.len() >= 40, "{} scenarios", shown.len());
    let out: BTreeSet<String> = left_out(&list()).unwrap().into_iter().collect();
    let all = samples(repository()).unwrap();
    let wanted = all.iter().filter(|one| is_shown(one)).map(|one| one.name.clone());
    let missing: Vec<String> =
        wanted.filter(|name| !shown.contains(name) && !out.contains(name)).collect();
    assert!(missing.is_empty(), "not in docs/book/gallery.toml: {missing:?}");
    let idle: Vec<&String> =
        out.iter().filter(|name| !all.iter().any(|one| one.name == **name)).collect();
    assert!(idle.is_empty(), "left out and not there: {idle:?}");
    for scene in &scenes {
        let statement = &scene.statement;
        assert!(
            !statement.is_empty() && !statement.contains('\n'),
            "{}: {statement:?}",
            scene.file
        );
        assert!(!scene.holds.is_empty(), "{}: nothing holds its lesson", scene.file);
    }
}

/// What is wrong with a scene: a run that fails, a balance that does not close, a statement that is not true.
fn faults(scene: &Scene, sample: &Sample, root: &Path) -> Vec<String> {
    let path = root.join(&sample.name);
    let scenario = percuss_scenario::read(&sample.text, &path.display().to_string()).unwrap();
    let compiled = scenario.compile().unwrap();
    let (model, settings) = (&compiled.model, &compiled.settings);
    let run = match simulate(model, settings, &mut NoRecorder) {
        Ok(run) => run,
        Err(error) => return vec![format!("{}: {error:?}", scene.file)],
    };
    let info = RunInfo {
        title: "",
        settings,
        wall_seconds: 0.0,
        advice: &[],
        warnings: &[],
        comparisons: &[],
    };
    let (_, mut found) = scene.filled(&summary_value(&run, info));
    let conserves = matches!(settings.scheme, Scheme::EnergyMomentum | Scheme::StrainRate);
    // Far above round-off; `plain-gradient` in rail-buffer.toml leaves 7e-10.
    if conserves && run.energy.residual_max > 1e-9 {
        found.push(format!("{}: energy residual {:e}", scene.file, run.energy.residual_max));
    }
    found
}

#[test]
fn statements_of_the_gallery_are_true() {
    let samples = samples(repository()).unwrap();
    let scenes = scenes();
    let halves: Vec<Vec<String>> = std::thread::scope(|scope| {
        let half = |k: usize| {
            let (scenes, samples) = (&scenes, &samples);
            scope.spawn(move || -> Vec<String> {
                let own = scenes.iter().skip(k).step_by(2);
                let run = |scene: &Scene| {
                    let sample = samples.iter().find(|one| one.name == scene.file);
                    match sample {
                        Some(sample) => faults(scene, sample, repository()),
                        None => vec![format!("there is no {}", scene.file)],
                    }
                };
                own.flat_map(run).collect()
            })
        };
        let threads = [half(0), half(1)];
        threads.into_iter().map(|thread| thread.join().unwrap()).collect()
    });
    let found = halves.concat();
    assert!(found.is_empty(), "{}", found.join("\n"));
}
