//! `percuss animate`.

use std::path::Path;

use percuss_codes::{FileCode, RequestCode};
use percuss_output::fields;
use percuss_pictures::{
    Error, Film, FilmOutcome, Format, Look, Plan, PrintFormat, animate, ffmpeg, is_ours, picture,
    unfinished,
};

use super::report::refuse_what_is_no_run;
use crate::interrupt;
use crate::modified_files;
use crate::number::{number, quantity};
use crate::outcome::{Failure, Status};
use crate::picture_arguments::Animate;
use crate::progress::Progress;
use crate::replacing;
use crate::terminal;

/// Share of the run for which a still shows an impulse, as the report does.
const FLASH: f64 = 0.02;
/// Delays below a fiftieth of a second are taken for a tenth by browsers.
const GIF_FPS: f64 = 50.0;
/// Pixels of a still's unit: pictures in pixels are as wide as asked for.
const SCREEN: f64 = 96.0;

/// Writes a film of a finished run, or a picture of an instant.
pub fn run(arguments: &Animate) -> Result<Status, Failure> {
    refuse_what_is_no_run(&arguments.dir)?;
    match arguments.still {
        Some(time) => still(arguments, time),
        None => film(arguments),
    }
}

fn film(arguments: &Animate) -> Result<Status, Failure> {
    let out = &arguments.out;
    let format = Format::of(out).ok_or_else(|| ending(out, ".gif, .apng or .mp4"))?;
    if format == Format::Mp4 && ffmpeg().is_none() {
        return Err(percuss_pictures::no_ffmpeg().into());
    }
    if format == Format::Gif && arguments.fps > GIF_FPS {
        return Err(Failure::input(
            RequestCode::PictureBounds,
            format!(
                "--fps {}: browsers play a GIF of more than {GIF_FPS} frames per second slowly; use {GIF_FPS} or less, or an .apng file",
                arguments.fps
            ),
        ));
    }
    refuse_foreign(out, arguments.force)?;
    let film = open(arguments)?;
    let span = span(arguments, &film)?;
    let seconds = arguments.duration.unwrap_or(film.seconds);
    let frames = ((seconds * arguments.fps).round() as usize).max(2);
    let plan = Plan { format, span, frames, fps: arguments.fps };
    interrupt::end_between_steps();
    interrupt::protect([&unfinished(out)]);
    let progress = Progress::of_frames(frames, !arguments.quiet);
    let may_go = |there: &Path| arguments.force || is_ours(there);
    let outcome = animate(&film, &plan, (out, &may_go), &mut |done| {
        progress.reach(done as u64);
        !interrupt::requested()
    });
    progress.clear();
    match outcome? {
        FilmOutcome::Stopped => {
            terminal::tell("interrupted; nothing is written");
            Ok(Status::Interrupted)
        }
        FilmOutcome::Done { kept } => {
            kept.iter().for_each(|kept| modified_files::tell(out, kept));
            if !arguments.quiet {
                let [width, height] = film.size;
                let what = format!(
                    "{}: {frames} frames of {width} x {height}, t = {} to {}, duration {}",
                    out.display(),
                    quantity(span[0], "s"),
                    quantity(span[1], "s"),
                    quantity(seconds, "s"),
                );
                terminal::tell(&what);
            }
            Ok(Status::Done)
        }
    }
}

fn still(arguments: &Animate, time: f64) -> Result<Status, Failure> {
    let out = &arguments.out;
    let format = still_format(out).ok_or_else(|| ending(out, ".svg, .pdf or .png"))?;
    refuse_foreign(out, arguments.force)?;
    let film = open(arguments)?;
    let [first, last] = film.whole;
    let time = within(time, film.whole).ok_or_else(|| outside("--still", time, film.whole))?;
    let svg = film.svg(time, FLASH * (last - first))?;
    let bytes = match format {
        // As the scripts wrote it, with text that can be edited.
        PrintFormat::Svg => percuss_pictures::marked(&svg).into_bytes(),
        PrintFormat::Pdf => picture(&svg, format, SCREEN)?,
        PrintFormat::Png => film.png(&svg)?,
    };
    replacing::put(out, &bytes, &|there| arguments.force || is_ours(there))?;
    if !arguments.quiet {
        terminal::tell(&format!("{}: the scene at t = {}", out.display(), quantity(time, "s")));
    }
    Ok(Status::Done)
}

fn still_format(out: &Path) -> Option<PrintFormat> {
    match out.extension()?.to_str()?.to_ascii_lowercase().as_str() {
        "svg" => Some(PrintFormat::Svg),
        "pdf" => Some(PrintFormat::Pdf),
        "png" => Some(PrintFormat::Png),
        _ => None,
    }
}

fn open(arguments: &Animate) -> Result<Film, Failure> {
    let dir = &arguments.dir;
    let fields = fields::read(dir)?.filter(|fields| !fields.frames.is_empty());
    let Some(fields) = fields else {
        return Err(Failure::input(
            FileCode::NoShapes,
            format!(
                "{}: the run has no recorded shapes (no fields/); run the scenario with record.shapes > 0",
                dir.display()
            ),
        ));
    };
    let look = Look {
        width: arguments.width,
        title: arguments.title.clone(),
        colour: arguments.colour.clone(),
        diagram: arguments.diagram.clone(),
        exaggeration: arguments.exaggeration,
        dark: arguments.dark,
    };
    let located = |error: Error| if error.is_input() { error.at(dir) } else { error };
    Ok(Film::open(&fields, &look).map_err(located)?)
}

fn span(arguments: &Animate, film: &Film) -> Result<[f64; 2], Failure> {
    if arguments.impact {
        return film.impact.ok_or_else(|| {
            let reason = "in this run nothing touches, or something does from its start to its end; omit --impact";
            Failure::input(RequestCode::Instant, format!("{}: {reason}", arguments.dir.display()))
        });
    }
    let [first, last] = film.whole;
    let given = |option: &str, time: f64| {
        within(time, film.whole).ok_or_else(|| outside(option, time, film.whole))
    };
    let from = given("--from", arguments.from.unwrap_or(first))?;
    let to = given("--to", arguments.to.unwrap_or(last))?;
    if from >= to {
        return Err(Failure::input(
            RequestCode::Instant,
            format!("--from {} s is not before --to {} s", number(from), number(to)),
        ));
    }
    Ok([from, to])
}

/// A time within those of the frames; the sum of so many steps may be a unit in the last place beside the end.
fn within(time: f64, [first, last]: [f64; 2]) -> Option<f64> {
    let near = 1e-9 * (last - first);
    (first - near..=last + near).contains(&time).then_some(time.clamp(first, last))
}

fn outside(option: &str, time: f64, [first, last]: [f64; 2]) -> Failure {
    Failure::input(
        RequestCode::Instant,
        format!(
            "{option} {} s: the run has shapes from {} s to {} s",
            number(time),
            number(first),
            number(last)
        ),
    )
}

fn ending(out: &Path, endings: &str) -> Failure {
    Failure::input(
        RequestCode::FileName,
        format!("{}: expected a name that ends with {endings}", out.display()),
    )
}

/// A file that percuss did not write stays as it is.
pub fn refuse_foreign(out: &Path, force: bool) -> Result<(), Failure> {
    if out.is_dir() {
        let text = format!("{}: is a directory; expected a file", out.display());
        return Err(Failure::input(RequestCode::FileName, text));
    }
    if force || !out.exists() || is_ours(out) {
        return Ok(());
    }
    Err(Failure::input(
        FileCode::Foreign,
        format!(
            "{}: exists and was not written by percuss; choose another name or use --force",
            out.display()
        ),
    ))
}
