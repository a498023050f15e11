//! Offsets of records, and the times that are compared.

use percuss::Fault;
use percuss_scenario::fit::{Alignment, FitTest};

use super::records::Read;
use crate::align::{Origin, onset};
use crate::curve::Curve;
use crate::error::FitError;
use crate::parameter::Adjustable;
use crate::problem::Problem;
use crate::run::{GoesOn, Share};

/// A number of times, in words.
fn count(times: usize) -> String {
    if times == 1 { "1 time".into() } else { format!("{times} times") }
}

/// Half the width of the bounds of a fitted offset, as a share of the run or of the record, whichever is shorter.
const OFFSET: f64 = 0.1;

/// What is wrong with the times that a test gives.
pub(super) fn times_at_fault(name: &str, given: &FitTest) -> Vec<Fault> {
    let mut faults = Vec::new();
    if let (Some(from), Some(to)) = (given.from, given.to)
        && from >= to
    {
        let found = format!("a window from {from:e} to {to:e} s");
        faults.push(Fault::new(format!("test.{name}.to"), found, "a time behind `from`"));
    }
    let mut idle = |key: &str, expected: &str| {
        let found = format!("`{key}`, which has no effect with this `align`");
        faults.push(Fault::new(format!("test.{name}.{key}"), found, expected));
    };
    if given.offset_bounds.is_some() && given.align != Alignment::Fit {
        idle("offset_bounds", "`align = \"fit\"`, or no bounds");
    }
    if given.offset.is_some() && given.align == Alignment::Onset {
        idle("offset", "`align = \"none\"` or \"fit\", or no offset");
    }
    faults
}

impl Problem {
    /// Chooses the offset of a test, and the times that are compared.
    ///
    /// # Errors
    /// If its run fails at the starting values, or the user asks to stop.
    pub(super) fn align(
        &mut self,
        k: usize,
        read: &Read,
        given: &FitTest,
        faults: &mut Vec<Fault>,
        goes_on: GoesOn<'_>,
    ) -> Result<(), FitError> {
        let values: Vec<f64> = self.adjustables.iter().map(|one| one.start).collect();
        let hold_out = self.tests[k].hold_out;
        let end = self.scenario(&self.tests[k], &values)?.compile()?.settings.end;
        let by_onset = given.align == Alignment::Onset
            || given.align == Alignment::Fit && (given.offset.is_none() || hold_out);
        if by_onset {
            match self.onsets(k, read, &values, goes_on)? {
                Ok([measured, computed]) => {
                    self.tests[k].onset = Some(measured);
                    self.tests[k].offset = measured - computed;
                }
                Err(fault) => {
                    faults.push(fault);
                    return Ok(());
                }
            }
        }
        let mut earliest = self.tests[k].offset;
        if given.align == Alignment::Fit && !hold_out {
            let length = read.all.last().unwrap_or(&0.0) - read.all.first().unwrap_or(&0.0);
            let offset = self.free_offset(k, OFFSET * length.min(end), given, faults);
            earliest = offset.bounds[0];
            self.tests[k].fitted_offset = Some(self.adjustables.len());
            self.adjustables.push(offset);
        }
        faults.extend(self.keep(k, read, given, [earliest, end]));
        Ok(())
    }

    /// Onsets of the first channel in record and run, or what is wrong with them.
    fn onsets(
        &self,
        k: usize,
        read: &Read,
        values: &[f64],
        goes_on: GoesOn<'_>,
    ) -> Result<Result<[f64; 2], Fault>, FitError> {
        let test = &self.tests[k];
        let record = Curve { time: read.all.clone(), values: read.first.clone() };
        let run = self.compute(test, values, Share::Whole, goes_on)?;
        let computed = run.curves.first().and_then(|curve| onset(curve, Origin::Computed));
        let found = match (onset(&record, Origin::Measured), computed) {
            (Some(measured), Some(computed)) => return Ok(Ok([measured, computed])),
            (None, _) => "a record whose first channel is constant",
            (_, None) => "a run at the starting values whose first channel is constant",
        };
        let expected = "a first channel that leaves its initial value, or `align = \"none\"`";
        Ok(Err(Fault::new(format!("test.{}.align", test.name), found, expected)))
    }

    /// The offset of a test as a parameter, free within `room` to either side of the first guess unless bounds are given.
    fn free_offset(
        &self,
        k: usize,
        room: f64,
        given: &FitTest,
        faults: &mut Vec<Fault>,
    ) -> Adjustable {
        let (name, start) = (&self.tests[k].name, self.tests[k].offset);
        let bounds = given.offset_bounds.unwrap_or([start - room, start + room]);
        if !(bounds[0] < bounds[1] && (bounds[0]..=bounds[1]).contains(&start)) {
            let found =
                format!("bounds from {} to {} s around {start:.6e} s", bounds[0], bounds[1]);
            let expected = "a smaller offset, then a larger one, with the first guess between them";
            faults.push(Fault::new(format!("test.{name}.offset_bounds"), found, expected));
        }
        Adjustable {
            name: format!("{name}.offset"),
            unit: "s".into(),
            paths: Vec::new(),
            start,
            bounds,
            logarithmic: false,
            fixed: false,
            prior: None,
        }
    }

    /// Keeps the rows of a record between `from` and `to`, up to the end of a run that starts at the earliest offset.
    fn keep(
        &mut self,
        k: usize,
        read: &Read,
        given: &FitTest,
        [earliest, end]: [f64; 2],
    ) -> Option<Fault> {
        let last = given.to.unwrap_or(f64::INFINITY).min(end + earliest);
        let first = given.from.unwrap_or(f64::NEG_INFINITY);
        let keep: Vec<usize> =
            (0..read.all.len()).filter(|i| (first..=last).contains(&read.all[*i])).collect();
        let offset = self.tests[k].offset;
        let within = keep.iter().filter(|i| read.all[**i] >= offset).count();
        let test = &mut self.tests[k];
        test.time = keep.iter().map(|i| read.all[*i]).collect();
        for channel in &mut test.channels {
            channel.measured = keep.iter().map(|i| channel.measured[*i]).collect();
        }
        (within < 2).then(|| {
            let found = format!(
                "a record from {:.6e} to {:.6e} s, of which {} lie within the run and the window (the run starts at {offset:.6e} s of the record and is {end:.6e} s long)",
                read.all[0],
                read.all[read.all.len() - 1],
                count(within)
            );
            let expected = "a record that overlaps the run: see `offset`, `align`, `from` and `to`, and `time.end` of the scenario";
            Fault::new(format!("test.{}.data", test.name), found, expected)
        })
    }
}
