//! Where things stand in a frame: the scene with its beams as the solver's cubics; see `scene.js` for those that are shear-flexible.

use serde_json::Value;

use crate::fields::{Fields, StoredFrame};

/// A beam of the scene.
#[derive(Clone, Debug)]
pub(super) struct Beam {
    pub name: String,
    /// Arc lengths of the stations, shape (stations) \[m\].
    pub s: Vec<f64>,
    /// Positions of the stations, shape (2, stations) \[m\].
    position: [Vec<f64>; 2],
    /// Unit tangents there, shape (2, stations) \[-\].
    tangent: [Vec<f64>; 2],
    /// Not finite where it is not known, shape (stations) \[m\].
    pub half_depth: Vec<f64>,
    /// Areas there, shape (stations) \[m^2\].
    pub area: Vec<f64>,
    /// Second moments of area there, shape (stations) \[m^4\].
    pub inertia: Vec<f64>,
    /// Whether it is shear-flexible: the tangents are the normals of its sections.
    shear_flexible: bool,
    /// Share of bending in the intervals that begin at stations, shape (stations) \[-\]; empty where it is zero.
    bent: Vec<f64>,
    /// Number of its first station among all nodes.
    first: usize,
    /// Stations at which an interval begins, and the interval's number among those of all beams, shape (intervals, 2)
    /// \[index of a station, index of an interval\].
    pub intervals: Vec<(usize, usize)>,
}

/// A point of a beam's axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct OnAxis {
    /// Position, shape (2) \[m\].
    pub place: [f64; 2],
    /// Displacement from the reference configuration, shape (2) \[m\].
    pub displacement: [f64; 2],
    /// Unit normal, to the left of the tangent, shape (2) \[-\].
    pub normal: [f64; 2],
    /// Velocity, shape (2) \[m/s\].
    pub velocity: [f64; 2],
    /// Angular rate of the section.
    pub spin: f64,
    /// Normal in the reference configuration, shape (2) \[-\].
    pub rest_normal: [f64; 2],
}

/// A scene and its frames, known to fit each other.
#[derive(Debug)]
pub(super) struct Placed<'a> {
    pub scene: &'a Value,
    /// The frames, shape (frames).
    pub frames: &'a [StoredFrame],
    /// The beams, shape (beams).
    pub beams: Vec<Beam>,
    /// Nodes of all beams; behind them stand the bodies.
    pub stations: usize,
    pub intervals: usize,
    /// Corners of what the beams and discs pass through, shape (2, 2) \[m\].
    pub bounds: [[f64; 2]; 2],
}

impl<'a> Placed<'a> {
    /// Reads the scene; says what does not fit.
    pub fn new(fields: &'a Fields) -> Result<Self, String> {
        if fields.frames.is_empty() {
            return Err(
                "no frames were kept of this run; run it again with record.shapes above 0".into()
            );
        }
        let (mut beams, mut stations, mut intervals) = (Vec::new(), 0, 0);
        for value in list(&fields.scene, "beams") {
            let beam = Beam::read(value, stations, &mut intervals)?;
            stations += beam.s.len();
            beams.push(beam);
        }
        let nodes = stations + list(&fields.scene, "bodies").len();
        for (k, frame) in fields.frames.iter().enumerate() {
            let fits = frame.displacement.len() == 4 * nodes
                && (frame.velocity.is_empty() || frame.velocity.len() == 4 * nodes)
                && (frame.angular_velocity.is_empty()
                    || frame.angular_velocity.len() == 3 * intervals)
                && frame.section_forces.len() == 6 * intervals
                && frame.has_points_of(intervals)
                && frame.contact_forces.len().is_multiple_of(6);
            if !fits {
                return Err(format!(
                    "frame {k} does not fit scene.json ({nodes} nodes, {intervals} intervals)"
                ));
            }
        }
        let bounds = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
        let mut placed = Self {
            scene: &fields.scene,
            frames: &fields.frames,
            beams,
            stations,
            intervals,
            bounds,
        };
        placed.measure();
        Ok(placed)
    }

