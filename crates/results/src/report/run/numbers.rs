//! Key numbers.

use laneweave_study::units::KMH_PER_MPS;
use laneweave_study::{Interval, poisson_interval};

use super::RunReport;
use crate::outcome::{LineServed, Summary};
use crate::report::{Section, Tile, counted, number, with_interval};

pub(super) fn section(run: &RunReport) -> Section {
    let summary = run.summary;
    let is_driven = summary.lane_changes_per_veh_km.is_some();
    let per_km = |count: u64| rate_per(count, summary.veh_km) + " per veh\u{2011}km";
    let if_driven = |text: String| if is_driven { text } else { "no vehicle drove".into() };
    let within = {
        let Interval { lower, upper } = poisson_interval(summary.lane_changes);
        let [lower, upper] = [lower, upper].map(|it| number(it / summary.veh_km, 3));
        let way = number(summary.veh_km, 4);
        format!("95 %: {lower} to {upper}; n = {}, {way} veh\u{2011}km", counted(summary.lane_changes))
    };
    let speed = summary.mean_speed_mps.map_or("–".into(), |it| format!("{:.1} km/h", it * KMH_PER_MPS));
    let delay = run.record.trips.delay.estimate();
    let interval = delay.map_or(String::new(), |it| {
        let Interval { lower, upper } = it.interval();
        let trips = counted(it.replications as u64);
        match it.half_width.is_finite() {
            true => format!("95 %: {} to {} s; n = {trips} trips", number(lower, 3), number(upper, 3)),
            false => format!("n = {trips} trip"),
        }
    });
    let Summary { entered, completed, on_road, waiting_to_enter, .. } = summary;
    let tiles = vec![
        tile(
            summary.lane_changes_per_veh_km.map_or("–".into(), |it| number(it, 3)),
            "lane changes per veh\u{2011}km",
            if_driven(within),
        ),
        tile(
            counted(summary.lane_changes_discretionary),
            "discretionary lane changes",
            if_driven(per_km(summary.lane_changes_discretionary)),
        ),
        tile(
            counted(summary.lane_changes_route_driven),
            "route-driven lane changes",
            if_driven(per_km(summary.lane_changes_route_driven)),
        ),
        tile(
            counted(summary.lane_changes_keeping),
            "lane changes to keep to the slow side",
            if_driven(per_km(summary.lane_changes_keeping)),
        ),
        tile(speed, "mean speed", "distance divided by time, all vehicles".into()),
        tile(summary.mean_delay_s.map_or("–".into(), |it| format!("{it:.1} s")), "mean trip delay", interval),
        tile(
            summary.mean_trip_duration_s.map_or("–".into(), |it| format!("{it:.1} s")),
            "mean trip time",
            summary.mean_stops.map_or(String::new(), |it| format!("with {it:.2} stops")),
        ),
        tile(
            counted(*entered),
            "vehicles entered",
            format!("= {} completed + {} on the road", counted(*completed), counted(*on_road)),
        ),
        tile(counted(*waiting_to_enter), "vehicles waiting to enter", "at the end".into()),
    ];
    let tiles = [tiles, lines(summary), troubles(summary)].concat();
    Section::new("numbers", "Key numbers").tiles(tiles).note(
        "A lane change counts when the centre of the vehicle crosses the line. The intervals of counts are exact Poisson 95 % \
         intervals, which assume that lane changes are independent. Delay is the trip time minus the time on a free road at the \
         driver's desired speeds. Its interval is Student's over trips, which share the same traffic and are not fully independent. \
         One run does not show how runs differ: repeat it with other seeds.",
    )
}

fn tile(value: String, name: &str, more: String) -> Tile {
    Tile { value, name: name.into(), more }
}

/// What the lines of buses did.
fn lines(summary: &Summary) -> Vec<Tile> {
    let of_line = |it: &LineServed| {
        let more = format!("of line {}, by {} departures; {} missed", it.name, it.departed, it.stops_missed);
        tile(counted(it.stops_served), "stops served", more)
    };
    summary.lines.iter().map(of_line).collect()
}

/// Problems, and changes of route.
fn troubles(summary: &Summary) -> Vec<Tile> {
    vec![
        tile(counted(summary.collisions), "collisions", "two vehicles touch while approaching".into()),
        tile(counted(summary.overlaps), "overlaps", "of any two vehicles, whatever their lanes".into()),
        tile(
            counted(summary.emergency_brakings),
            "emergency brakings",
            "decided by kinematics, not by the model".into(),
        ),
        tile(counted(summary.hard_brakings), "hard brakings", "beyond 4 m/s², whoever decided".into()),
        tile(counted(summary.stuck), "vehicles stuck", "stood for 300 s".into()),
        tile(counted(summary.lost), "lost", "drivers without a route to any destination".into()),
        tile(counted(summary.missed_turns), "missed turns", "drivers who had to take another route".into()),
        tile(counted(summary.route_changes), "route changes", "drivers who chose a better route".into()),
    ]
}

/// A count per unit of exposure with its exact Poisson interval, as text.
pub(super) fn rate_per(count: u64, exposure: f64) -> String {
    let Interval { lower, upper } = poisson_interval(count);
    let interval = Interval { lower: lower / exposure, upper: upper / exposure };
    with_interval(count as f64 / exposure, interval, 3)
}
