//! Time–space diagrams of the busiest lanes.

use laneweave_study::{Sample, Sheet, time_space};

use super::RunReport;
use crate::output::Traces;
use crate::report::{Figure, Section};

/// More trajectories than this are not drawn: of them only every second, third … one.
const MOST: usize = 300;

pub(super) fn section(run: &RunReport) -> Section {
    let section = Section::new("roads", "Time and space");
    let figures: Vec<Figure> = run.record.roads.iter().filter_map(figure).collect();
    if figures.is_empty() {
        section.text("Nobody drove on the lanes of the busiest entrances.")
    } else {
        section.figures(figures)
    }
}

fn figure(traces: &Traces) -> Option<Figure> {
    let driven = || traces.trajectories().filter(|it| it.len() > 1);
    let all = driven().count();
    let every = all.div_ceil(MOST).max(1);
    let drawn: Vec<Vec<Sample>> = driven().step_by(every).cloned().collect();
    if drawn.is_empty() {
        return None;
    }
    let which = match every {
        1 => "each line is a vehicle while it is on the lane".into(),
        _ => format!("each line is a vehicle while it is on the lane, one in {every} of them"),
    };
    let Traces { lanelet, changes, .. } = traces;
    Some(Figure {
        svg: time_space(Sheet::Column, "", &drawn, changes),
        title: format!("Time and space on the lane from lanelet {lanelet} on"),
        caption: format!(
            "The slow lane of a busiest entrance and where it goes on, at most 10 km and an hour; {which}, its colour the speed, \
             taken once a second. n = {} of {all} lines; {} changes onto and off the lane.",
            drawn.len(),
            changes.len()
        ),
    })
}
