//! What a fit found, in words.

use std::fmt::Write;

use super::following::FollowingReport;
use super::found::by_paper_terms;
use super::gaps::GapReport;
use super::prediction::HeldOut;
use super::report::{ByPaper, Correction, FitReport, Spread, WeightReport};

impl FitReport {
    /// The report in words.
    pub fn to_text(&self) -> String {
        let mut out = String::new();
        // Writing to a string never fails.
        let _ = write_to(self, &mut out);
        out
    }
}

fn write_to(report: &FitReport, out: &mut String) -> std::fmt::Result {
    report.data.write_counts(out)?;
    writeln!(out, "\n  weight      estimate   95 % interval          prior    drives")?;
    for it in report.weights.iter().chain([&report.theta]) {
        write_weight(it, out)?;
    }
    let beta = &report.beta;
    let open = if beta.is_identified { "" } else { "   not identified: the prior's" };
    writeln!(
        out,
        "  {:9} {:>10.2}   {:>7.2} to {:<7.2}{open}",
        "beta", beta.estimate, beta.interval[0], beta.interval[1]
    )?;
    writeln!(
        out,
        "Weights are in units of the choice noise. Not identified: {}. A weight matters if its interval excludes 0.",
        report.data.not_identified.join(", ")
    )?;
    if let Some(it) = &report.correction {
        writeln!(out, "{}", correction(it))?;
    }
    if let [_, _, ..] = &report.classes[..] {
        writeln!(out, "\n{} classes of drivers:", report.classes.len())?;
        for it in &report.classes {
            let [lower, upper] = it.share_interval.map(|it| 100.0 * it);
            writeln!(out, "  {}: {:.0} % ({lower:.0} to {upper:.0} %)", it.style, 100.0 * it.share)?;
        }
    }
    report.by_paper.iter().try_for_each(|it| write_by_paper(it, out))?;
    write_following(&report.following, out)?;
    write_gaps(&report.gaps, out)?;
    writeln!(out, "\nPredicting drivers who were not seen [nats per lane change, 95 % interval]")?;
    writeln!(out, "  model       better than a constant chance       mcdm better than it by")?;
    report.held_out.iter().try_for_each(|it| write_held_out(it, out))?;
    if report.held_out.iter().any(|it| it.elsewhere.is_some()) {
        writeln!(out, "\nThe same for a site that was not seen, with its rate of changes known")?;
        report.held_out.iter().try_for_each(|it| write_elsewhere(it, out))?;
    }
    writeln!(out)?;
    write_spread("duration of a change [s]", report.durations_s.as_ref(), out)?;
    write_spread("gap to the new leader [m]", report.lead_gaps_m.as_ref(), out)?;
    write_spread("gap to the new follower [m]", report.lag_gaps_m.as_ref(), out)?;
    let [mean, deviation] = report.desired_speed_logs;
    let ends = [-0.6745, 0.0, 0.6745].map(|it| (mean + it * deviation).exp());
    writeln!(
        out,
        "desired speed of all drivers, share of what is allowed: {:.2} in the median, {:.2} to {:.2} in the middle half",
        ends[1], ends[0], ends[2]
    )?;
    write_spread("desired speed of those who drove freely", report.desired_speed_factors.as_ref(), out)?;
    report.judged.as_ref().map_or(Ok(()), |it| out.write_str(&it.to_text()))
}

/// What was corrected, and from where.
pub(super) fn correction(it: &Correction) -> String {
    let each =
        it.uncorrected.iter().map(|it| format!("{} {:.2} ± {:.2}", it.name, it.estimate, it.standard_error));
    format!(
        "Weights and theta (not those of classes) are corrected for errors of positions of {} m by simulation-extrapolation. Without: {}.",
        it.position_error_m,
        each.collect::<Vec<String>>().join(", ")
    )
}

/// What the recordings tell of a weight.
pub(super) fn told(it: &WeightReport) -> String {
    let identified = match (it.is_identified, it.name) {
        (true, _) => "identified",
        (false, "route") => "not identified: in the prior's proportion to speed",
        (false, "theta") => "not identified",
        (false, _) => "not identified: the prior's",
    };
    format!("{identified}{}", if it.matters { ", matters" } else { "" })
}

fn write_weight(it: &WeightReport, out: &mut String) -> std::fmt::Result {
    let [lower, upper] = it.interval;
    let interval = format!("{lower:.2} to {upper:.2}");
    let (name, told) = (it.name, told(it));
    writeln!(
        out,
        "  {name:9} {:>10.2}   {interval:<20} {:>7.2} {:>9.2}   {told}",
        it.estimate, it.prior, it.value
    )
}

