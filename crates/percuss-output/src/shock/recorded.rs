//! Which accelerations a history has.

use crate::history::Channel;

/// An acceleration of a run, which follows from a velocity that was recorded.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Acceleration {
    /// Its name, `point.tip.acceleration_2`, or `point.tip.absolute_acceleration_2` in a run whose base is accelerated.
    pub name: String,
    /// Column of the velocity, `point.tip.velocity_2`.
    pub velocity: String,
    /// What it is of, `point.tip`.
    pub owner: String,
    /// Its axis, 1 or 2.
    pub axis: String,
    /// What it is relative to.
    pub frame: Frame,
}

/// What an acceleration is relative to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Frame {
    /// The ground, which is at rest.
    Rest,
    /// An accelerated base: it is not what an accelerometer measures.
    Base,
    /// The ground at rest, in a run whose base is accelerated.
    Absolute,
}

/// The accelerations of a history: those of recorded points and of projectiles, in the order of its columns.
pub fn accelerations(channels: &[Channel]) -> Vec<Acceleration> {
    let shaken = channels.iter().any(|channel| channel.name.contains(".absolute_velocity_"));
    let of = |channel: &Channel| {
        let absolute = channel.name.rsplit_once(".absolute_velocity_");
        let (frame, what, (owner, axis)) = match absolute {
            Some(parts) => (Frame::Absolute, "absolute_acceleration", parts),
            None => {
                let frame = if shaken { Frame::Base } else { Frame::Rest };
                (frame, "acceleration", channel.name.rsplit_once(".velocity_")?)
            }
        };
        (channel.unit == "m/s").then(|| Acceleration {
            name: format!("{owner}.{what}_{axis}"),
            velocity: channel.name.clone(),
            owner: owner.to_owned(),
            axis: axis.to_owned(),
            frame,
        })
    };
    channels.iter().filter_map(of).collect()
}

impl Acceleration {
    /// Why it is not what an oscillator on the point, or an accelerometer, sees, and what is; `None` if it is.
    pub fn misleads(&self) -> Option<String> {
        let Self { name, owner, axis, .. } = self;
        let instead = match owner.starts_with("point.") {
            true => format!("expected `{owner}.absolute_acceleration_{axis}`"),
            false => "record a point and use its absolute_acceleration".to_owned(),
        };
        let why = "is relative to the accelerated base, and an oscillator or an accelerometer responds to the absolute one";
        (self.frame == Frame::Base).then(|| format!("{name}: {why}; {instead}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn accelerations_say_what_they_are_relative_to() {
        let channel =
            |name: &str| Channel { name: name.into(), unit: "m/s".into(), ..Channel::default() };
        let still = [channel("point.tip.velocity_2")];
        let found = accelerations(&still);
        assert_eq!(
            (found[0].name.as_str(), found[0].frame),
            ("point.tip.acceleration_2", Frame::Rest)
        );
        assert_eq!(found[0].misleads(), None);
        let shaken = [channel("point.tip.velocity_2"), channel("point.tip.absolute_velocity_2")];
        let found = accelerations(&shaken);
        assert_eq!((found[0].frame, found[1].frame), (Frame::Base, Frame::Absolute));
        assert_eq!(found[1].name, "point.tip.absolute_acceleration_2");
        assert!(
            found[0]
                .misleads()
                .is_some_and(|why| why.contains("`point.tip.absolute_acceleration_2`"))
        );
        assert_eq!(found[1].misleads(), None);
    }
}
