//! Foundations in words.

use percuss::FoundationProperties;

use crate::number::quantity;

/// Where a foundation is, its law, and its stiffness per length if it has one.
pub fn foundation_place(of: &FoundationProperties) -> Vec<String> {
    let [from, to] = of.stretch.map(|s| quantity(s, "m"));
    let mut parts = vec![format!("'{}' from s = {from} to {to}", of.beam)];
    parts.push(match of.stiffness {
        Some(stiffness) => format!("{} {}", of.kind.name(), quantity(stiffness, "N/m^2")),
        None => of.kind.name().to_owned(),
    });
    parts
}

#[cfg(test)]
mod tests {
    use percuss::FoundationKind;

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
        assert!(parts[1].starts_with("linear 5"), "{parts:?}");
    }
}
