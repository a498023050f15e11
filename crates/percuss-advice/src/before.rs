//! Findings before a run.

use std::f64::consts::PI;

use super::case::{Beams, Case, Meeting, Struck, rigid_impact};
use super::duration::{From, Lasting, Modes};
use super::expected::{Expected, Trials};
use super::formulas::{pulse_frequency, reduced_mass};
use super::planned::{PlannedContact, STEPS, graded};
use super::structure::{BeamPlace, gravity, gravity_varies};
use super::surroundings::Surroundings;
use super::words::{digits, quantity, round_down};
use super::{Advice, Topic, Verdict, end_on, faces, first_contact, shear};
use percuss::Settings;
use percuss::math::vec2::dot;
use percuss::{EffectiveMass, HertzBody, Model, Potential, PressedIn, TouchLaw};

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

/// Estimates about a contact, in closed form or by a trial computation.
pub fn findings(
    model: &Model,
    settings: &Settings,
    case: &Case<'_>,
    mass: Option<EffectiveMass>,
    (modes, trials): (&Modes<'_>, &Trials<'_>),
) -> Vec<Advice> {
    let planned = PlannedContact { model, settings, case };
    let lasting = modes.lasting(case);
    let held = mass.is_some_and(|mass| mass.on_mesh.is_infinite())
        || lasting.as_ref().is_some_and(Lasting::is_held);
    let expected = if held {
        None
    } else {
        trials.expected(case, lasting.as_ref(), planned.is_certain(lasting.as_ref()))
    };
    let expected = expected.as_ref();
    let found = match &case.meeting {
        // A supported point sends out no waves.
        Meeting::Struck(struck) if held => planned.held(struck, mass),
        Meeting::Beams(_) if held => vec![mass.and_then(|mass| planned.effective_mass(mass))],
        Meeting::Struck(struck) => planned.struck(struck, mass, expected),
        Meeting::Bodies(_) => vec![expected.map(|expected| planned.duration(expected))],
        Meeting::Beams(beams) => planned.beams(beams, mass, expected),
    };
    // Steps chosen for an accuracy are not known before.
    let of_steps = |topic: Topic| settings.accuracy.is_some() && OF_STEPS.contains(&topic);
    found.into_iter().flatten().filter(|advice| !of_steps(advice.topic)).collect()
}

/// Findings about the size of steps.
const OF_STEPS: [Topic; 5] = [
    Topic::ContactDuration,
    Topic::WaveTransit,
    Topic::RearMass,
    Topic::Recording,
    Topic::ForceRise,
];

