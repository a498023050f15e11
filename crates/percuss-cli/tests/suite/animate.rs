//! `percuss animate`: films and stills of a finished run.

use crate::common;

use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use common::Sandbox;
use percuss_output::fields;
use percuss_output::report::{scene_colours, scene_scripts};
use serde_json::{Map, Value, json};

/// Options of a small film: ten frames.
const SMALL: [&str; 6] = ["--width", "320", "--duration", "1", "--fps", "10"];

/// A sandbox with a finished run of each example.
fn sandbox() -> Sandbox {
    let sandbox = Sandbox::new();
    for name in ["elastic", "rigid"] {
        let file = format!("{name}.toml");
        sandbox.percuss(&["run", &file, "--out", name, "--no-report", "-q"]).ends_with(0);
    }
    sandbox
}

fn film(sandbox: &Sandbox, run: &str, file: &str) {
    let made = sandbox.percuss(&[&["animate", run, "-o", file][..], &SMALL].concat());
    made.ends_with(0).tells("10 frames of 320 x ");
}

/// Size, frames as they are seen (RGBA) and delays [1/100 s] of a GIF.
fn read_gif(path: &Path) -> ([usize; 2], Vec<Vec<u8>>, Vec<u64>) {
    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::RGBA);
    let mut decoder = options.read_info(BufReader::new(File::open(path).unwrap())).unwrap();
    let size = [usize::from(decoder.width()), usize::from(decoder.height())];
    let mut shown = vec![0; 4 * size[0] * size[1]];
    let (mut frames, mut delays) = (Vec::new(), Vec::new());
    while let Some(frame) = decoder.read_next_frame().unwrap() {
        let [left, top, width] = [frame.left, frame.top, frame.width].map(usize::from);
        for (k, pixel) in frame.buffer.chunks_exact(4).enumerate().filter(|(_, p)| p[3] > 0) {
            let at = 4 * ((top + k / width) * size[0] + left + k % width);
            shown[at..at + 4].copy_from_slice(pixel);
        }
        frames.push(shown.clone());
        delays.push(u64::from(frame.delay));
    }
    (size, frames, delays)
}

/// Size, frames as they are seen (RGB) and delays [s] of a PNG; a still has one frame.
fn read_png(path: &Path) -> ([usize; 2], Vec<Vec<u8>>, Vec<f64>) {
    let decoder = png::Decoder::new(BufReader::new(File::open(path).unwrap()));
    let mut reader = decoder.read_info().unwrap();
    let size = [reader.info().width as usize, reader.info().height as usize];
    let count = reader.info().animation_control().map_or(1, |a| a.num_frames as usize);
    let mut shown = vec![0; 3 * size[0] * size[1]];
    let (mut frames, mut delays) = (Vec::new(), Vec::new());
    for _ in 0..count {
        let mut part = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut part).unwrap();
        let control = reader.info().frame_control().copied();
        let [left, top] = control.map_or([0, 0], |c| [c.x_offset as usize, c.y_offset as usize]);
        let width = 3 * info.width as usize;
        for (row, bytes) in part[..info.buffer_size()].chunks_exact(width).enumerate() {
            let at = 3 * ((top + row) * size[0] + left);
            shown[at..at + width].copy_from_slice(bytes);
        }
        frames.push(shown.clone());
        delays.extend(control.map(|c| f64::from(c.delay_num) / f64::from(c.delay_den)));
    }
    (size, frames, delays)
}

/// The picture of the last instant of a run.
fn last(sandbox: &Sandbox, run: &str) -> Vec<u8> {
    let frames = fields::read(sandbox.path(run)).unwrap().unwrap().frames;
    let time = format!("{}", frames.last().unwrap().time);
    let file = format!("{run}-last.png");
    let arguments = ["animate", run, "-o", &file, "--width", "320", "--still", &time];
    sandbox.percuss(&arguments).ends_with(0);
    read_png(&sandbox.path(&file)).1.remove(0)
}

#[test]
fn a_gif_moves_in_due_time_and_ends_where_the_run_ends() {
    let sandbox = sandbox();
    for run in ["elastic", "rigid"] {
        film(&sandbox, run, "film.gif");
        let ([width, height], frames, delays) = read_gif(&sandbox.path("film.gif"));
        assert_eq!((width, delays.iter().sum::<u64>()), (320, 100));
        assert!((5..=10).contains(&frames.len()) && delays.len() == frames.len());
        assert!(frames.windows(2).all(|pair| pair[0] != pair[1]));
        let still = last(&sandbox, run);
        assert_eq!(still.len(), 3 * width * height);
        let shown = frames.last().unwrap().chunks_exact(4).flat_map(|p| &p[..3]);
        let off: usize = shown.zip(&still).map(|(a, b)| usize::from(a.abs_diff(*b))).sum();
        // So many colours stand for all of them.
        assert!(off < still.len() / 20, "{run}: {off} in {}", still.len());
    }
}

