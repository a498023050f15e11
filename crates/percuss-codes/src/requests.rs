//! Studies, clusters and what is asked of a command: `E301` and on.

catalogue! {
    /// What a command cannot do as it was asked to.
    pub enum RequestCode {
        /// The directory belongs to another study.
        OtherStudy = "E301", "the directory of another study",
            "The directory holds the runs of another study, or of an earlier state of this one, and they must not be mixed. Give another \
             `--out`; or remove the directory to begin anew.";
        /// A shard or table that is damaged or belongs to another study.
        Shard = "E302", "runs of a study that cannot be used",
            "A file of runs (a shard) is damaged, or belongs to another study or version by its fingerprint. Remove it: the same command \
             does its runs again, and no others.";
        /// Not all shards are there.
        MissingShard = "E303", "a study that is not complete",
            "Runs are missing, so there is no table yet. Run the same `percuss sweep` again: it does what is left; where parts run on \
             several machines, wait for all of them.";
        /// No Python that speaks with a cluster.
        Cluster = "E304", "no way to a cluster",
            "`percuss sweep --scheduler` needs Python with percuss and Dask. `pip install \".[dask]\"` in the sources of Percuss installs \
             them; PERCUSS_PYTHON names another interpreter. Else no scheduler answers at the address: is it right, \
             and the scheduler running?";
        /// The cluster ended without results.
        ClusterFailed = "E305", "a cluster that left no results",
            "The sweep ended as if it were done, and its results are not in the directory. Look whether the cluster writes to the same \
             file system, and run the same command again: what is done is kept.";
        /// A run that the study does not have.
        NoSuchRun = "E306", "a run that the study does not have",
            "`--keep-run` names a run by its number, from 0. `percuss check` tells how many runs the study has.";
        /// A run whose values make no scenario.
        NoScenario = "E307", "a run without a scenario",
            "The values of this run make no sound scenario, so it cannot be kept whole. Its row in the table says why, in the column \
             `reason`.";
        /// A warning that the user denied.
        Denied = "E308", "a warning that is denied",
            "`--deny` says that a warning of this code is a failure, and it was found. Mend what it tells of, or leave the code out of \
             `--deny`. A scenario that allows the warning in `[allow]`, with a reason, is not failed by it.";
        /// Beams are needed.
        NoBeam = "E309", "an analysis of beams without beams",
            "Static equilibria and modes are those of beams, and this scene has none. `percuss run` simulates it.";
        /// The run has that time behind it.
        EndReached = "E310", "an end that is reached already",
            "`percuss extend` lets a run go on to a later end than it has. Give a time beyond it.";
        /// Levels of convergence that cannot be run.
        Levels = "E311", "levels that cannot be run",
            "An order of convergence needs three levels, each of which halves the step or doubles the mesh and costs twice as much. Use \
             fewer levels, a coarser start or a shorter run.";
        /// No figure of that name.
        NoSuchFigure = "E312", "a figure that the run does not have",
            "Figures are asked for by their names. `percuss plot DIR --list` lists those that the run has, and what they show.";
        /// A time outside the run, or an empty span.
        Instant = "E313", "an instant that the run does not have",
            "A film or picture shows times that the run has shapes of, and begins before it ends. The message names them. `--impact` needs \
             something that touches, and not all the time.";
        /// A file name that says no format.
        FileName = "E314", "a name of another kind",
            "The format of a film or picture follows from the end of its name. The message lists those that are known; a directory is no \
             file.";
        /// A picture that its format cannot hold.
        PictureBounds = "E315", "a picture out of bounds",
            "A format holds pictures up to a size and frames up to a rate, and displacements may be drawn larger only where no bodies \
             would overlap that do not. The message names the bound.";
        /// Too many runs on one page.
        TooManyRuns = "E316", "more runs than a page can tell apart",
            "A page lays a few runs over each other, each in a colour of its own. Give fewer directories; `percuss sweep` is for many runs.";
        /// Something that scenarios have and studies have not.
        NotOfStudies = "E317", "something that studies do not take",
            "A study names its base scenario by path, so it is read from a file and not from standard input, and its values are given in \
             it, not by `--set`.";
        /// Words vary, and a function is one of numbers.
        NoFunction = "E318", "a study that is no function of numbers",
            "`percuss serve`, `percuss eval` and functions in Python take the study as a function of numbers, and in this one words or \
             lists vary as well. Give it a study in which only numbers do: one for each word.";
        /// A point at which a function has no value, or something that is no point.
        NoValue = "E319", "a point without a value",
            "A study as a function wants a number for each of its parameters, in SI units, and has a value where the run completes and has \
             the results asked for: a blow that misses has no peak force. The message says which it is.";
        /// A column that is no acceleration, or an acceleration that cannot be judged as it was asked to.
        Acceleration = "E320", "no acceleration to filter or to take a spectrum of",
            "Filters of channel frequency classes and shock response spectra are those of an acceleration: of a recorded point or a \
             projectile. A class needs ten samples a period of its cut-off, a spectrum twice as many samples a second as its highest \
             frequency. The message says what is there and what is wanted.";
    }
}
