//! `percuss serve`: a study as a model that other programs evaluate over HTTP, as UM-Bridge says.

mod connections;
mod protocol;
mod request;

use std::net::{SocketAddr, TcpListener, ToSocketAddrs};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Mutex, OnceLock, PoisonError};
use std::thread;

use mio::{Poll, Waker};
use percuss_codes::{AnalysisCode, Code, FileCode, RequestCode};
use percuss_study::{Function, Study};

use self::connections::{ANSWERED, Asked, Connections, NumberedAnswer};
use self::protocol::{Answer, Kind, Model};
use self::request::{Gate, Request};
use crate::coupling_arguments::Serve;
use crate::outcome::{Failure, Status};
use crate::{scenario, terminal};

/// Serves a study until it is interrupted.
pub fn run(arguments: &Serve) -> Result<Status, Failure> {
    let study = Study::load_with(&arguments.study, scenario::access())?;
    let function = study.function()?;
    let token = token(arguments)?;
    let (listener, address) = listen(arguments)?;
    if !arguments.quiet {
        terminal::tell(&greeting(address, token.as_deref(), &function));
    }
    let hosts = arguments.allow_host.iter().cloned().chain([arguments.host.clone()]).collect();
    let jobs = arguments.jobs.map_or_else(cores, |jobs| jobs as usize);
    let differentiable = OnceLock::new();
    let (poll, (asked, to_do), (tell, answers)) = (Poll::new(), channel(), channel());
    let poll = poll.map_err(broken)?;
    let waker = Waker::new(poll.registry(), ANSWERED).map_err(broken)?;
    let listener = mio::net::TcpListener::from_std(listener);
    let gate = Gate { hosts, token };
    let mut all = Connections::new(poll, listener, gate, asked, answers).map_err(broken)?;
    let to_do = Mutex::new(to_do);
    thread::scope(|scope| {
        for job in 0..jobs {
            let (tell, to_do, waker) = (tell.clone(), &to_do, &waker);
            let (study, differentiable) = (&study, &differentiable);
            let work = move || answer_all(to_do, &tell, waker, (study, differentiable));
            match thread::Builder::new().spawn_scoped(scope, work) {
                Ok(_) => {}
                // Fewer answer then; without any nothing is answered.
                Err(error) if job == 0 => return Err(broken(error)),
                Err(_) => break,
            }
        }
        let done = all.serve().map_err(broken);
        drop(all); // the threads end when nobody asks any more
        done
    })?;
    Ok(Status::Done)
}

fn broken(error: std::io::Error) -> Failure {
    Failure::System(FileCode::System.into(), format!("cannot take requests: {error}"))
}

/// The token that requests have to know: a new one each time unless the user gives one, or wants none.
fn token(arguments: &Serve) -> Result<Option<String>, Failure> {
    if arguments.no_token {
        return Ok(None);
    }
    if let Some(token) = &arguments.token {
        let plain = token.bytes().all(|b| b.is_ascii_alphanumeric() || b"-_.~".contains(&b));
        return match plain && !token.is_empty() {
            true => Ok(Some(token.clone())),
            false => {
                let text = "--token: expected letters, digits and -_.~";
                Err(Failure::input(RequestCode::NoValue, text))
            }
        };
    }
    if arguments.quiet {
        let text = "--quiet hides the token; use --token or --no-token";
        return Err(Failure::input(RequestCode::NoValue, text));
    }
    let mut bytes = [0; 16];
    getrandom::fill(&mut bytes).map_err(|error| broken(error.into()))?;
    Ok(Some(bytes.iter().map(|b| format!("{b:02x}")).collect()))
}

fn listen(arguments: &Serve) -> Result<(TcpListener, SocketAddr), Failure> {
    let (host, port) = (arguments.host.as_str(), arguments.port);
    let refused = |error: std::io::Error| {
        let text = format!(
            "cannot listen at {host}:{port}: {error}; is another server running there? `--port` takes another one, 0 any that is free"
        );
        Failure::System(FileCode::System.into(), text)
    };
    let addresses: Vec<SocketAddr> = (host, port).to_socket_addrs().map_err(refused)?.collect();
    let listener = TcpListener::bind(addresses.as_slice()).map_err(refused)?;
    listener.set_nonblocking(true).map_err(refused)?;
    let address = listener.local_addr().map_err(refused)?;
    Ok((listener, address))
}

fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// Where it listens, what it takes and what it gives.
fn greeting(address: SocketAddr, token: Option<&str>, function: &Function<'_>) -> String {
    let token = token.map_or(String::new(), |token| format!("/{token}"));
    let named = |(name, unit): (&str, &str)| match unit {
        "" | "1" => name.to_owned(),
        unit => format!("{name} [{unit}]"),
    };
    let list = |all: Vec<String>| all.join(", ");
    let inputs = function.parameters().iter().map(|p| named((p.name.as_str(), p.unit.as_str())));
    let results = function.results().iter().map(|r| named((r.name.as_str(), r.path.unit())));
    format!(
        "model `{}` at http://{address}{token} (UM-Bridge {:.1})\n  in   {}\n  out  {}\nCtrl-C ends it",
        protocol::NAME,
        protocol::VERSION,
        list(inputs.collect()),
        list(results.collect())
    )
}

/// Answers requests one after the other, as they come.
fn answer_all(
    to_do: &Mutex<Receiver<Asked>>,
    tell: &Sender<NumberedAnswer>,
    waker: &Waker,
    (study, differentiable): (&Study, &OnceLock<bool>),
) {
    // That it can be had was tried before.
    let Ok(function) = study.function() else { return };
    let mut model = Model { function, differentiable };
    loop {
        let next = to_do.lock().unwrap_or_else(PoisonError::into_inner).recv();
        let Ok((number, request)) = next else { return };
        if tell.send((number, answer(&mut model, &request))).is_err() {
            return;
        }
        let _ = waker.wake();
    }
}

fn answer(model: &mut Model<'_>, request: &Request) -> Answer {
    let work = || protocol::answer(model, request.posted, &request.path, &request.body);
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|_| {
        let text = Code::from(AnalysisCode::Broken).behind("internal error in the solver");
        Answer::failure(Kind::Model, text)
    })
}
