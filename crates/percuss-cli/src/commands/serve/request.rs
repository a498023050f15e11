//! A request of HTTP/1.1 as bytes: what it asks, and who may ask.
//!
//! Nothing is allocated by what a request says of itself: lengths are compared with limits before anything is waited for.

use std::net::IpAddr;

use super::protocol::{Answer, Kind};

/// Longest head of a request: its line and its headers \[bytes\].
pub const LONGEST_HEAD: usize = 16 << 10;
/// Longest body of a request, more than any needs \[bytes\].
pub const LONGEST_BODY: usize = 1 << 20;
/// Headers of a request at most.
const HEADERS: usize = 64;

/// A request.
#[derive(Debug, PartialEq, Eq)]
pub struct Request {
    /// Whether it is a POST.
    pub posted: bool,
    /// The path behind the token.
    pub path: String,
    /// What it brings.
    pub body: String,
    /// Whether the connection stays open for another one.
    pub stays: bool,
}

/// What bytes of a connection are, so far.
#[derive(Debug, PartialEq)]
pub enum Parsed {
    /// The beginning of a request that takes this many bytes or more; whether its sender waits for `100 Continue`.
    Part { least: usize, waits: bool },
    /// A request, and how many bytes it took.
    Whole(Request, usize),
    /// None that is answered.
    Refused(Answer),
}

/// Who may ask: names that a request may call this server by, and the token that its path begins with.
#[derive(Clone, Debug)]
pub struct Gate {
    /// Names besides `localhost` and addresses in numbers, which no page of another site can take for its own, shape (names).
    pub hosts: Vec<String>,
    /// What a path begins with.
    pub token: Option<String>,
}

fn refused(kind: Kind, text: impl Into<String>) -> Parsed {
    Parsed::Refused(Answer::failure(kind, text.into()))
}

impl Gate {
    /// Reads what a connection has brought so far.
    pub fn read(&self, bytes: &[u8]) -> Parsed {
        let mut headers = [httparse::EMPTY_HEADER; HEADERS];
        let mut request = httparse::Request::new(&mut headers);
        let head = match request.parse(bytes) {
            Ok(httparse::Status::Complete(head)) if head <= LONGEST_HEAD => head,
            Ok(httparse::Status::Partial) if bytes.len() <= LONGEST_HEAD => {
                return Parsed::Part { least: bytes.len() + 1, waits: false };
            }
            Ok(_) => return refused(Kind::Large, "a request with a head of more than 16 KiB"),
            Err(error) => {
                return refused(Kind::Input, format!("no request of HTTP/1.1: {error}"));
            }
        };
        let about = match Head::of(&request) {
            Ok(about) => about,
            Err(answer) => return Parsed::Refused(answer),
        };
        if let Err(answer) = self.admits(&about) {
            return Parsed::Refused(answer);
        }
        let Some(path) = self.behind_token(about.path) else {
            let text = "the address ends in a token that was printed at the start";
            return refused(Kind::Forbidden, text);
        };
        let whole = head + about.length;
        if bytes.len() < whole {
            return Parsed::Part { least: whole, waits: about.waits && bytes.len() == head };
        }
        let Ok(body) = std::str::from_utf8(&bytes[head..whole]) else {
            return refused(Kind::Input, "a request that is not UTF-8");
        };
        let (posted, stays) = (about.posted, about.stays);
        Parsed::Whole(Request { posted, path, body: body.to_owned(), stays }, whole)
    }

    /// Whether a request calls this server by a name of its own, and comes from no page of another site.
    fn admits(&self, about: &Head<'_>) -> Result<(), Answer> {
        if !self.is_own(about.host) {
            let text = format!(
                "the request is for `{}`, which is no name of this server; `--allow-host` makes it one",
                about.host
            );
            return Err(Answer::failure(Kind::Forbidden, text));
        }
        let origin = about.origin.map(|o| o.split_once("://").map_or(o, |(_, host)| host));
        match origin.filter(|host| !host.eq_ignore_ascii_case(about.host)) {
            Some(host) => {
                let text = format!("a page of `{host}` asks, and only those of this server may");
                Err(Answer::failure(Kind::Forbidden, text))
            }
            None => Ok(()),
        }
    }

