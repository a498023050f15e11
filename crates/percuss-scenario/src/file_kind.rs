//! What a file is meant to be: a scenario, a study or a fit.

use toml::de::DeTable;

use crate::diagnostic::Diagnostics;

/// What a file contains.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum FileKind {
    /// A scenario.
    Scenario,
    /// A study, which varies a scenario.
    Study,
    /// A fit of parameters of a scenario to measured curves.
    Fit,
}

impl FileKind {
    /// It in words, what it does, and the command for it.
    fn words(self) -> [&'static str; 3] {
        match self {
            Self::Scenario => ["a scenario", "which describes one run", "`percuss run`"],
            Self::Study => ["a study", "which varies a scenario", "`percuss sweep`"],
            Self::Fit => ["a fit", "which finds numbers of a scenario", "`percuss fit`"],
        }
    }

    /// Refuses a text that is clearly a file of another kind: its keys would all be reported one by one.
    ///
    /// # Errors
    /// What it is, and the command for it.
    pub fn expect(self, text: &str, name: &str) -> Result<(), Diagnostics> {
        type Test = fn(&str) -> bool;
        let kinds: [(Self, Test); 3] =
            [(Self::Fit, is_fit), (Self::Study, is_study), (Self::Scenario, is_scenario)];
        let Some((other, _)) = kinds.into_iter().find(|(kind, is)| *kind != self && is(text))
        else {
            return Ok(());
        };
        let ([found, does, command], [wanted, ..]) = (other.words(), self.words());
        let expected = format!("{wanted}; for {found} there is {command}");
        Err(Diagnostics::of_file(name, format!("{found}, {does}"), expected))
    }
}

/// Whether a text is meant to be a scenario: it has a table of one, and none of a study or a fit.
fn is_scenario(text: &str) -> bool {
    let (root, _) = DeTable::parse_recoverable(text);
    let any = |keys: &[&str]| keys.iter().any(|key| root.get_ref().get(*key).is_some());
    any(&["beam", "projectile", "time"])
        && !any(&["base", "scenario", "parameter", "design", "results", "fit", "test"])
}

/// Whether a text is meant to be a study and not a scenario or a fit: it names a base or parameters.
pub fn is_study(text: &str) -> bool {
    const KEYS: [&str; 3] = ["base", "parameter", "design"];
    // Most scenarios are known by this, without being parsed; a key in quotes may be spelt with escapes.
    if !KEYS.iter().any(|key| text.contains(key)) && !text.contains('\\') {
        return false;
    }
    let (root, _) = DeTable::parse_recoverable(text);
    let root = root.get_ref();
    let another = ["beam", "fit", "test"].iter().any(|key| root.get(*key).is_some());
    KEYS.iter().any(|key| root.get(*key).is_some()) && !another
}

/// Whether a text is meant to be a fit: it has a table `[fit]` or tests.
pub fn is_fit(text: &str) -> bool {
    if !text.contains("fit") && !text.contains("test") {
        return false;
    }
    let (root, _) = DeTable::parse_recoverable(text);
    ["fit", "test"].iter().any(|key| root.get_ref().get(*key).is_some())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_of_another_kind_is_named_with_its_command() {
        let scenario = "[beam.a]\nelements = 2\n[time]\nend = 1\n";
        let study = "base = \"a.toml\"\n[parameter.k]\n[design]\n[results]\n";
        let fit = "base = \"a.toml\"\n[fit]\n[parameter.k]\n[test.one]\n";
        let kinds =
            [(FileKind::Scenario, scenario), (FileKind::Study, study), (FileKind::Fit, fit)];
        for (wanted, _) in kinds {
            for (kind, text) in kinds {
                match wanted.expect(text, "a.toml") {
                    Ok(()) => assert_eq!(kind, wanted),
                    Err(refused) => {
                        assert_ne!(kind, wanted);
                        let [what, _, command] = kind.words();
                        let refused = refused.to_string();
                        assert!(refused.contains(what) && refused.contains(command), "{refused}");
                    }
                }
            }
        }
        // What lacks its own table is reported key by key.
        let without = fit.replace("[fit]\n", "");
        assert!(FileKind::Fit.expect(&without, "a.toml").is_ok() && !is_study(&without));
        let mixed = format!("{study}[time]\nend = 1\n");
        assert!(FileKind::Study.expect(&mixed, "a.toml").is_ok());
        assert!(FileKind::Study.expect("base = \"a.toml\"\n", "a.toml").is_ok());
    }
}