    /// Things of a kind in the scene.
    pub fn list(&self, kind: &str) -> &'a [Value] {
        list(self.scene, kind)
    }

    /// Whether velocities were kept.
    pub fn has_velocities(&self) -> bool {
        self.frames.iter().all(|frame| !frame.velocity.is_empty())
    }

    /// Largest extent of what the beams and discs pass through.
    pub fn size(&self) -> f64 {
        let [low, high] = self.bounds;
        (high[0] - low[0]).max(high[1] - low[1]).max(1e-9)
    }

    /// Displacement and velocity (1, 2, angle) of a body.
    pub fn body(&self, frame: &StoredFrame, body: usize) -> [[f64; 3]; 2] {
        let at = 4 * (self.stations + body);
        [&frame.displacement, &frame.velocity]
            .map(|rows| std::array::from_fn(|i| rows.get(at + i).map_or(0.0, |v| f64::from(*v))))
    }

    /// Whether a beam of this number has parted between two stations by the time of a frame.
    pub fn is_parted(&self, beam: usize, k: usize, frame: &StoredFrame) -> bool {
        let s = &self.beams[beam].s;
        list(self.scene, "parted").iter().any(|gap| {
            let number = |value: &Value| value.as_f64().unwrap_or(f64::NAN);
            let (from, to) = (number(&gap["stretch"][0]), number(&gap["stretch"][1]));
            let overlap = to.min(s[k + 1]) - from.max(s[k]);
            gap["beam"].as_u64() == u64::try_from(beam).ok()
                && number(&gap["time"]) <= frame.time
                && overlap > 1e-9 * (to - from)
        })
    }

    /// Angular rate of the section in an interval at a share of the way, where it was kept.
    fn spin(interval: usize, x: f64, frame: &StoredFrame) -> Option<f64> {
        let values = frame.angular_velocity.get(3 * interval..3 * interval + 3)?;
        let shape = [(1.0 - x) * (1.0 - 2.0 * x), 4.0 * x * (1.0 - x), x * (2.0 * x - 1.0)];
        Some(values.iter().zip(shape).map(|(v, n)| f64::from(*v) * n).sum())
    }

    /// A point of a beam between two stations, in an interval, at a share of the way.
    pub fn point(
        &self,
        beam: &Beam,
        (k, interval): (usize, usize),
        share: f64,
        frame: &StoredFrame,
    ) -> OnAxis {
        let (x, y) = (share, 1.0 - share);
        let length = beam.s[k + 1] - beam.s[k];
        let value = [
            y * y * (1.0 + 2.0 * x),
            length * x * y * y,
            x * x * (1.0 + 2.0 * y),
            -length * x * x * y,
        ];
        let slope = [
            (6.0 * x * x - 6.0 * x) / length,
            1.0 - 4.0 * x + 3.0 * x * x,
            (6.0 * x - 6.0 * x * x) / length,
            3.0 * x * x - 2.0 * x,
        ];
        let node = 4 * (beam.first + k);
        let sum = |n: [f64; 4], v: [f64; 4]| n[0] * v[0] + n[1] * v[1] + n[2] * v[2] + n[3] * v[3];
        let of = |rows: &[f32], i: usize| -> [f64; 4] {
            let at = |j: usize| rows.get(node + j + i).map_or(0.0, |v| f64::from(*v));
            [at(0), at(2), at(4), at(6)]
        };
        let rest = |i: usize| {
            let (place, tangent) = (&beam.position[i], &beam.tangent[i]);
            [place[k], tangent[k], place[k + 1], tangent[k + 1]]
        };
        let bent = beam.bent.get(k).copied().unwrap_or(0.0);
        let placed = |v: [f64; 4]| sum(value, beam.axis(v, (length, bent)));
        let along = |v: [f64; 4]| {
            let leant = 6.0 * bent * x * y * difference(v, length);
            if beam.shear_flexible { y * v[1] + x * v[3] + leant } else { sum(slope, v) }
        };
        let rest_place = [0, 1].map(|i| placed(rest(i)));
        let rest_slope = [0, 1].map(|i| along(rest(i)));
        let displacement = [0, 1].map(|i| placed(of(&frame.displacement, i)));
        let turned = [0, 1].map(|i| rest_slope[i] + along(of(&frame.displacement, i)));
        let velocity = [0, 1].map(|i| placed(of(&frame.velocity, i)));
        let rate = [0, 1].map(|i| along(of(&frame.velocity, i)));
        let stretch = (turned[0] * turned[0] + turned[1] * turned[1]).max(f64::MIN_POSITIVE);
        OnAxis {
            place: [0, 1].map(|i| rest_place[i] + displacement[i]),
            displacement,
            normal: normal_of(turned),
            velocity,
            spin: Self::spin(interval, share, frame)
                .unwrap_or((turned[0] * rate[1] - turned[1] * rate[0]) / stretch),
            rest_normal: normal_of(rest_slope),
        }
    }

    /// A place on a beam as `scene.json` names it, with the half depth there (zero if unknown).
    pub fn on(&self, place: &Value, frame: &StoredFrame) -> Option<(OnAxis, f64)> {
        let beam = self.beams.get(usize::try_from(place["beam"].as_u64()?).ok()?)?;
        let s = place["s"].as_f64()?;
        let mut spans = beam.intervals.iter();
        let found = spans.find(|(k, _)| s <= beam.s[k + 1]).or(beam.intervals.last());
        let (k, interval) = *found?;
        let share = ((s - beam.s[k]) / (beam.s[k + 1] - beam.s[k])).clamp(0.0, 1.0);
        let depth = mix(&beam.half_depth, k, share);
        Some((
            self.point(beam, (k, interval), share, frame),
            if depth.is_finite() { depth } else { 0.0 },
        ))
    }

    fn measure(&mut self) {
        let mut bounds = self.bounds;
        let mut grow = |place: [f64; 2], margin: f64| {
            for i in 0..2 {
                bounds[0][i] = bounds[0][i].min(place[i] - margin);
                bounds[1][i] = bounds[1][i].max(place[i] + margin);
            }
        };
        let moved = |at: [f64; 2], frame: &StoredFrame, node: usize| {
            [0, 1].map(|i| at[i] + f64::from(frame.displacement[4 * node + i]))
        };
        for frame in self.frames {
            for beam in &self.beams {
                for k in 0..beam.s.len() {
                    let at = [beam.position[0][k], beam.position[1][k]];
                    let depth = beam.half_depth[k];
                    let margin = if depth.is_finite() { depth } else { 0.0 };
                    grow(moved(at, frame, beam.first + k), margin);
                }
            }
            for (k, body) in self.list("bodies").iter().enumerate() {
                if let Some(radius) = body["radius"].as_f64() {
                    grow(moved(pair(&body["position"]), frame, self.stations + k), radius);
                }
            }
        }
        self.bounds = if bounds[0][0].is_finite() { bounds } else { [[-1.0; 2], [1.0; 2]] };
    }
}

