//! What `percuss serve` and `percuss eval` promise to the programs that drive them.

use crate::common;

use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;

use common::Sandbox;
use serde_json::{Value, json};

const STUDY: &str = r#"
title = "Speed and mass"
base = "elastic.toml"

[parameter.speed]
path = "projectile.mass.velocity[1]"
range = { from = "10 m/s", to = "30 m/s" }

[parameter.mass]
path = "projectile.mass.mass"
range = { from = "400 kg", to = "600 kg" }

[design]
kind = "sobol"
runs = 8

[results]
force = "contact.mass.peak_force.value"
exit = "projectile.mass.velocity_final[1]"
"#;

fn sandbox() -> Sandbox {
    let sandbox = Sandbox::new();
    sandbox.put("study.toml", STUDY);
    sandbox
}

/// What `percuss sensitivity` and a run say at 20 m/s and 500 kg, the values of the file.
fn expected(sandbox: &Sandbox) -> Value {
    let reported = sandbox.percuss(&[
        "sensitivity",
        "elastic.toml",
        "--json",
        "-p",
        "projectile.mass.velocity[1]",
        "-p",
        "projectile.mass.mass",
        "-r",
        "contact.mass.peak_force.value",
        "-r",
        "projectile.mass.velocity_final[1]",
    ]);
    serde_json::from_str(&reported.stdout).expect("JSON")
}

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-10 * b.abs()
}

const DAKOTA: &str = "2 variables\n500 mass\n20 speed\n1 functions\n3 ASV_1:exit\n1 derivative_variables\n\
    1 DVV_1:mass\n0 analysis_components\n1 eval_id\n";

