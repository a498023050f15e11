//! A fit as JSON.

use serde_json::{Value, json};

use crate::fit::Fit;

/// Everything about a fit but its curves; a number that is not finite is null.
pub fn fit_value(fit: &Fit) -> Value {
    let bound = |x: f64| if x.is_finite() { json!(x) } else { Value::Null };
    let parameter = |one: &crate::fit::FittedParameter| {
        json!({
            "name": one.name,
            "unit": one.unit,
            "paths": one.paths,
            "value": one.value,
            "stderr": bound(one.stderr),
            "interval": one.interval.map(bound),
            "start": one.start,
            "bounds": one.bounds.map(bound),
            "fixed": one.fixed,
        })
    };
    let channel = |one: &crate::goodness::Goodness| {
        json!({
            "test": one.test,
            "channel": one.channel,
            "column": one.column,
            "unit": one.unit,
            "hold_out": one.hold_out,
            "samples": one.samples,
            "sigma": one.sigma,
            "rms": one.rms,
            "reduced_chi_square": one.reduced_chi_square,
            "r_squared": one.r_squared,
            "autocorrelation": one.autocorrelation,
            "effective_samples": one.effective_samples,
        })
    };
    let minimum = |(one, values): (&crate::solve::Minimum, &Vec<f64>)| {
        json!({
            "start": one.start,
            "coordinates": one.coordinates,
            "values": values,
            "cost": bound(one.cost),
            "success": one.success,
            "message": one.message,
            "evaluations": one.evaluations,
        })
    };
    let doubt = |one: &crate::doubts::Doubt| json!({ "kind": one.kind.name(), "text": one.text });
    let profile = |one: &crate::least_costs::Profile| {
        json!({
            "name": one.name,
            "unit": one.unit,
            "values": one.values,
            "costs": one.costs.iter().copied().map(bound).collect::<Vec<_>>(),
            "interval": one.interval.map(bound),
        })
    };
    let free: Vec<&str> = fit.free.iter().map(|k| fit.parameters[*k].name.as_str()).collect();
    json!({
        "title": fit.title,
        "success": fit.success,
        "message": fit.message,
        "cost": fit.cost,
        "reduced_chi_square": fit.reduced_chi_square,
        "degrees_of_freedom": fit.freedom,
        "sigma_unknown": fit.sigma_unknown,
        "evaluations": fit.evaluations,
        "runs": fit.runs,
        "derivatives": fit.derivatives,
        "condition": bound(fit.condition),
        "parameters": fit.parameters.iter().map(parameter).collect::<Vec<_>>(),
        "free": free,
        "covariance": fit.covariance,
        "correlation": fit.correlation,
        "channels": fit.channels.iter().map(channel).collect::<Vec<_>>(),
        "starts": fit.minima.iter().zip(&fit.reached).map(minimum).collect::<Vec<_>>(),
        "profiles": fit.profiles.iter().map(profile).collect::<Vec<_>>(),
        "warnings": fit.doubts.iter().map(doubt).collect::<Vec<_>>(),
    })
}