impl Beam {
    /// Nodal values of the cubic of the axis between two stations so far apart, with a share of bending: of a shear-flexible beam both slopes differ
    /// from the normals of the sections by the shear.
    fn axis(&self, v: [f64; 4], (length, bent): (f64, f64)) -> [f64; 4] {
        let [a, slope, b, other] = v;
        let shear = (1.0 - bent) * difference(v, length);
        let shear = if self.shear_flexible { shear } else { 0.0 };
        [a, slope + shear, b, other + shear]
    }

    fn read(value: &Value, first: usize, intervals: &mut usize) -> Result<Self, String> {
        let name = text(&value["name"]);
        let column = |key: &str| -> Vec<f64> {
            let entries = value[key].as_array().map(Vec::as_slice).unwrap_or_default();
            entries.iter().map(|v| v.as_f64().unwrap_or(f64::NAN)).collect()
        };
        let s = column("s");
        let beam = Self {
            position: [column("x"), column("y")],
            tangent: [column("tx"), column("ty")],
            half_depth: column("half_depth"),
            area: column("area"),
            inertia: column("inertia"),
            shear_flexible: value["shear_flexible"].as_bool().unwrap_or(false),
            bent: column("bent"),
            first,
            intervals: Vec::new(),
            name,
            s,
        };
        let columns = [&beam.position[0], &beam.position[1], &beam.tangent[0], &beam.tangent[1]];
        let more = [&beam.half_depth, &beam.area, &beam.inertia];
        if columns.into_iter().chain(more).any(|column| column.len() != beam.s.len()) {
            return Err(format!(
                "scene.json: the columns of beam `{}` differ in length",
                beam.name
            ));
        }
        let begins = (1..beam.s.len()).filter(|k| beam.s[*k] > beam.s[k - 1]).map(|k| k - 1);
        let numbered = begins.map(|k| {
            *intervals += 1;
            (k, *intervals - 1)
        });
        let numbered = numbered.collect();
        Ok(Self { intervals: numbered, ..beam })
    }
}

