//! What a run is said to show: short formulas over the numbers of its summary, compared or put into a sentence.
//!
//! A formula is a sum of products of numbers and paths of `summary.json`, `1000 * contact.ball.peak_force.time - 5`; names within a path may
//! hold dots. Bars make a magnitude, `|projectile.ball.velocity_final[1]|`; a list stands for its length.

use serde_json::Value;

/// Whether `LEFT < RIGHT` or `LEFT > RIGHT` holds of a summary.
///
/// # Errors
/// What it comes to instead, or what cannot be read.
pub fn holds(claim: &str, summary: &Value) -> Result<(), String> {
    let Some((at, sign)) = claim.char_indices().find(|(_, c)| matches!(c, '<' | '>')) else {
        return Err(format!("`{claim}` compares nothing"));
    };
    let [left, right] = [&claim[..at], &claim[at + 1..]].map(|side| value(side, summary));
    let (left, right) = (left?, right?);
    if if sign == '<' { left < right } else { left > right } {
        return Ok(());
    }
    Err(format!("`{claim}` does not hold: {left:e} and {right:e}"))
}

/// A sentence whose formulas in braces are replaced by their values, with three digits.
///
/// # Errors
/// A formula that cannot be read.
pub fn filled(sentence: &str, summary: &Value) -> Result<String, String> {
    let mut pieces = sentence.split('{');
    let mut out = pieces.next().unwrap_or_default().to_string();
    for piece in pieces {
        let (formula, rest) =
            piece.split_once('}').ok_or_else(|| format!("`{piece}`: a brace is not closed"))?;
        out.push_str(&three_digits(value(formula, summary)?));
        out.push_str(rest);
    }
    Ok(out)
}

/// A number as a sentence has it: a whole one as it is.
fn three_digits(x: f64) -> String {
    if x.fract() == 0.0 {
        return format!("{x}");
    }
    // A hair more, so that 99.96 counts as 100.
    let places = 2 - (x.abs() * 1.0005).log10().floor() as i32;
    if places > 5 {
        return format!("{x:.1e}");
    }
    let scale = 10f64.powi(places);
    let rounded = (x * scale).round() / scale;
    format!("{rounded:.*}", usize::try_from(places).unwrap_or(0))
}

/// What a formula comes to.
fn value(formula: &str, summary: &Value) -> Result<f64, String> {
    let (mut sum, mut product, mut divides) = (0.0, 1.0, false);
    for word in formula.split_whitespace() {
        match word {
            "*" => divides = false,
            "/" => divides = true,
            "+" | "-" => {
                sum += product;
                (product, divides) = (if word == "-" { -1.0 } else { 1.0 }, false);
            }
            _ => {
                let factor = factor(word, summary)?;
                product = if divides { product / factor } else { product * factor };
            }
        }
    }
    Ok(sum + product)
}

fn factor(word: &str, summary: &Value) -> Result<f64, String> {
    if let Some(inner) = word.strip_prefix('|').and_then(|w| w.strip_suffix('|')) {
        return factor(inner, summary).map(f64::abs);
    }
    if let Ok(number) = word.parse() {
        return Ok(number);
    }
    match find(word, summary) {
        Some(Value::Array(list)) => Ok(list.len() as f64),
        Some(found) => found.as_f64().ok_or_else(|| format!("`{word}` is no number: {found}")),
        None => Err(format!("there is no `{word}` in the summary")),
    }
}

/// What stands at a path, keys tried whole.
fn find<'v>(path: &str, at: &'v Value) -> Option<&'v Value> {
    if path.is_empty() {
        return Some(at);
    }
    if let Some((number, rest)) = path.strip_prefix('[').and_then(|p| p.split_once(']')) {
        let list = at.as_array()?;
        let entry = match number {
            "last" => list.last(),
            _ => list.get(number.parse::<usize>().ok()?),
        };
        return find(rest, entry?);
    }
    let path = path.strip_prefix('.').unwrap_or(path);
    at.as_object()?.iter().find_map(|(key, inner)| {
        let rest = path.strip_prefix(key.as_str())?;
        let ends = rest.is_empty() || rest.starts_with(['.', '[']);
        if ends { find(rest, inner) } else { None }
    })
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::{filled, holds};

    #[test]
    fn formulas_reach_names_with_dots_lists_and_magnitudes() {
        let summary = json!({
            "point": { "bar.mid": { "largest": { "value": -0.0123456 } } },
            "impacts": [{ "impulse": 2.0 }, { "impulse": 4.0 }],
        });
        let sentence = "{1000 * |point.bar.mid.largest.value|} mm, {impacts} impacts";
        assert_eq!(filled(sentence, &summary).unwrap(), "12.3 mm, 2 impacts");
        assert!(holds("impacts[0].impulse / impacts[last].impulse < 0.51", &summary).is_ok());
        assert!(holds("impacts[1].impulse - impacts[0].impulse * 2 + 1 > 0.9", &summary).is_ok());
        assert!(holds("impacts[0].impulse > impacts[1].impulse", &summary).is_err());
        assert!(holds("impacts[2].impulse > 0", &summary).is_err());
        assert!(filled("{nothing}", &summary).is_err());
    }
}
