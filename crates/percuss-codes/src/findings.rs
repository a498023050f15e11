//! What the model and result checks (the advisor) judge: `W001` and on.

catalogue! {
    /// What a finding of the advisor is about.
    pub enum Topic {
        /// Time of the first contact against the end of the run \[s\].
        FirstContact = "W001", "first contact",
            "The run ends before or during the first contact. Give a later `time.end`, a higher speed or a smaller distance.";
        /// Duration of the contact, expected or seen, against the step \[s\].
        ContactDuration = "W002", "contact duration",
            "The step is long compared with the duration of a contact: before a run the expected one of the first contact, after it \
             that with the largest force of every contact, and of every stop, rope, spring and foundation that can be open or slack; or \
             a damper's force falls within the step in which a gap closes. Peak forces and impulses \
             need about twenty steps; with fewer the peak force is missed. Use a `time.step` of 1/20 of the given duration; `percuss \
             converge FILE` shows the remaining dependence on it.";
        /// Length of the shortest relevant bending waves of the contact, against the elements \[m\].
        BendingWave = "W003", "bending wave",
            "The relevant bending waves are shorter than one or two elements, so that the mesh does not transport them; forces are too \
             large or oscillate. Use more `elements` for the struck beam.";
        /// Time of a longitudinal wave through an element against the step \[s\].
        WaveTransit = "W004", "wave transit",
            "The step is longer than the travel time of a longitudinal wave through an element. The scheme stays stable, but axial \
             waves are smoothed over several elements. This matters for axial forces after an impact; use a shorter `time.step` for \
             them.";
        /// Effective mass of the struck point on this mesh against its limit \[kg\].
        EffectiveMass = "W005", "effective mass",
            "With rigid contact the impulse depends on the effective mass, which on this mesh differs from its limit under refinement: \
             the impulse depends on the mesh. Use a compliant contact law, or check impulses with `percuss converge FILE`. On a \
             shear-flexible beam (`theory = \"shear\"`) the limit is zero, and the force just after an impact has a limit: twice the speed \
             times the root of shear stiffness and mass per length.";
        /// Contact stiffness, as a linear spring, against that of Hertz' contact \[N/m\].
        Stiffness = "W006", "contact stiffness",
            "The contact is much softer or stiffer than a Hertz contact between bodies of these materials and radii. That may be \
             intended (a rubber pad, a penalty); if not, check the units of the stiffness, or use `law = \"hertz\"`.";
        /// Distance of the nearest support or end against that from which waves return within the contact \[m\].
        Span = "W007", "minimum span",
            "Waves return from the nearest support or end during the contact, so that formulas for an infinite beam do not hold. The \
             run is correct; its results hold for this span, not for an infinite beam.";
        /// Period of a secondary mass on its spring against the step \[s\].
        RearMass = "W008", "secondary mass",
            "The step does not resolve the vibration of the secondary mass (`rear`). Use a shorter `time.step`.";
        /// Shear deformation, which the beams neglect, against a relevant share \[-\].
        Shear = "W009", "shear deformation",
            "Beams are Bernoulli beams: their sections stay normal to the axis. For short or thick beams, and for short waves, shear \
             deformation is not small: frequencies are too high and deflections too small, by about the given percentage. It uses the \
             shear stiffness of material and section (`poisson` or `shear_modulus`; shape or `shear_factor`) where that is known. Beams with \
             `theory = \"shear\"` have it.";
        /// Axial force against that under which a straight beam buckles \[N\]; of a start from equilibrium, whether it is stable.
        Stability = "W010", "stability",
            "A straight beam under this axial force would buckle, or the equilibrium at the start of the run is unstable. A perfectly \
             straight beam may stay straight: give an imperfection or a small lateral load, and see `percuss static`.";
        /// Time in which the force of a bar on a wall rises, against that of a wave through an element or the step \[s\].
        ForceRise = "W011", "force rise time",
            "The force of a bar on a wall rises within less than a step or the passage of a wave through an element: it overshoots by \
             up to a factor of two. Use a shorter step and more elements, or the impulse instead of the peak.";
        /// Time between rows of the history against the contact \[s\].
        Recording = "W012", "output interval",
            "The output interval of the history is longer than the contact: curves and figures may miss it; peaks and impulses of the \
             summary do not. Use a smaller `record.every`.";
        /// Peak reactions due to rigid impacts or to jumps of prescribed velocities.
        Reactions = "W013", "mesh-dependent reactions",
            "Rigid impacts on a beam, and velocity jumps of driven supports, excite waves as short as an element: peak reactions and \
             section forces depend on mesh and step, and grow with refinement. Use impulses and displacements, a compliant contact, or \
             a smooth motion. On a shear-flexible beam (`theory = \"shear\"`) forces have a limit where a mass stays in contact.";
        /// A section that varies along a beam, against one whose depth does.
        Taper = "W014", "tapered section",
            "The second moment of area is interpolated linearly between two stations of a beam. Where the depth varies linearly, it \
             follows the third or fourth power of the depth, and the interpolated value is too large. Add stations in between.";
        /// Compressive strain against the range of a strain measure.
        Strain = "W015", "large compressive strain",
            "The axis is compressed so much that Green's strain and the engineering strain differ, and forces with them. Compare with \
             `strain = \"engineering\"`; if the difference matters, so does the law of the material. Check the section, the speed and \
             the units.";
        /// Contacts, stops, springs and foundations that were not complete when the run ended.
        Ending = "W016", "contact incomplete at the end of the run",
            "The run ended while a contact was closed, or before the first contact: durations and impulses are incomplete and the peak \
             force may follow. So it may of a stop, rope, spring or foundation that closed during the run and has its largest force \
             since then at the end. Give a later `time.end`; a run with `--checkpoint` continues with `percuss extend`.";
        /// A value that is far from the usual ones, against the nearest usual one.
        Magnitude = "W017", "suspicious magnitude (unit?)",
            "A value is so far from the usual range that a unit is likely wrong by a power of ten (mm for m, MPa for Pa, g for kg). \
             Ignore this warning if the value is intended.";
        /// The largest stress of an elastic beam against the usual strength of its material \[Pa\].
        Strength = "W018", "usual strength exceeded",
            "The stress exceeds the usual strength of the material: structural steel yields at 235 MPa, concrete cracks at 2.9 MPa. It is \
             that of the extreme fibres or, where shear governs in a material as strong in tension as in compression, the von Mises \
             stress inside the section. The material is modelled as elastic, so that forces are too large and deflections too small. \
             Give the material `yield` (and `hardening`, `rate`, `failure_strain`), or, where your material is stronger, accept the \
             warning with its strength in `[allow]`.";
        /// Distance of the static equilibrium at the start from the reference configuration, against the size of the structure \[m\].
        StaticStart = "W019", "static start far from the reference",
            "With `time.start = \"static\"` the run starts from the equilibrium under the loads at time zero, which here is far from \
             the reference configuration: a pendulum hangs down, or a soft beam sags. If that is not intended, start from the reference \
             (`start = \"reference\"`), support it, or describe it in its equilibrium position.";
        /// A compliant contact of faces or of a flat end, whose stiffness depends on the mesh \[N/m\].
        FaceStiffness = "W020", "mesh-dependent contact stiffness",
            "Each contact point acts with the full law where beams touch along their faces, or with a flat end on a face: two points an \
             element. Refinement adds points, so that the stiffness and the force of the contact grow, and its duration falls, without \
             limit. Replace one of the two by a disc, or give it round ends; `percuss converge FILE` shows the dependence on the mesh.";
        /// Coincident ends of two beams that are not connected.
        LooseEnds = "W021", "unconnected beam ends",
            "The ends of two beams coincide without a joint, spring or contact, so they move independently. Beams are connected only by \
             `[joint.*]`; the message gives the missing one.";
        /// Penetration of a compliant contact against the distance of the axes or centres \[m\].
        Pressed = "W022", "deep penetration",
            "A compliant contact is penetrated by more than half the distance at which the axes or centres of the two bodies meet: by \
             more than half a depth, for two beams of equal depth. At such a penetration the force still follows the law, but its \
             location and direction are unreliable. Use a stiffer law (for example a table that stiffens), or larger depths.";
        /// Depth of an indentation that moved along a face \[m\].
        CarriedCrush = "W023", "indentation moved along the face",
            "A body slid under load along a face that crushes, and the indentation moved with it at its full depth: the law has no \
             tangential force, so that no new indentation forms. The force is too small there. Use the results up to that time; \
             friction, a larger `unloading_stiffness` or a law without crushing change it.";
        /// Estimated error of steps that were chosen for an accuracy, against that accuracy \[-\].
        Accuracy = "W024", "accuracy not reached",
            "Steps are chosen for `time.accuracy`, but not shorter than a hundredth of the first one, and the estimated error of some is \
             larger than requested: the motion there has no shortest time scale, as with many short contacts or with velocities that jump. \
             Request a lower accuracy, use a softer contact, or give a `time.step` and compare results with those of half of it (`percuss \
             converge FILE`).";
        /// Section forces over what the section bears with the strain that it has, less one; before a run the estimate of it.
        Unresolved = "W025", "yielding not resolved by the mesh",
            "Moment or axial force exceed what the section can bear with the strain that it has: the mesh does not resolve a plastic \
             hinge, and the structure bears too much, or does not collapse where the real one does. Use more `elements` (the message \
             says how many); those of a beam that can yield are short at supports, joints, loads and softly struck points, unless \
             `grading` is given. Where a rigid mass strikes, compare permanent deflections with those of twice as many.";
        /// Largest strain, or stress over Young's modulus, against that up to which the law of the material holds \[-\].
        Ductility = "W026", "strain beyond the material",
            "A plastic strain exceeds the strain at the largest force of the material, a strain exceeds 5 %, and the material has no \
             `failure_strain`, or a stress exceeds a tenth of Young's modulus: no usual material follows its law so far. Give a \
             `failure_strain` (and `hardening`), or a law that was measured up to that strain; check units and mesh.";
        /// A foundation of compression alone from which the weight pulls its beam away.
        Bed = "W027", "foundation on the wrong side",
            "A foundation with `law = \"compression\"` pushes in the direction in which the weight acts and never pulls, so that it does \
             not carry the beam. Without `direction` it pushes to the left of the direction in which the beam is drawn: upwards for a \
             beam drawn from left to right. Set its `direction`, or draw the beam in the other direction; if it is meant to hold the beam \
             down, accept the warning in `[allow]`.";
    }
}

impl Topic {
    /// Whether it may be found from the results of a run though nothing is found before.
    pub fn is_found_after_a_run(self) -> bool {
        matches!(
            self,
            Self::ContactDuration
                | Self::Reactions
                | Self::Strain
                | Self::Ending
                | Self::Strength
                | Self::Pressed
                | Self::CarriedCrush
                | Self::Accuracy
                | Self::Ductility
        )
    }
}
