//! Figures of the page, and their files.

use super::*;

#[test]
fn a_rigid_run_has_the_figures_of_the_paper() -> Outcome {
    let data = rigid()?;
    let dir = tempfile::tempdir()?;
    report::write_with_figures(dir.path(), &data)?;
    for name in
        ["overview", "displacement", "impulse", "velocity", "energy", "momentum", "restitution"]
    {
        for kind in ["svg", "png"] {
            let file = dir.path().join("figures").join(format!("{name}.{kind}"));
            assert!(fs::metadata(&file)?.len() > 1000, "{}", file.display());
        }
    }
    let page = fs::read_to_string(dir.path().join("report.html"))?;
    let index = index(&page)?;
    let figures = index["figures"].as_array().ok_or("no figures")?;
    let impulse = figures.iter().find(|f| f["id"] == "impulse").ok_or("no impulse figure")?;
    let stems = &impulse["tables"][0]["series"][0];
    assert_eq!(stems["shape"], "stem");
    let column = stems["y"].as_u64().ok_or("no column")? as usize;
    assert_eq!(index["columns"][column], json!([4, 250]), "the summary's impacts, nothing else");
    assert!(page.contains("250\u{a0}contacts in"), "one row of chatter");
    assert!(page.contains("and 210 more, in impacts.csv"), "250 impacts, 40 listed");
    assert!(page.contains("Mesh-dependent result"), "91.2 kg against 17.3 kg");
    Ok(())
}

#[test]
fn legends_name_the_point_that_the_summary_says_is_struck() -> Outcome {
    assert!(page(&rigid()?)?.contains("contact point girder.mid"));
    Ok(())
}

#[test]
fn several_projectiles_have_their_own_figures() -> Outcome {
    let mut data = rigid()?;
    let hammer = data.summary["contact"]["hammer"].clone();
    data.summary["contact"]["tongs/and:co"] = hammer;
    data.summary["projectile"]["tongs/and:co"] = data.summary["projectile"]["hammer"].clone();
    let history = memory(&mut data);
    let copies: Vec<(Channel, Vec<f64>)> = history
        .channels
        .iter()
        .zip(&history.columns)
        .filter(|(c, _)| c.name.contains("hammer"))
        .map(|(c, column)| {
            let name = c.name.replace("hammer", "tongs/and:co");
            (Channel { name, ..c.clone() }, column.clone())
        })
        .collect();
    for (channel, column) in copies {
        history.channels.push(channel);
        history.columns.push(column);
    }
    let dir = tempfile::tempdir()?;
    report::write_with_figures(dir.path(), &data)?;
    for name in ["displacement-hammer.svg", "displacement-tongs_and_co.svg", "impulse-hammer.png"] {
        assert!(dir.path().join("figures").join(name).is_file(), "{name}");
    }
    Ok(())
}

#[test]
fn closed_contact_is_a_band_and_never_a_stem() -> Outcome {
    let mut data = rigid()?;
    let contact = &mut data.summary["contact"]["hammer"];
    contact["intervals"] = json!([
        { "start": 0.001, "end": 0.002, "impulse": 1200.0 },
        { "start": 0.015, "end": null, "impulse": 800.5 },
    ]);
    contact["impact_count"] = json!(12_345);
    let page = page(&data)?;
    let index = index(&page)?;
    let figures = index["figures"].as_array().ok_or("no figures")?;
    let impulse = figures.iter().find(|f| f["id"] == "impulse").ok_or("no impulse figure")?;
    let band = &impulse["tables"][0]["series"][0];
    assert_eq!(band["shape"], "band");
    assert_eq!(band["label"], "closed contact, total 2000.5\u{a0}N\u{a0}s");
    let x = impulse["tables"][0]["x"].as_u64().ok_or("no column")? as usize;
    assert_eq!(index["columns"][x], json!([8, 4]), "two ends an interval");
    assert!(page.contains("First 250 of 12345 impacts shown."));
    Ok(())
}

