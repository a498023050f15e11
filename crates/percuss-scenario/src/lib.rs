//! Scenario files: TOML with units in, [`percuss::Model`] and [`percuss::Settings`] out.
//!
//! ```
//! let text = percuss_scenario::templates()[0].text;
//! let scenario = percuss_scenario::read(text, "elastic.toml")?;
//! assert_eq!(scenario.content().beam[0].name, "girder");
//! let again = percuss_scenario::read(&scenario.to_toml(), "again.toml")?;
//! assert_eq!(again.content(), scenario.content());
//! # Ok::<(), percuss_scenario::Diagnostics>(())
//! ```
//!
//! Files that a scenario names, points of a centre line or a measured pulse, lie relative to the scenario; written back, their
//! values stand in it.
//!
//! Every fault of a file is reported at once, each with its line, what was found and what would be
//! right; the semantics are checked by [`percuss::ModelBuilder::build`], whose faults are mapped back to
//! the lines of the file.

mod code;
mod compile;
#[macro_use]
mod declare;
pub mod content;
mod csv;
mod diagnostic;
mod edit;
mod file_faults;
mod file_kind;
mod files;
pub mod fit;
mod foreign;
mod format;
mod given;
mod header;
mod known_path;
mod layout;
mod load;
mod measure;
mod name;
mod node;
mod overrides;
mod parse;
mod partner;
mod point;
mod preset;
mod profile;
mod quantity;
mod reach;
mod reading;
mod reference;
mod scenario;
mod schema;
mod source;
mod stray;
pub mod study;
mod suggest;
mod syntax;
mod table;
mod tabulated;
mod template;
pub mod units;
mod vary;
mod visible;
mod words;
mod write;

pub use code::{FaultCode, in_one_line};
pub use compile::Compiled;
pub use content::Content;
pub use diagnostic::{Diagnostic, Diagnostics};
pub use edit::Adds;
pub use file_kind::{is_fit, is_study};
pub use files::{FileAccess, read_bytes, read_in_time};
pub use fit::{FitFile, fit_schema};
pub use given::Given;

pub use layout::TableForm;
pub use overrides::{apply_changes, apply_overrides, known_steps, remove_value};
pub use point::{Anchor, Point};
pub use reading::{load, load_whole, load_with, read, read_whole, read_with};
pub use reference::{
    BodyReference, KeyReference, KindsReference, TableReference, fit_reference, reference, schema,
    study_reference,
};
pub use scenario::Scenario;
pub use study::{StudyFile, study_schema};
pub use suggest::one_of;
pub use table::Named;
pub use tabulated::TableFile;
pub use template::{Template, fit_templates, study_templates, templates};
pub use vary::Field;
pub use visible::{visible, visible_line};
