//! What lanes and bottlenecks carry, and how jams move.

use laneweave::Fault;
use laneweave::generate::Motorway;

use crate::experiments::drive::{drive_all, over};
use crate::experiments::effort::Effort;
use crate::experiments::finding::Row;
use crate::experiments::seen::{INTERVAL, SECTION, Seen};
use crate::experiments::traffic::{Arriving, Road, Traffic};

/// Flows are counted over this time [s].
const COUNTED_OVER: f64 = 300.0;
const BOTTLENECKS: &str =
    "1,800–2,100 at 38 motorway bottlenecks (Geistefeldt, Shojaat 2019); upper end ours";
const RAMPS: &str = "2,048 pc/h/lane at 3 lanes (arXiv 1907.09606); with 10 % trucks at 2 pc about 1,860";
const DROPS: &str =
    "6 % (Hall, Agyemang-Duah 1991, m), 8–10 % (Cassidy, Bertini 1999, m), 3–18 % (Chung 2007, m)";
const WAVES: &str = "−18 ± 1 (Stipdonk, van Toorenburg, Postema), −15 ± 5 km/h";

/// Largest flow per lane [veh/h] at the end of the road, over whole intervals of five minutes.
pub(super) fn largest_flow(seen: &Seen, lanes: usize) -> Option<f64> {
    flows(seen, lanes).into_iter().reduce(f64::max)
}

/// Flows per lane [veh/h] over whole intervals of five minutes, or over all if the run is shorter.
fn flows(seen: &Seen, lanes: usize) -> Vec<f64> {
    let end = seen.completed.last().copied().unwrap_or(0.0);
    let over = COUNTED_OVER.min(end);
    if over <= 0.0 {
        return Vec::new();
    }
    let mut counts = vec![0_u32; (end / over) as usize];
    for time in &seen.completed {
        if let Some(count) = counts.get_mut((time / over) as usize) {
            *count += 1;
        }
    }
    counts.iter().map(|it| f64::from(*it) * 3600.0 / over / lanes as f64).collect()
}

/// The flow per lane after the largest one has passed: its mean until the end [veh/h].
fn discharge(seen: &Seen, lanes: usize) -> Option<f64> {
    let flows = flows(seen, lanes);
    let largest = flows.iter().copied().reduce(f64::max)?;
    let after = flows.iter().position(|it| *it == largest)? + 1;
    let rest = &flows[after..];
    (!rest.is_empty()).then(|| rest.iter().sum::<f64>() / rest.len() as f64)
}

/// Capacity drop [%].
fn drop(seen: &Seen, lanes: usize) -> Option<f64> {
    Some(100.0 * (1.0 - discharge(seen, lanes)? / largest_flow(seen, lanes)?))
}

pub(super) fn rows(effort: &Effort) -> Result<Vec<Row>, Fault> {
    const HOUR: [f64; 2] = [1.0, 4500.0];
    let road = |road| Traffic { road: Road::Motorway(road), times: HOUR, ..Traffic::on_motorway(3, 1800.0) };
    let long = Motorway { length_m: 8000.0, ..Motorway::default() };
    let lane_drop = road(Motorway { lane_drop_at: Some(5000.0), ..long.clone() });
    let on_ramp = Traffic {
        demand: Arriving::At(vec![("1", 5200.0), ("247", 400.0)]),
        ..road(Motorway { on_ramp_at: vec![5000.0], ..long })
    };
    let [dropped, merged] = &drive_all(effort, [lane_drop, on_ramp])?;
    let waves = Row {
        what: "speed of waves in the jam before the lane drop".into(),
        unit: "km/h",
        value: over(dropped, wave),
        range: [-20.0, -13.0],
        source: WAVES,
    };
    let rows = [
        bottleneck("a lane drop from 3 to 2", 2, dropped, BOTTLENECKS),
        bottleneck("an on-ramp on three lanes", 3, merged, RAMPS),
    ];
    Ok(rows.into_iter().flatten().chain([waves]).collect())
}

/// The largest flow behind a bottleneck with so many lanes, and how much less it is once there is a jam.
fn bottleneck(name: &str, lanes: usize, runs: &[Seen], source: &'static str) -> [Row; 2] {
    let largest = Row {
        what: format!("largest flow per lane behind {name}"),
        unit: "veh/h",
        value: over(runs, |it| largest_flow(it, lanes)),
        range: [1800.0, 2300.0],
        source,
    };
    let dropped = Row {
        what: "capacity drop there".into(),
        unit: "%",
        value: over(runs, |it| drop(it, lanes)),
        range: [5.0, 15.0],
        source: DROPS,
    };
    [largest, dropped]
}

/// Speed of waves [km/h] between 2 and 4 km: where speeds at a place are most like those 500 m further, some time
/// before.
fn wave(seen: &Seen) -> Option<f64> {
    const PLACES: [usize; 4] = [20, 25, 30, 35];
    const FURTHER: usize = 5;
    /// Intervals before the jam has reached the place, and the longest delay.
    const BEFORE: usize = 120;
    const LONGEST: usize = 30;
    let series = |section: usize| -> Option<Vec<f64>> {
        let means = seen.speeds.get(section)?.iter().map(|(sum, count)| sum / f64::from((*count).max(1)));
        Some(means.skip(BEFORE).collect())
    };
    let speeds = PLACES.iter().filter_map(|place| {
        let (here, there) = (series(*place)?, series(place + FURTHER)?);
        let alike = |delay: usize| correlation(&there, here.get(delay..)?);
        let best = (1..LONGEST).max_by(|a, b| {
            let of = |it: &usize| alike(*it).unwrap_or(-1.0);
            of(a).total_cmp(&of(b))
        })?;
        let [before, at, after] = [alike(best - 1)?, alike(best)?, alike(best + 1)?];
        let curvature = before - 2.0 * at + after;
        let delay = best as f64 + if curvature < 0.0 { 0.5 * (before - after) / curvature } else { 0.0 };
        Some(-3.6 * FURTHER as f64 * SECTION / (delay * INTERVAL))
    });
    laneweave::study::mean(&speeds.collect::<Vec<f64>>()).map(|it| it.mean)
}

/// Correlation of two series, as far as both go.
fn correlation(one: &[f64], other: &[f64]) -> Option<f64> {
    let length = one.len().min(other.len());
    if length < 2 {
        return None;
    }
    let centred = |of: &[f64]| {
        let mean = of[..length].iter().sum::<f64>() / length as f64;
        of[..length].iter().map(|it| it - mean).collect::<Vec<f64>>()
    };
    let (one, other) = (centred(one), centred(other));
    let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let size = (product(&one, &one) * product(&other, &other)).sqrt();
    (size > 0.0).then(|| product(&one, &other) / size)
}
