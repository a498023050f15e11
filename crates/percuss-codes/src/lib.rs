//! The catalogue of what Percuss tells of: every error and every warning has a code, a name and an explanation, which stand here and
//! nowhere else. `percuss explain`, the book and the exceptions of the Python package read them.

#[macro_use]
mod catalogue;

mod faults;
mod findings;

pub use faults::FaultCode;
pub use findings::Topic;

/// An entry of the catalogue.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Code {
    /// `W002`; the same from version to version.
    pub code: &'static str,
    /// A few words.
    pub name: &'static str,
    /// What it means and what to do.
    pub explanation: &'static str,
}

impl Code {
    /// All of them: errors, then warnings, each in the order of their codes.
    pub fn all() -> Vec<Self> {
        let mut all: Vec<Self> = FaultCode::ALL.map(Self::from).into();
        all.extend(Topic::ALL.map(Self::from));
        all
    }

    /// The one of a code, written in large or small letters.
    pub fn find(code: &str) -> Option<Self> {
        Self::all().into_iter().find(|one| one.code.eq_ignore_ascii_case(code))
    }

    /// Whether it stands for an error; else for a warning.
    pub fn is_error(self) -> bool {
        self.code.starts_with('E')
    }
}

impl std::fmt::Display for Code {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.code)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_are_their_own_and_lead_back() {
        let all = Code::all();
        for (k, one) in all.iter().enumerate() {
            assert!(all[..k].iter().all(|other| other.code != one.code), "{one} twice");
            assert_eq!(Code::find(&one.code.to_lowercase()), Some(*one));
            assert!(one.explanation.len() > 80 && !one.name.is_empty(), "{one}");
            assert!(!one.explanation.contains("  "), "{one}: {:?}", one.explanation);
        }
        assert_eq!(Code::find("W000"), None);
    }

    #[test]
    fn codes_count_within_their_group() {
        let mut before = Code { code: "", name: "", explanation: "" };
        for one in Code::all() {
            let number = |code: &Code| code.code[1..].parse::<u32>().unwrap();
            let group = |code: &Code| code.code.chars().take(2).collect::<String>();
            match group(&before) == group(&one) {
                true => assert_eq!(number(&one), number(&before) + 1, "{one}"),
                false => assert!(number(&one) % 100 == 1, "{one} begins a group"),
            }
            before = one;
        }
    }
}
