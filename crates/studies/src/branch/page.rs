//! The report of twins: the effects of the change, in figures.

use laneweave_results::output::Traces;
use laneweave_results::report::{Align, Figure, Page, Section, Table, counted, time_and_space};
use laneweave_study::units::KMH_PER_MPS;
use laneweave_study::{Distributed, Histogram, Sheet, TimeLine, Upwards, distribution, over_time};

use super::{Differences, Instant, Twins, Vehicle};

/// Maximum of vehicles that are named.
const NAMED: usize = 25;
/// Bins of delays in the branch relative to the base [s]: the first, their width and number.
const LATER: (f64, f64, usize) = (-60.0, 1.0, 120);

/// The report of `twins` after their run, with the `differences` that `settings` caused, and the `command`.
pub fn page(twins: &Twins, differences: &Differences, settings: &str, command: &str) -> Page {
    let lead = format!(
        "The same run twice (twins): from {:.1} s on, one of them with {settings}; compared by laneweave {}. Both use common random \
         numbers: the setting causes every difference.",
        differences.since_s,
        env!("CARGO_PKG_VERSION")
    );
    let mut facts: Vec<(String, String)> = vec![("command".into(), command.into())];
    facts.extend(differences.facts(settings).into_iter().map(|(name, value)| (name.into(), value)));
    let mut figures = in_time(differences).to_vec();
    figures.extend(later(differences));
    let lanes: Vec<(String, &Traces)> = ["base", "branch"]
        .into_iter()
        .zip(&twins.lanes)
        .filter_map(|(name, lane)| Some((name.into(), lane.as_ref()?)))
        .collect();
    let lanes: Vec<Figure> = time_and_space(&lanes).into_iter().collect();
    Page::new("Twins: the effect of one change", lead)
        .section(Section::new("what", "What differs").facts(facts))
        .section(
            Section::new("time", "Over time")
                .note(
                    "Traffic is chaotic: a centimetre in one place can cause another lane change elsewhere a minute later. The \
                     change causes every difference, but a single difference is not typical of the change. To measure its mean \
                     effect, compare many seeds.",
                )
                .figures(figures),
        )
        .section(Section::new("roads", "Time and space").figures(lanes))
        .section(Section::new("vehicles", "Vehicles that differ").table(vehicles(differences)))
}

fn in_time(differences: &Differences) -> [Figure; 3] {
    let line = |name: &str, value: &dyn Fn(&Instant) -> f64| TimeLine {
        name: name.into(),
        points: differences.instants.iter().map(|it| [it.time_s, value(it)]).collect(),
    };
    let both = |value: fn(&Instant) -> [f64; 2]| {
        [line("base", &|it| value(it)[0]), line("branch", &|it| value(it)[1])]
    };
    let figure = |label: &str, title: &str, caption: &str, lines: &[TimeLine]| Figure {
        drawn: over_time(Sheet::Column, label, lines),
        title: title.into(),
        caption: format!("{caption} n = {} seconds.", counted(differences.instants.len() as u64)),
    };
    [
        figure(
            "Vehicles",
            "Vehicles that differ",
            "Vehicles on the road in at least one run, and the number of them that differ in position, speed or lane-change state, \
             by however little, or that are on the road in one run only.",
            &[line("on the road", &|it| f64::from(it.on_road)), line("differ", &|it| f64::from(it.differ))],
        ),
        figure(
            "Lane changes",
            "Lane changes",
            "Completed lane changes since the time of the branch.",
            &both(|it| it.lane_changes.map(|it| it as f64)),
        ),
        figure(
            "Mean speed [km/h]",
            "Speeds",
            "Means over all vehicles on the road.",
            &both(|it| it.mean_speed_mps.map(|it| it * KMH_PER_MPS)),
        ),
    ]
}

/// Delays of vehicles in the branch relative to the base, if there are any.
fn later(differences: &Differences) -> Option<Figure> {
    let (from, width, bins) = LATER;
    let mut histogram = Histogram::new(from, width, bins);
    differences.later().for_each(|it| histogram.add(it));
    let (all, outside) = (histogram.total(), histogram.below(from) + histogram.beyond());
    let histogram = histogram.trimmed(&[]);
    (all > 0).then(|| Figure {
        drawn: distribution(
            Sheet::Column,
            ["Completed later in the branch [s]", "Share of vehicles [% per s]"],
            Upwards::Linear,
            &[Distributed { name: "", histogram: &histogram }],
        ),
        title: "Later and earlier arrivals".into(),
        caption: format!(
            "Time by which vehicles completed their trips later in the branch than in the base; negative: earlier. Only vehicles \
             that completed their trips in both runs. n = {} vehicles, {} of them beyond the axis.",
            counted(all),
            counted(outside)
        ),
    })
}

/// Vehicles that differ, the first ones first.
fn vehicles(differences: &Differences) -> Table {
    use Align::{Numbers, Words};
    let columns = [
        ("vehicle", Words),
        ("style", Words),
        ("class", Words),
        ("differs since [s]", Numbers),
        ("lane changes, base", Numbers),
        ("lane changes, branch", Numbers),
        ("completed [s], base", Numbers),
        ("completed [s], branch", Numbers),
    ];
    let mut all: Vec<(u64, &Vehicle)> =
        differences.vehicles.iter().map(|(id, it)| (u64::from(*id), it)).collect();
    all.sort_by(|a, b| a.1.since_s.total_cmp(&b.1.since_s).then(a.0.cmp(&b.0)));
    let caption = match all.len() {
        0..=NAMED => "All vehicles that differ.".into(),
        more => format!(
            "The first {NAMED} of {} vehicles that differ; the table differences has all of them.",
            counted(more as u64)
        ),
    };
    let mut table = Table::new(caption, &columns);
    for (id, it) in all.into_iter().take(NAMED) {
        let [base, branch] = it.lane_changes.map(|it| it.to_string());
        let [base_completed, branch_completed] =
            it.completed_s.map(|it| it.map_or("–".into(), |it| format!("{it:.1}")));
        let since = format!("{:.1}", it.since_s);
        table.row([
            id.to_string(),
            it.style.clone(),
            it.class.into(),
            since,
            base,
            branch,
            base_completed,
            branch_completed,
        ]);
    }
    table
}
