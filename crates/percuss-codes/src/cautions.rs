//! Warnings beside the advisor's findings: `W101` and on.

catalogue! {
    /// What deserves attention: first what the audit of a finished run found, then what a command met.
    pub enum Caution {
        /// Contact conditions that a run violates.
        ContactConditions = "W101", "contact conditions",
            "Velocities or forces of contacts do not meet their conditions (no approach of what is closed, no pull) to within 1e-8 of the \
             largest velocity. Impulses are off by that much. Look whether many contacts close at once; a compliant law avoids it.";
        /// Rigid things inside each other.
        Inside = "W102", "rigid things inside each other",
            "Rigid contacts were inside each other by more than a tenth of a micrometre. Impacts are then late and forces wrong. Use a \
             smaller `time.step`, unless something else holds them there.";
        /// One impact shared by several touching bodies.
        SharedBlow = "W103", "a shared blow",
            "Several touching bodies were struck at once, and the impact law shared the blow among them; which way it goes is a property of \
             the law, not of the bodies. With `time.multiple_impacts = \"sequential\"` it is passed on from one to the next.";
        /// Impulses that are properties of the mesh.
        MeshImpulse = "W104", "impulses of the mesh",
            "A rigid contact strikes a beam, and the mass that answers is that of a piece of the mesh: impulses and the number of impacts \
             go on changing with finer meshes. Give the contact a compliance of its own.";
        /// A balance that does not close.
        Balance = "W105", "a balance that does not close",
            "Energy, momentum or angular momentum is off by more than 1e-8 of its scale. Some schemes do not conserve energy, and then \
             this is their error: take `energy-momentum` or a smaller step. `--strict` makes it an error.";
        /// A run of the comparison of restitution coefficients that failed.
        Comparison = "W106", "a comparison that lacks a run",
            "The report compares energies under several coefficients of restitution, and the run with one of them failed. The results \
             themselves are whole. `[report] restitution` chooses the coefficients.";
        /// The user interrupted.
        Interrupted = "W107", "interrupted",
            "The command was asked to stop and did, after its step. What is there is written and says how far it came. With `--checkpoint` a \
             run goes on later with `--resume`; a sweep goes on with the same command.";
        /// Incomplete results beside complete ones.
        Incomplete = "W108", "incomplete results beside complete ones",
            "The results of a run that did not reach its end would have replaced complete ones, so they stand beside them, in the directory \
             that is told.";
        /// An equilibrium from which modes grow.
        Unstable = "W109", "an unstable equilibrium",
            "Modes about this equilibrium grow: the structure does not stay in it. Frequencies of the other modes are those of small \
             motions about it all the same.";
        /// Derivatives that end before the run.
        Horizon = "W110", "derivatives that end before the run",
            "Derivatives are followed up to an event that has none, or is not followed. Results that are decided later have no derivative; \
             those before it do.";
        /// Derivatives that hold on one side.
        OneSided = "W111", "one-sided derivatives",
            "A contact, or the yielding of a beam, is about to appear or to vanish: the change of the parameter that is told is enough, to first \
             order. Beyond it the run takes another course, which derivatives do not tell of.";
        /// Runs of a study that did not end well.
        FailedRuns = "W112", "runs that did not end well",
            "Runs of the study are no sound scenarios, or the solver gave up on them. Their rows have a reason, with its code, instead of \
             results; statistics leave them out.";
        /// A result that no run has.
        NoValues = "W113", "a result that no run has",
            "The path of a result led to no number in any run: the contact never closed, say. It is not a spelling: that would have been a \
             fault.";
        /// A scenario that is sound and that a run refuses.
        NotForRuns = "W114", "a scenario for statics alone",
            "Something that can move has no mass: statics does not ask for it, a run in time does. Give the material a density or the \
             point a mass.";
        /// Runs of a study that will be refused.
        UnsoundRuns = "W115", "runs that will be refused",
            "Some values of the study make no sound scenario. The others run; these will be rows with a reason. Look whether a range reaches \
             too far.";
        /// No browser.
        Browser = "W116", "no browser",
            "No program of this machine opens the page. It is there all the same: open it by hand, or copy it to where there is a browser.";
        /// Linear buckling that cannot be told.
        NoBuckling = "W117", "no linear buckling factor",
            "A linear buckling factor exists where the structure is stable without loads, elastic, and its loads keep their direction; and \
             the search may miss one that is counted. Modes about the static equilibrium, or the path of equilibria (`percuss static \
             --path`), tell what the structure carries.";
        /// A file that was changed while a command worked.
        Changed = "W118", "a file that was changed meanwhile",
            "A file that the command replaces was changed since it was written, or came to stand there while the command worked. The new one is in its \
             place, and the changed one is kept beside it as `NAME.changed-1`.";
    }
}

impl Caution {
    /// Whether it is told by the audit of a finished run, so that the scenario may allow it; others tell how a command went.
    pub fn is_of_the_audit(self) -> bool {
        self <= Self::Balance
    }
}
