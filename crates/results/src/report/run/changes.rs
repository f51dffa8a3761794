//! Lane changes: when, by which styles, why, and into which gaps.

use laneweave_sim::LaneChangeKind;
use laneweave_study::units::METRES_PER_KM;
use laneweave_study::{
    BarRow, Distributed, Estimated, Interval, Sheet, Upwards, bars, distribution, poisson_interval,
    rate_density,
};

use super::RunReport;
use super::numbers::rate_per;
use crate::report::kept::Reasons;
use crate::report::{Align, Figure, Section, Table, counted, number};

pub(super) const KINDS: [(LaneChangeKind, &str); LaneChangeKind::ALL.len()] = [
    (LaneChangeKind::Discretionary, "discretionary"),
    (LaneChangeKind::Route, "route-driven"),
    (LaneChangeKind::Keeping, "keeping"),
];
/// Incentives are counted per this number of vehicle-kilometres.
const MANY_KM: f64 = 100.0;
/// Minimum number of values in a distribution.
const LEAST: u64 = 20;

pub(super) fn section(run: &RunReport) -> Section {
    let section = Section::new("changes", "Lane changes");
    let reasons = &run.record.reasons;
    if reasons.total() == 0 {
        return section.text(format!("No lane change was completed; {} were aborted.", reasons.aborted));
    }
    let mut figures = vec![by_density(run)];
    figures.extend(gains(reasons));
    figures.extend([by_style(run), by_incentive(run)]);
    figures.extend(gaps(reasons));
    figures.extend(times_to_collision(reasons));
    section
        .note(format!(
            "The figures by style, by incentive and of gaps show the {} lane changes that were completed in the measured time (the \
             rows of the table lane_changes); {} more were aborted. Discretionary: between lanes that lead to the same place for \
             the driver. Keeping: of them, those that the driver makes only to keep to the slow side. Route-driven (mandatory): all \
             others. A distribution of fewer than {LEAST} values is not drawn.",
            counted(reasons.total()),
            counted(reasons.aborted)
        ))
        .figures(figures)
        .table(table(run))
}

fn by_density(run: &RunReport) -> Figure {
    let boxes = &run.record.boxes;
    let series = KINDS.map(|(kind, name)| boxes.series(name, run.end, |it| it == kind));
    let counts: Vec<String> = series
        .iter()
        .map(|it| format!("{} {}", it.points.iter().map(|it| it.changes).sum::<u64>(), it.name))
        .collect();
    Figure {
        drawn: rate_density(Sheet::Column, "", &series),
        title: "Lane changes against density".into(),
        caption: format!(
            "Lane changes per kilometre of lane and hour in boxes of about 500 m of all parallel lanes and 60 s; density by Edie's \
             definition in the same box. Boxes of similar density (2 veh/km) are pooled; bars are exact Poisson 95 % intervals of \
             the pooled counts. n = {} boxes; {} lane changes. A rate that rises and falls with density does not prove the model: \
             drivers who change at random (the null-model control) show it too.",
            counted(boxes.rows(run.end).count() as u64),
            counts.join(", ")
        ),
    }
}

/// A count per exposure with its exact Poisson interval.
fn estimated(count: u64, exposure: f64) -> Estimated {
    let Interval { lower, upper } = poisson_interval(count);
    let interval = Interval { lower: lower / exposure, upper: upper / exposure };
    Estimated { at: 0.0, value: count as f64 / exposure, interval }
}

/// Vehicle-kilometres of a style.
fn veh_km(run: &RunReport, style: usize) -> f64 {
    run.record.driving.styles[style].distance / METRES_PER_KM
}

fn by_style(run: &RunReport) -> Figure {
    let reasons = &run.record.reasons;
    let row = |(style, name): (usize, &String)| BarRow {
        name: name.clone(),
        values: KINDS.map(|(kind, _)| estimated(reasons.of_style(style, kind), veh_km(run, style))).into(),
    };
    let rows: Vec<BarRow> = reasons.styles.iter().enumerate().map(row).collect();
    Figure {
        drawn: bars(Sheet::Column, ["Lane changes [1/veh-km]", "Style"], &KINDS.map(|it| it.1), &rows),
        title: "Lane changes by style".into(),
        caption: format!(
            "Completed lane changes per vehicle-kilometre of the drivers of each style (speeds sampled every five seconds), with \
             exact Poisson 95 % intervals of the counts. n = {} lane changes.",
            counted(reasons.total())
        ),
    }
}

