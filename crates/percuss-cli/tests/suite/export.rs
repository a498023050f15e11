//! `percuss export`: files for ParaView from the directory of a run. That VTK reads them is tested in python/tests.

use crate::common;

use common::Sandbox;

const NAMES: [&str; 4] = ["beams.vtkhdf", "bodies.vtkhdf", "contacts.vtkhdf", "supports.vtkhdf"];

#[test]
fn a_run_gets_files_that_belong_to_it() {
    let sandbox = Sandbox::new();
    sandbox.percuss(&["run", "elastic.toml", "--out", "hit", "--no-report", "-q"]).ends_with(0);
    for _ in 0..2 {
        let done = sandbox.percuss(&["export", "hit", "--format", "vtkhdf"]);
        done.ends_with(0);
        assert!(done.stderr.contains("beams.vtkhdf") || done.stdout.contains("beams.vtkhdf"));
        assert_eq!(common::names(&sandbox.path("hit/paraview")), NAMES);
    }
    for name in NAMES {
        let bytes = std::fs::read(sandbox.path("hit/paraview").join(name)).unwrap();
        assert_eq!(&bytes[..8], b"\x89HDF\r\n\x1a\n", "{name}");
    }
    // A later run into the same directory replaces what is its own.
    sandbox.percuss(&["run", "elastic.toml", "--out", "hit", "--no-report", "-q"]).ends_with(0);
    assert!(!sandbox.path("hit/paraview").exists());
}

#[test]
fn a_list_of_files_has_one_for_each_instant() {
    let sandbox = Sandbox::new();
    let set = ["--set", "time.end=0.02 s", "--no-report", "-q"];
    sandbox.percuss(&[&["run", "elastic.toml", "--out", "hit"][..], &set].concat()).ends_with(0);
    sandbox.percuss(&["export", "hit", "--format", "pvd"]).ends_with(0).tells("beams.pvd");
    let list = std::fs::read_to_string(sandbox.path("hit/paraview/beams.pvd")).unwrap();
    let files = common::names(&sandbox.path("hit/paraview/beams"));
    assert_eq!(list.matches("<DataSet ").count(), files.len());
    assert!(files.iter().all(|file| list.contains(&format!("\"beams/{file}\""))));
    // Another format takes the place of the first one and leaves nothing of it.
    sandbox.percuss(&["export", "hit", "--out", "files", "--format", "pvd"]).ends_with(0);
    sandbox.percuss(&["export", "hit", "--out", "files"]).ends_with(0);
    assert_eq!(common::names(&sandbox.path("files")), NAMES);
}

#[test]
fn another_directory_keeps_what_is_not_an_export() {
    let sandbox = Sandbox::new();
    sandbox.percuss(&["run", "elastic.toml", "--out", "hit", "--no-report", "-q"]).ends_with(0);
    for _ in 0..2 {
        sandbox.percuss(&["export", "hit", "--out", "files"]).ends_with(0);
    }
    std::fs::create_dir(sandbox.path("mine")).unwrap();
    sandbox.put("mine/beams.vtkhdf", "mine");
    let refused = sandbox.percuss(&["export", "hit", "--out", "mine"]);
    refused.ends_with(2);
    assert_eq!(std::fs::read_to_string(sandbox.path("mine/beams.vtkhdf")).unwrap(), "mine");
    let into_run = sandbox.percuss(&["export", "hit", "--out", "hit"]);
    into_run.ends_with(2);
}

#[test]
fn runs_without_frames_say_so() {
    let sandbox = Sandbox::new();
    let set = ["--set", "record.shapes=0", "--no-report", "-q"];
    sandbox.percuss(&[&["run", "rigid.toml", "--out", "hit"][..], &set].concat()).ends_with(0);
    let refused = sandbox.percuss(&["export", "hit"]);
    refused.ends_with(2);
    refused.tells("record.shapes");
    let nowhere = sandbox.percuss(&["export", "elsewhere"]);
    nowhere.ends_with(2);
    nowhere.tells("no such directory");
}

#[test]
fn frames_that_do_not_fit_their_scene_are_refused_and_nothing_is_left() {
    let sandbox = Sandbox::new();
    sandbox.percuss(&["run", "elastic.toml", "--out", "hit", "--no-report", "-q"]).ends_with(0);
    let scene = sandbox.path("hit/fields/scene.json");
    let mut value: serde_json::Value =
        serde_json::from_str(&std::fs::read_to_string(&scene).unwrap()).unwrap();
    value["beams"][0]["x"].as_array_mut().unwrap().pop();
    std::fs::write(&scene, value.to_string()).unwrap();
    let refused = sandbox.percuss(&["export", "hit"]);
    refused.ends_with(2);
    refused.tells("girder");
    assert!(!sandbox.path("hit/paraview").exists());
}