    fn is_own(&self, host: &str) -> bool {
        let name = match host.strip_prefix('[').and_then(|host| host.split_once(']')) {
            Some((name, _)) => name,
            None => host.split_once(':').map_or(host, |(name, _)| name),
        };
        let own = |other: &String| other.eq_ignore_ascii_case(name);
        name.eq_ignore_ascii_case("localhost")
            || name.parse::<IpAddr>().is_ok()
            || self.hosts.iter().any(own)
    }

    /// The path behind the token, where there is one.
    fn behind_token(&self, path: &str) -> Option<String> {
        let Some(token) = &self.token else { return Some(path.to_owned()) };
        let inner = path.strip_prefix('/')?;
        let (given, _) = inner.split_once('/').unwrap_or((inner, ""));
        // All bytes are looked at, so that the time taken says nothing of where they differ.
        let differs = given.bytes().zip(token.bytes()).fold(0, |sum, (a, b)| sum | (a ^ b));
        let same = given.len() == token.len() && differs == 0;
        same.then(|| inner[given.len()..].to_owned())
    }
}

/// What the head of a request says.
struct Head<'r> {
    posted: bool,
    path: &'r str,
    host: &'r str,
    origin: Option<&'r str>,
    /// Length of its body \[bytes\].
    length: usize,
    waits: bool,
    stays: bool,
}

impl<'r> Head<'r> {
    fn of(request: &'r httparse::Request<'_, '_>) -> Result<Self, Answer> {
        let input = |text: &str| Answer::failure(Kind::Input, text.to_owned());
        let values = |name: &str| -> Vec<&'r [u8]> {
            let named = request.headers.iter().filter(|h| h.name.eq_ignore_ascii_case(name));
            named.map(|h| h.value).collect()
        };
        let text = |value: &'r [u8]| std::str::from_utf8(value).map(str::trim);
        let one = |name: &str| -> Result<Option<&'r str>, Answer> {
            match values(name).as_slice() {
                [] => Ok(None),
                &[value] => text(value).map(Some).map_err(|_| input("a header that is no text")),
                _ => Err(input(&format!("duplicate header `{name}`"))),
            }
        };
        if one("Transfer-Encoding")?.is_some() {
            return Err(input("a body in parts; give its length in Content-Length"));
        }
        let length = match one("Content-Length")? {
            None => 0,
            Some(digits) if !digits.is_empty() && digits.bytes().all(|b| b.is_ascii_digit()) => {
                // One that no number holds is too long as well.
                digits.parse::<usize>().unwrap_or(usize::MAX)
            }
            Some(_) => return Err(input("a Content-Length that is no number")),
        };
        if length > LONGEST_BODY {
            return Err(Answer::failure(Kind::Large, "a request of more than a megabyte".into()));
        }
        let says = |header: Option<&str>, word: &str| {
            header.is_some_and(|value| value.eq_ignore_ascii_case(word))
        };
        Ok(Self {
            posted: request.method == Some("POST"),
            path: request.path.unwrap_or_default().split('?').next().unwrap_or_default(),
            host: one("Host")?.ok_or_else(|| input("a request without the header `Host`"))?,
            origin: one("Origin")?,
            length,
            waits: says(one("Expect")?, "100-continue"),
            stays: request.version == Some(1) && !says(one("Connection")?, "close"),
        })
    }
}

