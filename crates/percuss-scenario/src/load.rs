//! Takes the bytes of a file for text.

use std::path::Path;

use crate::code::FaultCode;
use crate::diagnostic::{Diagnostic, Diagnostics};
use crate::source::Source;

impl Source {
    /// Reads a file from disk.
    pub fn load(path: &Path) -> Result<Self, Diagnostics> {
        let name = path.display().to_string();
        let whole = |found: &str, expected: &str| {
            let empty = Self::new(&name, "");
            Diagnostics::new(empty, vec![Diagnostic::of_file(found, expected)])
        };
        if path.is_dir() {
            return Err(whole("a directory", "a scenario file"));
        }
        let bytes = crate::files::read_bytes(path).map_err(|error| match error.kind() {
            std::io::ErrorKind::NotFound => whole("no such file", "a scenario file"),
            _ => whole(&format!("a file that cannot be read ({error})"), "a readable file"),
        })?;
        Self::decode(&name, bytes)
    }

    /// Takes bytes for text.
    pub fn decode(name: &str, bytes: Vec<u8>) -> Result<Self, Diagnostics> {
        let error = match String::from_utf8(bytes) {
            Ok(text) => return Ok(Self::new(name, &text)),
            Err(error) => error,
        };
        let at = error.utf8_error().valid_up_to();
        let bad = error.as_bytes().get(at).copied().unwrap_or_default();
        let source = Self::new(name, &String::from_utf8_lossy(error.as_bytes()));
        let found = format!("the byte 0x{bad:02x}, which is not UTF-8");
        let end = at + char::REPLACEMENT_CHARACTER.len_utf8();
        let one =
            Diagnostic::at(FaultCode::File, &source, at..end, "", found, "a text saved as UTF-8");
        Err(Diagnostics::new(source, vec![one]))
    }
}
