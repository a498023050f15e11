//! Dakota's files of parameters, in the standard form (a value, its label) and in that of aprepro (`{ label = value }`), and its files
//! of results (Dakota user manual, "Inputs to Dakota: parameters file format", "Outputs from Dakota: results file format").

use super::asked::{Answered, Asked, Wanted};

/// Bits of the active set vector.
const VALUE: u32 = 1;
const GRADIENT: u32 = 2;
const HESSIAN: u32 = 4;

/// A line: a value and its label.
type Line<'t> = (&'t str, &'t str);

/// What a file of parameters asks for.
pub fn read(text: &str) -> Result<Asked, String> {
    let lines: Vec<Line<'_>> = text.lines().filter_map(line).collect();
    let mut rest = lines.as_slice();
    let variables = section(&mut rest, &["variables", "DAKOTA_VARS"])?;
    let functions = section(&mut rest, &["functions", "DAKOTA_FNS"])?;
    let by = section(&mut rest, &["derivative_variables", "DAKOTA_DER_VARS"])?;
    let number = |(value, label): &Line<'_>| match value.parse::<f64>() {
        Ok(number) => Ok(((*label).to_owned(), number)),
        Err(_) => Err(format!("`{label}` is `{value}`: expected a number, in SI units")),
    };
    let variables = variables.iter().map(number).collect::<Result<Vec<_>, _>>()?;
    let functions = functions.iter().map(wanted).collect::<Result<Vec<_>, _>>()?;
    let by = by.iter().map(|(_, label)| behind_colon(label).to_owned()).collect();
    Ok(Asked { variables, functions: Some(functions), by: Some(by) })
}

fn line(text: &str) -> Option<Line<'_>> {
    let text = text.trim();
    if let Some(inner) = text.strip_prefix('{').and_then(|text| text.strip_suffix('}')) {
        let (label, value) = inner.split_once('=')?;
        return Some((value.trim(), label.trim()));
    }
    let (value, label) = text.split_once(char::is_whitespace)?;
    Some((value, label.trim()))
}

/// The lines of a section, whose head says how many they are.
fn section<'l, 't>(rest: &mut &'l [Line<'t>], heads: &[&str]) -> Result<&'l [Line<'t>], String> {
    let expected = || {
        format!(
            "expected a count of `{}`, as Dakota's files of parameters have, or a JSON table",
            heads[0]
        )
    };
    let ((count, head), others) = rest.split_first().ok_or_else(expected)?;
    let count: usize = match heads.contains(head) {
        true => count.parse().map_err(|_| expected())?,
        false => return Err(expected()),
    };
    let own = others.get(..count).ok_or_else(|| {
        format!("the file ends before its {count} {}: it has {}", heads[0], others.len())
    })?;
    *rest = &others[count..];
    Ok(own)
}

fn wanted((active, label): &Line<'_>) -> Result<Wanted, String> {
    let name = behind_colon(label);
    let bits: u32 =
        active.parse().map_err(|_| format!("`{label}` is `{active}`: expected an active set"))?;
    if bits & HESSIAN != 0 {
        return Err(format!(
            "second derivatives of `{name}` are not available: use no_hessians, or numerical or quasi Hessians"
        ));
    }
    Ok(Wanted { name: name.into(), value: bits & VALUE != 0, gradient: bits & GRADIENT != 0 })
}

/// The name behind `ASV_1:`.
fn behind_colon(label: &str) -> &str {
    label.split_once(':').map_or(label, |(_, name)| name)
}

/// A file of results: values, then gradients.
pub fn formatted(all: &[Answered]) -> String {
    let value = |f: &Answered| Some(format!("{:.16e} {}\n", f.value?, f.name));
    let gradient = |f: &Answered| {
        let by = f.gradient.as_ref()?.iter().map(|(_, d)| format!("{d:.16e}"));
        Some(format!("[ {} ]\n", by.collect::<Vec<_>>().join(" ")))
    };
    all.iter().filter_map(value).chain(all.iter().filter_map(gradient)).collect()
}

/// A file of results that Dakota takes for a failed evaluation.
pub fn failed(why: &str) -> String {
    format!("FAIL {why}\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    const STANDARD: &str = "                    2 variables\n 1.5000000000000000e+01 speed\n  4.0e+02 mass\n 1 functions\n 3 ASV_1:obj_fn\n\
        2 derivative_variables\n 1 DVV_1:speed\n 2 DVV_2:mass\n 0 analysis_components\n 7 eval_id\n";
    const APREPRO: &str = "{ DAKOTA_VARS = 2 }\n{ speed = 1.5e1 }\n{ mass = 400 }\n{ DAKOTA_FNS = 1 }\n{ ASV_1:obj_fn = 3 }\n\
        { DAKOTA_DER_VARS = 2 }\n{ DVV_1:speed = 1 }\n{ DVV_2:mass = 2 }\n{ DAKOTA_AN_COMPS = 0 }\n{ DAKOTA_EVAL_ID = 7 }\n";

    #[test]
    fn both_forms_ask_for_the_same() {
        for text in [STANDARD, APREPRO] {
            let asked = read(text).expect("a file of parameters");
            assert_eq!(asked.variables, [("speed".to_owned(), 15.0), ("mass".to_owned(), 400.0)]);
            let functions = asked.functions.expect("functions");
            assert!(functions.len() == 1 && functions[0].name == "obj_fn");
            assert!(functions[0].value && functions[0].gradient);
            assert_eq!(asked.by.as_deref(), Some(&["speed".to_owned(), "mass".to_owned()][..]));
        }
    }

    #[test]
    fn files_of_another_format_are_refused() {
        let message = |text: &str| read(text).err().unwrap_or_default();
        assert!(message("hello").contains("a count of `variables`"));
        assert!(message("3 variables\n1 a\n").contains("ends before its 3 variables: it has 1"));
        assert!(
            message(&STANDARD.replace("3 ASV", "7 ASV")).contains("second derivatives of `obj_fn`")
        );
        assert!(message(&STANDARD.replace("4.0e+02", "heavy")).contains("`mass` is `heavy`"));
    }
}
