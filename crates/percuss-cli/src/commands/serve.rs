//! `percuss serve`: a study as a model that other programs evaluate over HTTP, as UM-Bridge says.

mod protocol;

use std::io::Read;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::OnceLock;

use percuss_codes::{AnalysisCode, Code, FileCode};
use percuss_study::{Function, Study};
use tiny_http::{Header, Method, Request, Response, Server};

use self::protocol::{Answer, Kind, Model};
use crate::coupling_arguments::Serve;
use crate::outcome::{Failure, Status};
use crate::{scenario, terminal};

/// More than any request needs [bytes].
const LARGEST_REQUEST: u64 = 1 << 20;

/// Serves a study until it is interrupted.
pub fn run(arguments: &Serve) -> Result<Status, Failure> {
    let study = Study::load_with(&arguments.study, scenario::access())?;
    let function = study.function()?;
    let refused = |error: &dyn std::fmt::Display| {
        let text = format!(
            "cannot listen at {}:{}: {error}; is another server running there? `--port` takes another one, 0 any that is free",
            arguments.host, arguments.port
        );
        Failure::System(FileCode::System.into(), text)
    };
    let server =
        Server::http((arguments.host.as_str(), arguments.port)).map_err(|error| refused(&error))?;
    if !arguments.quiet {
        terminal::tell(&greeting(&server, &function));
    }
    let jobs = arguments.jobs.map_or_else(cores, |jobs| jobs as usize);
    let differentiable = OnceLock::new();
    std::thread::scope(|scope| {
        let work = || serve(&server, &study, &differentiable);
        let others: Vec<_> = (1..jobs).map(|_| scope.spawn(work)).collect();
        let mut done = work();
        for other in others {
            done = done.and(other.join().unwrap_or(Ok(())));
        }
        done
    })?;
    Ok(Status::Done)
}

fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// Where it listens, what it takes and what it gives.
fn greeting(server: &Server, function: &Function<'_>) -> String {
    let address = server.server_addr();
    let named = |(name, unit): (&str, &str)| match unit {
        "" | "1" => name.to_owned(),
        unit => format!("{name} [{unit}]"),
    };
    let list = |all: Vec<String>| all.join(", ");
    let inputs = function.parameters().iter().map(|p| named((p.name.as_str(), p.unit.as_str())));
    let results = function.results().iter().map(|r| named((r.name.as_str(), r.path.unit())));
    format!(
        "model `{}` at http://{address} (UM-Bridge {:.1})\n  in   {}\n  out  {}\nCtrl-C ends it",
        protocol::NAME,
        protocol::VERSION,
        list(inputs.collect()),
        list(results.collect())
    )
}

/// Answers requests one after the other.
fn serve(server: &Server, study: &Study, differentiable: &OnceLock<bool>) -> Result<(), Failure> {
    let function = study.function()?;
    let mut model = Model { function, differentiable };
    loop {
        let request = server.recv().map_err(|error| {
            Failure::System(FileCode::System.into(), format!("cannot take a request: {error}"))
        })?;
        answer(&mut model, request);
    }
}

/// Answers a request. One that goes away before its answer is no fault.
fn answer(model: &mut Model<'_>, mut request: Request) {
    let answer = match body(&mut request) {
        Err(refused) => refused,
        Ok(body) => {
            let posted = *request.method() == Method::Post;
            let path = request.url().to_owned();
            let work = || protocol::answer(model, posted, &path, &body);
            catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|_| {
                let text = Code::from(AnalysisCode::Broken).behind("the solver broke down");
                Answer::failure(Kind::Model, text)
            })
        }
    };
    let json = Header::from_bytes("Content-Type", "application/json");
    let mut response =
        Response::from_string(answer.body.to_string()).with_status_code(answer.status);
    if let Ok(header) = json {
        response.add_header(header);
    }
    let _ = request.respond(response);
}

/// What a request brings.
fn body(request: &mut Request) -> Result<String, Answer> {
    let mut text = String::new();
    let read = request.as_reader().take(LARGEST_REQUEST + 1).read_to_string(&mut text);
    match read {
        Ok(bytes) if bytes as u64 <= LARGEST_REQUEST => Ok(text),
        Ok(_) => Err(Answer::failure(Kind::Input, "a request of more than a megabyte".into())),
        Err(error) => {
            Err(Answer::failure(Kind::Input, format!("a request that cannot be read: {error}")))
        }
    }
}
