//! Errors of scenarios, studies and changes: `E001` and on.

catalogue! {
    /// The kind of an error in a file of the user's.
    pub enum FaultCode {
        /// A file that cannot be read, or is no scenario or study.
        File = "E001", "a file that cannot be read",
            "The file does not exist, cannot be read, is empty, is not UTF-8 text, lies outside the folder from which the scenario may \
             read files, or is of another kind (a study instead of a scenario). The same holds for standard input and pipes without \
             input for some seconds. Tables of numbers and the base of a study lie in the folder of the file that names them or below; \
             `--allow-outside` lifts this for scenarios that you trust.";
        /// Text that is not TOML.
        Syntax = "E002", "invalid TOML",
            "Scenarios and studies are TOML 1.0 files: tables in brackets, `key = value` lines, texts in quotes. Correct the marked \
             location first; other checks follow.";
        /// A key or table that the format does not know.
        UnknownKey = "E003", "unknown key or table",
            "The format has no such key here. Similar keys are suggested; `percuss schema` gives all of them to an editor. Unknown keys \
             are errors, because a misspelt key would silently keep its default.";
        /// A required key or table is missing.
        MissingKey = "E004", "missing key or table",
            "This key has no default and is required. `percuss new` writes a scenario that has all required keys.";
        /// A value of the wrong type or form.
        ValueType = "E005", "invalid value",
            "The key takes a value of another type or form: a number, a text in quotes, a list, a table in braces. The message shows an \
             example.";
        /// A unit that is unknown, or of another dimension.
        Unit = "E006", "unit mismatch",
            "The unit is unknown, or has another dimension than the key (a length instead of a mass). Numbers without a unit are in SI \
             units.";
        /// An unknown word or name.
        UnknownName = "E007", "unknown name",
            "The word or name is not valid here: a beam, section, material, point or body that the file does not define, or a kind that \
             does not exist. Similar names are suggested.";
        /// Keys that exclude each other, or have no meaning here.
        Conflict = "E008", "conflicting keys",
            "Two keys exclude each other, or a key has no meaning beside the others of its table. Remove one of them.";
        /// An invalid name given by the user.
        InvalidName = "E009", "invalid name",
            "Names of your own consist of letters, digits, `_` and `-`: they appear between dots in the names of results.";
        /// A table of numbers, in the file or beside it.
        Table = "E010", "invalid table of numbers",
            "A table needs at least two rows, numbers in each cell, and a first column that increases from row to row. Columns of a CSV \
             file are found by their headings, with units in brackets or by key.";
        /// A change (`--set`, a parameter of a study, Python) without effect.
        Change = "E011", "override without effect",
            "`--set PATH=VALUE`, the parameters of a study and Python name a value by its path in the file, such as \
             `projectile.hammer.velocity[1]`: names between dots, indices of lists counted from zero. The table must exist in the file; a key \
             with a default may be set without being in the file.";
        /// A setting of time, integration, recording or report.
        Setting = "E012", "setting out of range",
            "A setting of time, integration, recording or report is out of range, or incompatible with another one. The message names \
             the valid values.";
        /// A material or section.
        Section = "E013", "invalid material or section",
            "A modulus, density, area, dimension or second moment is not positive or finite, or the dimensions of a shape contradict \
             each other. The message names the key and the valid values.";
        /// A beam: its axis, elements, ends, or what overlaps with it.
        Beam = "E014", "invalid beam definition",
            "The points, elements, ends or section do not define a beam: too few points, no length, no elements. The message names the \
             key and the valid values.";
        /// A support, joint, spring or point mass, or a structure that can move without strain.
        Connection = "E015", "invalid support or connection",
            "A support, joint, spring or point mass acts at an invalid location, has a value out of range, or contradicts another one. \
             Statics and modes also need a structure that cannot move without strain.";
        /// A projectile or another rigid body.
        Body = "E016", "invalid projectile or body",
            "A mass, stiffness, size or coefficient of restitution of a projectile is out of range, or the projectile cannot strike its \
             target. The message names the key and the valid values.";
        /// An obstacle or contact.
        Contact = "E017", "invalid obstacle or contact",
            "A contact is between two bodies that can touch and do not overlap at the start; the values of its law are within their \
             ranges. An obstacle without a contact is an error, because it is likely a mistake.";
        /// A load, a prescribed motion or its time function.
        Load = "E018", "invalid load or time function",
            "A load or its time function has a value out of range, or acts at a location that the beam does not have. The message names \
             the key and the valid values.";
        /// Initial velocities or the state at the start.
        Initial = "E019", "invalid initial state",
            "A velocity is not finite, or [initial.NAME] does not name exactly one beam, or one point mass at a node of its beam; or a \
             beam and a point mass on it have different velocities at the node of the mass.";
        /// Damping.
        Damping = "E020", "invalid damping",
            "Modal damping ratios are from 0 to below 1; the message names the valid values of other keys. A mechanism, a structure \
             whose parts move relative to each other without strain, has no modal damping.";
        /// A study or a fit: its parameters, design, results or tests.
        Study = "E021", "invalid study or fit",
            "A study varies values of its base scenario by a sampling design, and selects results by paths into summary.json; a fit names \
             parameters, and tests with their records. The message names the key and the valid values.";
        /// An equilibrium path or modes.
        Analysis = "E022", "invalid path or modes settings",
            "An equilibrium path needs a first load factor above zero, at least one point, and an end that is not zero; the number of \
             modes is at most that of the mesh.";
        /// A file beside the scenario with another content than its `sha256`.
        Checksum = "E023", "checksum mismatch",
            "A table of numbers lies in a file of its own, and `sha256` beside its name identifies its content. The file that exists \
             now has another content, so that results would not belong to this scenario. Restore the file; or remove `sha256`, to use \
             the file as it is, and run from the start.";
    }
}
