//! The documentation of an array field states the array's shape and the unit of its entries.
//!
//! The form is `shape (nodes, 4) \[m, -\]`: for each index, the outermost first, the number of its values or the counted items, followed by the
//! unit of an entry, or units for entries of several kinds. Entries without unit have `\[-\]` or `\[-\]`; indices and counts name their items, as
//! `\[index of a beam\]`. Truth values, names and types of this crate need no unit: units of a type are given at its own fields. Matrices stored
//! row by row have two indices, so an index more than the type is valid.
//!
//! Arrays are Vec, slices and arrays, matrices and vectors of nalgebra, the crate's columns, other names for these, and types that contain one of
//! them, such as Option or Box. The documentation of a command's argument is exempt. For an unnamed field the documentation of its type or variant
//! may be used.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use syn::visit::{self, Visit};

use super::layers::{is_test, root, sources};

/// Types that are arrays by their name.
const ARRAYS: [&str; 13] = [
    "Columns", "Vec", "VecDeque", "IndexVec", "SVector", "DVector", "Vector3", "SMatrix",
    "DMatrix", "Matrix3", "Mat", "MatRef", "MatMut",
];

/// Types that contain others, and are arrays or numbers if these are.
const AROUND: [&str; 12] = [
    "Option",
    "Box",
    "Rc",
    "Arc",
    "Cow",
    "Range",
    "RangeInclusive",
    "Cell",
    "RefCell",
    "BTreeMap",
    "HashMap",
    "Result",
];

/// Numbers; so are type parameters.
const NUMBERS: [&str; 18] = [
    "f64", "f32", "u8", "u16", "u32", "u64", "u128", "usize", "i8", "i16", "i32", "i64", "isize",
    "Complex", "Wide", "Lanes", "Dual", "Derived",
];

/// Types inside a type, at any depth.
#[derive(Clone, Copy, Default)]
struct Contents {
    /// Indices of the array with most of them; zero if there is none.
    indices: usize,
    /// Whether numbers are among its entries.
    number: bool,
}

impl Contents {
    fn with(self, other: Self) -> Self {
        Self { indices: self.indices.max(other.indices), number: self.number || other.number }
    }

    /// An array of them.
    fn indexed(self) -> Self {
        Self { indices: self.indices + 1, ..self }
    }
}

/// Types that have another name, by it.
type Aliases = BTreeMap<String, syn::Type>;

fn contents(of: &syn::Type, aliases: &Aliases) -> Contents {
    let union = |types: &mut dyn Iterator<Item = &syn::Type>| {
        types.map(|one| contents(one, aliases)).fold(Contents::default(), Contents::with)
    };
    match of {
        syn::Type::Array(of) => contents(&of.elem, aliases).indexed(),
        syn::Type::Slice(of) => contents(&of.elem, aliases).indexed(),
        syn::Type::Reference(to) => contents(&to.elem, aliases),
        syn::Type::Paren(of) => contents(&of.elem, aliases),
        syn::Type::Group(of) => contents(&of.elem, aliases),
        syn::Type::Tuple(of) => union(&mut of.elems.iter()),
        syn::Type::Path(path) => {
            let last = path.path.segments.last().unwrap();
            let name = last.ident.to_string();
            let is_in = |list: &[&str]| list.contains(&name.as_str());
            if let Some(other) = aliases.get(&name) {
                return contents(other, aliases);
            }
            let array = is_in(&ARRAYS);
            let inside = match &last.arguments {
                syn::PathArguments::AngleBracketed(list) if array || is_in(&AROUND) => {
                    union(&mut list.args.iter().filter_map(|argument| match argument {
                        syn::GenericArgument::Type(one) => Some(one),
                        _ => None,
                    }))
                }
                _ => Contents::default(),
            };
            let number = name.len() == 1 || name == "Columns" || is_in(&NUMBERS);
            let all = Contents { number: number || inside.number, ..inside };
            if array { all.indexed() } else { all }
        }
        // Functions and trait objects hold no array that is to be read.
        _ => Contents::default(),
    }
}

/// The text of a documentation comment, in one line.
fn documentation(attributes: &[syn::Attribute]) -> String {
    let lines = attributes.iter().filter(|a| a.path().is_ident("doc")).filter_map(|a| {
        match &a.meta.require_name_value().ok()?.value {
            syn::Expr::Lit(syn::ExprLit { lit: syn::Lit::Str(text), .. }) => Some(text.value()),
            _ => None,
        }
    });
    let lines: Vec<String> = lines.map(|line| line.trim().to_owned()).collect();
    lines.join(" ")
}

/// Text between an opening and its closing bracket, and the rest.
fn between<'a>(text: &'a str, open: &str, close: &str) -> Option<(&'a str, &'a str)> {
    let (_, rest) = text.split_once(open)?;
    let (inner, rest) = rest.split_once(close)?;
    (!inner.trim().is_empty()).then_some((inner, rest))
}

