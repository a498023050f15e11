//! Foundations in words.

use percuss::{FoundationKind, FoundationProperties};

use crate::number::quantity;

/// Where a foundation is, its law, and its stiffness per length if it has one.
pub fn foundation_place(of: &FoundationProperties) -> Vec<String> {
    let [from, to] = of.stretch.map(|s| quantity(s, "m"));
    let mut parts = vec![format!("'{}' from s = {from} to {to}", of.beam)];
    let law = match of.kind {
        FoundationKind::Compression => "compression only",
        kind => kind.name(),
    };
    parts.push(match of.stiffness {
        Some(stiffness) => format!("{law}, {}", quantity(stiffness, "N/m^2")),
        None => law.to_owned(),
    });
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_foundation_is_named_by_its_beam_and_law() {
        let of = |kind, stiffness| FoundationProperties {
            beam: "rail".to_owned(),
            stretch: [0.0, 6.0],
            kind,
            stiffness,
        };
        let parts = foundation_place(&of(FoundationKind::Table, None));
        assert_eq!(parts, ["'rail' from s = 0 m to 6 m", "table"]);
        let parts = foundation_place(&of(FoundationKind::Linear, Some(5e6)));
        assert_eq!(parts[1], "linear, 5 MN/m\u{b2}");
        let parts = foundation_place(&of(FoundationKind::Compression, Some(3e7)));
        assert_eq!(parts[1], "compression only, 30 MN/m\u{b2}");
    }
}
