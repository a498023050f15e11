//! Lines of a list that may be too long.

/// Terms of the balance below this share of the energy scale are nothing but rounding.
pub(super) const ROUNDING: f64 = 1e-13;
/// Impacts and intervals listed for a contact.
pub(super) const LISTED: usize = 3;

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