/// An answer as bytes.
pub fn written(answer: &Answer, stays: bool) -> Vec<u8> {
    let (status, body) = (answer.status, answer.body.to_string());
    let reason = match status {
        200 => "OK",
        400 => "Bad Request",
        403 => "Forbidden",
        413 => "Content Too Large",
        _ => "Internal Server Error",
    };
    let connection = if stays { "keep-alive" } else { "close" };
    let head = format!(
        "HTTP/1.1 {status} {reason}\r\nContent-Type: application/json\r\nContent-Length: {}\r\nConnection: {connection}\r\n\r\n",
        body.len()
    );
    (head + &body).into_bytes()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn gate(token: Option<&str>) -> Gate {
        Gate { hosts: vec!["node7".into()], token: token.map(str::to_owned) }
    }

    fn status(gate: &Gate, text: &str) -> u16 {
        match gate.read(text.as_bytes()) {
            Parsed::Refused(answer) => answer.status,
            Parsed::Whole(..) => 200,
            Parsed::Part { .. } => 0,
        }
    }

    #[test]
    fn a_request_is_whole_when_its_body_is_there() {
        let text = "POST /key/Evaluate?x HTTP/1.1\r\nHost: 127.0.0.1:4242\r\nContent-Length: 4\r\n\r\nbodyGET";
        let whole = text.len() - 3;
        for end in 0..whole {
            let parsed = gate(Some("key")).read(&text.as_bytes()[..end]);
            assert!(matches!(parsed, Parsed::Part { least, .. } if least > end && least <= whole));
        }
        let request =
            Request { posted: true, path: "/Evaluate".into(), body: "body".into(), stays: true };
        assert_eq!(gate(Some("key")).read(text.as_bytes()), Parsed::Whole(request, whole));
    }

    #[test]
    fn lengths_are_refused_before_anything_is_waited_for() {
        let with = |length: &str| {
            status(&gate(None), &format!("POST / HTTP/1.1\r\nHost: localhost\r\n{length}\r\n\r\n"))
        };
        for (length, expected) in [
            ("Content-Length: 1048576", 0),
            ("Content-Length: 1048577", 413),
            ("Content-Length: 100000000000000", 413),
            ("Content-Length: 99999999999999999999999999", 413),
            ("Content-Length: -1", 400),
            ("Content-Length: +1", 400),
            ("Content-Length: 1\r\nContent-Length: 2", 400),
            ("Transfer-Encoding: chunked", 400),
        ] {
            assert_eq!(with(length), expected, "{length}");
        }
        let long = format!("GET /{} HTTP/1.1\r\n", "x".repeat(LONGEST_HEAD));
        assert_eq!(status(&gate(None), &long), 413);
        let many = "A: b\r\n".repeat(HEADERS + 1);
        assert_eq!(status(&gate(None), &format!("GET / HTTP/1.1\r\n{many}\r\n")), 400);
    }

    #[test]
    fn names_pages_and_tokens_of_others_are_refused() {
        let with = |path: &str, headers: &str| {
            status(&gate(Some("key")), &format!("GET {path} HTTP/1.1\r\n{headers}\r\n\r\n"))
        };
        let own = "Host: 127.0.0.1:4242";
        for (path, headers, expected) in [
            ("/key/Info", own, 200),
            ("/key/Info", "Host: localhost:4242\r\nOrigin: http://localhost:4242", 200),
            ("/key/Info", "Host: [::1]:4242", 200),
            ("/key/Info", "Host: NODE7:4242", 200),
            ("/key/Info", "Host: evil.example:4242", 403),
            ("/key/Info", "Host: 127.0.0.1.evil.example", 403),
            ("/key/Info", "Host: 127.0.0.1:4242\r\nOrigin: http://evil.example", 403),
            ("/key/Info", "Host: 127.0.0.1:4242\r\nOrigin: null", 403),
            ("/key/Info", "Accept: */*", 400),
            ("/Info", own, 403),
            ("/ke/Info", own, 403),
            ("/keys/Info", own, 403),
        ] {
            assert_eq!(with(path, headers), expected, "{path} {headers}");
        }
    }
}
