//! Input of the readers.

/// Longest input that is tested \[bytes\]: files written by people are shorter, and longer input does not find other errors.
pub(super) const LONGEST: usize = 1 << 15;

/// The input as text, if it is one and not too long.
pub(super) fn text(data: &[u8]) -> Option<&str> {
    std::str::from_utf8(data.get(..data.len().min(LONGEST))?).ok()
}
