//! Which gaps recorded drivers accept, in the report of a fit.

use laneweave_results::report::{Align, Section, Table};

use super::gaps::GapReport;
use super::words::with_interval;

/// The section of a report.
pub(super) fn section(gaps: &GapReport) -> Section {
    let section = Section::new("gaps", "Accepted gaps");
    if let Some(why) = gaps.not_fitted {
        return section.text(format!("Critical gaps are the prior style's: {why}."));
    }
    let columns = [
        ("critical gap", Align::Words),
        ("median [m]", Align::Numbers),
        ("95 % interval", Align::Numbers),
        ("prior [m]", Align::Numbers),
        ("spread of logarithms", Align::Numbers),
        ("identified", Align::Words),
    ];
    let mut table = Table::new(format!("Shown by {} lane changes.", gaps.changes), &columns);
    for it in &gaps.critical {
        let [lower, upper] = it.median_interval;
        let [least, most] = it.spread_interval;
        table.row([
            it.name.key().to_owned(),
            format!("{:.2}", it.median_m),
            format!("{lower:.2} to {upper:.2}"),
            format!("{:.2}", it.prior_m),
            format!("{:.2} ({least:.2} to {most:.2})", it.spread),
            (if it.is_identified { "yes" } else { "no: the style has the prior's" }).to_owned(),
        ]);
    }
    let score = gaps.held_out.map(|it| {
        format!(
            "Held-out drivers: {:.3} nats per lane change by these, {:.3} by the prior's critical gaps; better by {}: {}.",
            it.fitted,
            it.prior,
            with_interval(it.over_prior, it.over_prior_interval),
            it.fitted_is
        )
    });
    let braking = gaps.follower_braking.map(|it| it.to_text());
    let section = score.into_iter().chain(braking).fold(section.table(table), Section::text);
    section.text(
        "Each driver has one critical lead gap and one critical lag gap; over the drivers they are lognormal. Drivers who wait for a gap show \
         that the gaps which they let pass were too short; how long they waited is not seen, so the likelihood is the sum over all \
         possibilities. The other limits of the gap test are those that accept nearly all recorded gaps.",
    )
}
