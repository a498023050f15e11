//! Published equilibria, and closed forms of small deflections.

use std::f64::consts::PI;

use percuss::*;

use crate::check::{Checks, Curve, Report};
use crate::scene::{at_element, compiled, displaced, published, scene};
use crate::structure::or_nan;

/// Equilibrium of a file shown in the manual.
///
/// # Panics
/// If there is no equilibrium.
fn equilibrium_of(c: &mut Checks, file: (&'static str, &'static str)) -> Equilibrium {
    equilibrium(&scene(c, file).model).expect("an equilibrium")
}

/// Largest fibre stress of a beam, by magnitude.
fn stress(found: &Equilibrium, beam: usize) -> f64 {
    let range = &found.section_forces[beam].stress;
    range.max.value.max(-range.min.value)
}

/// ANSYS VM2: a beam with overhangs; between its supports the moment is constant, `w a^2 / 2`.
pub fn overhanging_beam() -> Report {
    let mut c = Checks::new();
    let found = equilibrium_of(&mut c, published!("overhanging-beam"));
    let (load, arm, span) = (1e4 / 12.0, 120.0_f64, 240.0_f64);
    let (young, inertia, half) = (30e6, 7892.0, 15.0);
    let moment = load * arm * arm / 2.0;
    // The deflection is 1e-3 of the length: the error of the linear theory is its square.
    let [_, up] = displaced(&found, "beam.mid");
    c.relative(
        "deflection of the middle [in]",
        up,
        moment * span * span / (8.0 * young * inertia),
        1e-5,
    );
    c.relative("the same, published", up, 0.182, 3e-3); // to three digits
    let range = &found.section_forces[0].moment;
    c.relative("moment over the supports [lb in]", -range.min.value, moment, 1e-5);
    // Fibre stress with the axial force that the inclined overhangs give, 5e-4 of it.
    c.relative("largest stress [psi]", stress(&found, 0), moment * half / inertia, 1e-3);
    c.relative("the same, published", stress(&found, 0), 11_400.0, 1e-3);
    c.into_report()
}

/// ANSYS VM5: a cantilever whose depth grows to its root.
pub fn tapered_cantilever() -> Report {
    let mut c = Checks::new();
    let found = equilibrium_of(&mut c, published!("tapered-cantilever"));
    let modulus = |depth: f64| 2.0 * depth * depth / 6.0;
    // The lever of the force is 1e-5 shorter than the beam.
    let middle = at_element(&found, 20)[2].abs() / modulus(6.0);
    let root = at_element(&found, 0)[2].abs() / modulus(9.0);
    c.relative("stress at the middle [psi]", middle, 4000.0 * 25.0 / modulus(6.0), 5e-5);
    c.relative("stress at the root [psi]", root, 4000.0 * 50.0 / modulus(9.0), 5e-5);
    c.relative("stress at the middle, published", middle, 8333.0, 1e-4);
    c.relative("stress at the root, published", root, 7407.0, 1e-4);
    // Reported for the beam is the largest anywhere: of a depth that shrinks evenly it lies where depth is twice that of the tip.
    c.relative("largest fibre stress [psi]", stress(&found, 0), 4000.0 * 25.0 / modulus(6.0), 1e-4);
    c.into_report()
}

/// ANSYS VM10: a T section under an end moment.
pub fn t_section() -> Report {
    let mut c = Checks::new();
    let found = equilibrium_of(&mut c, published!("t-section"));
    // Flange 9 by 4 at the outer face, web 1.5 by 16 behind it.
    let (flange, web) = (36.0, 24.0);
    let axis = (flange * 2.0 + web * 12.0) / (flange + web);
    let own = 9.0 * 64.0 / 12.0 + 1.5 * 4096.0 / 12.0;
    let inertia = own + flange * (axis - 2.0_f64).powi(2) + web * (12.0_f64 - axis).powi(2);
    c.relative("second moment of area [in^4]", inertia, 2000.0, 1e-12);
    c.relative("stress at the flange [psi]", stress(&found, 0), 1e5 * axis / inertia, 1e-6);
    c.relative("stress at the web [psi]", stress(&found, 1), 1e5 * (20.0 - axis) / inertia, 1e-6);
    c.relative("stress at the flange, published", stress(&found, 0), 300.0, 1e-6);
    c.relative("stress at the web, published", stress(&found, 1), 700.0, 1e-6);
    c.into_report()
}

/// A cantilever propped at its end: reactions of 5/8 of the load at the wall and 3/8 at the prop.
pub fn propped_cantilever() -> Report {
    let mut c = Checks::new();
    let found = equilibrium_of(&mut c, published!("propped-cantilever"));
    let (load, stiffness) = (0.1, 200e9 * 0.01_f64.powi(4) / 12.0);
    let reaction = |name: &str, k: usize| {
        or_nan(found.reactions.iter().find(|(own, _)| own == name).map(|(_, r)| r[k]))
    };
    // Deflections of 3e-6 of the length: linear to 1e-9; a polynomial of fourth order on cubic elements, exact at nodes.
    c.relative("force at the wall [N]", reaction("wall", 1), 5.0 / 8.0 * load, 1e-7);
    c.relative("force at the prop [N]", reaction("prop", 1), 3.0 / 8.0 * load, 1e-7);
    c.relative("moment at the wall [N m]", reaction("wall", 2), load / 8.0, 1e-7);
    c.relative(
        "deflection at the middle [m]",
        displaced(&found, "beam.mid")[1],
        -load / (192.0 * stiffness),
        1e-6,
    );
    let range = &found.section_forces[0].moment;
    c.relative("largest moment in the span [N m]", range.max.value, 9.0 / 128.0 * load, 1e-6);
    c.absolute("its place [m]", range.max.s, 0.625, 1e-6);
    let envelope = &found.section_forces[0].envelope;
    let exact = |s: f64| load * (-1.0 / 8.0 + 5.0 / 8.0 * s - s * s / 2.0);
    let computed = envelope.s.iter().zip(&envelope.moment[1]).map(|(s, m)| [*s, *m]).collect();
    let closed = (0..=20).map(|k| f64::from(k) / 20.0).map(|s| [s, exact(s)]).collect();
    c.figure(
        "Moment along the beam",
        ["place [m]", "moment [N m]"],
        [Curve::computed("Percuss", computed), Curve::reference("closed form", closed)],
    );
    c.into_report()
}

