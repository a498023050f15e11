//! `impacts.csv`.

use crate::synthetic;

use std::error::Error;

use percuss::{
    ContactInterval, ContactRecord, ContactSummary, EnergySplit, Peak, StopTouch, SupportSummary,
};
use percuss_output::write_impacts;

fn contact(name: &str, record: ContactRecord) -> ContactSummary {
    let between = ["girder".to_owned(), format!("{name}, the \"second\"")];
    ContactSummary {
        name: name.to_owned(),
        between,
        effective_mass: None,
        permanent_penetration: None,
        carried_crush: None,
        pressed_in: None,
        sliding: None,
        equivalent_force: None,
        no_equivalent_force: None,
        record,
    }
}

/// Fields with their columns.
type Row = Vec<(String, String)>;

/// The rows of the file.
fn written(contacts: &[ContactSummary]) -> Result<Vec<Row>, Box<dyn Error>> {
    written_with(contacts, &[])
}

fn written_with(
    contacts: &[ContactSummary],
    supports: &[SupportSummary],
) -> Result<Vec<Row>, Box<dyn Error>> {
    let dir = tempfile::tempdir()?;
    write_impacts(dir.path(), contacts, supports)?;
    let text = std::fs::read_to_string(dir.path().join("impacts.csv"))?;
    let mut lines = text.lines();
    let header: Vec<&str> = lines.next().ok_or("no header")?.split(',').collect();
    let row = |line: &str| {
        // Names with commas come quoted; here only the second partner's is.
        let Some((before, quoted)) = line.split_once('"') else {
            let fields = line.split(',').map(str::to_owned);
            return header.iter().map(|h| (*h).to_owned()).zip(fields).collect();
        };
        let (name, after) = quoted.rsplit_once('"').unwrap_or(("", ""));
        let mut fields: Vec<String> = before.split(',').map(str::to_owned).collect();
        fields.pop();
        fields.push(name.to_owned());
        fields.extend(after.split(',').skip(1).map(str::to_owned));
        assert_eq!(fields.len(), header.len(), "{line}");
        header.iter().map(|h| (*h).to_owned()).zip(fields).collect()
    };
    Ok(lines.map(row).collect())
}

fn field<'a>(row: &'a [(String, String)], column: &str) -> &'a str {
    row.iter().find(|(name, _)| name == column).map_or("no such column", |(_, value)| value)
}

#[test]
fn forces_and_impulses_never_share_a_column() -> Result<(), Box<dyn Error>> {
    let contacts = [contact("mass", synthetic::smooth()), contact("hammer", synthetic::impacts(3))];
    let rows = written(&contacts)?;
    assert_eq!(rows.len(), 4);
    for row in &rows {
        let (force, impulse) = (field(row, "force_peak_N"), field(row, "impulse_N_s"));
        assert!(impulse.parse::<f64>().is_ok());
        match field(row, "kind") {
            "impact" => assert_eq!(force, "", "no force is made up from an impulse"),
            _ => assert!((force.parse::<f64>()? / 337_784.605 - 1.0).abs() < 1e-12),
        }
    }
    Ok(())
}

#[test]
fn rows_come_in_the_order_of_time_and_say_where_and_with_what_energies()
-> Result<(), Box<dyn Error>> {
    let contacts = [contact("mass", synthetic::smooth()), contact("hammer", synthetic::impacts(2))];
    let rows = written(&contacts)?;
    let times: Vec<f64> = rows.iter().filter_map(|r| field(r, "start_s").parse().ok()).collect();
    assert_eq!(times.len(), 3);
    assert!(times.is_sorted());
    let last = &rows[2];
    assert_eq!(field(last, "second"), "mass, the \"\"second\"\"");
    assert_eq!(field(last, "end_s"), "", "still closed");
    assert_eq!(field(last, "separation_m_per_s"), "");
    for (column, value) in
        [("place_m", 1.5), ("x_m", 1.5), ("given_to_first_J", 8000.0), ("lost_J", 50.0)]
    {
        assert_eq!(field(last, column).parse::<f64>()?, value, "{column}");
    }
    assert_eq!(field(&rows[0], "restitution").parse::<f64>()?, 1.0);
    assert_eq!(field(&rows[0], "fallback_law"), "false");
    Ok(())
}

