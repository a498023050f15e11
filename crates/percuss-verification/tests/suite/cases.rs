//! Every verification case passes.

use percuss_verification::CASES;

fn holds(id: &str) {
    let case = CASES.iter().find(|case| case.id == id).expect("a case of this name");
    let checks = (case.run)().checks;
    assert!(!checks.is_empty(), "{id} checks nothing");
    let broken: Vec<_> = checks.iter().filter(|check| !check.holds()).collect();
    assert!(broken.is_empty(), "{}: {broken:#?}", case.title);
}

macro_rules! cases {
    ($($name:ident = $id:literal),* $(,)?) => {
        $(#[test]
        fn $name() {
            holds($id);
        })*

        #[test]
        fn every_case_is_tested() {
            let tested = [$($id),*];
            let missing: Vec<_> = CASES.iter().filter(|c| !tested.contains(&c.id)).collect();
            assert!(missing.is_empty(), "{missing:?}");
        }
    };
}

cases! {
    elastic_clamped = "elastic-clamped",
    elastic_converged = "elastic-converged",
    elastic_elementary = "elastic-elementary",
    large_steps = "large-steps",
    rigid_first_impact = "rigid-first-impact",
    rigid_sequence = "rigid-sequence",
    rigid_linear = "rigid-linear",
    bouncing_ball = "bouncing-ball",
    cradle = "cradle",
    sliding_disc = "sliding-disc",
    skew_thrust = "skew-thrust",
    rigid_rod = "rigid-rod",
    effective_mass = "effective-mass",
    frequencies = "frequencies",
    flying_beam = "flying-beam",
    cantilever = "cantilever",
    roll_up = "roll-up",
    buckled_column = "buckled-column",
    lees_frame = "lees-frame",
    toggle_on_floor = "toggle-on-floor",
    l_shape = "l-shape",
    curved_cantilever = "curved-cantilever",
    load_steps = "load-steps",
    simple_beam = "simple-beam",
    compressed_bar = "compressed-bar",
    free_rod = "free-rod",
    slender_beams = "slender-beams",
    strip_on_floor = "strip-on-floor",
    foundation_infinite = "foundation-infinite",
    foundation_modes = "foundation-modes",
    foundation_yields = "foundation-yields",
    heated_bars = "heated-bars",
    heated_strut = "heated-strut",
    sudden_heat = "sudden-heat",
    tip_mass = "tip-mass",
    becks_column = "becks-column",
    column_beside_ties = "column-beside-ties",
    spin_up = "spin-up",
    pendulum = "pendulum",
    swinging_beam = "swinging-beam",
    tip_stop = "tip-stop",
    mass_that_stays = "mass-that-stays",
    corners = "corners",
    everything = "everything",
    section_forces = "section-forces",
    tapered_stress = "tapered-stress",
    paper_balances = "paper-balances",
    paper_forms = "paper-forms",
    strain_history = "strain-history",
    time_reversal = "time-reversal",
    rigid_motion = "rigid-motion",
    contact_point = "contact-point",
    same_bits = "same-bits",
    bar_on_wall = "bar-on-wall",
    bar_on_bar = "bar-on-bar",
    bouncing_bar = "bouncing-bar",
    sphere_on_beam = "sphere-on-beam",
    infinite_beam = "infinite-beam",
    oblique_throw = "oblique-throw",
    beam_ends = "beam-ends",
    plastic_cycles = "plastic-cycles",
    plastic_rates = "plastic-rates",
    plastic_wave = "plastic-wave",
    three_bars = "three-bars",
    plastic_bending = "plastic-bending",
    plastic_moments = "plastic-moments",
    layered_sections = "layered-sections",
    interaction = "interaction",
    explosive_ring = "explosive-ring",
    heavy_mass = "heavy-mass",
    parkes = "parkes",
    thrown_beam = "thrown-beam",
    thrown_bar = "thrown-bar",
    mass_on_a_rod = "mass-on-a-rod",
    portal_pushover = "portal-pushover",
    strong_joints = "strong-joints",
    failing_bar = "failing-bar",
    overhanging_beam = "overhanging-beam",
    tapered_cantilever = "tapered-cantilever",
    t_section = "t-section",
    propped_cantilever = "propped-cantilever",
    pressed_ring = "pressed-ring",
    portal_sway = "portal-sway",
    euler_columns = "euler-columns",
    two_springs = "two-springs",
    deep_beam = "deep-beam",
    ring_modes = "ring-modes",
    stepped_load = "stepped-load",
    rise_time = "rise-time",
    dropped_container = "dropped-container",
    struck_rod = "struck-rod",
    bead_column = "bead-column",
    fibre_bar = "fibre-bar",
    shear_cantilevers = "shear-cantilevers",
    shear_frequencies = "shear-frequencies",
    shear_columns = "shear-columns",
    shear_tumbling = "shear-tumbling",
    shear_impact = "shear-impact",
    shear_force = "shear-force",
    shear_spectra = "shear-spectra",
    shear_slender_limit = "shear-slender-limit",
    shear_spin_up = "shear-spin-up",
    shear_flying_beam = "shear-flying-beam",
    shear_lees_frame = "shear-lees-frame",
}
