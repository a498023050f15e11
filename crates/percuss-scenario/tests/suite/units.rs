//! Quantities with units.

use percuss_scenario::units::{Dimension, parse};

fn value(text: &str) -> f64 {
    parse(text).unwrap_or_else(|e| panic!("{text}: {e:?}")).value
}

fn dimension(text: &str) -> String {
    parse(text).unwrap_or_else(|e| panic!("{text}: {e:?}")).dimension.to_string()
}

fn fault(text: &str) -> (String, String, String) {
    let fault = parse(text).expect_err(text);
    (text[fault.span].to_string(), fault.found, fault.expected)
}

#[test]
fn quantities_of_the_paper_have_the_bits_of_their_si_values() {
    assert_eq!(value("7.5e5 N/m"), 7.5e5);
    assert_eq!(value("1000 cm^2"), 0.1);
    assert_eq!(value("1e3 cm^2"), 0.1);
    assert_eq!(value("8330 cm^4"), 8.33e-5);
    assert_eq!(value("0.2e10 Pa"), 2e9);
    assert_eq!(value("20 cm"), 0.2);
    assert_eq!(value("3000 kg/m^3"), 3000.0);
}

#[test]
fn one_unit_may_be_written_in_many_ways() {
    for text in ["5 N*m", "5 N m", "5 N.m", "5 N·m", "5Nm", "5 (N)(m)", "5 kg m2/s2", "5 kg*m²*s⁻²"]
    {
        assert_eq!(value(text), 5.0, "{text}");
        assert_eq!(parse(text).unwrap().dimension, Dimension::new(2, 1, -2), "{text}");
    }
    for text in ["2 cm^4", "2 cm4", "2 cm⁴", " 2cm^4 ", "2 cm^(4)", "+2.0e0 cm^4"] {
        assert_eq!(value(text), 2e-8, "{text}");
    }
    assert_eq!(value("3 N/(mm s)"), 3000.0);
    assert_eq!(value("3 s^-1"), value("3 1/s"));
    assert_eq!(value("3 /s"), value("3 Hz"));
    assert_eq!(value("3 1 / s"), value("3 (1/s)"));
    assert_eq!(value("1_000.5 m"), 1000.5);
    assert_eq!(value("−5 m"), -5.0);
}

#[test]
fn every_unit_has_its_factor() {
    let close = |text: &str, si: f64| {
        assert!((value(text) - si).abs() <= 1e-14 * si.abs(), "{text}: {} {si}", value(text));
    };
    close("36 km/h", 10.0);
    close("180 deg", std::f64::consts::PI);
    close("60 rpm", 2.0 * std::f64::consts::PI);
    close("1 min", 60.0);
    close("5 ms", 5e-3);
    close("20 µs", 2e-5);
    close("20 us", 2e-5);
    close("2 t", 2000.0);
    close("60 K", 60.0);
    close("12e-6 1/K", 12e-6);
    close("1 bar", 1e5);
    close("1 ft", 12.0 * 0.0254);
    close("1 kip", 1000.0 * 4.4482216152605);
    close("1 ksi", 6894757.293168361);
    close("1 lbf", 0.45359237 * 9.80665);
    close("1 psi", 4.4482216152605 / (0.0254 * 0.0254));
    close("3 lb/in^3", 3.0 * 0.45359237 / 0.0254f64.powi(3));
    close("210 GPa", 2.1e11);
    close("2 kW", 2000.0);
    close("4 MN/m", 4e6);
    close("1 g", 1e-3);
    close("5 daN", 50.0);
    close("1 kp", 9.80665);
    close("2 kgf/cm^2", 2.0 * 98066.5);
    close("1 tf", 9806.65);
    close("1 dyn", 1e-5);
    close("1 atm", 101325.0);
    close("1 Msi", 1000.0 * 6894757.293168361);
    close("1 psf", 6894.757293168361 / 144.0);
    close("1 ksf", 6894757.293168361 / 144.0);
    close("1 plf", 4.4482216152605 / 0.3048);
    close("1 pli", 4.4482216152605 / 0.0254);
    close("1 klf", 4448.2216152605 / 0.3048);
    close("1 pcf", 0.45359237 / 0.3048f64.powi(3));
    close("1 pci", 0.45359237 / 0.0254f64.powi(3));
    close("1 slug", 0.45359237 * 9.80665 / 0.3048);
    close("60 mph", 26.8224);
    close("1 yd", 0.9144);
    close("2 rev/s", 4.0 * std::f64::consts::PI);
    close("5 %", 0.05);
}

