//! Findings before a run.

use std::f64::consts::PI;

use super::case::{Beams, Case, Meeting, Struck, rigid_blow};
use super::desk::{Desk, STEPS, graded};
use super::duration::{From, Lasting, Modes};
use super::expected::{Expected, Trials};
use super::formulas::{pulse_frequency, reduced_mass};
use super::structure::{BeamPlace, gravity, gravity_varies};
use super::surroundings::Surroundings;
use super::words::{digits, quantity, round_down};
use super::{Advice, Topic, Verdict, end_on, faces, shear, touch};
use percuss::Settings;
use percuss::math::vec2::dot;
use percuss::{EffectiveMass, HertzBody, Model, Potential, PressedIn};

/// Elements of the shortest wave of weight with which the force is within a per cent, and below which it is off by up to 40 %: thirty
/// scenes against meshes of 160 elements (docs/results.md).
const ELEMENTS: [f64; 2] = [2.0, 1.0];
/// A beam with this share of its direction along a wall's normal meets it end on.
const END_ON: f64 = 0.99;
/// A contact so many times stiffer than Hertz' is worth a word.
const STIFF: f64 = 3.0;
/// Waves that come back within this share of a contact come back several times: the span answers as a whole.
const WAVES: f64 = 1.0 / 3.0;
/// Poisson's ratio for Hertz' contact; beams have none.
const POISSON: f64 = 0.3;

/// What hand calculation says about a contact.
pub fn findings(
    model: &Model,
    settings: &Settings,
    case: &Case<'_>,
    mass: Option<EffectiveMass>,
    (modes, trials): (&Modes<'_>, &Trials<'_>),
) -> Vec<Advice> {
    let desk = Desk { model, settings, case };
    let lasting = modes.lasting(case);
    let held = mass.is_some_and(|mass| mass.on_mesh.is_infinite())
        || lasting.as_ref().is_some_and(Lasting::is_held);
    let expected = if held {
        None
    } else {
        trials.expected(case, lasting.as_ref(), desk.is_certain(lasting.as_ref()))
    };
    let expected = expected.as_ref();
    let found = match &case.meeting {
        // What gives way to no blow has no waves either.
        Meeting::Struck(struck) if held => desk.held(struck, mass),
        Meeting::Beams(_) if held => vec![mass.and_then(|mass| desk.effective_mass(mass))],
        Meeting::Struck(struck) => desk.struck(struck, mass, expected),
        Meeting::Bodies(_) => vec![expected.map(|expected| desk.duration(expected))],
        Meeting::Beams(beams) => desk.beams(beams, mass, expected),
    };
    // Steps chosen for an accuracy are not known before.
    let of_steps = |topic: Topic| settings.accuracy.is_some() && OF_STEPS.contains(&topic);
    found.into_iter().flatten().filter(|advice| !of_steps(advice.topic)).collect()
}

/// What is said of the size of steps.
const OF_STEPS: [Topic; 5] = [
    Topic::ContactDuration,
    Topic::WaveTransit,
    Topic::RearMass,
    Topic::Recording,
    Topic::ForceRise,
];