/// Missing parts in the documentation of an array.
fn missing(text: &str, of: Contents) -> Option<&'static str> {
    let Some((shape, rest)) = between(text, "shape (", ")") else {
        return Some("no shape");
    };
    let said = shape.split(',').filter(|index| !index.trim().is_empty()).count();
    if said < of.indices {
        return Some("a shape of fewer indices than it has");
    }
    match between(rest, r"\[", r"\]") {
        None if of.number => Some("no unit behind its shape"),
        Some((units, _)) if units.split(", ").any(|unit| unit == "1") => {
            Some("a unit of 1 where `-` says that there is none")
        }
        _ => None,
    }
}

/// Collects the names that types have besides their own.
struct Names<'a>(&'a mut Aliases);

impl<'ast> Visit<'ast> for Names<'_> {
    fn visit_item_type(&mut self, item: &'ast syn::ItemType) {
        self.0.insert(item.ident.to_string(), (*item.ty).clone());
    }
}

/// Array fields in one file, and the missing parts of their documentation.
struct Fields<'a> {
    text: &'a str,
    aliases: &'a Aliases,
    /// How many fields of arrays were found.
    found: usize,
    /// Lines, fields and missing parts, shape (number of faults).
    faults: Vec<(usize, String, &'static str)>,
}

/// Line, counted from one, at which the last of several words begins a line or follows its visibility; each is searched after the previous one.
fn line_of(text: &str, words: &[String]) -> usize {
    let mut words = words.iter();
    let mut next = words.next();
    for (number, line) in text.lines().enumerate() {
        let line = line.trim_start();
        let declares = |word: &String| {
            let begins = line.strip_prefix(word.as_str()).or_else(|| {
                let (_, rest) = line.strip_prefix("pub")?.split_once(' ')?;
                rest.strip_prefix(word.as_str())
            });
            begins.is_some_and(|rest| !rest.starts_with(|c: char| c.is_alphanumeric() || c == '_'))
        };
        if next.is_some_and(declares) {
            next = words.next();
            if next.is_none() {
                return number + 1;
            }
        }
    }
    0
}

impl Fields<'_> {
    /// Adds the fields of a type or variant, with its own documentation and the words that declare it.
    fn take(&mut self, at: &[String], attributes: &[syn::Attribute], fields: &syn::Fields) {
        for (number, field) in fields.iter().enumerate() {
            let of = contents(&field.ty, self.aliases);
            // The documentation of an argument is the help of its command.
            let is_argument = field.attrs.iter().any(|a| a.path().is_ident("arg"));
            if of.indices == 0 || is_argument {
                continue;
            }
            self.found += 1;
            let mut text = documentation(&field.attrs);
            if field.ident.is_none() && missing(&text, of).is_some() {
                text = documentation(attributes);
            }
            if let Some(lacks) = missing(&text, of) {
                let own = field.ident.as_ref().map(syn::Ident::to_string);
                let words = [at, &own.iter().map(|own| format!("{own}:")).collect::<Vec<_>>()];
                let line = line_of(self.text, &words.concat());
                let name = at.join("::").replace("struct ", "").replace("enum ", "");
                let own = own.unwrap_or_else(|| number.to_string());
                self.faults.push((line, format!("{name}.{own}"), lacks));
            }
        }
    }
}

impl<'ast> Visit<'ast> for Fields<'_> {
    fn visit_item_mod(&mut self, item: &'ast syn::ItemMod) {
        if !is_test(&item.attrs) {
            visit::visit_item_mod(self, item);
        }
    }

    fn visit_item_struct(&mut self, item: &'ast syn::ItemStruct) {
        self.take(&[format!("struct {}", item.ident)], &item.attrs, &item.fields);
    }

    fn visit_item_enum(&mut self, item: &'ast syn::ItemEnum) {
        for variant in &item.variants {
            let at = [format!("enum {}", item.ident), variant.ident.to_string()];
            self.take(&at, &variant.attrs, &variant.fields);
        }
    }
}

