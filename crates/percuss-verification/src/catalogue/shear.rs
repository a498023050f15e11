//! Cases of shear-flexible beams.

use crate::{Case, shear, shear_impact, shear_reissner};

pub(super) const SHEAR: &[Case] = &[
    Case {
        id: "shear-cantilevers",
        title: "Shear-flexible cantilevers, slender and deep, small and large deflections",
        source: "closed form; Nachbagauer, Pechstein, Irschik and Gerstmayr 2011; own integration",
        run: shear::cantilevers,
    },
    Case {
        id: "shear-frequencies",
        title: "Frequencies of deep beams",
        source: "roots of Timoshenko's theory; NAFEMS FV5",
        run: shear::frequencies,
    },
    Case {
        id: "shear-columns",
        title: "Buckling of columns that are flexible in shear",
        source: "closed form P (1 + P / GA) = Euler's load (Haringx 1942; Reissner 1972)",
        run: shear::columns,
    },
    Case {
        id: "shear-tumbling",
        title: "A shear-flexible beam that turns by half a radian a step, 10 000 steps",
        source: "conservation laws",
        run: shear::tumbling,
    },
    Case {
        id: "shear-impact",
        title: "A rigid mass on a shear-flexible beam: its velocity has a limit from the first instant on",
        source: "Laplace inversion of Timoshenko's theory",
        run: shear_impact::velocity,
    },
    Case {
        id: "shear-force",
        title: "The force of that mass: its limit just after the impact, its mean over intervals, order of convergence",
        source: "Laplace inversion of Timoshenko's theory, F(0+) = 2 v sqrt(kappa G A rho A)",
        run: shear_impact::force,
    },
    Case {
        id: "shear-spectra",
        title: "Both spectra of a simply supported deep beam, and which mode belongs to which",
        source: "closed form of Timoshenko's theory",
        run: shear::spectra,
    },
    Case {
        id: "shear-slender-limit",
        title: "A shear-flexible cantilever approaches a slender one as 1 / GA",
        source: "own integration",
        run: shear::slender_limit,
    },
    Case {
        id: "shear-spin-up",
        title: "C1 with shear: spin-up",
        source: "Simo and Vu-Quoc 1986; independent method; steady stretch in closed form",
        run: shear_reissner::spin_up,
    },
    Case {
        id: "shear-flying-beam",
        title: "C2 with shear: a beam thrown by a force and a torque",
        source: "data of Simo and Vu-Quoc 1986; independent method",
        run: shear_reissner::flying_beam,
    },
    Case {
        id: "shear-lees-frame",
        title: "A5 with shear: Lee's frame up to its limit point, order of convergence",
        source: "own integration (shooting)",
        run: shear_reissner::lees_frame,
    },
];
