//! The report of twins: what one thing changed, drawn.

use laneweave_results::report::{Align, Figure, Page, Section, Table, counted, time_and_space};
use laneweave_study::units::KMH_PER_MPS;
use laneweave_study::{Distributed, Histogram, Sheet, TimeLine, Upwards, distribution, over_time};

use super::{Differences, Instant, Twins, Vehicle};

/// Vehicles that are named.
const NAMED: usize = 25;
/// Bins of how much later somebody left [s]: the first, their width and number.
const LATER: (f64, f64, usize) = (-60.0, 1.0, 120);

/// The report of `twins` after they were driven, with their `differences`, which come of `settings`, as the `command`
/// was given.
pub fn page(twins: &Twins, differences: &Differences, settings: &str, command: &str) -> Page {
    let lead = format!(
        "The same traffic twice from {:.1} s on, once with {settings}; compared by laneweave {}. All draws are equal: whatever differs \
         is caused by that.",
        differences.since_s,
        env!("CARGO_PKG_VERSION")
    );
    let mut facts: Vec<(String, String)> = vec![("command".into(), command.into())];
    facts.extend(differences.facts(settings).into_iter().map(|(name, value)| (name.into(), value)));
    let mut figures = in_time(differences).to_vec();
    figures.extend(later(differences));
    let lanes = ["as it was", "with the change"].into_iter().zip(&twins.lanes);
    let lanes =
        lanes.filter_map(|(name, lane)| time_and_space(lane.as_ref()?, format!("Time and space {name}")));
    Page::new("Twins: what one thing changes", lead)
        .section(Section::new("what", "What differs").facts(facts))
        .section(
            Section::new("time", "In the course of time")
                .note(
                    "Traffic is chaotic: a centimetre in one place is another lane change a minute later elsewhere. That a difference is \
                     caused by the change does not make it typical of it: for what a change does on average, compare many seeds.",
                )
                .figures(figures),
        )
        .section(Section::new("roads", "Time and space").figures(lanes.collect()))
        .section(Section::new("vehicles", "Who differs").table(vehicles(differences)))
}

fn in_time(differences: &Differences) -> [Figure; 3] {
    let line = |name: &str, value: &dyn Fn(&Instant) -> f64| TimeLine {
        name: name.into(),
        points: differences.instants.iter().map(|it| [it.time_s, value(it)]).collect(),
    };
    let both = |value: fn(&Instant) -> [f64; 2]| {
        [line("as it was", &|it| value(it)[0]), line("with the change", &|it| value(it)[1])]
    };
    let figure = |label: &str, title: &str, caption: &str, lines: &[TimeLine]| Figure {
        svg: over_time(Sheet::Column, label, lines),
        title: title.into(),
        caption: format!("{caption} n = {} seconds.", counted(differences.instants.len() as u64)),
    };
    [
        figure(
            "vehicles [number]",
            "Who differs",
            "Vehicles on the road in either, and those of them that are elsewhere, faster or slower, or want something else, by a bit \
             or by much, or are on the road in one only.",
            &[line("on the road", &|it| f64::from(it.on_road)), line("differ", &|it| f64::from(it.differ))],
        ),
        figure(
            "lane changes [number]",
            "Lane changes",
            "Completed changes since the twins parted.",
            &both(|it| it.lane_changes.map(|it| it as f64)),
        ),
        figure(
            "mean speed [km/h]",
            "Speeds",
            "Means over all vehicles on the road.",
            &both(|it| it.mean_speed_mps.map(|it| it * KMH_PER_MPS)),
        ),
    ]
}

/// How much later vehicles left, where any did.
fn later(differences: &Differences) -> Option<Figure> {
    let (from, width, bins) = LATER;
    let mut histogram = Histogram::new(from, width, bins);
    differences.later().for_each(|it| histogram.add(it));
    let (all, outside) = (histogram.total(), histogram.below(from) + histogram.beyond());
    let histogram = histogram.trimmed(&[]);
    (all > 0).then(|| Figure {
        svg: distribution(
            Sheet::Column,
            ["left later with the change [s]", "share of vehicles [% per s]"],
            Upwards::Linear,
            &[Distributed { name: "", histogram: &histogram }],
        ),
        title: "Who arrives later, and earlier".into(),
        caption: format!(
            "By how much vehicles that left in both left later with the change; below 0 earlier. n = {} vehicles, {} of them beyond \
             the axis.",
            counted(all),
            counted(outside)
        ),
    })
}

/// Those who differ, the first ones first.
fn vehicles(differences: &Differences) -> Table {
    use Align::{Numbers, Words};
    let columns = [
        ("vehicle", Words),
        ("style", Words),
        ("class", Words),
        ("differs since [s]", Numbers),
        ("lane changes, as it was", Numbers),
        ("with the change", Numbers),
        ("left [s], as it was", Numbers),
        ("with the change", Numbers),
    ];
    let mut all: Vec<(u64, &Vehicle)> =
        differences.vehicles.iter().map(|(id, it)| (u64::from(*id), it)).collect();
    all.sort_by(|a, b| a.1.since_s.total_cmp(&b.1.since_s).then(a.0.cmp(&b.0)));
    let caption = match all.len() {
        0..=NAMED => "All that differ.".into(),
        more => format!(
            "The first {NAMED} of {} that differ; the table differences has them all.",
            counted(more as u64)
        ),
    };
    let mut table = Table::new(caption, &columns);
    for (id, it) in all.into_iter().take(NAMED) {
        let [base, branch] = it.lane_changes.map(|it| it.to_string());
        let [base_left, branch_left] = it.left_s.map(|it| it.map_or("–".into(), |it| format!("{it:.1}")));
        let since = format!("{:.1}", it.since_s);
        table.row([
            id.to_string(),
            it.style.clone(),
            it.class.into(),
            since,
            base,
            branch,
            base_left,
            branch_left,
        ]);
    }
    table
}
