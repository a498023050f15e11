//! Conversion of definitions to a frozen [`Model`], with all validation.

use std::collections::HashSet;
use std::sync::Arc;

use super::builder::ModelBuilder;
use super::centre_line::CentreLine;
use super::definition::{Material, StrainMeasure, Theory};
use super::frozen::*;
use super::material_points::locate;
use super::mesh::SpanPlan;
use super::places::Places;
use super::section_line::SectionLine;
use super::{
    Fault, bodies, check, connect, constrain, fibres, foundation, hinge_mesh, loads, mesh, outline,
    pairs,
};
use crate::element::beam::{ElementTable, NodeFrame};
use crate::element::shear::ShearTable;
use crate::geometry::axis::{AxisElement, AxisElements};
use crate::math::hermite::{GAUSS, gauss_points};
use crate::math::vec2::{cross, sub};

impl ModelBuilder {
    /// Checks everything and freezes it.
    ///
    /// # Errors
    /// Every fault found, each with its place in the words of the scenario file.
    pub fn build(&self) -> Result<Model, Vec<Fault>> {
        let faults = check::faults(self);
        if !faults.is_empty() {
            return Err(faults);
        }
        let mut model = self.mesh();
        let faults = outline::too_short(self, &model);
        if !faults.is_empty() {
            return Err(faults);
        }
        self.place_masses(&mut model);
        self.place_motions(&mut model)?;
        connect::supports(self, &mut model);
        bodies::place(self, &mut model);
        loads::place(self, &mut model);
        let mut labels = HashSet::new();
        for point in self.projectiles.iter().map(|p| &p.strikes).chain(&self.points) {
            if labels.insert(point.label.as_str()) {
                model.points.push(locate(&model, point));
            }
        }
        connect::springs(self, &mut model);
        foundation::place(self, &mut model);
        constrain::all(self, &mut model)?;
        pairs::place(self, &mut model)?;
        // Bodies have doubled the memory of the nodes.
        model.nodes.shrink_to_fit();
        Ok(model)
    }

    fn mesh(&self) -> Model {
        let mut model = Model {
            nodes: Vec::new(),
            beams: Vec::new(),
            spans: Vec::new(),
            prescribed: Vec::new(),
            constraints: Vec::new(),
            joints: Vec::new(),
            connectors: Vec::new(),
            foundations: Vec::new(),
            masses: Vec::new(),
            supports: Vec::new(),
            motions: Vec::new(),
            bodies: Vec::new(),
            projectiles: Vec::new(),
            obstacles: Vec::new(),
            contacts: Vec::new(),
            pairs: Vec::new(),
            loads: Vec::new(),
            modal_damping: self.modal_damping.clone(),
            initial_motion: self.initial_motion,
            own_motions: Vec::new(),
            points: Vec::new(),
            total_mass: 0.0,
        };
        let places = Places::new(self);
        for (index, beam) in self.beams.iter().enumerate() {
            let Some(line) = CentreLine::new(beam) else { continue }; // checked before
            let first = (model.spans.len(), model.nodes.len(), model.element_count());
            let least = |plan: &SpanPlan, s: f64| self.make(plan).hinge_length(s / line.length());
            let with_struck = places.of_beam(index, &line, true);
            let hinges = hinge_mesh::hinges(beam, &line, &with_struck, least);
            let wanted = beam.mesh.hinges && beam.mesh.grading.is_none() && !hinges.is_empty();
            let (plans, graded) = match wanted {
                true => hinge_mesh::spans(beam, &line, &with_struck, least),
                false => (mesh::spans(beam, &line, &places.of_beam(index, &line, false)), false),
            };
            let add = |plan| self.add_span(&line, (plan, beam.theory), &mut model);
            plans.iter().for_each(add);
            model.beams.push(BeamData {
                name: beam.name.clone(),
                spans: first.0..model.spans.len(),
                nodes: first.1..model.nodes.len(),
                elements: first.2..model.element_count(),
                length: line.length(),
                hinges,
                graded,
                axis: Arc::new(axis(&model, first.0, &line, &plans)),
            });
        }
        model
    }

