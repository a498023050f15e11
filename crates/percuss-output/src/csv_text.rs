//! CSV as this crate writes and reads it: names, quoted where necessary (RFC 4180), and numbers; a name never holds a line break.

use std::path::Path;

use crate::error::Error;
use crate::files;

/// `text` as a field, quoted where necessary.
pub(crate) fn quote(text: &str) -> String {
    let mut writer = csv::Writer::from_writer(Vec::new());
    // Neither can fail: it writes to memory.
    let _ = writer.write_record([text.replace(['\n', '\r'], " ")]);
    let line = writer.into_inner().unwrap_or_default();
    String::from_utf8_lossy(&line).trim_end_matches('\n').to_owned()
}

/// The fields of a line.
pub(crate) fn fields(line: &str) -> Vec<String> {
    // Making a reader takes longer than most lines do, and most lines are numbers.
    if !line.is_empty() && !line.contains('"') {
        return line.split(',').map(str::to_owned).collect();
    }
    let mut reader = csv::ReaderBuilder::new().has_headers(false).from_reader(line.as_bytes());
    let record = reader.records().next().and_then(Result::ok).unwrap_or_default();
    record.iter().map(str::to_owned).collect()
}

/// Hands the rows of a file, a name and `N` numbers each, to `visit`; none if there is no such file.
///
/// # Errors
/// If the file cannot be read, has another header or holds something else.
pub(crate) fn for_each_named<const N: usize>(
    path: &Path,
    header: &str,
    mut visit: impl FnMut(&str, [f64; N]),
) -> Result<(), Error> {
    if !path.is_file() {
        return Ok(());
    }
    let text = files::read_text(path)?;
    let mut lines = text.lines();
    if lines.next() != Some(header) {
        return Err(Error::content(path, format!("does not begin with `{header}`")));
    }
    for (index, line) in lines.enumerate() {
        let fault = |what: String| Error::content(path, format!("line {}: {what}", index + 2));
        let fields = fields(line);
        let Some((name, texts)) = fields.split_first().filter(|(_, texts)| texts.len() == N) else {
            return Err(fault(format!("not {} fields", N + 1)));
        };
        let mut numbers = [0.0; N];
        for (number, text) in numbers.iter_mut().zip(texts) {
            *number = text.parse().map_err(|_| fault(format!("`{text}` is not a number")))?;
        }
        visit(name, numbers);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_reads_back_to_its_fields() {
        let names = ["time", "point.a,b.x", "the \"hammer\"", ""];
        let line = names.map(quote).join(",");
        assert_eq!(fields(&line), names);
        assert_eq!(fields("a,,-1e3,"), ["a", "", "-1e3", ""]);
        assert_eq!(fields(""), Vec::<String>::new());
    }
}
