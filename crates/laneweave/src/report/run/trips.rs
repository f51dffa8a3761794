//! Trips: how long they took, what they lost, and who never got in.

use laneweave_study::{Distributed, Histogram, Moments, Sheet, distribution};

use super::RunReport;
use crate::report::{Align, Figure, Section, Table, number, with_interval};

/// Queues that are named.
const MOST_QUEUES: usize = 12;

pub(super) fn section(run: &RunReport) -> Section {
    let mut section = Section::new("trips", "Trips, delays and queues");
    let trips = &run.record.trips;
    if trips.durations.total() == 0 {
        section = section.text("No trip ended while it was measured.");
    } else {
        let mut figures = vec![figure(
            &trips.durations,
            "time of a trip [s]",
            "Times of trips",
            "Time on the map of the vehicles that left it; those still on the road at the end, and slow trips with them, are missing",
        )];
        if trips.delays.total() > 0 {
            figures.push(figure(
                &trips.delays,
                "delay of a trip [s]",
                "Delays of trips",
                "Time of the trip beyond that on a free road at the speeds the driver desires; time in a queue before the entrance is \
                 not part of it",
            ));
        }
        section = section.figures(figures).table(times(run));
    }
    section.table_unless_empty(queues(run), "At the end nobody waits at an entrance.")
}

fn figure(histogram: &Histogram, label: &str, title: &str, what: &str) -> Figure {
    let histogram = histogram.trimmed();
    let share = format!("share of trips [% per {} s]", number(histogram.width(), 1));
    let all = [Distributed { name: "", histogram: &histogram }];
    Figure {
        svg: distribution(Sheet::Column, [label, &share], &all),
        title: title.into(),
        caption: format!("{what}. n = {} trips.", histogram.total()),
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
        table.row([name.into(), mean.replications.to_string(), text, quantile(0.5), quantile(0.9)]);
    };
    row("time on the map", &trips.duration, Some(&trips.durations));
    row("delay", &trips.delay, Some(&trips.delays));
    if trips.of_styles.len() > 1 {
        for (name, moments) in &trips.of_styles {
            row(&format!("delay, {name}"), moments, None);
        }
    }
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
    let all = run.summary.map_or(&[][..], |it| &it.queues);
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
        let [waiting, most] = [queue.waiting, queue.most_waiting].map(|it| it.to_string());
        table.row([entrance, lanelet, waiting, most, queue.held_s.to_text()]);
    }
    table
}
