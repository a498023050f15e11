//! Files and directories: `E201` and on.

catalogue! {
    /// Why a file or directory could not be read, written or used.
    pub enum FileCode {
        /// The operating system reported an error.
        System = "E201", "I/O error",
            "The operating system reported an error for a file, or did not provide what the program needs; the message contains its \
             text: no space, no permission, no such directory. Earlier results are unchanged.";
        /// A file with unexpected content.
        Content = "E202", "unexpected file content",
            "A file of results is damaged, incomplete or of another format. Run the scenario again; `percuss report` and similar \
             commands need the files as `percuss run` wrote them.";
        /// Something else exists at the location of the results.
        Foreign = "E203", "output directory in use",
            "The output directory contains files that are not percuss results, or results of another analysis, or a file exists in its \
             place. Percuss replaces only files that it wrote itself. Choose another `--out`.";
        /// Another process writes to the directory.
        Busy = "E204", "results locked by another process",
            "Another process writes to the same directory, or to the same picture, and two would mix their results. Wait for it, or \
             choose another `--out`. The lock ends with the process, also if it is killed.";
        /// A file of earlier results that was modified.
        Changed = "E205", "result modified by the user",
            "A file of earlier results was modified after percuss wrote it, and replacing it would lose the modification. Move it away, \
             or choose another `--out`.";
        /// There is no checkpoint.
        NoCheckpoint = "E206", "no checkpoint",
            "A run writes checkpoints only with `--checkpoint`, and removes those beside its results when it is complete. Run it from \
             the start, with `--checkpoint` if it is to be continued later.";
        /// A checkpoint whose checksum does not match.
        Checkpoint = "E207", "damaged checkpoint",
            "The checkpoint, or the rows that belong to it, is not what was written; results of a continued run would be wrong. Run the \
             scenario from the start.";
        /// A checkpoint that belongs to another run.
        OtherCheckpoint = "E208", "checkpoint of another run",
            "The checkpoint belongs to another scenario, was written by another version, or is later than the end: the results would \
             not be those of one run. Only `time.end` may differ. Run the scenario from the start.";
        /// A directory without a run.
        NoRun = "E209", "not the directory of a run",
            "The command needs the directory that `percuss run` has written, with `summary.json` in it.";
        /// No shapes were recorded.
        NoShapes = "E210", "run without shapes",
            "Films, pictures and exports need the shapes of the scene over time, and this run recorded none. Run its scenario again \
             with `record.shapes` above 0, which is its default.";
        /// A scenario within the directory of its results.
        OwnInput = "E211", "results would overwrite the scenario",
            "The scenario lies in the output directory, and the copy of the scenario among the results would replace it, with its \
             comments. Choose another `--out`.";
        /// A picture that could not be made.
        Drawing = "E212", "graphics error",
            "A picture or film could not be made from the run, or the program that makes it failed; the message contains its text. \
             Another format may work: `.gif` and `.apng` need no other program.";
        /// ffmpeg was not found.
        Ffmpeg = "E213", "ffmpeg not found",
            "MP4 films are made by ffmpeg, which is not on the PATH. Install it, or give a file name that ends with `.gif` or `.apng`.";
        /// The book is not installed.
        NoBook = "E214", "book not found",
            "Archives and wheels of a release contain the book; a build from the sources does not. Its pages are in docs/book/src, and \
             `scripts/book` builds it. PERCUSS_BOOK names the folder of another copy, with its index.html.";
    }
}

impl FileCode {
    /// Whether to continue would have destroyed data.
    pub fn is_refused(self) -> bool {
        matches!(self, Self::Foreign | Self::Busy | Self::Changed | Self::NoRun | Self::OwnInput)
    }

    /// Whether a file was read and has an unexpected content.
    pub fn is_content(self) -> bool {
        matches!(
            self,
            Self::Content | Self::NoCheckpoint | Self::Checkpoint | Self::OtherCheckpoint
        )
    }
}