/// Persistent contact of rigid bodies has an impulse and no force.
#[test]
fn columns_that_do_not_apply_are_empty() -> Result<(), Box<dyn Error>> {
    let interval = ContactInterval {
        start: 0.1,
        end: 0.2,
        impulse: 3.0,
        tangential_impulse: -0.5,
        peak_force: Peak::default(),
        approach_velocity: 0.0,
        separation_velocity: 0.0,
        steps: 7,
        steady: true,
        one_point: true,
        torn: false,
        place: Default::default(),
        place_end: Default::default(),
        energy: EnergySplit::default(),
    };
    let record = ContactRecord::Nonsmooth {
        impacts: Vec::new(),
        impact_count: 0,
        fallback_count: 0,
        impulse_total: 3.0,
        impulse_resting: 3.0,
        intervals: vec![interval],
        penetration: Peak::default(),
    };
    let rows = written(&[contact("rest", record)])?;
    for column in
        ["force_peak_N", "force_peak_time_s", "restitution", "place_m", "x_m", "fallback_law"]
    {
        assert_eq!(field(&rows[0], column), "", "{column}");
    }
    assert_eq!(field(&rows[0], "friction_impulse_N_s"), "-0.5");
    assert_eq!(field(&rows[0], "no_restitution"), "persistent contact");
    assert_eq!([field(&rows[0], "points"), field(&rows[0], "steps")], ["", "7"]);
    Ok(())
}

/// A coefficient of restitution that the step does not resolve is left out, with the reason.
#[test]
fn unresolved_quantities_have_a_reason_instead_of_a_number() -> Result<(), Box<dyn Error>> {
    let ContactRecord::Smooth { peak_force, intervals } = synthetic::smooth() else { panic!() };
    let closed = ContactInterval { end: 0.02, separation_velocity: 2.35, ..intervals[0] };
    for (steps, steady, separation, found, why) in [
        (2, true, 2.35, "", "not resolved: 2 steps in contact"),
        (
            9,
            false,
            2.35,
            "",
            "not resolved: the gap's velocity changes by more than itself in a step",
        ),
        (9, true, 0.5 * closed.approach_velocity, "0.5", ""),
    ] {
        let interval = ContactInterval { steps, steady, separation_velocity: separation, ..closed };
        let record = ContactRecord::Smooth { peak_force, intervals: vec![interval] };
        let contact = contact("mass", record);
        let rows = written(std::slice::from_ref(&contact))?;
        assert_eq!(
            [field(&rows[0], "restitution"), field(&rows[0], "no_restitution")],
            [found, why]
        );
    }
    Ok(())
}

#[test]
fn touches_of_stops_stand_among_the_contacts() -> Result<(), Box<dyn Error>> {
    let peak_force = Peak { value: 900.0, time: 1e-3 };
    let touch = StopTouch { start: 5e-4, end: Some(2e-3), impulse: 0.7, peak_force };
    let still = StopTouch { start: 9e9, end: None, ..touch };
    let stop =
        SupportSummary { touches: Some(vec![touch, still]), ..synthetic::support("bracket", 1.0) };
    let rows = written_with(
        &[contact("mass", synthetic::smooth())],
        &[stop, synthetic::support("root", 1.0)],
    )?;
    let of_stop: Vec<&Row> = rows.iter().filter(|r| field(r, "kind") == "stop").collect();
    assert_eq!(of_stop.len(), 2);
    assert_eq!(field(of_stop[0], "contact"), "bracket");
    let reported =
        ["start_s", "end_s", "impulse_N_s", "force_peak_N"].map(|c| field(of_stop[0], c));
    assert_eq!(reported, ["0.0005", "0.002", "0.7", "900.0"]);
    assert_eq!((field(of_stop[1], "end_s"), field(of_stop[1], "restitution")), ("", ""));
    let starts: Vec<f64> = rows.iter().filter_map(|r| field(r, "start_s").parse().ok()).collect();
    assert!(starts.is_sorted());
    Ok(())
}
