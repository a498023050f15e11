//! Verification of Percuss: results against closed forms, published figures and references computed independently.
//!
//! A case is a function that returns its [`Check`]s; its documentation names the source of every expected number. The same
//! cases run in the test suite and behind `percuss verify`.

mod beams;
mod check;
mod conservation;
mod elastic;
mod rigid;
mod structure;

pub use check::{Check, Tolerance};

/// A verification case.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    /// Short name, unique.
    pub id: &'static str,
    /// What is verified.
    pub title: &'static str,
    /// Where the expected numbers come from.
    pub source: &'static str,
    /// Runs it.
    pub run: fn() -> Vec<Check>,
}

/// Every case, in the order of the manual.
pub const CASES: &[Case] = &[
    Case {
        id: "elastic-clamped",
        title: "Elastic projectile on a clamped beam: figures and order of convergence",
        source: "limit h -> 0 of the paper's example (section 2.3), independent implementation",
        run: elastic::clamped,
    },
    Case {
        id: "elastic-converged",
        title: "E3: the same on a converged mesh, both strain measures, low velocity",
        source: "reference on 384 elements, independent method",
        run: elastic::converged_mesh,
    },
    Case {
        id: "elastic-elementary",
        title: "E8: mass and spring against a wall; two free masses",
        source: "closed form",
        run: elastic::elementary,
    },
    Case {
        id: "large-steps",
        title: "Unsupported elastic example at steps of 5e-3 and 1e-2 s for 20 s",
        source: "conservation laws",
        run: elastic::large_steps,
    },
    Case {
        id: "rigid-first-impact",
        title: "F1, trap 3: impulse and loss of the first impact",
        source: "closed form (1 + e) mu |v|, mu = M m_eff / (M + m_eff)",
        run: rigid::first_impact,
    },
    Case {
        id: "rigid-sequence",
        title: "Rigid example, restitution 1: impacts of the limit h -> 0, error falling fourfold",
        source: "adaptive 8th-order Runge-Kutta with located events, rtol 1e-11",
        run: rigid::sequence,
    },
    Case {
        id: "rigid-linear",
        title: "F2: whole sequence of impacts in the linear range",
        source: "exact modal sums with located events",
        run: rigid::linear_sequence,
    },
    Case {
        id: "bouncing-ball",
        title: "F3: bouncing ball, accumulation of impacts and rest",
        source: "closed form",
        run: rigid::bouncing_ball,
    },
    Case {
        id: "rigid-rod",
        title: "F4: free rigid rod struck off its middle",
        source: "closed form",
        run: rigid::rigid_rod,
    },
    Case {
        id: "effective-mass",
        title: "Trap 2: effective mass of the struck point on 2 to 768 elements",
        source: "closed form 1 / (n M^-1 n^T); limit 2 sqrt(rhoA rhoI)",
        run: rigid::effective_mass,
    },
    Case {
        id: "frequencies",
        title: "B: natural frequencies, six elements with rotary inertia",
        source: "closed form of the discrete problem",
        run: beams::frequencies,
    },
    Case {
        id: "flying-beam",
        title: "C2: beam thrown by a force and a torque, invariants of its flight",
        source: "Simo and Vu-Quoc 1986; closed forms; first-order reference (0.3 %)",
        run: beams::flying_beam,
    },
    Case {
        id: "paper-books",
        title: "Books of every scenario in scenarios/paper",
        source: "conservation laws",
        run: conservation::paper_books,
    },
    Case {
        id: "paper-forms",
        title: "What the paper's own forms do: midpoint force, time-stepping",
        source: "independent implementation of the same forms",
        run: conservation::paper_forms,
    },
    Case {
        id: "strain-history",
        title: "Trap 4: only stored curvature drifts, with the square of the step",
        source: "identity of the Green membrane strain; order of the scheme",
        run: conservation::strain_history,
    },
    Case {
        id: "time-reversal",
        title: "Velocities flipped, the motion runs back",
        source: "invariance of the equations",
        run: conservation::time_reversal,
    },
    Case {
        id: "rigid-motion",
        title: "The scene turned and moved",
        source: "invariance of the equations",
        run: conservation::rigid_motion,
    },
    Case {
        id: "contact-point",
        title: "A struck point inside an element against one at a node",
        source: "mesh error",
        run: conservation::contact_point,
    },
    Case {
        id: "same-bits",
        title: "The same input twice",
        source: "identity",
        run: conservation::same_bits,
    },
];
