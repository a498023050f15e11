//! All connections of the server, looked after by one thread: whoever is slow waits for himself alone.
//!
//! A connection may hold one request of limited length, has a limited time to send it and to take the answer, and there are so many of
//! them at most: then the one that has been sending for the longest time makes room.

use std::collections::{BTreeMap, VecDeque};
use std::io::{self, ErrorKind, Read, Write};
use std::net::Shutdown;
use std::sync::mpsc::{Receiver, Sender};
use std::time::{Duration, Instant};

use mio::net::{TcpListener, TcpStream};
use mio::{Events, Interest, Poll, Token};

use super::protocol::Answer;
use super::request::{Gate, LONGEST_BODY, Parsed, Request, written};

/// Connections at a time.
const MOST: usize = 256;
/// Time in which a request has to come whole, and in which its answer has to be taken.
const PATIENCE: Duration = Duration::from_secs(10);
/// Time for which what a refused request still sends is thrown away, so that its sender reads the answer.
const AFTERWARDS: Duration = Duration::from_secs(1);
/// Times are looked at this often.
const TICK: Duration = Duration::from_millis(200);
/// Bytes read at a time.
const CHUNK: usize = 16 << 10;

const LISTENER: Token = Token(usize::MAX);
/// Wakes the loop where an answer is ready.
pub const ANSWERED: Token = Token(usize::MAX - 1);

/// What is being done with a connection.
enum State {
    /// A request comes; it takes this many bytes or more.
    Reading { least: usize },
    /// It is being answered.
    Answering { stays: bool },
    /// The answer goes; whether the connection stays open, whether more is sent than was read.
    Writing { stays: bool, more_comes: bool },
    /// The answer has gone; what still comes, so many bytes at most, is thrown away.
    Ending { left: usize },
}

struct Connection {
    stream: TcpStream,
    state: State,
    /// What has come and is not answered yet, shape (bytes) \[-\].
    input: Vec<u8>,
    /// What is answered and not sent yet, shape (bytes) \[-\].
    output: VecDeque<u8>,
    /// When what is being done has to be over; an answer takes as long as it takes.
    until: Option<Instant>,
}

/// A request to be answered, and the number of its connection.
pub type Asked = (usize, Request);
/// An answer, and the number of its connection.
pub type NumberedAnswer = (usize, Answer);

/// The connections.
pub struct Connections {
    poll: Poll,
    listener: TcpListener,
    gate: Gate,
    all: BTreeMap<usize, Connection>,
    next: usize,
    asked: Sender<Asked>,
    answers: Receiver<NumberedAnswer>,
}

impl Connections {
    /// Connections that come to a listener; requests go to `asked`, answers come from `answers`.
    ///
    /// # Errors
    /// If the listener cannot be looked after.
    pub fn new(
        poll: Poll,
        mut listener: TcpListener,
        gate: Gate,
        asked: Sender<Asked>,
        answers: Receiver<NumberedAnswer>,
    ) -> io::Result<Self> {
        poll.registry().register(&mut listener, LISTENER, Interest::READABLE)?;
        Ok(Self { poll, listener, gate, all: BTreeMap::new(), next: 0, asked, answers })
    }

    /// Looks after them for ever.
    ///
    /// # Errors
    /// If the system does not tell what comes any more.
    pub fn serve(&mut self) -> io::Result<()> {
        let mut events = Events::with_capacity(MOST);
        loop {
            let tick = (!self.all.is_empty()).then_some(TICK);
            match self.poll.poll(&mut events, tick) {
                Err(error) if error.kind() == ErrorKind::Interrupted => continue,
                done => done?,
            }
            let others = events.iter().map(|event| event.token());
            others.filter(|one| *one != LISTENER && *one != ANSWERED).for_each(|one| {
                self.go_on(one.0);
            });
            self.accept();
            self.answer();
            self.end_slow();
        }
    }

    fn accept(&mut self) {
        // An error is that of one connection, or is looked at again when time has passed.
        while let Ok((mut stream, _)) = self.listener.accept() {
            if self.all.len() >= MOST && !self.make_room() {
                continue;
            }
            let number = self.next;
            self.next += 1;
            let both = Interest::READABLE | Interest::WRITABLE;
            if self.poll.registry().register(&mut stream, Token(number), both).is_err() {
                continue;
            }
            let until = Some(Instant::now() + PATIENCE);
            let state = State::Reading { least: 1 };
            let (input, output) = (Vec::new(), VecDeque::new());
            self.all.insert(number, Connection { stream, state, input, output, until });
        }
    }

    /// Closes the connection that has been sending or taking for the longest time; none where all wait for answers.
    fn make_room(&mut self) -> bool {
        let oldest = self.all.iter().filter_map(|(k, one)| Some((one.until?, *k))).min();
        oldest.is_some_and(|(_, number)| self.close(number))
    }

    fn close(&mut self, number: usize) -> bool {
        let Some(mut one) = self.all.remove(&number) else { return false };
        let _ = self.poll.registry().deregister(&mut one.stream);
        true
    }

