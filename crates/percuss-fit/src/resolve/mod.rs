//! From the file of a fit to its problem: paths found, values in SI units, records read, every fault told at once.

mod numbers;
mod records;

use std::collections::BTreeMap;
use std::sync::Mutex;
use std::sync::atomic::AtomicU64;

use percuss::{Channel as HistoryColumn, Fault, MemoryRecorder, simulate};
use percuss_scenario::fit::{Alignment, FitContent, FitTest, Record};
use percuss_scenario::{Diagnostics, FitFile, Named, Scenario, load_whole, read_whole};
use percuss_study::Workers;

use crate::align::{Origin, onset};
use crate::channel::Test;
use crate::curve::Curve;
use crate::error::FitError;
use crate::parameter::Adjustable;
use crate::problem::Problem;
use crate::run::{GoesOn, Share};
use numbers::numbers;
use records::{Read, record};

/// Half the width of the bounds of a fitted offset, as a share of the run or of the record, whichever is shorter.
const OFFSET: f64 = 0.1;

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
        let scenarios = scenarios(&base, content, supplied, &mut faults)?;
        let (adjustables, fields) = numbers(content, &scenarios, &mut faults);
        let mut tests = Vec::new();
        let mut reads = Vec::new();
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
        faults.extend(problem.enough(content));
        file.settle(faults)?;
        Ok(problem)
    }

    /// Chooses the offset of a test, and the times that are compared.
    fn align(
        &mut self,
        k: usize,
        read: &Read,
        given: &FitTest,
        faults: &mut Vec<Fault>,
        goes_on: GoesOn<'_>,
    ) -> Result<(), FitError> {
        let values: Vec<f64> = self.adjustables.iter().map(|one| one.start).collect();
        let test = &self.tests[k];
        let (name, hold_out) = (test.name.clone(), test.hold_out);
        let end = self.scenario(test, &values)?.compile()?.settings.end;
        let by_onset = given.align == Alignment::Onset
            || given.align == Alignment::Fit && (given.offset.is_none() || hold_out);
        if by_onset {
            let first = Curve { time: read.all.clone(), values: read.first.clone() };
            let computed = self.compute(test, &values, Share::Whole, goes_on)?;
            let computed = computed.curves.first();
            let computed = computed.and_then(|curve| onset(curve, Origin::Computed));
            let both = (onset(&first, Origin::Measured), computed);
            let (Some(measured), Some(computed)) = both else {
                let found = match both.0 {
                    None => "a record whose first channel is constant",
                    Some(_) => "a run at the starting values whose first channel is constant",
                };
                let expected =
                    "a first channel that leaves its initial value, or `align = \"none\"`";
                faults.push(Fault::new(format!("test.{name}.align"), found, expected));
                return Ok(());
            };
            self.tests[k].onset = Some(measured);
            self.tests[k].offset = measured - computed;
        }
        let mut earliest = self.tests[k].offset;
        if given.align == Alignment::Fit && !hold_out {
            let length = read.all.last().unwrap_or(&0.0) - read.all.first().unwrap_or(&0.0);
            let room = OFFSET * length.min(end);
            let start = self.tests[k].offset;
            let bounds = given.offset_bounds.unwrap_or([start - room, start + room]);
            if !(bounds[0] < bounds[1] && (bounds[0]..=bounds[1]).contains(&start)) {
                let found =
                    format!("bounds from {} to {} s around {start:.6e} s", bounds[0], bounds[1]);
                let expected =
                    "a smaller offset, then a larger one, with the first guess between them";
                faults.push(Fault::new(format!("test.{name}.offset_bounds"), found, expected));
            }
            earliest = bounds[0];
            self.tests[k].fitted_offset = Some(self.adjustables.len());
            self.adjustables.push(Adjustable {
                name: format!("{name}.offset"),
                unit: "s".into(),
                paths: Vec::new(),
                start,
                bounds,
                logarithmic: false,
                fixed: false,
                prior: None,
            });
        }
        let last = given.to.unwrap_or(f64::INFINITY).min(end + earliest);
        let first = given.from.unwrap_or(f64::NEG_INFINITY);
        let keep: Vec<usize> =
            (0..read.all.len()).filter(|i| (first..=last).contains(&read.all[*i])).collect();
        let test = &mut self.tests[k];
        test.time = keep.iter().map(|i| read.all[*i]).collect();
        for channel in &mut test.channels {
            channel.measured = keep.iter().map(|i| channel.measured[*i]).collect();
        }
        if test.time.len() < 2 {
            let found = format!(
                "a record from {:.6e} to {:.6e} s, of which {} times lie within the run (from {earliest:.6e} s of the record, {end:.6e} s long)",
                read.all[0],
                read.all[read.all.len() - 1],
                test.time.len()
            );
            let expected = "a record that overlaps the run: see `offset`, `align`, `from` and `to`, and `time.end` of the scenario";
            faults.push(Fault::new(format!("test.{name}.data"), found, expected));
        }
        Ok(())
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
) -> Result<Vec<Scenario>, FitError> {
    let mut all = Vec::new();
    for Named { name, table } in &content.test {
        let own = supplied.scenarios.get(name).unwrap_or(base);
        let split = |change: &String| {
            let (path, value) = change.split_once('=')?;
            Some((path.trim().to_owned(), value.trim().to_owned()))
        };
        let changes: Vec<Option<(String, String)>> = table.set.iter().map(split).collect();
        if changes.iter().any(Option::is_none) {
            let expected = "changes such as \"projectile.bag.velocity[1]=-3\"";
            faults.push(Fault::new(format!("test.{name}.set"), "a text without `=`", expected));
        }
        let changes: Vec<(String, String)> = changes.into_iter().flatten().collect();
        let pairs: Vec<(&str, &str)> =
            changes.iter().map(|(path, value)| (path.as_str(), value.as_str())).collect();
        all.push(if pairs.is_empty() { own.clone() } else { own.anew(&pairs)? });
    }
    Ok(all)
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
