//! Progress of a run on the terminal.

use std::fmt::Write;
use std::io::{self, IsTerminal};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use percuss::{Flow, Settings};
use percuss_scenario::visible_line;

use crate::{interrupt, terminal};

/// The clock is looked at about this often.
const LOOK: Duration = Duration::from_millis(50);
/// Shorter runs show nothing.
const PATIENCE: Duration = Duration::from_millis(200);
/// Ticks of a bar that goes by time.
const TICKS: f64 = 1000.0;
/// Draws a second.
const HERTZ: u8 = 10;

/// A progress bar on standard error, if that is a terminal.
///
/// The clock is read every so many steps, a number that follows the speed of the run, so that a step
/// costs one comparison.
#[derive(Debug)]
pub struct Progress {
    bar: Option<ProgressBar>,
    /// End of a run whose number of steps is not known \[s\].
    end: Option<f64>,
    begun: Instant,
    looked: Instant,
    steps: u64,
    next: u64,
    stride: u64,
}

impl Progress {
    /// A bar for a run under the given settings.
    pub fn of_settings(name: String, settings: &Settings, wanted: bool) -> Self {
        match settings.accuracy {
            Some(_) => Self::of_time(name, settings.end, wanted),
            None => Self::of_run(name, settings.step_count(), settings.end, wanted),
        }
    }

    /// A bar for a run of so many steps that ends at `end` \[s\].
    pub fn of_run(name: String, steps: usize, end: f64, wanted: bool) -> Self {
        let template =
            "{prefix} [{bar:24}] {percent:>3} %  t = {time} s  {rate} steps/s  {eta} left";
        let time = move |state: &ProgressState, out: &mut dyn Write| {
            let _ = write!(out, "{:.4}", f64::from(state.fraction()) * end);
        };
        let rate = |state: &ProgressState, out: &mut dyn Write| {
            let _ = write!(out, "{:.0}", state.per_sec());
        };
        let style = style_of(template).with_key("time", time).with_key("rate", rate);
        Self::new(name, steps, wanted, style)
    }

    /// A bar for so many things done one after the other.
    pub fn of_things(name: &str, things: usize) -> Self {
        Self::new(name.into(), things, true, style_of("{prefix} [{bar:24}] {pos}/{len}  {msg}"))
    }

    /// A bar for so many frames of a film.
    pub fn of_frames(frames: usize, wanted: bool) -> Self {
        let template = "film [{bar:24}] {percent:>3} %  {pos}/{len} frames  {eta} left";
        Self::new(String::new(), frames, wanted, style_of(template))
    }

    /// A bar for so many runs, of which `before` were done earlier.
    pub fn of_runs(runs: u64, before: u64, wanted: bool) -> Self {
        let template =
            "sweep [{bar:24}] {percent:>3} %  {pos}/{len} runs  {rate} runs/s  {eta} left";
        let rate = |state: &ProgressState, out: &mut dyn Write| {
            let _ = write!(out, "{:.0}", state.per_sec());
        };
        let length = usize::try_from(runs).unwrap_or(usize::MAX);
        let progress =
            Self::new(String::new(), length, wanted, style_of(template).with_key("rate", rate));
        if let Some(bar) = &progress.bar {
            bar.set_position(before);
            bar.reset_eta();
        }
        progress
    }

    /// So many things are done.
    pub fn reach(&self, done: u64) {
        if let Some(bar) = &self.bar
            && self.begun.elapsed() > PATIENCE
        {
            bar.set_position(done);
        }
    }

    /// So many things are to be done in all.
    pub fn expect(&self, things: u64) {
        if let Some(bar) = &self.bar {
            bar.set_length(things);
        }
    }

    fn new(name: String, length: usize, wanted: bool, style: ProgressStyle) -> Self {
        let now = Instant::now();
        let bar = (wanted && io::stderr().is_terminal()).then(|| {
            let target = ProgressDrawTarget::stderr_with_hz(HERTZ);
            ProgressBar::with_draw_target(u64::try_from(length).ok(), target)
                .with_style(style)
                .with_prefix(visible_line(&name))
        });
        Self { bar, end: None, begun: now, looked: now, steps: 0, next: 1, stride: 1 }
    }

    /// A bar for a run whose steps are chosen as it goes, up to `end` \[s\].
    pub fn of_time(name: String, end: f64, wanted: bool) -> Self {
        let template = "{prefix} [{bar:24}] {percent:>3} %  t = {time} s  {eta} left";
        let time = move |state: &ProgressState, out: &mut dyn Write| {
            let _ = write!(out, "{:.4}", f64::from(state.fraction()) * end);
        };
        let style = style_of(template).with_key("time", time);
        let mut progress = Self::new(name, TICKS as usize, wanted, style);
        progress.end = Some(end);
        progress
    }

    /// One step done, up to `time` \[s\]; whether to go on.
    pub fn step(&mut self, time: f64) -> Flow {
        self.steps += 1;
        if self.steps >= self.next {
            self.look(time);
        }
        if interrupt::requested() { Flow::Stop } else { Flow::Continue }
    }

    fn look(&mut self, time: f64) {
        let elapsed = self.looked.elapsed();
        if elapsed < LOOK / 2 {
            self.stride = (2 * self.stride).min(1 << 20);
        } else if elapsed > 2 * LOOK {
            let share = LOOK.as_secs_f64() / elapsed.as_secs_f64();
            self.stride = ((self.stride as f64 * share) as u64).max(1);
        }
        self.looked = Instant::now();
        self.next = self.steps + self.stride;
        if let Some(bar) = &self.bar
            && self.begun.elapsed() > PATIENCE
        {
            bar.set_position(self.end.map_or(self.steps, |end| (TICKS * time / end) as u64));
        }
    }

    /// So many steps were done by an earlier process.
    pub fn begin_at(&mut self, steps: usize) {
        self.steps = steps as u64;
        self.next = self.steps + 1;
        if let Some(bar) = self.bar.as_ref().filter(|_| self.end.is_none()) {
            bar.set_position(self.steps);
            bar.reset_eta();
        }
    }

    /// Shows what is being done now, `done` things being done.
    pub fn show(&self, message: &str, done: usize) {
        if let Some(bar) = &self.bar {
            bar.set_message(visible_line(message));
            bar.set_position(done as u64);
            bar.tick();
        }
    }

    /// Says something above the bar.
    pub fn tell(&self, text: &str) {
        match &self.bar {
            Some(bar) => bar.suspend(|| terminal::tell(text)),
            None => terminal::tell(text),
        }
    }

    /// Takes the bar away.
    pub fn clear(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.clear();
    }
}

fn style_of(template: &str) -> ProgressStyle {
    let style = ProgressStyle::with_template(template);
    style.unwrap_or_else(|_| ProgressStyle::default_bar()).progress_chars("=> ")
}
