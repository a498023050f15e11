//! The grammar of paths, of values in scenarios and of results in summaries: `projectile.mass.velocity[1]`.

use super::fault::Fault;

/// The steps of a path: names between dots, and indices of lists, counted from zero, in brackets or between dots. `points[1][0]` and
/// `points.1.0` are both `points`, `1`, `0`.
///
/// # Errors
/// The first step that is neither a name nor an index.
///
/// ```
/// assert_eq!(percuss::path_steps("beam.girder.points[1][0]").unwrap(), ["beam", "girder", "points", "1", "0"]);
/// assert_eq!(percuss::path_steps("points[-1]").unwrap_err().found, "the index `[-1]`");
/// ```
pub fn path_steps(path: &str) -> Result<Vec<String>, Fault> {
    let mut steps = Vec::new();
    for part in path.split('.') {
        let (name, mut rest) = part.split_at(part.find('[').unwrap_or(part.len()));
        steps.push(named(path, name)?);
        while !rest.is_empty() {
            let end = rest.find(']').map_or(rest.len(), |at| at + 1);
            let (index, more) = rest.split_at(end);
            let digits = index.strip_prefix('[').and_then(|index| index.strip_suffix(']'));
            let digits = digits.filter(|digits| is_index(digits));
            steps.push(digits.ok_or_else(|| no_index(path, index))?.to_owned());
            rest = more;
        }
    }
    Ok(steps)
}

/// Whether a step can be the index of an entry of a list.
pub fn is_index(step: &str) -> bool {
    !step.is_empty() && step.bytes().all(|byte| byte.is_ascii_digit())
}

fn named(path: &str, name: &str) -> Result<String, Fault> {
    let expected = "a path of names and indices, such as `projectile.mass.velocity[1]`";
    if name.is_empty() {
        return Err(Fault::new(path, "an empty name", expected));
    }
    if name.strip_prefix('-').is_some_and(is_index) {
        return Err(no_index(path, name));
    }
    if !name.chars().all(|c| c.is_alphanumeric() || c == '_' || c == '-') {
        let expected = "a name of letters, digits, `_` and `-`";
        return Err(Fault::new(path, format!("the name `{name}`"), expected));
    }
    Ok(name.to_owned())
}

fn no_index(path: &str, index: &str) -> Fault {
    let expected = "the index of an entry, counted from zero, such as `[0]`";
    Fault::new(path, format!("the index `{index}`"), expected)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn indices_stand_in_brackets_or_between_dots() {
        let steps = |path: &str| path_steps(path).map_err(|fault| fault.found);
        let velocity = || Ok(vec!["a".to_owned(), "v".to_owned(), "1".to_owned()]);
        assert_eq!(steps("a.v[1]"), velocity());
        assert_eq!(steps("a.v.1"), velocity());
        assert_eq!(steps("a__b"), Ok(vec!["a__b".to_owned()]));
        for (path, found) in [
            ("", "an empty name"),
            ("a..b", "an empty name"),
            ("a.", "an empty name"),
            ("[1]", "an empty name"),
            ("a.my beam", "the name `my beam`"),
            ("a]", "the name `a]`"),
            ("a[-1]", "the index `[-1]`"),
            ("a.-1", "the index `-1`"),
            ("a[1", "the index `[1`"),
            ("a[]", "the index `[]`"),
            ("a[x]", "the index `[x]`"),
            ("a[1]b", "the index `b`"),
            ("a[0.5]", "the index `[0`"),
        ] {
            assert_eq!(steps(path), Err(found.to_owned()), "{path}");
        }
    }
}
