//! What may stand in a table: keys, and choices of kinds that bring more of them.

use serde_json::Value as Json;

use crate::code::FaultCode;
use crate::node::{Body, Reader};
use crate::source::join;
use crate::suggest;

/// A key of a table.
#[derive(Clone)]
pub(crate) struct Key {
    pub name: &'static str,
    pub about: String,
    /// Its JSON Schema; made only when asked for, for readers want none.
    pub schema: fn() -> Json,
    /// What a reference says of its form.
    pub described: fn() -> Described,
    /// Whether it must be there.
    pub required: bool,
    /// Its default as TOML, if it has one that can be written.
    pub default: Option<String>,
}

/// One of the kinds a table can be of.
#[derive(Clone)]
pub(crate) struct Variant {
    pub word: &'static str,
    /// What it brings.
    pub layout: Layout,
}

/// The key that says of which kind a table is, and the kinds.
#[derive(Clone)]
pub(crate) struct Kinds {
    pub tag: &'static str,
    pub about: String,
    pub default: Option<&'static str>,
    /// A key that implies a kind where nothing is said of it, and that kind.
    pub implied: Option<(&'static str, &'static str)>,
    /// The kinds, shape (kinds).
    pub variants: Vec<Variant>,
}

/// What may stand in a table, or comes into it with one of its kinds.
#[derive(Clone, Default)]
pub(crate) struct Layout {
    pub about: String,
    /// The keys, shape (keys).
    pub keys: Vec<Key>,
    /// Sets of keys that may be left out, of which one set must be there; of tables without kinds, shape (sets, keys of one).
    pub either: Vec<Vec<&'static str>>,
    /// Keys that people look for here in vain, and what stands here instead, shape (keys).
    pub refused: Vec<(&'static str, &'static str)>,
    /// Keys of one kind that another choice brings, shape (parts).
    pub bound: Vec<Bound>,
    /// Choices of kinds, shape (choices).
    pub choices: Vec<Kinds>,
}

/// Keys that one choice of kinds brings, and that count only with one kind of another choice.
#[derive(Clone)]
pub(crate) struct Bound {
    /// The keys, shape (keys).
    keys: Vec<&'static str>,
    tag: &'static str,
    word: &'static str,
}

impl Bound {
    /// The keys of a part count only where `tag` is `word`.
    pub fn of(part: &Layout, tag: &'static str, word: &'static str) -> Self {
        let keys = part.keys.iter().map(|key| key.name).collect();
        Self { keys, tag, word }
    }
}

/// A key that stands in another kind than the one chosen.
struct Elsewhere<'l> {
    kinds: &'l Kinds,
    owner: &'l Variant,
    /// `None` where the kind is not known.
    chosen: Option<&'l Variant>,
}

/// Joins the lines of a doc comment.
pub(crate) fn about(lines: &[&str]) -> String {
    lines.iter().map(|l| l.trim()).collect::<Vec<_>>().join(" ").trim().to_string()
}

impl Key {
    /// The same key, which may be left out.
    pub fn optional(self) -> Self {
        Self { required: false, default: None, ..self }
    }
}

impl Kinds {
    /// The kind of a table; nothing is said of one that is not known.
    fn chosen(&self, body: &Body<'_>) -> Option<&Variant> {
        let node = body.get(self.tag);
        let implied = self.implied.filter(|(key, _)| body.get(key).is_some());
        let unsaid = implied.map_or(self.default, |(_, word)| Some(word));
        let word = node.as_ref().map_or(unsaid, |node| node.value.as_str());
        self.variants.iter().find(|v| Some(v.word) == word)
    }

    /// The kind of a table, with a fault where it is not known.
    pub fn read(&self, body: &Body<'_>, reader: &mut Reader<'_>) -> Option<&Variant> {
        let words = || self.variants.iter().map(|v| v.word);
        let chosen = self.chosen(body);
        match body.get(self.tag) {
            Some(node) if chosen.is_none() => {
                let word = node.value.as_str().unwrap_or("");
                reader.wrong_as(
                    FaultCode::UnknownName,
                    &node,
                    node.found(),
                    suggest::one_of(word, words()),
                );
            }
            None if chosen.is_none() => {
                let found = format!("no `{}`", self.tag);
                reader.missing(body, self.tag, found, suggest::one_of("", words()));
            }
            _ => {}
        }
        chosen
    }
}

impl Layout {
    /// With the keys and choices of a part of the table; `about` is said of its choice.
    pub fn with(mut self, about: String, part: Self) -> Self {
        self.keys.extend(part.keys);
        self.refused.extend(part.refused);
        for mut kinds in part.choices {
            if kinds.about.is_empty() {
                kinds.about.clone_from(&about);
            }
            self.choices.push(kinds);
        }
        self
    }

    /// With sets of keys of which one must be there.
    pub fn either(self, either: Vec<Vec<&'static str>>) -> Self {
        Self { either, ..self }
    }

    /// With keys that people look for in vain.
    pub fn not(mut self, refused: Vec<(&'static str, &'static str)>) -> Self {
        self.refused.extend(refused);
        self
    }

    /// With keys that belong to one kind only.
    pub fn only(self, bound: Vec<Bound>) -> Self {
        Self { bound, ..self }
    }

    /// The kinds that the keys bound to a kind miss, with the kind chosen.
    fn unmet(&self, body: &Body<'_>) -> Vec<(&Bound, &Variant)> {
        let chosen = |bound: &Bound| {
            let kinds = self.choices.iter().find(|kinds| kinds.tag == bound.tag);
            kinds.and_then(|kinds| kinds.chosen(body)).filter(|chosen| chosen.word != bound.word)
        };
        self.bound.iter().filter_map(|bound| chosen(bound).map(|is| (bound, is))).collect()
    }

