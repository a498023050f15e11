//! Cases of shear-flexible beams.

use crate::{Case, shear};

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
        source: "Laplace inversion of Timoshenko's theory, F(0+) = 2 v sqrt(kappa G A rho A)",
        run: shear::impact,
    },
];