#[test]
fn figures_left_out_are_named_with_the_reason() -> Outcome {
    let mut data = rigid()?;
    assert!(!page(&data)?.contains("No comparison of restitution coefficients"));
    data.comparison.clear();
    assert!(page(&data)?.contains("No comparison of restitution coefficients"));
    data.scenario = "[report]\nrestitution = []\n".to_owned();
    assert!(!page(&data)?.contains("No comparison of restitution coefficients"));
    data.summary["energy"]["residual_max"] = json!(1e-7);
    assert!(page(&data)?.contains("exceeds 1e-10"));
    data.scenario = "[projectile.hammer]\nforce = \"midpoint\"\n".to_owned();
    assert!(page(&data)?.contains("not conserved by the midpoint force"));
    assert!(page(&data)?.contains("Section forces</caption>"));
    Ok(())
}

/// A disc and a wall beside the projectile: gap, place and impulses of the contact, motion of the disc.
#[test]
fn contacts_between_free_things_have_their_figures() -> Outcome {
    let mut data = rigid()?;
    let mut contact = data.summary["contact"]["hammer"].clone();
    contact["between"] = json!(["girder", "ball"]);
    contact["impacts"][0]["tangential_impulse"] = json!(7.0);
    data.summary["contact"]["drop"] = contact;
    let history = memory(&mut data);
    let copy = history.column("contact.hammer.gap").ok_or("no gap")?.to_vec();
    for name in ["contact.drop.gap", "contact.drop.impulse", "contact.drop.place"] {
        let unit = "m".to_owned();
        history.channels.push(Channel { name: name.to_owned(), unit, ..Channel::default() });
        history.columns.push(copy.clone());
    }
    for what in ["position_1", "position_2", "velocity_1", "velocity_2", "angle", "spin"] {
        let name = format!("projectile.ball.{what}");
        history.channels.push(Channel { name, ..Channel::default() });
        history.columns.push(copy.clone());
    }
    let page = page(&data)?;
    let ids = figure_ids(&page)?;
    for id in ["gap-drop", "place-drop", "impulse-drop", "position-ball", "spin-ball"] {
        assert!(ids.iter().any(|i| i == id), "no {id} in {ids:?}");
    }
    assert!(!ids.iter().any(|i| i == "displacement-ball"), "a disc has no line of flight");
    assert!(page.contains("Contact drop: girder and ball"));
    let index = index(&page)?;
    let figures = index["figures"].as_array().ok_or("no figures")?;
    let impulse = figures.iter().find(|f| f["id"] == "impulse-drop").ok_or("no figure")?;
    assert_eq!(impulse["tables"][0]["series"][1]["label"], "friction impulse");
    assert!(
        page.contains("shown where the gap is below"),
        "closest points jump where bodies are far apart"
    );
    Ok(())
}

fn figure_ids(page: &str) -> Result<Vec<String>, RecorderError> {
    let index = index(page)?;
    let figures = index["figures"].as_array().ok_or("no figures")?;
    Ok(figures.iter().filter_map(|f| f["id"].as_str().map(str::to_owned)).collect())
}

#[test]
fn reactions_and_section_forces_have_figures_and_tables_with_signs() -> Outcome {
    let data = rigid()?;
    let dir = tempfile::tempdir()?;
    report::write_with_figures(dir.path(), &data)?;
    let page = fs::read_to_string(dir.path().join("report.html"))?;
    let ids = figure_ids(&page)?;
    for id in ["reaction-2", "reaction-moment", "section-shear", "section-moment"] {
        assert!(ids.iter().any(|i| i == id), "no {id} in {ids:?}");
        assert!(dir.path().join("figures").join(format!("{id}.svg")).is_file(), "{id}");
    }
    // Nothing but zeros, and a stress that no section has, are not worth a figure.
    assert!(!ids.iter().any(|i| i == "reaction-1" || i == "section-stress"), "{ids:?}");
    assert!(page.contains("Reactions (of the supports on the structure)</caption>"));
    assert!(page.contains("<td>-150\u{a0}kN</td>"), "a reaction that pulls keeps its sign");
    assert!(page.contains("not included in the force history)</caption>"));
    assert!(page.contains("<td>-12.5\u{a0}N\u{a0}s</td>"), "impulses of supports");
    assert!(page.contains("bending moment") && !page.contains("fibre stress"));
    Ok(())
}

