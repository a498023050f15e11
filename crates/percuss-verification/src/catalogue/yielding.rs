//! Cases of beams, springs and hinges that yield.

use crate::{
    Case, interaction, layered, plastic_bars, plastic_bending, rigid_plastic, strength,
    yielding_joints,
};

pub(super) const YIELDING: &[Case] = &[
    Case {
        id: "plastic-cycles",
        title: "Bars pulled and pressed beyond yield: stress, what is dissipated and stored",
        source: "closed form, isotropic and kinematic hardening",
        run: plastic_bars::cycles,
    },
    Case {
        id: "plastic-rates",
        title: "Bars pulled at a steady rate, viscous overstress",
        source: "Cowper and Symonds 1957; closed form; Runge and Kutta",
        run: plastic_bars::rates,
    },
    Case {
        id: "plastic-wave",
        title: "A bar whose end is pulled at once: precursor and plastic front",
        source: "closed form (Donnell 1930; von Karman and Duwez 1950)",
        run: plastic_bars::plastic_wave,
    },
    Case {
        id: "three-bars",
        title: "Three bars in a fan, loaded until all yield and unloaded",
        source: "ANSYS VM11; closed form",
        run: plastic_bars::fan,
    },
    Case {
        id: "plastic-bending",
        title: "Moment and curvature of a rectangle beyond yield, by the number of fibres",
        source: "closed form; ANSYS LS-DYNA verification case 003",
        run: plastic_bending::moment_and_curvature,
    },
    Case {
        id: "plastic-moments",
        title: "Fully plastic moments of five shapes",
        source: "closed form",
        run: plastic_bending::plastic_moments,
    },
    Case {
        id: "layered-sections",
        title: "Layers of two metals and a reinforced rectangle: stresses, first yield, plastic moment",
        source: "closed form, transformed section",
        run: layered::layered_sections,
    },
    Case {
        id: "interaction",
        title: "Axial force and moment together that a rectangle bears",
        source: "closed form, M/M0 = 1 - (N/N0)^2",
        run: interaction::interaction,
    },
    Case {
        id: "explosive-ring",
        title: "A free ring that sheet explosive closes, by hardening and by rate",
        source: "Clark et al. 1962; Abaqus benchmark of the free ring",
        run: plastic_bending::explosive_ring,
    },
    Case {
        id: "heavy-mass",
        title: "A heavy mass on clamped and pinned beams, rigid-plastic",
        source: "closed form (Haythornthwaite 1957; Jones 1989)",
        run: rigid_plastic::heavy_mass,
    },
    Case {
        id: "parkes",
        title: "A cantilever struck at its tip, rigid-plastic",
        source: "closed form (Parkes 1955)",
        run: rigid_plastic::parkes,
    },
    Case {
        id: "thrown-beam",
        title: "A velocity on all of a beam, rigid-plastic",
        source: "closed form (Symonds; Jones 1989)",
        run: rigid_plastic::thrown,
    },
    Case {
        id: "thrown-bar",
        title: "A stiff bar thrown round a hinge that yields",
        source: "closed form",
        run: yielding_joints::thrown_bar,
    },
    Case {
        id: "mass-on-a-rod",
        title: "A mass on a rod that yields under a force that acts at once",
        source: "ANSYS VM80 (Biggs 1964); closed form",
        run: yielding_joints::mass_on_a_rod,
    },
    Case {
        id: "portal-pushover",
        title: "A portal whose hinges yield one after the other",
        source: "slope-deflection method; plastic-hinge analysis",
        run: yielding_joints::portal_pushover,
    },
    Case {
        id: "strong-joints",
        title: "Joints that part when a growing load reaches their strength",
        source: "closed form",
        run: strength::strong_joints,
    },
    Case {
        id: "failing-bar",
        title: "A bar that yields until all of its fibres fail at once",
        source: "closed form",
        run: strength::failing_bar,
    },
];
