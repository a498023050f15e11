//! How long a first contact is expected to last: by modes or waves where these agree with a short trial of the model, else by the trial.

use std::cell::{Cell, RefCell};

use super::case::{Case, Meeting, rigid_impact};
use super::duration::{From, Lasting};
use percuss::Model;
use percuss::Settings;
use percuss::{Preview, preview};

/// Elements times iterations of all trials of a model together: some tenths of a second.
const EFFORT: usize = 150_000;
/// Steps of a contact that a trial aims at, those that it makes do with, and those without which it is made again.
const STEPS: f64 = 40.0;
const FEWER: f64 = 15.0;
const LEAST: f64 = 12.0;
/// Trials of one contact.
const TRIES: usize = 3;
/// Iterations of a step in the estimate of what a trial takes.
const ITERATIONS: f64 = 3.0;
/// A trial that differs from the modes by less than this share confirms them; beyond the second they say nothing of this contact.
const SAME: f64 = 0.1;
const ALIKE: f64 = 0.5;

/// Trials of a model, made when they are asked for.
pub struct Trials<'m> {
    model: &'m Model,
    settings: &'m Settings,
    left: Cell<usize>,
    /// Previews of runs made so far, shape (trials).
    made: RefCell<Vec<Preview>>,
}

/// How long the first contact lasts.
#[derive(Clone, Debug, PartialEq)]
pub enum Stays {
    /// About so long \[s\].
    About(f64),
    /// Longer than this \[s\]: a trial ended in it.
    AtLeast(f64),
    /// It does not begin before the end of the run.
    Untouched,
    /// Not known, and why.
    Unknown(String),
}

/// What is expected of a first contact.
pub struct Expected<'a> {
    pub stays: Stays,
    /// The estimate by modes, waves or bodies, where it holds for this contact.
    pub lasting: Option<&'a Lasting>,
    /// What the modes of the structure say where the trial says something else \[s\].
    pub otherwise: Option<f64>,
    /// When a trial of the model saw it begin, if it did \[s\].
    pub begins: Option<f64>,
}

impl Expected<'_> {
    /// The duration that other findings reckon with \[s\].
    pub fn duration(&self) -> Option<f64> {
        match &self.stays {
            Stays::About(duration) | Stays::AtLeast(duration) => Some(*duration),
            Stays::Untouched | Stays::Unknown(_) => None,
        }
    }
}

impl<'m> Trials<'m> {
    pub fn new(model: &'m Model, settings: &'m Settings) -> Self {
        let (left, made) = (Cell::new(EFFORT), RefCell::new(Vec::new()));
        Self { model, settings, left, made }
    }

    /// What is expected of the first contact of a case under a smooth law; none under another one. `certain` says whether the estimate
    /// holds without a trial, else why not.
    pub fn expected<'a>(
        &self,
        case: &Case<'_>,
        lasting: Option<&'a Lasting>,
        certain: Result<(), String>,
    ) -> Option<Expected<'a>> {
        if case.law.is_rigid() {
            return None;
        }
        let guess = lasting.map(|lasting| lasting.duration);
        let trial = self.trial(case, guess);
        let begins = trial.as_ref().and_then(|(_, begins)| *begins);
        let found = match (trial.map(|(stays, _)| stays), guess) {
            // A trial that ended too early says less than an estimate that holds.
            (Some(Stays::AtLeast(time)), Some(guess))
                if certain.is_ok() && time < guess && guess < self.settings.end =>
            {
                Stays::About(guess)
            }
            // A run that ends before it is longer another time.
            (Some(Stays::Untouched), Some(guess)) if certain.is_ok() => Stays::About(guess),
            (Some(found), _) => found,
            (None, _) => {
                let stays = match (guess, certain) {
                    (Some(duration), Ok(())) => Stays::About(duration),
                    (_, Err(why)) => Stays::Unknown(why),
                    (None, Ok(())) => return None,
                };
                let lasting = lasting.filter(|_| matches!(stays, Stays::About(_)));
                return Some(Expected { stays, lasting, otherwise: None, begins });
            }
        };
        let (&Stays::About(time), Some(guess)) = (&found, guess) else {
            return Some(Expected { stays: found, lasting: None, otherwise: None, begins });
        };
        let off = (guess / time).max(time / guess) - 1.0;
        let stays = Stays::About(if off < SAME { guess } else { time });
        let by_modes = lasting.is_some_and(|lasting| lasting.from == From::Modes);
        Some(Expected {
            stays,
            lasting: lasting.filter(|_| off < ALIKE),
            otherwise: (by_modes && off >= SAME).then_some(guess),
            begins,
        })
    }

    /// What a trial shows of a contact, and when it begins \[s\], if it is worth its time.
    fn trial(&self, case: &Case<'_>, guess: Option<f64>) -> Option<(Stays, Option<f64>)> {
        let mut guess = guess.or_else(|| alone(case)).unwrap_or(STEPS * self.settings.step);
        let mut found = None;
        for _ in 0..TRIES {
            let step = self.step(case, guess)?;
            let made = self.made(case.index, step)?;
            let first = made.first[case.index];
            found = match first {
                Some([start, end]) if end.is_finite() => {
                    let steps = (end - start) / made.step;
                    guess = end - start;
                    if steps < LEAST {
                        found = None;
                        continue;
                    }
                    Some((Stays::About(end - start), Some(start)))
                }
                Some([start, _]) => Some((Stays::AtLeast(made.time - start), Some(start))),
                None if made.time >= self.settings.end => Some((Stays::Untouched, None)),
                None => None,
            };
            break;
        }
        found
    }

    /// The step of a trial: that of the run if it resolves the contact, else one that does. None if it takes too long.
    fn step(&self, case: &Case<'_>, guess: f64) -> Option<f64> {
        let touch = match &case.meeting {
            Meeting::Struck(struck) => struck.gap.map_or(0.0, |gap| gap / struck.speed),
            _ => 0.0,
        };
        let touch = if touch.is_finite() { touch.min(self.settings.end) } else { 0.0 };
        let size = self.model.element_count().max(self.model.node_count()).max(1) as f64;
        let most = self.left.get() as f64 / size / ITERATIONS;
        let wanted = self.settings.step.min(guess / STEPS);
        let affordable = (touch + 1.5 * guess) / most;
        let step = wanted.max(affordable);
        (step <= wanted || step <= guess / FEWER).then_some(step)
    }

    /// A trial in steps of this size or less that says something of a contact, made now or before.
    fn made(&self, contact: usize, step: f64) -> Option<Preview> {
        let closed = |made: &&Preview| {
            made.step <= 1.001 * step && made.first[contact].is_some_and(|[_, end]| end.is_finite())
        };
        if let Some(made) = self.made.borrow().iter().find(closed) {
            return Some(made.clone());
        }
        let settings = Settings { step, accuracy: None, ..*self.settings };
        let made = preview(self.model, &settings, contact, self.left.get())?;
        self.left.set(self.left.get().saturating_sub(made.effort));
        self.made.borrow_mut().push(made.clone());
        Some(made)
    }
}

/// How long the striking body would stay on a rigid target \[s\].
fn alone(case: &Case<'_>) -> Option<f64> {
    let (mass, speed) = match &case.meeting {
        Meeting::Struck(struck) => (struck.mass, struck.speed),
        Meeting::Bodies(two) => (two.mass, two.speed),
        Meeting::Beams(_) => return None,
    };
    let impact =
        rigid_impact(case.law, mass, speed, 0.0).filter(|_| speed > 0.0 && mass.is_finite());
    impact.map(|impact| impact.duration)
}
