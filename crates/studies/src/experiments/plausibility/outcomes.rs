//! What comes of lane changes: speed that is gained, vehicles that are passed, followers who are cut off.

use crate::experiments::drive::{between, over};
use crate::experiments::finding::Row;
use crate::experiments::seen::Seen;

const OURS: &str = "ours: what separates drivers from coins";

/// Gains and returns beside those of a constant hazard, at 1,100 veh/h/lane on three lanes.
pub(super) fn beside_coin(ours: &[Seen], coin: &[Seen]) -> [Row; 4] {
    let gain = |it: &Seen| it.outcomes.gains.estimate().map(|it| it.mean);
    let empty = |it: &Seen| it.outcomes.returns.percent();
    let row = |what: &str, unit, value, range| Row { what: what.into(), unit, value, range, source: OURS };
    [
        row(
            "speed in the 15 s after a discretionary change, less that of the traffic that was left",
            "m/s",
            over(ours, gain),
            [0.0, f64::INFINITY],
        ),
        row(
            "that gain of speed, less a constant hazard's",
            "m/s",
            between(ours, coin, |ours, coin| Some(gain(ours)? - gain(coin)?)),
            [0.0, f64::INFINITY],
        ),
        row(
            "returns to the slow side by drivers who had overtaken nobody",
            "%",
            over(ours, empty),
            [0.0, 25.0],
        ),
        row(
            "those returns, less a constant hazard's",
            "points",
            between(ours, coin, |ours, coin| Some(empty(ours)? - empty(coin)?)),
            [f64::NEG_INFINITY, 0.0],
        ),
    ]
}

/// Returns, and followers who are cut off, under a law that wants drivers on the slow side.
pub(super) fn of_law(flow: f64, ours: &[Seen]) -> [Row; 2] {
    let at = format!("{flow:.0} veh/h/lane on 3 lanes, law of Germany");
    let cut_off = |it: &Seen| Some(it.outcomes.keeping.percent()? - it.outcomes.discretionary.percent()?);
    [
        Row {
            what: format!("returns to the slow side by drivers who had overtaken nobody, {at}"),
            unit: "%",
            value: over(ours, |it| it.outcomes.returns.percent()),
            range: [0.0, 25.0],
            source: "ours",
        },
        Row {
            what: format!(
                "changes for the slow side before a follower within 1 s, less that of discretionary ones, {at}"
            ),
            unit: "points",
            value: over(ours, cut_off),
            range: [f64::NEG_INFINITY, 0.0],
            source: "ours: nobody should be cut off for tidiness",
        },
    ]
}