fn write_by_paper(it: &ByPaper, out: &mut String) -> std::fmt::Result {
    let each = by_paper_terms().into_iter().zip(&it.weights);
    let weights: Vec<String> =
        each.map(|(name, [value, error])| format!("{name} {value:.2} ± {error:.2}")).collect();
    let found = match it.beta {
        None => "the weights have no maximum".to_owned(),
        Some(beta) => format!("{}, β {beta}", weights.join(", ")),
    };
    writeln!(
        out,
        "By the paper's procedure, {} ({} vehicles, {} changed): {found}",
        it.group, it.vehicles, it.changed
    )
}

fn write_following(it: &FollowingReport, out: &mut String) -> std::fmt::Result {
    if let Some(why) = it.not_fitted {
        return writeln!(out, "\nFollowing is the prior style's: {why}.");
    }
    writeln!(out, "\nFollowing: {} drivers in {:.0} s", it.drivers, it.seconds)?;
    writeln!(out, "  number                estimate   95 % interval          prior")?;
    for it in &it.numbers {
        let [lower, upper] = it.interval;
        let interval = format!("{lower:.2} to {upper:.2}");
        let open = if it.is_identified { "" } else { "   not identified: the prior's" };
        let name = it.name.key();
        writeln!(out, "  {name:20} {:>9.2}   {interval:<20} {:>7.2}{open}", it.estimate, it.prior)?;
    }
    writeln!(out, "{}", it.own())?;
    writeln!(out, "\nPredicting where drivers follow who were not seen [m off in the mean]")?;
    writeln!(out, "  after     fitted     prior   constant speed   better than a constant speed by")?;
    for it in &it.predictions {
        let [fitted, prior, constant] = [it.fitted, it.prior, it.constant_speed].map(|it| it.distance_m);
        let over = with_interval(it.over_constant_m, it.over_constant_interval);
        let (after, is) = (it.after_s, it.fitted_is);
        writeln!(out, "  {after:.1} s {fitted:>10.2} {prior:>9.2} {constant:>16.2}   {over}: {is}")?;
    }
    Ok(())
}

fn write_gaps(it: &GapReport, out: &mut String) -> std::fmt::Result {
    if let Some(why) = it.not_fitted {
        return writeln!(out, "\nCritical gaps are the prior style's: {why}.");
    }
    writeln!(out, "\nCritical gaps [m], by {} lane changes", it.changes)?;
    writeln!(out, "  gap                     median   95 % interval          prior   spread of logarithms")?;
    for it in &it.critical {
        let [lower, upper] = it.median_interval;
        let interval = format!("{lower:.2} to {upper:.2}");
        let [least, most] = it.spread_interval;
        let spread = format!("{:.2} ({least:.2} to {most:.2})", it.spread);
        let open = if it.is_identified { "" } else { "   not identified: the prior's" };
        let name = it.name.key();
        writeln!(
            out,
            "  {name:20} {:>9.2}   {interval:<20} {:>7.2}   {spread}{open}",
            it.median_m, it.prior_m
        )?;
    }
    if let Some(it) = &it.held_out {
        let over = with_interval(it.over_prior, it.over_prior_interval);
        writeln!(
            out,
            "Held-out drivers [nats per lane change]: {:.3} by these, {:.3} by the prior's; better by {over}: {}",
            it.fitted, it.prior, it.fitted_is
        )?;
    }
    if let Some(it) = &it.follower_braking {
        writeln!(out, "{}", it.to_text())?;
    }
    Ok(())
}

fn write_held_out(it: &HeldOut, out: &mut String) -> std::fmt::Result {
    let over = with_interval(it.over_constant, it.over_constant_interval);
    let mcdm = with_interval(it.mcdm_over_it, it.mcdm_over_it_interval);
    write_prediction(&it.model, [&over, &mcdm, it.mcdm_is], out)
}

fn write_elsewhere(it: &HeldOut, out: &mut String) -> std::fmt::Result {
    let Some(elsewhere) = &it.elsewhere else { return Ok(()) };
    let over = with_interval(elsewhere.over_constant, elsewhere.over_constant_interval);
    let mcdm = with_interval(elsewhere.mcdm_over_it, elsewhere.mcdm_over_it_interval);
    write_prediction(&it.model, [&over, &mcdm, elsewhere.mcdm_is], out)
}

fn write_prediction(model: &str, [over, mcdm, verdict]: [&str; 3], out: &mut String) -> std::fmt::Result {
    let verdict = if model == "mcdm" { String::new() } else { format!("  {mcdm}: {verdict}") };
    writeln!(out, "  {model:10} {over:<34}{verdict}")
}

/// A number with its interval.
pub(super) fn with_interval(value: f64, [lower, upper]: [f64; 2]) -> String {
    format!("{value:.3} ({lower:.3} to {upper:.3})")
}

fn write_spread(what: &str, spread: Option<&Spread>, out: &mut String) -> std::fmt::Result {
    match spread {
        Some(it) => writeln!(
            out,
            "{what}: {:.2} in the median, {:.2} to {:.2} in the middle half ({})",
            it.median, it.lower_quartile, it.upper_quartile, it.count
        ),
        None => writeln!(out, "{what}: not seen"),
    }
}
