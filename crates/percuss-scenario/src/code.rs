//! Of which kind a fault of the model is, by its place in the file.

use percuss::Fault;
use percuss_codes::Code;
pub use percuss_codes::FaultCode;

/// A fault of the model in one line, with its code.
pub fn in_one_line(fault: &Fault) -> String {
    Code::from(of_path(&fault.path)).behind(fault)
}

/// The kind of a fault of the model at a dotted path, by the table that the path begins with.
pub(crate) fn of_path(path: &str) -> FaultCode {
    match path.split(['.', '[']).next().unwrap_or_default() {
        "material" | "section" => FaultCode::Section,
        "beam" => FaultCode::Beam,
        "support" | "joint" | "spring" | "foundation" | "mass" | "connector" => {
            FaultCode::Connection
        }
        "projectile" | "disc" => FaultCode::Body,
        "obstacle" | "contact" => FaultCode::Contact,
        "load" | "function" | "gravity" => FaultCode::Load,
        "initial" => FaultCode::Initial,
        "damping" => FaultCode::Damping,
        "path" | "modes" => FaultCode::Analysis,
        "parameter" | "values" | "design" | "results" | "base" | "fit" | "test" => FaultCode::Study,
        _ => FaultCode::Setting,
    }
}