/// A thin ring pressed by two forces P (Timoshenko): moments `P R / pi` and `P R (1/2 - 1/pi)`, diameters shorter by
/// `(pi/4 - 2/pi) P R^3 / E I` and longer by `(2/pi - 1/2) P R^3 / E I`.
pub fn pressed_ring() -> Report {
    let mut c = Checks::new();
    let found = equilibrium_of(&mut c, published!("ring"));
    let (force, stiffness) = (2e-3, 200e9 * 0.02 * 0.004_f64.powi(3) / 12.0);
    let range = &found.section_forces[0].moment;
    c.relative("moment under the force [N m]", -range.min.value, force / PI, 1e-5);
    c.relative("moment at the side [N m]", range.max.value, force * (0.5 - 1.0 / PI), 1e-5);
    // A thin ring: normal forces contribute about (h/R)^2 / 12 = 1.3e-6.
    let short = -2.0 * displaced(&found, "quarter.end")[1];
    let long = 2.0 * displaced(&found, "quarter.start")[0];
    c.relative("shorter by [m]", short, (PI / 4.0 - 2.0 / PI) * force / stiffness, 3e-5);
    c.relative("longer by [m]", long, (2.0 / PI - 0.5) * force / stiffness, 3e-5);
    c.into_report()
}

/// Linear buckling factor of a model.
fn factor(model: &Model) -> f64 {
    or_nan(buckling(model, 1).modes.first().map(|mode| mode.factor))
}

/// A portal frame on pins buckles sideways under a force on each column: `k L tan(k L) = 6` for a beam like the columns.
pub fn portal_sway() -> Report {
    let mut c = Checks::new();
    let model = scene(&mut c, published!("portal-sway")).model;
    let stiffness = 200e9 * 0.02 * 0.004_f64.powi(3) / 12.0;
    let (mut low, mut high) = (0.5, 1.5);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if middle * f64::tan(middle) < 6.0 { low = middle } else { high = middle }
    }
    // The columns are compressed by 2.4e-6 at the load.
    c.relative("force on each column [N]", factor(&model), low * low * stiffness, 1e-4);
    c.into_report()
}

/// Euler's columns: `P = pi^2 E I / (mu L)^2`, with the order of convergence.
pub fn euler_columns() -> Report {
    let mut c = Checks::new();
    let text = |elements: usize, foot: &str, head: &str| {
        format!(
            "[material.steel]\nyoung = 200e9\ndensity = 8000\n[section.strip]\nshape = \"rectangle\"\nwidth = 0.02\ndepth = 4e-3\n\
             [beam.column]\npoints = [[0, 0], [1, 0]]\nelements = {elements}\nmaterial = \"steel\"\nsection = \"strip\"\n\
             [support.foot]\nat = \"column.start\"\n{foot}\n{head}\
             [load.press]\nkind = \"point\"\nat = \"column.end\"\nforce = [-1, 0]\n[time]\nend = 1e-3\nstep = 1e-4\n"
        )
    };
    let held = |components: &str| {
        format!("[support.head]\nat = \"column.end\"\nkind = \"fix\"\ncomponents = {components}\n")
    };
    let stiffness = 200e9 * 0.02 * 0.004_f64.powi(3) / 12.0;
    // tan(x) = x, the lowest root above zero, for a column clamped at one end and pinned at the other.
    let root = 4.493_409_457_909_064_f64;
    for (name, foot, head, exact) in [
        ("pinned", "kind = \"pin\"", held("[2]"), PI * PI),
        ("clamped and pinned", "kind = \"clamp\"", held("[2]"), root * root),
        ("clamped", "kind = \"clamp\"", held("[2, \"rotation\"]"), 4.0 * PI * PI),
        ("cantilever", "kind = \"clamp\"", String::new(), PI * PI / 4.0),
    ] {
        let found = |elements: usize| {
            factor(&compiled(&text(elements, foot, &head), name).model) / stiffness
        };
        // Its compressive strain at the load is at most 5e-5.
        c.relative(format!("{name}: P L^2 / (E I)"), found(32), exact, 1e-4);
        if name == "clamped" {
            c.file("euler-column", text(32, foot, &head));
            // Errors of the mesh, without the effect of compression, which is equal on all meshes.
            let limit = found(96);
            let errors = [4, 6, 8, 12].map(|n| [1.0 / n as f64, (found(n) / limit - 1.0).abs()]);
            let axes = ["length of an element [m]", "relative error"];
            let order =
                c.convergence("A clamped column under mesh refinement", axes, errors.to_vec());
            c.absolute("order of convergence", order, 4.0, 0.15);
        }
    }
    c.into_report()
}
