//! All drivers of a run: the reasons of their lane changes, and the reasons against.

use std::collections::BTreeMap;
use std::fmt::Write;

use laneweave_sim::{Act, Event, Phase, Spot, explain};

use crate::Simulation;

use super::words::reason;

/// Counts of reasons.
#[derive(Clone, Debug, PartialEq)]
pub struct Commonest {
    /// Changes from this time on are counted, by when their centre crossed the line [s].
    pub since_s: f64,
    /// Completed changes by style and by the row with the largest contribution in favour.
    pub changes: BTreeMap<(String, String), u64>,
    /// Times that drivers considered lanes and stayed, or waited for a second, by reason.
    pub refusals: BTreeMap<String, u64>,
}

impl Commonest {
    /// No counts; counting begins now.
    pub fn since_now(simulation: &Simulation) -> Commonest {
        Commonest { since_s: simulation.time_s(), changes: BTreeMap::new(), refusals: BTreeMap::new() }
    }

    /// Asks all drivers who consider lanes in the next step, and simulates it.
    pub fn step(&mut self, simulation: &mut Simulation) {
        let world = simulation.world();
        let clock = world.clock();
        // A driver who waits is asked once a second.
        let asks_those_who_wait = clock.step.is_multiple_of(clock.steps(1.0));
        let asked: Vec<Spot> = world
            .vehicles()
            .filter(|it| it.is_in_lane())
            .filter(|it| match it.driver.phase {
                Phase::Cruises => it.driver.due <= clock.step,
                Phase::Wants => asks_those_who_wait,
                Phase::Changes | Phase::Aborts => false,
            })
            .map(|it| it.spot)
            .collect();
        for spot in asked {
            let account = explain(world, spot);
            if matches!(account.act, Act::Stays | Act::Waits(..)) {
                *self.refusals.entry(reason(&account)).or_default() += 1;
            }
        }
        simulation.advance();
        let world = simulation.world();
        for event in world.events() {
            if let Event::LaneChange(change) = event
                && change.is_completed
                && change.time >= self.since_s
            {
                let style = &world.driver_parameters()[change.parameters as usize];
                let names = style.change.row_names();
                let row = change.appraisal.leading().map(|row| names[row]).filter(|it| !it.is_empty());
                let key = (style.name.clone(), row.unwrap_or("nothing").to_string());
                *self.changes.entry(key).or_default() += 1;
            }
        }
    }

    /// Tables of both, the most frequent first.
    pub fn to_text(&self) -> String {
        let mut text = String::new();
        let all: u64 = self.changes.values().sum();
        // Writing to a string never fails.
        let _ = writeln!(text, "{all} lane changes, by style and by the leading incentive");
        let mut changes: Vec<_> = self.changes.iter().collect();
        changes.sort_by(|a, b| b.1.cmp(a.1));
        for ((style, row), count) in changes {
            let _ = writeln!(text, "  {:>6.1} %  {count:>7}  {style}: {row}", percent(*count, all));
        }
        let all: u64 = self.refusals.values().sum();
        let _ = writeln!(
            text,
            "{all} considerations in which a driver stayed in its lane, or waited for a second, because"
        );
        let mut refusals: Vec<_> = self.refusals.iter().collect();
        refusals.sort_by(|a, b| b.1.cmp(a.1));
        for (reason, count) in refusals {
            let _ = writeln!(text, "  {:>6.1} %  {count:>7}  {reason}", percent(*count, all));
        }
        text
    }
}

fn percent(part: u64, all: u64) -> f64 {
    if all == 0 { 0.0 } else { 100.0 * part as f64 / all as f64 }
}
