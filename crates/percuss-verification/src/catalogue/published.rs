//! Cases whose scenes are scenario files: published ones, and closed forms of engineering textbooks.

use crate::{Case, published_motion, published_statics};

pub(super) const PUBLISHED: &[Case] = &[
    Case {
        id: "overhanging-beam",
        title: "A beam with overhangs under a uniform load",
        source: "ANSYS VM2; closed form",
        run: published_statics::overhanging_beam,
    },
    Case {
        id: "tapered-cantilever",
        title: "Stresses of a cantilever whose depth grows to its root",
        source: "ANSYS VM5; closed form",
        run: published_statics::tapered_cantilever,
    },
    Case {
        id: "t-section",
        title: "Bending of a T section",
        source: "ANSYS VM10; closed form",
        run: published_statics::t_section,
    },
    Case {
        id: "propped-cantilever",
        title: "A cantilever propped at its end under a uniform load",
        source: "closed form",
        run: published_statics::propped_cantilever,
    },
    Case {
        id: "pressed-ring",
        title: "A thin ring pressed by two forces",
        source: "closed form (Timoshenko, Strength of Materials II)",
        run: published_statics::pressed_ring,
    },
    Case {
        id: "portal-sway",
        title: "Linear buckling of a portal frame that sways",
        source: "closed form (Timoshenko and Gere, Theory of Elastic Stability)",
        run: published_statics::portal_sway,
    },
    Case {
        id: "euler-columns",
        title: "Euler's four columns, order in the element size",
        source: "closed form",
        run: published_statics::euler_columns,
    },
    Case {
        id: "two-springs",
        title: "Two springs and a force, with large displacements",
        source: "ANSYS VM9; least potential energy",
        run: published_motion::two_springs,
    },
    Case {
        id: "deep-beam",
        title: "NAFEMS FV5: frequencies of a deep beam, and what shear is worth",
        source: "NAFEMS FV5 (Abaqus benchmark); closed forms of Rayleigh and Timoshenko",
        run: published_motion::deep_beam,
    },
    Case {
        id: "ring-modes",
        title: "In-plane modes of a thin ring",
        source: "closed form (Love)",
        run: published_motion::ring_modes,
    },
    Case {
        id: "stepped-load",
        title: "NAFEMS 5T: a deep beam under a load put on at once",
        source: "NAFEMS 5T (Altair); sum over modes",
        run: published_motion::stepped_load,
    },
    Case {
        id: "rise-time",
        title: "A beam that bears a mass under a force with a rise time",
        source: "ANSYS VM77 (Biggs 1964); closed form",
        run: published_motion::rise_time,
    },
    Case {
        id: "dropped-container",
        title: "A container dropped on a spring",
        source: "ANSYS VM65, VM81; closed form",
        run: published_motion::dropped_container,
    },
    Case {
        id: "struck-rod",
        title: "Saint-Venant's rod struck by a mass behind a spring",
        source: "waves with a delay, integrated finely",
        run: published_motion::struck_rod,
    },
    Case {
        id: "bead-column",
        title: "Three rigid beads fall on a floor, 24 impacts",
        source: "event to event, closed form between",
        run: published_motion::bead_column,
    },
    Case {
        id: "fibre-bar",
        title: "A bar of fibres pulled beyond yield",
        source: "code_aster SSNL106; closed form",
        run: published_motion::fibre_bar,
    },
];
