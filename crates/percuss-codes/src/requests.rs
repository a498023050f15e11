//! Studies, clusters and requests to a command: `E301` and on.

catalogue! {
    /// Requests that a command cannot meet.
    pub enum RequestCode {
        /// The output directory belongs to another study.
        OtherStudy = "E301", "output directory of another study",
            "The directory holds the runs of another study, or of an earlier state of this one, and they must not be mixed. Choose \
             another `--out`, or remove the directory to start again.";
        /// A shard or table that is damaged or belongs to another study.
        Shard = "E302", "invalid shard",
            "A file of runs (a shard) is damaged, or belongs to another study or version by its fingerprint. Remove it: the same \
             command computes its runs again, and no others.";
        /// Some shards are missing.
        MissingShard = "E303", "incomplete study",
            "Runs are missing, so that there is no table yet. Run the same `percuss sweep` again: it computes the missing runs; where \
             parts are computed on several machines, wait for all of them.";
        /// No Python with access to a cluster.
        Cluster = "E304", "no cluster connection",
            "`percuss sweep --scheduler` needs Python with percuss and Dask. `pip install \".[dask]\"` in the sources of Percuss \
             installs them; PERCUSS_PYTHON names another interpreter. Otherwise no scheduler answers at the address: check the address, \
             and that the scheduler is running.";
        /// The cluster ended without results.
        ClusterFailed = "E305", "cluster without results",
            "The sweep ended without an error, but its results are not in the directory. Check that the cluster writes to the same file \
             system, and run the same command again: finished runs are kept.";
        /// A run that the study does not have.
        NoSuchRun = "E306", "no such run",
            "`--keep-run` names a run by its number, from 0. `percuss check` prints the number of runs of the study.";
        /// A run whose values give an invalid scenario.
        NoScenario = "E307", "run without a valid scenario",
            "The values of this run give an invalid scenario, so that its full results cannot be kept. The column `reason` of its row \
             in the table has the reason.";
        /// A warning that the user denied.
        Denied = "E308", "denied warning",
            "`--deny` makes a warning of this code an error, and the warning was found. Remove its cause, or drop the code from \
             `--deny`. A warning that the scenario accepts in `[allow]`, with a reason, is not an error.";
        /// Beams are needed.
        NoBeam = "E309", "no beams",
            "Static equilibria and modes are those of beams, and this scene has none. `percuss run` simulates it.";
        /// The end time is already reached.
        EndReached = "E310", "end time already reached",
            "`percuss extend` continues a run to a later end. Give a time beyond the present one.";
        /// Levels of convergence that cannot be run.
        Levels = "E311", "invalid convergence levels",
            "An order of convergence needs three levels, each of which halves the step or doubles the mesh and costs twice as much. Use \
             fewer levels, a coarser start or a shorter run.";
        /// No figure of that name.
        NoSuchFigure = "E312", "no such figure",
            "Figures are selected by name. `percuss plot DIR --list` lists those of the run, and what they show.";
        /// A time outside the run, or an empty span.
        Instant = "E313", "time outside the run",
            "A film or picture shows times at which the run recorded shapes, and starts before it ends. The message names them. \
             `--impact` needs a contact that is closed for a part of the run.";
        /// A file name without a known format.
        FileName = "E314", "unknown file format",
            "The format of a film or picture follows from the end of its file name. The message lists the known ones; a directory is \
             not a file.";
        /// A picture that its format cannot hold.
        PictureBounds = "E315", "picture size or rate out of range",
            "A format has a largest size and frame rate, and displacements may be scaled only up to where bodies that do not overlap \
             would be shown overlapping. The message names the limit.";
        /// Too many runs on one page.
        TooManyRuns = "E316", "too many runs in one comparison",
            "A page overlays a few runs, each in a colour of its own. Give fewer directories; `percuss sweep` is for many runs.";
        /// Something that scenarios have and studies do not.
        NotOfStudies = "E317", "not available for studies and fits",
            "A study or a fit names its base scenario by path, so it is read from a file and not from standard input; its values are given \
             in the file, not by `--set`.";
        /// Words vary, and a function takes numbers.
        NoFunction = "E318", "non-numeric parameters",
            "`percuss serve`, `percuss eval` and functions in Python use the study as a function of numbers, and in this one words or \
             lists vary too. Use a study in which only numbers vary: one for each word.";
        /// A point at which the function has no value, or an invalid point.
        NoValue = "E319", "no value at this point",
            "A study as a function needs a number for each of its parameters, in SI units, and has a value where the run completes and \
             has the requested results: a projectile that misses has no peak force. The message has the reason.";
        /// A column without an acceleration, or an acceleration with too few samples.
        Acceleration = "E320", "no acceleration data",
            "Filters of channel frequency classes and shock response spectra need an acceleration: of a recorded point or a projectile. \
             A class needs ten samples per period of its cut-off, a spectrum twice as many samples per second as its highest frequency. \
             The message says what is available and what is needed.";
    }
}
