//! Maps: where vehicles drive slowly and densely, change lanes, queue, and touch each other.

use laneweave_network::{Lanelet, Network};
use laneweave_sim::{IncidentKind, LaneletAggregate};
use laneweave_study::units::{KMH_PER_MPS, METRES_PER_KM};
use laneweave_study::{Area, MarkAt, Marks, OnTop, Shading, map};

use super::changes::KINDS;
use super::{NOBODY, RunReport};
use crate::report::kept::{Sparse, Spotted, in_plan};
use crate::report::{Figure, Section, counted};

/// The largest sizes of marks of events and of queues, as multiples of the usual one.
const LARGEST: f64 = 1.0;
const LARGEST_QUEUE: f64 = 2.6;
const TOGETHER: &str = "Places so close together that their marks would lie on each other have one mark of each kind: the larger it \
                        is, the more it stands for.";
/// Numbers of the colours and shapes of queues, collisions and overlaps; lane changes have the first three.
const QUEUE: usize = 1;
const COLLISION: usize = 1;
const OVERLAP: usize = 0;

pub(super) fn section(run: &RunReport) -> Section {
    let section = Section::new("map", "The map");
    let queued = run.record.places.entrances.iter().any(|it| it.most_waiting > 0);
    if run.aggregates.iter().all(|it| it.time == 0.0) && !queued {
        return section.text(NOBODY);
    }
    let areas: Vec<Area> = run.network.lanelets.iter().map(area).collect();
    let (speeds, densities) = (speeds(run, &areas), densities(run, &areas));
    let (changes, queues, incidents) = (changes(run, &areas), queues(run, &areas), incidents(run, &areas));
    let note = "North is up. Parts of the map that lie far from each other have panels of their own, with scales of their own. A long \
                road without bends is drawn wider than to scale: then a second, upright bar stands beside it. On a screen, a lanelet \
                says its id and its value when it is pointed at. Scales of colours reach up to the value that 98 % of the ground do not \
                exceed; a + at their last number says that there are higher values.";
    let section = section.note(note);
    match incidents {
        Some(figure) => section.figures(vec![speeds, densities, changes, queues, figure]),
        None => section
            .figures(vec![speeds, densities, changes, queues])
            .text("No vehicles touched each other, so there is no map of collisions."),
    }
}

/// A lanelet as it is seen from above.
pub fn area(lanelet: &Lanelet) -> Area {
    let [left, right] = [&lanelet.left_border, &lanelet.right_border].map(|it| it.points().iter());
    Area { name: lanelet.id.to_string(), outline: left.chain(right.rev()).map(in_plan).collect() }
}

/// A value for each lanelet that has vehicles.
fn values(run: &RunReport, of: impl Fn(&LaneletAggregate, f64) -> Option<f64>) -> Vec<Option<f64>> {
    let Network { lanelets, .. } = run.network;
    run.aggregates.iter().zip(lanelets).map(|(it, lanelet)| of(it, lanelet.length())).collect()
}

fn driven(values: &[Option<f64>]) -> String {
    format!(
        "Lanelets with vehicles: n = {} of {}",
        counted(values.iter().flatten().count() as u64),
        counted(values.len() as u64)
    )
}

fn speeds(run: &RunReport, areas: &[Area]) -> Figure {
    let values = values(run, |it, _| it.speed().map(|it| it * KMH_PER_MPS));
    let caption = format!(
        "Space-mean speed on each lanelet by Edie's definition, Σd/Σt over all vehicles and the measured time. Where lanelets overlap, \
         the slower one is on top. {}.",
        driven(&values)
    );
    let words = ["Mean speed", "km/h", "no vehicle"];
    let drawn = map(areas, Some(&Shading::of(areas, words, OnTop::Lowest, values)), &[]);
    Figure { drawn, title: "Mean speed on the map".into(), caption }
}

fn densities(run: &RunReport, areas: &[Area]) -> Figure {
    let duration = run.summary.duration_s;
    let values =
        values(run, |it, length| (it.time > 0.0).then(|| it.density(length, duration) * METRES_PER_KM));
    let caption = format!(
        "Density on each lanelet by Edie's definition, Σt/(LT), in vehicles per kilometre of lane. Where lanelets overlap, the denser \
         one is on top. {}.",
        driven(&values)
    );
    let words = ["Density", "veh/km", "no vehicle"];
    let drawn = map(areas, Some(&Shading::of(areas, words, OnTop::Highest, values)), &[]);
    Figure { drawn, title: "Density on the map".into(), caption }
}

