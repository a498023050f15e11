//! From the file of a fit to its problem: paths found, values in SI units, records read, every fault reported at once.

mod numbers;
mod offsets;
mod records;
mod starts;

use std::collections::BTreeMap;
use std::sync::Mutex;
use std::sync::atomic::AtomicU64;

use percuss::{Channel as HistoryColumn, Fault, MemoryRecorder, simulate};
use percuss_scenario::fit::{Alignment, FitChannel, FitContent, FitTest, Record};
use percuss_scenario::{Diagnostics, FitFile, Named, Scenario, load_whole, read_whole};
use percuss_study::Workers;

use crate::channel::Test;
use crate::error::FitError;
use crate::problem::Problem;
use crate::run::GoesOn;
use numbers::numbers;
use records::record;
use starts::starts_at_fault;

/// Most starting points, and most iterations from one: a slip of the keyboard does not fill the memory.
const MOST: usize = 100_000;

/// What a program hands over instead of naming it in the file.
#[derive(Debug, Default)]
pub struct Supplied {
    /// The scenario.
    pub base: Option<Scenario>,
    /// Scenarios of tests by the names of these.
    pub scenarios: BTreeMap<String, Scenario>,
    /// Records by the names of their tests.
    pub records: BTreeMap<String, Record>,
}

impl Problem {
    /// The problem of a file, whose runs use `jobs` threads, 0 for one a core. Makes a run of each test that is aligned by its onset.
    ///
    /// # Errors
    /// Every fault of the file, its scenarios and records; a run that fails at the starting values; the wish to stop.
    pub fn new(
        file: &FitFile,
        supplied: &Supplied,
        jobs: usize,
        goes_on: GoesOn<'_>,
    ) -> Result<Self, FitError> {
        let workers = Workers::new(jobs)?;
        let base = base(file, supplied)?;
        base.compile()?;
        let mut faults = whole(&file.content);
        let content = &file.content;
        let scenarios = scenarios(&base, content, supplied, &mut faults);
        let (adjustables, fields) = numbers(content, &scenarios, &mut faults);
        faults.extend(starts_at_fault(content, (&adjustables, &fields), &scenarios));
        let mut tests = Vec::new();
        let mut reads = Vec::new();
        faults.extend(
            content.test.iter().flat_map(|one| offsets::times_at_fault(&one.name, &one.table)),
        );
        for ((named, scenario), fields) in content.test.iter().zip(&scenarios).zip(fields) {
            if file.is_tainted(&format!("test.{}.data", named.name)) {
                continue;
            }
            let columns = columns(scenario)?;
            let of = (named, columns.as_slice());
            let found = record(file.folder(), of, supplied.records.get(&named.name), &mut faults);
            let Some((read, channels)) = found else { continue };
            let FitTest { align, offset, hold_out, .. } = named.table;
            tests.push(Test {
                name: named.name.clone(),
                scenario: scenario.clone(),
                fields,
                time: read.time.clone(),
                channels,
                align,
                offset: offset.unwrap_or(0.0),
                fitted_offset: None,
                onset: None,
                hold_out,
            });
            reads.push(read);
        }
        let given = content.test.iter().flat_map(|test| &test.table.channel);
        let sigma_unknown = given.clone().all(|channel| channel.table.sigma.is_none());
        if !sigma_unknown {
            faults.extend(content.test.iter().flat_map(without_sigma));
        }
        file.settle(faults)?;
        let mut problem = Self {
            title: content.title.clone(),
            options: content.fit.clone(),
            adjustables,
            tests,
            base,
            sigma_unknown,
            workers,
            runs: AtomicU64::new(0),
            found: Mutex::default(),
        };
        let mut faults = Vec::new();
        for (k, read) in reads.iter().enumerate() {
            problem.align(k, read, &content.test[k].table, &mut faults, goes_on)?;
        }
        if faults.is_empty() {
            faults.extend(problem.enough(content));
        }
        file.settle(faults)?;
        Ok(problem)
    }

    /// Whether there are values enough for the parameters.
    fn enough(&self, content: &FitContent) -> Option<Fault> {
        let (values, free) = (self.residual_count(), self.free().count());
        if free == 0 {
            let expected = "a parameter that is not fixed";
            return Some(Fault::new("parameter", "no free parameter", expected));
        }
        let few = values < free && !content.test.is_empty();
        few.then(|| {
            let found = format!("{values} measured values for {free} parameters");
            Fault::new("test", found, "as many measured values as parameters, or more")
        })
    }
}

