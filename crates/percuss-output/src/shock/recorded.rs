//! Which accelerations a history has.

use crate::history::Channel;

/// An acceleration of a run, which follows from a velocity that was recorded.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Acceleration {
    /// Its name, `point.tip.acceleration_2`.
    pub name: String,
    /// Column of the velocity, `point.tip.velocity_2`.
    pub velocity: String,
}

/// The accelerations of a history: those of recorded points and of projectiles, in the order of its columns.
pub fn accelerations(channels: &[Channel]) -> Vec<Acceleration> {
    let of = |channel: &Channel| {
        let (owner, axis) = channel.name.rsplit_once(".velocity_")?;
        let name = format!("{owner}.acceleration_{axis}");
        (channel.unit == "m/s").then(|| Acceleration { name, velocity: channel.name.clone() })
    };
    channels.iter().filter_map(of).collect()
}