#[test]
fn an_animated_png_has_every_frame_as_it_is() {
    let sandbox = sandbox();
    for run in ["elastic", "rigid"] {
        film(&sandbox, run, "film.apng");
        let ([width, _], frames, delays) = read_png(&sandbox.path("film.apng"));
        assert_eq!((width, frames.len()), (320, 10));
        assert_eq!(delays, [0.1; 10]);
        assert!(frames.windows(2).all(|pair| pair[0] != pair[1]));
        assert_eq!(frames.last(), Some(&last(&sandbox, run)), "{run}");
        let bytes = std::fs::read(sandbox.path("film.apng")).unwrap();
        assert!(bytes.windows(4).any(|w| w == b"acTL") && bytes.windows(4).any(|w| w == b"fdAT"));
    }
}

#[cfg(unix)]
#[test]
fn ffmpeg_gets_every_pixel_of_every_frame() {
    let sandbox = sandbox();
    let says = "#!/bin/sh\nfor last; do :; done\necho \"$@\" > arguments\nwc -c < /dev/stdin > \"${last#file:}\"\n";
    let fails = "#!/bin/sh\necho 'no such encoder' >&2\nexit 1\n";
    let with = |program: &str| {
        std::fs::create_dir_all(sandbox.path("bin")).unwrap();
        sandbox.put("bin/ffmpeg", program);
        let file = sandbox.path("bin/ffmpeg");
        let mode = std::os::unix::fs::PermissionsExt::from_mode(0o755);
        std::fs::set_permissions(file, mode).unwrap();
        let mut command =
            sandbox.command(&[&["animate", "rigid", "-o", "film.mp4"][..], &SMALL].concat());
        let path = format!("{}:/usr/bin:/bin", sandbox.path("bin").display());
        command.env("PATH", path).output().unwrap()
    };
    let failed = common::Outcome::from(with(fails));
    failed.ends_with(1).tells("no such encoder");
    assert!(sandbox.names().iter().all(|name| !name.contains("film")), "{:?}", sandbox.names());
    let made = common::Outcome::from(with(says));
    made.ends_with(0);
    let size = made.stderr.split_once("frames of ").unwrap().1.split_once(',').unwrap().0;
    let (width, height) = size.split_once(" x ").unwrap();
    let [width, height] = [width, height].map(|n| n.parse::<usize>().unwrap());
    assert!(width % 2 == 0 && height % 2 == 0);
    let bytes = std::fs::read_to_string(sandbox.path("film.mp4")).unwrap();
    assert_eq!(bytes.trim().parse::<usize>().unwrap(), 10 * 3 * width * height);
    let arguments = std::fs::read_to_string(sandbox.path("arguments")).unwrap();
    for expected in
        ["-f rawvideo", "rgb24", &format!("{width}x{height}"), "-framerate 10", "-f mp4"]
    {
        assert!(arguments.contains(expected), "no {expected} in {arguments}");
    }
}

#[test]
fn without_ffmpeg_a_message_says_what_works() {
    let sandbox = sandbox();
    let mut command = sandbox.command(&["animate", "rigid", "-o", "film.mp4"]);
    let refused =
        common::Outcome::from(command.env("PATH", sandbox.path("nowhere")).output().unwrap());
    refused.ends_with(2).tells(".gif").tells(".apng").tells("ffmpeg");
    assert!(sandbox.names().iter().all(|name| !name.contains("film")), "{:?}", sandbox.names());
}

#[test]
fn files_of_others_stay() {
    let sandbox = sandbox();
    let make = |file: &str, more: &[&str]| {
        sandbox.percuss(&[&["animate", "rigid", "-o", file][..], &SMALL, more].concat())
    };
    sandbox.put("film.gif", "mine");
    make("film.gif", &[]).ends_with(2).tells("--force");
    assert_eq!(std::fs::read_to_string(sandbox.path("film.gif")).unwrap(), "mine");
    make("film.gif", &["--force"]).ends_with(0);
    for file in ["film.gif", "film.apng"] {
        make(file, &[]).ends_with(0);
        make(file, &[]).ends_with(0);
    }
    for file in ["still.svg", "still.pdf", "still.png"] {
        for _ in 0..2 {
            sandbox
                .percuss(&["animate", "rigid", "-o", file, "--still", "1 ms", "-q"])
                .ends_with(0);
        }
    }
    std::fs::create_dir(sandbox.path("dir.gif")).unwrap();
    make("dir.gif", &["--force"]).ends_with(2).tells("directory");
    make("no/such/dir.gif", &[]).ends_with(1).tells("no/such");
    assert!(sandbox.names().iter().all(|name| !name.contains("partial")), "{:?}", sandbox.names());
}

