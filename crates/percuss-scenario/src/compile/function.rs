//! Functions of time, checked.

use percuss::{Fault, TimeFunction};

use crate::content::Function;
use crate::given::Given;
use crate::node::count;

/// The function of the core; one at fault becomes a constant, so that the rest can be checked.
pub(super) fn function(
    path: &str,
    function: &Function,
    given: Option<&Given>,
    faults: &mut Vec<Fault>,
) -> TimeFunction {
    let converted = match (function, given) {
        (Function::Given, Some(given)) => given.function(path),
        _ => found(path, function).map_or_else(|| Ok(convert(function)), Err),
    };
    converted.unwrap_or_else(|fault| {
        faults.push(fault);
        TimeFunction::Constant
    })
}

fn found(path: &str, function: &Function) -> Option<Fault> {
    let fault = |key: &str, found: String, expected: &str| {
        Some(Fault::new(format!("{path}.{key}"), found, expected))
    };
    match function {
        Function::Ramp { duration }
        | Function::HalfSine { duration }
        | Function::Triangle { duration }
            if *duration <= 0.0 =>
        {
            fault("duration", format!("{duration} s"), "a duration above zero")
        }
        Function::Harmonic { frequency, .. } if *frequency <= 0.0 => {
            fault("frequency", format!("{frequency} Hz"), "a frequency above zero")
        }
        Function::Table { .. } => {
            let [times, values] = function.columns()?;
            if times.len() != values.len() {
                let found =
                    format!("{} for {}", count(values.len(), "value"), count(times.len(), "time"));
                return fault("values", found, "as many values as times");
            }
            if times.len() < 2 {
                return fault(
                    "times",
                    format!("a table of {}", count(times.len(), "time")),
                    "at least two",
                );
            }
            let fallen = times.windows(2).find(|pair| pair[1] <= pair[0])?;
            let found = format!("{} s after {} s", fallen[1], fallen[0]);
            fault("times", found, "times that increase")
        }
        _ => None,
    }
}

fn convert(function: &Function) -> TimeFunction {
    match function {
        Function::Constant => TimeFunction::Constant,
        Function::Step { at } => TimeFunction::Step { at: *at },
        Function::Ramp { duration } => TimeFunction::Ramp { duration: *duration },
        Function::HalfSine { duration } => TimeFunction::HalfSine { duration: *duration },
        Function::Triangle { duration } => TimeFunction::Triangle { duration: *duration },
        Function::Harmonic { frequency, phase } => {
            TimeFunction::Harmonic { frequency: *frequency, phase: *phase }
        }
        Function::Table { smooth, .. } => {
            match function.columns().map(|both| both.map(Vec::from)) {
                Some([times, values]) => TimeFunction::Table { times, values, smooth: *smooth },
                None => TimeFunction::Constant, // a fault of reading
            }
        }
        Function::Given => TimeFunction::Constant, // nobody asks what is given
    }
}
