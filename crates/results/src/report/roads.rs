//! The figure of a lane: its vehicles in time and space.

use laneweave_study::{Mark, Sample, Sheet, time_space};

use super::Figure;
use crate::numbers::counted;
use crate::seen::Traces;

/// Maximum of trajectories, and of lane changes, in a figure: beyond it, only every second, third … one is drawn.
const MOST: [usize; 2] = [300, 300];

/// Time and space on the lane of `traces`; `None` without vehicles.
pub fn time_and_space(traces: &Traces, title: String) -> Option<Figure> {
    let changes = &traces.changes;
    let driven = || traces.trajectories().filter(|it| it.len() > 1);
    let all = [driven().count(), changes.len()];
    let every = [0, 1].map(|it| all[it].div_ceil(MOST[it]).max(1));
    let lines: Vec<&[Sample]> = driven().step_by(every[0]).collect();
    let marks: Vec<Mark> = changes.iter().step_by(every[1]).copied().collect();
    if lines.is_empty() {
        return None;
    }
    let of = |every: usize| if every == 1 { String::new() } else { format!(" (one in {every} is drawn)") };
    Some(Figure {
        svg: time_space(Sheet::Column, "", &lines, &marks),
        title,
        caption: format!(
            "The slow lane from an entrance on and its continuation, at most 10 km and one hour. Of all entrances, this lane has \
             the largest product of length and demand. Each line is a vehicle while it is on the lane, sampled once a second; its \
             colour is the speed. n = {} lines{}; {} lane changes onto and off the lane{}.",
            counted(all[0] as u64),
            of(every[0]),
            counted(all[1] as u64),
            of(every[1])
        ),
    })
}