#[test]
fn unavailable_outputs_are_reported_with_their_cure() {
    let sandbox = sandbox();
    let refused = |arguments: &[&str], text: &str| {
        sandbox.percuss(&[&["animate"][..], arguments].concat()).ends_with(2).tells(text);
    };
    refused(&["rigid", "-o", "a.avi"], ".mp4");
    refused(&["rigid", "-o", "a.gif", "--still", "0"], ".svg");
    refused(&["rigid", "-o", "a.gif", "--from", "3 kg"], "12 ms");
    refused(&["rigid", "-o", "a.gif", "--from", "1 h"], "the run has shapes from 0 s to");
    refused(&["rigid", "-o", "a.gif", "--from", "2 ms", "--to", "1 ms"], "is not before");
    refused(&["rigid", "-o", "a.gif", "--colour", "stres"], "stress");
    refused(&["rigid", "-o", "a.gif", "--fps", "60"], "50 or less");
    refused(&["nowhere", "-o", "a.gif"], "no such directory");
    let set = ["--set", "record.shapes=0", "--no-report", "-q", "--out", "bare"];
    sandbox.percuss(&[&["run", "rigid.toml"][..], &set].concat()).ends_with(0);
    refused(&["bare", "-o", "a.gif"], "record.shapes");
    let discs = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenarios/disc-chain.toml");
    let run = ["run", discs, "--no-report", "-q", "--out", "discs"];
    sandbox.percuss(&run).ends_with(0);
    let touch = "touch in this run (contact `striker`)";
    refused(&["discs", "-o", "a.gif", "--exaggeration", "5"], touch);
    assert!(!sandbox.path("a.gif").exists());
}

#[test]
fn frames_that_do_not_fit_their_scene_are_refused() {
    let sandbox = sandbox();
    let scene = sandbox.path("rigid/fields/scene.json");
    let text = std::fs::read_to_string(&scene).unwrap();
    let mut value: Value = serde_json::from_str(&text).unwrap();
    value["beams"][0]["x"].as_array_mut().unwrap().pop();
    std::fs::write(&scene, value.to_string()).unwrap();
    sandbox.percuss(&["animate", "rigid", "-o", "a.gif"]).ends_with(2).tells("rigid");
    // Arrays fit, but what stands on a beam that is not there cannot be drawn.
    let mut value: Value = serde_json::from_str(&text).unwrap();
    value["supports"] =
        json!([{ "name": "s", "kind": "pin", "at": { "beam": 7, "s": 0.0 }, "until": null }]);
    std::fs::write(&scene, value.to_string()).unwrap();
    for file in ["a.gif", "a.apng"] {
        let made = sandbox.percuss(&["animate", "rigid", "-o", file]);
        made.ends_with(2).tells("fields/scene.json is damaged");
        assert_eq!(made.stderr.lines().count(), 1, "{}", made.stderr);
    }
    assert!(sandbox.names().iter().all(|name| !name.contains("a.")), "{:?}", sandbox.names());
}

#[test]
fn the_impact_alone_is_shown_longer_than_it_lasts_by_little() {
    let sandbox = sandbox();
    let of = |more: &[&str]| {
        let all = [&["animate", "elastic", "-o", "a.gif"][..], &SMALL, more].concat();
        let made = sandbox.percuss(&all);
        made.ends_with(0);
        made.stderr
    };
    let whole = of(&[]);
    let impact = of(&["--impact"]);
    assert_ne!(whole, impact);
    assert!(of(&["--from", "1 ms", "--to", "0.003"]).contains("t = 1 ms to 3 ms, duration 1 s"));
}

