//! Text of files and of users, as a terminal may show it.

/// A text in which what a terminal would obey, or not show, is written out: `\u{1b}`. Line ends and tabs stay.
///
/// Control characters change colours and titles of a terminal, move its cursor and hide what was reported; marks of the direction of writing
/// and of no width make a name look like another.
pub fn visible(text: &str) -> String {
    written(text, |c| !matches!(c, '\n' | '\t'))
}

/// The same of what is one line: a title, a name, the path of a file.
pub fn visible_line(text: &str) -> String {
    written(text, |_| true)
}

fn written(text: &str, may_be: impl Fn(char) -> bool) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match is_obeyed_or_hidden(c) && may_be(c) {
            true => out.extend(c.escape_default()),
            false => out.push(c),
        }
    }
    out
}

/// The same text with such characters replaced by others of the same length in bytes, so that places in it stay.
pub(crate) fn covered(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match (is_obeyed_or_hidden(c) && !matches!(c, '\n' | '\t'), c.len_utf8()) {
            (false, _) => out.push(c),
            (true, 3) => out.push('\u{fffd}'),
            (true, length) => out.extend(std::iter::repeat_n('?', length)),
        }
    }
    out
}

fn is_obeyed_or_hidden(c: char) -> bool {
    c.is_control()
        || matches!(
            c,
            '\u{61c}'
                | '\u{200b}'..='\u{200f}'
                | '\u{2028}'..='\u{202e}'
                | '\u{2060}'..='\u{206f}'
                | '\u{feff}'
                | '\u{fdd0}'..='\u{fdef}'
                | '\u{fff9}'..='\u{fffb}'
                | '\u{e0000}'..='\u{e007f}'
        )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn control_characters_are_written_out() {
        assert_eq!(visible("a\u{1b}[2Jb\u{9b}31m"), "a\\u{1b}[2Jb\\u{9b}31m");
        assert_eq!(visible("one\n\ttwo\rthree"), "one\n\ttwo\\rthree");
        assert_eq!(visible_line("one\ntwo"), "one\\ntwo");
        assert_eq!(visible("a\u{202e}b\u{200b}c"), "a\\u{202e}b\\u{200b}c");
        let plain = "Träger ± 3 µm, ε = 0.1 %, 梁, 'quoted' \"twice\" back\\slash";
        assert_eq!(visible_line(plain), plain);
        assert_eq!(covered("a\u{1b}b\u{9b}c\u{202e}\n"), "a?b??c\u{fffd}\n");
    }
}