    fn end_slow(&mut self) {
        let now = Instant::now();
        let late = |one: &Connection| one.until.is_some_and(|until| until <= now);
        let late: Vec<usize> =
            self.all.iter().filter(|(_, one)| late(one)).map(|(k, _)| *k).collect();
        late.into_iter().for_each(|number| {
            self.close(number);
        });
    }

    /// Sends answers on their way. A connection that has gone meanwhile is no fault.
    fn answer(&mut self) {
        while let Ok((number, answer)) = self.answers.try_recv() {
            if let Some(one) = self.all.get_mut(&number)
                && let State::Answering { stays } = one.state
            {
                one.write(&answer, (stays, false));
                self.go_on(number);
            }
        }
    }

    fn go_on(&mut self, number: usize) {
        let Some(one) = self.all.get_mut(&number) else { return };
        let asked = &self.asked;
        let ask = |request| asked.send((number, request)).is_ok();
        if !one.go_on(&self.gate, ask) {
            self.close(number);
        }
    }
}

impl Connection {
    fn write(&mut self, answer: &Answer, (stays, more_comes): (bool, bool)) {
        self.output.extend(written(answer, stays));
        self.state = State::Writing { stays, more_comes };
        self.until = Some(Instant::now() + PATIENCE);
    }

    /// Does what can be done now; whether the connection stays.
    fn go_on(&mut self, gate: &Gate, ask: impl Fn(Request) -> bool) -> bool {
        loop {
            let goes_on = match self.state {
                State::Reading { least } => self.read(gate, least, &ask),
                // What comes meanwhile is read when the answer has gone.
                State::Answering { .. } => return true,
                State::Writing { stays, more_comes } => self.sent((stays, more_comes)),
                State::Ending { left } => self.throw_away(left),
            };
            match goes_on {
                Ok(true) => {}
                Ok(false) => return true,
                Err(_) => return false,
            }
        }
    }

    /// Reads until a request is whole. Whether more can be done now; an error ends the connection.
    fn read(
        &mut self,
        gate: &Gate,
        least: usize,
        ask: &impl Fn(Request) -> bool,
    ) -> io::Result<bool> {
        self.send()?;
        while self.input.len() < least {
            if !self.receive()? {
                return Ok(false);
            }
        }
        match gate.read(&self.input) {
            Parsed::Part { least, waits } => {
                if waits {
                    self.output.extend(b"HTTP/1.1 100 Continue\r\n\r\n");
                }
                self.state = State::Reading { least };
            }
            Parsed::Whole(request, length) => {
                self.input.drain(..length);
                self.input.shrink_to(CHUNK);
                (self.state, self.until) = (State::Answering { stays: request.stays }, None);
                if !ask(request) {
                    return Err(ErrorKind::BrokenPipe.into());
                }
            }
            Parsed::Refused(answer) => self.write(&answer, (false, true)),
        }
        Ok(true)
    }

    /// More input; false where nothing is there now.
    fn receive(&mut self) -> io::Result<bool> {
        let mut chunk = [0; CHUNK];
        match self.stream.read(&mut chunk) {
            Ok(0) => Err(ErrorKind::UnexpectedEof.into()),
            Ok(bytes) => {
                self.input.extend_from_slice(&chunk[..bytes]);
                Ok(true)
            }
            Err(error) if error.kind() == ErrorKind::Interrupted => Ok(true),
            Err(error) if error.kind() == ErrorKind::WouldBlock => Ok(false),
            Err(error) => Err(error),
        }
    }

    /// Sends what can be sent now.
    fn send(&mut self) -> io::Result<()> {
        while !self.output.is_empty() {
            match self.stream.write(self.output.as_slices().0) {
                Ok(bytes) => drop(self.output.drain(..bytes)),
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                Err(error) if error.kind() == ErrorKind::WouldBlock => break,
                Err(error) => return Err(error),
            }
        }
        Ok(())
    }

    /// Sends the answer; when it has gone the next request may come, or the connection ends.
    fn sent(&mut self, (stays, more_comes): (bool, bool)) -> io::Result<bool> {
        self.send()?;
        if !self.output.is_empty() {
            return Ok(false);
        }
        if stays {
            self.state = State::Reading { least: self.input.len().max(1) };
            self.until = Some(Instant::now() + PATIENCE);
            return Ok(true);
        }
        self.stream.shutdown(Shutdown::Write)?;
        if !more_comes {
            return Err(ErrorKind::ConnectionAborted.into());
        }
        self.state = State::Ending { left: 2 * LONGEST_BODY };
        self.until = Some(Instant::now() + AFTERWARDS);
        Ok(true)
    }

    fn throw_away(&mut self, left: usize) -> io::Result<bool> {
        self.input.clear();
        let more = self.receive()?;
        let left = left.checked_sub(self.input.len()).ok_or(ErrorKind::ConnectionAborted)?;
        self.state = State::Ending { left };
        Ok(more)
    }
}