    fn add_span(&self, line: &CentreLine, (plan, theory): (&SpanPlan, Theory), model: &mut Model) {
        let mut material = &self.materials[plan.material.0 as usize];
        // Shear-flexible beams have the strains of Simo and Reissner, which are of engineering in stretching.
        let engineering;
        if theory == Theory::Shear {
            engineering = Material { strain: StrainMeasure::Engineering, ..material.clone() };
            material = &engineering;
        }
        let section = &self.sections[plan.section.0 as usize];
        let make = fibres::Make { material, section, materials: &self.materials };
        let stations = &plan.stations;
        let n = stations.len() - 1;
        let frames: Vec<NodeFrame> = (0..=n)
            .map(|i| {
                let (position, tangent) = plan.node(line, i);
                NodeFrame { position, tangent }
            })
            .collect();
        let total = line.length();
        let section_line = SectionLine::new(&make, total);
        let mut shear = Vec::new();
        let mut table = |k: usize, length: f64| {
            let (ends, from) = ([frames[k], frames[k + 1]], stations[k]);
            let at = |xi: f64| section_line.at(from + xi * length);
            let table = ElementTable::new(length, ends, make.has_fibres(), at);
            if theory == Theory::Slender {
                return table;
            }
            // Fibres stand in the middle alone.
            let places = if make.has_fibres() { [0.5; GAUSS] } else { gauss_points() };
            let flexible = ShearTable::new(length, ends, &places.map(at));
            shear.push(flexible);
            flexible.carried_by(table, &gauss_points().map(at))
        };
        let share = |w: &[f64]| n as f64 * (w[1] - w[0]) / (stations[n] - stations[0]);
        let alike = mesh::is_straight(&line.pieces[plan.piece])
            && section_line.is_uniform()
            && stations.windows(2).all(|w| (share(w) - 1.0).abs() < 1e-9);
        let tables: Vec<ElementTable> = if alike {
            vec![table(0, (stations[n] - stations[0]) / n as f64)]
        } else {
            (0..n).map(|k| table(k, stations[k + 1] - stations[k])).collect()
        };
        let (first, element) = (model.nodes.len(), model.element_count());
        // Elements of different lengths have the same fibres.
        let (uniform, in_middle) = (section_line.is_uniform(), theory == Theory::Shear);
        let stretch = fibres::Stretch { stations, total, uniform, count: n, in_middle };
        // The count continues from the last span with fibres, past all without.
        let fibres_before = if make.has_fibres() { model.fibre_count() } else { 0 };
        let span = Span {
            nodes: first..first + n + 1,
            elements: element..element + n,
            tables,
            section: section_line,
            stations: stations.clone(),
            measure: material.strain,
            retardation: material.retardation,
            mass_damping: material.mass_damping,
            expansion: material.expansion,
            uniform_strain: material.uniform_strain,
            strength: material
                .strength
                .filter(|_| material.inelasticity.is_none() && make.is_plain()),
            shear_modulus: material.shear_stiffness(),
            moduli: make.moduli(),
            fibres: fibres::of_span(&make, &stretch, fibres_before),
            shear: (theory == Theory::Shear).then_some(shear),
        };
        for k in 0..n {
            let m = &span.table(k).mass;
            model.total_mass += m[0][0] + 2.0 * m[0][2] + m[2][2];
        }
        model.nodes.extend(frames);
        model.spans.push(span);
    }

    /// Material and section of a span.
    fn make(&self, plan: &SpanPlan) -> fibres::Make<'_> {
        let material = &self.materials[plan.material.0 as usize];
        let section = &self.sections[plan.section.0 as usize];
        fibres::Make { material, section, materials: &self.materials }
    }

    fn place_masses(&self, model: &mut Model) {
        for mass in &self.masses {
            let point = locate(model, &mass.at);
            let rotary_inertia = mass.rotary_inertia;
            model.masses.push(MassData { point, mass: mass.mass, rotary_inertia });
            model.total_mass += mass.mass;
        }
    }
}

/// The elements of the spans from `first_span` on, for contact; `plans` are those of the same spans.
fn axis(model: &Model, first_span: usize, line: &CentreLine, plans: &[SpanPlan]) -> AxisElements {
    let known = |depth: f64| if depth.is_nan() { 0.0 } else { depth };
    let element = |span: &Span, plan: &SpanPlan, k: usize| AxisElement {
        node: span.nodes.start + k,
        length: span.table(k).length,
        s: span.stations[k],
        bent: span.inside(k).bent,
        half_depths: [0.0, 1.0].map(|xi| known(span.section_at(k, xi).half_depth)),
        deviations: deviations(model, span, k, line, plan),
    };
    let spans = model.spans[first_span..].iter().zip(plans);
    let axis = spans
        .flat_map(|(span, plan)| (0..span.elements.len()).map(move |k| element(span, plan, k)));
    AxisElements::new(axis.collect())
}

/// Distance to the left from element `k` of a span to the line at its quarter points, shape (3) \[m\].
fn deviations(
    model: &Model,
    span: &Span,
    k: usize,
    line: &CentreLine,
    plan: &SpanPlan,
) -> [f64; 3] {
    if mesh::is_straight(&line.pieces[plan.piece]) {
        return [0.0; 3];
    }
    let [a, b] = [0, 1].map(|i| &model.nodes[span.nodes.start + k + i]);
    let (length, inside) = (span.table(k).length, span.inside(k));
    [0.25, 0.5, 0.75].map(|xi| {
        let (place, tangent) = plan.at(line, span.stations[k] + xi * length);
        let n = inside.axis(xi);
        let own = [0, 1].map(|i| {
            n[0] * a.position[i] + n[1] * a.tangent[i] + n[2] * b.position[i] + n[3] * b.tangent[i]
        });
        cross(tangent, sub(place, own))
    })
}
