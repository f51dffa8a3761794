//! Time–space diagrams of the lanes with the largest distance driven.

use super::RunReport;
use crate::report::{Figure, Section, time_and_space};

pub(super) fn section(run: &RunReport) -> Section {
    let section = Section::new("roads", "Time and space");
    let figures: Vec<Figure> = run
        .record
        .roads
        .iter()
        .filter_map(|it| {
            time_and_space(it, format!("Time and space on the lane from lanelet {} on", it.lanelet))
        })
        .collect();
    if figures.is_empty() { section.text("No vehicle drove on the lane.") } else { section.figures(figures) }
}