/// Channels without a standard deviation beside others that have one: the residuals give one common factor, which would contradict those.
fn without_sigma(test: &Named<FitTest>) -> Vec<Fault> {
    let without = test.table.channel.iter().filter(|one| one.table.sigma.is_none());
    let fault = |one: &Named<FitChannel>| {
        let path = format!("test.{}.channel.{}.sigma", test.name, one.name);
        let expected = "`sigma` for every channel of all tests, or for none";
        Fault::new(path, "no `sigma` beside channels that have one", expected)
    };
    without.map(fault).collect()
}

/// What the file lacks as a whole.
fn whole(content: &FitContent) -> Vec<Fault> {
    let mut faults = Vec::new();
    if content.parameter.is_empty() && !content.test.iter().any(|t| t.table.align == Alignment::Fit)
    {
        faults.push(Fault::new("parameter", "no parameter", "at least one [parameter.NAME]"));
    }
    if !content.test.iter().any(|test| !test.table.hold_out) {
        let found = if content.test.is_empty() { "no test" } else { "only tests with `hold_out`" };
        faults.push(Fault::new("test", found, "at least one [test.NAME] that is fitted"));
    }
    for (key, count) in [("starts", content.fit.starts), ("iterations", content.fit.iterations)] {
        if !(1..=MOST).contains(&count) {
            let expected = format!("a whole number from 1 to {MOST}");
            faults.push(Fault::new(format!("fit.{key}"), count.to_string(), expected));
        }
    }
    if content.fit.loss_scale <= 0.0 {
        let found = content.fit.loss_scale.to_string();
        faults.push(Fault::new(
            "fit.loss_scale",
            found,
            "a number of standard deviations above zero",
        ));
    }
    faults
}

/// The scenario without what differs in tests.
fn base(file: &FitFile, supplied: &Supplied) -> Result<Scenario, FitError> {
    if let Some(scenario) = &supplied.base {
        return Ok(scenario.clone());
    }
    let content = &file.content;
    if let Some(text) = &content.scenario {
        let name = format!("scenario in {}", file.name());
        return Ok(read_whole(text, &name, file.access())?);
    }
    let example = "the path of a scenario, such as \"drop.toml\"";
    let named = content.base.as_deref().filter(|path| !path.is_empty());
    let named = named.filter(|_| !file.is_tainted("base"));
    let Some(path) = named else {
        file.settle(vec![Fault::new("base", "no `base`", example)])?;
        return Err(Diagnostics::of_file(file.name(), "no scenario", example).into());
    };
    let full = file.folder().join(path);
    if !full.is_file() {
        let found = format!("{path:?}, where there is no file");
        file.settle(vec![Fault::new("base", found, example)])?;
    }
    Ok(load_whole(full, file.access())?)
}

/// The scenario of each test.
fn scenarios(
    base: &Scenario,
    content: &FitContent,
    supplied: &Supplied,
    faults: &mut Vec<Fault>,
) -> Vec<Scenario> {
    let mut all = Vec::new();
    for Named { name, table } in &content.test {
        let own = supplied.scenarios.get(name).unwrap_or(base);
        let key = format!("test.{name}.set");
        let split = |change: &String| {
            let (path, value) = change.split_once('=')?;
            Some((path.trim().to_owned(), value.trim().to_owned()))
        };
        let changes: Vec<Option<(String, String)>> = table.set.iter().map(split).collect();
        if changes.iter().any(Option::is_none) {
            let expected = "changes such as \"projectile.bag.velocity[1]=-3\"";
            faults.push(Fault::new(&key, "a text without `=`", expected));
        }
        let changes: Vec<(String, String)> = changes.into_iter().flatten().collect();
        let pairs: Vec<(&str, &str)> =
            changes.iter().map(|(path, value)| (path.as_str(), value.as_str())).collect();
        // Further faults are sought in the scenario without the changes.
        let changed = match pairs.is_empty() {
            true => own.clone(),
            false => own.reread(&pairs).unwrap_or_else(|wrong| {
                let found = percuss_study::in_one_line(&wrong);
                faults.push(Fault::new(&key, found, "changes that the scenario can have"));
                own.clone()
            }),
        };
        all.push(changed);
    }
    all
}

/// Columns of the history of a scenario.
fn columns(scenario: &Scenario) -> Result<Vec<HistoryColumn>, FitError> {
    let compiled = scenario.compile()?;
    let mut settings = compiled.settings;
    settings.end = settings.step;
    let mut recorder = MemoryRecorder::default();
    simulate(&compiled.model, &settings, &mut recorder)
        .map_err(|faults| scenario.diagnostics(faults))?;
    Ok(recorder.channels)
}
