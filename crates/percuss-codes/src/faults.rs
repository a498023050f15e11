//! Faults of scenarios, studies and changes: `E001` and on.

catalogue! {
    /// What kind of fault a message about a file of the user's tells of.
    pub enum FaultCode {
        /// A file that cannot be read, or is no scenario or study.
        File = "E001", "a file that cannot be read",
            "The file is not there, cannot be read, is empty, is no UTF-8 text, lies outside the folder where the scenario may name \
             files, or is of another kind (a study where a scenario is meant). Standard input and pipes that give \
             nothing for some seconds count as such. Tables of numbers and the base of a study lie in the folder of the \
             file that names them or below; `--allow-outside` lifts this for scenarios that you trust.";
        /// Text that is not TOML.
        Syntax = "E002", "text that is not TOML",
            "Scenarios and studies are TOML 1.0 files: tables in brackets, `key = value` lines, texts in quotes. Mend the place \
             that is marked; until then only values that are wrong in themselves are told besides.";
        /// A key or table that the format does not know.
        UnknownKey = "E003", "an unknown key or table",
            "The format knows no such key here. Keys that look alike are suggested; `percuss schema` gives all of them to an \
             editor. Unknown keys are never passed over: a misspelt key would leave its default in force.";
        /// A key or table that is not there.
        MissingKey = "E004", "a missing key or table",
            "This key has no default and must be given. `percuss new` writes a scenario that has all of them.";
        /// A value of the wrong type or form.
        ValueType = "E005", "a value of the wrong form",
            "The key takes a value of another type or form: a number, a text in quotes, a list, a table in braces. The message \
             shows an example.";
        /// A unit that is not known, or of another dimension.
        Unit = "E006", "a unit that does not fit",
            "The unit is not known, or it measures something else than this key means (a length where a mass is asked). Bare \
             numbers are in SI units.";
        /// A word or name that refers to nothing.
        UnknownName = "E007", "a name that refers to nothing",
            "The word or name is none of those that may stand here: a beam, section, material, point or body that the file does not \
             define, or a kind that does not exist. Names that look alike are suggested.";
        /// Keys that exclude each other or do not belong where they stand.
        Conflict = "E008", "keys that exclude each other",
            "Two keys say the same thing in two ways, or a key stands where it means nothing. Leave one of them out.";
        /// A name of the user's that cannot be one.
        InvalidName = "E009", "a name that cannot be one",
            "Names of your own consist of letters, digits, `_` and `-`: they appear between dots in the names of results.";
        /// A table of numbers, in the file or beside it.
        Table = "E010", "a table of numbers with a fault",
            "A table needs at least two rows, numbers in each cell, and a first column that increases from row to row. Columns of a \
             CSV file are found by their headings, with units in brackets or by key.";
        /// A change (`--set`, a parameter of a study) that reaches nothing.
        Change = "E011", "a change that reaches nothing",
            "`--set PATH=VALUE` and the parameters of a study name a value by its path in the file, such as \
             `projectile.hammer.mass`. The table must exist in the file; a key with a default may be set though it is not written.";
        /// A setting of time, integration, recording or report.
        Setting = "E012", "a setting out of its bounds",
            "A setting of time, integration, recording or report is out of its bounds, or does not go with another one. The message \
             names what would be right.";
        /// A material or section.
        Section = "E013", "a material or section that cannot be",
            "A modulus, density, area, dimension or second moment is not positive or finite, or the dimensions of a shape \
             contradict each other. The message names the key and what would be right.";
        /// A beam: its axis, elements, ends, or what overlaps with it.
        Beam = "E014", "a beam that cannot be",
            "The points, elements, ends or section of a beam do not make a beam: too few points, no length, no elements. The \
             message names the key and what would be right.";
        /// A support, joint, spring or point mass, or a structure that can move without strain.
        Connection = "E015", "a support or connection that cannot be",
            "A support, joint, spring or point mass stands where it cannot act, has a value out of its bounds, or contradicts \
             another one. Statics and modes also need a structure that cannot move without strain.";
        /// A projectile or another rigid body.
        Body = "E016", "a projectile or body that cannot be",
            "A mass, stiffness, size or restitution of a projectile is out of its bounds, or it cannot strike what it is said to \
             strike. The message names the key and what would be right.";
        /// An obstacle or contact.
        Contact = "E017", "an obstacle or contact that cannot be",
            "A contact is between two partners that can touch and that do not overlap at the start; its law has values within \
             bounds. An obstacle that no contact names is refused as a likely slip.";
        /// A load, a prescribed motion or its time function.
        Load = "E018", "a load or time function that cannot be",
            "A load or its time function has a value out of its bounds, or acts at a place that the beam does not have. The message \
             names the key and what would be right.";
        /// Initial velocities or the state at the start.
        Initial = "E019", "an initial state that cannot be",
            "A velocity is not finite, or [initial.NAME] does not name exactly one beam, or one point mass at a node of its \
             beam; or a beam and a point mass on it are given motions that differ where the mass is: a place has one velocity.";
        /// Damping.
        Damping = "E020", "damping that cannot be",
            "Modal damping ratios lie from 0 to below 1; the message names what would be right of other values. A structure whose \
             parts move against each other without strain, a mechanism, has no modal damping.";
        /// A study: its parameters, design or results.
        Study = "E021", "a study that cannot be run",
            "A study varies values of its base scenario, with a design that exists, and picks results by paths into summary.json. \
             The message names the key and what would be right.";
        /// An equilibrium path or modes.
        Analysis = "E022", "a path or modes that cannot be computed",
            "An equilibrium path needs a first load factor above zero, at least one point, and an end to reach that is not zero; \
             modes a number that the mesh has.";
        /// A file beside the scenario that is no longer the one that was meant.
        Checksum = "E023", "a file that has changed",
            "A table of numbers lies in a file of its own, and `sha256` beside its name says which content is meant. The file that is there now \
             has another one: results computed with it would not belong to those that the scenario was written for. Put the file back as it \
             was; or leave `sha256` out, to take the file as it is, and run from the beginning.";
    }
}
