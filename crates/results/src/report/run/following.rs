//! How drivers drive and follow: speeds, time gaps, times to collision, accelerations.

use laneweave_study::{Distributed, Histogram, Sheet, Upwards, distribution};

use super::{NOBODY, RunReport};
use crate::report::kept::StyleDriving;
use crate::report::{Align, Figure, Section, Table, counted, number, percent};

/// Number of styles that are drawn: the most frequent ones.
const MOST_STYLES: usize = 4;
const SECONDS_PER_HOUR: f64 = 3600.0;

pub(super) fn section(run: &RunReport) -> Section {
    let section = Section::new("following", "Speeds, gaps, accelerations");
    let mut styles: Vec<&StyleDriving> =
        run.record.driving.styles.iter().filter(|it| it.samples > 0).collect();
    if styles.is_empty() {
        return section.text(NOBODY);
    }
    styles.sort_by_key(|it| std::cmp::Reverse(it.samples));
    let drawn = &styles[..styles.len().min(MOST_STYLES)];
    let of = |histogram: fn(&StyleDriving) -> &Histogram, upwards: Upwards, labels: [&str; 2]| {
        let all: Vec<&Histogram> = drawn.iter().map(|it| histogram(it)).collect();
        let trimmed: Vec<Histogram> = all.iter().map(|it| it.trimmed(&all)).collect();
        let named = drawn.iter().zip(&trimmed);
        let all: Vec<Distributed> =
            named.map(|(it, histogram)| Distributed { name: &it.name, histogram }).collect();
        distribution(Sheet::Column, labels, upwards, &all)
    };
    let sum = |count: fn(&StyleDriving) -> u64| drawn.iter().map(|it| count(it)).sum::<u64>();
    let mut figures = vec![Figure {
        drawn: of(|it| &it.speeds, Upwards::Linear, ["Speed [km/h]", "Share of samples [% per 5 km/h]"]),
        title: "Speeds".into(),
        caption: format!(
            "Speeds of all vehicles on all roads of the map; stopped vehicles are in the first bin. n = {} samples.",
            counted(sum(|it| it.samples))
        ),
    }];
    if sum(|it| it.time_gaps.total()) > 0 {
        figures.push(Figure {
            drawn: of(|it| &it.time_gaps, Upwards::Linear, ["Time gap to the leader [s]", "Share of samples [% per 0.25 s]"]),
            title: "Time gaps".into(),
            caption: format!(
                "Net gap to the leader divided by the vehicle's own speed, for vehicles faster than 2 m/s with a leader within 295 \
                 m. n = {} samples, {} of them beyond the axis.",
                counted(sum(|it| it.time_gaps.total())),
                counted(sum(|it| it.time_gaps.beyond()))
            ),
        });
    }
    if sum(|it| it.times_to_collision.total()) > 0 {
        figures.push(Figure {
            drawn: of(|it| &it.times_to_collision, Upwards::Linear, ["Time to collision [s]", "Share of closing samples [% per 0.5 s]"]),
            title: "Times to collision".into(),
            caption: format!(
                "Gap divided by closing speed, for vehicles that approach a leader within 295 m. n = {} samples, {} of them beyond \
                 the axis.",
                counted(sum(|it| it.times_to_collision.total())),
                counted(sum(|it| it.times_to_collision.beyond()))
            ),
        });
    }
    figures.push(Figure {
        drawn: of(|it| &it.accelerations, Upwards::Logarithmic, ["Acceleration [m/s²]", "Share of samples [% per 0.25 m/s²]"]),
        title: "Accelerations".into(),
        caption: format!(
            "Accelerations of all vehicles; negative values are braking, and stopped vehicles are at 0. The vertical axis is \
             logarithmic, so that rare hard braking is visible. n = {} samples.",
            counted(sum(|it| it.samples))
        ),
    });
    section
        .note(
            "Every vehicle on the road is sampled every five seconds. Successive samples of a vehicle, and samples of a platoon, \
             are nearly the same. Therefore these distributions have no intervals; n is the number of samples, not a measure of \
             precision.",
        )
        .figures(figures)
        .table(table(&styles))
}

fn table(styles: &[&StyleDriving]) -> Table {
    use Align::{Numbers, Words};
    let columns = [
        ("style", Words),
        ("veh-hours", Numbers),
        ("with a leader", Numbers),
        ("median time gap [s]", Numbers),
        ("time gap < 1 s", Numbers),
        ("time to collision < 3 s", Numbers),
        ("brakes > 2 m/s²", Numbers),
        ("brakes > 4 m/s²", Numbers),
    ];
    let mut table = Table::new(
        "Car-following by style: shares of all samples of the style; the median is over samples with a time gap.",
        &columns,
    );
    for it in styles {
        let all = it.samples as f64;
        let share = |count: u64| percent(count as f64 / all);
        table.row([
            it.name.clone(),
            number(all / SECONDS_PER_HOUR, 3),
            share(it.following),
            it.time_gaps.quantile(0.5).map_or("–".into(), |it| number(it, 3)),
            share(it.time_gaps.below(1.0)),
            share(it.times_to_collision.below(3.0)),
            share(it.accelerations.below(-2.0)),
            share(it.accelerations.below(-4.0)),
        ]);
    }
    table
}