    /// The kinds of its choices, each with what stands beside them.
    pub fn distributed(self) -> Vec<Variant> {
        let Self { keys, refused, choices, .. } = self;
        let beside = Self { keys, refused, ..Self::default() };
        let with = |Variant { word, layout }| {
            let layout = layout.with(String::new(), beside.clone());
            Variant { word, layout }
        };
        choices.into_iter().flat_map(|kinds| kinds.variants).map(with).collect()
    }

    /// All layouts that count in a table: this one, and those of the kinds chosen.
    fn active(&self, body: &Body<'_>) -> Vec<&Self> {
        let chosen = self.choices.iter().filter_map(|kinds| kinds.chosen(body));
        [self].into_iter().chain(chosen.flat_map(|v| v.layout.active(body))).collect()
    }

    /// Whether it knows a key, in whatever kind.
    fn knows(&self, key: &str) -> bool {
        let within = |kinds: &Kinds| {
            kinds.tag == key || kinds.variants.iter().any(|variant| variant.layout.knows(key))
        };
        self.keys.iter().any(|k| k.name == key) || self.choices.iter().any(within)
    }

    fn elsewhere(&self, key: &str, body: &Body<'_>) -> Option<Elsewhere<'_>> {
        self.choices.iter().find_map(|kinds| {
            let chosen = kinds.chosen(body);
            kinds.variants.iter().find_map(|owner| match chosen {
                Some(chosen) if chosen.word == owner.word => owner.layout.elsewhere(key, body),
                _ => owner.layout.knows(key).then_some(Elsewhere { kinds, owner, chosen }),
            })
        })
    }

    /// Tells of every key of a table that does not belong there.
    pub fn check_keys(&self, body: &Body<'_>, reader: &mut Reader<'_>) {
        let active = self.active(body);
        let unmet = self.unmet(body);
        let missed = |key: &str| unmet.iter().find(|(bound, _)| bound.keys.contains(&key));
        let keys = active.iter().flat_map(|layout| &layout.keys).map(|key| key.name);
        let keys = keys.filter(|key| missed(key).is_none());
        let tags = active.iter().flat_map(|layout| &layout.choices).map(|kinds| kinds.tag);
        let names: Vec<&str> = keys.chain(tags).collect();
        let expected = |key: &str| suggest::one_of(key, names.iter().copied());
        let implying = implying(&active, body);
        for (key, span) in body.keys() {
            if names.contains(&key) {
                continue;
            }
            let (found, expected) = match self.elsewhere(key, body) {
                _ if let Some((Bound { tag, word, .. }, is)) = missed(key) => {
                    let expected = format!("{} for {tag} = \"{}\"", expected(""), is.word);
                    (format!("`{key}`, which belongs to {tag} = \"{word}\""), expected)
                }
                Some(Elsewhere { kinds: Kinds { tag, .. }, owner, chosen: Some(chosen) }) => {
                    let expected = format!("{} for {tag} = \"{}\"", expected(""), chosen.word);
                    (format!("`{key}`, which belongs to {tag} = \"{}\"", owner.word), expected)
                }
                Some(_) => continue, // may belong: the kind is not known
                None if let Some(meant) = implying.iter().find(|one| meant(one, key, &names)) => {
                    // The kind that it implies has keys of its own: none of these is missed.
                    let excused =
                        names.iter().map(|name| (join(&body.path, name), body.span.start));
                    reader.excused.extend(excused);
                    (format!("the unknown key `{key}`"), format!("`{meant}`"))
                }
                None => {
                    if let Some(meant) = suggest::nearest(key, names.iter().copied()) {
                        reader.excused.insert((join(&body.path, meant), body.span.start));
                    }
                    (format!("the unknown key `{key}`"), expected(key))
                }
            };
            let mut refused = active.iter().flat_map(|layout| &layout.refused);
            let instead = refused.find(|(name, _)| *name == key).map(|(_, instead)| *instead);
            let expected = instead.map_or(expected, str::to_string);
            let path = join(&body.path, key);
            reader.misplaced_as(FaultCode::UnknownKey, &path, span, (found, expected));
        }
    }
}

/// Keys that would imply a kind where none is named, shape (keys).
fn implying(active: &[&Layout], body: &Body<'_>) -> Vec<&'static str> {
    let choices = active.iter().flat_map(|layout| &layout.choices);
    let unsaid = choices.filter(|kinds| body.get(kinds.tag).is_none());
    unsaid.filter_map(|kinds| kinds.implied).map(|(key, _)| key).collect()
}

/// Whether a misspelt key is nearer to `implying` than to every one of `names`.
fn meant(implying: &str, key: &str, names: &[&str]) -> bool {
    suggest::nearest(key, names.iter().copied().chain([implying])) == Some(implying)
}

/// What the form of a value says of itself.
#[derive(Clone, Default)]
pub(crate) struct Described {
    /// What is expected, with an example.
    pub expected: String,
    /// SI unit of a bare number.
    pub unit: &'static str,
    /// Words that may stand here, and what they mean, shape (words).
    pub words: Vec<(&'static str, &'static str)>,
    /// The table that stands behind the key.
    pub table: Option<Inner>,
}

/// A table that stands behind a key.
#[derive(Clone)]
pub(crate) struct Inner {
    /// Name of its declaration.
    pub name: &'static str,
    pub form: TableForm,
    pub layout: fn() -> Layout,
}

/// How a table stands in the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TableForm {
    /// The file itself.
    File,
    /// Once, under its header: `[time]`.
    Once,
    /// As often as wanted, with names of the user's: `[beam.NAME]`.
    Named,
    /// In braces behind a key of another table.
    Braces,
}
