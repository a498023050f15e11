//! Whom `percuss serve` answers, and what hostile and slow clients cost it.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::process::Child;
use std::time::{Duration, Instant};

use crate::common::Sandbox;

const STUDY: &str = "base = \"elastic.toml\"\n[parameter.speed]\npath = \"projectile.mass.velocity[1]\"\n\
    range = { from = \"10 m/s\", to = \"30 m/s\" }\n[design]\nkind = \"sobol\"\nruns = 8\n\
    [results]\nexit = \"projectile.mass.velocity_final[1]\"\n";
const PATIENCE: Duration = Duration::from_secs(60);

/// A server, ended with the test.
struct Served {
    child: Child,
    host: String,
    token: String,
    _sandbox: Sandbox,
}

impl Drop for Served {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

impl Served {
    fn new() -> Self {
        let sandbox = Sandbox::new();
        sandbox.put("study.toml", STUDY);
        let line = ["serve", "study.toml", "--port", "0", "--jobs", "2"];
        let mut child = sandbox.command(&line).spawn().expect("percuss");
        let mut first = String::new();
        let reported = child.stderr.take().expect("piped");
        BufReader::new(reported).read_line(&mut first).expect("a greeting");
        let address = first.split("http://").nth(1).and_then(|rest| rest.split(' ').next());
        let (host, token) = address.and_then(|a| a.split_once('/')).expect("an address");
        let (host, token) = (host.to_owned(), token.to_owned());
        Self { child, host, token, _sandbox: sandbox }
    }

    fn open(&self) -> TcpStream {
        let stream = TcpStream::connect(&self.host).expect("a connection");
        stream.set_read_timeout(Some(PATIENCE)).expect("a timeout");
        stream
    }

    /// What is answered to bytes; empty where the connection is closed.
    fn reported(&self, bytes: &[u8]) -> String {
        let mut stream = self.open();
        let _ = stream.write_all(bytes);
        let mut answer = Vec::new();
        let _ = stream.read_to_end(&mut answer);
        String::from_utf8_lossy(&answer).into_owned()
    }

    /// The status with which a request is answered.
    fn status(&self, path: &str, headers: &str, body: &str) -> String {
        let head = format!("POST {path} HTTP/1.1\r\nConnection: close\r\n{headers}\r\n\r\n");
        let answer = self.reported((head + body).as_bytes());
        answer.split(' ').nth(1).unwrap_or_default().to_owned()
    }

    fn evaluates(&self) {
        let body = "{\"name\": \"forward\", \"input\": [[20]]}";
        let headers = format!("Host: {}\r\nContent-Length: {}", self.host, body.len());
        let path = format!("/{}/Evaluate", self.token);
        assert_eq!(self.status(&path, &headers, body), "200");
    }

    /// Resident memory [kB].
    #[cfg(target_os = "linux")]
    fn memory(&self) -> u64 {
        let status = std::fs::read_to_string(format!("/proc/{}/status", self.child.id()));
        let status = status.expect("a process");
        let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:")).expect("its memory");
        line.trim().trim_end_matches(" kB").parse().expect("a number")
    }
}

#[test]
fn whoever_does_not_know_the_token_or_comes_from_elsewhere_is_refused() {
    let served = Served::new();
    let (own, info) = (format!("Host: {}", served.host), format!("/{}/Info", served.token));
    assert!(served.token.len() == 32, "{}", served.token);
    for (path, headers, status) in [
        (info.as_str(), own.as_str(), "200"),
        ("/Info", own.as_str(), "403"),
        ("/0123456789abcdef0123456789abcdef/Info", own.as_str(), "403"),
        (info.as_str(), "Host: evil.example", "403"),
        (info.as_str(), format!("{own}\r\nOrigin: http://evil.example").as_str(), "403"),
        (info.as_str(), format!("{own}\r\nContent-Length: 100000000000000").as_str(), "413"),
        (info.as_str(), format!("{own}\r\nTransfer-Encoding: chunked").as_str(), "400"),
        (info.as_str(), "Accept: */*", "400"),
    ] {
        assert_eq!(served.status(path, headers, ""), status, "{path} {headers}");
    }
    served.evaluates();
}

#[test]
fn a_server_that_tells_nothing_needs_to_be_given_its_token() {
    let sandbox = Sandbox::new();
    sandbox.put("study.toml", STUDY);
    let reported = sandbox.percuss(&["serve", "study.toml", "--port", "0", "--quiet"]);
    reported.ends_with(2).tells("--token or --no-token");
    let reported = sandbox.percuss(&["serve", "study.toml", "--port", "0", "--token", "a/b"]);
    reported.ends_with(2).tells("--token");
}

/// More slow clients than there are jobs, and than there is room for.
#[test]
fn slow_clients_wait_for_themselves_alone() {
    let served = Served::new();
    let mut slow = Vec::new();
    for k in 0..300 {
        let mut stream = served.open();
        let half = format!("POST /{}/Evaluate HTTP/1.1\r\nHost: x\r\nContent-", served.token);
        let _ = stream.write_all(&half.as_bytes()[..20 + k % 20]);
        slow.push(stream);
    }
    let begun = Instant::now();
    served.evaluates();
    assert!(begun.elapsed() < Duration::from_secs(8), "{:?}", begun.elapsed());
    // The first ones made room.
    let mut rest = Vec::new();
    let _ = slow[0].read_to_end(&mut rest);
    assert!(rest.is_empty());
}

/// Requests of a kind by their number: cut, too long, of other names, without end, no text at all, and valid ones between them.
#[cfg(target_os = "linux")]
fn hostile(served: &Served, k: usize) -> Vec<u8> {
    let (host, token) = (&served.host, &served.token);
    let head = |more: &str| {
        format!(
            "POST /{token}/Info HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n{more}\r\n\r\n"
        )
    };
    match k % 10 {
        0 => head("Content-Length: 100000000000000").into_bytes(),
        1 => head("Content-Length: 18446744073709551616").into_bytes(),
        2 => head("Transfer-Encoding: chunked").into_bytes(),
        3 => head(&"A: b\r\n".repeat(100)).into_bytes(),
        4 => format!("GET /{} HTTP/1.1\r\n", "x".repeat(20_000)).into_bytes(),
        5 => head("Content-Length: 1000000").into_bytes(),
        6 => (0..200).map(|i: usize| (i * 7919 + k * 104_729) as u8).collect(),
        7 => head("Origin: null").into_bytes(),
        8 => format!("{}{{\"name\"", head("Content-Length: 9")).into_bytes(),
        _ => head("Content-Length: 0").into_bytes(),
    }
}

/// `PERCUSS_SOAK` says how many requests; each connection is left as it is, so that the server has to end it.
#[test]
#[cfg(target_os = "linux")]
fn hostile_requests_cost_no_memory() {
    let served = Served::new();
    let count = std::env::var("PERCUSS_SOAK").ok().and_then(|n| n.parse().ok()).unwrap_or(10_000);
    let mut before = 0;
    for k in 0..count {
        let mut stream = served.open();
        let _ = stream.write_all(&hostile(&served, k));
        if k % 10 == 9 {
            let mut answer = String::new();
            stream.read_to_string(&mut answer).expect("an answer");
            assert!(answer.starts_with("HTTP/1.1 200"), "{answer}");
        }
        if k == count / 10 {
            before = served.memory();
        }
    }
    served.evaluates();
    let after = served.memory();
    println!("{count} requests: {before} kB after a tenth of them, {after} kB after all");
    assert!(after < before + 8192, "{before} kB, then {after} kB");
}
