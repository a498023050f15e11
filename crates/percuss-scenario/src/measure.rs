//! The measures of the format: what dimension each value must have and what it is called.

use crate::units::Dimension;

/// What a value measures.
pub(crate) trait Measure: 'static {
    /// Its dimension.
    const DIMENSION: Dimension;
    /// Its name, with the article.
    const NAME: &'static str;
    /// Its SI unit; empty for a pure number.
    const UNIT: &'static str;
    /// An example as it stands in a file.
    const EXAMPLE: &'static str;
    /// Whether the radian may be left out of its unit.
    const ANGLE_IMPLIED: bool;
    /// Units of the same dimension that mean something else.
    const REFUSED: &'static [&'static str];
}

/// Declares the measures, and the list that names a dimension in messages.
macro_rules! measures {
    ($($name:ident = ($m:literal, $kg:literal, $s:literal $(, rad $rad:literal)? $(, implied $implied:literal)? $(, kelvin $kelvin:literal)?)
        $about:literal, $unit:literal, $example:literal $(, not [$($refused:literal),*])?;)*) => {
        $(
            #[doc = $about]
            pub(crate) struct $name;

            impl Measure for $name {
                const DIMENSION: Dimension =
                    Dimension::halves($m as f64, $kg as f64, $s as f64)$(.with_radian($rad))?$(.with_kelvin($kelvin))?;
                const ANGLE_IMPLIED: bool = false $(|| $implied)?;
                const NAME: &'static str = $about;
                const UNIT: &'static str = $unit;
                const EXAMPLE: &'static str = $example;
                const REFUSED: &'static [&'static str] = &[$($($refused),*)?];
            }
        )*

        const KNOWN: &[(Dimension, &str, &str)] =
            &[$(($name::DIMENSION, $about, $unit),)*];
    };
}

measures! {
    Ratio = (0, 0, 0) "a pure number", "", "0.8";
    Poisson = (0, 0, 0) "a pure number", "", "0.3";
    Length = (1, 0, 0) "a length", "m", "\"3 m\"";
    Area = (2, 0, 0) "an area", "m^2", "\"1e3 cm^2\"";
    Inertia = (4, 0, 0) "a second moment of area", "m^4", "\"8330 cm^4\"";
    Mass = (0, 1, 0) "a mass", "kg", "\"500 kg\"";
    Time = (0, 0, 1) "a time", "s", "\"0.15 s\"";
    Velocity = (1, 0, -1) "a velocity", "m/s", "\"20 m/s\"";
    Acceleration = (1, 0, -2) "an acceleration", "m/s^2", "\"-9.81 m/s^2\"";
    Density = (-3, 1, 0) "a density", "kg/m^3", "\"3000 kg/m^3\"";
    Pressure = (-1, 1, -2) "a pressure", "Pa", "\"0.2e10 Pa\"";
    Force = (1, 1, -2) "a force", "N", "\"5 kN\"";
    Moment = (2, 1, -2) "a moment", "N*m", "\"80 N*m\"";
    Stiffness = (0, 1, -2) "a stiffness", "N/m", "\"7.5e5 N/m\"";
    HertzStiffness = (-0.5, 1, -2) "a Hertz stiffness", "N/m^1.5", "\"5e8 N/m^1.5\"";
    Dissipation = (-1, 0, 1) "a dissipation factor", "s/m", "\"0.2 s/m\"";
    Angle = (0, 0, 0, rad 1, implied true) "an angle", "rad", "\"30 deg\"";
    Frequency = (0, 0, -1) "a frequency", "Hz", "\"50 Hz\"";
    Spin = (0, 0, -1, rad 1) "an angular velocity", "rad/s", "\"90 deg/s\"";
    Rate = (0, 0, -1) "a rate", "1/s", "\"0.5 1/s\"", not ["Hz"];
    Damping = (0, 1, -1) "a damping constant", "N*s/m", "\"200 N*s/m\"";
    TurnStiffness = (2, 1, -2, rad -1, implied true) "a rotational stiffness", "N*m", "\"5 kN*m/rad\"";
    TurnDamping = (2, 1, -1, rad -1, implied true) "a rotational damping constant", "N*m*s", "\"20 N*m*s\"";
    MassInertia = (2, 1, 0) "a mass moment of inertia", "kg*m^2", "\"2 kg*m^2\"";
    LineForce = (0, 1, -2) "a force per length", "N/m", "\"5 kN/m\"";
    LineStiffness = (-1, 1, -2) "a stiffness per length", "N/m^2", "\"20 MN/m^2\"";
    LineDamping = (-1, 1, -1) "a damping constant per length", "N*s/m^2", "\"5 kN*s/m^2\"";
    Temperature = (0, 0, 0, kelvin 1) "a difference of temperatures", "K", "\"60 K\"";
    TemperatureGradient = (-1, 0, 0, kelvin 1) "a temperature gradient", "K/m", "\"200 K/m\"";
    Expansion = (0, 0, 0, kelvin -1) "a thermal expansion", "1/K", "\"12e-6 1/K\"";
    TurnPerLength = (-1, 0, 0) "a curvature", "1/m", "\"0.01 1/m\"";
    LineInertia = (1, 1, 0) "a rotary inertia per length", "kg*m", "\"10 kg*m\"";
}

/// Dimensions no key of the format has, which people write nevertheless.
const OTHERS: &[(Dimension, &str, &str)] = &[
    (Dimension::new(3, 0, 0), "a volume", "m^3"),
    (Dimension::new(2, 1, -3), "a power", "W"),
    (Dimension::new(1, 1, -1), "an impulse", "N*s"),
    (Dimension::new(-1, 1, 0), "a mass per length", "kg/m"),
    (Dimension::new(-2, 1, 0), "a mass per area", "kg/m^2"),
    (Dimension::new(3, 1, -2), "a bending stiffness", "N*m^2"),
];

/// Whether a quantity of some dimension can be what `M` measures.
pub(crate) fn fits<M: Measure>(dimension: Dimension) -> bool {
    let implied = M::ANGLE_IMPLIED && dimension == M::DIMENSION.without_angle();
    dimension == M::DIMENSION || implied
}

/// `an area (m^2)`; a dimension without a name by its unit.
pub(crate) fn name(dimension: Dimension) -> String {
    match KNOWN.iter().chain(OTHERS).find(|known| known.0 == dimension) {
        Some((_, name, "")) => (*name).to_string(),
        Some((_, name, unit)) => format!("{name} ({unit})"),
        None => format!("a quantity in {dimension}"),
    }
}
