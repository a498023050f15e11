//! Sections of several materials, compared with transformed sections.

use percuss::*;

use crate::check::{Checks, Report};
use crate::structure::at;
use crate::yielding::perfect;

const LENGTH: f64 = 1.0;

/// Relative error of four elements on an arc of 0.015 rad per metre and more; it is quartered by half the curvature.
const ARC: f64 = 1e-6;

/// A part of a section: number of its material, its bottom and its top \[m\], its width \[m\].
struct Layer {
    material: usize,
    from: f64,
    to: f64,
    width: f64,
}

impl Layer {
    /// Two fibres at the Gauss points, with its area and second moment: height, area, number of the material.
    fn fibres(&self) -> [(f64, f64, usize); 2] {
        let (middle, half) = (0.5 * (self.from + self.to), 0.5 * (self.to - self.from));
        let point = |x: f64| (middle + half * x / 3.0_f64.sqrt(), half * self.width, self.material);
        [point(-1.0), point(1.0)]
    }
}

/// A cantilever of such fibres under an axial force and a moment at its end.
fn loaded(
    fibres: &[(f64, f64, usize)],
    materials: &[Material],
    [axial, moment]: [f64; 2],
) -> Option<Equilibrium> {
    let mut b = ModelBuilder::new();
    let ids: Vec<MaterialId> = materials.iter().map(|m| b.material(m.clone())).collect();
    let fibre = |&(height, area, material): &(f64, f64, usize)| SectionFibre {
        height,
        area,
        material: Some(ids[material]),
    };
    let section = b.section(Section::of_fibres("layers", fibres.iter().map(fibre).collect()));
    let arm = b.beam(Beam::new("arm", &[[0.0, 0.0], [LENGTH, 0.0]], 4, ids[0], section));
    b.support(Support::new("root", at("root", arm, 0.0), SupportKind::Clamp));
    let tip = at("tip", arm, 1.0);
    b.record_point(tip.clone());
    let kind = LoadKind::Point { at: tip, force: [axial, 0.0], moment, follower: false };
    b.load(Load::new("end", kind));
    equilibrium(&b.build().ok()?).ok()
}

/// Curvature of the arc under a moment \[1/m\], and its least and largest stress \[Pa\].
fn bent(found: Option<&Equilibrium>) -> [f64; 3] {
    let Some(found) = found else { return [f64::NAN; 3] };
    let [u, w] = found.points[0].1;
    let stress = &found.section_forces[0].stress;
    // The angle of an arc is twice that of its chord.
    [2.0 * w.atan2(LENGTH + u) / LENGTH, stress.min.value, stress.max.value]
}

/// A material with engineering strains, in which moment and curvature are in proportion.
fn elastic(name: &str, young: f64, density: f64) -> Material {
    Material { strain: StrainMeasure::Engineering, ..Material::new(name, young, density) }
}

/// Two layers and a reinforced rectangle, `EA = sum E A`, `EI = sum E (I + A y^2)`, stress `E (N/EA + y M/EI)`.
pub fn layered_sections() -> Report {
    let mut c = Checks::new();
    bimetal(&mut c);
    reinforced(&mut c);
    c.into_report()
}

