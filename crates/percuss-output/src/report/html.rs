//! Text into HTML.

use std::fmt::Write as _;

/// `text` where HTML expects text or a quoted attribute.
pub(crate) fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            _ => out.push(c),
        }
    }
    out
}

/// Sentences as HTML, in which numbers with an exponent such as `4e-15` are not broken across lines.
pub(super) fn sentences(text: &str) -> String {
    let word = |word: &str| {
        let number = word.trim_end_matches(['.', ',', ';', ':', ')']);
        let whole = number.contains("e-") && number.parse::<f64>().is_ok();
        if whole { format!("<span class=\"whole\">{}</span>", escape(word)) } else { escape(word) }
    };
    text.split(' ').map(word).collect::<Vec<_>>().join(" ")
}

/// JSON inside a `<script>` element: no `<` is left to end it early.
pub(super) fn json(value: &serde_json::Value) -> String {
    value.to_string().replace('<', "\\u003c").replace('>', "\\u003e").replace('&', "\\u0026")
}

/// Content of a cell.
#[derive(Clone, Debug)]
pub(crate) enum Cell {
    /// Text, escaped where it is written.
    Text(String),
    /// Markup of our own, in which all of the users' text is escaped.
    Markup(String),
}

impl From<String> for Cell {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

/// A table: header cells, then rows; all cells are escaped here. The first column heads its row.
pub(crate) fn table(caption: &str, header: &[&str], rows: &[Vec<String>]) -> String {
    let cells = |row: &Vec<String>| row.iter().cloned().map(Cell::Text).collect();
    table_of_cells(caption, header, &rows.iter().map(cells).collect::<Vec<_>>())
}

/// The same with cells of markup among them.
pub(crate) fn table_of_cells(caption: &str, header: &[&str], rows: &[Vec<Cell>]) -> String {
    let plain = |cells: &Vec<Cell>| Row { cells: cells.clone(), attributes: String::new() };
    table_of_rows(caption, header, &rows.iter().map(plain).collect::<Vec<_>>())
}

/// A row of a table.
#[derive(Clone, Debug)]
pub(crate) struct Row {
    /// Its cells, shape (cells).
    pub cells: Vec<Cell>,
    /// Attributes of its element, markup of our own.
    pub attributes: String,
}

/// The same with attributes of the rows.
pub(crate) fn table_of_rows(caption: &str, header: &[&str], rows: &[Row]) -> String {
    let mut out = format!("<div class=\"table\"><table><caption>{}</caption>\n", escape(caption));
    if !header.is_empty() {
        out.push_str("<thead><tr>");
        for cell in header {
            let _ = write!(out, "<th scope=\"col\">{}</th>", escape(cell));
        }
        out.push_str("</tr></thead>\n");
    }
    out.push_str("<tbody>\n");
    for row in rows {
        let space = if row.attributes.is_empty() { "" } else { " " };
        let _ = write!(out, "<tr{space}{}>", row.attributes);
        for (k, cell) in row.cells.iter().enumerate() {
            let content = match cell {
                Cell::Text(text) => escape(text),
                Cell::Markup(markup) => markup.clone(),
            };
            let _ = match k {
                0 => write!(out, "<th scope=\"row\">{content}</th>"),
                _ => write!(out, "<td>{content}</td>"),
            };
        }
        out.push_str("</tr>\n");
    }
    out.push_str("</tbody></table></div>\n");
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn markup_becomes_text() {
        assert_eq!(
            escape("<b a=\"1\" b='2'>&</b>"),
            "&lt;b a=&quot;1&quot; b=&#39;2&#39;&gt;&amp;&lt;/b&gt;"
        );
    }

    #[test]
    fn numbers_with_an_exponent_are_kept_whole() {
        assert_eq!(
            sentences("Error 4e-15 of <2> J. Factor 1e-3."),
            "Error <span class=\"whole\">4e-15</span> of &lt;2&gt; J. Factor <span class=\"whole\">1e-3.</span>"
        );
    }

    #[test]
    fn a_script_element_cannot_be_ended_from_within_its_data() {
        let value = serde_json::json!({ "title": "</script><!--<script>" });
        let text = json(&value);
        assert!(!text.contains('<') && !text.contains('>'));
        assert_eq!(serde_json::from_str::<serde_json::Value>(&text).ok(), Some(value));
    }
}
