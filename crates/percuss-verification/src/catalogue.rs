//! The catalogue of cases.

mod published;
mod shear;
mod yielding;

use self::published::PUBLISHED;
use self::shear::SHEAR;
use self::yielding::YIELDING;
use crate::*;

/// Every case, in the order of the manual.
pub const CASES: &[Case] = &joined::<COUNT>(LISTS);

const LISTS: &[&[Case]] = &[OWN, YIELDING, PUBLISHED, SHEAR];
const COUNT: usize = OWN.len() + YIELDING.len() + PUBLISHED.len() + SHEAR.len();

/// Concatenation of several lists.
const fn joined<const N: usize>(lists: &[&[Case]]) -> [Case; N] {
    let mut all = [lists[0][0]; N];
    let (mut list, mut first, mut k) = (0, 0, 0);
    while k < N {
        if k - first == lists[list].len() {
            first = k;
            list += 1;
        }
        all[k] = lists[list][k - first];
        k += 1;
    }
    all
}

/// Elastic cases whose scenes are built with the library.
const OWN: &[Case] = &[
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
        id: "cradle",
        title: "Newton's cradle of five balls: sequential and simultaneous impacts",
        source: "closed form; Herrmann and Seitz 1982, Am. J. Phys. 50, 977",
        run: cradle::cradle_of_five,
    },
    Case {
        id: "sliding-disc",
        title: "Friction: a disc slides, then rolls; a block slides until it stops",
        source: "closed form",
        run: sliding::sliding_disc,
    },
    Case {
        id: "skew-thrust",
        title: "Follower force: a free rod pushed across at its end",
        source: "rigid rod, Fresnel's integrals",
        run: thrust::skew_thrust,
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
        id: "cantilever",
        title: "A1: cantilever under a dead tip force, order in the element size",
        source: "Bisshopp and Drucker 1945, elliptic integrals",
        run: statics::cantilever,
    },
    Case {
        id: "roll-up",
        title: "A2: roll-up by an end moment, and a moment that Green strains cannot carry",
        source: "closed form in both strain measures; code_aster SSNL103",
        run: statics::roll_up,
    },
    Case {
        id: "foundation-infinite",
        title: "Infinite beam on an elastic foundation under a force, order in the element size",
        source: "Hetenyi 1946, Beams on Elastic Foundation; closed form",
        run: foundation::infinite_beam,
    },
    Case {
        id: "foundation-modes",
        title: "Pinned beam on an elastic foundation: frequencies and buckling load",
        source: "Hetenyi 1946; closed form",
        run: foundation::frequencies_and_buckling,
    },
    Case {
        id: "foundation-yields",
        title: "Beam dropped flat on a foundation of compression that yields: indentation and rebound",
        source: "closed form of the balance of energy",
        run: foundation::yielding_drop,
    },
    Case {
        id: "heated-bars",
        title: "Heated bars: expansion, curvature, and the forces of what is held",
        source: "closed form",
        run: heat::heated_bars,
    },
    Case {
        id: "heated-strut",
        title: "Heated strut between walls: buckling temperature and frequency below it",
        source: "closed form",
        run: heat::heated_strut,
    },
    Case {
        id: "sudden-heat",
        title: "Heat in motion: its work on a held bar, and the wave in a bar heated at once",
        source: "closed form",
        run: heat::sudden_heat,
    },
    Case {
        id: "buckled-column",
        title: "A3: column beyond its buckling load",
        source: "ANSYS VM136; elliptic integrals",
        run: statics::buckled_column,
    },
    Case {
        id: "lees-frame",
        title: "A5: Lee's frame, path past two limit points",
        source: "independent shooting on the beam's differential equation",
        run: statics::lees_frame,
    },
    Case {
        id: "toggle-on-floor",
        title: "A toggle snaps through onto a floor and presses on it",
        source: "closed form, Green strain",
        run: statics::toggle_on_floor,
    },
    Case {
        id: "l-shape",
        title: "A7: two legs with a rigid corner",
        source: "Exudyn, LShapeGeomExactBeam2D",
        run: statics::l_shape,
    },
    Case {
        id: "curved-cantilever",
        title: "Quarter circle with a force at its tip",
        source: "Castigliano, slender bar",
        run: statics::curved_cantilever,
    },
    Case {
        id: "load-steps",
        title: "Equilibria against the size of load steps",
        source: "identity",
        run: statics::load_steps,
    },
    Case {
        id: "section-forces",
        title: "Section forces under distributed loads, weight, and forces that part a beam",
        source: "balance of free bodies; any mesh",
        run: section_forces::in_statics,
    },
    Case {
        id: "tapered-stress",
        title: "Stress at the thin end of tapered cantilevers",
        source: "N/A + M/W of the section there",
        run: section_forces::of_tapers,
    },
    Case {
        id: "simple-beam",
        title: "B1: simply supported beam",
        source: "ANSYS VM50; closed form",
        run: vibration::simple_beam,
    },
    Case {
        id: "compressed-bar",
        title: "B2: modes about a compressed equilibrium",
        source: "ANSYS VM59; closed form",
        run: vibration::compressed_bar,
    },
    Case {
        id: "free-rod",
        title: "B3: axial modes of a free rod",
        source: "ANSYS VM61; closed form",
        run: vibration::free_rod,
    },
    Case {
        id: "slender-beams",
        title: "Frequencies of slender beams, clamped, free, cantilevered",
        source: "closed form",
        run: vibration::slender_beams,
    },
    Case {
        id: "strip-on-floor",
        title: "A strip lies down on a rigid floor: force, moment, touch-down",
        source: "closed form h = w a^4 / 72 EI; heavy elastica by Runge-Kutta and Newton's method",
        run: stability::strip_on_a_floor,
    },
    Case {
        id: "tip-mass",
        title: "Lowest frequency of a cantilever with 1 t at its tip, up to 1000 elements",
        source: "closed form",
        run: stability::tip_mass,
    },
    Case {
        id: "becks-column",
        title: "Beck's column: frequencies, and flutter with its load",
        source: "Beck 1952, Z. angew. Math. Phys. 3, 225; closed form",
        run: stability::becks_column,
    },
    Case {
        id: "column-beside-ties",
        title: "Linear buckling of a column beside rods in tension",
        source: "Euler's column",
        run: stability::column_beside_ties,
    },
    Case {
        id: "spin-up",
        title: "C1: spin-up by a prescribed rotation",
        source: "Simo and Vu-Quoc 1986; ANSYS VM258; independent method",
        run: motion::spin_up,
    },
    Case {
        id: "pendulum",
        title: "C4: pendulum of large swing",
        source: "ANSYS VM91; elliptic integral",
        run: motion::pendulum,
    },
    Case {
        id: "swinging-beam",
        title: "E1: hinged beam rotates onto a spring, undamped and with modal damping",
        source: "code_aster SDNL32; exact modal sums",
        run: stops::swinging_beam,
    },
    Case {
        id: "tip-stop",
        title: "E2: cantilever with a stop at its tip",
        source: "code_aster SDNL104",
        run: stops::tip_stop,
    },
    Case {
        id: "mass-that-stays",
        title: "E6: a mass strikes at midspan and stays",
        source: "Saint-Venant; modes of beam and mass",
        run: stops::mass_that_stays,
    },
    Case {
        id: "corners",
        title: "Rigid corners and branches keep their angles and do no work",
        source: "conservation laws",
        run: structures::corners,
    },
    Case {
        id: "everything",
        title: "Every kind of structure, support, load, damping and impact at once",
        source: "conservation laws",
        run: structures::everything,
    },
    Case {
        id: "paper-balances",
        title: "Balances of every scenario in scenarios/paper",
        source: "conservation laws",
        run: conservation::paper_balances,
    },
    Case {
        id: "paper-forms",
        title: "What the paper's forms do: midpoint force, time-stepping",
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
    Case {
        id: "bar-on-wall",
        title: "D1, D4: a bar strikes a rigid wall with its end",
        source: "exact waves; ANSYS VM265 (Carpenter, Taylor and Katona 1991); code_aster SDNV100",
        run: waves::bar_on_a_wall,
    },
    Case {
        id: "bar-on-bar",
        title: "D7: a bar strikes another one end to end",
        source: "exact waves; code_aster SDNL111",
        run: waves::bar_on_a_bar,
    },
    Case {
        id: "bouncing-bar",
        title: "D8: a bar falls on a rigid floor and bounces",
        source: "exact solution; Doyen, Ern and Piperno 2011",
        run: waves::bouncing_bar,
    },
    Case {
        id: "sphere-on-beam",
        title: "E7: a sphere strikes a steel beam, Hertz contact",
        source: "Timoshenko 1913; independent modal reference",
        run: surface::sphere_on_a_beam,
    },
    Case {
        id: "infinite-beam",
        title: "E4, E9: a mass and spring on a long beam, before waves return",
        source: "closed form with complex error functions",
        run: surface::infinite_beam,
    },
    Case {
        id: "oblique-throw",
        title: "A disc slides along a free beam over element borders, step 1e-3 s",
        source: "conservation laws",
        run: surface::oblique_throw,
    },
    Case {
        id: "beam-ends",
        title: "A stiff bar falls on its corner; a disc slides over the end of a beam",
        source: "rigid bodies in closed form",
        run: ends::beam_ends,
    },
];
