//! The catalogue of errors and warnings: each has a code, a name and an explanation, which are written here and
//! nowhere else. `percuss explain`, the book and the exceptions of the Python package read them.

#[macro_use]
mod catalogue;

mod analyses;
mod cautions;
mod faults;
mod files;
mod findings;
mod requests;

pub use analyses::AnalysisCode;
pub use cautions::Caution;
pub use faults::FaultCode;
pub use files::FileCode;
pub use findings::Topic;
pub use requests::RequestCode;

/// Codes that belong together, in the order of their numbers.
#[derive(Clone, Debug)]
pub struct Group {
    /// What they are about.
    pub name: &'static str,
    /// Their consequence for the user.
    pub about: &'static str,
    /// The codes, shape (codes).
    pub codes: Vec<Code>,
}

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
    /// All of them in their groups: errors, then warnings.
    pub fn groups() -> [Group; 6] {
        [
            Group {
                name: "Errors of scenarios, studies and changes",
                about: "A file with an error is not run. All errors of a file are reported together.",
                codes: FaultCode::ALL.map(Self::from).into(),
            },
            Group {
                name: "Analyses without a result",
                about: "The file is valid, but the solver has no result, or none up to the end.",
                codes: AnalysisCode::ALL.map(Self::from).into(),
            },
            Group {
                name: "Files and directories",
                about: "Results could not be read or written. Existing results are unchanged.",
                codes: FileCode::ALL.map(Self::from).into(),
            },
            Group {
                name: "Studies, clusters and requests",
                about: "A command cannot meet a request.",
                codes: RequestCode::ALL.map(Self::from).into(),
            },
            Group {
                name: "Model and result checks",
                about: "The run continues; its results may be inaccurate, or depend on mesh and step.",
                codes: Topic::ALL.map(Self::from).into(),
            },
            Group {
                name: "Warnings of runs and commands",
                about: "W101 to W105 come from the audit of a finished run; the others report on a command.",
                codes: Caution::ALL.map(Self::from).into(),
            },
        ]
    }

    /// All of them: errors, then warnings, each in the order of their codes.
    pub fn all() -> Vec<Self> {
        Self::groups().into_iter().flat_map(|group| group.codes).collect()
    }

    /// Those that a scenario may accept: those of the model and result checks and of the audit of a run.
    pub fn allowable() -> Vec<Self> {
        let audit = Caution::ALL.into_iter().filter(|one| one.is_of_the_audit());
        Topic::ALL.into_iter().map(Self::from).chain(audit.map(Self::from)).collect()
    }

    /// A message with the code behind it, as every message has it: `no such file [E001]`.
    pub fn behind(self, text: impl std::fmt::Display) -> String {
        format!("{text} [{}]", self.code)
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