#[test]
fn dimensions_print_as_coherent_units() {
    assert_eq!(dimension("1 m^2"), "m^2");
    assert_eq!(dimension("1 N"), "kg*m/s^2");
    assert_eq!(dimension("1 Pa"), "kg/(m*s^2)");
    assert_eq!(dimension("1 Hz"), "1/s");
    assert_eq!(dimension("1 rad"), "rad");
    assert_eq!(dimension("1 rpm"), "rad/s");
    assert_eq!(dimension("7"), "1");
}

#[test]
fn exponents_may_be_halves() {
    for text in ["5e8 N/m^1.5", "5e8 N m^-1.5", "5e8 N/(m m^0.5)", "5e8 (N^2/m^3)^0.5"] {
        assert_eq!((value(text), dimension(text)), (5e8, "kg/(m^0.5*s^2)".into()), "{text}");
    }
    let relative = value("1 N/mm^1.5") / 10f64.powf(4.5) - 1.0;
    assert!(relative.abs() < 1e-15, "{relative:e}");
    assert_eq!(value("2 cm^0.5 cm^1.5"), 2.0 * value("1 cm^2"));
}

#[test]
fn unknown_units_are_marked_and_come_with_a_suggestion() {
    for (text, token, near) in [
        ("5 Kg", "Kg", "`kg`"),
        ("5 kg/M^3", "M", "`m`"),
        ("5 Newton", "Newton", "`N`"),
        ("5 meters", "meters", "`m`"),
        ("5 pa", "pa", "`Pa`"),
        ("5 KN/m", "KN", "`kN`"),
        ("5 sec", "sec", "`s`"),
        ("5 inch", "inch", "`in`"),
        ("5 mpa", "mpa", "`MPa` or `mPa`"),
        ("5 kilonewtons", "kilonewtons", "`kN`"),
        ("5 newtn", "newtn", "`N`"),
        ("5 degrees", "degrees", "`deg`"),
        ("5 mps", "mps", "`m/s`"),
        ("5 degC", "degC", "`K`"),
        ("5 °C", "°C", "`K`"),
        ("5 ton", "ton", "`t` (1000 kg), or 2000 lb"),
    ] {
        let (span, found, expected) = fault(text);
        assert_eq!(span, token);
        assert_eq!(found, format!("the unknown unit `{token}`"));
        assert!(expected.contains(near), "{text}: {expected}");
    }
    assert!(!fault("5 parsec").2.contains("did you mean"));
}

#[test]
fn no_suggestion_differs_from_what_was_written_by_a_power_of_ten_or_a_system() {
    // Each of these is a unit of somebody's; their neighbours in spelling are units of another size.
    for text in ["kpa2", "dan", "ozf", "kn2", "kips", "psia", "gal", "pond", "mN2", "tonf", "mil"] {
        let Err(fault) = parse(&format!("5 {text}")) else { continue };
        let Some((_, suggestion)) = fault.expected.split_once("did you mean `") else { continue };
        let suggestion = suggestion.split('`').next().unwrap();
        assert_eq!(suggestion.to_lowercase(), text.trim_end_matches(char::is_numeric), "{text}");
    }
    assert!(!fault("5 ozf").2.contains("did you mean"));
    assert!(!fault("5 psia").2.contains("did you mean"));
}

#[test]
fn values_beyond_the_range_of_numbers_are_refused() {
    for text in ["1e400 m", "-1e400 m", "1e308 km", "1e99999999999999999999 m", "1e-400 m"] {
        assert_eq!(fault(text).0, text);
    }
    assert_eq!(value("1e309 mm"), 1e306);
    assert_eq!(value("0e400 m"), 0.0);
}

#[test]
fn texts_that_are_no_quantities_say_why() {
    for (text, part) in [
        ("", "does not begin with a number"),
        ("m", "does not begin with a number"),
        ("inf m", "does not begin with a number"),
        ("nan", "does not begin with a number"),
        ("1,5 m", "a comma"),
        ("5 m/s kg", "a factor after a quotient"),
        ("5 N/m*s", "a factor after a quotient"),
        ("5 *m", "before the unit"),
        ("5 m*", "no unit before it"),
        ("5 (m", "open bracket"),
        ("5 m)", "no unit to its left"),
        ("5 m^99", "exponent"),
        ("5 m^", "exponent"),
        ("5 m^1.25", "no unit before it"),
        ("5 (m^0.5)^0.5", "of a square root"),
        ("5 m^13.5", "exponent"),
        ("5 12/s", "second number"),
        ("8 1 N", "second number"),
        ("8 N 1/s", "second number"),
        ("8 1", "second number"),
        ("5 3", "no unit before it"),
        ("5 m ((((((((((m", "too many brackets"),
    ] {
        let found = fault(text).1;
        assert!(found.contains(part), "{text}: {found}");
    }
}
