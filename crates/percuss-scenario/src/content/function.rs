//! Functions of time.

use serde_json::{Value as Json, json};

use crate::format::{self, Flag, Format, Inline, List, Maybe};
use crate::layout::Described;
use crate::measure;
use crate::node::{Body, Node, Reader};
use crate::quantity::Quantity;
use crate::reach::Reached;
use crate::suggest;
use crate::table::{Braces, Declared, Part};
use crate::tabulated::{self, File, Given, Pulse, Sum, TableFile};
use crate::write::{self, Writer};

kinds! {
    /// Time function: a factor as a function of the time since the start of the load or motion.
    pub enum Function by "kind" {
        /// Constant: one.
        Constant = "constant",
        /// Step: zero before a time, one from it on.
        Step = "step" {
            /// Time of the step (s).
            at: f64 as Quantity<measure::Time>,
        },
        /// Ramp: rises linearly to one, then constant.
        Ramp = "ramp" {
            /// Duration of the rise (s).
            duration: f64 as Quantity<measure::Time>,
        },
        /// Half-sine pulse, then zero.
        HalfSine = "half-sine" {
            /// Duration of the pulse (s).
            duration: f64 as Quantity<measure::Time>,
        },
        /// Triangular pulse: rises linearly to one at half of its duration and falls to zero.
        Triangle = "triangle" {
            /// Duration of the pulse (s).
            duration: f64 as Quantity<measure::Time>,
        },
        /// Harmonic: sin(2 pi frequency t + phase).
        Harmonic = "harmonic" {
            /// Frequency (Hz).
            frequency: f64 as Quantity<measure::Frequency>,
            /// Phase (rad).
            phase: f64 as Quantity<measure::Angle> = 0.0,
        },
        /// Table of values at given times; constant before the first and after the last.
        Table = "table" {
            /// Times, increasing (s).
            times: Option<Vec<f64>> as Maybe<List<Quantity<measure::Time>>> = None,
            /// Values at these times.
            values: Option<Vec<f64>> as Maybe<List<Quantity<measure::Ratio>>> = None,
            /// Instead of both: path of a CSV file with two columns, time (s) and value.
            file: Option<TableFile> as Maybe<File<Pulse>> = None,
            /// The SHA-256 that the file must have, 64 hexadecimal digits.
            sha256: Option<String> as Maybe<Sum> = None,
            /// Natural cubic spline through the values instead of linear interpolation.
            smooth: bool as Flag = false,
        },
        /// A function given by the program that reads the scenario.
        Given = "given",
    }
}

table! {
    /// A function of time.
    pub struct FunctionTable {}
    with {
        /// Which function.
        kind: Function
    }
    then settle_function
}

fn settle_function(table: &mut FunctionTable, body: &Body<'_>, reader: &mut Reader<'_>) {
    if let Function::Table { times, values, file, sha256, .. } = &mut table.kind {
        let lists = [("times", times), ("values", values)];
        tabulated::settle::<Pulse>(Given { file, sum: sha256, lists }, body, reader);
    }
}

impl Function {
    /// Times and values of a table, wherever they come from.
    pub fn columns(&self) -> Option<[&[f64]; 2]> {
        match self {
            Self::Table { file: Some(file), .. } => Some([&file.columns[0], &file.columns[1]]),
            Self::Table { times: Some(times), values: Some(values), .. } => Some([times, values]),
            _ => None,
        }
    }
}

/// `"constant"`, or a table in braces.
pub(crate) struct FunctionText;

impl FunctionText {
    /// The word alone: enough for a function without keys.
    fn word(node: &Node<'_>, word: &str, reader: &mut Reader<'_>) -> Option<Function> {
        let kinds = &Function::declared().choices[0];
        let known = kinds.variants.iter().find(|v| v.word == word);
        if known.is_some_and(|v| v.layout.keys.is_empty()) {
            let given = known.is_some_and(|v| v.word == "given");
            return Some(if given { Function::Given } else { Function::Constant });
        }
        let expected = match known {
            Some(variant) => {
                let keys = variant.layout.keys.iter().filter(|k| k.required);
                let keys: String = keys.map(|k| format!(", {} = ...", k.name)).collect();
                format!("a table {{ kind = \"{word}\"{keys} }}")
            }
            None => suggest::one_of(word, kinds.variants.iter().map(|v| v.word)),
        };
        reader.wrong(node, node.found(), expected);
        None
    }
}

impl Format for FunctionText {
    type Value = Function;

    fn read(node: &Node<'_>, reader: &mut Reader<'_>) -> Option<Function> {
        match (node.value.as_str(), node.value.is_table()) {
            (Some(word), _) => Self::word(node, word, reader),
            (None, true) => Braces::<FunctionTable>::read(node, reader).map(|table| table.kind),
            (None, false) => {
                reader.wrong(node, node.found(), Self::expected());
                None
            }
        }
    }

    fn placeholder() -> Function {
        Function::Constant
    }

    fn expected() -> String {
        "\"constant\" or a table, such as { kind = \"ramp\", duration = \"10 ms\" }".into()
    }

    fn schema() -> Json {
        json!({ "anyOf": [{ "enum": ["constant", "given"] }, Braces::<FunctionTable>::schema()] })
    }

    fn described() -> Described {
        Described { expected: Self::expected(), ..Braces::<FunctionTable>::described() }
    }

    fn reach<'c>(value: &'c mut Function, path: &[String]) -> Reached<'c> {
        match path {
            [] => format::end::<Self>(value, path),
            _ => Part::reach(value, path),
        }
    }
}

impl Inline for FunctionText {
    fn text(value: &Function) -> Option<String> {
        match value {
            Function::Constant => Some(write::text("constant")),
            Function::Given => Some(write::text("given")),
            kind => Braces::<FunctionTable>::text(&FunctionTable { kind: kind.clone() }),
        }
    }
}
