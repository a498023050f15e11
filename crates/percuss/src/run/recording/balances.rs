//! The columns of a history whose names contain none of a model: energies, momenta, audit numbers, the solver.

use super::now::Now;

/// Name, unit, meaning and value of a column.
pub(super) type Column = (&'static str, &'static str, &'static str, fn(&Now<'_>) -> f64);

/// Columns every history has.
pub(super) const BALANCES: [Column; 24] = [
    ("energy.kinetic", "J", "Kinetic energy", |now| {
        now.measures.kinetic_beams + now.measures.kinetic_projectiles
    }),
    ("energy.kinetic_beams", "J", "Kinetic energy of the beams", |now| now.measures.kinetic_beams),
    ("energy.kinetic_projectiles", "J", "Kinetic energy of the projectiles", |now| {
        now.measures.kinetic_projectiles
    }),
    ("energy.strain", "J", "Strain energy", |now| {
        now.measures.strain_axial + now.measures.strain_bending
    }),
    ("energy.strain_axial", "J", "Axial strain energy", |now| now.measures.strain_axial),
    ("energy.strain_bending", "J", "Bending strain energy", |now| {
        now.measures.strain_bending - now.measures.strain_shear
    }),
    ("energy.contact", "J", "Energy of the contact springs", |now| now.measures.contact),
    ("energy.springs", "J", "Energy of springs, elastic supports, stops and foundations", |now| {
        now.measures.springs
    }),
    ("energy.total", "J", "Total energy", |now| now.measures.total()),
    ("energy.work_loads", "J", "Work of the loads so far", |now| now.state.ledger.work_loads),
    ("energy.work_supports", "J", "Work of the supports so far", |now| {
        now.state.ledger.work_supports
    }),
    (
        "energy.loss_impacts",
        "J",
        "Energy dissipated by impacts and by friction of rigid contacts so far",
        |now| now.state.ledger.loss_impacts,
    ),
    (
        "energy.loss_damping",
        "J",
        "Energy dissipated by damping and in compliant contacts so far",
        |now| now.state.ledger.loss_damping,
    ),
    ("energy.residual", "J", "Error of the energy balance", |now| {
        now.state.ledger.energy_residual(now.measures)
    }),
    ("momentum.linear_1", "kg*m/s", "Linear momentum", |now| now.measures.linear[0]),
    ("momentum.linear_2", "kg*m/s", "Linear momentum", |now| now.measures.linear[1]),
    ("momentum.angular", "kg*m^2/s", "Angular momentum about the origin", |now| {
        now.measures.angular
    }),
    ("momentum.residual_1", "kg*m/s", "Error of the momentum balance", |now| {
        now.state.ledger.linear_residual(now.measures)[0]
    }),
    ("momentum.residual_2", "kg*m/s", "Error of the momentum balance", |now| {
        now.state.ledger.linear_residual(now.measures)[1]
    }),
    ("momentum.residual_angular", "kg*m^2/s", "Error of the angular momentum balance", |now| {
        now.state.ledger.angular_residual(now.measures)
    }),
    (
        "audit.curvature_drift",
        "1/m",
        "Difference between stored bending strains and those of the configuration",
        |now| now.measures.curvature_drift,
    ),
    (
        "audit.membrane_drift",
        "1",
        "Difference between stored membrane strains and those of the configuration",
        |now| now.measures.membrane_drift,
    ),
    (
        "audit.angular_rate_drift",
        "J",
        "Kinetic energy with the angular rates of the slopes' velocities, less that with the sections' own",
        |now| now.measures.angular_rate_drift,
    ),
    ("solver.newton_iterations", "1", "Newton iterations during the output interval", |now| {
        now.iterations as f64
    }),
];

/// Columns of histories of yielding parts.
pub(super) const HARDENING: [Column; 3] = [
    ("energy.plastic", "J", "Energy dissipated by plastic flow so far", |now| {
        now.state.ledger.loss_plastic
    }),
    ("energy.hardening", "J", "Energy stored in hardening", |now| now.measures.hardening),
    (
        "energy.failure",
        "J",
        "Energy that had been stored in the fibres, springs and hinges that failed so far",
        |now| now.state.ledger.loss_failure,
    ),
];

/// Column of histories of shear-flexible beams.
pub(super) const SHEAR: [Column; 1] = [(
    "energy.strain_shear",
    "J",
    "Shear strain energy of shear-flexible beams, not contained in that of bending",
    |now| now.measures.strain_shear,
)];
