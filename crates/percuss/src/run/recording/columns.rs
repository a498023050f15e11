//! Names, units and descriptions of the columns of a history whose names contain none of a model.

/// Columns of the section at a recorded point: axial force, shear force and moment, and with a depth stresses.
pub(super) const SECTION_COLUMNS: [(&str, &str, &str); 6] = [
    ("axial", "N", "Axial force at the point, positive in tension"),
    ("shear", "N", "Shear force at the point"),
    ("moment", "N*m", "Bending moment at the point"),
    ("stress", "Pa", "Stress of the extreme fibre (top or bottom) with the larger magnitude"),
    (
        "stress_top",
        "Pa",
        "Stress at the top fibre: left of the direction of increasing s, the upper face of a beam drawn from left to right",
    ),
    (
        "stress_bottom",
        "Pa",
        "Stress at the bottom fibre: right of the direction of increasing s, the lower face of a beam drawn from left to right",
    ),
];

/// How many of [`SECTION_COLUMNS`] are forces and the moment.
pub(super) const FORCE_COLUMNS: usize = 3;

/// Columns of histories of yielding parts.
pub(super) const PLASTIC_COLUMNS: [(&str, &str); 3] = [
    ("energy.plastic", "Energy dissipated by plastic flow so far"),
    ("energy.hardening", "Energy stored in hardening"),
    (
        "energy.failure",
        "Energy that had been stored in the fibres, springs and hinges that failed so far",
    ),
];

/// Column of histories of shear-flexible beams.
pub(super) const SHEAR_COLUMN: (&str, &str, &str) = (
    "energy.strain_shear",
    "J",
    "Shear strain energy of shear-flexible beams, not contained in that of bending",
);

/// Columns every history has.
pub(super) const BALANCE_COLUMNS: [(&str, &str, &str); 24] = [
    ("energy.kinetic", "J", "Kinetic energy"),
    ("energy.kinetic_beams", "J", "Kinetic energy of the beams"),
    ("energy.kinetic_projectiles", "J", "Kinetic energy of the projectiles"),
    ("energy.strain", "J", "Strain energy"),
    ("energy.strain_axial", "J", "Axial strain energy"),
    ("energy.strain_bending", "J", "Bending strain energy"),
    ("energy.contact", "J", "Energy of the contact springs"),
    ("energy.springs", "J", "Energy of springs, elastic supports, stops and foundations"),
    ("energy.total", "J", "Total energy"),
    ("energy.work_loads", "J", "Work of the loads so far"),
    ("energy.work_supports", "J", "Work of the supports so far"),
    (
        "energy.loss_impacts",
        "J",
        "Energy dissipated by impacts and by friction of rigid contacts so far",
    ),
    ("energy.loss_damping", "J", "Energy dissipated by damping and in compliant contacts so far"),
    ("energy.residual", "J", "Error of the energy balance"),
    ("momentum.linear_1", "kg*m/s", "Linear momentum"),
    ("momentum.linear_2", "kg*m/s", "Linear momentum"),
    ("momentum.angular", "kg*m^2/s", "Angular momentum about the origin"),
    ("momentum.residual_1", "kg*m/s", "Error of the momentum balance"),
    ("momentum.residual_2", "kg*m/s", "Error of the momentum balance"),
    ("momentum.residual_angular", "kg*m^2/s", "Error of the angular momentum balance"),
    (
        "audit.curvature_drift",
        "1/m",
        "Difference between stored bending strains and those of the configuration",
    ),
    (
        "audit.membrane_drift",
        "1",
        "Difference between stored membrane strains and those of the configuration",
    ),
    (
        "audit.angular_rate_drift",
        "J",
        "Kinetic energy with the angular rates of the slopes' velocities, less that with the sections' own",
    ),
    ("solver.newton_iterations", "1", "Newton iterations during the output interval"),
];
