//! Trips: their durations and delays, and the vehicles that could not enter.

use laneweave_study::{
    BarRow, Distributed, Estimated, Histogram, Moments, Sheet, TimeLine, Upwards, bars, distribution,
    over_time,
};

use super::RunReport;
use crate::report::kept::TripTimes;
use crate::report::{Align, Figure, Section, Table, counted, number, with_interval};

/// Queues that are named.
const MOST_QUEUES: usize = 12;

pub(super) fn section(run: &RunReport) -> Section {
    let mut section = Section::new("trips", "Trips, delays and queues");
    let trips = &run.record.trips;
    let mut figures = Vec::new();
    if trips.durations.total() == 0 {
        section = section.text("No trip was completed in the measured time.");
    } else {
        figures.push(figure(
            &trips.durations,
            "Trip time [s]",
            "Trip times",
            "Time on the map of completed trips; vehicles still on the road at the end, many of them slow, are missing",
        ));
        if trips.delays.total() > 0 {
            figures.push(figure(
                &trips.delays,
                "Trip delay [s]",
                "Trip delays",
                "Trip time minus the time on a free road at the driver's desired speeds; the insertion delay (waiting to enter) is \
                 not included",
            ));
        }
    }
    if run.record.crowd.counts.iter().any(|(_, on_road, waiting)| on_road + waiting > 0) {
        figures.push(crowd(run));
    }
    figures.extend(by_style(trips));
    section
        .figures(figures)
        .table_unless_empty(times(run), "")
        .table_unless_empty(queues(run), "At the end no vehicle is waiting to enter.")
}

fn figure(histogram: &Histogram, label: &str, title: &str, what: &str) -> Figure {
    let histogram = histogram.trimmed(&[]);
    let share = format!("Share of trips [% per {} s]", histogram.width());
    let all = [Distributed { name: "", histogram: &histogram }];
    Figure {
        drawn: distribution(Sheet::Column, [label, &share], Upwards::Linear, &all),
        title: title.into(),
        caption: format!("{what}. n = {} trips.", counted(histogram.total())),
    }
}

/// Delays by style, where there are several.
fn by_style(trips: &TripTimes) -> Option<Figure> {
    let row = |(name, moments): &(String, Moments)| {
        let mean = moments.estimate()?;
        let values = vec![Estimated { at: 0.0, value: mean.mean, interval: mean.interval() }];
        mean.half_width.is_finite().then(|| (mean.replications, BarRow { name: name.clone(), values }))
    };
    let rows: Vec<(usize, BarRow)> = trips.of_styles.iter().filter_map(row).collect();
    if rows.len() < 2 {
        return None;
    }
    let counts: Vec<String> =
        rows.iter().map(|(count, row)| format!("{} {}", counted(*count as u64), row.name)).collect();
    let rows: Vec<BarRow> = rows.into_iter().map(|(_, row)| row).collect();
    Some(Figure {
        drawn: bars(Sheet::Column, ["Mean trip delay [s]", "Style"], &["delay"], &rows),
        title: "Delays by style".into(),
        caption: format!(
            "Mean delays with Student's 95 % intervals over trips, which assume that trips are independent. Delay is relative to \
             the driver's desired speeds: a driver with a higher desired speed has more to lose. n = {} trips.",
            counts.join(", ")
        ),
    })
}

fn crowd(run: &RunReport) -> Figure {
    let counts = &run.record.crowd.counts;
    let line = |name: &str, count: fn(&(f64, usize, usize)) -> usize| TimeLine {
        name: name.into(),
        points: counts.iter().map(|it| [it.0, count(it) as f64]).collect(),
    };
    let lines = [line("on the road", |it| it.1), line("waiting to enter", |it| it.2)];
    Figure {
        drawn: over_time(Sheet::Column, "Vehicles", &lines),
        title: "Vehicles over time".into(),
        caption: format!(
            "Vehicles on the road, and vehicles waiting to enter (insertion backlog). While these numbers grow, the traffic is not \
             steady, and means over the run are not those of a steady state. n = {} times.",
            counted(counts.len() as u64)
        ),
    }
}

fn times(run: &RunReport) -> Table {
    use Align::{Numbers, Words};
    let trips = &run.record.trips;
    let columns = [
        ("", Words),
        ("trips", Numbers),
        ("mean [s] (95 % interval)", Numbers),
        ("median [s]", Numbers),
        ("90th percentile [s]", Numbers),
    ];
    let caption = "Completed trips: means with Student's 95 % intervals over trips, which assume that trips are independent. Trips \
                   share the same traffic, so the intervals are somewhat too narrow.";
    let mut table = Table::new(caption, &columns);
    let mut row = |name: &str, moments: &Moments, histogram: Option<&Histogram>| {
        let Some(mean) = moments.estimate() else { return };
        let quantile =
            |share| histogram.and_then(|it| it.quantile(share)).map_or("–".into(), |it| number(it, 3));
        let text = with_interval(mean.mean, mean.interval(), 3);
        table.row([name.into(), counted(mean.replications as u64), text, quantile(0.5), quantile(0.9)]);
    };
    row("time on the map", &trips.duration, Some(&trips.durations));
    row("delay", &trips.delay, Some(&trips.delays));
    table
}

fn queues(run: &RunReport) -> Table {
    use Align::{Numbers, Words};
    let columns = [
        ("entrance", Words),
        ("onto lanelet", Words),
        ("waiting at the end", Numbers),
        ("largest queue", Numbers),
        ("blocked by (share of the time)", Words),
    ];
    let all = &run.summary.queues;
    let caption = match all.len() {
        0..=MOST_QUEUES => {
            "Queues of vehicles waiting to enter at the end, and what blocked the first vehicle.".into()
        }
        more => format!(
            "The {MOST_QUEUES} longest of {more} queues of vehicles waiting to enter at the end, and what blocked the first \
             vehicle; summary.json has all of them."
        ),
    };
    let mut table = Table::new(caption, &columns);
    for queue in all.iter().take(MOST_QUEUES) {
        let [entrance, lanelet] = [queue.entrance, queue.lanelet].map(|it| it.to_string());
        let [waiting, most] = [queue.waiting, queue.most_waiting].map(|it| counted(it as u64));
        table.row([entrance, lanelet, waiting, most, queue.held_s.to_text()]);
    }
    table
}
