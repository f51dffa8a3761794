//! Time gaps, and what one lane of a style carries.

use std::path::Path;

use laneweave::Fault;
use laneweave::models::follow::Pace;
use laneweave::style::{StyleTemplate, find};

use crate::experiments::drive::{between, drive_all, over};
use crate::experiments::effort::Effort;
use crate::experiments::finding::Row;
use crate::experiments::plausibility::capacity::largest_flow;
use crate::experiments::seen::Seen;
use crate::experiments::traffic::Traffic;

/// 100 km/h, and the limit of a motorway [m/s].
const SPEED: f64 = 100.0 / 3.6;
const LIMIT: f64 = 120.0 / 3.6;
const SOURCE: &str = "comfortable .98 s, minimum .66 s (Taieb-Maor, Shinar 2001, m); by style: ours";

pub(super) fn rows(effort: &Effort) -> Result<Vec<Row>, Fault> {
    let alone =
        |style| Traffic { styles: vec![(style, 1.0)], trucks: 0.0, ..Traffic::on_motorway(1, 3500.0) };
    let in_traffic = |style| Traffic { styles: vec![(style, 1.0)], ..Traffic::on_motorway(3, 1300.0) };
    let [aggressive, conservative] = ["aggressive", "conservative"];
    let [fast, calm, fast_traffic, calm_traffic] = &drive_all(
        effort,
        [alone(aggressive), alone(conservative), in_traffic(aggressive), in_traffic(conservative)],
    )?;
    let row = |what: String, unit, value, range, source| Row { what, unit, value, range, source };
    let gap_row = |style: &str, range| -> Result<Row, Fault> {
        let gap = equilibrium(style)?;
        let value = laneweave::study::mean(&[gap]);
        Ok(row(format!("time gap of {style} drivers at 100 km/h in equilibrium"), "s", value, range, SOURCE))
    };
    let measured = |style: &str, runs: &[Seen], range| {
        let value = over(runs, |it| it.time_gaps.get(style)?.estimate().map(|it| it.mean));
        row(
            format!("time gap of {style} drivers who follow at about 100 km/h, in traffic"),
            "s",
            value,
            range,
            SOURCE,
        )
    };
    Ok(vec![
        gap_row(aggressive, [0.7, 1.2])?,
        gap_row(conservative, [1.2, 1.8])?,
        measured(aggressive, fast_traffic, [0.7, 1.5]),
        measured(conservative, calm_traffic, [1.0, 2.0]),
        row(
            "one lane of aggressive drivers carries more than one of conservative drivers by".into(),
            "veh/h",
            between(fast, calm, |fast, calm| Some(largest_flow(fast, 1)? - largest_flow(calm, 1)?)),
            [0.0, f64::INFINITY],
            "ours",
        ),
    ])
}

/// The time gap [s] of a typical driver of `style` at 100 km/h behind a leader as fast as itself.
fn equilibrium(style: &str) -> Result<f64, Fault> {
    let template = StyleTemplate::parse(&find(style, Path::new(""), String::new)?)?;
    let typical = template.typical();
    let pace = Pace::new(SPEED, LIMIT * typical.speed_factor);
    Ok(typical.follow.equilibrium_gap(pace) / SPEED)
}