#[cfg(unix)]
#[test]
fn an_interrupted_film_leaves_nothing() {
    let sandbox = sandbox();
    let arguments = ["animate", "elastic", "-o", "long.apng", "--duration", "600", "--fps", "50"];
    let mut child = sandbox.command(&arguments).spawn().unwrap();
    let begun = std::time::Instant::now();
    while !sandbox.names().iter().any(|name| name.contains("partial")) {
        if begun.elapsed().as_secs() > 60 {
            let _ = child.kill();
            panic!("no film was begun");
        }
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    let sent = Command::new("kill").args(["-INT", &child.id().to_string()]).status();
    assert!(sent.unwrap().success());
    let ended = common::Outcome::from(child.wait_with_output().unwrap());
    ended.ends_with(130).tells("nothing is written");
    assert!(sandbox.names().iter().all(|name| !name.contains("long")), "{:?}", sandbox.names());
}

/// What node makes of the same scripts; none if there is no node.
fn drawn_by_node(sandbox: &Sandbox, run: &str, look: &Value, time: f64) -> Option<String> {
    Command::new("node").arg("--version").stdout(Stdio::null()).status().ok()?;
    let fields = fields::read(sandbox.path(run)).unwrap().unwrap();
    let all = |list: fn(&fields::StoredFrame) -> &Vec<f32>| -> Vec<f32> {
        fields.frames.iter().flat_map(list).copied().collect()
    };
    let frames = json!({
        "time": fields.frames.iter().map(|f| f.time).collect::<Vec<f64>>(),
        "displacement": all(|f| &f.displacement),
        "velocity": all(|f| &f.velocity),
        "sections": all(|f| &f.section_forces),
        "points": all(|f| &f.section_points),
        "point_count": fields.frames.iter().map(|f| f.section_points.len() / 5).collect::<Vec<usize>>(),
        "contacts": all(|f| &f.contact_forces),
        "loads": all(|f| &f.load_factors),
        "contact_count": fields.frames.iter().map(|f| f.contact_forces.len() / 6).collect::<Vec<usize>>(),
    });
    let colours: Map<String, Value> =
        scene_colours(false).into_iter().map(|(n, v)| (n.to_owned(), v.into())).collect();
    let film =
        PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../percuss-pictures/web/film.js"));
    let scripts: Vec<String> = scene_scripts()
        .map(str::to_owned)
        .chain([std::fs::read_to_string(film).unwrap()])
        .collect();
    let flash = 0.02 * (fields.frames.last().unwrap().time - fields.frames[0].time);
    let task = json!({
        "scripts": scripts, "scene": fields.scene.to_string(), "frames": frames, "look": look.to_string(),
        "colours": Value::Object(colours).to_string(), "time": time, "flash": flash,
    });
    sandbox.put("task.json", task.to_string());
    sandbox.put(
        "draw.js",
        "const vm = require('node:vm');\n\
         const task = JSON.parse(require('node:fs').readFileSync('task.json', 'utf8'));\n\
         const context = vm.createContext({});\n\
         for (const script of task.scripts) vm.runInContext(script, context);\n\
         const typed = Object.fromEntries(Object.entries(task.frames).map(([name, values]) =>\n\
           [name, name === 'time' ? Float64Array.from(values) : Float32Array.from(values)]));\n\
         context.openFilm(task.scene, typed, task.colours, task.look);\n\
         process.stdout.write(context.drawFilm(task.time, task.flash));\n",
    );
    let output =
        Command::new("node").arg("draw.js").current_dir(sandbox.path("")).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    Some(String::from_utf8(output.stdout).unwrap())
}

#[test]
fn a_still_is_what_another_engine_makes_of_the_same_scripts() {
    let sandbox = sandbox();
    let options = ["--colour", "moment", "--diagram", "shear", "--exaggeration", "3"];
    for (run, time) in [("elastic", 0.02), ("rigid", 0.011)] {
        let text = format!("{time}");
        let still = ["animate", run, "-o", "still.svg", "--title", "A < B & C", "--still", &text];
        sandbox.percuss(&[&still[..], &options].concat()).ends_with(0);
        let file = std::fs::read_to_string(sandbox.path("still.svg")).unwrap();
        let (mark, svg) = file.split_once('\n').unwrap();
        assert!(mark.starts_with("<!-- made by percuss"), "{mark}");
        assert!(svg.contains("A &lt; B &amp; C") && !svg.contains("NaN"), "{svg}");
        let look = json!({ "width": 800, "title": "A < B & C", "colour": "moment", "diagram": "shear", "exaggeration": 3.0 });
        match drawn_by_node(&sandbox, run, &look, time) {
            Some(drawn) => assert!(drawn == svg, "{run}: node draws something else"),
            None => eprintln!("node is missing: not compared"),
        }
    }
}
