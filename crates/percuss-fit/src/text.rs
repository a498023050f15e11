//! The report of a fit as text.

use std::fmt::Write;

use crate::fit::Fit;

/// Correlations below this are not listed.
const LISTED: f64 = 0.1;

/// The report of a fit: statistics, parameters with their standard errors, correlations, channels and warnings.
pub fn fit_text(fit: &Fit) -> String {
    let mut out = String::new();
    // Writing to a String never fails.
    let _ = statistics(fit, &mut out)
        .and_then(|()| parameters(fit, &mut out))
        .and_then(|()| profiles(fit, &mut out))
        .and_then(|()| correlations(fit, &mut out))
        .and_then(|()| channels(fit, &mut out))
        .and_then(|()| starts(fit, &mut out))
        .and_then(|()| warnings(fit, &mut out));
    out
}

fn statistics(fit: &Fit, out: &mut String) -> std::fmt::Result {
    if !fit.title.is_empty() {
        writeln!(out, "{}", fit.title)?;
    }
    writeln!(out, "{}", fit.message)?;
    let rows = [
        (
            "measured values",
            fit.channels
                .iter()
                .filter(|c| !c.hold_out)
                .map(|c| c.samples)
                .sum::<usize>()
                .to_string(),
        ),
        ("free parameters", fit.free.len().to_string()),
        ("cost (half the sum of losses)", format!("{:.6}", fit.cost)),
        ("reduced chi-square", format!("{:.6}", fit.reduced_chi_square)),
        ("evaluations", fit.evaluations.to_string()),
        ("runs", fit.runs.to_string()),
        ("derivatives", fit.derivatives.clone()),
    ];
    writeln!(out, "[statistics]")?;
    rows.iter().try_for_each(|(name, value)| writeln!(out, "  {name:<30} {value}"))?;
    if fit.sigma_unknown {
        writeln!(out, "  standard deviations of the channels follow from the residuals")?;
    }
    Ok(())
}

fn parameters(fit: &Fit, out: &mut String) -> std::fmt::Result {
    let width = fit.parameters.iter().map(|p| p.name.len()).max().unwrap_or(0);
    writeln!(out, "[parameters]")?;
    for one in &fit.parameters {
        let unit = if one.unit == "1" { String::new() } else { format!(" {}", one.unit) };
        let reported = if one.fixed {
            format!("{:.7e}{unit} (fixed)", one.value)
        } else if one.stderr.is_finite() {
            let share = 100.0 * one.stderr / one.value.abs();
            let share = if share.is_finite() { format!(" ({share:.2} %)") } else { String::new() };
            let [low, high] = one.interval;
            format!(
                "{:.7e} +- {:.3e}{unit}{share}, 95 %: {low:.7e} to {high:.7e} (start {:.7e})",
                one.value, one.stderr, one.start
            )
        } else {
            format!("{:.7e}{unit}, not determined by the data (start {:.7e})", one.value, one.start)
        };
        writeln!(out, "  {:<width$}  {reported}", one.name)?;
    }
    Ok(())
}

fn profiles(fit: &Fit, out: &mut String) -> std::fmt::Result {
    if fit.profiles.is_empty() {
        return Ok(());
    }
    writeln!(out, "[profiles]")?;
    let width = fit.profiles.iter().map(|one| one.name.len()).max().unwrap_or(0);
    fit.profiles.iter().try_for_each(|one| writeln!(out, "  {:<width$}  {}", one.name, one.words()))
}

fn correlations(fit: &Fit, out: &mut String) -> std::fmt::Result {
    let mut pairs = Vec::new();
    for i in 0..fit.free.len() {
        for j in 0..i {
            pairs.push((j, i, fit.correlation[i][j]));
        }
    }
    pairs.retain(|(.., found)| found.abs() >= LISTED);
    pairs.sort_by(|a, b| b.2.abs().total_cmp(&a.2.abs()));
    if pairs.is_empty() {
        return Ok(());
    }
    writeln!(out, "[correlations above {LISTED}]")?;
    let name = |k: usize| fit.parameters[fit.free[k]].name.as_str();
    pairs
        .iter()
        .try_for_each(|(i, j, found)| writeln!(out, "  {}, {}: {found:+.3}", name(*i), name(*j)))
}

fn channels(fit: &Fit, out: &mut String) -> std::fmt::Result {
    writeln!(out, "[channels]")?;
    for one in &fit.channels {
        let kept = if one.hold_out { ", not fitted" } else { "" };
        writeln!(
            out,
            "  {}.{} ({}): rms {:.4e} {}, sigma {:.4e}, reduced chi-square {:.4}, R^2 {:.6}, autocorrelation {:+.3}, {} values ({:.0} independent){kept}",
            one.test,
            one.channel,
            one.column,
            one.rms,
            one.unit,
            one.sigma,
            one.reduced_chi_square,
            one.r_squared,
            one.autocorrelation,
            one.samples,
            one.effective_samples,
        )?;
    }
    Ok(())
}

fn starts(fit: &Fit, out: &mut String) -> std::fmt::Result {
    if fit.minima.len() < 2 {
        return Ok(());
    }
    writeln!(out, "[starting points]")?;
    fit.minima.iter().enumerate().try_for_each(|(k, one)| {
        writeln!(out, "  {}: cost {:.6}, {}", k + 1, one.cost, one.message)
    })
}

fn warnings(fit: &Fit, out: &mut String) -> std::fmt::Result {
    if fit.doubts.is_empty() {
        return Ok(());
    }
    writeln!(out, "[warnings]")?;
    fit.doubts.iter().try_for_each(|doubt| writeln!(out, "  {}", doubt.text))
}
