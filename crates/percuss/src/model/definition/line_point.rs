//! Position and depth of a beam at a point, for the placement of other bodies.

use super::{Along, Beam, Section};
use crate::model::centre_line::CentreLine;

/// A point of a beam's centre line in the reference configuration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinePoint {
    /// Arc length from the start \[m\].
    pub s: f64,
    /// Arc length of the whole line \[m\].
    pub length: f64,
    /// Position, shape (2) \[m\].
    pub position: [f64; 2],
    /// Unit tangent, shape (2) \[-\]; at a corner that of the part before it.
    pub tangent: [f64; 2],
}

impl Beam {
    /// A point of the centre line; `None` outside of the line, or if the beam's points define none.
    pub fn line_point(&self, along: Along) -> Option<LinePoint> {
        let line = CentreLine::new(self)?;
        let (s, length) = (line.arc(along), line.length());
        if !(0.0..=length).contains(&s) {
            return None;
        }
        let mut start = 0.0;
        for (i, piece) in line.pieces.iter().enumerate() {
            let end = start + piece.length();
            if s <= end || i + 1 == line.pieces.len() {
                let (position, tangent) = piece.at(s - start);
                return Some(LinePoint { s, length, position, tangent });
            }
            start = end;
        }
        None
    }
}

impl Section {
    /// Depth between the extreme fibres at a fraction of the beam's length \[m\]; `None` where it is not given.
    pub fn depth_at(&self, fraction: f64) -> Option<f64> {
        self.at(fraction).depth
    }
}

#[cfg(test)]
mod tests {
    use super::super::{MaterialId, SectionId};
    use super::*;

    #[test]
    fn a_point_lies_on_the_line_and_no_further() {
        let points = [[0.0, 0.0], [0.0, 2.0], [3.0, 2.0]];
        let beam = Beam::new("b", &points, 5, MaterialId(0), SectionId(0));
        let at = |s: f64| beam.line_point(Along::Distance(s));
        let point = LinePoint { s: 3.0, length: 5.0, position: [1.0, 2.0], tangent: [1.0, 0.0] };
        assert_eq!(at(3.0), Some(point));
        assert_eq!(at(2.0).map(|p| p.tangent), Some([0.0, 1.0]));
        assert_eq!(at(5.0).map(|p| p.position), Some([3.0, 2.0]));
        assert_eq!((at(5.1), at(-0.1)), (None, None));
    }

    #[test]
    fn a_tapered_section_has_a_depth_at_every_place() {
        let mut section = Section::rectangle("s", 1.0, 0.5);
        assert_eq!(section.depth_at(0.3), Some(0.5));
        let station = |at: f64, depth: f64| super::super::Station {
            at,
            area: 1.0,
            inertia: 1.0,
            depth: Some(depth),
            profile: super::super::Profile::Unknown,
            properties: Default::default(),
        };
        section.stations = vec![station(0.0, 1.0), station(1.0, 3.0)];
        assert_eq!(section.depth_at(0.25), Some(1.5));
    }
}
