//! Tapered beams: sections at their given places, for any mesh.

use crate::common;

use common::*;
use percuss::*;

/// A station with a rectangle 50 mm wide.
fn station(at: f64, depth: f64) -> Station {
    let Section { area, inertia, depth, profile, .. } = Section::rectangle("r", 0.05, depth);
    Station { at, area, inertia, depth, profile, properties: Default::default() }
}

/// 4 m long, 100 mm deep at both ends and 300 mm a quarter of the way, clamped at both ends.
fn girder(b: &mut ModelBuilder, elements: usize) -> BeamId {
    let material = b.material(Material::new("steel", 210e9, 7850.0));
    let stations = vec![station(0.0, 0.1), station(0.25, 0.3), station(1.0, 0.1)];
    let section = Section { stations, ..Section::rectangle("taper", 0.05, 0.1) };
    let section = b.section(section);
    let girder = b.beam(beam("girder", [0.0, 0.0], [4.0, 0.0], elements, material, section));
    for (name, f) in [("left", 0.0), ("right", 1.0)] {
        b.support(Support::new(name, at(name, girder, f), SupportKind::Clamp));
    }
    girder
}

/// A ball of radius 10 mm falls onto the peak from 1 m at 10 m/s: its face is half of 300 mm up.
#[test]
fn a_ball_meets_the_face_where_the_section_puts_it() {
    for elements in [1, 2, 3, 8] {
        let mut b = ModelBuilder::new();
        let girder = girder(&mut b, elements);
        let ball = b.disc(disc("ball", 1.0, 0.01, [1.0, 1.0], [0.0, -10.0]));
        let between = [ContactPartner::Disc(ball), ContactPartner::Beam(girder)];
        b.contact(Contact::new("blow", between, TouchLaw::Rigid(RigidLaw::frictionless(0.5))));
        let model = b.build().unwrap();
        let summary = simulate(&model, &Settings::new(0.09, 1e-4), &mut NoRecorder).unwrap();
        let ContactRecord::Nonsmooth { impacts, .. } = &summary.contacts[0].record else {
            panic!("a rigid contact")
        };
        assert!((impacts[0].time - 0.084).abs() < 1e-9, "{elements}: {impacts:?}");
    }
}

/// Two straight lines of area: `4 m x 50 mm x 200 mm`, whatever the elements.
#[test]
fn the_mass_of_a_taper_is_that_of_its_sections() {
    let mass = |elements: usize| {
        let mut b = ModelBuilder::new();
        girder(&mut b, elements);
        b.build().unwrap().total_mass
    };
    for elements in [1, 2, 3, 7] {
        let found = mass(elements);
        assert!((found / (7850.0 * 4.0 * 0.05 * 0.2) - 1.0).abs() < 1e-12, "{elements}: {found}");
    }
}
