//! The figure of lanes: their vehicles in time and space.

use laneweave_study::{LaneInTime, Sheet, time_space};

use super::Figure;
use crate::numbers::counted;
use crate::seen::Traces;

/// Maximum of trajectories, and of lane changes, on a lane in a figure: beyond it, only every second, third … one is
/// drawn.
const MOST: [usize; 2] = [300, 300];

/// Time and space on lanes with their names, as panels with one scale of colours; `None` without vehicles.
pub fn time_and_space(lanes: &[(String, &Traces)]) -> Option<Figure> {
    let drawn: Vec<(LaneInTime, String)> = lanes.iter().filter_map(|(name, it)| lane(name, it)).collect();
    if drawn.is_empty() {
        return None;
    }
    let (panels, counts): (Vec<LaneInTime>, Vec<String>) = drawn.into_iter().unzip();
    let names: Vec<String> = panels.iter().map(|it| format!(", {}", it.name)).collect();
    Some(Figure {
        drawn: time_space(Sheet::Column, "", &panels),
        title: match &names[..] {
            [only] => format!("Time and space{only}"),
            _ => "Time and space".into(),
        },
        caption: format!(
            "The slow lane from an entrance on and its continuation, at most 10 km and one hour: of all entrances, a lane with a large \
             product of length and demand. Each line is a vehicle while it is on the lane, sampled once a second; its colour is the \
             speed, on one scale for all panels. n = {}.",
            counts.join(", ")
        ),
    })
}

/// A lane with its name, and the numbers of what is on it.
fn lane<'a>(name: &str, traces: &'a Traces) -> Option<(LaneInTime<'a>, String)> {
    let changes = &traces.changes;
    let driven = || traces.trajectories().filter(|it| it.len() > 1);
    let all = [driven().count(), changes.len()];
    if all[0] == 0 {
        return None;
    }
    let every = [0, 1].map(|it| all[it].div_ceil(MOST[it]).max(1));
    let of = |every: usize| if every == 1 { String::new() } else { format!(" (one in {every} is drawn)") };
    let panel = LaneInTime {
        name: name.into(),
        trajectories: driven().step_by(every[0]).collect(),
        changes: changes.iter().step_by(every[1]).copied().collect(),
    };
    let counts = format!(
        "{} lines{} and {} lane changes onto and off it{} on the {name}",
        counted(all[0] as u64),
        of(every[0]),
        counted(all[1] as u64),
        of(every[1])
    );
    Some((panel, counts))
}
