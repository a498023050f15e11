//! The page and the pictures.

use crate::synthetic;

use std::error::Error;
use std::fs;

use percuss::{MemoryRecorder, RecorderError, Settings};
use percuss_output::report::{self, ReportData};
use percuss_output::{
    BeamEnvelope, Channel, ComparisonSeries, History, HistoryFormat, HistorySource, HistoryWriter,
    RunInfo, read_comparison, read_envelopes, summary_value, write_comparison, write_envelopes,
    write_summary,
};
use serde_json::{Value, json};

type Outcome = Result<(), RecorderError>;

fn rigid() -> Result<ReportData, RecorderError> {
    let mut recorder = MemoryRecorder::default();
    synthetic::rigid(&mut recorder, "hammer", 300, 1.0)?;
    let history = History::from(&recorder);
    let comparison =
        ComparisonSeries::from_history("restitution 1", &history).into_iter().collect();
    let run = synthetic::summary("hammer", synthetic::impacts(250));
    let settings = Settings::new(0.02, 1e-5);
    let (advice, comparisons) = (synthetic::advice("hammer"), synthetic::comparisons("hammer"));
    let info = RunInfo {
        title: "Hammer",
        settings: &settings,
        wall_seconds: 0.1,
        advice: &advice,
        warnings: &[],
        comparisons: &comparisons,
    };
    let summary = summary_value(&run, info);
    let envelopes = vec![envelope("girder", 1.0)];
    let scenario = "[beam]\n".to_owned();
    Ok(ReportData {
        history: history.into(),
        summary,
        scenario,
        comparison,
        envelopes,
        fields: None,
    })
}

fn envelope(name: &str, size: f64) -> BeamEnvelope {
    let envelope = synthetic::section_forces(name, size).envelope;
    BeamEnvelope { name: name.to_owned(), envelope }
}

/// The history of data that are in memory.
fn memory(data: &mut ReportData) -> &mut History {
    if !matches!(data.history, HistorySource::Memory(_)) {
        data.history = HistorySource::default();
    }
    match &mut data.history {
        HistorySource::Memory(history) => history,
        HistorySource::File(_) => unreachable!("just replaced"),
    }
}

fn page(data: &ReportData) -> Result<String, Box<dyn Error + Send + Sync>> {
    let dir = tempfile::tempdir()?;
    report::write(dir.path(), data)?;
    Ok(fs::read_to_string(dir.path().join("report.html"))?)
}

/// The JSON index embedded in a page.
fn index(page: &str) -> Result<Value, RecorderError> {
    let start = page.find("id=\"percuss-index\">").ok_or("no index")? + 19;
    let end = page[start..].find("</script>").ok_or("no end")? + start;
    Ok(serde_json::from_str(&page[start..end])?)
}

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
fn the_page_is_self_contained() -> Outcome {
    let page = page(&rigid()?)?;
    for outside in ["src=\"http", "href=\"http", "@import", "url(http", "<link rel=\"stylesheet"] {
        assert!(!page.contains(outside), "{outside}");
    }
    assert!(!page.contains("{{"), "a hole of the template is left");
    Ok(())
}

#[test]
fn text_of_users_stays_text() -> Outcome {
    let evil = "</script><script>alert(1)</script><img src=x onerror=alert(2)>{{data}}";
    let mut data = rigid()?;
    data.summary["title"] = json!(evil);
    data.summary["error"] = json!(evil);
    data.summary["settings"]["scheme"] = json!(evil);
    data.summary["status"] = json!(evil);
    for (part, name) in [
        ("projectile", "hammer"),
        ("contact", "hammer"),
        ("point", "girder.mid"),
        ("support", "left"),
        ("section_forces", "girder"),
    ] {
        data.summary[part] = json!({ evil: data.summary[part][name].clone() });
    }
    data.summary["contact"][evil]["between"] = json!([evil, evil]);
    for key in ["contact", "topic", "verdict", "unit", "text"] {
        data.summary["advice"][0][key] = json!(evil);
    }
    for key in ["contact", "formula", "source", "quantity", "unit", "holds_if"] {
        data.summary["hand_formulas"][0][key] = json!(evil);
    }
    data.envelopes = vec![envelope(evil, 1.0), envelope(evil, 2.0), envelope("c", 3.0)];
    data.scenario = evil.to_owned();
    data.comparison[0].label = evil.to_owned();
    memory(&mut data).source = evil.to_owned();
    for channel in &mut memory(&mut data).channels {
        let name = channel.name.replace("hammer", evil).replace("girder.mid", evil);
        channel.name = name.replace("left", evil);
    }
    let page = page(&data)?;
    let usual = self::page(&rigid()?)?;
    assert_eq!(page.matches("<script").count(), usual.matches("<script").count());
    assert_eq!(page.matches("</script").count(), usual.matches("</script").count());
    assert!(!page.contains("<img"));
    index(&page)?;
    Ok(())
}

