//! Time–space diagrams of the lanes on which most way is driven.

use laneweave_study::{Mark, Sample, Sheet, time_space};

use super::RunReport;
use crate::output::Traces;
use crate::report::{Figure, Section, counted};

/// More trajectories, and more lane changes, than this are not drawn: of them only every second, third … one.
const MOST: [usize; 2] = [300, 300];

pub(super) fn section(run: &RunReport) -> Section {
    let section = Section::new("roads", "Time and space");
    let figures: Vec<Figure> = run.record.roads.iter().filter_map(figure).collect();
    if figures.is_empty() {
        section.text("Nobody drove on the lanes that would be shown.")
    } else {
        section.figures(figures)
    }
}

fn figure(traces: &Traces) -> Option<Figure> {
    let Traces { lanelet, changes, .. } = traces;
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
        title: format!("Time and space on the lane from lanelet {lanelet} on"),
        caption: format!(
            "The slow lane from an entrance and where it goes on, of those on which most way is to be driven, at most 10 km and an hour: each line is a vehicle \
             while it is on the lane, its colour the speed, taken once a second. n = {} lines{}; {} changes onto and off the \
             lane{}.",
            counted(all[0] as u64),
            of(every[0]),
            counted(all[1] as u64),
            of(every[1])
        ),
    })
}
