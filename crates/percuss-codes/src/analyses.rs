//! Analyses that give up: `E101` and on.

catalogue! {
    /// Why an analysis has no result.
    pub enum AnalysisCode {
        /// Newton's iteration failed down to the smallest step.
        Convergence = "E101", "a step that does not converge",
            "Newton's iteration found no solution, however short the step was made. The message names the time and what did not \
             settle. Try a smaller `time.step`; if the time stays the same, look at what happens there: `percuss animate` shows \
             how far the run came.";
        /// No equilibrium beyond a share of the loads.
        Equilibrium = "E102", "no equilibrium found",
            "Beyond the share of the loads that is told no equilibrium was found: a limit point, which load steps do not pass, or a \
             load that the structure cannot carry. `percuss static --path` follows the equilibrium by arc length, beyond a limit \
             point too.";
        /// Forces of rigid contacts that do not settle.
        UnsettledContacts = "E103", "contact forces that do not settle",
            "Which rigid contacts press, and how much, was not found beyond a share of the loads. Those that lie side by side over \
             a long stretch settle slowly: give the contact a compliant law. Else it is a limit point, or a load that the structure \
             cannot carry.";
        /// A moment that no curvature gives in Green strains.
        MomentBeyondLaw = "E104", "a moment beyond the law",
            "A section in Green strains carries a largest bending moment, 2/3 EI / sqrt(6 I/A), and the loads ask for more. With \
             `strain = \"engineering\"` on the beam there is no such limit.";
        /// A rigid body that the loads carry away.
        NothingHolds = "E105", "a body that nothing holds",
            "The loads carry a rigid body away, and no contact holds it in equilibrium: in statics contacts have no friction. Support \
             it, or simulate its motion with `percuss run`.";
        /// One thing inside another before any load acts.
        Overlap = "E106", "things inside each other",
            "Before any load acts one thing is inside another, so there is no equilibrium to begin with. Move one of them, or leave \
             their contact out.";
        /// A tangent that cannot be factorised.
        Singular = "E107", "a singular tangent",
            "The linear system of a step has no unique solution at the place that is told: something there can move without mass and \
             without stiffness, or constraints contradict or repeat each other. Look at supports and joints there.";
        /// Energy that grows out of nothing.
        Growth = "E108", "energy out of nothing",
            "A scheme that does not conserve energy has made more of it than all that was there or came in. Take `integrator.scheme = \
             \"energy-momentum\"`, which conserves it, or a smaller `time.step`.";
        /// What receives the rows of a run failed.
        Recorder = "E109", "results that could not be recorded",
            "What receives the rows of a run failed on the way, most often because a disk is full; the message says what the system \
             said. Earlier results stay as they were. Make room and run it again; with `--checkpoint` it goes on where it was.";
        /// No mode can be computed.
        NoModes = "E110", "no modes",
            "Nothing that can move has mass, or the tangent of the configuration is singular, so that there are no frequencies. Give \
             the material a density, or look at supports and joints.";
        /// An equilibrium path that ends before its end.
        PathEnds = "E111", "a path that ends early",
            "The equilibrium path was followed as far as `[path]` allows, and the end that was asked for was not reached, or a joint of a given \
             strength would tear on the way. What was found is written. Allow more points or longer arcs, or ask for an end that the structure reaches.";
        /// A result that has no derivatives.
        NoDerivative = "E112", "a result without derivatives",
            "Derivatives through a run are known of beams, joined or not, on supports that stay where they are, that guided projectiles \
             strike, up to the first event that is not followed. The message names what stands against them. `percuss sweep` shows how the result depends on the parameter \
             all the same.";
        /// A balance that is asked for and does not close.
        Balance = "E113", "a balance that does not close (--strict)",
            "Energy, momentum or angular momentum of the run is off by more than 1e-10 of its scale, and `--strict` asks for less. The \
             scheme may not conserve it: then take `integrator.scheme = \"energy-momentum\"`. Else give a smaller `time.step`.";
        /// The solver broke down, or lost a run.
        Broken = "E114", "the solver broke down",
            "The program met something that it does not know of. This is a fault of Percuss, not of the scenario: the other runs of a \
             study are not touched. Please send the scenario.";
        /// Something that fails and leaves no equilibrium.
        NothingLeft = "E115", "a failure that leaves no equilibrium",
            "On the way to the loads something fails for good at the load factor that is told: fibres at their `failure_strain`, a spring or \
             hinge at its failure extension, a joint at its `strength`. Without it no equilibrium was found at that factor. Take the load \
             down, make what fails stronger, or see with `percuss run` and `start = \"reference\"` where the structure falls to.";
    }
}
