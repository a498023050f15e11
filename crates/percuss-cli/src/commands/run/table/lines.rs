//! Lines of a list that may be too long.

/// The first few of `count` items, and how many more there are.
pub(super) fn listed<T>(
    items: &[T],
    count: usize,
    most: usize,
    line: impl Fn(&T) -> String,
) -> Vec<String> {
    let mut lines: Vec<String> = items.iter().take(most).map(line).collect();
    if count > lines.len() {
        lines.push(format!("and {} more", count - lines.len()));
    }
    lines
}