#[test]
fn a_million_noisy_rows_make_a_page_below_five_megabytes() -> Outcome {
    let mut data = rigid()?;
    let mut seed = 1_u64;
    for column in &mut memory(&mut data).columns[1..] {
        *column = (0..1_000_001)
            .map(|_| {
                seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
                (seed >> 11) as f64 / (1_u64 << 53) as f64
            })
            .collect();
    }
    memory(&mut data).columns[0] = (0..1_000_001).map(|r| f64::from(r) * 1e-6).collect();
    let page = page(&data)?;
    assert!(page.len() < 5_000_000, "{} bytes", page.len());
    assert!(page.contains("1\u{202f}000\u{202f}001 rows recorded"));
    Ok(())
}

#[test]
fn strange_histories_do_no_harm() -> Outcome {
    let data = rigid()?;
    let with = |change: &dyn Fn(&mut History)| {
        let mut data = data.clone();
        change(memory(&mut data));
        page(&data).map(|_| ())
    };
    with(&|h| h.columns.iter_mut().for_each(Vec::clear))?;
    with(&|h| h.columns.iter_mut().for_each(|c| c.truncate(1)))?;
    with(&|h| h.columns[1..].iter_mut().for_each(|c| c.fill(0.0)))?;
    with(&|h| h.columns[1..].iter_mut().for_each(|c| c.fill(f64::NAN)))?;
    with(&|h| h.columns[1..].iter_mut().for_each(|c| c.fill(1e300)))?;
    with(&|h| h.columns[1..].iter_mut().for_each(|c| c.fill(-1e-300)))?;
    with(&|h| h.columns[0].fill(0.5))?;
    with(&|h| h.columns[0].fill(f64::NAN))?;
    with(&|h| h.columns[3..].iter_mut().for_each(|c| c.truncate(7)))?;
    with(&|h| *h = History::default())?;
    with(&|h| {
        h.channels = vec![Channel { name: "time".to_owned(), ..Channel::default() }];
        h.columns = vec![vec![0.0, 1.0]];
    })?;
    Ok(())
}

