//! Time–space diagrams of the lanes with the largest distance driven.

use super::RunReport;
use crate::report::{Section, time_and_space};
use crate::seen::Traces;

pub(super) fn section(run: &RunReport) -> Section {
    let section = Section::new("roads", "Time and space");
    let name = |it: &Traces| format!("lane from lanelet {} on", it.lanelet);
    let lanes: Vec<(String, &Traces)> = run.record.roads.iter().map(|it| (name(it), it)).collect();
    match time_and_space(&lanes) {
        Some(figure) => section.figures(vec![figure]),
        None => section.text("No vehicle drove on the lane."),
    }
}
