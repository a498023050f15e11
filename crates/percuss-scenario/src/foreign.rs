//! Words of other programs and of text books, and what they are called here.

/// Words, in lower case where case tells nothing, and the names of ours that may be meant: which of them depends on where they stand.
const WORDS: &[(&[&str], &[&str])] = &[
    (
        &[
            "E",
            "emod",
            "e_mod",
            "e-modulus",
            "emodulus",
            "modulus",
            "youngs",
            "youngs_modulus",
            "young_modulus",
            "elastic_modulus",
        ],
        &["young"],
    ),
    (&["rho", "dens", "mass_density"], &["density"]),
    (&["fy", "sigma_y", "sy", "yield_stress", "yield_strength"], &["yield"]),
    (&["A", "area_section", "cross_section_area"], &["area"]),
    (&["I", "iy", "iz", "ixx", "iyy", "izz", "moment_of_inertia", "second_moment"], &["inertia"]),
    (&["b", "breadth"], &["width"]),
    (&["h", "height"], &["depth"]),
    (&["d", "dia"], &["diameter", "depth"]),
    (&["r", "rad"], &["radius"]),
    (&["t", "wall"], &["thickness"]),
    (&["tf"], &["flange"]),
    (&["tw"], &["web"]),
    (&["dt", "delta_t", "timestep", "time_step", "step_size", "stepsize", "increment"], &["step"]),
    (
        &[
            "t_end",
            "tend",
            "tmax",
            "t_max",
            "end_time",
            "total_time",
            "final_time",
            "termination",
            "duration",
        ],
        &["end"],
    ),
    (
        &[
            "nodes",
            "node",
            "n_nodes",
            "mesh",
            "nel",
            "ne",
            "n_elements",
            "num_elements",
            "n_elem",
            "nelem",
            "element",
            "divisions",
        ],
        &["elements", "points", "beam"],
    ),
    (&["coordinates", "coords", "vertices", "geometry"], &["points"]),
    (&["members", "member", "frame", "bar", "bars", "rod"], &["beam"]),
    (
        &[
            "boundary",
            "boundaries",
            "bc",
            "bcs",
            "boundary_condition",
            "boundary_conditions",
            "constraint",
            "constraints",
            "restraints",
        ],
        &["support"],
    ),
    (&["connection", "connections", "coupling"], &["joint"]),
    (&["impactor", "striker", "hammer"], &["projectile"]),
    (&["wall", "ground", "rigid_wall"], &["obstacle"]),
    (&["output", "outputs", "results"], &["record"]),
    (
        &[
            "fixed",
            "fully_fixed",
            "encastre",
            "encastred",
            "built_in",
            "built-in",
            "clamped",
            "cantilever",
        ],
        &["clamp"],
    ),
    (&["pinned", "simple", "simply_supported", "simply-supported"], &["pin", "hinge"]),
    (&["hinged"], &["hinge", "pin"]),
    (&["rolling", "sliding", "slider", "rollers"], &["roller"]),
    (&["fixed", "welded", "weld", "tie", "tied"], &["rigid"]),
    (&["spring"], &["elastic"]),
    (&["hook", "tension-only", "tension_only", "rope", "cable"], &["tension"]),
    (&["gap", "compression-only", "compression_only", "buffer"], &["compression"]),
    (&["tabulated", "multilinear", "nonlinear"], &["table"]),
    (&["winkler", "subgrade", "elastic_foundation", "soil"], &["foundation"]),
    (&["thermal", "heat"], &["temperature"]),
    (&["cte", "thermal_expansion", "expansion_coefficient"], &["expansion"]),
    (&["k", "spring_constant", "ks"], &["stiffness"]),
    (&["c", "dashpot", "damper", "viscosity"], &["damping"]),
    (&["m", "weight"], &["mass"]),
    (&["v", "v0", "vel", "speed", "initial_velocity"], &["velocity"]),
    (&["cor", "e", "coefficient_of_restitution"], &["restitution"]),
    (&["mu", "friction_coefficient", "coefficient_of_friction"], &["friction"]),
    (&["g", "a", "acc"], &["acceleration"]),
    (&["F", "p", "load", "value", "magnitude"], &["force"]),
    (&["M", "torque", "couple"], &["moment"]),
    (&["type"], &["kind", "shape", "scheme"]),
    (&["profile"], &["section", "shape"]),
    (&["location", "position", "point", "where"], &["at"]),
    (&["beta", "kelvin_voigt", "stiffness_damping"], &["retardation"]),
    (&["alpha", "rayleigh_alpha"], &["mass_damping"]),
    (&["method", "solver", "integration"], &["scheme"]),
];

/// What a word of another program is called here, if one of the candidates is it.
pub(crate) fn ours<'c>(
    word: &str,
    candidates: impl Iterator<Item = &'c str> + Clone,
) -> Option<&'c str> {
    let lower = word.to_lowercase();
    let found = |same: &dyn Fn(&str) -> bool| {
        WORDS
            .iter()
            .filter(|(words, _)| words.iter().any(|w| same(w)))
            .flat_map(|(_, ours)| ours.iter())
            .find_map(|name| candidates.clone().find(|candidate| candidate == name))
    };
    // A single letter means something else in the other case, where both are known.
    found(&|w| w == word).or_else(|| found(&|w| w.to_lowercase() == lower))
}