/// Number of array fields in a source, and lines, names and missing parts of those with faults.
fn faults_of(text: &str, aliases: &Aliases) -> (usize, Vec<(usize, String, &'static str)>) {
    let mut fields = Fields { text, aliases, found: 0, faults: Vec::new() };
    fields.visit_file(&syn::parse_file(text).unwrap());
    (fields.found, fields.faults)
}

#[test]
fn fields_of_arrays_say_shape_and_unit() {
    let crates = root().join("crates");
    let mut files = Vec::new();
    for one in fs::read_dir(&crates).unwrap() {
        let src = one.unwrap().path().join("src");
        if src.is_dir() {
            sources(&src, &mut files);
        }
    }
    let is_rust = |file: &Path| file.extension().is_some_and(|e| e == "rs");
    files.retain(|file| is_rust(file) && !file.ends_with("tests.rs"));
    files.sort();
    let texts: Vec<(&Path, String)> = files
        .iter()
        .map(|file| (file.strip_prefix(&crates).unwrap(), fs::read_to_string(file).unwrap()))
        .collect();
    let mut found = 0;
    let mut faults = Vec::new();
    // Crates use names of types for arrays of their own.
    for own in texts.chunk_by(|(a, _), (b, _)| a.iter().next() == b.iter().next()) {
        let mut aliases = Aliases::new();
        for (_, text) in own {
            Names(&mut aliases).visit_file(&syn::parse_file(text).unwrap());
        }
        for (file, text) in own {
            let (of_file, lacking) = faults_of(text, &aliases);
            found += of_file;
            let fault = |(line, name, lacks): (usize, String, &str)| {
                format!("{}:{line}: `{name}` says {lacks}", file.display())
            };
            faults.extend(lacking.into_iter().map(fault));
        }
    }
    assert!(found > 700, "only {found} fields found");
    assert!(faults.is_empty(), "{} of {found} fields:\n{}", faults.len(), faults.join("\n"));
}

/// Every kind of field is checked, and missing parts are reported with their line; other fields and complete ones are not reported.
#[test]
fn arrays_without_shape_or_unit_are_found() {
    let mut aliases = Aliases::new();
    let names = syn::parse_file("type Nodal = Vec<[f64; 4]>; type Other = Nodal;").unwrap();
    Names(&mut aliases).visit_file(&names);
    let faults = |text: &str| faults_of(text, &aliases).1;

    let two = "struct Peak {\n    /// When \\[s\\].\n    time: f64,\n    /// Where, shape (2).\n    place: [f64; 2],\n}";
    assert_eq!(faults(two), [(5, "Peak.place".to_owned(), "no unit behind its shape")]);
    let one = "struct Line {\n    /// Unit vector, shape (2) \\[1\\].\n    along: [f64; 2],\n}";
    let reported = "a unit of 1 where `-` says that there is none";
    assert_eq!(faults(one), [(3, "Line.along".to_owned(), reported)]);
    let none = "enum Path {\n    /// Points, shape (n) \\[m\\].\n    Points {\n        all: Vec<f64>,\n    },\n}";
    assert_eq!(faults(none), [(4, "Path::Points.all".to_owned(), "no shape")]);

    for of in [
        "Vec<f64>",
        "Option<Vec<f64>>",
        "Box<[f64]>",
        "&'a [f64]",
        "&'a mut [[S; 4]]",
        "[usize; 2]",
        "Nodal",
        "Other",
        "Option<Box<Nodal>>",
        "(usize, Vec<f64>)",
        "nalgebra::SMatrix<f64, 2, 2>",
        "std::collections::BTreeMap<u32, [f64; 2]>",
        "Vec<(Beam, f64)>",
        "Vec<Option<Range<usize>>>",
    ] {
        for wrong in
            ["", "Meaning.", "Of any shape.", r"\[m\], shape (n).", r"Shape shape () \[m\]."]
        {
            let field = format!("struct A<'a> {{ /** {wrong} */ field: {of} }}");
            assert_eq!(faults(&field).len(), 1, "{field}");
            let unnamed = format!("/** {wrong} */ struct A<'a>({of});");
            assert_eq!(faults(&unnamed).len(), 1, "{unnamed}");
            let variant = format!("enum A<'a> {{ /** {wrong} */ One({of}) }}");
            assert_eq!(faults(&variant).len(), 1, "{variant}");
        }
        for right in
            [r"Meaning, shape (n, 4) \[m, -\].", r"Of shape (2 n, n), by row \[-\]; or not."]
        {
            let field = format!("struct A<'a> {{ /** {right} */ field: {of} }}");
            assert_eq!(faults(&field), [], "{field}");
            let unnamed = format!("/** {right} */ struct A<'a>({of});");
            assert_eq!(faults(&unnamed), [], "{unnamed}");
        }
    }
    for of in ["Vec<Beam>", "[bool; 2]", "Option<Vec<String>>", "&'a [Chain<S>]"] {
        let with = |text: &str| format!("struct A<'a> {{ /** {text} */ field: {of} }}");
        assert_eq!(faults(&with("Meaning.")).len(), 1, "{of}");
        assert_eq!(faults(&with("Meaning, shape (n).")), [], "{of}");
    }
    for of in ["Nodal", "&'a [[S; 4]]", "Vec<(usize, Vec<f64>)>", "Option<[[f64; 2]; 2]>"] {
        let fault =
            faults(&format!(r"struct A<'a> {{ /** Shape: shape (n) \[m\]. */ field: {of} }}"));
        assert_eq!(fault[0].2, "a shape of fewer indices than it has", "{of}");
    }
    for of in
        ["f64", "Option<f64>", "Range<usize>", "Arc<dyn Fn(&[f64]) -> f64>", "Chain<S>", "&'a str"]
    {
        assert_eq!(faults(&format!("struct A<'a> {{ field: {of} }}")), [], "{of}");
    }
    assert_eq!(faults("#[cfg(test)]\nmod tests { struct A { field: Vec<f64> } }"), []);
}