/// The slope of the chord less the mean slope of both ends.
fn difference([a, slope, b, other]: [f64; 4], length: f64) -> f64 {
    (b - a) / length - 0.5 * (slope + other)
}

/// A value between two stations.
pub(super) fn mix(column: &[f64], k: usize, share: f64) -> f64 {
    column[k] + share * (column[k + 1] - column[k])
}

/// A text of the scene; empty where there is none.
pub(super) fn text(value: &Value) -> String {
    value.as_str().unwrap_or_default().to_owned()
}

/// Two numbers of the scene; zero where they are missing.
pub(super) fn pair(value: &Value) -> [f64; 2] {
    [0, 1].map(|i| value[i].as_f64().unwrap_or(0.0))
}

fn normal_of(tangent: [f64; 2]) -> [f64; 2] {
    let size = tangent[0].hypot(tangent[1]).max(f64::MIN_POSITIVE);
    [-tangent[1] / size, tangent[0] / size]
}

fn list<'a>(scene: &'a Value, kind: &str) -> &'a [Value] {
    scene[kind].as_array().map(Vec::as_slice).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn a_shear_flexible_beam_is_drawn_by_the_field_inside_its_elements() {
        let beam = |bent: f64| {
            json!({ "name": "b", "s": [0.0, 2.0], "x": [0.0, 2.0], "y": [0.0, 0.0], "tx": [1.0, 1.0], "ty": [0.0, 0.0],
            "half_depth": [0.1, 0.1], "area": [1.0, 1.0], "inertia": [1.0, 1.0], "shear_flexible": true, "bent": [bent, 0.0] })
        };
        // The right end rises by 1 m over 2 m, with a level normal and with one of slope 1; by shear, and by bending alone, as a slender beam.
        let cases = [
            (0.0, 0.0, 0.25, 0.0),
            (0.0, 1.0, 0.0625, 0.25),
            (1.0, 0.0, 0.15625, 0.5625),
            (1.0, 1.0, 0.0625, 0.25),
        ];
        for (bent, turn, rise, slope) in cases {
            let frame = StoredFrame {
                displacement: vec![0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, turn],
                section_forces: vec![0.0; 6],
                ..StoredFrame::default()
            };
            let fields =
                Fields { scene: json!({ "beams": [beam(bent)] }), frames: vec![frame.clone()] };
            let placed = Placed::new(&fields).unwrap();
            let at = placed.point(&placed.beams[0], (0, 0), 0.25, &frame);
            assert!((at.place[0] - 0.5).abs() < 1e-12 && (at.place[1] - rise).abs() < 1e-12);
            assert!((-at.normal[0] / at.normal[1] - slope).abs() < 1e-12, "{:?}", at.normal);
        }
    }
}
