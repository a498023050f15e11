//! Input as the readers take it.

/// Longest input that is looked at \[bytes\]: what a person writes is shorter, and longer ones find nothing else.
pub(super) const LONGEST: usize = 1 << 15;

/// The input as text, if it is one and not too long.
pub(super) fn text(data: &[u8]) -> Option<&str> {
    std::str::from_utf8(data.get(..data.len().min(LONGEST))?).ok()
}
