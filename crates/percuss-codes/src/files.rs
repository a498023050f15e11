//! Files and directories: `E201` and on.

catalogue! {
    /// Why a file or directory could not be read, written or used.
    pub enum FileCode {
        /// The system said no.
        System = "E201", "what the system refuses",
            "The system did not let a file be read or written, or did not give what the program needs of it; the message says what it \
             said: no space, no permission, no such directory. Results that were there before stay as they were.";
        /// A file that is not what it should be.
        Content = "E202", "a file that is not what it should be",
            "A file of results was read and is damaged, incomplete or of another form. Run the scenario again; `percuss report` and \
             its like need the files as `percuss run` wrote them.";
        /// A place that holds something that Percuss did not write, or other results.
        Foreign = "E203", "a place that holds something else",
            "What stands at the place for the results is not what would be replaced: a file, a directory that is not empty, results \
             of another analysis. Percuss replaces only what it wrote itself. Give another `--out`.";
        /// Another process is writing there.
        Busy = "E204", "what another process is writing",
            "Another process writes into the same directory, or the same picture, and two would mix them. Wait for it, or give another `--out`. \
             The lock goes with the process, also if it dies.";
        /// A file of the results that was changed since.
        Changed = "E205", "a result that was changed by hand",
            "A file of earlier results is not as it was written, and replacing it would lose the change. Move it away, or give another \
             `--out`.";
        /// There is no checkpoint.
        NoCheckpoint = "E206", "no checkpoint to go on from",
            "A run writes checkpoints only with `--checkpoint`, and removes those beside its results when it is complete. Run it from the \
             beginning, with `--checkpoint` if it is to go on later.";
        /// A checkpoint whose checksum does not fit.
        Checkpoint = "E207", "a damaged checkpoint",
            "The checkpoint, or the rows that belong to it, is not what was written: going on from it would give results of nobody \
             knows what. Run the scenario from the beginning.";
        /// A checkpoint that belongs to something else.
        OtherCheckpoint = "E208", "a checkpoint of another run",
            "The checkpoint is of another scenario, or was written by another version, or lies beyond the end: the results would not be \
             those of one run. Nothing but `time.end` may change. Run the scenario from the beginning.";
        /// A path at which no run stands.
        NoRun = "E209", "not the directory of a run",
            "The command needs the directory that `percuss run` has written, with `summary.json` in it.";
        /// No shapes were kept.
        NoShapes = "E210", "a run without shapes",
            "Films, pictures and exports show how the scene moved, and no shapes were kept of this run. Run its scenario again with \
             `record.shapes` above 0, which is its default.";
        /// A scenario within the directory of its results.
        OwnInput = "E211", "results over their own scenario",
            "The scenario lies in the directory for its results, and its own echo would replace it, comments and all. Give another \
             `--out`.";
        /// A picture that could not be made.
        Drawing = "E212", "a picture that cannot be drawn",
            "A picture or film could not be made from the run, or the program that makes it gave up; the message says what it said. \
             Another format may do: `.gif` and `.apng` need nothing else.";
        /// ffmpeg is not there.
        Ffmpeg = "E213", "ffmpeg is needed",
            "MP4 films are made by ffmpeg, which is not on the PATH. Install it, or give a name that ends with `.gif` or `.apng`.";
    }
}

impl FileCode {
    /// Whether going on would have destroyed something.
    pub fn is_refused(self) -> bool {
        matches!(self, Self::Foreign | Self::Busy | Self::Changed | Self::NoRun | Self::OwnInput)
    }

    /// Whether something was read and is not what it should be.
    pub fn is_content(self) -> bool {
        matches!(
            self,
            Self::Content | Self::NoCheckpoint | Self::Checkpoint | Self::OtherCheckpoint
        )
    }
}