#[test]
fn stresses_at_top_and_bottom_are_two_curves_of_one_figure() -> Outcome {
    for points in [1, 3] {
        let mut data = rigid()?;
        let history = memory(&mut data);
        let rows = history.columns[0].len();
        for (point, quantity) in
            (1..=points).flat_map(|k| ["stress", "stress_top", "stress_bottom"].map(|q| (k, q)))
        {
            let name = format!("section.p{point}.{quantity}");
            let description = String::new();
            history.channels.push(Channel { name, unit: "Pa".into(), description });
            let sign = if quantity == "stress_top" { -1e6 } else { 1e6 };
            history.columns.push((0..rows).map(|row| sign * (row % 7) as f64).collect());
        }
        let dir = tempfile::tempdir()?;
        report::write_with_figures(dir.path(), &data)?;
        let page = fs::read_to_string(dir.path().join("report.html"))?;
        let index = index(&page)?;
        let figures = index["figures"].as_array().ok_or("no figures")?;
        let id = |f: &Value| f["id"].as_str().is_some_and(|id| id.starts_with("section-stress"));
        let labels = figures.iter().filter(|f| id(f)).map(|f| {
            let series = f["tables"][0]["series"].as_array().into_iter().flatten();
            series.map(|s| s["label"].as_str().unwrap_or("").to_owned()).collect()
        });
        let labels: Vec<Vec<String>> = labels.collect();
        let of = |name: &str| ["top fibre", "bottom fibre"].map(|part| format!("{name}, {part}"));
        let expected = match points {
            1 => vec![vec!["top fibre".to_owned(), "bottom fibre".to_owned()]],
            _ => vec![[of("p1"), of("p2")].concat(), of("p3").to_vec()],
        };
        assert_eq!(labels, expected);
    }
    Ok(())
}

#[test]
fn envelopes_are_drawn_for_one_beam_and_for_many() -> Outcome {
    let mut data = rigid()?;
    let one = page(&data)?;
    let count = |page: &str| {
        Ok::<_, RecorderError>(
            figure_ids(page)?.iter().filter(|i| i.starts_with("envelope-")).count(),
        )
    };
    assert_eq!(count(&one)?, 3, "axial, shear and moment; no stress without a depth");
    assert!(one.contains("Bending moment of girder"));
    data.envelopes = (0..20).map(|k| envelope(&format!("beam {k}"), f64::from(1 + k))).collect();
    let dir = tempfile::tempdir()?;
    report::write_with_figures(dir.path(), &data)?;
    for name in ["envelope-axial-force.png", "envelope-bending-moment.svg"] {
        assert!(dir.path().join("figures").join(name).is_file(), "{name}");
    }
    let many = fs::read_to_string(dir.path().join("report.html"))?;
    assert_eq!(count(&many)?, 3 * 12, "the most loaded ones");
    assert!(many.contains("the 12 of 20 beams with the largest values"));
    let ids = figure_ids(&many)?;
    assert!(ids.iter().any(|i| i == "envelope-moment-beam 19"));
    assert!(!ids.iter().any(|i| i == "envelope-moment-beam 7"));
    let index = index(&many)?;
    let figures = index["figures"].as_array().ok_or("no figures")?;
    let ranges: Vec<&Value> = figures
        .iter()
        .filter(|f| f["id"].as_str().is_some_and(|i| i.starts_with("envelope-moment")))
        .map(|f| &f["range"])
        .collect();
    assert!(ranges.windows(2).all(|pair| pair[0] == pair[1]), "one scale a quantity");
    Ok(())
}