#[test]
fn a_point_is_evaluated_in_every_form() {
    let sandbox = sandbox();
    let expected = expected(&sandbox);
    let number = |value: &Value| value.as_f64().expect("a number");
    sandbox.put("point.json", r#"{"mass": 500, "speed": 20}"#);
    let reported = sandbox.percuss(&["eval", "study.toml", "point.json", "--gradients"]);
    assert_eq!(reported.status, Some(0), "{}", reported.stderr);
    let reported: Value = serde_json::from_str(&reported.stdout).expect("JSON alone");
    let plain = sandbox.percuss(&["eval", "study.toml", "point.json"]);
    let plain: Value = serde_json::from_str(&plain.stdout).expect("JSON alone");
    assert_eq!(
        plain["results"], reported["results"],
        "values do not depend on whether gradients are asked for"
    );
    assert_eq!(reported["means"], "exact");
    for (k, result) in ["force", "exit"].iter().enumerate() {
        assert!(close(
            number(&reported["results"][result]),
            number(&expected["results"][k]["value"])
        ));
        for (j, parameter) in ["speed", "mass"].iter().enumerate() {
            let found = number(&reported["derivatives"][result][parameter]);
            assert!(close(found, number(&expected["derivatives"][k][j])), "{reported:#}");
        }
    }
    sandbox.put("params.in", DAKOTA);
    sandbox.percuss(&["eval", "study.toml", "params.in", "results.out"]).ends_with(0);
    let text = std::fs::read_to_string(sandbox.path("results.out")).expect("results");
    let lines: Vec<&str> = text.lines().collect();
    let (value, label) = lines[0].split_once(' ').expect("a value and its label");
    assert!(
        label == "exit"
            && close(value.parse().expect("a number"), number(&expected["results"][1]["value"]))
    );
    let gradient = lines[1].trim_matches(['[', ']', ' ']).parse().expect("one number");
    assert!(lines.len() == 2 && close(gradient, number(&expected["derivatives"][1][1])), "{text}");
}

#[test]
fn failed_evaluations_are_reported_and_nothing_is_lost() {
    let sandbox = sandbox();
    sandbox.put("params.in", DAKOTA);
    sandbox.put("results.out", "earlier");
    sandbox
        .percuss(&["eval", "study.toml", "params.in", "results.out"])
        .ends_with(2)
        .tells("exists already");
    assert_eq!(std::fs::read(sandbox.path("results.out")).expect("a file"), b"earlier");
    // A failed evaluation is one for Dakota too.
    sandbox.put("heavy.in", DAKOTA.replace("500 mass", "-500 mass"));
    sandbox
        .percuss(&["eval", "study.toml", "heavy.in", "failed.out"])
        .ends_with(3)
        .tells("a mass above zero");
    let failed = std::fs::read_to_string(sandbox.path("failed.out")).expect("results");
    assert!(failed.starts_with("FAIL") && failed.contains("[E016]"), "{failed}");
    for (text, reported) in [
        (
            DAKOTA.replace("20 speed", "20 sped"),
            "`sped` is no parameter of the study, expected one of `speed`, `mass` (did you mean `speed`?)",
        ),
        (
            DAKOTA.replace("3 ASV_1:exit", "3 ASV_1:obj_fn"),
            "functions obj_fn do not match the study's results (force, exit)",
        ),
        (DAKOTA.replace("3 ASV", "4 ASV"), "second derivatives of `exit`"),
        (r#"{"speed": "fast", "mass": 1}"#.to_owned(), "`speed` is \"fast\""),
        (r#"{"speed": 20}"#.to_owned(), "no value for `mass`"),
        ("nothing".to_owned(), "a count of `variables`"),
        (
            DAKOTA.replace("DVV_1:mass", "DVV_1:mas"),
            "derivatives by a parameter: `mas` is no parameter of the study",
        ),
        (r#"{"speed": 20, "mass": 1, "speed": 21}"#.to_owned(), "duplicate key `speed`"),
        (r#"{"speed": 20, "mass""#.to_owned(), "EOF"),
        (DAKOTA.replace("500 mass", "500 speed"), "two values for `speed`"),
        (
            DAKOTA.replace("1 functions\n3 ASV_1:exit", "2 functions\n1 ASV_1:exit\n1 ASV_2:other"),
            "do not match the study's results",
        ),
        (
            DAKOTA.replace("1 functions\n3 ASV_1:exit", "2 functions\n1 ASV_1:exit\n1 ASV_2:exit"),
            "duplicate function `exit`",
        ),
        // A point, and then blanks up to where reading ended: what came behind was not read.
        (
            format!("{DAKOTA}{}", " ".repeat(16 << 20)),
            "a file of more than 16 MiB is no file of parameters",
        ),
    ] {
        sandbox.put("bad.in", text);
        sandbox
            .percuss(&["eval", "study.toml", "bad.in", "bad.out"])
            .ends_with(2)
            .tells(reported)
            .tells("E319");
        assert!(!sandbox.path("bad.out").exists());
    }
}

/// Whether runs go side by side, and what keeps them from it.
#[test]
fn checks_say_whether_runs_go_side_by_side() {
    let sandbox = sandbox();
    let reported = |study: String| {
        sandbox.put("asked.toml", study);
        let reported = sandbox.percuss(&["check", "asked.toml"]);
        assert_eq!(reported.status, Some(0), "{}", reported.stderr);
        reported.stdout.lines().nth(1).unwrap_or_default().to_owned()
    };
    let rigid = STUDY
        .replace("elastic.toml", "rigid.toml")
        .replace("\"10 m/s\", to = \"30 m/s\"", "\"-30 m/s\", to = \"-10 m/s\"")
        .replace("contact.mass.peak_force.value", "contact.hammer.impulse_total")
        .replace("projectile.mass", "projectile.hammer");
    let asking =
        |result: &str| STUDY.replace("[results]", &format!("[results]\nasked = \"{result}\""));
    let [moment, stress] = ["moment_max.value", "stress.max.value"]
        .map(|force| asking(&format!("section_forces.girder.{force}")));
    for study in [STUDY.to_owned(), rigid, moment, stress] {
        assert_eq!(reported(study), "runs are computed in SIMD batches");
    }
    for alone in ["section_forces.girder.strain.max.value", "support.left.moment.max.value"] {
        let why = format!("runs are computed one at a time: `asked` is requested ({alone})");
        assert_eq!(reported(asking(alone)), why);
    }
    let stayed = common::ELASTIC.to_owned()
        + "\n[spring.stay]\nbetween = [\"girder.mid\", [0, 1]]\nstiffness = 1e3\n";
    sandbox.put("stayed.toml", stayed);
    let springs = STUDY.replace("elastic.toml", "stayed.toml");
    let why = "runs are computed one at a time: springs between points, and rotational springs";
    assert_eq!(reported(springs), why);
}

/// A request over HTTP: status and answer.
fn ask(address: &str, path: &str, body: &Value) -> (u16, Value) {
    let (host, token) = address.split_once('/').expect("an address with its token");
    let mut stream = TcpStream::connect(host).expect("a connection");
    let body = body.to_string();
    let head = format!(
        "POST /{token}{path} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\nContent-Length: {}\r\n\r\n",
        body.len()
    );
    stream.write_all((head + &body).as_bytes()).expect("a request");
    let mut answer = String::new();
    stream.read_to_string(&mut answer).expect("an answer");
    let (head, body) = answer.split_once("\r\n\r\n").expect("head and body");
    let status = head.split(' ').nth(1).and_then(|status| status.parse().ok()).expect("a status");
    (status, serde_json::from_str(body).expect("JSON"))
}

#[test]
fn a_served_study_speaks_um_bridge() {
    let sandbox = sandbox();
    let mut server =
        sandbox.command(&["serve", "study.toml", "--port", "0"]).spawn().expect("percuss");
    let mut first = String::new();
    BufReader::new(server.stderr.take().expect("piped")).read_line(&mut first).expect("a greeting");
    let address = first
        .split("http://")
        .nth(1)
        .and_then(|rest| rest.split(' ').next())
        .expect("an address")
        .to_owned();
    let asked = |path: &str, more: Value| {
        let mut body = json!({ "name": "forward", "config": {} });
        for (key, value) in more.as_object().expect("a table") {
            body[key] = value.clone();
        }
        ask(&address, path, &body)
    };
    let point = json!({ "input": [[20.0, 500.0]] });
    let with = |key: &str, value: Value| {
        let mut point = point.clone();
        point["outWrt"] = json!(0);
        point["inWrt"] = json!(0);
        point[key] = value;
        point
    };
    assert_eq!(
        ask(&address, "/Info", &json!({})).1,
        json!({ "protocolVersion": 1.0, "models": ["forward"] })
    );
    assert_eq!(asked("/InputSizes", json!({})).1, json!({ "inputSizes": [2] }));
    assert_eq!(asked("/OutputSizes", json!({})).1, json!({ "outputSizes": [2] }));
    assert_eq!(asked("/ModelInfo", json!({})).1["support"]["Gradient"], true);
    let expected = expected(&sandbox);
    let d = |k: usize, j: usize| expected["derivatives"][k][j].as_f64().expect("a number");
    let numbers = |(status, answer): (u16, Value)| -> Vec<f64> {
        assert_eq!(status, 200, "{answer}");
        let output = answer["output"].as_array().cloned().unwrap_or_default();
        let flat =
            output.iter().flat_map(|x| x.as_array().cloned().unwrap_or_else(|| vec![x.clone()]));
        flat.filter_map(|x| x.as_f64()).collect()
    };
    let values = numbers(asked("/Evaluate", point.clone()));
    assert!(close(values[0], expected["results"][0]["value"].as_f64().expect("a number")));
    let gradient = numbers(asked("/Gradient", with("sens", json!([2.0, -1.0]))));
    let action = numbers(asked("/ApplyJacobian", with("vec", json!([1.0, 3.0]))));
    for j in 0..2 {
        assert!(close(gradient[j], 2.0 * d(0, j) - d(1, j)), "{gradient:?}");
        assert!(close(action[j], d(j, 0) + 3.0 * d(j, 1)), "{action:?}");
    }
    for (path, body, status, kind) in [
        ("/Evaluate", json!({ "input": [[20.0]] }), 400, "InvalidInput"),
        ("/Evaluate", json!({ "input": [[20.0, -1.0]] }), 500, "InvalidOutput"),
        (
            "/Evaluate",
            json!({ "input": [[20.0, 500.0]], "config": { "fine": true } }),
            400,
            "InvalidInput",
        ),
        ("/Evaluate", json!({ "name": "backward" }), 400, "ModelNotFound"),
        ("/ApplyHessian", json!({}), 400, "UnsupportedFeature"),
        ("/Gradient", with("sens", json!([1.0])), 400, "InvalidInput"),
    ] {
        let (found, answer) = asked(path, body);
        assert_eq!((found, answer["error"]["type"].as_str()), (status, Some(kind)), "{answer}");
    }
    server.kill().expect("an end");
    server.wait().expect("an end");
}

#[test]
fn manual_pages_are_written_for_every_command() {
    let sandbox = Sandbox::empty();
    sandbox.percuss(&["man", "--out", "pages"]).ends_with(0);
    let page = std::fs::read_to_string(sandbox.path("pages/percuss-run.1")).expect("a page");
    assert!(page.contains(".TH percuss-run 1") && page.contains("checkpoint"));
    assert!(sandbox.path("pages/percuss.1").exists());
}

/// A ball of 0.5 kg is still in a contact of 1 MN/m after 0.5 ms (it leaves after 2.22 ms): what it has come to by then is no final result, and whoever
/// asks is told.
#[test]
fn results_that_a_closed_contact_leaves_open_are_named() {
    let sandbox = Sandbox::new();
    sandbox.put(
        "ball.toml",
        "[projectile.ball]\nkind = \"elastic\"\ncontact = \"surface\"\nmass = 0.5\nvelocity = [0, -2]\n\
         stiffness = 1e6\nposition = [0, 0]\nstrikes = \"floor\"\n\
         [obstacle.floor]\nkind = \"half-plane\"\npoint = [0, 0]\nnormal = [0, 1]\n\
         [time]\nend = \"3 ms\"\nstep = \"4 us\"\n",
    );
    sandbox.put(
        "study.toml",
        "base = \"ball.toml\"\n[parameter.end]\npath = \"time.end\"\nvalues = [5e-4, 3e-3]\n\
         [design]\nkind = \"grid\"\n[results]\npeak = \"contact.ball.peak_force.value\"\n\
         vout = \"projectile.ball.velocity_final[1]\"\n",
    );
    for (end, open) in [("5e-4", true), ("3e-3", false)] {
        sandbox.put("point.json", format!("{{\"end\": {end}}}"));
        let reported = sandbox.percuss(&["eval", "study.toml", "point.json"]);
        assert_eq!(reported.status, Some(0), "{}", reported.stderr);
        assert_eq!(reported.stderr.contains("W016"), open, "{}", reported.stderr);
        let value: Value = serde_json::from_str(&reported.stdout).expect("JSON alone");
        let not_final = if open { serde_json::json!(["peak", "vout"]) } else { Value::Null };
        assert_eq!(value["not_final"], not_final, "{value}");
    }
}
