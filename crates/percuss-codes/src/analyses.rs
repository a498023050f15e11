//! Analyses without a result: `E101` and on.

catalogue! {
    /// Why an analysis has no result.
    pub enum AnalysisCode {
        /// No Newton step converged.
        Convergence = "E101", "no convergence",
            "Newton's iteration found no solution, however short the step was made. The message names the time and the equation that \
             did not converge. Try a smaller `time.step`; if the time stays the same, look at what happens there: `percuss animate` \
             shows the motion up to that time.";
        /// No equilibrium beyond a share of the loads.
        Equilibrium = "E102", "no equilibrium found",
            "No equilibrium was found beyond the given load factor: a limit point, which load steps cannot pass, or a load that the \
             structure cannot carry. `percuss static --path` follows the equilibrium path by arc length, beyond limit points too.";
        /// Forces of rigid contacts that do not converge.
        UnsettledContacts = "E103", "contact iteration not converged",
            "The set of closed rigid contacts and their forces did not converge beyond the given load factor. Many contact points side \
             by side over a long stretch converge slowly: use a compliant law for the contact. Otherwise the structure has reached a \
             limit point, or cannot carry the load.";
        /// A moment above the largest one in Green strains.
        MomentBeyondLaw = "E104", "moment beyond the limit of Green strains",
            "A section in Green strains carries at most the bending moment 2/3 EI / sqrt(6 I/A), and the loads require more. With \
             `strain = \"engineering\"` on the beam there is no such limit.";
        /// A rigid body that is not supported.
        NothingHolds = "E105", "unsupported body",
            "A rigid body is moved by the loads, and no contact holds it in equilibrium: statics has no friction in contacts. Support \
             it, or simulate its motion with `percuss run`.";
        /// Bodies that overlap before any load acts.
        Overlap = "E106", "initial interpenetration",
            "Two bodies overlap before any load acts, so that there is no equilibrium to start from. Move one of them, or remove the \
             contact between them.";
        /// A tangent that cannot be factorised.
        Singular = "E107", "singular tangent stiffness",
            "The linear system of a step has no unique solution at the given location: something there can move without mass and \
             without stiffness, or constraints contradict or repeat each other. Check supports and joints there.";
        /// Energy that grows without work of loads.
        Growth = "E108", "energy growth",
            "A scheme that does not conserve energy has produced more energy than was there initially and was supplied since. Use \
             `integrator.scheme = \"energy-momentum\"`, which conserves it, or a smaller `time.step`.";
        /// The rows of a run could not be written.
        Recorder = "E109", "output error",
            "Writing the rows of a run failed, most often because a disk is full; the message contains the text of the operating \
             system. Earlier results are unchanged. Free some space and run again; a run with `--checkpoint` continues with `--resume`.";
        /// No mode can be computed.
        NoModes = "E110", "no modes",
            "No movable part has mass, or the tangent stiffness of the configuration is singular, so that there are no frequencies. \
             Give the material a density, or check supports and joints.";
        /// An equilibrium path that stops before its end.
        PathEnds = "E111", "equilibrium path stopped early",
            "The equilibrium path was followed as far as `[path]` allows without reaching the requested end, or a joint of a given \
             strength would fail before. The points found are written. Allow more points or longer arcs, or request an end that the \
             structure reaches.";
        /// A result that has no derivatives.
        NoDerivative = "E112", "derivatives not available",
            "Derivatives through a run are available for beams, joined or not, on supports without prescribed motion, struck by guided \
             projectiles, up to the first event that is not differentiated. The message names the feature that is not differentiable. \
             `percuss sweep` shows the dependence on the parameter without derivatives.";
        /// A balance error above the limit of `--strict`.
        Balance = "E113", "balance error (--strict)",
            "The error of the energy, momentum or angular momentum balance exceeds 1e-10 of its scale, the limit of `--strict`. If the \
             scheme does not conserve the quantity, use `integrator.scheme = \"energy-momentum\"`; otherwise a smaller `time.step`.";
        /// An internal error of the solver.
        Broken = "E114", "internal error",
            "The solver met a state that it does not handle. This is an error of Percuss, not of the scenario; the other runs of a \
             study are not affected. Please send the scenario.";
        /// A failure after which there is no equilibrium.
        NothingLeft = "E115", "failure without a new equilibrium",
            "A part fails at the given load factor: fibres at their `failure_strain`, a spring or hinge at its failure extension, or a \
             joint at its `strength`. The remaining structure has no equilibrium at that factor. Reduce the load, strengthen the part, \
             or simulate the failure with `percuss run` and `start = \"reference\"`.";
        /// Runs of a fit that lead to no minimum.
        NoFit = "E116", "no fit",
            "No starting point of a fit leads to a minimum: its run fails, or ends early. The message has the reason. Start from values with \
             which `percuss run` completes, and narrow the bounds to such values.";
    }
}
