//! Numbers that a contact, stop, spring or foundation which is still closed at the end of a run leaves open.

use percuss::{ContactRecord, PulseOf, RunSummary};

use super::{SummaryPath, pick};

impl SummaryPath {
    /// Whether a contact that is still closed at the end of a run leaves this number open: duration, force and impulse of the contact, velocity
    /// of what it touches; likewise forces of stops, springs and foundations.
    pub fn may_stay_open(&self) -> bool {
        let keys: Vec<&str> = self.keys.iter().map(String::as_str).collect();
        self.is_bearing_force()
            || matches!(
                (self.part.as_str(), &keys[..]),
                ("contact", ["duration"] | ["peak_force", "value"])
                    | ("contact", ["intervals", _, "end" | "impulse" | "separation_velocity"])
                    | ("contact", ["intervals", _, "peak_force", "value"])
                    | ("projectile", ["velocity_final", _] | ["spin_final"])
                    | (
                        "projectile",
                        ["momentum_transferred"] | ["energy_given" | "energy_received_by_others"]
                    )
            )
    }

    /// Whether it is a largest force, or a reaction per length, of a support, spring or foundation.
    fn is_bearing_force(&self) -> bool {
        let keys: Vec<&str> = self.keys.iter().map(String::as_str).collect();
        matches!(
            (self.part.as_str(), &keys[..]),
            ("support" | "foundation", ["force_1" | "force_2", "min" | "max", "value"])
                | ("foundation", ["pressure_max", "value"] | ["pressure", "min" | "max", "value"])
                | ("support", ["intervals", _, "peak_force", "value"])
                | ("yielding", ["force_max", "value"])
        )
    }

    /// The value of a largest force that was reached while its stop, spring or foundation was last closed, if it may still grow.
    fn bearing_value(&self, run: &RunSummary) -> f64 {
        let own = |of: &PulseOf| match of {
            PulseOf::Stop(name) => self.part == "support" && *name == self.name,
            PulseOf::Foundation(name) => self.part == "foundation" && *name == self.name,
            PulseOf::Spring(name) => {
                self.part == "yielding" && self.name == format!("spring.{name}")
            }
            PulseOf::Contact(_) => false,
        };
        let Some((_, since)) = run.still_rising().find(|(of, _)| own(of)) else { return f64::NAN };
        let time = self.beside("time");
        let [value, time] = [self, &time].map(|path| pick(std::slice::from_ref(path), run)[0]);
        if time >= since && value != 0.0 { value } else { f64::NAN }
    }

    /// Whether the number can only grow while a contact stays closed: what it is at the end of the run is its least value.
    pub fn only_grows(&self) -> bool {
        let last = self.keys.last().is_some_and(|key| key != "separation_velocity");
        self.part == "contact" && self.may_stay_open() && last
    }

    /// What the number has come to at the end of a run in which a contact that is still closed leaves it open: of a duration the time
    /// since it closed, of a force the largest so far, see [`percuss::ContactSummary::cut_short`]; NaN where the number is settled.
    pub fn open_value(&self, run: &RunSummary) -> f64 {
        if !self.may_stay_open() {
            return f64::NAN;
        }
        if self.is_bearing_force() {
            return self.bearing_value(run);
        }
        let own = || pick(std::slice::from_ref(self), run)[0];
        if self.part == "projectile" {
            return if run.still_touches(&self.name).next().is_some() { own() } else { f64::NAN };
        }
        let Some(contact) = run.contacts.iter().find(|one| one.name == self.name) else {
            return f64::NAN;
        };
        if contact.closed_since().is_none() {
            return f64::NAN;
        }
        let cut = contact.cut_short().map(|last| last.start);
        let keys: Vec<&str> = self.keys.iter().map(String::as_str).collect();
        let interval = |k: &str| {
            let at = contact.record.intervals().get(k.parse::<usize>().ok()?)?;
            at.end.is_nan().then_some(at)
        };
        let found = match &keys[..] {
            ["duration"] => interval("0").map(|one| run.time - one.start),
            ["peak_force", "value"] => match &contact.record {
                ContactRecord::Smooth { .. } => cut.map(|_| own()),
                ContactRecord::Nonsmooth { .. } => None,
            },
            ["intervals", k, "end"] => interval(k).map(|_| run.time),
            ["intervals", k, "peak_force", "value"] => {
                interval(k).filter(|one| cut == Some(one.start)).map(|_| own())
            }
            ["intervals", k, ..] => interval(k).map(|_| own()),
            _ => None,
        };
        found.unwrap_or(f64::NAN)
    }
}
