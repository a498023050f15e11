//! Files that know whether they are whole: a hash of all bytes stands among them, taken with zeros in its place.

use sha2::{Digest, Sha256};

use crate::study::hex;

/// What stands before the digits.
const MARK: &str = "sha256:";
/// Hexadecimal digits of a seal.
const DIGITS: usize = 64;

/// A seal to be closed.
pub(crate) fn open() -> String {
    format!("{MARK}{}", "0".repeat(DIGITS))
}

/// Writes the hash into the last open seal of a file.
pub(crate) fn close(bytes: &mut [u8]) {
    let digest = hash(bytes);
    if let Some(at) = place(bytes) {
        bytes[at..at + DIGITS].copy_from_slice(digest.as_bytes());
    }
}

/// Whether a file is what it was when it was sealed.
pub(crate) fn holds(bytes: &[u8]) -> bool {
    let Some(at) = place(bytes) else { return false };
    let mut opened = bytes.to_vec();
    opened[at..at + DIGITS].fill(b'0');
    hash(&opened).as_bytes() == &bytes[at..at + DIGITS]
}

fn hash(bytes: &[u8]) -> String {
    hex(&Sha256::digest(bytes))
}

/// Where the digits of the last seal stand.
fn place(bytes: &[u8]) -> Option<usize> {
    let mark = bytes.windows(MARK.len()).rposition(|window| window == MARK.as_bytes())?;
    let at = mark + MARK.len();
    (at + DIGITS <= bytes.len()).then_some(at)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_bit_of_a_sealed_file_can_change_unseen() {
        let mut bytes = format!("rows rows rows {} the end", open()).into_bytes();
        assert!(!holds(&bytes));
        close(&mut bytes);
        assert!(holds(&bytes));
        for bit in 0..8 * bytes.len() {
            let mut changed = bytes.clone();
            changed[bit / 8] ^= 1 << (bit % 8);
            assert!(!holds(&changed), "bit {bit}");
        }
        assert!(!holds(&bytes[..bytes.len() - 1]) && !holds(b""));
    }
}