impl PlannedContact<'_> {
    /// Whether an estimate holds without a trial, and if not, why.
    fn is_certain(&self, lasting: Option<&Lasting>) -> Result<(), String> {
        let because = |what: &str| Err(what.to_owned());
        let (_, loads) = gravity(self.model);
        if loads || gravity_varies(self.model) {
            return because("other loads act as well");
        }
        if self.model.contacts().len() > 1 {
            return because("other contacts are possible");
        }
        let Some(lasting) = lasting else {
            return because("no closed-form estimate applies");
        };
        if lasting.from == From::Comes {
            return because("the motion of the beam before the contact is unknown");
        }
        if let Some(limit) = self.bends_beyond(lasting) {
            return Err(format!(
                "the struck point deflects by {}, and its stiffness changes beyond about {}",
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
        let mass = mass.filter(|_| struck.begins_with_an_impact());
        vec![
            first_contact::finding(self, struck, contact, expected),
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

    /// A supported point: only the projectile moves.
    fn held(&self, struck: &Struck<'_>, mass: Option<EffectiveMass>) -> Vec<Option<Advice>> {
        let weight = struck.mass * struck.pull();
        let impact = rigid_impact(self.case.law, struck.mass, struck.speed, weight);
        let contact = impact.map(|impact| impact.duration);
        vec![
            first_contact::finding(self, struck, contact, None),
            mass.filter(|_| struck.begins_with_an_impact())
                .and_then(|mass| self.effective_mass(mass)),
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
            "shortest relevant bending wavelength {}: {} elements",
            quantity(wave, "m"),
            digits(wave / element)
        );
        if verdict != Verdict::Fine {
            let shorter = quantity(round_down(wave / ELEMENTS[0]), "m");
            text += &format!(
                " (too few): estimated force error {} %; use elements of {shorter} or less near the struck point",
                if verdict == Verdict::Note { "up to 5" } else { "5 to 40" }
            );
        }
        self.finding(Topic::BendingWave, [wave, element], "m", verdict, text)
    }

    /// `lengthwise` is whether the impact has an axial part, `contact` the duration of the contact, if known.
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
                (Verdict::Fine, "the relevant waves of such a long contact are longer".to_owned())
            }
            (true, ..) => (Verdict::Fine, "the step resolves such waves".to_owned()),
            (false, false, false) => (
                Verdict::Fine,
                "such waves matter little in a compliant transverse impact".to_owned(),
            ),
            _ => {
                let better = quantity(round_down(transit), "s");
                let why = if lengthwise {
                    "the step does not resolve the stress waves of this impact"
                } else {
                    "the response after the first impact depends on waves that the step does not resolve"
                };
                (Verdict::Note, format!("{why}; set time.step to {better} or less"))
            }
        };
        let text = format!(
            "the step is {} times the transit time of a longitudinal wave through the shortest element, {}: {rest}",
            digits(ratio),
            quantity(transit, "s"),
        );
        Some(self.finding(Topic::WaveTransit, [transit, step], "s", verdict, text))
    }

    /// Limit of the force just after a rigid impact across the interior of a shear-flexible beam \[N\].
    fn force_after_impact(&self) -> Option<f64> {
        let Meeting::Struck(struck) = &self.case.meeting else { return None };
        let place = &struck.place;
        let inside = place.s > 0.0 && place.s < place.beam.length();
        let shear = place.shear_stiffness().filter(|_| inside && struck.across() > 0.999)?;
        Some(2.0 * struck.speed * (shear * place.section().mass).sqrt())
    }

    fn effective_mass(&self, mass: EffectiveMass) -> Option<Advice> {
        if !self.case.law.is_rigid() || mass.on_mesh.is_nan() {
            return None;
        }
        let (verdict, text) = if mass.on_mesh.is_infinite() {
            (Verdict::Fine, "the struck point is supported (infinite effective mass)".to_owned())
        } else {
            let here = quantity(mass.on_mesh, "kg");
            let limit = quantity(mass.limit, "kg");
            let text =
                format!("effective mass {here} on this mesh, tends to {limit} with refinement");
            if let Some(force) = self.force_after_impact() {
                // What rebounds has the impulse of the mesh; what stays has a force with a limit.
                let stays = matches!(self.case.law, TouchLaw::Rigid(law) if law.restitution == 0.0);
                let verdict = if stays { Verdict::Note } else { Verdict::Warning };
                let text = format!(
                    "{text}: impulses depend on the mesh; the force just after an impact does not and tends to {}, \
                     2 v sqrt(kappa G A rho A) of a shear-flexible beam",
                    quantity(force, "N")
                );
                (verdict, text)
            } else if mass.depends_on_mesh() {
                let mass = if self.case.guided.is_some() { "add a local_mass or " } else { "" };
                let text = format!(
                    "{text}: the impulse depends on the mesh; {mass}use a compliant contact"
                );
                (Verdict::Warning, text)
            } else {
                (Verdict::Fine, text)
            }
        };
        let values = [mass.on_mesh, mass.limit];
        Some(self.finding(Topic::EffectiveMass, values, "kg", verdict, text))
    }

    /// Largest penetration of a disc, if it is deep: a supported target taken as rigid and fixed, a free one as a rigid body.
    fn pressed(&self, struck: &Struck<'_>) -> Option<Advice> {
        let half_depth = struck.place.half_depth();
        let through = struck.radius? + if half_depth.is_nan() { 0.0 } else { half_depth };
        let held = Surroundings::of(self.model, struck.place.index).held;
        let target = if held { f64::INFINITY } else { struck.beam_mass() };
        let mass = reduced_mass([struck.mass, target]);
        let impact = rigid_impact(self.case.law, mass, struck.speed, 0.0)?;
        let pressed = PressedIn { penetration: impact.penetration, through, time: f64::NAN };
        if !pressed.is_deep() {
            return None;
        }
        let text = format!(
            "estimated penetration up to {}, and centre and axis meet at {}: location and direction of the force are unreliable at such \
             a depth; use a stiffer law",
            quantity(impact.penetration, "m"),
            quantity(through, "m")
        );
        let values = [impact.penetration, through];
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
        let chosen = rigid_impact(self.case.law, mass, struck.speed, 0.0)?;
        let hertz = super::formulas::hertz_impact(mass, constant, struck.speed);
        // The linear spring with the same peak force at this speed.
        let [value, reference] = [chosen, hertz].map(|b| b.peak_force.powi(2) / energy);
        if !(value.is_finite() && reference.is_finite()) {
            return None;
        }
        let whose = if struck.radius.is_some() { "its radius" } else { "the beam's half depth" };
        let ball = format!(
            "a Hertz contact of a rigid ball of {whose}, {}, with this beam (K = {} N/m^1.5)",
            quantity(radius, "m"),
            digits(constant)
        );
        let ratio = value / reference;
        let (verdict, text) = if ratio > STIFF {
            (
                Verdict::Note,
                format!(
                    "contact stiffness {} times that of {ball}, peak force up to {} times as large: use the Hertz law \
                     unless flat faces meet",
                    digits(ratio),
                    digits(ratio.sqrt())
                ),
            )
        } else {
            (Verdict::Fine, format!("contact stiffness {} times that of {ball}", digits(ratio)))
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
            let text = "the struck point is an end of the beam, is connected to another part or lies on a foundation, which affects the contact from its start";
            (Verdict::Fine, text.to_owned())
        } else if free >= least && !struck.place.is_uniform() {
            let text = format!(
                "bending waves return from the nearest end or support after {time}, later than the contact ({lasts}); curvature and changes \
                 of the section reflect waves earlier"
            );
            (Verdict::Fine, text)
        } else if free >= least {
            let text = format!(
                "bending waves return from the nearest end or support after {time}, later than the contact ({lasts}): no reflection during \
                 the contact (infinite beam)"
            );
            (Verdict::Fine, text)
        } else if back < WAVES * contact {
            let text = format!(
                "bending waves return from the nearest end or support after {time}, several times during the contact ({lasts}): the whole \
                 span responds"
            );
            (Verdict::Fine, text)
        } else {
            let text = format!(
                "bending waves return from the nearest end or support after {time}, during the contact ({lasts}): reflected waves affect \
                 the contact; an unaffected contact needs {needed} to the nearest end or support"
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
        let mut text =
            format!("relative vibration of the two masses: period {lasts}, {count} steps");
        if verdict != Verdict::Fine {
            let better = quantity(round_down(period / STEPS[0]), "s");
            text += &format!(": set time.step to {better} to resolve it");
        }
        let values = [period, self.settings.step];
        Some(self.finding(Topic::RearMass, values, "s", verdict, text))
    }
}
