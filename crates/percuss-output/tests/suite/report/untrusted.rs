//! Texts of users, strange and very long data: the page stays a page.

use super::*;

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
