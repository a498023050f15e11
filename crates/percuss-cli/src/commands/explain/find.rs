//! Tables, keys and words of a file format, by the names that files have for them.

use percuss_scenario::{BodyReference, KeyReference, KindsReference, TableForm, TableReference};

/// The meaning of a name at one location of a format.
#[derive(Debug)]
pub struct Found<'r> {
    /// Paths of the table or key, as in `percuss explain PATH`, shape (paths).
    pub paths: Vec<String>,
    /// Kinds of the table for which it is there, each as `kind = "word"`, shape (kinds).
    pub kinds: Vec<String>,
    pub meaning: Meaning<'r>,
}

/// A table, a key, or a word that a key takes.
#[derive(Debug)]
pub enum Meaning<'r> {
    Table(&'r TableReference),
    Key(&'r KeyReference),
    /// A key whose words are kinds of the table.
    Choice(&'r KindsReference),
    /// One of these words.
    Kind(&'r str, &'r BodyReference),
    /// A word of another key, and its meaning.
    Word(&'r str, &'r str),
}

/// Terms of the field for tables and keys that have another name in files.
const TERMS: [(&str, &str); 3] =
    [("connector", "spring"), ("grade", "material.preset"), ("base acceleration", "load.base")];

/// Every location at which a format has a name, or the name in files of a term of the field. The user's name of a table may be in it:
/// `projectile.hammer.mass`.
pub fn find<'r>(format: &'r [TableReference], name: &str) -> Vec<Found<'r>> {
    let name = name.trim_start_matches('[');
    let name = name.split(['[', ']']).next().unwrap_or_default();
    let found = by_name(format, name);
    if !found.is_empty() {
        return found;
    }
    let (first, rest) = name.split_at(name.find('.').unwrap_or(name.len()));
    let term = TERMS.iter().find(|(term, _)| *term == first);
    term.map_or_else(Vec::new, |(_, ours)| by_name(format, &format!("{ours}{rest}")))
}

fn by_name<'r>(format: &'r [TableReference], name: &str) -> Vec<Found<'r>> {
    let found = exactly(format, name);
    let mut parts: Vec<&str> = name.split('.').collect();
    if !found.is_empty() || parts.len() < 2 {
        return found;
    }
    let middle = parts.remove(1);
    let mut found = exactly(format, &parts.join("."));
    // In `load.base.acceleration` it is a kind, whose key comes first.
    let of_kind =
        |one: &Found<'_>| one.kinds.iter().any(|kind| kind.ends_with(&format!("= \"{middle}\"")));
    found.sort_by_key(|one| !of_kind(one));
    found
}

fn exactly<'r>(format: &'r [TableReference], name: &str) -> Vec<Found<'r>> {
    let mut search = Search { name, kinds: Vec::new(), found: Vec::new() };
    for table in format {
        if table.form != TableForm::File && table.places.iter().any(|place| place == name) {
            search.add(table.places.clone(), Meaning::Table(table));
        }
        search.body(table, &table.body);
    }
    search.found
}

struct Search<'r, 'n> {
    name: &'n str,
    /// Kinds of the part of a table that is searched, shape (kinds).
    kinds: Vec<String>,
    /// Entries found so far, shape (entries).
    found: Vec<Found<'r>>,
}

impl<'r> Search<'r, '_> {
    fn add(&mut self, paths: Vec<String>, meaning: Meaning<'r>) {
        self.found.push(Found { paths, kinds: self.kinds.clone(), meaning });
    }

    fn body(&mut self, table: &'r TableReference, body: &'r BodyReference) {
        for key in &body.keys {
            // A key of the file with a table is that table.
            if table.form == TableForm::File && key.table.is_some() {
                continue;
            }
            let paths = paths(table, key.name);
            if let Some((word, about)) = key.words.iter().find(|(word, _)| *word == self.name) {
                self.add(paths.clone(), Meaning::Word(word, about));
            }
            if self.is_meant(key.name, &paths) {
                self.add(paths, Meaning::Key(key));
            }
        }
        for choice in &body.kinds {
            let paths = paths(table, choice.tag);
            if self.is_meant(choice.tag, &paths) {
                self.add(paths.clone(), Meaning::Choice(choice));
            }
            for (word, variant) in &choice.variants {
                if *word == self.name {
                    self.add(paths.clone(), Meaning::Kind(word, variant));
                }
                self.kinds.push(format!("{} = \"{word}\"", choice.tag));
                self.body(table, variant);
                self.kinds.pop();
            }
        }
    }

    fn is_meant(&self, key: &str, paths: &[String]) -> bool {
        key == self.name || paths.iter().any(|path| path == self.name)
    }
}

/// Paths of a key of a table, one for each place of the table.
fn paths(table: &TableReference, key: &str) -> Vec<String> {
    let path = |place: &String| match place.is_empty() {
        true => key.to_owned(),
        false => format!("{place}.{key}"),
    };
    table.places.iter().map(path).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use percuss_scenario::{reference, study_reference};

    fn keys(table: &TableReference, body: &BodyReference, all: &mut Vec<String>) {
        all.extend(body.keys.iter().flat_map(|key| paths(table, key.name)));
        for choice in &body.kinds {
            all.extend(paths(table, choice.tag));
            for (word, variant) in &choice.variants {
                all.push((*word).to_owned());
                keys(table, variant, all);
            }
        }
    }

    #[test]
    fn every_table_key_and_kind_is_found() {
        for format in [reference(), study_reference()] {
            let mut all = Vec::new();
            for table in &format {
                let places = table.places.iter().filter(|place| !place.is_empty());
                all.extend(places.cloned());
                keys(table, &table.body, &mut all);
            }
            assert!(all.len() > 30, "{all:?}");
            for name in all {
                assert!(!find(&format, &name).is_empty(), "{name}");
            }
        }
    }

    #[test]
    fn names_of_the_user_and_brackets_are_passed_over() {
        let format = reference();
        let of = |name: &str| {
            find(&format, name).into_iter().flat_map(|one| one.paths).collect::<Vec<_>>()
        };
        assert_eq!(of("projectile.hammer.velocity[1]"), ["projectile.velocity"]);
        assert_eq!(of("[beam.girder]"), ["beam"]);
        assert_eq!(of("beam"), ["beam"]);
        assert_eq!(of("nothing"), Vec::<String>::new());
        assert_eq!(of("connector.law"), ["spring.law"]);
        assert_eq!(of("grade"), ["material.preset"]);
        for (term, _) in TERMS {
            assert!(!of(term).is_empty(), "{term}");
        }
    }

    #[test]
    fn the_kind_in_a_path_comes_first() {
        let format = reference();
        let found = find(&format, "load.base.acceleration");
        assert_eq!(found[0].kinds, ["kind = \"base\""]);
        assert_eq!(find(&format, "load.quake.acceleration").len(), found.len());
    }

    #[test]
    fn a_key_has_the_kinds_that_it_belongs_to() {
        let format = reference();
        let found = find(&format, "projectile.stiffness");
        let [one] = &found[..] else { panic!("{found:?}") };
        assert_eq!(one.kinds, ["kind = \"elastic\"", "law = \"linear\""]);
        let Meaning::Key(key) = one.meaning else { panic!("{one:?}") };
        assert!(key.required && key.unit == "N/m");
    }
}
