//! What the advisor judges: `W001` and on.

catalogue! {
    /// What a finding of the advisor is about.
    pub enum Topic {
        /// Time of the first touch against the end of the run \[s\].
        Touch = "W001", "first touch",
            "The run ends before anything touches, or shortly after: there is no impact in it, or none that is seen to its end. \
             Give a later `time.end`, a higher speed or a smaller distance.";
        /// Expected duration of the contact against the step \[s\].
        ContactDuration = "W002", "contact duration",
            "The step is long for the time the contact is expected to last. Peak forces and impulses of a contact need some twenty \
             steps; with fewer the largest force is missed. Give a `time.step` of a twentieth of the duration that is told; \
             `percuss converge FILE` shows how far results still depend on it.";
        /// Length of the shortest bending waves of weight that the contact sends out, against the elements \[m\].
        BendingWave = "W003", "bending wave",
            "An impact sends out bending waves; those that carry weight are shorter than an element or two, so that the mesh cannot \
             carry them away from the contact. Forces come out too large or ring. Give more `elements` to the struck beam.";
        /// Time of a longitudinal wave through an element against the step \[s\].
        WaveTransit = "W004", "wave transit",
            "The step is longer than a longitudinal wave takes through an element. The scheme stays stable, but axial waves are \
             smeared over several elements. It matters where axial forces after an impact are read; give a shorter `time.step` \
             then.";
        /// Effective mass of the struck point on this mesh against its limit \[kg\].
        EffectiveMass = "W005", "effective mass",
            "Under a rigid law an impulse depends on the mass that the struck point opposes to it, and on this mesh that is far \
             from its limit on ever finer ones: the impulse is a property of the mesh. Use an elastic contact law, or read impulses \
             with care and `percuss converge FILE`.";
        /// Contact stiffness, as a linear spring, against that of Hertz' contact \[N/m\].
        Stiffness = "W006", "contact stiffness",
            "The contact is much softer or stiffer than Hertz' contact between bodies of these materials and radii would be. That \
             may be meant (a rubber pad, a penalty); if not, look at the units of the stiffness, or give `law = \"hertz\"`.";
        /// Distance of the nearest support or end against that from which waves return within the contact \[m\].
        Span = "W007", "minimum span",
            "Waves return from the nearest support or end while the contact lasts, so that formulas for an infinite beam do not \
             hold. Nothing is wrong with the run; results belong to this structure and not to a long one.";
        /// Period of a rear mass on its spring against the step \[s\].
        RearMass = "W008", "rear mass",
            "The mass behind the spring of a projectile swings faster than the step resolves. Give a shorter `time.step`.";
        /// Shear deformation, which beams here leave out, against what matters \[-\].
        Shear = "W009", "shear deformation",
            "Beams here keep their sections normal to the axis. For short or thick beams, and for short waves, shear deformation is \
             no longer small: frequencies come out too high and deflections too small, by about the share that is told.";
        /// Axial force against that under which a straight beam buckles \[N\]; of a start from equilibrium, whether it is stable.
        Stability = "W010", "stability",
            "A straight beam under this axial force would buckle, or the equilibrium that the run starts from is unstable. A \
             perfectly straight beam may stay straight all the same: give an imperfection or a small lateral load, and see `percuss \
             static`.";
        /// Time in which the force of a bar on a wall rises, against that of a wave through an element or the step \[s\].
        ForceRise = "W011", "rise of the force",
            "The force of a bar on a wall rises within less than a step or the passage of a wave through an element: it overshoots \
             by up to a factor of two. Give a shorter step and more elements, or read the impulse instead of the peak.";
        /// Time between rows of the history against the contact \[s\].
        Recording = "W012", "recording",
            "Rows of the history are further apart than the contact lasts: curves and figures may miss it, though peaks and \
             impulses of the summary do not. Give a smaller `record.every`.";
        /// Largest reactions where rigid impacts, or jumps of prescribed velocities, make them.
        Reactions = "W013", "reactions",
            "Rigid impacts on a beam, and driven supports whose velocity jumps, send out waves as short as its elements: largest reactions \
             and section forces are those of this mesh and step, and finer ones have larger ones. Read impulses and displacements, give \
             the contact a compliance, or the motion a smooth course.";
        /// A section that varies along a beam, against one whose size does.
        Taper = "W014", "taper",
            "Between two stations of a beam the second moment of area is a straight line. Where it is the size of the section that \
             varies evenly, the second moment goes with its third or fourth power, and the line is too large between. Give stations \
             in between.";
        /// Compressive strain against what a strain measure can be trusted with.
        Strain = "W015", "strain",
            "The axis is compressed so much that Green's strain and the engineering strain differ, and forces with them. Compare \
             with `strain = \"engineering\"`; if that matters, so does the law of the material. Look at the section, the speed and \
             the units.";
        /// What was still to come when the run ended.
        Ending = "W016", "end of the run",
            "The run ended while a contact was still closed, or before any had closed: durations and impulses are not whole, and \
             the largest force may still come. Give a later `time.end`; a run that had `--checkpoint` goes on with `percuss \
             extend`.";
        /// A value so far from what things are made of that it looks like a slip of a unit, against the nearest usual one.
        Slip = "W017", "a slip of a unit?",
            "A value lies so far from what things are made of that a unit is likely wrong by a power of ten (mm for m, MPa for Pa, \
             g for kg). If it is meant, nothing is wrong.";
        /// The largest stress of an elastic beam against what its material usually bears \[Pa\].
        Strength = "W018", "beyond the strength",
            "A beam of a material known by name is stressed beyond what that material usually bears: structural steel \
             yields at 235 MPa, concrete cracks at 2.9. In the run it stays elastic all the same, so that forces come \
             out too large and deflections too small. Give the material `yield` (and `hardening`, `rate`, \
             `failure_strain`), or, where yours bears more, allow it with the strength it has.";
        /// How far the static equilibrium that a run starts from lies from the drawn configuration, against the size of the structure \[m\].
        StaticStart = "W019", "a start far from the drawing",
            "With `time.start = \"static\"` the run starts from the equilibrium under the loads that act at time zero, and here that \
             lies far from what is drawn: a pendulum has swung down, or something soft has sagged. If that is not meant, start from \
             the reference (`start = \"reference\"`), hold what swings, or draw it where it hangs.";
        /// A compliant contact of faces or of a flat end, which has no stiffness of its own \[N/m\].
        FaceStiffness = "W020", "a stiffness that grows with the mesh",
            "Where beams meet along their faces, or with a flat end on a face, every point that lies in the contact presses under the \
             law: two an element. Finer meshes have more of them, so that the contact gets stiffer, its force larger and its \
             duration shorter without limit. Let one of both be a disc or give it round ends; `percuss converge FILE` shows \
             how far results depend on the mesh.";
        /// Ends of two beams at one place that nothing joins.
        LooseEnds = "W021", "ends that nothing joins",
            "The ends of two beams lie at one place, and there is neither a joint nor a spring nor a contact between them: each moves as if \
             the other were not there. Beams are joined where a `[joint.*]` says so; the message gives the one that is missing.";
        /// Penetration of a compliant contact against that at which the middles of both meet \[m\].
        Pressed = "W022", "pressed in deep",
            "A compliant contact is pressed in by more than half of what it takes until the middles of both, axes or centres, meet: by more \
             than half a depth, where two beams of one depth touch. Outlines that deep inside each other mean little: the force goes on \
             growing by the law, but from where it acts and which way it points is that of lines that go through each other. Give the \
             law more stiffness (a table that locks, say), or thicker outlines.";
        /// How deep a dent was carried along a face \[m\].
        CarriedCrush = "W023", "a dent carried along",
            "Something slid along a face that crushes while it pressed, and went on as deep as it had been pushed in before: the law has no \
             force along the face, so that nothing could push the face in anew. Its force is too small there, and the face is not \
             dented. Read what happens up to then; friction, a larger `unloading_stiffness` or a law without crushing change it.";
    }
}

impl Topic {
    /// Whether it is judged from the results of a run alone, so that nothing is known of it before.
    pub fn is_found_after_a_run(self) -> bool {
        matches!(
            self,
            Self::Reactions | Self::Strain | Self::Ending | Self::Strength | Self::CarriedCrush
        )
    }
}
