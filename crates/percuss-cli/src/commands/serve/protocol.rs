//! UM-Bridge, protocol 1.0: what is asked and what is answered, without the network.
//!
//! One model of one vector in, of the study's parameters in SI units, and one vector out, of its results.

use std::sync::OnceLock;

use percuss_codes::{Code, Topic};
use percuss_study::{Function, Jacobian, Means};
use serde_json::{Value, json};

use crate::terminal;

/// Name of the model, as most examples of UM-Bridge have it.
pub const NAME: &str = "forward";

/// Version of the protocol.
pub const VERSION: f64 = 1.0;

/// The study as a model.
pub struct Model<'s> {
    /// What is evaluated.
    pub function: Function<'s>,
    /// Whether it has derivatives, once somebody asked.
    pub differentiable: &'s OnceLock<bool>,
}

/// An answer: status of HTTP and what is reported.
#[derive(Debug, PartialEq)]
pub struct Answer {
    /// Status.
    pub status: u16,
    /// Content.
    pub body: Value,
}

/// What an error is about, in the protocol's words.
#[derive(Clone, Copy, Debug)]
pub enum Kind {
    /// The request.
    Input,
    /// A request that is too long.
    Large,
    /// Whoever asks, or by what name.
    Forbidden,
    /// The name of the model.
    Name,
    /// Something that is not offered.
    Feature,
    /// The evaluation.
    Model,
}

impl Answer {
    /// An error.
    pub fn failure(kind: Kind, text: String) -> Self {
        let (status, name) = match kind {
            Kind::Input => (400, "InvalidInput"),
            Kind::Large => (413, "InvalidInput"),
            Kind::Forbidden => (403, "InvalidInput"),
            Kind::Name => (400, "ModelNotFound"),
            Kind::Feature => (400, "UnsupportedFeature"),
            Kind::Model => (500, "InvalidOutput"),
        };
        Self { status, body: json!({ "error": { "type": name, "message": text } }) }
    }
}

type Refused = (Kind, String);

/// The answer to a request.
pub fn answer(model: &mut Model<'_>, posted: bool, path: &str, body: &str) -> Answer {
    match respond(model, posted, path, body) {
        Ok(body) => Answer { status: 200, body },
        Err((kind, text)) => Answer::failure(kind, text),
    }
}

fn respond(model: &mut Model<'_>, posted: bool, path: &str, body: &str) -> Result<Value, Refused> {
    let path = path.split('?').next().unwrap_or(path);
    if path == "/Info" {
        return Ok(json!({ "protocolVersion": VERSION, "models": [NAME] }));
    }
    let known =
        ["/InputSizes", "/OutputSizes", "/ModelInfo", "/Evaluate", "/Gradient", "/ApplyJacobian"];
    if !known.contains(&path) {
        let text = format!("`{path}` is not offered; {} are", known.join(", "));
        return Err((Kind::Feature, text));
    }
    if !posted {
        return Err((Kind::Input, format!("`{path}` is asked by POST")));
    }
    let request = crate::json::read(body)
        .map_err(|error| (Kind::Input, format!("the request is no JSON: {error}")))?;
    refuse_others(&request)?;
    match path {
        "/InputSizes" => Ok(json!({ "inputSizes": [model.function.parameters().len()] })),
        "/OutputSizes" => Ok(json!({ "outputSizes": [model.function.results().len()] })),
        "/ModelInfo" => {
            let derivatives = model.is_differentiable();
            Ok(json!({ "support": {
                "Evaluate": true,
                "Gradient": derivatives,
                "ApplyJacobian": derivatives,
                "ApplyHessian": false,
            } }))
        }
        "/Evaluate" => {
            let point = model.point(&request)?;
            let found = model.function.evaluated(&[point]).pop();
            let found = found.unwrap_or_else(|| Err("no result".into()));
            let found = found.map_err(|why| (Kind::Model, why))?;
            let mut output = json!({ "output": [found.values] });
            // A key of its own: clients of the protocol leave it alone.
            if let Some(text) = model.function.study().not_final(&found.open) {
                output["warning"] = Code::from(Topic::Ending).behind(&text).into();
                terminal::warning(Topic::Ending, &text);
            }
            Ok(output)
        }
        "/Gradient" => {
            let sens = vector(&request, "sens", model.function.results().len())?;
            let Jacobian { derivatives, .. } = model.jacobian(&request)?;
            let parameters = model.function.parameters().len();
            let column = |k: usize| derivatives.iter().zip(&sens).map(|(row, s)| row[k] * s).sum();
            Ok(json!({ "output": (0..parameters).map(column).collect::<Vec<f64>>() }))
        }
        _ => {
            let along = vector(&request, "vec", model.function.parameters().len())?;
            let Jacobian { derivatives, .. } = model.jacobian(&request)?;
            let row = |row: &Vec<f64>| row.iter().zip(&along).map(|(d, v)| d * v).sum();
            Ok(json!({ "output": derivatives.iter().map(row).collect::<Vec<f64>>() }))
        }
    }
}

impl Model<'_> {
    /// Whether results have exact derivatives: tried once, at the middle of what varies. Differences are left to the client, which knows better where
    /// it needs them.
    fn is_differentiable(&mut self) -> bool {
        let middle = self.function.middle();
        *self.differentiable.get_or_init(|| {
            self.function.jacobian(&middle).is_ok_and(|found| found.means == Means::Exact)
        })
    }

    /// The point of a request: one vector in a list.
    fn point(&self, request: &Value) -> Result<Vec<f64>, Refused> {
        let parameters = self.function.parameters();
        let lists = request.get("input").and_then(Value::as_array);
        let one = lists.filter(|lists| lists.len() == 1).and_then(|lists| numbers(&lists[0]));
        one.filter(|point| point.len() == parameters.len()).ok_or_else(|| {
            let names: Vec<&str> = parameters.iter().map(|p| p.name.as_str()).collect();
            let (count, names) = (names.len(), names.join(", "));
            (
                Kind::Input,
                format!("`input` must be a list with one list of {count} numbers in it ({names})"),
            )
        })
    }

    fn jacobian(&mut self, request: &Value) -> Result<Jacobian, Refused> {
        for key in ["outWrt", "inWrt"] {
            if request.get(key).is_some_and(|k| k.as_u64() != Some(0)) {
                return Err((Kind::Input, format!("`{key}` must be 0: there is one vector")));
            }
        }
        let point = self.point(request)?;
        self.function.jacobian(&point).map_err(|why| (Kind::Model, why))
    }
}

/// Refuses other models, and settings, of which there are none.
fn refuse_others(request: &Value) -> Result<(), Refused> {
    match request.get("name").and_then(Value::as_str) {
        Some(NAME) => {}
        Some(name) => return Err((Kind::Name, format!("no model `{name}`; there is `{NAME}`"))),
        None => return Err((Kind::Name, format!("the request names no model; there is `{NAME}`"))),
    }
    match request.get("config").and_then(Value::as_object).and_then(|config| config.keys().next()) {
        None => Ok(()),
        Some(key) => {
            let text = format!("the model takes no configuration; found `{key}`");
            Err((Kind::Input, text))
        }
    }
}

fn vector(request: &Value, key: &str, length: usize) -> Result<Vec<f64>, Refused> {
    let found = request.get(key).and_then(numbers).filter(|all| all.len() == length);
    found.ok_or_else(|| (Kind::Input, format!("`{key}` must be a list of {length} numbers")))
}

fn numbers(value: &Value) -> Option<Vec<f64>> {
    value.as_array()?.iter().map(Value::as_f64).collect()
}