impl Desk<'_> {
    /// Whether an estimate holds without a trial, and if not, why.
    fn is_certain(&self, lasting: Option<&Lasting>) -> Result<(), String> {
        let because = |what: &str| Err(what.to_owned());
        let (_, loads) = gravity(self.model);
        if loads || gravity_varies(self.model) {
            return because("other loads act as well");
        }
        if self.model.contacts().len() > 1 {
            return because("other contacts may act meanwhile");
        }
        let Some(lasting) = lasting else {
            return because("nothing that hand calculation knows brings it about");
        };
        if lasting.from == From::Comes {
            return because("it is not known in what motion the beam comes");
        }
        if let Some(limit) = self.bends_beyond(lasting) {
            return Err(format!(
                "the struck point goes {} far, where its stiffness changes beyond some {}",
                quantity(lasting.deflection, "m"),
                quantity(limit, "m")
            ));
        }
        Ok(())
    }

    pub fn finding(
        &self,
        topic: Topic,
        values: [f64; 2],
        unit: &'static str,
        verdict: Verdict,
        text: String,
    ) -> Advice {
        Advice::new(self.case.name, topic, values, unit, verdict, text)
    }

    fn struck(
        &self,
        struck: &Struck<'_>,
        mass: Option<EffectiveMass>,
        expected: Option<&Expected<'_>>,
    ) -> Vec<Option<Advice>> {
        let contact = expected.and_then(Expected::duration);
        let lasting = expected.and_then(|expected| expected.lasting);
        let across = struck.across();
        vec![
            touch::finding(self, struck, contact, expected),
            expected.map(|expected| self.duration(expected)),
            contact.filter(|_| across > 0.5).map(|contact| self.bending(struck, contact)),
            self.transit(&struck.place, across < 0.99, contact),
            mass.and_then(|mass| self.effective_mass(mass)),
            self.stiffness(struck),
            self.pressed(struck),
            contact.filter(|_| across > 0.5).map(|contact| self.span(struck, contact)),
            self.rear(struck),
            shear::finding(self, struck, lasting),
            end_on::strut(self, struck),
            contact.and_then(|contact| self.recording(contact)),
        ]
    }

    /// A place that is held: the projectile is on its own.
    fn held(&self, struck: &Struck<'_>, mass: Option<EffectiveMass>) -> Vec<Option<Advice>> {
        let weight = struck.mass * struck.pull();
        let blow = rigid_blow(self.case.law, struck.mass, struck.speed, weight);
        let contact = blow.map(|blow| blow.duration);
        vec![
            touch::finding(self, struck, contact, None),
            mass.and_then(|mass| self.effective_mass(mass)),
            self.rear(struck),
        ]
    }

    fn beams(
        &self,
        beams: &Beams<'_>,
        mass: Option<EffectiveMass>,
        expected: Option<&Expected<'_>>,
    ) -> Vec<Option<Advice>> {
        let tangent = beams.place.tangent();
        let lengthwise = beams.wall.is_some_and(|normal| dot(normal, tangent).abs() > 0.1);
        let mut all = vec![
            self.transit(&beams.place, lengthwise, expected.and_then(Expected::duration)),
            faces::finding(self, beams),
            mass.and_then(|mass| self.effective_mass(mass)),
        ];
        if beams.wall.is_some_and(|normal| dot(normal, tangent).abs() > END_ON) {
            all.extend(end_on::on_wall(self, beams, expected.and_then(Expected::duration)));
        } else {
            all.push(expected.map(|expected| self.duration(expected)));
            let contact = expected.and_then(Expected::duration);
            all.push(contact.and_then(|contact| self.recording(contact)));
        }
        all
    }

    fn bending(&self, struck: &Struck<'_>, contact: f64) -> Advice {
        let wave = struck.place.section().wavelength(pulse_frequency(contact));
        let element = struck.place.element_length();
        let verdict = graded(wave / element, ELEMENTS);
        let mut text = format!(
            "the shortest bending waves of weight in this contact are {} long, {} elements",
            quantity(wave, "m"),
            digits(wave / element)
        );
        if verdict != Verdict::Fine {
            let shorter = quantity(round_down(wave / ELEMENTS[0]), "m");
            text += &format!(
                ": too few to carry them, and the force is off by {} %; use elements of {shorter} or less near the \
                 struck point",
                if verdict == Verdict::Note { "up to 5" } else { "5 to 40" }
            );
        }
        self.finding(Topic::BendingWave, [wave, element], "m", verdict, text)
    }

    /// `lengthwise` says whether the blow has a part along the beam, `contact` how long it lasts, if that is known.
    fn transit(
        &self,
        place: &BeamPlace<'_>,
        lengthwise: bool,
        contact: Option<f64>,
    ) -> Option<Advice> {
        let step = self.settings.step;
        let transit = place.shortest_transit();
        let ratio = step / transit;
        let rigid = self.case.law.is_rigid();
        let gentle = contact.is_some_and(|contact| contact >= STEPS[0] * step);
        let (verdict, rest) = match (ratio <= 1.0, lengthwise, rigid) {
            (false, true, false) if gentle => {
                (Verdict::Fine, "the waves of weight in so long a contact are longer".to_owned())
            }
            (true, ..) => (Verdict::Fine, "the step follows such waves".to_owned()),
            (false, false, false) => {
                (Verdict::Fine, "they matter little in a soft blow across the beam".to_owned())
            }
            _ => {
                let better = quantity(round_down(transit), "s");
                let why = if lengthwise {
                    "the step smears the waves that carry this blow"
                } else {
                    "what follows the first impact hangs on waves that the step does not follow"
                };
                (Verdict::Note, format!("{why}; set time.step to {better} or less"))
            }
        };
        let text = format!(
            "one step is {} times the {} that a longitudinal wave takes through the shortest element: {rest}",
            digits(ratio),
            quantity(transit, "s"),
        );
        Some(self.finding(Topic::WaveTransit, [transit, step], "s", verdict, text))
    }

    fn effective_mass(&self, mass: EffectiveMass) -> Option<Advice> {
        if !self.case.law.is_rigid() || mass.on_mesh.is_nan() {
            return None;
        }
        let (verdict, text) = if mass.on_mesh.is_infinite() {
            (Verdict::Fine, "the struck point is held and gives way to no blow".to_owned())
        } else {
            let here = quantity(mass.on_mesh, "kg");
            let limit = quantity(mass.limit, "kg");
            let text = format!("the struck point answers a blow with {here} on this mesh");
            if mass.depends_on_mesh() {
                let mass = if self.case.guided.is_some() { "a local_mass or " } else { "" };
                let advice = format!(
                    "take the impulse as that of this mesh, or give the contact {mass}a compliance of its own"
                );
                let text = format!("{text}, with {limit} on ever finer ones: {advice}");
                (Verdict::Warning, text)
            } else {
                (Verdict::Fine, format!("{text}, with {limit} on ever finer ones"))
            }
        };
        let values = [mass.on_mesh, mass.limit];
        Some(self.finding(Topic::EffectiveMass, values, "kg", verdict, text))
    }

    /// How deep a disc is pressed in at most, if that is deep: as if what is held did not give way, and what is free met it as one piece.
    fn pressed(&self, struck: &Struck<'_>) -> Option<Advice> {
        let half_depth = struck.place.half_depth();
        let through = struck.radius? + if half_depth.is_nan() { 0.0 } else { half_depth };
        let held = Surroundings::of(self.model, struck.place.index).held;
        let target = if held { f64::INFINITY } else { struck.beam_mass() };
        let mass = reduced_mass([struck.mass, target]);
        let blow = rigid_blow(self.case.law, mass, struck.speed, 0.0)?;
        let pressed = PressedIn { penetration: blow.penetration, through, time: f64::NAN };
        if !pressed.is_deep() {
            return None;
        }
        let text = format!(
            "law, mass and speed let it be pressed in by up to {}, and the middles of both meet at {}: place and direction of the force \
             mean little that deep; give the law more stiffness",
            quantity(blow.penetration, "m"),
            quantity(through, "m")
        );
        let values = [blow.penetration, through];
        Some(self.finding(Topic::Pressed, values, "m", Verdict::Note, text))
    }

    fn stiffness(&self, struck: &Struck<'_>) -> Option<Advice> {
        let half_depth = struck.place.half_depth();
        let radius = struck.radius.or((half_depth > 0.0).then_some(half_depth))?;
        let flat =
            HertzBody { young: struck.place.young(), poisson: POISSON, radius: f64::INFINITY };
        let ball = HertzBody { young: f64::INFINITY, poisson: POISSON, radius };
        let Potential::Hertz { stiffness: constant } = Potential::hertz([ball, flat]) else {
            return None;
        };
        let mass = reduced_mass([struck.mass, struck.beam_mass()]);
        let energy = mass * struck.speed * struck.speed;
        let chosen = rigid_blow(self.case.law, mass, struck.speed, 0.0)?;
        let hertz = super::formulas::hertz_blow(mass, constant, struck.speed);
        // The linear spring with the same peak force at this speed.
        let [value, reference] = [chosen, hertz].map(|b| b.peak_force.powi(2) / energy);
        if !(value.is_finite() && reference.is_finite()) {
            return None;
        }
        let whose = if struck.radius.is_some() { "its radius" } else { "the beam's half depth" };
        let ball = format!(
            "Hertz' contact of a rigid ball of {whose}, {}, with this beam (K = {} N/m^1.5)",
            quantity(radius, "m"),
            digits(constant)
        );
        let ratio = value / reference;
        let (verdict, text) = if ratio > STIFF {
            (
                Verdict::Note,
                format!(
                    "the contact is {} times as stiff as {ball}, and its peak force up to {} times \
                     as large: unless flat faces meet, use that law",
                    digits(ratio),
                    digits(ratio.sqrt())
                ),
            )
        } else {
            (
                Verdict::Fine,
                format!("the contact has {} times the stiffness of {ball}", digits(ratio)),
            )
        };
        Some(self.finding(Topic::Stiffness, [value, reference], "N/m", verdict, text))
    }

    fn span(&self, struck: &Struck<'_>, contact: f64) -> Advice {
        let (section, free) = (struck.place.section(), struck.place.free_distance());
        let least = section.least_distance(contact);
        let back = section.return_time(free, contact);
        let (time, lasts) = (quantity(back, "s"), quantity(contact, "s"));
        let needed = quantity(least, "m");
        let (verdict, text) = if free == 0.0 {
            let text = "the struck point is an end of the beam, or tied to something: ends and ties take part in the contact throughout";
            (Verdict::Fine, text.to_owned())
        } else if free >= least && !struck.place.is_uniform() {
            let text = format!(
                "bending waves come back from the nearest end or support after {time}, when the contact of {lasts} is over; where the \
                 beam curves or changes its section, waves come back before"
            );
            (Verdict::Fine, text)
        } else if free >= least {
            let text = format!(
                "bending waves come back from the nearest end or support after {time}, when the \
                 contact of {lasts} is over: as on a beam without end"
            );
            (Verdict::Fine, text)
        } else if back < WAVES * contact {
            let text = format!(
                "bending waves come back from the nearest end or support after {time}, many times \
                 in the contact of {lasts}: the whole span takes part in it"
            );
            (Verdict::Fine, text)
        } else {
            let text = format!(
                "bending waves come back from the nearest end or support after {time}, within the \
                 contact of {lasts}: how the beam is held shapes the force; to keep that out, leave \
                 {needed} free on either side"
            );
            (Verdict::Note, text)
        };
        self.finding(Topic::Span, [free, least], "m", verdict, text)
    }

    fn rear(&self, struck: &Struck<'_>) -> Option<Advice> {
        let rear = struck.rear?;
        let mass = reduced_mass([struck.mass, rear.mass]);
        let period = 2.0 * PI * (mass / rear.stiffness).sqrt();
        let steps = period / self.settings.step;
        let verdict = graded(steps, STEPS);
        let (lasts, count) = (quantity(period, "s"), digits(steps));
        let mut text = format!(
            "the two masses swing against each other with a period of {lasts}, {count} steps"
        );
        if verdict != Verdict::Fine {
            let better = quantity(round_down(period / STEPS[0]), "s");
            text += &format!(": set time.step to {better} to follow them");
        }
        let values = [period, self.settings.step];
        Some(self.finding(Topic::RearMass, values, "s", verdict, text))
    }
}
