//! Contacts in `summary.json`.

use percuss::{
    ContactInterval, ContactPlace, ContactRecord, ContactSummary, EnergySplit, EquivalentForce,
    Impact, NoRestitution, Peak,
};
use serde_json::{Value, json};

use super::peak::peak;

/// What happened between two things that can touch.
pub(super) fn value(contact: &ContactSummary) -> Value {
    let mut value = json!({ "between": contact.between });
    if let Some(mass) = contact.effective_mass {
        value["effective_mass"] = Value::from(mass.on_mesh);
        value["effective_mass_limit"] = Value::from(mass.limit);
    }
    if let Some(force) = &contact.equivalent_force {
        value["equivalent_force"] = equivalent(force);
    } else if let Some(reason) = &contact.no_equivalent_force {
        value["equivalent_force_note"] = Value::from(reason.as_str());
    }
    if let Some(permanent) = contact.permanent_penetration {
        value["permanent_penetration"] = Value::from(permanent);
    }
    if let Some(carried) = contact.carried_crush {
        value["carried_crush"] = json!({ "distance": carried.distance, "depth": carried.depth });
    }
    if let Some(sliding) = contact.sliding {
        value["sliding_distance"] = Value::from(sliding.distance);
        value["friction_work"] = Value::from(sliding.work);
    }
    match &contact.record {
        ContactRecord::Smooth { peak_force, intervals } => {
            value["peak_force"] = peak(peak_force);
            let first =
                intervals.first().map_or(f64::NAN, |interval| interval.end - interval.start);
            value["duration"] = Value::from(first);
            value["intervals"] = intervals.iter().map(interval).collect();
        }
        ContactRecord::Nonsmooth {
            impacts,
            impact_count,
            fallback_count,
            impulse_total,
            impulse_resting,
            intervals,
            penetration,
        } => {
            value["impacts"] = impacts.iter().map(impact).collect();
            value["impact_count"] = Value::from(*impact_count);
            value["fallback_count"] = Value::from(*fallback_count);
            value["impulse_total"] = Value::from(*impulse_total);
            value["impulse_resting"] = Value::from(*impulse_resting);
            value["penetration"] = peak(penetration);
            value["intervals"] = intervals.iter().map(interval).collect();
        }
    }
    value
}

fn equivalent(force: &EquivalentForce) -> Value {
    let mut value = json!({
        "on_rebound": force.on_rebound,
        "beside_loads": force.beside_loads,
        "as_if_elastic": force.as_if_elastic,
    });
    for (key, one) in [("moment", force.moment), ("deflection", force.deflection)] {
        match one {
            Ok(force) => value[key] = Value::from(force),
            Err(why) if why.is_reported() => value[format!("{key}_note")] = why.to_string().into(),
            Err(_) => {}
        }
    }
    value
}

fn interval(interval: &ContactInterval) -> Value {
    let mut value = json!({
        "start": interval.start,
        "end": interval.end,
        "impulse": interval.impulse,
        "approach_velocity": interval.approach_velocity,
        "separation_velocity": interval.separation_velocity,
        "steps": interval.steps,
        "place": place(&interval.place),
        "place_end": place(&interval.place_end),
        "energy": energy(&interval.energy),
    });
    add_restitution(&mut value, interval.restitution());
    if interval.torn {
        value["torn"] = true.into();
    }
    // Persistent contact of rigid bodies has no force but means over steps.
    if interval.peak_force != Peak::default() && !interval.peak_force.value.is_nan() {
        value["peak_force"] = peak(&interval.peak_force);
    }
    if !interval.tangential_impulse.is_nan() {
        value["tangential_impulse"] = interval.tangential_impulse.into();
    }
    value
}

fn impact(impact: &Impact) -> Value {
    let mut value = json!({
        "time": impact.time,
        "impulse": impact.impulse,
        "tangential_impulse": impact.tangential_impulse,
        "approach_velocity": impact.approach_velocity,
        "separation_velocity": impact.separation_velocity,
        "points": impact.points,
        "place": place(&impact.place),
        "energy": energy(&impact.energy),
        "fallback_law": impact.fallback_law,
    });
    add_restitution(&mut value, impact.restitution());
    value
}

/// Adds the coefficient of restitution, or why there is none.
fn add_restitution(value: &mut Value, restitution: Result<f64, NoRestitution>) {
    match restitution {
        Ok(e) => value["restitution"] = e.into(),
        Err(why) => {
            value["restitution"] = Value::Null;
            value["restitution_why"] = why.to_string().into();
        }
    }
}

fn place(place: &ContactPlace) -> Value {
    json!({ "s": place.s, "position": place.position })
}

fn energy(split: &EnergySplit) -> Value {
    json!({ "given": split.given, "lost": split.lost, "stored": split.stored, "scheme": split.scheme })
}
