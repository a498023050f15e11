//! How a group of codes is declared: the kinds and, beside each, its code, its name and what it means.

/// Declares a group of codes. A kind cannot be declared without its words, nor be left out of `ALL`.
macro_rules! catalogue {
    (
        $(#[doc = $doc:literal])*
        pub enum $group:ident {
            $(
                $(#[doc = $about:literal])*
                $kind:ident = $code:literal, $name:literal, $explanation:literal;
            )+
        }
    ) => {
        $(#[doc = $doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum $group {
            $($(#[doc = $about])* $kind,)+
        }

        impl $group {
            /// All of them, in the order of their codes.
            pub const ALL: [Self; [$($code),+].len()] = [$(Self::$kind),+];

            /// Its code, which stays the same from version to version.
            pub fn code(self) -> &'static str {
                match self {
                    $(Self::$kind => $code,)+
                }
            }

            /// Its name in a few words.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$kind => $name,)+
                }
            }

            /// What it means, why it matters, and what to do.
            pub fn explanation(self) -> &'static str {
                match self {
                    $(Self::$kind => $explanation,)+
                }
            }

            /// The kind of a code, written in large or small letters.
            pub fn of_code(code: &str) -> Option<Self> {
                Self::ALL.into_iter().find(|one| one.code().eq_ignore_ascii_case(code))
            }
        }

        impl From<$group> for crate::Code {
            fn from(one: $group) -> Self {
                Self { code: one.code(), name: one.name(), explanation: one.explanation() }
            }
        }
    };
}
