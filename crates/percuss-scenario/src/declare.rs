//! Declares tables: the struct, its reader, its writer and its keys, each from the same lines.

/// The name of a key in the file: a word that Rust keeps for itself has a mark before it.
pub(crate) fn name_of(key: &'static str) -> &'static str {
    key.strip_prefix("r#").unwrap_or(key)
}

/// Reads one key: with a default it may be left out.
macro_rules! read_key {
    ($body:ident, $reader:ident, $key:ident, $format:ty) => {
        crate::table::required::<$format>($body, crate::declare::name_of(stringify!($key)), $reader)
    };
    ($body:ident, $reader:ident, $key:ident, $format:ty, $default:expr) => {
        crate::table::optional::<$format>(
            $body,
            crate::declare::name_of(stringify!($key)),
            $default,
            $reader,
        )
    };
}

/// Describes one key.
macro_rules! describe_key {
    (@of [$($doc:literal)*] $key:ident, $format:ty, $required:literal, $default:expr) => {
        crate::layout::Key {
            name: crate::declare::name_of(stringify!($key)),
            about: crate::layout::about(&[$($doc),*]),
            schema: <$format as crate::format::Format>::schema,
            described: <$format as crate::format::Format>::described,
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

/// Describes keys and parts that stand together.
macro_rules! layout {
    (
        [$($doc:literal)*]
        $([$($key_doc:literal)*] $key:ident: $format:ty $(= $default:expr)?;)*
        $(with [$($part_doc:literal)*] $part:ty;)*
    ) => {
        crate::layout::Layout {
            about: crate::layout::about(&[$($doc),*]),
            keys: vec![$(describe_key!([$($key_doc)*] $key, $format $(, $default)?)),*],
            ..crate::layout::Layout::default()
        }
        $(.with(
            crate::layout::about(&[$($part_doc),*]),
            <$part as crate::table::Part>::layout(),
        ))*
    };
}

/// Follows a path to one of the keys, or into one of the parts.
macro_rules! reach_key {
    ($path:expr, [$($key:ident: $format:ty = $value:expr;)*] [$($part:expr),*]) => {{
        let Some((step, rest)) = $path.split_first() else {
            return Err(crate::reach::Lost::Table);
        };
        let _ = rest;
        $(if step == crate::declare::name_of(stringify!($key)) {
            return <$format as crate::format::Format>::reach($value, rest)
                .map_err(crate::reach::Lost::deeper);
        })*
        #[allow(unused_mut, reason = "not every table has what changes it")]
        let mut known: Vec<String> = vec![$(crate::declare::name_of(stringify!($key)).to_string()),*];
        $(match crate::table::Part::reach($part, $path) {
            Err(crate::reach::Lost::Unknown { depth: 0, known: more, .. }) => known.extend(more),
            reached => return reached,
        })*
        Err(crate::reach::Lost::key(step, known))
    }};
}

/// A table, or keys that stand together in several of them: `key: Type as Format`, `= default` where it may be left out, `with`
/// parts whose keys stand beside them, `either` keys of which one set must be there, `not` keys that people look for in vain
/// with what stands here instead, `only` a part whose keys belong to one kind of another part, `then` a function that sees the whole table once it has been read.
macro_rules! table {
    (
        $(#[doc = $doc:literal])*
        pub struct $table:ident {
            $(
                $(#[doc = $key_doc:literal])*
                $key:ident: $type:ty as $format:ty $(= $default:expr)?
            ),* $(,)?
        }
        $(with {$(
            $(#[doc = $part_doc:literal])*
            $part:ident: $part_type:ty
        ),+ $(,)?})?
        $(either $($($needed:ident)&+)|+)?
        $(not { $($refused:ident: $instead:expr),+ $(,)? })?
        $(only $bound:ty: $bound_tag:literal = $bound_word:literal)?
        $(then $settle:path)?
    ) => {
        $(#[doc = $doc])*
        #[derive(Clone, Debug, PartialEq)]
        pub struct $table {
            $($(#[doc = $key_doc])* pub $key: $type,)*
            $($($(#[doc = $part_doc])* pub $part: $part_type,)+)?
        }

        impl crate::table::Declared for $table {
            fn declared() -> &'static crate::layout::Layout {
                static ONCE: std::sync::LazyLock<crate::layout::Layout> =
                    std::sync::LazyLock::new(<$table as crate::table::Part>::layout);
                &ONCE
            }
        }

        impl crate::table::Part for $table {
            fn layout() -> crate::layout::Layout {
                let layout = layout! {
                    [$($doc)*]
                    $([$($key_doc)*] $key: $format $(= $default)?;)*
                    $($(with [$($part_doc)*] $part_type;)+)?
                };
                layout
                    .either(vec![$($(vec![$(crate::declare::name_of(stringify!($needed))),+]),+)?])
                    .not(vec![$($((stringify!($refused), $instead)),+)?])
                    .only(vec![$(crate::layout::Bound::of(
                        &<$bound as crate::table::Part>::layout(), $bound_tag, $bound_word
                    ))?])
            }

            fn read(body: &Body<'_>, reader: &mut Reader<'_>) -> Option<Self> {
                $(let $key = read_key!(body, reader, $key, $format $(, $default)?);)*
                $($(let $part = <$part_type as crate::table::Part>::read(body, reader);)+)?
                #[allow(unused_mut, reason = "not every table has what changes it")]
                let mut table = Self { $($key,)* $($($part: $part?,)+)? };
                $($settle(&mut table, body, reader);)?
                Some(table)
            }

            fn placeholder() -> Self {
                Self {
                    $($key: <$format as crate::format::Format>::placeholder(),)*
                    $($($part: <$part_type as crate::table::Part>::placeholder(),)+)?
                }
            }

            fn write(&self, out: &mut Writer) {
                $(<$format as crate::format::Written>::write(&self.$key, crate::declare::name_of(stringify!($key)), out);)*
                $($(crate::table::Part::write(&self.$part, out);)+)?
            }

            fn reach<'c>(&'c mut self, path: &[String]) -> crate::reach::Reached<'c> {
                reach_key!(
                    path,
                    [$($key: $format = &mut self.$key;)*]
                    [$($(&mut self.$part),+)?]
                )
            }
        }
    };
}

/// The kinds of a table: `Variant = "word" { keys } with { parts }`, by the key `tag`, one of them `implied` by a key of its own where `tag` is not
/// given; `or` another part that comes in more
/// kinds by the same key.
macro_rules! kinds {
    (
        $(#[doc = $doc:literal])*
        pub enum $choice:ident by $tag:literal $(default $default_word:literal)?
            $(implied $implied_word:literal by $implied_key:literal)? {
            $(
                $(#[doc = $variant_doc:literal])*
                $variant:ident = $word:literal $({
                    $(
                        $(#[doc = $key_doc:literal])*
                        $key:ident: $type:ty as $format:ty $(= $default:expr)?
                    ),* $(,)?
                } $(with {$(
                    $(#[doc = $part_doc:literal])*
                    $part:ident: $part_type:ty
                ),+ $(,)?})?)?
            ),* $(,)?
        }
        $(or {
            $(#[doc = $other_doc:literal])*
            $other:ident: $other_type:ty
        })?
    ) => {
        $(#[doc = $doc])*
        #[derive(Clone, Debug, PartialEq)]
        pub enum $choice {
            $(
                $(#[doc = $variant_doc])*
                $variant $({
                    $($(#[doc = $key_doc])* $key: $type,)*
                    $($($(#[doc = $part_doc])* $part: $part_type,)+)?
                })?,
            )*
            $($(#[doc = $other_doc])* $other($other_type),)?
        }

        impl $choice {
            pub(crate) fn kinds() -> crate::layout::Kinds {
                let mut variants = vec![$(crate::layout::Variant {
                    word: $word,
                    layout: layout! {
                        [$($variant_doc)*]
                        $($([$($key_doc)*] $key: $format $(= $default)?;)*
                        $($(with [$($part_doc)*] $part_type;)+)?)?
                    },
                }),*];
                let others: Vec<crate::layout::Layout> =
                    vec![$(<$other_type as crate::table::Part>::layout())?];
                variants.extend(others.into_iter().flat_map(crate::layout::Layout::distributed));
                crate::layout::Kinds {
                    tag: $tag,
                    about: String::new(),
                    default: [None, $(Some($default_word))?].into_iter().flatten().next(),
                    implied: [None, $(Some(($implied_key, $implied_word)))?].into_iter().flatten().next(),
                    variants,
                }
            }
        }

        impl crate::table::Declared for $choice {
            fn declared() -> &'static crate::layout::Layout {
                static ONCE: std::sync::LazyLock<crate::layout::Layout> =
                    std::sync::LazyLock::new(<$choice as crate::table::Part>::layout);
                &ONCE
            }
        }

        impl crate::table::Part for $choice {
            fn layout() -> crate::layout::Layout {
                crate::layout::Layout {
                    about: crate::layout::about(&[$($doc),*]),
                    choices: vec![Self::kinds()],
                    ..crate::layout::Layout::default()
                }
            }

            fn read(body: &Body<'_>, reader: &mut Reader<'_>) -> Option<Self> {
                match <Self as crate::table::Declared>::declared().choices[0].read(body, reader)?.word {
                    $($word => {
                        $($(let $key = read_key!(body, reader, $key, $format $(, $default)?);)*
                        $($(let $part = <$part_type as crate::table::Part>::read(body, reader);)+)?)?
                        Some(Self::$variant $({ $($key,)* $($($part: $part?,)+)? })?)
                    })*
                    $(_ => <$other_type as crate::table::Part>::read(body, reader).map(Self::$other),)?
                    #[allow(unreachable_patterns)]
                    _ => None,
                }
            }

            #[allow(unreachable_code)]
            fn placeholder() -> Self {
                $(return Self::$variant $({
                    $($key: <$format as crate::format::Format>::placeholder(),)*
                    $($($part: <$part_type as crate::table::Part>::placeholder(),)+)?
                })?;)*
            }

            fn write(&self, out: &mut Writer) {
                match self {
                    $(Self::$variant $({ $($key,)* $($($part,)+)? })? => {
                        out.line($tag, &crate::write::text($word), "");
                        $($(<$format as crate::format::Written>::write(
                            $key, crate::declare::name_of(stringify!($key)), out
                        );)*
                        $($(crate::table::Part::write($part, out);)+)?)?
                    })*
                    $(Self::$other(part) => crate::table::Part::write(part, out),)?
                }
            }

            fn reach<'c>(&'c mut self, path: &[String]) -> crate::reach::Reached<'c> {
                if path.first().is_some_and(|step| step == $tag) {
                    return Err(crate::reach::Lost::Reread);
                }
                match self {
                    $(Self::$variant $({ $($key,)* $($($part,)+)? })? => reach_key!(
                        path,
                        [$($($key: $format = $key;)*)?]
                        [$($($($part),+)?)?]
                    ),)*
                    $(Self::$other(part) => crate::table::Part::reach(part, path),)?
                }
            }
        }
    };
}
