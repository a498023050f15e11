//! Films: frames of a scene in a file.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;
use std::rc::Rc;
use std::sync::Mutex;
use std::sync::mpsc::{Receiver, Sender, channel, sync_channel};
use std::thread;

use percuss_output::Unfinished;

use crate::apng::Apng;
use crate::error::Error;
use crate::ffmpeg::{ffmpeg, no_ffmpeg};
use crate::film::Film;
use crate::gif::{Gif, Palette};
use crate::mp4::Mp4;
use crate::pixels::Pixels;
use crate::request::{FilmOutcome, Format, Plan};

/// Frames from which the colours of a GIF are chosen.
const PALETTE_FRAMES: usize = 12;
/// Impulses are shown for this share of the film's time.
const FLASH: f64 = 0.02;

/// Makes a film; `go_on` receives the number of completed frames and returns whether to continue. The file appears when it is complete: until then
/// it has the name of [`unfinished()`](crate::unfinished). It replaces a file for which `may_go` is true; another file that was created there
/// meanwhile is moved to a name beside it.
///
/// # Errors
/// If ffmpeg is needed and missing, the scene cannot be drawn, or an I/O error occurs.
pub fn animate(
    film: &Film,
    plan: &Plan,
    (out, may_go): (&Path, &dyn Fn(&Path) -> bool),
    go_on: &mut dyn FnMut(usize) -> bool,
) -> Result<FilmOutcome, Error> {
    let unfinished = Unfinished::of(out)?;
    Ok(match record(film, plan, &unfinished, go_on)? {
        true => FilmOutcome::Done { kept: unfinished.put(may_go)? },
        false => FilmOutcome::Stopped,
    })
}

/// Whether the film is complete.
fn record(
    film: &Film,
    plan: &Plan,
    unfinished: &Unfinished,
    go_on: &mut dyn FnMut(usize) -> bool,
) -> Result<bool, Error> {
    let file = unfinished.path();
    let (times, flash) = (plan.times(), FLASH * (plan.span[1] - plan.span[0]));
    let mut recorder = match plan.format {
        Format::Mp4 => {
            let program = ffmpeg().ok_or_else(no_ffmpeg)?;
            Recorder::Mp4(Mp4::new(&program, unfinished, film.size, plan.fps)?)
        }
        Format::Apng => {
            let sink = Sink::new(unfinished)?;
            Recorder::Apng(Apng::new(sink.clone(), film.size, times.len(), plan.fps)?, sink)
        }
        Format::Gif => {
            let sink = Sink::new(unfinished)?;
            let stride = times.len().div_ceil(PALETTE_FRAMES);
            let some: Vec<f64> = times.iter().copied().step_by(stride).collect();
            let mut frames = Vec::new();
            let whole = render(film, &some, flash, &mut |pixels| {
                frames.push(pixels);
                Ok(go_on(0))
            })?;
            if !whole {
                return Ok(false);
            }
            let lasts = (times.len(), 1.0 / plan.fps);
            Recorder::Gif(Gif::new(sink.clone(), film.size, Palette::of(&frames), lasts)?, sink)
        }
    };
    let mut done = 0;
    let whole = render(film, &times, flash, &mut |pixels| {
        recorder.push(pixels)?;
        done += 1;
        Ok(go_on(done))
    })?;
    if whole {
        recorder.finish().map_err(|e| if e.is_input() { e } else { e.at(file) })?;
    }
    Ok(whole)
}

enum Recorder {
    Gif(Gif<Sink>, Sink),
    Apng(Apng<Sink>, Sink),
    Mp4(Mp4),
}

impl Recorder {
    fn push(&mut self, pixels: Pixels) -> Result<(), Error> {
        match self {
            Self::Gif(gif, _) => gif.push(&pixels),
            Self::Apng(apng, _) => apng.push(pixels),
            Self::Mp4(mp4) => mp4.push(&pixels),
        }
    }

    fn finish(self) -> Result<(), Error> {
        let flush = |mut sink: Sink| sink.flush().map_err(Error::drawing);
        match self {
            Self::Gif(gif, sink) => gif.finish().and_then(|()| flush(sink)),
            Self::Apng(apng, sink) => apng.finish().and_then(|()| flush(sink)),
            Self::Mp4(mp4) => mp4.finish(),
        }
    }
}

/// A file that is flushed, with its error reported, after its encoder is dropped.
#[derive(Clone)]
struct Sink(Rc<RefCell<BufWriter<File>>>);

impl Sink {
    fn new(unfinished: &Unfinished) -> Result<Self, Error> {
        let file = unfinished.file().map_err(|e| Error::io(unfinished.path(), "write", &e))?;
        Ok(Self(Rc::new(RefCell::new(BufWriter::new(file)))))
    }
}

impl Write for Sink {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.borrow_mut().write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.borrow_mut().flush()
    }
}

/// Draws the scene at the given times: as SVG in this thread, as pixels in other threads, which are passed on in their order. Returns whether all
/// frames were used.
fn render(
    film: &Film,
    times: &[f64],
    flash: f64,
    take: &mut dyn FnMut(Pixels) -> Result<bool, Error>,
) -> Result<bool, Error> {
    let workers = thread::available_parallelism().map_or(1, usize::from).min(8);
    thread::scope(|scope| {
        let (jobs, queue) = sync_channel::<(usize, String)>(workers);
        let queue = std::sync::Arc::new(Mutex::new(queue));
        let (finished, results) = channel();
        // They end when `jobs` is dropped, on any return.
        let jobs = jobs;
        let size = film.size;
        let start = |_| {
            let (queue, finished) = (std::sync::Arc::clone(&queue), finished.clone());
            let work = move || rasterise(&queue, &finished, size);
            thread::Builder::new().spawn_scoped(scope, work).ok()
        };
        let started = (0..workers).map_while(start).count();
        drop((queue, finished));
        let mut waiting = BTreeMap::new();
        let mut next = 0;
        let mut hand_over = |result: (usize, Result<Pixels, Error>)| -> Result<bool, Error> {
            waiting.insert(result.0, result.1);
            while let Some(pixels) = waiting.remove(&next) {
                next += 1;
                if !take(pixels?)? {
                    return Ok(false);
                }
            }
            Ok(true)
        };
        for (k, time) in times.iter().enumerate() {
            let svg = film.svg(*time, flash)?;
            if started == 0 {
                // No other thread can be started: this thread draws the pixels.
                if !hand_over((k, Pixels::of_svg(&svg, size)))? {
                    return Ok(false);
                }
            } else if jobs.send((k, svg)).is_err() {
                return Err(Error::drawing("a thread ended"));
            }
            while let Ok(result) = results.try_recv() {
                if !hand_over(result)? {
                    return Ok(false);
                }
            }
        }
        drop(jobs);
        for result in results {
            if !hand_over(result)? {
                return Ok(false);
            }
        }
        Ok(true)
    })
}

type Jobs = Mutex<Receiver<(usize, String)>>;

fn rasterise(queue: &Jobs, finished: &Sender<(usize, Result<Pixels, Error>)>, size: [u32; 2]) {
    let next = || queue.lock().ok()?.recv().ok();
    while let Some((k, svg)) = next() {
        if finished.send((k, Pixels::of_svg(&svg, size))).is_err() {
            return;
        }
    }
}
