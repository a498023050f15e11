//! Warnings beside those of the model and result checks: `W101` and on.

catalogue! {
    /// Warnings: first those of the audit of a finished run, then those of commands.
    pub enum Caution {
        /// Contact conditions that a run violates.
        ContactConditions = "W101", "contact conditions",
            "Velocities or forces of contacts violate the contact conditions (no approach of closed contacts, no tension) by more than \
             1e-8 of the largest velocity. Impulses have an error of that size. Check whether many contacts close at once; a compliant \
             law avoids it.";
        /// Rigid bodies that overlap.
        Inside = "W102", "penetration of rigid contacts",
            "Rigid contacts penetrated each other by more than a tenth of a micrometre. Impacts are then late and forces wrong. Use a \
             smaller `time.step`, unless supports or joints force the overlap.";
        /// One impact on several touching bodies.
        MultipleImpact = "W103", "multiple impact",
            "Several bodies in contact were struck at once. The distribution of the impulse follows from the impact law, not from the \
             bodies; `time.multiple_impacts = \"sequential\"` resolves one impact after another.";
        /// Impulses that are properties of the mesh.
        MeshImpulse = "W104", "mesh-dependent impulses",
            "A rigid contact acts on the effective mass of the mesh: impulses and the number of impacts change with refinement. Use a \
             compliant contact.";
        /// The error of a balance.
        Balance = "W105", "balance error",
            "The error of the energy, momentum or angular momentum balance exceeds 1e-8 of its scale. Some schemes do not conserve \
             energy, and this is their error: use `energy-momentum` or a smaller step. `--strict` makes it an error.";
        /// A run of the comparison of restitution coefficients that failed.
        Comparison = "W106", "incomplete comparison",
            "The report compares energies for several coefficients of restitution, and the run with one of them failed. The results of \
             the run itself are complete. `[report] restitution` chooses the coefficients.";
        /// The user interrupted.
        Interrupted = "W107", "interrupted",
            "The command was interrupted and stopped after the current step. The results up to there are written, with the time \
             reached. A run with `--checkpoint` continues with `--resume`; a sweep continues with the same command.";
        /// Incomplete results beside complete ones.
        Incomplete = "W108", "incomplete results kept separately",
            "The run did not reach its end, and the output directory has complete results. The incomplete results are kept in the given \
             directory; the complete ones are unchanged.";
        /// An equilibrium with growing modes.
        Unstable = "W109", "unstable equilibrium",
            "Modes about this equilibrium grow: the structure does not stay in it. The frequencies of the other modes hold for small \
             motions about it.";
        /// Derivatives that end before the run.
        Horizon = "W110", "derivatives end before the run",
            "Derivatives are computed up to an event that has none or is not differentiated. Results after this event have no \
             derivative; those before it do.";
        /// Derivatives that hold on one side.
        OneSided = "W111", "one-sided derivatives",
            "The given change of the parameter opens or closes a contact, or starts or prevents yielding, to first order; beyond it the \
             derivative does not hold.";
        /// Failed runs of a study.
        FailedRuns = "W112", "failed runs",
            "Some runs are invalid or did not converge. Their rows contain the reason and its code; statistics omit them.";
        /// A result without a value in any run.
        NoValues = "W113", "result without values",
            "The path of a result gave no number in any run, for example because the contact never closed. The path itself is valid: a \
             misspelt one is an error.";
        /// A scenario that is valid for statics only.
        NotForRuns = "W114", "valid for statics only",
            "A movable part has no mass. Statics does not need it, a run in time does. Give the material a density or the point a mass.";
        /// Invalid runs of a study.
        InvalidRuns = "W115", "invalid runs",
            "Some parameter values give invalid scenarios. The other runs are computed; the rows of these contain the reason. Check the \
             ranges of the parameters.";
        /// No browser.
        Browser = "W116", "no browser",
            "No program on this machine opens the page. The page is written: open it in a browser, here or on another machine.";
        /// A linear buckling factor that is not available.
        NoBuckling = "W117", "no linear buckling factor",
            "A linear buckling factor exists for an elastic structure that is stable without loads, under loads of fixed direction; the \
             search may also miss one. Modes about the static equilibrium, or the equilibrium path (`percuss static --path`), show the \
             load capacity.";
        /// A file that was modified while a command ran.
        Changed = "W118", "file modified during the command",
            "A file that the command replaces was modified after percuss wrote it, or was created while the command ran. The new file \
             is in its place, and the other one is kept beside it as `NAME.changed-1`.";
    }
}

impl Caution {
    /// Whether the audit of a finished run gives it, so that the scenario may accept it; the others report on a command.
    pub fn is_of_the_audit(self) -> bool {
        self <= Self::Balance
    }
}