/// Marks for places of a kind.
fn marks(kind: &str, series: usize, places: &Sparse) -> Marks {
    let mark = |it: &Spotted| MarkAt { area: it.lanelet.to_string(), at: it.at, value: it.time, weight: 1.0 };
    Marks {
        kind: kind.into(),
        key: format!("{kind} ({})", counted(places.total)),
        quantity: "time [s]".into(),
        series,
        largest: LARGEST,
        marks: places.kept.iter().map(mark).collect(),
    }
}

/// Which share of the places is drawn, if it is not all of them.
fn drawn_share(kind: &str, places: &Sparse) -> Option<String> {
    (places.every > 1).then(|| format!(" Of the {kind} ones, one in {} is drawn.", places.every))
}

fn changes(run: &RunReport, areas: &[Area]) -> Figure {
    let places = KINDS.map(|(kind, name)| (name, run.record.places.changes(kind)));
    let all: Vec<Marks> = (0..).zip(places).map(|(series, (name, it))| marks(name, series, it)).collect();
    let shares: String = places.iter().filter_map(|(name, it)| drawn_share(name, it)).collect();
    let total = places.iter().map(|(_, it)| it.total).sum();
    Figure {
        drawn: map(areas, None, &all),
        title: "Lane changes on the map".into(),
        caption: format!(
            "Where the centres of vehicles crossed the line between two lanes, by kind. {TOGETHER} n = {} completed lane changes.{shares}",
            counted(total)
        ),
    }
}

fn queues(run: &RunReport, areas: &[Area]) -> Figure {
    let duration = run.summary.duration_s;
    let values = values(run, |it, length| {
        (it.standing > 0.0).then(|| it.standing_density(length, duration) * METRES_PER_KM)
    });
    let entrances = &run.record.places.entrances;
    let most = entrances.iter().map(|it| it.most_waiting).max().unwrap_or(0);
    let queued = entrances.iter().filter(|it| it.most_waiting > 0);
    let waiting: Vec<MarkAt> = queued
        .map(|it| MarkAt {
            area: it.lanelet.to_string(),
            at: it.at,
            value: it.most_waiting as f64,
            weight: it.most_waiting as f64,
        })
        .collect();
    let caption = format!(
        "Standing vehicles (slower than 0.1 m/s) per kilometre of lane, in the mean of the measured time, and the largest number of \
         vehicles that waited to enter at a lane of an entrance: the larger the square, the longer the queue; lanes that lie close \
         together have one square. Lanelets on which vehicles stood: n = {} of {}; lanes of entrances with queues: n = {} of {}.",
        counted(values.iter().flatten().count() as u64),
        counted(values.len() as u64),
        counted(waiting.len() as u64),
        counted(entrances.len() as u64)
    );
    let queues = Marks {
        kind: "waiting to enter".into(),
        key: format!("waiting to enter (largest queue: {})", counted(most as u64)),
        quantity: "largest queue [vehicles]".into(),
        series: QUEUE,
        largest: LARGEST_QUEUE,
        marks: waiting,
    };
    let queues: Vec<Marks> = if most > 0 { vec![queues] } else { Vec::new() };
    let words = ["Standing vehicles", "veh/km", "none stood"];
    let drawn = map(areas, Some(&Shading::of(areas, words, OnTop::Highest, values)), &queues);
    Figure { drawn, title: "Queues on the map".into(), caption }
}

/// Collisions and overlaps, if there are any.
fn incidents(run: &RunReport, areas: &[Area]) -> Option<Figure> {
    let kinds = [(IncidentKind::Collision, COLLISION), (IncidentKind::Overlap, OVERLAP)];
    let places = kinds.map(|(kind, series)| (kind.name(), series, run.record.places.incidents(kind)));
    let total: u64 = places.iter().map(|(_, _, it)| it.total).sum();
    let found = places.iter().filter(|(_, _, it)| it.total > 0);
    let all: Vec<Marks> = found.map(|(name, series, it)| marks(name, *series, it)).collect();
    let shares: String = places.iter().filter_map(|(name, _, it)| drawn_share(name, it)).collect();
    (total > 0).then(|| Figure {
        drawn: map(areas, None, &all),
        title: "Collisions and overlaps on the map".into(),
        caption: format!(
            "Where vehicles began to touch each other; the table incidents lists them. {TOGETHER} n = {} incidents.{shares}",
            counted(total)
        ),
    })
}