fn by_incentive(run: &RunReport) -> Figure {
    let reasons = &run.record.reasons;
    let all: f64 = (0..reasons.styles.len()).map(|it| veh_km(run, it)).sum();
    let row = |name: &str| BarRow {
        name: name.into(),
        values: KINDS.map(|(kind, _)| estimated(reasons.of_incentive(name, kind), all / MANY_KM)).into(),
    };
    let led = |name: &str| KINDS.iter().any(|(kind, _)| reasons.of_incentive(name, *kind) > 0);
    let named = reasons.incentives().into_iter().filter(|it| *it != "none" || led(it));
    let rows: Vec<BarRow> = named.map(row).collect();
    let labels = ["Lane changes [1/(100 veh-km)]", "Leading incentive"];
    Figure {
        drawn: bars(Sheet::Column, labels, &KINDS.map(|it| it.1), &rows),
        title: "Lane changes by leading incentive".into(),
        caption: format!(
            "Completed lane changes per 100 vehicle-kilometres, by the incentive with the largest product μY of weight and yield \
             when the desire began. The other incentives may also have contributed, for or against the change. Exact Poisson 95 % \
             intervals. n = {} lane changes.",
            counted(reasons.total())
        ),
    }
}

fn gaps(reasons: &Reasons) -> Option<Figure> {
    let [ahead, behind] = &reasons.gaps;
    if [ahead, behind].iter().map(|it| it.total()).sum::<u64>() < LEAST {
        return None;
    }
    let all = [("to the new leader", ahead), ("to the new follower", behind)];
    let all = all.map(|(name, histogram)| Distributed { name, histogram });
    Some(Figure {
        drawn: distribution(Sheet::Column, ["Gap [m]", "Share of gaps [% per 5 m]"], Upwards::Linear, &all),
        title: "Accepted gaps".into(),
        caption: format!(
            "Net gaps in the target lane at the start of the lateral motion, for completed changes with a leader or a follower \
             there: n = {} ahead, {} behind; {} and {} of them lie beyond the axis.",
            counted(ahead.total()),
            counted(behind.total()),
            counted(ahead.beyond()),
            counted(behind.beyond())
        ),
    })
}

fn gains(reasons: &Reasons) -> Option<Figure> {
    let [discretionary, route, keeping] = &reasons.gains;
    if reasons.gains.iter().map(|it| it.total()).sum::<u64>() < LEAST {
        return None;
    }
    let trimmed = reasons.gains.each_ref().map(|it| it.trimmed(&[discretionary, route, keeping]));
    let named = KINDS.iter().zip(&trimmed).filter(|(_, histogram)| histogram.total() > 0);
    let all: Vec<Distributed> = named.map(|((_, name), histogram)| Distributed { name, histogram }).collect();
    let labels = ["Speed gain [m/s]", "Share of lane changes [% per m/s]"];
    Some(Figure {
        drawn: distribution(Sheet::Column, labels, Upwards::Linear, &all),
        title: "Anticipated speed gain".into(),
        caption: format!(
            "Anticipated speed in the target lane minus that in the driver's own lane, when the desire began, of completed changes. \
             n = {} discretionary, {} route-driven, {} keeping. Changes for the route, out of courtesy or to keep to the slow side may \
             cost speed.",
            counted(discretionary.total()),
            counted(route.total()),
            counted(keeping.total())
        ),
    })
}

fn times_to_collision(reasons: &Reasons) -> Option<Figure> {
    let [ahead, behind] = &reasons.times_to_collision;
    if [ahead, behind].iter().map(|it| it.total()).sum::<u64>() < LEAST {
        return None;
    }
    let all = [("with the new leader", ahead), ("of the new follower", behind)];
    let all = all.map(|(name, histogram)| Distributed { name, histogram });
    Some(Figure {
        drawn: distribution(
            Sheet::Column,
            ["Time to collision [s]", "Share of closing pairs [% per s]"],
            Upwards::Linear,
            &all,
        ),
        title: "Time to collision at the start of lane changes".into(),
        caption: format!(
            "Gap divided by closing speed at the start of the lateral motion, for pairs whose gap closes: n = {} ahead, {} behind; \
             {} and {} of them lie beyond the axis. The time to collision gives no information on pairs with equal speeds, however \
             small the gap is.",
            counted(ahead.total()),
            counted(behind.total()),
            counted(ahead.beyond()),
            counted(behind.beyond())
        ),
    })
}

fn table(run: &RunReport) -> Table {
    use Align::{Numbers, Words};
    let reasons = &run.record.reasons;
    let columns = [
        ("style", Words),
        ("discretionary", Numbers),
        ("route-driven", Numbers),
        ("keeping", Numbers),
        ("veh-km", Numbers),
        ("lane changes per veh-km (95 % interval)", Numbers),
    ];
    let mut table = Table::new("Completed lane changes by style.", &columns);
    let mut row = |name: &str, counts: [u64; LaneChangeKind::ALL.len()], km: f64| {
        let [discretionary, route, keeping] = counts.map(counted);
        let rate = rate_per(counts.iter().sum(), km);
        table.row([name.into(), discretionary, route, keeping, number(km, 4), rate]);
    };
    for (style, name) in reasons.styles.iter().enumerate() {
        row(name, KINDS.map(|(kind, _)| reasons.of_style(style, kind)), veh_km(run, style));
    }
    let all: f64 = (0..reasons.styles.len()).map(|it| veh_km(run, it)).sum();
    row("all", KINDS.map(|(kind, _)| reasons.of_kind(kind)), all);
    table
}
