//! Trips: how long they took, what they lost, and who never got in.

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
        section = section.text("No trip ended while it was measured.");
    } else {
        figures.push(figure(
            &trips.durations,
            "time of a trip [s]",
            "Times of trips",
            "Time on the map of the vehicles that left it; those still on the road at the end, and slow trips with them, are missing",
        ));
        if trips.delays.total() > 0 {
            figures.push(figure(
                &trips.delays,
                "delay of a trip [s]",
                "Delays of trips",
                "Time of the trip beyond that on a free road at the speeds the driver desires; time in a queue before the entrance is \
                 not part of it",
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
        .table_unless_empty(queues(run), "At the end nobody waits at an entrance.")
}

fn figure(histogram: &Histogram, label: &str, title: &str, what: &str) -> Figure {
    let histogram = histogram.trimmed(&[]);
    let share = format!("share of trips [% per {} s]", histogram.width());
    let all = [Distributed { name: "", histogram: &histogram }];
    Figure {
        svg: distribution(Sheet::Column, [label, &share], Upwards::Linear, &all),
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
        svg: bars(Sheet::Column, ["mean delay of a trip [s]", "style [name]"], &["delay"], &rows),
        title: "Delays by style".into(),
        caption: format!(
            "Mean delays with Student's 95 % intervals over trips, as if they were independent. Delay is measured against the speeds \
             that the driver desires: who desires more has more to lose. n = {} trips.",
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
    let lines = [line("on the road", |it| it.1), line("waiting at the entrances", |it| it.2)];
    Figure {
        svg: over_time(Sheet::Column, "vehicles [number]", &lines),
        title: "Vehicles in the course of time".into(),
        caption: format!(
            "Vehicles on the road, and those that have arrived and find no room yet. While the numbers still grow, means over the \
             run are those of no steady traffic. n = {} times.",
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
        ("9 of 10 below [s]", Numbers),
    ];
    let caption = "Trips that ended: means with Student's 95 % intervals over trips, as if they were independent; they share the \
                   same traffic, so the intervals are rather too narrow.";
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
        ("most ever", Numbers),
        ("held by (share of the time)", Words),
    ];
    let all = &run.summary.queues;
    let caption = match all.len() {
        0..=MOST_QUEUES => "Queues that are left at the entrances, and what held the first in them.".into(),
        more => format!(
            "The {MOST_QUEUES} longest of {more} queues that are left at the entrances, and what held the first in them; all are in \
             summary.json."
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