/// Steel below, aluminium above, 20 mm wide, 6 and 10 mm deep.
fn bimetal(c: &mut Checks) {
    let metals = [elastic("steel", 210e9, 7850.0), elastic("aluminium", 70e9, 2700.0)];
    let (width, deep) = (0.02, [6e-3, 10e-3]);
    let stiff = [210e9 * width * deep[0], 70e9 * width * deep[1]];
    let axial = stiff[0] + stiff[1];
    let centroid = (stiff[0] * 0.5 * deep[0] + stiff[1] * (deep[0] + 0.5 * deep[1])) / axial;
    let layers = [
        Layer { material: 0, from: -centroid, to: deep[0] - centroid, width },
        Layer { material: 1, from: deep[0] - centroid, to: deep[0] + deep[1] - centroid, width },
    ];
    let arms = [0.5 * deep[0] - centroid, deep[0] + 0.5 * deep[1] - centroid];
    let bending: f64 =
        (0..2).map(|i| stiff[i] * (deep[i] * deep[i] / 12.0 + arms[i] * arms[i])).sum();
    let fibres: Vec<_> = layers.iter().flat_map(Layer::fibres).collect();
    // So small that the linear theory applies: for a larger arc four elements are accurate only to the sixth digit.
    let moment = 0.02;
    let [curvature, least, most] = bent(loaded(&fibres, &metals, [0.0, moment]).as_ref());
    c.relative("bimetal: curvature [1/m]", curvature, moment / bending, 1e-9);
    // A counter-clockwise moment compresses the upper part.
    let stress = |&(y, _, i): &(f64, f64, usize)| -metals[i].young * y * moment / bending;
    let all: Vec<f64> = fibres.iter().map(stress).collect();
    let [low, high] = [f64::min, f64::max].map(|f| all.iter().copied().fold(all[0], f));
    c.relative("bimetal: least stress [Pa]", least, low, 1e-9);
    c.relative("bimetal: largest stress [Pa]", most, high, 1e-9);
    let pulled = loaded(&fibres, &metals, [1000.0, 0.0]);
    let [_, least, most] = bent(pulled.as_ref());
    let stretch = pulled.map_or(f64::NAN, |found| found.points[0].1[0] / LENGTH);
    c.relative("bimetal: stretch under an axial force", stretch, 1000.0 / axial, 1e-9);
    c.relative("bimetal: stress of the aluminium [Pa]", least, 70e9 * 1000.0 / axial, 1e-9);
    c.relative("bimetal: stress of the steel [Pa]", most, 210e9 * 1000.0 / axial, 1e-9);
}

/// An elastic rectangle of 0.2 x 0.4 m with bars of 500 mm^2 at 0.17 m above and below the centre line, which yield at 500 MPa; then with a matrix
/// that also yields, at 20 MPa.
fn reinforced(c: &mut Checks) {
    let (width, depth, bar, arm) = (0.2, 0.4, 500e-6, 0.17);
    let (soft, hard, limit) = (30e9, 200e9, 500e6);
    let body = |material| {
        let layer = |i: u32| {
            let from = depth * (f64::from(i) / 16.0 - 0.5);
            Layer { material, from, to: from + depth / 16.0, width }
        };
        (0..16).flat_map(move |i| layer(i).fibres()).collect::<Vec<_>>()
    };
    let mut fibres = body(0);
    fibres.extend([(-arm, bar, 1), (arm, bar, 1)]);
    let alone = soft * width * depth.powi(3) / 12.0;
    let bending = alone + 2.0 * hard * bar * arm * arm;
    let bars = perfect(hard, 7850.0, limit);
    let metals = [elastic("body", soft, 2400.0), bars.clone()];
    let first = limit * bending / (hard * arm);
    for share in [0.5, 0.999, 1.001, 1.5] {
        let [curvature, _, most] = bent(loaded(&fibres, &metals, [0.0, share * first]).as_ref());
        // Beyond first yield the force of the bars is constant, and the matrix carries the rest.
        let rest = (share * first - 2.0 * limit * bar * arm) / alone;
        let [exact, stress] = match share < 1.0 {
            true => [share * first / bending, share * limit],
            false => [rest, limit],
        };
        c.relative(format!("bars, {share} of first yield: curvature [1/m]"), curvature, exact, ARC);
        c.relative(format!("bars, {share} of first yield: stress [Pa]"), most, stress, ARC);
    }
    let metals = [Material { name: "body".into(), ..perfect(soft, 2400.0, 20e6) }, bars];
    let plastic = 20e6 * width * depth * depth / 4.0 + 2.0 * limit * bar * arm;
    let borne = |share: f64| loaded(&fibres, &metals, [0.0, share * plastic]).is_some();
    let (mut low, mut high) = (0.5, 2.0);
    for _ in 0..12 {
        let middle = 0.5 * (low + high);
        *(if borne(middle) { &mut low } else { &mut high }) = middle;
    }
    c.absolute("all yields: largest moment over the plastic one", low, 1.0, 3e-3);
}
