//! Declares tables: the struct, its reader, its writer and its keys, each from the same lines.

/// Reads one key: with a default it may be left out.
macro_rules! read_key {
    ($body:ident, $reader:ident, $key:ident, $format:ty) => {
        crate::table::required::<$format>($body, stringify!($key), $reader)
    };
    ($body:ident, $reader:ident, $key:ident, $format:ty, $default:expr) => {
        crate::table::optional::<$format>($body, stringify!($key), $default, $reader)
    };
}

/// Describes one key.
macro_rules! describe_key {
    (@of [$($doc:literal)*] $key:ident, $format:ty, $required:literal, $default:expr) => {
        crate::table::Key {
            name: stringify!($key),
            about: crate::table::about(&[$($doc),*]),
            schema: <$format as crate::format::Format>::schema,
            required: $required,
            default: $default,
        }
    };
    ([$($doc:literal)*] $key:ident, $format:ty) => {
        describe_key!(@of [$($doc)*] $key, $format, true, None)
    };
    ([$($doc:literal)*] $key:ident, $format:ty, $default:expr) => {
        describe_key!(
            @of [$($doc)*] $key, $format, false,
            <$format as crate::format::Written>::default_text(&$default)
        )
    };
}

/// A table: `key: Type as Format`, `= default` where it may be left out, `with` the part that
/// depends on its kind, `either` keys of which one set must be there, `then` a function that sees the whole table once it has been read.
macro_rules! table {
    (
        $(#[doc = $doc:literal])*
        pub struct $table:ident {
            $(
                $(#[doc = $key_doc:literal])*
                $key:ident: $type:ty as $format:ty $(= $default:expr)?
            ),* $(,)?
        }
        $(with {
            $(#[doc = $choice_doc:literal])*
            $choice:ident: $choice_type:ty
        })?
        $(either $($($needed:ident)&+)|+)?
        $(then $settle:path)?
    ) => {
        $(#[doc = $doc])*
        #[derive(Clone, Debug, PartialEq)]
        pub struct $table {
            $($(#[doc = $key_doc])* pub $key: $type,)*
            $($(#[doc = $choice_doc])* pub $choice: $choice_type,)?
        }

        impl crate::table::Table for $table {
            fn about() -> String {
                crate::table::about(&[$($doc),*])
            }

            fn keys() -> Vec<crate::table::Key> {
                vec![$(describe_key!([$($key_doc)*] $key, $format $(, $default)?)),*]
            }

            fn either() -> Vec<Vec<&'static str>> {
                vec![$($(vec![$(stringify!($needed)),+]),+)?]
            }

            fn kinds() -> Option<crate::table::Kinds> {
                $(return Some(crate::table::Kinds {
                    about: crate::table::about(&[$($choice_doc),*]),
                    ..<$choice_type as crate::table::Choice>::kinds()
                });)?
                #[allow(unreachable_code)]
                None
            }

            fn read(body: &Body<'_>, reader: &mut Reader<'_>) -> Option<Self> {
                $(let $key = read_key!(body, reader, $key, $format $(, $default)?);)*
                $(let $choice = <$choice_type as crate::table::Choice>::read(body, reader)?;)?
                #[allow(unused_mut)]
                let mut table = Self { $($key,)* $($choice,)? };
                $($settle(&mut table, body, reader);)?
                Some(table)
            }

            fn placeholder() -> Self {
                Self {
                    $($key: <$format as crate::format::Format>::placeholder(),)*
                    $($choice: <$choice_type as crate::table::Choice>::placeholder(),)?
                }
            }

            fn write(&self, out: &mut Writer) {
                $(<$format as crate::format::Written>::write(&self.$key, stringify!($key), out);)*
                $(crate::table::Choice::write(&self.$choice, out);)?
            }
        }
    };
}

/// The kinds of a table: `Variant = "word" { keys }`, by the key `tag`.
macro_rules! kinds {
    (
        $(#[doc = $doc:literal])*
        pub enum $choice:ident by $tag:literal $(default $default_word:literal)? {
            $(
                $(#[doc = $variant_doc:literal])*
                $variant:ident = $word:literal $({
                    $(
                        $(#[doc = $key_doc:literal])*
                        $key:ident: $type:ty as $format:ty $(= $default:expr)?
                    ),* $(,)?
                })?
            ),* $(,)?
        }
    ) => {
        $(#[doc = $doc])*
        #[derive(Clone, Debug, PartialEq)]
        pub enum $choice {
            $(
                $(#[doc = $variant_doc])*
                $variant $({ $($(#[doc = $key_doc])* $key: $type),* })?
            ),*
        }

        impl crate::table::Choice for $choice {
            fn kinds() -> crate::table::Kinds {
                crate::table::Kinds {
                    tag: $tag,
                    about: String::new(),
                    default: [None, $(Some($default_word))?].into_iter().flatten().next(),
                    variants: vec![$(crate::table::Variant {
                        word: $word,
                        about: crate::table::about(&[$($variant_doc),*]),
                        keys: vec![$($(
                            describe_key!([$($key_doc)*] $key, $format $(, $default)?)
                        ),*)?],
                    }),*],
                }
            }

            fn read(body: &Body<'_>, reader: &mut Reader<'_>) -> Option<Self> {
                let kinds = <Self as crate::table::Choice>::kinds();
                match crate::table::kind(body, &kinds, reader)?.word {
                    $($word => Some(Self::$variant $({
                        $($key: read_key!(body, reader, $key, $format $(, $default)?)),*
                    })?),)*
                    _ => None,
                }
            }

            #[allow(unreachable_code)]
            fn placeholder() -> Self {
                $(return Self::$variant $({
                    $($key: <$format as crate::format::Format>::placeholder()),*
                })?;)*
            }

            fn write(&self, out: &mut Writer) {
                match self {
                    $(Self::$variant $({ $($key),* })? => {
                        out.line($tag, &crate::write::text($word), "");
                        $($(<$format as crate::format::Written>::write(
                            $key, stringify!($key), out
                        );)*)?
                    })*
                }
            }
        }
    };
}