#[test]
fn strange_summaries_do_no_harm() -> Outcome {
    let data = rigid()?;
    let strange =
        [json!(null), json!({}), json!("text"), json!([1]), json!(3.5), json!({ "a": 1 })];
    for value in &strange {
        page(&ReportData { summary: value.clone(), ..data.clone() })?;
    }
    let keys: Vec<String> =
        data.summary.as_object().into_iter().flat_map(|o| o.keys().cloned()).collect();
    for key in keys {
        for value in &strange {
            let mut summary = data.summary.clone();
            summary[&key] = value.clone();
            let history = HistorySource::default();
            page(&ReportData { summary, history, ..ReportData::default() })?;
        }
    }
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
fn a_comparison_reads_back() -> Outcome {
    let dir = tempfile::tempdir()?;
    assert!(read_comparison(dir.path())?.is_empty(), "none was written");
    let series = |label: &str, by: f64| ComparisonSeries {
        label: label.to_owned(),
        time: vec![0.0, 0.1, 0.30000000000000004],
        energy: vec![by, by / 3.0, by * 1e-20],
    };
    let written = vec![series("restitution 0.5", 1.0), series("with, \"commas\"", 2.0)];
    write_comparison(dir.path(), &written)?;
    assert_eq!(read_comparison(dir.path())?, written);
    fs::write(dir.path().join("comparison.csv"), "series,time,energy_total\na,0,b\n")?;
    assert!(read_comparison(dir.path()).is_err_and(|e| e.to_string().contains("line 2")));
    Ok(())
}

#[test]
fn a_report_from_files_is_that_from_memory() -> Outcome {
    for format in [HistoryFormat::Parquet, HistoryFormat::Csv] {
        let mut data = rigid()?;
        let dir = tempfile::tempdir()?;
        let mut writer = HistoryWriter::new(dir.path(), format, "");
        synthetic::rigid(&mut writer, "hammer", 300, 1.0)?;
        writer.finish()?;
        write_summary(dir.path(), &data.summary)?;
        write_comparison(dir.path(), &data.comparison)?;
        write_envelopes(dir.path(), &[synthetic::section_forces("girder", 1.0)])?;
        fs::write(dir.path().join("scenario.toml"), &data.scenario)?;
        let read = ReportData::read(dir.path())?;
        assert!(matches!(read.history, HistorySource::File(_)));
        data.summary = read.summary.clone(); // its last digits may have been rounded
        assert!(page(&read)? == page(&data)?, "{format:?}");
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
fn contacts_that_never_closed_share_a_line() -> Outcome {
    let mut data = rigid()?;
    let untouched = |k: usize| {
        let between = json!([format!("d{k}"), "wall"]);
        json!({ "between": between, "impact_count": 0, "impulse_total": 0.0, "impacts": [], "intervals": [] })
    };
    data.summary["contact"]["d0-wall"] = untouched(0);
    let single = page(&data)?;
    assert!(single.contains("Contact d0-wall") && !single.contains("not closed:"));
    for k in 1..20 {
        data.summary["contact"][format!("d{k}-wall")] = untouched(k);
    }
    let page = page(&data)?;
    assert!(page.contains("20 contacts not closed: d0-wall, ") && page.contains(" and 8 more<"));
    assert!(page.contains("Projectile hammer") && !page.contains("Contact d0-wall"));
    data.summary["projectile"]["hammer"]["direction"] = json!(null);
    assert!(self::page(&data)?.contains("Disc hammer"));
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

#[test]
fn the_log_names_times_places_and_where_the_energy_went() -> Outcome {
    let mut data = rigid()?;
    let contact = &mut data.summary["contact"]["hammer"];
    contact["impacts"] = json!([contact["impacts"][0]]);
    contact["impact_count"] = json!(1);
    contact["impacts"][0]["energy"] = json!({ "given": [600.0, -1000.0], "lost": 400.0 });
    contact["impacts"][0]["fallback_law"] = json!(true);
    contact["impacts"][0]["tangential_impulse"] = json!(-12.5);
    contact["intervals"] = json!([{ "start": 0.0001, "end": null, "impulse": 3.0 }]);
    let page = page(&data)?;
    let log = page.split_once("<h2>Impact log</h2>").ok_or("no log")?.1;
    let log = log.split_once("</section>").ok_or("no end")?.0;
    let first = log.find("still closed").ok_or("no interval")?;
    let second = log.find("<td>instant</td>").ok_or("no impact")?;
    assert!(first < second, "in the order of time");
    for text in [
        "arc\u{a0}length\u{a0}[m]",
        "friction\u{a0}impulse",
        "600\u{a0}J\u{a0}girder.mid",
        "400\u{a0}J\u{a0}dissipated",
    ] {
        assert!(log.contains(text), "no {text} in {log}");
    }
    assert!(log.contains("class=\"first\" style=\"width:60.00%\""), "{log}");
    assert!(
        log.contains("1*</td>") && log.contains("Moreau"),
        "impacts under the fallback law are marked"
    );
    assert!(!log.contains("peak\u{a0}force"), "nothing here has a force");
    Ok(())
}

#[test]
fn findings_and_hand_formulas_stand_in_the_report() -> Outcome {
    let page = page(&rigid()?)?;
    for text in [
        "<h2 id=\"checks\">Model and result checks</h2>",
        "<span class=\"verdict mark\">warning</span>",
        "hammer: two-degree-of-freedom model</caption>",
        "<td>256.57\u{a0}kN</td><td>337.78\u{a0}kN</td><td>+31.7\u{a0}%</td>",
        "<li class=\"unmet\">small slopes: up to 0.3 (not met)</li>",
    ] {
        assert!(page.contains(text), "no {text}");
    }
    Ok(())
}

/// The energy of a run that loses 400 of 1000 J, 150 of them in the contact; a force of 120 kN bends the beam as far as the impact does.
#[test]
fn energy_and_equivalent_static_force_stand_in_tables() -> Outcome {
    let mut data = rigid()?;
    data.summary["energy"] = json!({
        "initial": 1000.0, "final": 600.0, "work_loads": 0.0, "work_supports": 0.0, "loss_impacts": 0.0, "loss_damping": 400.0,
        "loss_contacts": 150.0, "plastic": 0.0, "hardening": 0.0, "failure": 0.0, "scale": 1000.0, "residual_max": 2e-15,
    });
    let contact = &mut data.summary["contact"]["hammer"];
    contact["permanent_penetration"] = json!(0.0125);
    contact["equivalent_force"] =
        json!({ "moment": 120e3, "deflection": 95e3, "as_if_elastic": true });
    let page = page(&data)?.replace('\u{a0}', " ");
    for text in [
        "initial energy</th><td>1000 J</td>",
        "dissipated by damping</th><td>250 J</td>",
        "dissipated in contacts</th><td>150 J</td>",
        "final energy</th><td>600 J</td>",
        "residual, relative</th><td>2e-15</td>",
        "permanent indentation</th><td>12.5 mm</td>",
        "same peak moment</th><td>120 kN, elastic structure assumed</td>",
        "same peak deflection</th><td>95 kN, elastic structure assumed</td>",
    ] {
        assert!(page.contains(text), "no {text}");
    }
    assert!(!page.contains("lost in failed parts</th>"), "terms that are zero are left out");
    data.summary["contact"]["hammer"]["equivalent_force"] = Value::Null;
    data.summary["contact"]["hammer"]["equivalent_force_note"] = json!("two < three");
    assert!(self::page(&data)?.contains("<td>none: two &lt; three</td>"));
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

#[test]
fn envelopes_read_back() -> Outcome {
    let dir = tempfile::tempdir()?;
    assert!(read_envelopes(dir.path())?.is_empty(), "none was written");
    let written =
        [synthetic::section_forces("a, \"b\"", 1.0), synthetic::section_forces("c", 1e-7)];
    write_envelopes(dir.path(), &written)?;
    let read = read_envelopes(dir.path())?;
    assert_eq!(read.len(), 2);
    for (read, written) in read.iter().zip(&written) {
        assert_eq!(read.name, written.name);
        assert_eq!(read.envelope.moment, written.envelope.moment);
        assert_eq!(read.envelope.s, written.envelope.s);
        assert!(read.envelope.stress.iter().flatten().all(|v| v.is_nan()));
    }
    fs::write(dir.path().join("envelopes.csv"), "beam,s\n")?;
    assert!(read_envelopes(dir.path()).is_err_and(|e| e.is_content()));
    Ok(())
}

/// Every name and every text of a value replaced by one that would be markup.
fn poisoned(value: &Value, poison: &str) -> Value {
    match value {
        Value::String(text) => Value::from(format!("{text}{poison}")),
        Value::Array(list) => list.iter().map(|v| poisoned(v, poison)).collect(),
        Value::Object(entries) => entries
            .iter()
            .map(|(key, v)| {
                // Names of contacts, beams, ...: keys that are no words of ours.
                let named =
                    v.is_object() && !["energy", "momentum", "peak_force"].contains(&key.as_str());
                let key = if named { format!("{key}{poison}") } else { key.clone() };
                (key, poisoned(v, poison))
            })
            .collect(),
        other => other.clone(),
    }
}

#[test]
fn nothing_that_a_directory_of_results_says_becomes_markup() -> Outcome {
    let parts =
        ["projectile", "contact", "point", "support", "section_forces", "provenance", "settings"];
    for poison in [
        "</script><script>bad()</script>",
        "\"><img src=x onerror=bad()>",
        "--><b>",
        "'><svg/onload=bad()>",
    ] {
        let mut data = rigid()?;
        for part in parts {
            let inner = data.summary[part].as_object().cloned().unwrap_or_default();
            data.summary[part] = inner
                .into_iter()
                .map(|(name, value)| {
                    let keeps = ["provenance", "settings"].contains(&part);
                    let name = if keeps { name } else { format!("{name}{poison}") };
                    (name, poisoned(&value, poison))
                })
                .collect();
        }
        for key in ["title", "error", "percuss_version", "advice", "hand_formulas"] {
            data.summary[key] = poisoned(&data.summary[key], poison);
        }
        data.scenario.push_str(poison);
        let page = page(&data)?;
        let other = report::side_by_side::render(&[
            report::side_by_side::Named { name: format!("a{poison}"), data: data.clone() },
            report::side_by_side::Named { name: format!("b{poison}"), data },
        ])?;
        for text in [page, other] {
            let plain = text.matches("<script").count();
            assert!(!text.contains(poison), "{poison} stands in the page as it is");
            assert!(
                plain <= 5 && !text.contains("<img") && !text.contains("<svg/"),
                "{plain} scripts"
            );
        }
    }
    Ok(())
}
