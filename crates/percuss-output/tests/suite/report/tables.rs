//! Tables of the page: contacts, the impact log, findings, energy.

use super::*;

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
    assert!(page.contains("20 contacts not closed: d0-wall, ") && page.contains(" and 14 more<"));
    assert!(page.contains("Projectile hammer") && !page.contains("Contact d0-wall"));
    data.summary["projectile"]["hammer"]["direction"] = json!(null);
    assert!(self::page(&data)?.contains("Disc hammer"));
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
        "same peak moment</th><td>120 kN, of the elastic structure</td>",
        "same peak deflection</th><td>95 kN, of the elastic structure</td>",
    ] {
        assert!(page.contains(text), "no {text}");
    }
    assert!(!page.contains("lost in failed parts</th>"), "terms that are zero are left out");
    data.summary["contact"]["hammer"]["equivalent_force"] = Value::Null;
    data.summary["contact"]["hammer"]["equivalent_force_note"] = json!("two < three");
    assert!(self::page(&data)?.contains("<td>none: two &lt; three</td>"));
    Ok(())
}
